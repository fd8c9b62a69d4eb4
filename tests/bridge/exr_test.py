"""Pictures: what is written comes back; the engine's own pictures; damaged files give a sentence."""

import os
import pathlib
import subprocess
import tempfile
import unittest

import program
import numpy as np
from lightwell_bridge import exr


class Exr(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.path = pathlib.Path(place.name)

    def test_channels_and_values_come_back(self):
        rng = np.random.default_rng(2)
        wanted = {f"ViewLayer.Combined.{c}": rng.normal(size=(5, 7)).astype(np.float32) * 1e4 for c in "RGBA"}
        file = self.path / "a.exr"
        file.write_bytes(exr.to_bytes(wanted, [("unit", "cd/m2")]))
        header, picture = exr.read(file)
        self.assertEqual((header.size, header.text("unit")), ((7, 5), "cd/m2"))
        for name, values in wanted.items():
            np.testing.assert_array_equal(picture[name], values)
        self.assertIsNone(exr.check_for_layer(file, "ViewLayer", (7, 5)))
        self.assertIn("no channel Other.Combined.R", exr.check_for_layer(file, "Other", (7, 5)))
        self.assertIn("7 x 5 pixels, expected 5 x 7", exr.check_for_layer(file, "ViewLayer", (5, 7)))

    def test_a_picture_of_the_engine_shows_the_radiance_of_the_glow_it_looks_at(self):
        scene = self.path / "glow.rad"
        scene.write_text("void glow g\n0\n0\n4 1 2 3 0\ng source all\n0\n0\n4 0 0 1 360\n"
                         "#@view v -vtv -vp 0 0 0 -vd 0 1 0 -vu 0 0 1 -vh 40 -vv 40\n")
        subprocess.run([os.environ["LIGHTWELL"], "render", scene, "--view", "v", "--size", "40x40", "--samples", "4", "-o",
                        self.path / "g.exr"], check=True, capture_output=True)
        header, picture = exr.read(self.path / "g.exr")
        self.assertEqual(header.size, (40, 40))
        for channel, value in (("R", 1), ("G", 2), ("B", 3)):
            np.testing.assert_allclose(picture[channel], value, rtol=1e-6)

    def test_reading_ends_where_its_check_says_so(self):
        file = self.path / "large.exr"
        file.write_bytes(exr.to_bytes({name: np.ones((300, 400)) for name in "RGBA"}))
        calls = []

        def check():
            calls.append(None)
            if len(calls) == 100:
                raise KeyboardInterrupt
        with self.assertRaises(KeyboardInterrupt):
            exr.read(file, check=check)
        calls.clear()
        exr.read(file, check=lambda: calls.append(None))
        self.assertGreater(len(calls), 300)  # every line of the picture

    def test_damaged_files_give_a_sentence(self):
        whole = exr.to_bytes({"R": np.ones((4, 4))})
        file = self.path / "bad.exr"
        for data in (b"", b"not a picture at all", whole[:40], whole[:-10], whole.replace(b"\x03\0\0\0\x03\0\0\0", b"\xff" * 8)):
            file.write_bytes(data)
            with self.assertRaisesRegex(ValueError, "bad.exr: no readable OpenEXR picture"):
                exr.read(file)
        with self.assertRaises(OSError):
            exr.read(self.path / "absent.exr")


if __name__ == "__main__":
    program.run()
