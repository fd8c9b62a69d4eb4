"""Meshes to bytes and back, and what is refused."""

import math
import unittest

import program
import numpy as np
from lightwell_bridge import ply


def l_shape():
    """An L of six corners (area 24) and a triangle (area 0.5) standing on it."""
    vertices = [(0, 0, 0), (6, 0, 0), (6, 3, 0), (4, 3, 0), (4, 4.5, 0), (0, 4.5, 0), (0, 0, 1)]
    return vertices, [[0, 1, 2, 3, 4, 5], [0, 1, 6]]


class Ply(unittest.TestCase):
    def test_polygons_keep_all_their_corners_and_coordinates_to_the_last_bit(self):
        rng = np.random.default_rng(1)
        sizes = rng.integers(3, 300, 50)
        vertices = rng.normal(size=(500, 3)) * 10.0 ** rng.integers(-6, 7, (500, 1))
        corners = rng.integers(0, 500, sizes.sum())
        mesh = ply.PlyMesh(vertices, sizes, corners, modifiers=["Wände: Größe M", "x y"],
                           face_modifiers=rng.integers(0, 2, 50), uv=rng.normal(size=(sizes.sum(), 2)),
                           normals=rng.normal(size=(sizes.sum(), 3)))
        again = ply.from_bytes(ply.to_bytes(mesh))
        for field in ("vertices", "sizes", "corners", "face_modifiers", "uv", "normals"):
            np.testing.assert_array_equal(getattr(again, field), getattr(mesh, field), field)
        self.assertEqual(again.modifiers, ["Wände: Größe M", "x y"])

    def test_a_cage_keeps_its_creases(self):
        vertices, faces = l_shape()
        mesh = ply.PlyMesh.of_faces(vertices, faces, edges=[(0, 1), (1, 2)], edge_sharpness=[2.5, 10],
                                    points=[6], point_sharpness=[3], boundary="smooth")
        again = ply.from_bytes(ply.to_bytes(mesh))
        self.assertEqual(again.edges.tolist(), [[0, 1], [1, 2]])
        self.assertEqual(again.edge_sharpness.tolist(), [2.5, 10])
        self.assertEqual((again.points.tolist(), again.point_sharpness.tolist()), ([6], [3]))
        self.assertEqual(again.boundary, "smooth")

    def test_areas_of_concave_polygons_are_those_of_geometry(self):
        vertices, faces = l_shape()
        mesh = ply.PlyMesh.of_faces(vertices, faces)
        np.testing.assert_allclose(mesh.areas(), [24, 3], rtol=1e-15)
        mirrored = np.diag([-2.0, 2.0, 2.0, 1.0])
        np.testing.assert_allclose(mesh.areas(mirrored), [96, 12], rtol=1e-15)

    def test_the_bytes_are_those_that_the_format_prescribes(self):
        mesh = ply.PlyMesh.of_faces([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [[0, 1, 2]], modifiers=["A"], face_modifiers=[0])
        header, body = ply.to_bytes(mesh).split(b"end_header\n")
        self.assertIn(b"comment modifier 0 A\n", header)
        self.assertIn(b"property list uint uint vertex_indices\nproperty ushort modifier\n", header)
        self.assertEqual(len(body), 9 * 8 + 4 + 3 * 4 + 2)
        self.assertEqual(body[72:], bytes([3, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 0, 0]))

    def test_two_hundred_thousand_quads_take_seconds_not_minutes(self):
        import time
        start = time.process_time()
        columns, rows = 1001, 201
        at = np.arange(rows * columns).reshape(rows, columns)
        corners = np.stack([at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]], axis=-1).reshape(-1)
        data = ply.to_bytes(ply.PlyMesh(np.zeros((rows * columns, 3)), np.full(200_000, 4), corners))
        self.assertEqual(len(data.split(b"end_header\n", 1)[1]), rows * columns * 24 + 200_000 * 20)
        self.assertLess(time.process_time() - start, 4)

    def test_what_is_wrong_is_refused_with_its_numbers(self):
        triangle = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
        for sentence, arguments in (("names vertex 3 of 3", (triangle, [3], [0, 1, 3])),
                                    ("2 corners, expected at least 3", (triangle, [2], [0, 1])),
                                    ("want 4 corners, there are 3", (triangle, [4], [0, 1, 2])),
                                    ("no finite number", ([(math.nan, 0, 0)] * 3, [3], [0, 1, 2]))):
            with self.assertRaisesRegex(ValueError, sentence):
                ply.PlyMesh(*arguments)
        whole = ply.to_bytes(ply.PlyMesh(triangle, [3], [0, 1, 2]))
        for cut in (3, 60, len(whole) - 5):
            with self.assertRaises(ValueError):
                ply.from_bytes(whole[:cut])


if __name__ == "__main__":
    program.run()
