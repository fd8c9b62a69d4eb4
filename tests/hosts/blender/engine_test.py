"""The add-on with the engine: the picture and the means are those of the command line on the same scene folder."""

import csv
import io
import json
import os
import pathlib
import subprocess
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from baked import Baked
from blender import OFFICE, TRUTH, InBlender, run
from lightwell_bridge import exr


class Engine(InBlender):
    def setUp(self):
        self.result = self.once("inside_engine.py", file=OFFICE)
        self.scene = self.path / "kept" / "scene.rad"

    def command(self, *words):
        done = subprocess.run([os.environ["LIGHTWELL"], *map(str, words)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_what_the_engine_read_is_what_blender_has(self):
        """Faces by number of corners, area and bounds of each object, as the engine tells them."""
        truth = json.loads(TRUTH.read_text())["objects"]
        parts = {p["name"]: p for p in self.result["load"]["parts"]}
        for source, part in parts.items():
            name = source.rsplit("/", 1)[-1]
            if name not in truth or "cage" not in truth[name] or name.startswith("Pouf"):
                continue
            wanted = truth[name]["cage"]
            self.assertEqual(part["faces"], wanted["faces"], source)
            sizes = {int(k): v for k, v in part["corners"].items()}
            self.assertEqual(sum(n for k, n in sizes.items() if k > 4), wanted["ngons"], source)
            self.assertEqual(max(sizes), wanted["largest_ngon"], source)
            self.assertLessEqual(abs(part["area_m2"] - wanted["area"]), max(1e-5, 1e-6 * wanted["area"]), source)
            if not name.startswith("Asset"):
                np.testing.assert_allclose([part["low"], part["high"]], wanted["bbox"], atol=1e-5, err_msg=source)

    def test_the_picture_is_that_of_the_command_line(self):
        self.assertIsNone(self.result["whole"], self.said[-3000:])
        words = ["--samples", "16", "--seed", "1", "--size", "96x60"]
        self.command("render", self.scene, "--view", "Camera main", *words, "-o", self.path / "cli.exr")
        theirs, ours = exr.read(self.path / "cli.exr")[1], exr.read(self.path / "whole.exr")[1]
        lit = np.isfinite(theirs["illuminance.Y"])
        np.testing.assert_allclose(ours["ViewLayer.Illuminance.X"][lit], theirs["illuminance.Y"][lit], rtol=1e-5)
        # Luminance of the displayed colours: Rec.709 weights of a white that was adapted.
        luminance = 179 * sum(w * theirs[c].astype(float) for w, c in zip((0.265, 0.670, 0.065), "RGB"))
        np.testing.assert_allclose(ours["ViewLayer.Luminance.X"], luminance, rtol=1e-4, atol=1e-3)
        self.assertIn("ViewLayer.Error.X", ours)
        self.assertIn("ViewLayer.ObjectLayer.X", ours)
        np.testing.assert_allclose(ours["ViewLayer.Depth.Z"][lit], theirs["Z"][lit], rtol=1e-5)

    def test_a_border_shows_the_same_pixels_in_their_place(self):
        self.assertIsNone(self.result["border"], self.said[-3000:])
        whole, part = (exr.read(self.path / f"{name}.exr")[1]["ViewLayer.Illuminance.X"] for name in ("whole", "border"))
        inside = np.zeros(whole.shape, dtype=bool)
        inside[60 - 36:60 - 12, 24:72] = True
        np.testing.assert_array_equal(part[inside], whole[inside])
        self.assertEqual(float(np.abs(part[~inside]).max()), 0)

    def test_other_cameras_show_something_else(self):
        for camera in ("Camera plan", "Camera fisheye"):
            self.assertIsNone(self.result[camera], self.said[-3000:])
            picture = exr.read(self.path / f"{camera}.exr")[1]["ViewLayer.Combined.G"]
            self.assertGreater(float(picture.mean()), 0.1, camera)

    def test_the_mean_of_each_object_is_that_of_the_command_line(self):
        rows = {r["name"]: r for r in csv.DictReader(io.StringIO(self.result["table"])) if r["kind"] == "object"}
        self.assertEqual(len(rows), 28)
        self.command("bake", self.path / "lit" / "scene.rad", "--all", "--spacing", "1", "--samples", "16", "--seed", "3",
                     "-o", self.path / "baked")
        baked = Baked(self.path / "baked" / "maps.json")
        self.assertEqual(rows["Architecture/Floor and ceiling/Ceiling"]["side"], "front")
        worst = (0.0, "")
        for source, row in rows.items():
            area, lux = baked.mean({source}, row["side"])
            self.assertAlmostEqual(float(row["area_m2"]), area, delta=1e-6 * area + 1e-9, msg=source)
            # Two runs, each with the error of the row.
            stated = 3 * 2 ** 0.5 * float(row["error_lx"]) + 1e-6 * lux
            worst = max(worst, (abs(float(row["mean_lx"]) - lux) / stated, source))
        print(f"28 objects: at worst {worst[0]:.2f} of three standard errors of the difference: {worst[1]}")
        self.assertLessEqual(worst[0], 1)

    def test_values_sit_on_the_objects_and_go_away_again(self):
        self.assertEqual(self.result["illuminance"], ["FINISHED"])
        self.assertEqual(len(self.result["shown"]), 25)
        rows = {r["name"]: r for r in csv.DictReader(io.StringIO(self.result["table"])) if r["kind"] == "object"}
        for name in ("Floor", "Ceiling", "Wall E", "Door leaf"):
            source = next(s for s in rows if s.endswith("/" + name))
            self.assertAlmostEqual(self.result["shown"][name][0] / float(rows[source]["mean_lx"]), 1, places=4)
        self.assertTrue(self.result["same"])
        self.assertRegex(self.result["report"], r"Floor +\d+\.\d +\d+\.\d+ +\d+\.\d +\d+\.\d +0\.\d\d")


if __name__ == "__main__":
    run()
