"""Materials, lamps, cameras and skies of hosts against closed forms and the engine."""

import math
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import program
import numpy as np
from lightwell_bridge import colour, exr, lamps, library, looks, ply, sky, views
from lightwell_bridge.scene_folder import SceneFolder


class InFolder(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.path = pathlib.Path(place.name)
        self.folder = SceneFolder(self.path)

    def text(self):
        return self.folder.save().read_text()

    def numbers(self, kind, name):
        found = re.search(rf"\w\S* {kind} {re.escape(name)}\n.*\n0\n\d+ (.*)\n", self.text())
        self.assertIsNotNone(found, f"no {kind} {name} in\n{self.text()}")
        return [float(v) for v in found[1].split()]


class Materials(InFolder):
    def test_paint_keeps_its_reflectance_and_a_coating_of_four_per_cent(self):
        looks.add_look(self.folder, looks.Look("Oak", base=(0.5, 0.5, 0.5), roughness=0.4, specular=0.5))
        np.testing.assert_allclose(self.numbers("plastic", "Oak"), [0.5, 0.5, 0.5, 0.04, 0.16])

    def test_a_pane_lets_through_what_is_stated(self):
        looks.add_look(self.folder, looks.Look("Pane", base=(1, 1, 1), transmission=1, index=1.52, transmittance=0.88))
        tau, index = self.numbers("glass", "Pane")[1], 1.52
        r = ((index - 1) / (index + 1)) ** 2
        self.assertAlmostEqual((1 - r) ** 2 * tau / (1 - r * r * tau * tau), 0.88, places=12)

    def test_more_than_a_clear_pane_lets_through_is_noted(self):
        notes = looks.add_look(self.folder, looks.Look("Pane", base=(1, 1, 1), transmission=1, index=1.52))
        self.assertRegex(notes[0], "\"Pane\": transmittance 1.000 is more than a clear pane of index 1.52")
        self.assertAlmostEqual(self.numbers("glass", "Pane")[0], 1, places=12)

    def test_an_emitter_has_the_luminance_stated_or_colour_times_strength(self):
        looks.add_look(self.folder, looks.Look("LED", emission=(1, 0.93, 0.84), strength=12, luminance=3500))
        self.assertAlmostEqual(colour.luminous(self.numbers("light", "LED")) * 179, 3500, places=6)
        looks.add_look(self.folder, looks.Look("W", emission=(1, 1, 1), strength=12))
        self.assertEqual(self.numbers("light", "W"), [12, 12, 12])

    def test_half_metal_is_a_mixture_the_engine_reads(self):
        looks.add_look(self.folder, looks.Look("Both", metallic=0.25, roughness=0.3))
        looks.add_look(self.folder, looks.Look("Three", mixed=[(0.5, looks.Look("", metallic=1.0)), (0.25, looks.Look("")),
                                                               (0.25, looks.Look("", base=(0.1, 0.1, 0.1)))]))
        for i, name in enumerate(("Both", "Three")):
            self.folder.surface(name, "sphere", f"ball{i}", (3 * i, 0, 0, 1))
        self.folder.view("v", "-vtv -vp 0 -9 0 -vd 0 1 0 -vu 0 0 1 -vh 40 -vv 40")
        self.folder.text(sky.uniform_text((1, 1, 1)), light=True)
        self.folder.save()
        self.engine("render", "--view", "v", "--size", "16x16", "--samples", "4", "-o", self.path / "v.exr")

    def test_a_picture_lies_over_the_texture_coordinates_once_in_each_unit_square(self):
        pixels = np.array([[0.1, 0.2, 0.3, 0.4], [0.5, 0.6, 0.7, 0.8]])  # twice as wide as high
        picture = self.folder.texture("tiles", exr.to_bytes({c: np.kron(pixels, np.ones((8, 8))) for c in "RGB"}), ".exr")
        looks.add_look(self.folder, looks.Look("Tiles", roughness=1, picture=picture, picture_aspect=2.0))
        self.folder.alias("Floor: Tiles", "Tiles")
        square = ply.PlyMesh.of_faces([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)], [[0, 1, 2, 3]],
                                      uv=[(0, 0), (2, 0), (2, 2), (0, 2)])
        self.folder.mesh("Floor: Tiles", "floor", self.folder.part("floor", square))
        self.folder.text(sky.uniform_text((1, 1, 1)), light=True)
        self.folder.view("v", "-vtl -vp 1 1 1 -vd 0 0 -1 -vu 0 1 0 -vh 2 -vv 2")
        self.folder.save()
        self.engine("render", "--view", "v", "--size", "16x16", "--samples", "64", "-o", self.path / "v.exr")
        seen = exr.read(self.path / "v.exr")[1]["R"]
        wanted = np.tile(np.kron(pixels, np.ones((4, 2))), (2, 2))
        inner = np.tile(np.kron(np.ones((2, 4)), [[0, 0], [1, 1], [1, 1], [0, 0]]), (2, 2)).astype(bool)
        self.assertLess(np.abs(seen - wanted)[inner].max(), 0.05)

    def test_transmission_mixture_with_an_emitter_is_said(self):
        notes = looks.add_look(self.folder, looks.Look("Lamp", mixed=[(0.5, looks.Look("", emission=(1, 1, 1), strength=2)),
                                                                      (0.5, looks.Look(""))]))
        self.assertIn("mixture with an emitter", notes[0])
        self.assertEqual(self.numbers("light", "Lamp"), [1, 1, 1])

    def engine(self, command, *more):
        return subprocess.run([os.environ["LIGHTWELL"], command, self.path / "scene.rad", *map(str, more)], check=True,
                              capture_output=True, text=True)


class Library(InFolder):
    def test_materials_of_the_library_are_those_that_the_program_lists(self):
        known = library.read_library(os.environ["LIGHTWELL"])
        self.assertGreater(len(known), 40)
        self.assertFalse(library.add_library_material(self.folder, known["grey_50"], "Wall: grey"))
        self.assertTrue(library.add_library_material(self.folder, known["led_panel_4000cd"], "LED"))
        library.add_library_material(self.folder, known["glass_single_clear"], "Pane")
        text = self.text()
        self.assertIn("void plastic Wall:%20grey\n0\n0\n5 0.5 0.5 0.5 0 0\n", text)
        self.assertAlmostEqual(colour.luminous(self.numbers("light", "LED")) * 179, 4000, places=6)
        self.assertEqual(known["glass_single_clear"].type, "glass")

    def test_an_engine_that_is_none_gives_a_sentence(self):
        for engine in ("/nowhere/lightwell", "/bin/false", "/bin/echo"):
            with self.assertRaisesRegex(ValueError, f"{engine} does not list its materials"):
                library.read_library(engine)


class Lamps(InFolder):
    """What each lamp gives on a level sensor 10 m below it, as the host measures it and from lumens."""

    DOWN = np.array([[1.0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 10], [0, 0, 0, 1]])

    def lux(self, lamp, x=0.0):
        self.folder = SceneFolder(self.path)
        amount, _ = lamps.add_lamp(self.folder, lamp)
        self.folder.material("plastic", "black", numbers=(0, 0, 0, 0, 0))
        self.folder.surface("black", "polygon", "floor", (-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0))
        self.folder.grid("g", [(x, 0, 0.001, 0, 0, 1)], 1, 1, 1.0, [0])
        self.folder.save()
        subprocess.run([os.environ["LIGHTWELL"], "illuminance", self.path / "scene.rad", "--grid", "g", "--samples", "256",
                        "-o", self.path / "g.csv"], check=True, capture_output=True)
        return float((self.path / "g.csv").read_text().split()[-1].split(",")[6]), amount

    def test_watts_are_what_the_host_makes_of_them(self):
        point = 40 / (4 * math.pi * 100) * 179
        for lamp, wanted, share in (
                (lamps.Lamp("p", "POINT", self.DOWN, watts=40, radius_m=0.05), point, 2e-3),
                (lamps.Lamp("s", "SPOT", self.DOWN, watts=40, radius_m=0.05, angle_rad=math.radians(60)), point, 2e-3),
                (lamps.Lamp("a", "AREA", self.DOWN, watts=40, size=(0.3, 0.3)), 40 / (4 * 100) * 179, 2e-3),
                (lamps.Lamp("e", "AREA", self.DOWN, watts=40, size=(0.3, 0.2), shape="ELLIPSE"), 40 / (4 * 100) * 179, 2e-3),
                (lamps.Lamp("d", "AREA", self.DOWN, watts=40, size=(0.3, 0.3), shape="DISK"), 40 / (4 * 100) * 179, 2e-3),
                (lamps.Lamp("sun", "SUN", self.DOWN, watts=3, angle_rad=0.01), 3 * 179, 2e-3)):
            with self.subTest(lamp.name):
                self.assertAlmostEqual(self.lux(lamp)[0] / wanted, 1, delta=share)

    def test_a_spot_has_the_same_intensity_all_over_its_cone_and_a_soft_edge(self):
        lamp = lamps.Lamp("s", "SPOT", self.DOWN, watts=40, radius_m=0.02, angle_rad=math.radians(80), blend=0.5)
        axis = 40 / (4 * math.pi) * 179 / 100
        edge = math.cos(math.radians(40))
        for degrees in (0, 20, 34, 38, 41):
            cosine = math.cos(math.radians(degrees))
            t = min(max((cosine - edge) / ((1 - edge) * 0.5), 0), 1)
            wanted = axis * t * t * (3 - 2 * t) * cosine ** 3
            self.assertAlmostEqual(self.lux(lamp, 10 * math.tan(math.radians(degrees)))[0], wanted, delta=4e-3 * axis)

    def test_lumens_leave_the_lamp_whatever_its_colour(self):
        for lamp, wanted in (
                (lamps.Lamp("p", "POINT", self.DOWN, lumens=1000, radius_m=0.05, kelvin=2700), 1000 / (4 * math.pi * 100)),
                (lamps.Lamp("a", "AREA", self.DOWN, lumens=1000, size=(0.3, 0.3), tint=(1, 0.5, 0.2)), 1000 / (math.pi * 100)),
                (lamps.Lamp("s", "SPOT", self.DOWN, lumens=1000, radius_m=0.05, angle_rad=math.pi / 3, blend=0.5),
                 1000 / (2 * math.pi * (1 - math.cos(math.pi / 6)) * 0.75) / 100)):
            lux, amount = self.lux(lamp)
            self.assertAlmostEqual(lux / wanted, 1, delta=2e-3)
            self.assertAlmostEqual(amount, 1000, places=6)

    def test_a_mirrored_lamp_still_shines_downwards(self):
        mirrored = self.DOWN @ np.diag([-1.0, 1, 1, 1])
        lux, _ = self.lux(lamps.Lamp("a", "AREA", mirrored, watts=40, size=(0.3, 0.3)))
        self.assertAlmostEqual(lux / (0.1 * 179), 1, delta=2e-3)

    def test_a_lamp_without_area_is_refused_by_name(self):
        with self.assertRaisesRegex(ValueError, "\"Panel\" has no area"):
            lamps.add_lamp(self.folder, lamps.Lamp("Panel", "AREA", np.eye(4), watts=1, size=(0, 1)))


class Views(unittest.TestCase):
    def value(self, words, word):
        return float(words.split(f"{word} ")[1].split()[0])

    def test_a_lens_of_20_mm_opens_as_the_host_says(self):
        words = views.view_words(views.Camera("PERSPECTIVE", np.eye(4), 640, 400, lens=20))
        self.assertAlmostEqual(math.radians(self.value(words, "-vh")), 1.46563, places=5)
        tall = views.view_words(views.Camera("PERSPECTIVE", np.eye(4), 400, 640, lens=20))
        self.assertAlmostEqual(math.radians(self.value(tall, "-vv")), 1.46563, places=5)

    def test_shifts_count_in_widths_and_heights(self):
        words = views.view_words(views.Camera("PERSPECTIVE", np.eye(4), 640, 400, shift=(0.1, 0.1)))
        self.assertAlmostEqual(self.value(words, "-vs"), 0.1)
        self.assertAlmostEqual(self.value(words, "-vl"), 0.16)

    def test_a_parallel_view_counts_metres_and_a_fisheye_fits_the_shorter_side(self):
        words = views.view_words(views.Camera("PARALLEL", np.eye(4), 640, 400, scale_m=6.5))
        self.assertEqual((self.value(words, "-vh"), self.value(words, "-vv")), (6.5, 6.5 * 400 / 640))
        words = views.view_words(views.Camera("EQUIDISTANT", np.eye(4), 640, 400))
        self.assertEqual((self.value(words, "-vh"), self.value(words, "-vv")), (288, 180))


class Sky(InFolder):
    def lux(self, *words):
        subprocess.run([os.environ["LIGHTWELL"], "illuminance", *map(str, words), "--samples", "256", "-o", self.path / "s.csv"],
                       check=True, capture_output=True)
        return [float(v) for v in (self.path / "s.csv").read_text().split()[-1].split(",")[6:8]]

    def test_a_place_and_a_time_give_the_light_of_the_command_line(self):
        place, time, north = (52.37, 4.9), "2026-06-21T14:30+02:00", 30.0
        drawing = self.path / "wall.obj"
        drawing.write_text("v -1 -1 0\nv 1 -1 0\nv 1 -1 1\nv -1 -1 1\nf 1 2 3 4\n")
        (self.path / "points").write_text("0 0 0.5 1 0 0\n")  # upright, so that the sun's azimuth counts
        theirs, error = self.lux(drawing, "--up", "z", "--sky", "clear", "--place", "%g,%g" % place, "--time", time, "--north",
                                 north, "--grid", f"file:{self.path / 'points'}")
        self.folder.material("plastic", "grey", numbers=(0.5, 0.5, 0.5, 0, 0))
        self.folder.surface("grey", "polygon", "wall", (-1, -1, 0, 1, -1, 0, 1, -1, 1, -1, -1, 1))
        sky.add_sky(self.folder, sky.Sky("clear", *place, time, north))
        ours, our_error = self.lux(self.folder.save(), "--grid", f"file:{self.path / 'points'}")
        self.assertLess(abs(ours - theirs), 5 * math.hypot(error, our_error) + 1e-3 * theirs)

    def test_a_sky_is_told_by_place_and_time(self):
        text = sky.sky_text(sky.Sky(latitude_deg=52.37, longitude_deg=4.9, time="2026-06-21T14:30+02:00"))
        self.assertIn("!gensky 6 21 14.50000 -y 2026 +s -a 52.37 -o -4.9 -m -30.0 -t 2.45 -g 0.2\n", text)

    def test_what_is_out_of_range_is_said(self):
        for words, sentence in (({"time": "noon"}, "\"noon\" is no time"), ({"latitude_deg": 91}, "latitude is 91"),
                                ({"time": "2026-02-31T12:00+01:00"}, "is no time"), ({"type": "pink"}, "\"pink\" is no sky")):
            with self.assertRaisesRegex(ValueError, sentence):
                sky.sky_text(sky.Sky(**words))


if __name__ == "__main__":
    program.run()
