"""Means over faces, layers and grids by hand; false colours and legends against what the eye and the engine want."""

import math
import pathlib
import tempfile
import unittest

import program
import numpy as np
from lightwell_bridge import false_colour, grids, legend_font, ply, results, surface_results
from lightwell_bridge.results import FaceLight, GridLight, ObjectLight


class Means(unittest.TestCase):
    def test_means_are_weighted_by_area_and_errors_add_as_they_are(self):
        light = ObjectLight("Room/Wall", "Room", [FaceLight(3, 100, 4, 1, 0), FaceLight(1, 500, 12, 1, 0)])
        area, lux, error = light.mean()
        self.assertEqual((area, lux), (4, 200))
        self.assertEqual(error, (3 * 4 + 12) / 4)
        self.assertEqual(light.side(), "front")

    def test_the_front_counts_unless_it_is_dark_and_faces_without_a_value_do_not(self):
        light = ObjectLight("a", "L", [FaceLight(1, 0, 0, 80, 1), FaceLight(1, math.nan, math.nan, math.nan, math.nan)])
        self.assertEqual((light.side(), light.mean()), ("back", (1, 80, 1)))
        ceiling = ObjectLight("Ceiling", "L", [FaceLight(24, 171, 2, 50000, 0)])
        self.assertEqual((ceiling.side(), ceiling.mean()), ("front", (24, 171, 2)))
        self.assertIn("object,Ceiling,L,24.0,171.0,2.0,171.0,171.0,,front,50000.0\n", results.table([ceiling], []))

    def test_layers_and_grids_are_summed_up(self):
        objects = [ObjectLight("a", "L", [FaceLight(1, 100, 0, 0, 0)]), ObjectLight("b", "L", [FaceLight(3, 300, 0, 0, 0)]),
                   ObjectLight("c", "M", [FaceLight(2, 50, 0, 0, 0)])]
        self.assertEqual({k: v[:2] for k, v in results.by_layer(objects).items()}, {"L": (4, 250), "M": (2, 50)})
        grid = GridLight("desk", [100, 200, 300], [3, 4, 0])
        self.assertEqual(grid.summary(), {"mean": 200, "min": 100, "max": 300, "uniformity": 0.5, "error": 7 / 3, "points": 3})
        text = results.report(objects, [grid], ["lamp \"x\""])
        self.assertRegex(text, r"desk +200\.0 +2\.33 +100\.0 +300\.0 +0\.50")
        self.assertIn("lamp \"x\"", text)
        self.assertIn("layer,L,L,4.0,250.0,0.0,,,", results.table(objects, [grid]))

    def test_a_file_that_is_no_result_is_named(self):
        with tempfile.TemporaryDirectory() as place:
            path = pathlib.Path(place) / "g.csv"
            for text in ("", "x,y\n1,2\n", "x,y,z,nx,ny,nz,illuminance_lx,error_lx\n0,0,0,0,0,1,abc,1\n"):
                path.write_text(text)
                if not text:
                    self.assertEqual(results.read_grid_csv(path, "g").summary()["points"], 0)
                    continue
                with self.assertRaisesRegex(ValueError, "g.csv: no results of a grid"):
                    results.read_grid_csv(path, "g")


class Surfaces(unittest.TestCase):
    def read(self, text, objects):
        with tempfile.TemporaryDirectory() as place:
            path = pathlib.Path(place) / "faces.json"
            path.write_text(text)
            return surface_results.read(path, objects)

    def test_faces_come_back_under_their_object_and_number(self):
        sides = '"area_m2": %g, "front": %g, "front_error": %g, "back": %g, "back_error": 0'
        text = '{"parts": [{"object": "A/Tür", %s, "faces": [{"face": 2, %s}, {"face": 0, %s}]}, ' \
               '{"object": "cage", %s, "faces": [{"id": "x", %s}]}, {"object": "lamp", %s, "faces": []}]}' % (
                   sides % (3, 90, 1, 0), sides % (2, 120, 2, 5), sides % (1, 30, 1, 0), sides % (7, 40, 3, 9),
                   sides % (7, 40, 3, 9), sides % (1, 1, 1, 1))
        lights, notes = self.read(text, {"A/Tür": ("A", 3), "cage": ("B", 6), "gone": ("B", 1)})
        self.assertEqual([(f.area, f.front) for f in lights[0].faces[::2]], [(1, 30), (2, 120)])
        self.assertEqual(lights[0].mean(), (3, 90, 5 / 3))
        self.assertEqual((lights[1].mean(), len(lights[1].lux())), ((7, 40, 3), 6))
        self.assertEqual(lights[1].lux().tolist(), [40] * 6)
        self.assertIn("\"gone\"", notes[0])
        np.testing.assert_array_equal(surface_results.mean_of_drawings([lights[0], lights[0]]), [30, np.nan, 120])

    def test_what_is_no_result_is_said(self):
        for text in ("", "[]", '{"parts": 3}', '{"parts": [{}]}', '{"parts": [{"object": "a", "faces": [{"face": 0}]}]}'):
            with self.assertRaisesRegex(ValueError, "faces.json: no results of surfaces"):
                self.read(text, {"a": ("L", 1)})


class Colours(unittest.TestCase):
    def test_lightness_rises_evenly_from_dark_violet_to_light_yellow(self):
        linear = false_colour.linear_colours(np.linspace(0, 1, 101))
        y = linear @ (0.2126729, 0.7151522, 0.0721750)
        lightness = np.where(y > 216 / 24389, 116 * np.cbrt(y) - 16, 903.3 * y)
        np.testing.assert_allclose(lightness, np.linspace(14, 94, 101), atol=1.0)
        self.assertEqual(false_colour.linear_colours([np.nan]).tolist(), false_colour.linear_colours([0]).tolist())

    def test_scales_end_at_round_numbers(self):
        self.assertEqual(false_colour.scale_top([0, 10, 740]), 800)
        self.assertEqual(false_colour.scale_top([]), 1)
        self.assertEqual(false_colour.steps(800), [0, 200, 400, 600, 800])
        for top in (1, 1.2, 25, 300, 6000, 0.08):
            self.assertTrue(3 <= len(false_colour.steps(top)) <= 7, top)

    def test_a_legend_has_its_numbers_beside_the_colours_they_mean(self):
        picture = false_colour.legend(800)
        letters = np.isclose(picture[:, 94:, 0], 0.95)
        self.assertTrue(letters.any())
        np.testing.assert_allclose(picture[112, 40, :3], false_colour.encoded(false_colour.linear_colours([1]))[0], atol=0.02)
        self.assertFalse(legend_font.text_mask("0") is None)
        self.assertEqual(int(legend_font.text_mask("1")[:, :5].sum()), 10)


class Grids(unittest.TestCase):
    def test_sensors_lie_over_the_faces_and_nowhere_else(self):
        mesh = ply.PlyMesh.of_faces([(0, 0, 0), (6, 0, 0), (6, 3, 0), (4, 3, 0), (4, 4.5, 0), (0, 4.5, 0)], [[0, 1, 2, 3, 4, 5]])
        grid = grids.over_faces("floor", mesh, np.eye(4), 0.5, 0.8)
        self.assertEqual((grid.rows, grid.columns, len(grid.sensors)), (9, 12, 96))  # 24 m2 at 4 sensors each
        sensors = np.array(grid.sensors)
        np.testing.assert_allclose(sensors[:, 2:], np.tile([0.8, 0, 0, 1], (96, 1)))
        self.assertFalse(((sensors[:, 0] > 4) & (sensors[:, 1] > 3)).any())
        self.assertEqual(grid.cells[:12], list(range(12)))
        self.assertEqual(grid.cells.count(-1), 12)

    def test_what_cannot_be_a_grid_is_said(self):
        cube = ply.PlyMesh.of_faces([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [[0, 1, 2], [0, 1, 3]])
        flat = ply.PlyMesh.of_faces([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [[0, 1, 2]])
        line = ply.PlyMesh.of_faces([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [[0, 1, 2]])
        for mesh, spacing, sentence in ((cube, 0.5, "one plane"), (flat, 1e-5, "at most 1000000"), (line, 0.1, "no face")):
            with self.assertRaisesRegex(ValueError, sentence):
                grids.over_faces("g", mesh, np.eye(4), spacing, 0)


if __name__ == "__main__":
    program.run()
