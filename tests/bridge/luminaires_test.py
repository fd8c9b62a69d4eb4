"""Measured luminaires through the engine: candela of a file as illuminance on a floor, and files that are none."""

import csv
import math
import os
import pathlib
import subprocess
import tempfile
import unittest

import program
import numpy as np
from lightwell_bridge.engine import EngineError
from lightwell_bridge.luminaires import Measured, add_measured
from lightwell_bridge.scene_folder import SceneFolder

ENGINE = os.environ.get("LIGHTWELL", str(program.ROOT / "build/release/lightwell"))
# Candela at 45 degrees from the nadir in the planes 0, 90, 180 and 270 of the file.
PLANES_CD = (800, 300, 20, 100)
LOPSIDED = (program.ROOT / "tests/fixtures/hosts/lopsided.ies").read_text()
HEIGHT_M = 2.0


class Lamps(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory(prefix="lämp ")
        self.addCleanup(place.cleanup)
        self.path = pathlib.Path(place.name)
        self.file = self.path / "lopsided lamp.ies"
        self.file.write_text(LOPSIDED)
        self.folder = SceneFolder(self.path / "scene")
        self.folder.material("plastic", "black", numbers=(0, 0, 0, 0, 0))
        self.folder.surface("black", "polygon", "floor", (-9, -9, 0, 9, -9, 0, 9, 9, 0, -9, 9, 0))

    def place(self, angle_deg=0.0, scale=1.0):
        """Two metres above the floor, turned about the vertical."""
        c, s = (scale * f(math.radians(angle_deg)) for f in (math.cos, math.sin))
        return [[c, -s, 0, 0], [s, c, 0, 0], [0, 0, scale, HEIGHT_M], [0, 0, 0, 1]]

    def add(self, **more):
        return add_measured(self.folder, lambda: ENGINE, Measured("Lamp 1", **dict({"file": self.file, "matrix": self.place()}, **more)))

    def candela(self):
        """What the floor gets two metres along +x, +y, -x and -y, as candela at 45 degrees."""
        scene = self.folder.save()
        at = ((2, 0), (0, 2), (-2, 0), (0, -2))
        points = self.path / "points.txt"
        points.write_text("".join(f"{x} {y} 0.0001 0 0 1\n" for x, y in at))
        subprocess.run([ENGINE, "illuminance", scene, "--grid", f"file:{points}", "--samples", "64", "-o", self.path / "lux.csv"],
                       check=True, capture_output=True)
        with open(self.path / "lux.csv", newline="", encoding="utf-8") as file:
            return [float(row["illuminance_lx"]) * 2 * HEIGHT_M ** 2 * math.sqrt(2) for row in csv.DictReader(file)]

    def test_each_plane_of_the_file_shines_where_it_was_measured(self):
        lumens, notes = self.add()
        np.testing.assert_allclose(self.candela(), PLANES_CD, rtol=0.02)
        self.assertIn("lopsided lamp.ies has 983 lm", notes[-1])
        self.assertAlmostEqual(lumens, 983, delta=1)

    def test_a_lamp_that_is_turned_and_scaled_turns_its_light_and_keeps_it(self):
        self.add(matrix=self.place(90, 3.0))
        np.testing.assert_allclose(self.candela(), np.roll(PLANES_CD, 1), rtol=0.02)

    def test_a_mirrored_lamp_has_its_planes_mirrored(self):
        self.add(matrix=np.array(self.place()) @ np.diag([1, -1, 1, 1]))
        np.testing.assert_allclose(self.candela(), [PLANES_CD[i] for i in (0, 3, 2, 1)], rtol=0.02)

    def test_lumens_replace_those_of_the_file_and_a_factor_scales_them(self):
        whole, _ = self.add()
        lumens, notes = self.add(lumens=500.0)
        self.assertAlmostEqual(lumens, 500)
        self.assertEqual(notes, [])
        half, _ = self.add(factor=0.5, colour=(1.5, 0.8, 1.0))
        self.assertAlmostEqual(half, whole / 2)

    def test_equal_luminaires_share_a_file_and_those_that_are_gone_leave_none(self):
        for turn in (0, 45, 90):
            self.add(matrix=self.place(turn))
        self.folder.save()
        kept = sorted(p.name for p in (self.folder.path / "luminaires").iterdir())
        self.assertEqual(len(kept), 2, kept)  # the part, and the folder of its table
        SceneFolder(self.folder.path).save()
        self.assertEqual(list((self.folder.path / "luminaires").iterdir()), [])

    def test_a_body_does_not_stand_in_its_own_light(self):
        self.folder.surface("black", "sphere", "body", (0, 0, HEIGHT_M, 0.05))
        self.add(body_m=(0.1, 0.1, 0.1))
        np.testing.assert_allclose(self.candela(), PLANES_CD, rtol=0.1)

    def refused(self, *sentences, **more):
        with self.assertRaises(ValueError) as refusal:
            self.add(**more)
        for sentence in ("Lamp 1", *sentences):
            self.assertIn(sentence, str(refusal.exception))

    def test_files_that_are_none_are_refused_with_their_line(self):
        self.refused("there is no photometric file", "gone.ies", file=self.path / "gone.ies")
        self.refused("there is no photometric file", file=self.path)
        bad = self.path / "bad.ies"
        for text, sentence in (("", "bad.ies"), (LOPSIDED[:60], "bad.ies"), (LOPSIDED.replace("800", "nan"), "bad.ies:"),
                               (LOPSIDED.replace("5 5 1 2", "999999999 5 1 2"), "bad.ies:"), ("\0" * 100, "bad.ies")):
            bad.write_text(text)
            self.refused(sentence, file=bad)
        bad.write_text("\n".join(LOPSIDED.splitlines()[:-5] + ["0 0 0 0 0"] * 5))
        self.refused("0 lm, expected more than 0", file=bad)

    def test_places_and_factors_that_are_none_are_refused(self):
        self.refused("its scale is 0", matrix=self.place(scale=0))
        self.refused("its scale is 0", matrix=np.full((4, 4), np.nan))
        for factor in (0.0, -1.0, math.nan, math.inf):
            self.refused("expected more than 0", factor=factor)

    def test_an_engine_that_is_none_is_told(self):
        with self.assertRaisesRegex(EngineError, "does not read"):
            add_measured(self.folder, lambda: "/nowhere/lightwell", Measured("Lamp 1", self.file, self.place()))


if __name__ == "__main__":
    program.run()
