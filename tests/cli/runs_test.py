#!/usr/bin/env python3
"""Projects, interrupted runs and plans."""

import csv
import json
import math
import signal
import subprocess
import time
import unittest

from case import BAD_INPUT, DONE, EXR_MAGIC, NO, PROGRAM, USAGE, Case
from scenes import VIEW


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


if __name__ == "__main__":
    unittest.main()
