#!/usr/bin/env python3
"""Calls the program `lightwell` (its path in the environment variable LIGHTWELL) as a user would."""

import csv
import json
import math
import os
import pathlib
import signal
import subprocess
import tempfile
import time
import unittest

from exr_file import windows_and_pixels
from scenes import OBJ, ROOM_RAD, VIEW, face_dxf

PROGRAM = os.environ.get("LIGHTWELL", "build/release/lightwell")
DONE, NO, USAGE, BAD_INPUT = 0, 1, 2, 3
EXR_MAGIC = b"\x76\x2f\x31\x01"


class Case(unittest.TestCase):
    """Runs in a folder of its own with room.rad in it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.write("room.rad", ROOM_RAD)

    def write(self, name, text):
        mode = "wb" if isinstance(text, bytes) else "w"
        with open(self.folder / name, mode) as file:
            file.write(text)

    def run_program(self, *words, timeout=120):
        return subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, timeout=timeout,
                              errors="replace", stdin=subprocess.DEVNULL)

    def expect(self, status, *words, says=()):
        """The status, and each part of `says` in one line of the message on stderr."""
        done = self.run_program(*words)
        self.assertEqual(done.returncode, status, f"{words}\n{done.stdout}{done.stderr}")
        for part in says:
            self.assertIn(part, done.stderr)
        return done

    def files(self):
        return sorted(p.name for p in self.folder.iterdir())


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
                ("bright.rad", ROOM_RAD.replace("0.5 0.5 0.5 0 0", "1.5 0.5 0.5 0 0"), "1.5"),
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


class Outputs(Case):
    def test_the_csv_agrees_with_the_closed_form_of_a_disc(self):
        """E = pi L sin^2 on the axis of a uniform disc: L = 179 * 20 cd/m2, radius 0.5 m, 2 m above the point."""
        self.write("disc.rad", "void light l 0 0 3 20 20 20\nl ring d 0 0 8 0 0 2 0 0 -1 0 0.5\n")
        self.write("point.txt", "0 0 0 0 0 1\n")
        self.expect(DONE, "illuminance", "disc.rad", "--grid", "file:point.txt", "-o", "e.csv", "--samples", "4096")
        with open(self.folder / "e.csv") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(rows[0]), ["x", "y", "z", "nx", "ny", "nz", "illuminance_lx", "error_lx", "bias_lx"])
        expected = math.pi * 179 * 20 * 0.25 / 4.25
        self.assertLess(abs(float(rows[0]["illuminance_lx"]) - expected), 5 * float(rows[0]["error_lx"]) + 1e-6 * expected)
        self.assertLess(float(rows[0]["error_lx"]), 0.02 * expected)

    def test_a_map_is_written_in_all_formats_with_its_record(self):
        self.expect(DONE, "illuminance", "room.rad", "--grid", "plane:0.8,0,0,4,3/1", "-o", "e.csv", "-o", "e.png", "-o",
                    "e.exr", "--samples", "16")
        self.assertEqual(self.files(), ["e.csv", "e.exr", "e.png", "e.run.json", "room.rad"])
        self.assertEqual((self.folder / "e.exr").read_bytes()[:4], EXR_MAGIC)
        self.assertEqual((self.folder / "e.png").read_bytes()[:4], b"\x89PNG")
        self.assertEqual((self.folder / "e.csv").read_text().count("\n"), 13)
        record = json.loads((self.folder / "e.run.json").read_text())
        self.assertEqual(record["samples"], 16)
        self.assertIn("lightwell illuminance room.rad --grid", record["command"])

    def test_a_picture_is_written_with_its_companions_and_provenance(self):
        self.expect(DONE, "render", "room.rad", "--view", VIEW, "-o", "p.exr", "--png", "--hdr", "--samples", "4",
                    "--size", "64x64")
        self.assertEqual(self.files(), ["p.exr", "p.hdr", "p.png", "p.run.json", "room.rad"])
        header = (self.folder / "p.exr").read_bytes()[:4096]
        for entry in (b"VIEW", b"settings", b"software", b"seed", b"units"):
            self.assertIn(entry, header)
        self.assertTrue((self.folder / "p.hdr").read_bytes().startswith(b"#?"))

    def test_pixels_stay_square(self):
        self.expect(DONE, "render", "room.rad", "--view", "-vp 2 1 1 -vd 0 1 0 -vh 90 -vv 90", "-o", "p.exr",
                    "--samples", "1", "--size", "64x32")
        record = json.loads((self.folder / "p.run.json").read_text())
        self.assertIn("size 32x32", record["settings"]["settings"])

    def test_the_wanted_accuracy_is_reached(self):
        self.expect(DONE, "illuminance", "room.rad", "--grid", "plane:0.8,0,0,4,3/0.5", "-o", "e.csv", "--accuracy", "2%")
        record = json.loads((self.folder / "e.run.json").read_text())
        self.assertLess(record["median_relative_error"], 0.02 * 1.5)  # an error found from few replicates is itself uncertain


class Region(Case):
    WORDS = ("render", "room.rad", "--view", VIEW.replace("-vv 45", "-vv 60"), "--samples", "8", "--size", "72x72")

    def render(self, name, *more):
        self.expect(DONE, *self.WORDS, "-o", name, *more)
        return windows_and_pixels((self.folder / name).read_bytes())

    def test_a_region_is_a_window_of_the_whole_with_the_same_bits(self):
        for more in ((), ("--unbiased",)):
            data, display, whole = self.render("whole.exr", *more)
            self.assertEqual((data, display), ((0, 0, 71, 71), (0, 0, 71, 71)))
            data, display, part = self.render("part.exr", "--region", "40,10,72,41", *more)
            self.assertEqual((data, display), ((40, 10, 71, 40), (0, 0, 71, 71)))
            self.assertEqual(sorted(part), sorted(whole))
            self.assertEqual("bias.Y" in part, not more)
            part.pop("bias.Y", None)  # told by checks within the region
            for channel, pixels in part.items():
                self.assertEqual(len(pixels), 32 * 31)
                self.assertEqual(pixels, {place: whole[channel][place] for place in pixels}, channel)

    def test_the_radiance_picture_of_a_region_has_the_view_of_the_region(self):
        self.render("part.exr", "--region", "0,36,36,72", "--hdr")
        header = (self.folder / "part.hdr").read_bytes().split(b"\n\n")[0].decode()
        view = header.split("VIEW=")[1].split("\n")[0].split()
        quarter = math.degrees(2 * math.atan(math.tan(math.radians(30)) / 2))
        self.assertAlmostEqual(float(view[view.index("-vh") + 1]), quarter, 9)
        self.assertAlmostEqual(float(view[view.index("-vs") + 1]), -0.5, 9)
        self.assertAlmostEqual(float(view[view.index("-vl") + 1]), -0.5, 9)

    def test_a_region_that_is_not_in_the_picture_is_refused_before_work_begins(self):
        self.expect(BAD_INPUT, *self.WORDS, "-o", "part.exr", "--region", "40,10,73,41",
                    says=["region 40,10,73,41", "72 x 72"])
        self.assertEqual(self.files(), ["room.rad"])


class Project(Case):
    TEXT = """
[inputs]
files = ["room.rad"]
[[view]]
name = "corner"
text = "%s"
size = [64, 48]
[[grid]]
name = "floor"
on = "plane:0.8,0,0,4,3"
spacing = 1
[wish]
samples = 8
[output]
folder = "results"
""" % VIEW

    def test_all_views_and_grids_are_made_and_a_line_printed_for_each(self):
        self.write("project.toml", self.TEXT)
        done = self.expect(DONE, "run", "project.toml")
        self.assertEqual(len(done.stdout.splitlines()), 2, done.stdout)
        made = sorted(p.name for p in (self.folder / "results").iterdir())
        self.assertEqual(made, ["corner.exr", "corner.png", "corner.run.json", "floor.csv", "floor.exr", "floor.png",
                                "floor.run.json"])

    def test_only_and_output_choose_what_is_made_and_where(self):
        self.write("project.toml", self.TEXT)
        self.expect(DONE, "run", "project.toml", "--only", "floor", "-o", "elsewhere")
        made = sorted(p.name for p in (self.folder / "elsewhere").iterdir())
        self.assertEqual(made, ["floor.csv", "floor.exr", "floor.png", "floor.run.json"])
        self.expect(BAD_INPUT, "run", "project.toml", "--only", "attic", says=["project.toml", "nothing to make"])

    def test_two_scenes_add_their_light(self):
        """Two equal discs, each of E = pi L sin^2 at the point between them."""
        for name in ("a", "b"):
            self.write(f"{name}.rad", f"void light l 0 0 3 20 20 20\nl ring {name} 0 0 8 0 0 2 0 0 -1 0 0.5\n")
        self.write("b.rad", "void light l 0 0 3 20 20 20\nl ring b 0 0 8 0 0 -2 0 0 1 0 0.5\n")
        self.write("points.txt", "0 0 0 0 0 1\n0 0 0 0 0 -1\n")
        self.write("project.toml", '[inputs]\nfiles = ["a.rad", "b.rad"]\n[[grid]]\nname = "e"\n'
                   'on = "file:points.txt"\n[wish]\nsamples = 1024\n[output]\nfolder = "."\n')
        self.expect(DONE, "run", "project.toml")
        with open(self.folder / "e.csv") as file:
            values = [float(row["illuminance_lx"]) for row in csv.DictReader(file)]
        for value in values:
            self.assertAlmostEqual(value / (math.pi * 179 * 20 * 0.25 / 4.25), 1, delta=0.02)

    def test_faults_of_a_project_are_named_with_their_line(self):
        self.write("project.toml", self.TEXT.replace("spacing", "spacign"))
        self.expect(BAD_INPUT, "run", "project.toml", says=["project.toml:11", "spacign"])
        self.write("project.toml", self.TEXT.replace('"floor"', '"corner"'))
        self.expect(BAD_INPUT, "run", "project.toml", says=["two results", "corner"])
        self.expect(BAD_INPUT, "run", "gone.toml", says=["gone.toml"])


class Interruption(Case):
    WORDS = ("render", "room.rad", "--view", VIEW, "-o", "p.exr", "--samples", "64", "--size", "128x96", "--seed", "7")

    def interrupt(self, signal_number, wait_s, *more):
        """Sends the signal once tiles have been written."""
        running = subprocess.Popen([PROGRAM, *self.WORDS, *more], cwd=self.folder, stderr=subprocess.PIPE, text=True)
        partial, deadline = self.folder / "p.partial.exr", time.monotonic() + wait_s
        while time.monotonic() < deadline and running.poll() is None:
            if partial.exists() and partial.stat().st_size > 120_000:  # more than two tiles of 32 x 32 x 13 floats, packed
                break
            time.sleep(0.02)
        running.send_signal(signal_number)
        try:
            return running, running.communicate(timeout=60)[1]
        finally:
            running.kill()

    def test_ctrl_c_leaves_a_partial_picture_that_goes_on_to_the_same_bytes(self):
        running, message = self.interrupt(signal.SIGINT, 60)
        self.assertEqual(running.returncode, NO, message)
        self.assertIn("p.partial.exr", message)
        self.assertIn("run the same command again", message)
        self.assertEqual(self.files(), ["p.partial.exr", "room.rad"])
        self.assertEqual((self.folder / "p.partial.exr").read_bytes()[:4], EXR_MAGIC)
        done = self.expect(DONE, *self.WORDS)
        self.assertIn("going on after", done.stderr)
        self.assertEqual(self.files(), ["p.exr", "p.run.json", "room.rad"])
        resumed = (self.folder / "p.exr").read_bytes()
        (self.folder / "p.exr").unlink()
        self.expect(DONE, *self.WORDS)
        self.assertEqual(resumed, (self.folder / "p.exr").read_bytes())

    def test_a_killed_run_leaves_no_final_name_and_goes_on_to_the_same_bytes(self):
        for more in ((), ("--region", "11,5,120,90"), ("--region", "11,5,120,90", "--unbiased")):
            running, _ = self.interrupt(signal.SIGKILL, 60, *more)
            self.assertEqual(running.returncode, -signal.SIGKILL)
            self.assertNotIn("p.exr", self.files())
            done = self.expect(DONE, *self.WORDS, *more)
            self.assertIn("going on after", done.stderr)
            resumed = (self.folder / "p.exr").read_bytes()
            (self.folder / "p.exr").unlink()
            self.expect(DONE, *self.WORDS, *more)
            self.assertEqual(resumed, (self.folder / "p.exr").read_bytes())
            (self.folder / "p.exr").unlink()

    def test_a_partial_region_is_not_continued_as_another_one(self):
        self.interrupt(signal.SIGKILL, 60, "--region", "11,5,120,90")
        done = self.run_program(*self.WORDS, "--region", "12,5,120,90")
        self.assertNotIn("going on after", done.stderr)
        self.assertEqual(done.returncode, DONE, done.stderr)

    def test_a_partial_picture_of_other_settings_is_not_continued(self):
        self.interrupt(signal.SIGINT, 60)
        words = [word if word != "7" else "8" for word in self.WORDS]
        done = self.run_program(*words)
        self.assertNotIn("going on after", done.stderr)
        self.assertEqual(done.returncode, DONE, done.stderr)


class Plan(Case):
    def test_a_plain_room_needs_lamps_and_interreflection_alone(self):
        plan = json.loads(self.expect(DONE, "plan", "room.rad", "--json").stdout)
        self.assertEqual([s["stage"] for s in plan["stages"] if s["on"]], ["lamps", "interreflection"])
        self.assertEqual(plan["needs"]["surfaces"], 7)
        self.assertAlmostEqual(plan["needs"]["lamp_flux_lm"], math.pi * 179 * 20, places=6)
        self.assertNotIn("expected", plan)
        text = self.expect(DONE, "plan", "room.rad", "--explain").stdout
        self.assertIn("virtual sources: no flat mirror", text)
        self.assertNotIn("virtual sources", self.expect(DONE, "plan", "room.rad").stdout)

    def test_the_prediction_stands_beside_what_was_reached(self):
        self.expect(DONE, "illuminance", "room.rad", "--grid", "plane:0.8,0,0,4,3/0.25", "-o", "e.csv", "--accuracy", "2%",
                    "--plan", says=["expected, grid plane:0.8,0,0,4,3/0.25, 192 sensors"])
        record = json.loads((self.folder / "e.run.json").read_text())
        for value in ("cpu_seconds", "median_relative_error"):
            self.assertGreater(record["predicted"][value], 0.25 * record[value])
            self.assertLess(record["predicted"][value], 4 * record[value])

    def test_more_time_buys_more_accuracy(self):
        def offer(seconds):
            done = self.expect(DONE, "plan", "room.rad", "--view", VIEW, "--size", "64x64", "--within", seconds, "--json")
            return json.loads(done.stdout)["within_time"]["accuracy"]
        self.assertLess(offer("100"), offer("1"))

    def test_words_that_mean_nothing_are_refused(self):
        self.expect(USAGE, "plan")
        self.expect(USAGE, "plan", "room.rad", "--view", VIEW, "--grid", "plane:0.8,0,0,4,3/1")
        self.expect(USAGE, "plan", "room.rad", "--within", "-1")
        self.expect(BAD_INPUT, "plan", "none.rad", says=["none.rad"])
        self.expect(BAD_INPUT, "plan", "room.rad", "--grid", "roof:1", says=["roof:1"])


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


class Threads(Case):
    def test_one_two_and_four_threads_give_the_same_bytes(self):
        pictures, maps = set(), set()
        for threads in ("1", "2", "4"):
            self.expect(DONE, "render", "room.rad", "--view", VIEW, "-o", "p.exr", "--samples", "8", "--size", "96x72",
                        "--threads", threads)
            pictures.add((self.folder / "p.exr").read_bytes())
            self.expect(DONE, "illuminance", "room.rad", "--grid", "plane:0.8,0,0,4,3/0.5", "-o", "e.csv", "--samples",
                        "64", "--threads", threads)
            maps.add((self.folder / "e.csv").read_bytes())
        self.assertEqual((len(pictures), len(maps)), (1, 1))

    def test_another_seed_gives_other_noise(self):
        maps = set()
        for seed in ("1", "2"):
            self.expect(DONE, "illuminance", "room.rad", "--grid", "plane:0.8,0,0,4,3/1", "-o", "e.csv", "--samples", "16",
                        "--seed", seed)
            maps.add((self.folder / "e.csv").read_bytes())
        self.assertEqual(len(maps), 2)


if __name__ == "__main__":
    unittest.main()
