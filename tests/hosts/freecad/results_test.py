"""Results on the objects of a document, and the document as it was once they are taken away."""

import pathlib
import shutil
import tempfile
import unittest

import host

host.show_main_window()

import FreeCAD
import numpy as np

from lightwell_bridge import false_colour
from lightwell_bridge.results import FaceLight, GridLight, ObjectLight
from lightwell_freecad import contours, export, project, results

# Each object and what it looks like: colours by face, on links, on meshes, of a glazed window.
SHOWN = ("Wall South", "Window S1", "Six-coloured block", "Column", "Chairs 3x2 (link array)", "Chair turned (link)",
         "Bowl (mesh)", "Rooflight dome")


def appearance(document):
    """What a user sees of every object: colours by face or element, visibility, and the list of objects."""
    seen = {}
    for obj in document.Objects:
        view = obj.ViewObject
        seen[obj.Name] = (obj.Label, bool(obj.Visibility), tuple(map(tuple, getattr(view, "DiffuseColor", None) or ())),
                          tuple(sorted((k, tuple(v)) for k, v in view.getElementColors().items())) if hasattr(view, "getElementColors") else (),
                          bool(getattr(view, "Coloring", False)), "FaceColors" in obj.PropertiesList)
    return seen


@unittest.skipUnless(host.BUILDING.exists(), f"no {host.BUILDING}")
class Shown(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # One document for all tests, left open: FreeCAD 0.20 can crash when documents with a window are closed and others
        # are opened.
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.original = FreeCAD.openDocument(str(shutil.copy(host.BUILDING, cls.folder / "building.FCStd")))
        project.make(cls.original)
        cls.exported = export.export_document(cls.original, cls.folder / "scene")
        cls.before = appearance(cls.original)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def setUp(self):
        self.document, self.project = self.original, project.find(self.original)
        self.addCleanup(self.taken_away)

    def taken_away(self):
        results.clear(project.find(self.original))
        self.assertEqual(appearance(self.original), self.before)

    def light(self):
        """Face i of an object has 100 i lx, beginning again after 20; a sensor at x has 100 x."""
        objects = []
        for path, record in self.exported.objects.items():
            count = record["faces"][0]["count"] if record["faces"][0]["kind"] == "mesh" else len(record["faces"])
            objects.append(ObjectLight(path, record["layer"] or "", [FaceLight(1.0, 100.0 * (i % 20), 1.0, 0.0, 0.0) for i in range(count)]))
        grids = []
        for name, facts in self.exported.grids.items():
            lux = [100 * s[0] for s in facts["sensors"]]
            grids.append(GridLight(name, lux, [1.0] * len(lux), facts["rows"], facts["columns"], facts["cells"]))
        return objects, grids

    def show(self):
        objects, grids = self.light()
        group = results.show(self.project, self.exported, objects, grids, self.folder, ["a note"])
        return group, results.scale_top(objects, grids, self.exported)

    def object(self, label):
        return self.document.getObjectsByLabel(label)[0]

    def test_every_face_of_the_same_object_has_the_colour_of_its_illuminance(self):
        _, top = self.show()
        wall = self.object("Wall South").ViewObject.DiffuseColor
        self.assertEqual(len(wall), 14)
        for i, colour in enumerate(wall):
            wanted = false_colour.encoded(false_colour.linear_colours([100.0 * i / top]))[0]
            np.testing.assert_allclose(colour[:3], wanted, atol=1 / 255)
        chair = self.object("Chair turned (link)").ViewObject.getElementColors()
        self.assertEqual(len(chair), 15)
        array = self.object("Chairs 3x2 (link array)").ViewObject.getElementColors()
        self.assertEqual(len(array), 90)
        self.assertEqual(array["5.Face15"][:3], chair["Face15"][:3])
        bowl = self.object("Bowl (mesh)")
        self.assertEqual((len(bowl.FaceColors), bowl.ViewObject.Coloring), (480, True))

    def test_glass_stays_transparent(self):
        self.show()
        window = self.object("Window S1").ViewObject.DiffuseColor
        self.assertEqual([round(c[3], 2) for c in window], [0.0] * 20 + [0.85] * 6)
        self.assertEqual(len({c[:3] for c in window}), 20)

    def test_the_scale_is_that_of_most_of_the_area(self):
        lights = [ObjectLight("wall", "", [FaceLight(99.0, 400.0, 1, 0, 0)]), ObjectLight("lamp", "", [FaceLight(1.0, 90000.0, 1, 0, 0)])]
        self.assertEqual(results.scale_top(lights, [], self.exported), 400)
        self.assertEqual(results.scale_top([], [], self.exported), 1)

    def test_the_grid_is_points_a_surface_and_lines(self):
        group, _ = self.show()
        points, = [o for o in group.Group if o.TypeId == "Points::Feature"]
        self.assertEqual(len(points.Points.Points), 81)
        np.testing.assert_allclose(points.Illuminance, [0.1 * p.x for p in points.Points.Points], rtol=1e-5)
        surface, = [o for o in group.Group if o.TypeId == "Mesh::Feature"]
        self.assertAlmostEqual(surface.Mesh.Area * 1e-6, 81 * 0.25, places=4)
        lines, = [o for o in group.Group if o.TypeId == "Part::Feature"]
        for edge, level in zip(lines.Shape.Edges, lines.Levels):
            self.assertAlmostEqual(0.1 * edge.CenterOfMass.x, level, places=6)

    def test_the_table_has_the_numbers_and_their_units(self):
        group, _ = self.show()
        sheet, = [o for o in group.Group if o.TypeId == "Spreadsheet::Sheet"]
        self.document.recompute()
        self.assertEqual([sheet.get(f"{c}1") for c in "ABDE"], ["kind", "name", "area_m2", "mean_lx"])
        self.assertEqual(sheet.get("B2"), "Working plane (sensors)")
        self.assertAlmostEqual(sheet.get("E2"), 255.0, places=3)
        rows = {sheet.get(f"B{i}"): i for i in range(2, 60) if sheet.getContents(f"B{i}")}
        self.assertAlmostEqual(sheet.get(f"E{rows['A-WALL/Wall South']}"), 650.0, places=3)
        self.assertIn("a note", rows)

    def test_taking_results_away_gives_back_the_document_as_it_was(self):
        for _ in range(2):
            self.show()
            self.assertNotEqual(appearance(self.document), self.before)
        results.clear(self.project)
        self.assertEqual(appearance(self.document), self.before)
        self.assertEqual(self.project.SavedColours, "")

    def test_undo_gives_back_the_document_as_it_was(self):
        self.document.UndoMode = 1
        self.show()
        self.assertNotEqual(appearance(self.document), self.before)
        self.document.undo()
        self.assertEqual(appearance(self.document), self.before)

    def test_results_survive_saving_and_can_still_be_taken_away(self):
        self.show()
        shown = appearance(self.document)
        file = str(self.folder / "kept.FCStd")
        self.document.saveAs(file)
        self.document = FreeCAD.openDocument(str(shutil.copy(file, self.folder / "reopened.FCStd")))
        again = appearance(self.document)
        for label in SHOWN:
            if label.startswith("Window"):
                continue  # Arch gives windows the colours of their parts again when a document is opened
            name = self.object(label).Name
            np.testing.assert_allclose(np.array(again[name][2]).ravel(), np.array(shown[name][2]).ravel(), atol=1 / 255)
        results.clear(project.find(self.document))
        cleared = appearance(self.document)
        self.assertEqual(set(cleared), set(self.before))
        for label in SHOWN:
            name = self.object(label).Name
            np.testing.assert_allclose(np.array(cleared[name][2]).ravel(), np.array(self.before[name][2]).ravel(), atol=1 / 255)
            self.assertEqual(cleared[name][3:] if "link" in label else cleared[name][4:],
                             self.before[name][3:] if "link" in label else self.before[name][4:], label)

    def test_results_are_no_part_of_the_model(self):
        self.show()
        again = export.export_document(self.document, self.folder / "again")
        self.assertEqual(set(again.objects), set(self.exported.objects))

    def test_a_failure_leaves_nothing_behind(self):
        objects, grids = self.light()
        with self.assertRaises(KeyError):
            results.show(self.project, self.exported, objects + [ObjectLight("nowhere", "", [])], grids, self.folder)
        self.assertEqual(appearance(self.document), self.before)


class Contours(unittest.TestCase):
    def test_lines_of_a_plane_are_straight_and_saddles_do_not_cross(self):
        rows, columns = np.mgrid[0:5, 0:7]
        for (r0, c0), (r1, c1) in contours.lines(2.0 * columns + rows, 5.3):
            self.assertAlmostEqual(2 * c0 + r0, 5.3)
            self.assertAlmostEqual(2 * c1 + r1, 5.3)
        saddle = contours.lines(np.array([[1.0, 0], [0, 1]]), 0.4)
        self.assertEqual(len(saddle), 2)
        for a, b in saddle:
            # The middle, 0.5, lies between the lines: each goes round one of the corners with 0.
            self.assertLess(max(abs(a[0] - b[0]), abs(a[1] - b[1])), 0.5)
        self.assertEqual(contours.lines(np.array([[1.0, np.nan], [0, 1]]), 0.4), [])


host.run(Shown, Contours)
