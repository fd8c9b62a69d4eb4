#!/usr/bin/env python3
"""Pictures and maps: their files, regions, threads and seeds."""

import csv
import json
import math
import unittest

from case import BAD_INPUT, DONE, EXR_MAGIC, Case
from exr_file import windows_and_pixels
from scenes import VIEW


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
