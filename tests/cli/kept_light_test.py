#!/usr/bin/env python3
"""Ambient light kept in a file: second views, stale files, several writers, kills."""

import csv
import json
import signal
import subprocess
import time
import unittest

from case import BAD_INPUT, DONE, PROGRAM, USAGE, Case
from scenes import ROOM_RAD, VIEW

OTHER_VIEW = "-vtv -vp 0.8 0.4 1.4 -vd 0.6 0.7 -0.2 -vu 0 0 1 -vh 60 -vv 45"  # sees much of what VIEW sees
SIZE = ("--size", "96x72", "--samples", "8", "--accuracy", "10%")
FILE = ("--ambient-file", "room.amb")


class KeptCase(Case):
    def render(self, name, view, *more, status=DONE, says=()):
        self.expect(status, "render", "room.rad", "--view", view, "-o", name, *SIZE, *more, says=says)
        return json.loads((self.folder / name).with_suffix(".run.json").read_text()) if status == DONE else None

    def bytes_of(self, name):
        return (self.folder / name).read_bytes()


class KeptLight(KeptCase):
    def test_the_same_view_again_takes_everything_from_the_file_to_the_same_values(self):
        first = self.render("a.exr", VIEW, *FILE)
        size = (self.folder / "room.amb").stat().st_size
        second = self.render("b.exr", VIEW, *FILE)
        self.assertEqual(first["built"]["records_from_file"], 0)
        self.assertEqual(second["built"]["records_from_file"], second["built"]["ambient_records"])
        self.assertEqual(second["built"]["sites_from_file"], second["built"]["deep_sites"])
        self.assertEqual((self.folder / "room.amb").stat().st_size, size)
        self.assertEqual(self.bytes_of("a.exr"), self.bytes_of("b.exr"))

    def test_a_fresh_file_changes_nothing(self):
        with_file, without = self.render("a.exr", VIEW, *FILE), self.render("b.exr", VIEW)
        for name in ("median_relative_error", "bias", "samples"):
            self.assertEqual(with_file[name], without[name])

    def test_another_view_takes_what_fits_and_adds_what_is_missing(self):
        first = self.render("a.exr", VIEW, *FILE)["built"]
        second = self.render("b.exr", OTHER_VIEW, *FILE)["built"]
        alone = self.render("c.exr", OTHER_VIEW)["built"]
        self.assertEqual(second["sites_from_file"], first["deep_sites"])
        self.assertEqual(second["records_from_file"], first["ambient_records"])
        self.assertLess(second["ambient_records"] - second["records_from_file"], 0.7 * alone["ambient_records"])

    def test_light_of_another_scene_or_other_settings_is_refused_with_what_changed(self):
        self.render("a.exr", VIEW, *FILE)
        size = (self.folder / "room.amb").stat().st_size
        for text, what in ((ROOM_RAD.replace("wall 0 0 5 0.5 0.5", "wall 0 0 5 0.6 0.5"), 'material "wall" changed'),
                           (ROOM_RAD.replace("2.5 1 2.45", "2.6 1 2.45"), "geometry changed")):
            self.write("room.rad", text)
            self.render("b.exr", VIEW, *FILE, status=BAD_INPUT,
                        says=["room.amb", "another scene or other settings", what, "delete the file"])
        self.write("room.rad", ROOM_RAD)
        for more, what in ((("--accuracy", "20%"), "ambient accuracy was 0.1, is 0.2"), (("--seed", "2"), "seed was 1, is 2"),
                           (("--without", "gradients"), "techniques switched off was none, is gradients")):
            self.expect(BAD_INPUT, "render", "room.rad", "--view", VIEW, "-o", "b.exr", "--size", "32x24", "--samples", "8",
                        *(() if more[0] == "--accuracy" else ("--accuracy", "10%")), *more, *FILE, says=["room.amb", what])
        self.assertEqual((self.folder / "room.amb").stat().st_size, size)
        self.assertNotIn("b.exr", self.files())

    def test_what_is_no_cache_and_what_is_damaged_is_told(self):
        self.write("room.amb", "not a cache, but a letter\n")
        self.render("a.exr", VIEW, *FILE, status=BAD_INPUT, says=["room.amb", "is not a cache of light"])
        self.assertEqual(self.bytes_of("room.amb"), b"not a cache, but a letter\n")
        (self.folder / "room.amb").unlink()
        self.render("a.exr", VIEW, *FILE)
        damaged = bytearray(self.bytes_of("room.amb"))
        damaged[-100] ^= 1
        self.write("room.amb", bytes(damaged))
        record = self.render("b.exr", VIEW, *FILE, says=["a block whose checksum differs was left out"])
        self.assertLess(record["built"]["records_from_file"], record["built"]["ambient_records"])
        self.assertIn("checksum", " ".join(note["text"] for note in record["notes"]))

    def test_words_that_keep_nothing_are_wrong_usage(self):
        for more in (("--unbiased",), ("--without", "ambient"), ("--within", "5s")):
            self.expect(USAGE, "render", "room.rad", "--view", VIEW, "-o", "a.exr", *more, *FILE, says=["--ambient-file"])

    def test_a_project_shares_one_file_among_maps_and_pictures(self):
        self.write("project.toml", f"""
[inputs]
files = ["room.rad"]
[[view]]
name = "one"
text = "{VIEW}"
size = [64, 48]
[[view]]
name = "two"
text = "{OTHER_VIEW}"
size = [64, 48]
[[grid]]
name = "desk"
on = "plane:0.8,0.5,0.5,3.5,2.5"
spacing = 0.5
[wish]
quality = "draft"
[output]
png = false
""")
        self.expect(DONE, "run", "project.toml", "-o", ".", *FILE)
        for name in ("one", "two"):
            built = json.loads((self.folder / f"{name}.run.json").read_text())["built"]
            self.assertEqual(built["sites_from_file"], built["deep_sites"], name)


class KeptWriters(KeptCase):
    WORDS = ("illuminance", "room.rad", "--grid", "plane:0.8,0.05,0.05,3.95,2.95/0.06", "--samples", "16", "--accuracy",
             "10%", "--threads", "1")

    def start(self, number):
        return subprocess.Popen([PROGRAM, *self.WORDS, "-o", f"{number}.csv", *FILE], cwd=self.folder,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def mean_and_error(self, name):
        with open(self.folder / name) as file:
            rows = list(csv.DictReader(file))
        record = json.loads((self.folder / name).with_suffix(".run.json").read_text())
        mean = sum(float(row["illuminance_lx"]) for row in rows) / len(rows)
        error = sum(float(row["error_lx"]) for row in rows) / len(rows)  # errors of neighbours go together
        return mean, error + abs(record["bias"]["mean"]) * mean

    def test_of_eight_writers_three_are_killed_and_the_file_stays_sound(self):
        running = [self.start(number) for number in range(8)]
        for killed in running[:3]:  # at different moments: a little after the file has grown
            before = self.grown()
            deadline = time.monotonic() + 30
            while self.grown() == before and time.monotonic() < deadline and killed.poll() is None:
                time.sleep(0.005)
            killed.kill()
        for number, process in enumerate(running):
            message = process.communicate(timeout=300)[1]
            if number >= 3:
                self.assertEqual(process.returncode, DONE, message)
            else:
                self.assertIn(process.returncode, (-signal.SIGKILL, DONE))
        self.expect(DONE, *self.WORDS, "-o", "alone.csv")
        expected, spread = self.mean_and_error("alone.csv")
        for number in range(3, 8):
            mean, error = self.mean_and_error(f"{number}.csv")
            self.assertLess(abs(mean - expected), 3 * (error + spread), number)
        again = self.expect(DONE, *self.WORDS, "-o", "again.csv", *FILE)
        self.assertNotIn("checksum", again.stderr)
        built = json.loads((self.folder / "again.run.json").read_text())["built"]
        self.assertGreater(built["records_from_file"], 0)
        self.assertEqual(built["records_from_file"], built["ambient_records"])

    def grown(self):
        file = self.folder / "room.amb"
        return file.stat().st_size if file.exists() else 0

    def test_an_interrupted_picture_goes_on_with_kept_light_to_the_same_bytes(self):
        words = [PROGRAM, "render", "room.rad", "--view", VIEW, "-o", "p.exr", "--size", "128x96", "--samples", "64", *FILE]
        running = subprocess.Popen(words, cwd=self.folder, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        partial, deadline = self.folder / "p.partial.exr", time.monotonic() + 60
        while time.monotonic() < deadline and running.poll() is None:
            if partial.exists() and partial.stat().st_size > 120_000:
                break
            time.sleep(0.02)
        running.kill()
        running.wait()
        self.assertNotIn("p.exr", self.files())
        self.expect(DONE, *words[1:], says=["going on after"])
        resumed = self.bytes_of("p.exr")
        for name in ("p.exr", "room.amb"):
            (self.folder / name).unlink()
        self.expect(DONE, *words[1:])
        self.assertEqual(resumed, self.bytes_of("p.exr"))


if __name__ == "__main__":
    unittest.main()
