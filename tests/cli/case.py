"""Calls the program `lightwell` (its path in the environment variable LIGHTWELL) as a user would."""

import os
import pathlib
import subprocess
import tempfile
import unittest

from scenes import ROOM_RAD

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
