"""The text of a scene folder, its files, and what is refused; colours against the engine's own numbers."""

import math
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import program
import numpy as np
from lightwell_bridge import colour, names, ply
from lightwell_bridge.scene_folder import SceneFolder, number, surface_text, transform_words


def triangle(z=0.0):
    return ply.PlyMesh.of_faces([(0, 0, z), (1, 0, z), (0, 1, z)], [[0, 1, 2]])


class Names(unittest.TestCase):
    def test_every_name_is_one_word_and_comes_back(self):
        for name in ("Wall paint (white) 0.75", "Stoff blau – Größe M", "a/b\\c", "50%", "#1", "\"q\"", "!ls", "void",
                     "inherit", "日本", "tab\there", "Bürostuhl 01"):
            word = names.encoded(name)
            self.assertEqual(len(word.split()), 1, name)
            self.assertFalse(word.startswith(("#", "!", "\"", "'")), name)
            self.assertEqual(names.decoded(word), name)
        self.assertNotIn(names.encoded("void"), ("void",))
        self.assertEqual(names.encoded("a b"), "a%20b")

    def test_two_things_of_one_name_are_told_apart(self):
        unique = names.UniqueNames()
        self.assertEqual([unique.of(key, "Oak") for key in (1, 2, 1)], ["Oak", "Oak (2)", "Oak"])


class Text(unittest.TestCase):
    def test_numbers_read_back_as_the_same_double(self):
        for value in (0.1, 1 / 3, 1e-300, -2.5, 6.02e23, 4.0):
            self.assertEqual(float(number(value)), value)
        self.assertEqual(number(4.0), "4")

    def test_a_transform_is_twelve_numbers_row_by_row(self):
        matrix = np.arange(16, dtype=float).reshape(4, 4)
        self.assertEqual(transform_words(matrix), ["-affine"] + [str(i) for i in range(12)])
        self.assertEqual(transform_words(np.eye(4)), [])

    def test_a_surface_is_the_text_of_the_language(self):
        self.assertEqual(surface_text("Wall 1", "sphere", "ball", (1, 2, 3, 0.5)),
                         "Wall%201 sphere ball\n0\n0\n4 1 2 3 0.5\n")
        with self.assertRaisesRegex(ValueError, "3 numbers, expected 4"):
            surface_text("m", "sphere", "ball", (1, 2, 3))
        with self.assertRaisesRegex(ValueError, "not finite"):
            surface_text("m", "sphere", "ball", (1, 2, 3, math.inf))


class Folder(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory(prefix="light well ü ")
        self.path = pathlib.Path(self.place.name)
        self.addCleanup(self.place.cleanup)

    def folder(self, z=0.0):
        folder = SceneFolder(self.path)
        folder.material("plastic", "Oak", numbers=(0.4, 0.3, 0.2, 0, 0))
        folder.alias("Furniture: Oak", "Oak")
        for x in (0.0, 5.0):
            folder.mesh("Furniture: Oak", f"Desk {x:g}", folder.part("Desk ü", triangle(z)),
                        [[1, 0, 0, x], [0, 1, 0, 0], [0, 0, 1, 0]], source=f"Furniture/Desk {x:g}")
        folder.view("main", "-vtv -vp 0 0 1")
        folder.grid("plane", [(0, 0, 0.8, 0, 0, 1)], 1, 1, 0.25, [0])
        return folder

    def test_a_scene_is_written_in_the_order_in_which_it_is_read(self):
        text = self.folder().save().read_text()
        self.assertIn("void plastic Oak\n0\n0\n5 0.4 0.3 0.2 0 0\ninherit alias Furniture:%20Oak Oak\n", text)
        self.assertIn("#@from Furniture/Desk%205\nFurniture:%20Oak mesh Desk%205\n14 parts/Desk", text)
        self.assertIn(" -affine 1 0 0 5 0 1 0 0 0 0 1 0\n0\n0\n", text)
        self.assertIn("#@grid plane 1 1 0.25\n#@grid-sensor 0 0 0.8 0 0 1\n#@grid-cells 0\n", text)
        self.assertLess(text.index("alias"), text.index("mesh"))

    def test_two_objects_of_one_mesh_share_a_file_and_unchanged_files_are_left_alone(self):
        self.folder().save()
        files = list((self.path / "parts").iterdir())
        self.assertEqual(len(files), 1)
        self.assertTrue(files[0].name.isascii() and " " not in files[0].name)
        before = files[0].stat().st_mtime_ns, files[0].stat().st_ino
        self.folder().save()
        self.assertEqual((files[0].stat().st_mtime_ns, files[0].stat().st_ino), before)
        self.folder(z=1.0).save()
        self.assertEqual(len(list((self.path / "parts").iterdir())), 1)
        self.assertFalse(files[0].exists())

    def test_one_name_cannot_mean_two_materials(self):
        folder = self.folder()
        folder.material("plastic", "Oak", numbers=(0.4, 0.3, 0.2, 0, 0))
        with self.assertRaisesRegex(ValueError, "\"Oak\" stands for two"):
            folder.material("plastic", "Oak", numbers=(0.5, 0.3, 0.2, 0, 0))


class Colour(unittest.TestCase):
    def test_grey_stays_grey_and_colours_go_where_the_engine_puts_them(self):
        self.assertEqual(colour.from_rec709((0.3, 0.3, 0.3)), (0.3, 0.3, 0.3))
        # What `lightwell import` writes for a material of an .obj file, whose colours are linear Rec.709.
        for rgb in ((0.8, 0.1, 0.2), (0.1, 0.6, 0.3), (0.06, 0.12, 0.35)):
            np.testing.assert_allclose(colour.from_rec709(rgb), self.as_the_program_reads(rgb), rtol=1e-12)

    def as_the_program_reads(self, rgb):
        with tempfile.TemporaryDirectory() as place:
            path = pathlib.Path(place)
            (path / "m.mtl").write_text("newmtl paint\nKd %r %r %r\n" % rgb)
            (path / "m.obj").write_text("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\nf 1 2 3\n")
            subprocess.run([os.environ["LIGHTWELL"], "import", path / "m.obj", "-o", path / "m.rad"], check=True,
                           capture_output=True)
            text = (path / "m.rad").read_text()
            return [float(v) for v in re.search(r"plastic paint.material\n0\n0\n5 (\S+) (\S+) (\S+)", text).groups()]

    def test_a_hue_of_given_luminance_has_it(self):
        self.assertAlmostEqual(colour.luminous(colour.of_luminance((1, 0.85, 0.7), 12.5)), 12.5, delta=1e-3)

    def test_low_temperatures_are_red_and_daylight_is_white(self):
        warm, white = colour.blackbody_hue(2700), colour.blackbody_hue(6500)
        self.assertEqual(warm[0], 1)
        self.assertLess(warm[2], 0.4)
        self.assertGreater(min(white), 0.9)


if __name__ == "__main__":
    program.run()
