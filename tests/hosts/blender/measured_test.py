"""Lamps of Blender with photometric files, measured by the engine on the floor below them."""

import csv
import math
import os
import subprocess

import numpy as np

from blender import ROOT, InBlender, run

# Candela of the file at 45 degrees from the nadir, in its planes 0, 90, 180 and 270.
PLANES_CD = (800, 300, 20, 100)
HEIGHT_M = 2.0


class Measured(InBlender):
    def setUp(self):
        self.result = self.once("inside_measured.py", ROOT / "tests/fixtures/hosts/lopsided.ies")

    def candela(self, x):
        """Towards -y, +x, +y and -x of the lamp that hangs over x."""
        points = self.path / "points.txt"
        points.write_text("".join(f"{x + dx} {dy} 0.0001 0 0 1\n" for dx, dy in ((0, -2), (2, 0), (0, 2), (-2, 0))))
        subprocess.run([os.environ["LIGHTWELL"], "illuminance", self.result["scene"], "--grid", f"file:{points}", "--samples", "64",
                        "-o", self.path / "lux.csv"], check=True, capture_output=True)
        with open(self.path / "lux.csv", newline="", encoding="utf-8") as file:
            return [float(row["illuminance_lx"]) * 2 * HEIGHT_M ** 2 * math.sqrt(2) for row in csv.DictReader(file)]

    def test_an_ies_texture_shines_with_the_candela_of_its_file_for_each_watt(self):
        """Plane 0 towards the lamp's -y: where Cycles has it."""
        np.testing.assert_allclose(self.candela(0), PLANES_CD, rtol=0.03)

    def test_a_text_block_counts_with_watts_and_strength(self):
        np.testing.assert_allclose(self.candela(30), np.multiply(PLANES_CD, 4 * 0.5), rtol=0.03)

    def test_a_file_of_the_lamp_s_settings_turns_with_the_lamp_and_needs_no_watts(self):
        np.testing.assert_allclose(self.candela(60), np.roll(PLANES_CD, 1), rtol=0.03)

    def test_lumens_count_before_those_of_the_file(self):
        self.assertAlmostEqual(self.result["lamps"]["dimmed"], 500)
        np.testing.assert_allclose(self.candela(90), np.multiply(PLANES_CD, 500 / self.result["lamps"]["outside"]), rtol=0.03)

    def test_what_is_missing_is_named_and_the_others_shine(self):
        notes = "\n".join(self.result["notes"])
        self.assertIn("lamp \"lost\": there is no photometric file", notes)
        self.assertIn("lamp \"without a text\": its IES texture names no text", notes)
        self.assertIn("lamp \"sunny\": a sun has no photometric file", notes)
        self.assertEqual(set(self.result["lamps"]), {"outside", "inside", "chosen", "dimmed", "sunny"})


if __name__ == "__main__":
    run()
