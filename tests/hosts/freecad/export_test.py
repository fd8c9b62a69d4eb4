"""A building's scene folder against what FreeCAD itself says of it (truth.json, written from its B-rep)."""

import collections
import json
import pathlib
import tempfile
import unittest

import host
import numpy as np

import FreeCAD
import Part
from scene_text import Scene

from lightwell_freecad import export, optics

# Larger of these two: areas in truth.json are rounded to 1e-5 m2.
AREA_M2, AREA_SHARE = 1e-5, 1e-6
# Curved edges and facets lie within the chord tolerance on both sides of the curve; the bounds in truth.json of round
# objects are those of OpenCascade's display mesh, up to 0.18 mm inside (the ring lamp ends at y = 4.225 m).
BOUNDS_M = export.DEFAULT_TOLERANCE_MM * 1e-3 + 0.2e-3


@unittest.skipUnless(host.BUILDING.exists(), f"no {host.BUILDING}")
class Building(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.truth = json.loads((host.BUILDING.parent / "truth.json").read_text())
        cls.document = FreeCAD.openDocument(str(host.BUILDING))
        cls.before = cls.document.Content
        cls.temporary = tempfile.TemporaryDirectory()
        cls.exported = export.export_document(cls.document, cls.temporary.name)
        cls.scene = Scene(cls.exported.scene)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()
        FreeCAD.closeDocument(cls.document.Name)

    def visible(self):
        """Label -> truth of what must be in the scene; the sensor plane becomes a grid."""
        return {label: self.truth["objects"][label] for label in self.truth["exported_objects"]
                if self.truth["objects"][label].get("props", {}).get("lw_role") != "sensor plane"}

    def surfaces(self, label):
        layer = self.truth["objects"][label]["layer"]
        return self.scene.of(f"{layer}/{label}" if layer else label)

    def test_area_of_each_object_arrives(self):
        for label, truth in self.visible().items():
            wanted = truth["area_mm2"] * 1e-6
            area = sum(s.area() for s in self.surfaces(label))
            self.assertAlmostEqual(area, wanted, delta=max(AREA_M2, AREA_SHARE * wanted), msg=label)

    def test_bounds_of_each_object_arrive(self):
        for label, truth in self.visible().items():
            boxes = [s.bounds() for s in self.surfaces(label)]
            found = [np.min([b[0] for b in boxes], axis=0), np.max([b[1] for b in boxes], axis=0)]
            difference = np.abs(np.array(found) - np.array(truth["bbox_mm"]) * 1e-3).max()
            self.assertLess(difference, BOUNDS_M, label)

    def test_area_and_bounds_of_each_layer_arrive(self):
        for name, truth in self.truth["layers"].items():
            if name == "Z-SENSOR":
                continue
            chosen = [s for s in self.scene.surfaces if (s.source or "").startswith(name + "/")]
            area = sum(s.area() for s in chosen)
            self.assertAlmostEqual(area, truth["area_m2"], delta=max(AREA_M2, AREA_SHARE * truth["area_m2"]), msg=name)
            low, high = (np.array(b) for b in truth["bbox_m"])
            self.assertLess(np.abs(np.min([s.bounds()[0] for s in chosen], axis=0) - low).max(), BOUNDS_M, name)
            self.assertLess(np.abs(np.max([s.bounds()[1] for s in chosen], axis=0) - high).max(), BOUNDS_M, name)

    def test_every_face_of_every_object_is_in_the_manifest_once(self):
        for label, truth in self.visible().items():
            if "facets" in truth:
                continue
            records = [r for r in self.exported.objects.values() if r["label"] == label]
            faces = [f["face"] for r in records for f in r["faces"]]
            self.assertEqual(len(faces), truth["face_count"], label)
            for record in records:
                self.assertEqual([f["face"] for f in record["faces"]], list(range(len(record["faces"]))), label)

    def test_whole_cylinders_cones_and_spheres_are_one_native_surface_each(self):
        native = {"Cylinder": ("cylinder", "tube"), "Cone": ("cone", "cup"), "Sphere": ("sphere", "bubble")}
        for label, truth in self.visible().items():
            kinds = collections.Counter(s.kind for s in self.surfaces(label))
            for surface, names in native.items():
                wanted = truth.get("by_surface", {}).get(surface, {}).get("faces", 0)
                # A half sphere is none of the native surfaces.
                wanted = 0 if label == "Rooflight dome" else wanted
                self.assertEqual(sum(kinds[n] for n in names), wanted, f"{label} {surface}")

    def test_a_hole_in_a_slab_is_lined_by_a_tube_that_faces_the_hole(self):
        kinds = {s.kind for s in self.surfaces("Ceiling with rooflight")}
        self.assertIn("tube", kinds)
        self.assertNotIn("cylinder", kinds)

    def test_each_plane_face_of_a_wall_with_windows_is_one_polygon(self):
        mesh, = self.surfaces("Wall South")
        self.assertEqual(len(mesh.mesh.sizes), 14)
        # Two windows in the outer face and in the inner one: 4 corners, and for each window 4 and a seam of 2.
        self.assertEqual(sorted(mesh.mesh.sizes)[-2:], [16, 16])
        wanted = sorted(f["area_mm2"] * 1e-6 for f in self.truth["objects"]["Wall South"]["faces"])
        np.testing.assert_allclose(sorted(mesh.face_areas), wanted, atol=1e-9)

    def test_normals_of_plane_faces_point_where_the_host_says(self):
        for label in ("Wall South", "Ceiling with rooflight", "Column", "Chair turned (link)", "LED panel"):
            wanted = [f["normal"] for f in self.truth["objects"][label]["faces"] if f["surface"] == "Plane"]
            found = []
            for s in self.surfaces(label):
                if s.kind == "ring":
                    found.append(s.numbers[3:6])
                elif s.kind == "mesh":
                    found += [face_normal(s, f) for f in s.mesh.faces()]
            self.assertEqual(len(found), len(wanted), label)
            for normal in wanted:
                self.assertTrue(any(np.dot(normal, n) > 0.9999 for n in found), f"{label} {normal}")
            self.assertAlmostEqual(float(np.abs(np.sum(found, axis=0) - np.sum(wanted, axis=0)).max()), 0, delta=1e-3)

    def test_round_facets_face_outwards_with_the_surfaces_own_normals(self):
        centre = np.array([2.5, 2.5, 3.25])
        dome, = [s for s in self.surfaces("Rooflight dome") if s.kind == "mesh"]
        points = dome.mesh.vertices @ dome.matrix[:3, :3].T + dome.matrix[:3, 3]
        outward = points[dome.mesh.corners] - centre
        outward /= np.linalg.norm(outward, axis=1)[:, None]
        self.assertGreater(float((outward * dome.mesh.normals).sum(axis=1).min()), 1 - 1e-6)
        for face in dome.mesh.faces():
            self.assertGreater(np.dot(face_normal(dome, face), points[face].mean(axis=0) - centre), 0)

    def test_links_and_arrays_share_one_prototype(self):
        chairs = self.surfaces("Chairs 3x2 (link array)") + self.surfaces("Chair turned (link)")
        meshes = [s for s in chairs if s.kind == "mesh"]
        self.assertEqual(len(meshes), 7)
        self.assertEqual(len({s.file for s in meshes}), 1)
        self.assertEqual(len({tuple(s.matrix.flat) for s in meshes}), 7)
        self.assertEqual(sum(s.kind == "cylinder" for s in chairs), 7)

    def test_hidden_objects_stay_out(self):
        for label in ("Demolished wall (hidden)", "Ceiling blank", "Rooflight hole", "Chair"):
            self.assertEqual(self.scene.of(label), [])
        self.assertTrue(any("Demolished wall (hidden)" in n and "hidden" in n for n in self.exported.notes))

    def test_the_most_particular_rule_names_the_layer_of_a_face(self):
        names = lambda label: {n for s in self.surfaces(label)
                               for n in (s.face_names if s.kind == "mesh" else [s.modifier])}
        self.assertEqual(names("Wall South"), {"A-WALL/Plaster white"})
        self.assertEqual(names("Partition (two layers)"), {"A-WALL/Plaster white", "A-WALL/Concrete"})
        self.assertEqual(names("Column"), {"S-COLS"})
        self.assertEqual(len(names("Six-coloured block")), 6)
        self.assertIn("colour #FF0000", names("Six-coloured block"))
        self.assertEqual({n.split(" (")[0] for n in names("Window S1")},
                         {"A-GLAZ/OuterFrame", "A-GLAZ/InnerFrame", "A-GLAZ/InnerGlass"})

    def test_colours_are_known_without_a_window(self):
        kind, _, numbers = self.scene.modifiers["colour #FFFFFF as drawn"]
        self.assertEqual(kind, "plastic")
        self.assertEqual(numbers[:3], [optics.HIGHEST_REFLECTANCE] * 3)
        kind, _, numbers = self.scene.modifiers["S-COLS as drawn"]
        # sRGB 0.5 0.52 0.55 of the column's own colour, which is lighter in blue.
        self.assertEqual(kind, "plastic")
        self.assertLess(numbers[0], numbers[2])
        self.assertAlmostEqual(0.265 * numbers[0] + 0.67 * numbers[1] + 0.065 * numbers[2], 0.231, delta=0.01)

    def test_glazing_of_two_sheets_lets_the_stated_share_pass(self):
        kind, _, numbers = self.scene.modifiers["A-GLAZ/InnerGlass (Glass panel) (two sheets) as drawn"]
        self.assertEqual(kind, "glass")
        self.assertEqual(len(numbers), 3)
        self.assertTrue(all(0 < n <= 1 for n in numbers))

    def test_lamps_give_their_lumens(self):
        for label, lumens in (("Pendant bulb", 800), ("Ring lamp", 2600), ("LED panel", 3600)):
            surfaces = self.surfaces(label)
            radiance = 0
            for s in surfaces:
                kind, _, numbers = self.scene.modifiers[s.modifier]
                self.assertEqual(kind, "light")
                radiance = 0.265 * numbers[0] + 0.67 * numbers[1] + 0.065 * numbers[2]
            flux = 179 * np.pi * radiance * sum(s.area() for s in surfaces)
            self.assertAlmostEqual(flux, lumens, delta=1e-4 * lumens)

    def test_the_sensor_plane_is_a_grid(self):
        grid = self.scene.grids["Working plane (sensors)"]
        self.assertEqual(grid["size"], ["9", "9", "0.5"])
        self.assertEqual(len(grid["sensors"]), 81)
        for sensor in grid["sensors"]:
            np.testing.assert_allclose(sensor[2:], [0.8, 0, 0, 1], atol=1e-12)
            self.assertTrue(0.2 < sensor[0] < 4.9 and 0.2 < sensor[1] < 4.8)

    def test_the_document_is_unchanged(self):
        self.assertEqual(self.document.Content, self.before)


class Nested(unittest.TestCase):
    """Containers, groups and links within links, with bounds from FreeCAD's own global placements."""

    def setUp(self):
        self.document = FreeCAD.newDocument("nested")
        self.addCleanup(FreeCAD.closeDocument, self.document.Name)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def bounds(self, label):
        surfaces = self.scene.of(label)
        self.assertTrue(surfaces, f"{label}: {sorted({s.source for s in self.scene.surfaces})}")
        return [[round(float(v), 9) for v in side] for side in (np.min([s.bounds()[0] for s in surfaces], axis=0),
                                                                np.max([s.bounds()[1] for s in surfaces], axis=0))]

    def export(self):
        self.document.recompute()
        self.exported = export.export_document(self.document, self.folder)
        self.scene = Scene(self.exported.scene)

    def part_with_box(self):
        part = self.document.addObject("App::Part", "Assembly")
        part.Placement.Base = FreeCAD.Vector(1000, 0, 0)
        group = self.document.addObject("App::DocumentObjectGroup", "Group")
        part.addObject(group)
        box = self.document.addObject("Part::Box", "Box")
        box.Length, box.Width, box.Height = 100, 200, 300
        box.Placement.Base = FreeCAD.Vector(0, 500, 0)
        group.addObject(box)
        return part, box

    def test_objects_in_parts_have_global_placements(self):
        self.part_with_box()
        self.export()
        self.assertEqual(self.bounds("Box"), [[1.0, 0.5, 0.0], [1.1, 0.7, 0.3]])

    def test_a_link_to_a_part_places_what_it_contains(self):
        part, _ = self.part_with_box()
        link = self.document.addObject("App::Link", "Copy")
        link.LinkedObject, link.Placement.Base = part, FreeCAD.Vector(0, 0, 2000)
        self.export()
        self.assertEqual(self.bounds("Copy"), [[0.0, 0.5, 2.0], [0.1, 0.7, 2.3]])
        self.assertEqual(self.bounds("Box"), [[1.0, 0.5, 0.0], [1.1, 0.7, 0.3]])

    def test_a_scaled_link_keeps_native_surfaces_and_a_stretched_one_becomes_facets(self):
        ball = self.document.addObject("Part::Sphere", "Ball")
        ball.Radius = 100
        for name, scale in (("Twice", FreeCAD.Vector(2, 2, 2)), ("Stretched", FreeCAD.Vector(1, 1, 3))):
            link = self.document.addObject("App::Link", name)
            link.LinkedObject, link.ScaleVector = ball, scale
        self.export()
        self.assertEqual([s.kind for s in self.scene.of("Twice")], ["sphere"])
        self.assertAlmostEqual(self.scene.of("Twice")[0].area(), 4 * np.pi * 0.2 ** 2, places=9)
        self.assertEqual([s.kind for s in self.scene.of("Stretched")], ["mesh"])
        # A prolate spheroid with half axes 0.1, 0.1, 0.3.
        e = np.sqrt(1 - 1 / 9)
        wanted = 2 * np.pi * 0.01 * (1 + 3 / e * np.arcsin(e))
        self.assertAlmostEqual(self.scene.of("Stretched")[0].area(), wanted, delta=0.005 * wanted)

    def test_a_chair_of_many_holes_is_one_polygon_a_face(self):
        plate = Part.makeBox(1000, 1000, 10)
        for x in range(5):
            for y in range(5):
                plate = plate.cut(Part.makeBox(100, 100, 20, FreeCAD.Vector(50 + 200 * x, 50 + 200 * y, -5)))
        feature = self.document.addObject("Part::Feature", "Grating")
        feature.Shape = plate
        self.export()
        mesh, = self.scene.of("Grating")
        self.assertEqual(len(mesh.mesh.sizes), len(plate.Faces))
        self.assertEqual(max(mesh.mesh.sizes), 4 + 25 * 6)
        self.assertAlmostEqual(mesh.area(), plate.Area * 1e-6, places=9)


def face_normal(surface, face):
    points = surface.mesh.vertices[face] @ surface.matrix[:3, :3].T + surface.matrix[:3, 3]
    rays = points - points[0]
    normal = np.cross(rays[1:-1], rays[2:]).sum(axis=0)
    return normal / np.linalg.norm(normal)


host.run(Building, Nested)
