#!/usr/bin/env python3
"""Wrong words and bad input: exit statuses and messages."""

import json
import os
import unittest

from case import BAD_INPUT, DONE, NO, USAGE, Case
from scenes import ROOM_RAD, VIEW, face_dxf


class Usage(Case):
    def test_wrong_usage_has_status_2_and_points_to_help(self):
        for words in ((), ("paint",), ("render",), ("layers",), ("render", "room.rad", "--colour", "red"),
                      ("render", "room.rad", "--view", VIEW, "-o", "a.exr", "--size", "0x10"),
                      ("render", "room.rad", "--view", VIEW, "-o", "a.exr", "--size", "wide"),
                      ("render", "room.rad", "--view", VIEW, "-o", "a.exr", "--region", "1,2,3"),
                      ("render", "room.rad", "--view", VIEW, "-o", "a.exr", "--region", "5,2,5,9"),
                      ("render", "room.rad", "--view", VIEW, "-o", "a.exr", "--region", "-1,0,5,9"),
                      ("render", "room.rad", "--view", VIEW, "-o", "a.exr", "--region", "0,0,nan,9"),
                      ("render", "room.rad", "--view", VIEW, "-o", "a.exr", "--region", "0,0,99999999999,9"),
                      ("render", "room.rad", "--view", VIEW, "-o", "a.exr", "--accuracy", "0"),
                      ("render", "room.rad", "--view", VIEW, "-o", "a.exr", "--accuracy", "nan"),
                      ("render", "room.rad", "--view", VIEW, "-o", "a.exr", "--samples", "-5"),
                      ("render", "room.rad", "--view", VIEW, "-o", "a.exr", "--sky", "pink")):
            done = self.expect(USAGE, *words)
            self.assertIn("--help", done.stderr, words)
        self.assertEqual(self.files(), ["room.rad"])

    def test_every_subcommand_explains_itself_with_an_example(self):
        overview = self.expect(DONE, "--help").stdout
        for name in ("layers", "import", "materials", "render", "illuminance", "run"):
            self.assertIn(name, overview)
            text = self.expect(DONE, name, "--help").stdout
            self.assertIn("Example", text)
            self.assertIn(f"lightwell {name}", text)

    def test_the_version_is_one_line(self):
        self.assertRegex(self.expect(DONE, "--version").stdout, r"^lightwell \d+\.\d+\.\d+\n$")

    def test_materials_are_listed_and_an_unknown_one_is_a_no(self):
        listed = json.loads(self.expect(DONE, "materials", "--json").stdout)
        self.assertGreater(len(listed), 10)
        for entry in listed:
            self.assertTrue(entry["name"] and entry["type"] and entry["source"], entry)
            self.assertTrue(all(0 <= channel <= 1 for channel in entry["reflectance"]), entry)
        self.expect(NO, "materials", "no_such_material_*", says=["no_such_material_"])


class BadInput(Case):
    RENDER = ("--view", VIEW, "-o", "out.exr", "--samples", "1", "--size", "16x16")

    def rejected(self, *words, says):
        done = self.expect(BAD_INPUT, *words, says=says)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        self.assertEqual([f for f in self.files() if f.startswith("out")], [])

    def test_a_missing_file_a_folder_and_an_unreadable_file(self):
        self.rejected("layers", "none.dxf", says=["none.dxf"])
        self.rejected("render", "none.rad", *self.RENDER, says=["none.rad"])
        (self.folder / "folder.dxf").mkdir()
        self.rejected("layers", "folder.dxf", says=["folder.dxf"])
        if os.geteuid() != 0:  # root reads everything
            self.write("closed.dxf", face_dxf(["A"]))
            os.chmod(self.folder / "closed.dxf", 0)
            self.rejected("layers", "closed.dxf", says=["closed.dxf"])

    def test_a_file_of_no_known_format(self):
        self.write("noise.bin", bytes(range(256)) * 16)
        self.rejected("layers", "noise.bin", says=["noise.bin"])

    def test_truncated_files(self):
        dxf = face_dxf(["A", "B", "C"])
        self.write("cut.dxf", dxf[:-60])
        self.rejected("layers", "cut.dxf", says=["cut.dxf"])
        self.write("cut.rad", ROOM_RAD[:-12])
        self.rejected("render", "cut.rad", *self.RENDER, says=["cut.rad"])
        self.write("cut.glb", b"glTF\x02\x00\x00\x00\x00\x10\x00\x00")
        self.rejected("layers", "cut.glb", says=["cut.glb"])

    def test_a_map_with_an_unknown_material_names_near_ones(self):
        self.write("a.dxf", face_dxf(["A"]))
        self.write("map.toml", '[[rule]]\nlayer = "A"\nuse = "gras_single"\n')
        self.rejected("layers", "a.dxf", "--map", "map.toml", says=["map.toml", "gras_single", "glass"])

    def test_a_map_rule_that_matches_nothing(self):
        self.write("a.dxf", face_dxf(["A"]))
        self.write("map.toml", 'default = "white_paint"\n[[rule]]\nlayer = "NONE-*"\nuse = "void"\n')
        self.rejected("layers", "a.dxf", "--map", "map.toml", says=["map.toml", "NONE-*"])

    def test_a_map_that_is_no_toml_or_missing(self):
        self.write("a.dxf", face_dxf(["A"]))
        self.write("map.toml", "[[rule]\n")
        self.rejected("layers", "a.dxf", "--map", "map.toml", says=["map.toml"])
        self.rejected("layers", "a.dxf", "--map", "gone.toml", says=["gone.toml"])

    def test_impossible_materials_and_numbers_that_are_none(self):
        for name, text, value in (
                ("bright.rad", ROOM_RAD.replace("0.5 0.5 0.5 0 0", "1.5 1.5 1.5 0 0"), "1.5"),
                ("nan.rad", ROOM_RAD.replace("4 3 2.5  4 0 2.5", "4 nan 2.5  4 0 2.5"), "nan.rad"),
                ("unknown.rad", ROOM_RAD + "marble polygon p 0 0 9 0 0 0 1 0 0 0 1 0\n", "marble"),
                ("dark.rad", ROOM_RAD.replace("void light lamp 0 0 3 20 20 20", "void plastic lamp 0 0 5 0 0 0 0 0"),
                 "emits")):
            self.write(name, text)
            self.rejected("render", name, *self.RENDER, says=[name, value])

    def test_views_that_show_nothing(self):
        for view in ("-vp 1 1 1 -vd 0 0 1 -vu 0 0 1", "-vp 1 1 1 -vd 0 0 0", "-vp 1 1 1 -vd 0 1 0 -vh 400",
                     "-vp nan 1 1 -vd 0 1 0", "-vp 1 1", "-vq 1", "kitchen"):
            self.rejected("render", "room.rad", "--view", view, "-o", "out.exr", says=["-v"])

    def test_grids_that_measure_nothing(self):
        for grid in ("layer:roof@0.8/0.5", "plane:0.8,0,0,4,3/0", "plane:0.8,0,0,4/0.5", "plane:0.8,0,0,4,3/nan",
                     "file:none.txt", "everywhere", "plane:0.8,0,0,1e9,1e9/0.001"):
            self.rejected("illuminance", "room.rad", "--grid", grid, "-o", "out.csv", says=[grid.removeprefix("file:")])

    def test_a_sky_needs_a_place_and_a_time_with_an_offset(self):
        self.write("a.dxf", face_dxf(["A"]))
        base = ("render", "a.dxf", *self.RENDER, "--sky", "clear")
        self.rejected(*base, says=["--place"])
        self.rejected(*base, "--place", "52.5,13.4", says=["--time"])
        self.rejected(*base, "--place", "52.5,13.4", "--time", "2026-03-21T12:00", says=["--time", "+01:00"])
        self.rejected(*base, "--place", "52.5,13.4", "--time", "2026-02-30T12:00Z", says=["--time"])
        self.rejected(*base, "--place", "-91,13.4", "--time", "2026-03-21T12:00Z", says=["--place", "-91"])

    def test_a_result_in_a_folder_that_does_not_exist(self):
        self.expect(BAD_INPUT, "render", "room.rad", "--view", VIEW, "-o", "gone/out.exr", "--size", "16x16",
                    "--samples", "1", says=["gone"])
        self.expect(BAD_INPUT, "illuminance", "room.rad", "--grid", "plane:0.8,0,0,4,3/1", "-o", "gone/out.csv",
                    "--samples", "1", says=["gone"])


if __name__ == "__main__":
    unittest.main()
