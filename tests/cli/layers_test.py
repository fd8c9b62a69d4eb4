#!/usr/bin/env python3
"""Layers of drawings, what they are made of, and the scene they become."""

import csv
import json
import unittest

from case import BAD_INPUT, DONE, NO, Case
from scenes import OBJ, face_dxf


class Layers(Case):
    def test_json_lists_layers_with_areas_and_the_balance_of_entities(self):
        self.write("a.dxf", face_dxf(["A-FLOR", "A-GLAZ"]))
        found = json.loads(self.expect(DONE, "layers", "a.dxf", "--json").stdout)
        self.assertEqual(list(found), ["file", "unit", "bounds_m", "layers", "entities"])
        self.assertEqual([layer["name"] for layer in found["layers"]], ["A-FLOR", "A-GLAZ"])
        for layer in found["layers"]:
            self.assertEqual(list(layer), ["name", "surfaces", "area_m2", "material"])
            self.assertEqual(layer["surfaces"], 1)
            self.assertAlmostEqual(layer["area_m2"], 1.0, places=12)
        self.assertEqual((found["entities"]["read"], found["entities"]["made"]), (2, 2))
        self.assertEqual(found["bounds_m"], [[0, 0, 0], [3, 1, 0]])

    def test_unit_and_up_override_what_the_file_says(self):
        self.write("a.obj", OBJ)
        found = json.loads(self.expect(DONE, "layers", "a.obj", "--json", "--unit", "mm", "--up", "z").stdout)
        self.assertEqual(found["bounds_m"], [[0, 0, 0], [2, 1, 0.5]])
        self.assertAlmostEqual(sum(layer["area_m2"] for layer in found["layers"]), 3.0, places=9)
        self.expect(BAD_INPUT, "layers", "a.obj", "--unit", "furlongish", says=["furlongish", "mm"])

    def test_the_proposed_map_can_be_used_at_once(self):
        self.write("a.dxf", face_dxf(["A-FLOR", "A-WALL", "A-GLAZ"]))
        self.expect(DONE, "layers", "a.dxf", "--propose", "map.toml")
        found = json.loads(self.expect(DONE, "layers", "a.dxf", "--map", "map.toml", "--strict", "--json").stdout)
        self.assertTrue(all(layer["material"] for layer in found["layers"]), found)

    def test_strict_is_a_no_when_a_layer_has_no_material(self):
        self.write("a.dxf", face_dxf(["A-FLOR", "XQZ17"]))
        self.write("map.toml", '[[rule]]\nlayer = "A-FLOR"\nuse = "white_paint"\n')
        self.expect(DONE, "layers", "a.dxf", "--map", "map.toml", says=["XQZ17"])
        noted = self.expect(DONE, "layers", "a.dxf", "--map", "map.toml", "--json", says=["XQZ17", "grey_50"])
        materials = {layer["name"]: layer["material"] for layer in json.loads(noted.stdout)["layers"]}
        self.assertEqual(materials, {"A-FLOR": "white_paint", "XQZ17": "grey_50"})
        self.expect(NO, "layers", "a.dxf", "--map", "map.toml", "--strict", says=["XQZ17"])

    def test_import_writes_a_scene_that_can_be_lit(self):
        self.write("a.dxf", face_dxf(["A-FLOR"]))
        self.write("map.toml", 'default = "white_paint"\n')
        self.expect(DONE, "import", "a.dxf", "--map", "map.toml", "--sky", "uniform", "--place", "52.5,13.4", "--time",
                    "2026-03-21T12:00+01:00", "-o", "a.rad", "--flat")
        self.expect(DONE, "illuminance", "a.rad", "--grid", "plane:1,0,0,1,1/0.5", "-o", "a.csv", "--samples", "64")
        with open(self.folder / "a.csv") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 4)


if __name__ == "__main__":
    unittest.main()
