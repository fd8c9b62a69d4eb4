#!/usr/bin/python3
"""cycles_ladder.py FOLDER [WIDTH]: the office by Cycles with 1 to 1024 samples a pixel, for `lightwell tradeoff --peer-file`.

Writes FOLDER/scene (what the add-on hands to Lightwell) and FOLDER/cycles.csv (luminances, cd/m2). Matt surfaces are Diffuse BSDF, emission
is of fronts alone, there is no sun and no sky: where the same words mean other light in Cycles. Then:

    lightwell tradeoff FOLDER/scene/blender_office.rad --view "Camera main" --size 64x40 --peer-file FOLDER/cycles.csv -o FOLDER/blender_office
"""

import pathlib
import shutil
import sys

import numpy as np

from beside_cycles import WEIGHTS, colours
from blender import OFFICE, InBlender
from lightwell_bridge import exr

LUMEN_PER_W = 179
SAMPLES = [4 ** i for i in range(6)]


class Ladder(InBlender):
    """Not a test: it measures."""

    def rows(self, width, folder):
        height = round(width * 0.625)
        counts = ",".join(map(str, SAMPLES))
        answer = self.blender("inside_cycles.py", width, height, 4, counts, "alike", file=OFFICE)
        shutil.copytree(self.path / "scene", folder / "scene", dirs_exist_ok=True)
        (folder / "scene/scene.rad").rename(folder / "scene/blender_office.rad")
        for samples, (cpu_s, wall_s) in answer["cycles"].items():
            luminance = colours(exr.read(self.path / f"cycles_{samples}.exr")[1]) @ WEIGHTS * LUMEN_PER_W
            values = ",".join(f"{value:.6g}" for value in np.ravel(luminance))
            yield f"Cycles,{samples},{cpu_s:.3f},{wall_s:.3f},{values}\n"


def main(folder, width=64):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    Ladder.setUpClass()
    try:
        (folder / "cycles.csv").write_text("".join(Ladder("rows").rows(int(width), folder)))
    finally:
        Ladder.tearDownClass()


if __name__ == "__main__":
    main(*sys.argv[1:])
