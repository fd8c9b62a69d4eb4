#!/usr/bin/env python3
"""Pictures of surfaces; the engine against closed forms."""

import json
import math
import unittest

from case import BAD_INPUT, DONE, EXR_MAGIC, NO, USAGE, Case


class Bake(Case):
    def test_a_closed_sphere_has_the_illuminance_of_the_geometric_series(self):
        """A lamp of radius r in the middle of a sphere of radius R: E = pi L f / (1 - rho (1 - f)), f = (r / R)^2."""
        self.write("s.rad", "void plastic wall 0 0 5 0.5 0.5 0.5 0 0\nvoid light lamp 0 0 3 100 100 100\n"
                   "wall bubble shell 0 0 4 0 0 0 1\nlamp sphere bulb 0 0 4 0 0 0 0.1\n")
        self.expect(DONE, "bake", "s.rad", "--surface", "wall", "--side", "front", "--spacing", "0.3", "--accuracy", "1%",
                    "-o", "maps")
        maps = json.loads((self.folder / "maps" / "maps.json").read_text())
        expected = 179 * math.pi * 100 * 0.01 / (1 - 0.5 * 0.99)
        self.assertLess(abs(maps["layers"]["wall"]["front"]["mean_lx"] / expected - 1), 0.01)
        self.assertAlmostEqual(maps["layers"]["wall"]["area_m2"], 4 * math.pi, places=6)
        self.assertNotIn("back", maps["layers"]["wall"])

    def test_every_surface_has_a_picture_that_the_table_names(self):
        done = self.expect(DONE, "bake", "room.rad", "--all", "--spacing", "0.5", "--samples", "16", "-o", "maps")
        maps = json.loads((self.folder / "maps" / "maps.json").read_text())
        self.assertEqual(len(maps["surfaces"]), 7)
        floor = next(s for s in maps["surfaces"] if s["surface"] == "floor")
        self.assertEqual((floor["layer"], floor["columns"], floor["rows"], floor["kind"]), ("wall", 8, 6, "plane"))
        self.assertAlmostEqual(floor["area_m2"], 12)
        self.assertEqual(floor["back"]["maximum_lx"], 0, "no light from under the floor")
        self.assertGreater(floor["front"]["minimum_lx"], 0)
        for surface in maps["surfaces"]:
            self.assertEqual((self.folder / "maps" / surface["file"]).read_bytes()[:4], EXR_MAGIC)
        self.assertEqual([line.split("\t")[0] for line in done.stdout.splitlines()], ["layer", "lamp", "wall"])

    def test_what_cannot_be_baked_is_refused(self):
        self.expect(BAD_INPUT, "bake", "room.rad", "-o", "maps", says=["--all"])
        self.expect(BAD_INPUT, "bake", "room.rad", "--all", "--surface", "wall", "-o", "maps", says=["--all"])
        self.expect(BAD_INPUT, "bake", "room.rad", "--surface", "roof", "-o", "maps", says=["roof"])
        self.expect(BAD_INPUT, "bake", "room.rad", "--all", "--spacing", "1e-6", "-o", "maps", says=["spacing"])
        self.expect(BAD_INPUT, "bake", "room.rad", "--all", "-o", "room.rad/maps", says=["room.rad/maps"])
        self.expect(USAGE, "bake", "room.rad", "--all", "--spacing", "0", "-o", "maps")
        self.assertEqual(self.files(), ["room.rad"])


class Validate(Case):
    def test_values_agree_with_closed_forms_and_a_deliberate_error_does_not(self):
        result = json.loads(self.expect(DONE, "validate", "--case", "cl_sun_disc", "--json").stdout)
        self.assertTrue(result["passed"])
        rows = {(row["case"], row["quantity"]): row for row in result["rows"]}
        expected = math.pi * 1.6e9 * math.sin(math.radians(0.2665)) ** 2
        row = rows["cl_sun_disc_0.2665_60", "normal"]
        self.assertAlmostEqual(row["expected"] / expected, 1, 12)
        self.assertAlmostEqual(row["found"] / expected, 1, 3)
        wrong = json.loads(self.expect(NO, "validate", "--case", "cl_sun_disc", "--json", "--perturb", "direct").stdout)
        self.assertEqual([row["passed"] for row in wrong["rows"]], [False] * len(rows))

    def test_words_that_mean_nothing_are_refused(self):
        self.expect(BAD_INPUT, "validate", "--perturb", "mirrors", says=["use direct, specular, ambient (or interreflection), sky or glass"])
        self.expect(BAD_INPUT, "validate", "--case", "cl_sun_dics", says=["is in the name of no case", "cl_sun_disc_0.2665"])
        self.expect(USAGE, "validate", "--quick", "--full")


if __name__ == "__main__":
    unittest.main()
