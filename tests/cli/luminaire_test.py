#!/usr/bin/env python3
"""The subcommand `luminaire`, and measured luminaires in a layer map."""

import json
import math
import pathlib
import struct
import unittest

from case import BAD_INPUT, DONE, Case
from scenes import face_dxf


def ies(candela, size):
    """A luminaire of one plane with an intensity every 5 degrees down to the horizontal."""
    values = " ".join(f"{candela(math.radians(a)):.6g}" for a in range(0, 91, 5))
    angles = " ".join(str(a) for a in range(0, 91, 5))
    return f"IESNA:LM-63-2002\n[LUMINAIRE] test lamp\nTILT=NONE\n1 -1 1 19 1 1 2 {size}\n1 1 40\n{angles}\n0\n{values}\n"


class Luminaire(Case):
    def setUp(self):
        super().setUp()
        self.write("panel.ies", ies(lambda a: 1000 * math.cos(a), "0.3 1.2 0"))

    def test_a_luminaire_becomes_scene_text_that_shines_as_the_file(self):
        """What a floor gets straight below it, four metres away, tells its candela."""
        self.expect(DONE, "luminaire", "panel.ies", "--scene", "panel.rad", "--share", "0.5", "--body", "0.1,0.1,0.02")
        self.write("room.rad", "void plastic black 0 0 5 0 0 0 0 0\nblack polygon floor 0 0 12 -1 -1 0 1 -1 0 1 1 0 -1 1 0\n"
                   "void instance lamp 14 panel.rad -affine 1 0 0 0 0 1 0 0 0 0 1 4 0 0\n")
        self.expect(DONE, "illuminance", "room.rad", "--grid", "plane:0.001,-0.1,-0.1,0.1,0.1/0.2", "-o", "a.csv")
        lux = float((pathlib.Path(self.folder) / "a.csv").read_text().splitlines()[1].split(",")[6])
        candela = json.loads(self.expect(DONE, "luminaire", "panel.ies", "--json").stdout)["greatest_candela"]
        self.assertAlmostEqual(lux * 4 ** 2 / (0.5 * candela), 1, delta=0.05)
        self.expect(BAD_INPUT, "luminaire", "panel.ies", "--scene", "b.rad", "--body", "1,-1,0", says=("--body",))
        self.expect(BAD_INPUT, "luminaire", "panel.ies", "--scene", "b.rad", "--colour", "1,nan,0", says=("--colour",))
        self.expect(BAD_INPUT, "luminaire", "panel.ies", "--scene", "no folder/b.rad", says=("no folder",))

    def test_numbers_and_picture(self):
        done = self.expect(DONE, "luminaire", "panel.ies", "-o", "panel.png", "--json", "--aim", "0.3,0,-1", "--turn", "30")
        found = json.loads(done.stdout)
        self.assertAlmostEqual(found["lumens"], 1000 * math.pi, delta=5)
        self.assertAlmostEqual(found["beam_angle_deg"][0], 120, delta=0.5)
        self.assertEqual(found["opening_m"], [1.2, 0.3, 0])
        picture = (self.folder / "panel.png").read_bytes()
        self.assertEqual(struct.unpack(">II", picture[16:24]), (960, 560))
        self.assertIn("lm/W", self.expect(DONE, "luminaire", "panel.ies").stdout)

    def test_damage_is_named(self):
        self.write("cut.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 19 1 1 2\n")
        self.expect(BAD_INPUT, "luminaire", "cut.ies", says=("cut.ies:4",))
        self.write("text.ldt", "a table of figures")
        self.expect(BAD_INPUT, "luminaire", "text.ldt", says=("text.ldt",))
        self.expect(BAD_INPUT, "luminaire", "panel.ies", "--aim", "0,0,0", says=("--aim",))

    def test_a_rule_of_the_map_places_it(self):
        self.write("lamp.dxf", face_dxf(["E-LITE"]))
        self.write("map.toml", 'default = "white_paint"\n[[rule]]\nlayer = "E-LITE"\nluminaire = "panel.ies"\n')
        done = self.expect(DONE, "import", "lamp.dxf", "--map", "map.toml", "-o", "lamp.rad")
        self.assertIn("luminaire of panel.ies, 3", done.stdout + done.stderr)
        self.assertIn("brightdata", (self.folder / "lamp.rad").read_text())


if __name__ == "__main__":
    unittest.main()
