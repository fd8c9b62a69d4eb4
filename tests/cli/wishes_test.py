#!/usr/bin/env python3
"""Wishes: a time, a quality, techniques left out."""

import json
import subprocess
import time
import unittest

from case import BAD_INPUT, DONE, PROGRAM, USAGE, Case
from scenes import VIEW

GRID = "plane:0.8,0,0,4,3/0.5"


class Wishes(Case):
    def map(self, name, *words):
        self.expect(DONE, "illuminance", "room.rad", "--grid", GRID, "-o", name, "--threads", "1", *words)
        return json.loads((self.folder / name).with_suffix(".run.json").read_text())

    def test_a_time_is_kept_and_its_work_can_be_repeated_to_the_same_bits(self):
        for word, seconds in (("--within", 1), ("--time", 2)):
            record = self.map("a.csv", word, f"{seconds}s")
            self.assertEqual(record["wanted_time_s"], seconds)
            self.assertLess(record["cpu_seconds"], 2 * seconds)
            self.assertGreater(record["cpu_seconds"], seconds / 10)  # the deep field may turn out cheaper than predicted
            self.map("b.csv", *record["replay"].split())
            self.assertEqual((self.folder / "a.csv").read_bytes(), (self.folder / "b.csv").read_bytes())

    def test_more_time_gives_a_smaller_error(self):
        short, long = self.map("a.csv", "--within", "0.5s"), self.map("b.csv", "--within", "4s")
        self.assertLess(long["median_relative_error"], 0.7 * short["median_relative_error"])

    def test_a_quality_is_a_name_for_an_accuracy(self):
        wanted = {name: self.map("a.csv", "--quality", name)["wanted_accuracy"] for name in ("draft", "normal", "fine")}
        self.assertEqual(wanted, {"draft": 0.08, "normal": 0.02, "fine": 0.005})
        by_name = (self.folder / "a.csv").read_bytes()
        self.map("b.csv", "--accuracy", "0.5%")
        self.assertEqual(by_name, (self.folder / "b.csv").read_bytes())

    def test_interval_and_bias_are_stated_apart(self):
        self.expect(DONE, "illuminance", "room.rad", "--grid", GRID, "-o", "a.csv")
        done = self.run_program("illuminance", "room.rad", "--grid", GRID, "-o", "a.csv")
        self.assertRegex(done.stdout, r"standard error of a point [\d.e-]+ %, .*bias [+-][\d.e+-]+ \+- [\d.e+-]+ %")
        record = json.loads((self.folder / "a.run.json").read_text())
        self.assertGreater(record["bias"]["points"], 0)
        self.assertGreater(record["bias"]["standard_error"], 0)
        self.assertNotIn("bias", self.map("b.csv", "--unbiased", "--samples", "64"))

    def test_one_wish_at_a_time(self):
        for words in (("--accuracy", "5%", "--quality", "fine"), ("--within", "5s", "--accuracy", "5%"),
                      ("--within", "5s", "--quality", "draft"), ("--time", "5s", "--samples", "16"), ("--quality", "best"),
                      ("--within", "0s"), ("--within", "soon"), ("--within", "-3s"), ("--within", "nan")):
            self.expect(USAGE, "illuminance", "room.rad", "--grid", GRID, "-o", "a.csv", *words)
        self.assertEqual(self.files(), ["room.rad"])

    def test_the_time_of_the_sky_is_still_a_moment(self):
        done = self.expect(DONE, "illuminance", "room.rad", "--grid", GRID, "-o", "a.csv", "--sky", "clear", "--place",
                           "52.5,13.4", "--time", "2026-03-21T12:00+01:00", "--time", "1s")
        self.assertIn("sun at altitude", done.stderr)
        self.assertEqual(json.loads((self.folder / "a.run.json").read_text())["wanted_time_s"], 1)

    def test_a_killed_picture_in_a_time_goes_on_with_the_work_that_was_chosen(self):
        words = ("render", "room.rad", "--view", VIEW, "-o", "p.exr", "--size", "192x144", "--threads", "1")
        running = subprocess.Popen([PROGRAM, *words, "--within", "8s"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        partial, deadline = self.folder / "p.partial.exr", time.monotonic() + 60
        while time.monotonic() < deadline and running.poll() is None:
            if partial.exists() and partial.stat().st_size > 120_000:  # more than two tiles
                break
            time.sleep(0.02)
        running.kill()
        running.wait()
        self.assertIn("going on after", self.expect(DONE, *words, "--within", "8s").stderr)
        resumed = (self.folder / "p.exr").read_bytes()
        replay = json.loads((self.folder / "p.run.json").read_text())["replay"].split()
        self.expect(DONE, *words, *replay)
        self.assertEqual(resumed, (self.folder / "p.exr").read_bytes())


class Without(Case):
    NAMES = ("ambient", "cache", "gradients", "hessian", "image", "adaptive", "subdivision", "virtual", "secondary",
             "tree", "analytic")

    def test_each_technique_has_a_name_and_an_unknown_one_is_refused_with_the_list(self):
        for name in self.NAMES:
            self.expect(DONE, "illuminance", "room.rad", "--grid", "plane:0.8,1,1,3,2/1", "-o", "a.csv", "--samples", "8",
                        "--without", name)
        self.expect(BAD_INPUT, "illuminance", "room.rad", "--grid", GRID, "-o", "b.csv", "--without", "gradients,luck",
                    says=['"luck" is no technique', *self.NAMES])

    def test_without_ambient_is_plain_path_tracing(self):
        words = ("illuminance", "room.rad", "--grid", GRID, "--samples", "64")
        self.expect(DONE, *words, "-o", "a.csv", "--without", "ambient")
        self.expect(DONE, *words, "-o", "b.csv", "--unbiased")
        self.assertEqual((self.folder / "a.csv").read_bytes(), (self.folder / "b.csv").read_bytes())

    def test_the_settings_of_a_picture_name_what_was_left_out(self):
        self.expect(DONE, "render", "room.rad", "--view", VIEW, "-o", "a.exr", "--size", "32x24", "--samples", "8",
                    "--without", "cache,tree")
        record = json.loads((self.folder / "a.run.json").read_text())
        self.assertIn("without cache,tree", record["settings"]["settings"])
        self.assertEqual(record["built"]["ambient_records"], 0)

    def test_secondary_sources_are_chosen_by_name_and_what_is_none_is_refused(self):
        words = ("illuminance", "room.rad", "--grid", GRID, "-o", "a.csv", "--samples", "8", "--secondary")
        self.expect(DONE, *words, "auto")
        self.assertEqual(json.loads((self.folder / "a.run.json").read_text())["built"]["secondary_sources"], 0)
        self.expect(BAD_INPUT, *words, "nowhere", says=['"nowhere"', "no modifier of the scene"])


if __name__ == "__main__":
    unittest.main()
