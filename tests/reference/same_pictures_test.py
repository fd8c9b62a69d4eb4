"""Radiance's own real scenes through `oconv | rpict` and through `lightwell render`: the same pictures, to the bit.

The scenes are not part of the repository: fixtures/radiance in LIGHTWELL_SHARED, or beside the repository. Job files are taken with
the first of their views. What is refused must be refused by both.
"""

import os
import pathlib
import re
import shlex
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("LIGHTWELL", str(ROOT / "build/release/lightwell"))
SCENES = pathlib.Path(os.environ.get("LIGHTWELL_SHARED", ROOT.parent / "shared")) / "fixtures/radiance"
SKY = ["!gensky 6 21 12 -a 40 -o 105 -m 105", "skyfunc glow sky_glow 0 0 4 1 1 1 0", "sky_glow source sky 0 0 4 0 0 1 180"]
SIZE = "20"
# Read back from its compiled form this scene gives some pixels other samples of the same light.
WITHIN_NOISE = {"glass"}


def scene_lines(folder, files, more=()):
    return [name if name.startswith("!") else f"!xform {folder / name}" for name in files] + list(more)


def of_job(file):
    """Files, commands and the first view of a job file (.rif)."""
    words = {"materials": [], "scene": [], "view": []}
    for line in file.read_text().replace("\\\n", " ").splitlines():
        key, _, value = line.partition("=")
        # Names of variables may be cut short after three letters.
        key = next((name for name in words if len(key.strip()) >= 3 and name.startswith(key.strip())), "")
        if key and not (key == "view" and words["view"]):
            words[key] += shlex.split(value)
    view = words["view"][1:]
    if "-vf" in view:
        at = view.index("-vf")
        view[at:at + 2] = view_of(file.parent / view[at + 1]).split()
    return words["materials"] + words["scene"], " ".join(view)


def view_of(file):
    lines = [line for line in file.read_text().splitlines() if not line.startswith("#") and line.strip()]
    return re.sub(r"^\S+\s+(-[xy] \d+ )*", "", lines[-1])


def all_scenes():
    cornell, office, room = SCENES / "cornell_box", SCENES / "lbnl_reference_office", SCENES / "lbnl_tutorial_room"
    for name in ("cornell", "cornell_window"):
        yield name, scene_lines(cornell, [name + ".rad"]), view_of(cornell / "cornell.vf")
    parts = sorted(file.name for file in office.glob("*.rad"))
    yield "office", scene_lines(office, ["materials.mat"] + parts, SKY), "-vp 6 6 4 -vd 0 1 0 -vh 60 -vv 60"
    parts = ["materials.rad", "room.rad", "objects/Glazing.rad"]
    yield "tutorial room", scene_lines(room, parts, SKY), view_of(room / "views/in.vf")
    for job in sorted((SCENES / "radiance_test_renders").glob("*.rif")):
        names, view = of_job(job)
        yield job.stem, scene_lines(job.parent, names), view


def run(*words, output=None):
    """Standard error of a program, and whether it succeeded."""
    path = os.pathsep.join([".", str(SCENES.parents[1] / "reference/radiance-renders/common")])
    with open(output or os.devnull, "wb") as out:
        done = subprocess.run([PROGRAM, *words], stdout=out, stderr=subprocess.PIPE, check=False,
                              cwd=SCENES / "radiance_test_renders", env={**os.environ, "RAYPATH": path})
    return done.stderr.decode(errors="replace"), done.returncode == 0


def pixels(file):
    done = subprocess.run([PROGRAM, "rad", "pvalue", "-h", "-H", "-d", str(file)], capture_output=True, check=True)
    return [float(word) for word in done.stdout.split()]


class SamePictures(unittest.TestCase):
    def test_every_scene_gives_the_same_bits_through_both_doors(self):
        if not SCENES.is_dir():
            self.skipTest("the real scenes are not here")
        rendered = []
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for title, lines, view in all_scenes():
                with self.subTest(scene=title):
                    if self.compare(folder, title, lines, view):
                        rendered.append(title)
        self.assertGreaterEqual(len(rendered), 8)

    def compare(self, folder, title, lines, view):
        scene, octree = folder / "scene.rad", folder / "scene.oct"
        scene.write_text("\n".join(lines) + "\n")
        said, done = run("rad", "oconv", "-w", str(scene), output=octree)
        words = [*view.split(), "-x", SIZE, "-y", SIZE, "-ab", "2", "-ad", "49"]
        if done:
            said, done = run("rad", "rpict", *words, str(octree), output=folder / "rpict.hdr")
        other_said, other_done = run("render", str(scene), "--view", view, "--size", SIZE + "x" + SIZE,
                                     "--accuracy", "10%", "--hdr", "-o", str(folder / "render.exr"))
        self.assertEqual(done, other_done, (said, other_said))
        if not done:
            print(title, "is refused by both:", said.strip()[-250:])
            return False
        first, second = pixels(folder / "rpict.hdr"), pixels(folder / "render.hdr")
        if title in WITHIN_NOISE:
            self.assertEqual(len(first), len(second))
            self.assertAlmostEqual(sum(first) / sum(second), 1, delta=0.03)
        else:
            self.assertEqual(first, second)
        alike = sum(a == b for a, b in zip(first, second)) / len(first)
        print(f"{title}: {alike:.1%} of {len(first) // 3} pixels alike, mean {sum(first) / len(first):.4g}")
        return sum(first) > 0


if __name__ == "__main__":
    unittest.main(verbosity=2)
