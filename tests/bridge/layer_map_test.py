"""Proposals by name, and layer maps as JSON."""

import os
import unittest

import program
from lightwell_bridge import layer_map


class LayerMap(unittest.TestCase):
    def test_the_engine_proposes_by_name_whatever_characters_it_has(self):
        layers = ["Architecture/Glazing", "Architecture/Floor and ceiling", "Wände [innen] #1", "Möbel/Xyzzy 17"]
        found = layer_map.propose(os.environ["LIGHTWELL"], layers)
        self.assertEqual(found["Architecture/Glazing"], "glass_double_clear")
        self.assertNotIn("Möbel/Xyzzy 17", {k for k, v in found.items() if v == "glass_double_clear"})
        self.assertEqual(layer_map.propose(os.environ["LIGHTWELL"], []), {})

    def test_no_engine_is_a_sentence(self):
        with self.assertRaisesRegex(ValueError, "/nowhere proposes no materials"):
            layer_map.propose("/nowhere", ["a"])

    def test_a_map_comes_back_and_anything_else_is_refused(self):
        rules = {"collections": {"A/B": "grey_50"}, "materials": {}, "objects": {"Tür": "oak"}}
        self.assertEqual(layer_map.from_json(layer_map.to_json(rules)), rules)
        for text in ("", "[]", '{"layers": {}}', '{"objects": {"a": 1}}', '{"objects": []}'):
            with self.assertRaisesRegex(ValueError, "no layer map"):
                layer_map.from_json(text)


if __name__ == "__main__":
    program.run()
