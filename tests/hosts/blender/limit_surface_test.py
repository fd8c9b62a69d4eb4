"""The limit surface that the engine makes of a cage, against Blender's own mesh at level 6, pixel by pixel."""

import os
import subprocess

import numpy as np

from blender import OFFICE, InBlender, run
from lightwell_bridge import exr

SIDE = 256


class Silhouette(InBlender):
    """From the side and from above, for two creases: where one sees the pouf differs at most along its outline."""

    # Name, words of the view (parallel, 1 m), the two axes across and up.
    VIEWS = (("side", "-vtl -vp 5.3 -4 0.225 -vd 0 1 0 -vu 0 0 1 -vh 1 -vv 1", (0, 2), (5.3, 0.225)),
             ("above", "-vtl -vp 5.3 0.7 4 -vd 0 0 -1 -vu 0 1 0 -vh 1 -vv 1", (0, 1), (5.3, 0.7)))

    def test_it_is_blenders_own_within_a_pixel(self):
        for crease, scene in self.blender("inside_pouf.py", file=OFFICE)["creases"].items():
            mesh = np.load(self.path / f"pouf{crease}.npz")
            for name, view, axes, middle in self.VIEWS:
                with self.subTest(crease=crease, view=name):
                    seen = self.seen(scene, view)
                    wanted = covered(mesh["points"][:, list(axes)] - middle, mesh["faces"])
                    self.assertGreater(wanted.sum(), SIDE * SIDE / 8)
                    # Nothing beyond one pixel around, nothing missing one pixel within.
                    self.assertFalse((seen & ~grown(wanted)).any())
                    self.assertFalse((~seen & ~grown(~wanted)).any())

    def seen(self, scene, view):
        picture = self.path / "pouf.exr"
        subprocess.run([os.environ["LIGHTWELL"], "render", scene, "--view", view, "--size", f"{SIDE}x{SIDE}", "--samples", "8",
                        "-o", picture], check=True, capture_output=True)
        depth = exr.read(picture, ["Z"])[1]["Z"]
        return np.isfinite(depth) & (depth < 100)


def covered(points, faces):
    """Pixels that points spread evenly over the quads fall into, row 0 at the top."""
    share = np.linspace(0, 1, 5)
    x, y = (axis.reshape(-1, 1, 1) for axis in np.meshgrid(share, share))
    a, b, c, d = (points[faces[:, i]] for i in range(4))
    spread = (1 - x) * (1 - y) * a + x * (1 - y) * b + x * y * c + (1 - x) * y * d
    pixels = np.floor((spread.reshape(-1, 2) + 0.5) * SIDE).astype(int)
    mask = np.zeros((SIDE, SIDE), dtype=bool)
    mask[pixels[:, 1], pixels[:, 0]] = True
    return mask[::-1]


def grown(mask):
    """The mask and all pixels that touch it."""
    padded = np.pad(mask, 1)
    return np.any([padded[1 + dy:1 + dy + SIDE, 1 + dx:1 + dx + SIDE] for dy in (-1, 0, 1) for dx in (-1, 0, 1)], axis=0)


if __name__ == "__main__":
    run()
