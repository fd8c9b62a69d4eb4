"""Simulations inside FreeCAD: with the engine, with one that behaves badly, and with documents that are hard to light."""

import csv
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

import host

host.show_main_window()

import FreeCAD
import numpy as np
import Part

from lightwell_freecad import export, project, results, run

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from processes import alive

HERE = pathlib.Path(host.__file__).parent
LOPSIDED = host.ROOT / "tests" / "fixtures" / "hosts" / "lopsided.ies"
FAKE_ENGINE = host.ROOT / "tests" / "bridge" / "fake_engine.py"
ENGINE = os.environ.get("LIGHTWELL_ENGINE", "")
# From the call to the end of the job.
STOPPED_WITHIN_S = 0.2
# An engine that is deaf is killed after its own grace.
GONE_WITHIN_S = 20
# The room: inner size in metres, and its lamp.
WIDTH, DEPTH, HEIGHT, LUMENS = 4.0, 3.0, 2.5, 5000.0


def content(document):
    """What must stay as it was: objects, labels, properties, colours."""
    seen = {}
    for obj in document.Objects:
        view = obj.ViewObject
        seen[obj.Name] = (obj.Label, tuple(sorted(obj.PropertiesList)), tuple(map(tuple, getattr(view, "DiffuseColor", None) or ())),
                          bool(obj.Visibility), str(getattr(obj, "Placement", "")))
    return seen


def room(document):
    """A closed room with a lamp below its ceiling and a grid over its floor."""
    walls = Part.makeBox(4200, 3200, 2700, FreeCAD.Vector(-100, -100, -100)).cut(Part.makeBox(4000, 3000, 2500))
    shell = document.addObject("Part::Feature", "Room")
    shell.Shape = walls
    lamp = document.addObject("Part::Plane", "Lamp")
    lamp.Length, lamp.Width = 600, 600
    lamp.Placement = FreeCAD.Placement(FreeCAD.Vector(1700, 1800, 2480), FreeCAD.Rotation(FreeCAD.Vector(1, 0, 0), 180))
    project.make_luminaire(lamp, LUMENS, 4000)
    column = document.addObject("Part::Cylinder", "Column")
    column.Radius, column.Height, column.Placement.Base = 150, 2500, FreeCAD.Vector(3300, 700, 0)
    document.recompute()
    lighting = project.make(document)
    floor = next(i for i, f in enumerate(walls.Faces, 1) if abs(f.CenterOfMass.z) < 1e-6)
    project.add_grid(lighting, shell, f"Face{floor}", spacing_mm=500, offset_mm=750, label="Desks")
    project.add_view(lighting, "Eye", position=(300, 300, 1500), direction=(1, 0.7, -0.1), angle=80)
    lighting.Accuracy, lighting.Width, lighting.Height, lighting.FaceSpacing = 0.05, 120, 90, 500
    document.recompute()
    return lighting


class InRoom(unittest.TestCase):
    def setUp(self):
        self.document = FreeCAD.newDocument("room")
        self.project = room(self.document)
        self.addCleanup(lambda: run.end(self.document))
        self.before = content(self.document)

    def fake(self, how):
        os.environ["FAKE"] = how
        self.addCleanup(os.environ.pop, "FAKE", None)
        self.project.Engine = str(FAKE_ENGINE)
        self.before = content(self.document)

    def refused(self, call, *parts):
        """The sentence with which it fails; the document is as before."""
        with self.assertRaises(run.Failed) as failure:
            call()
        sentence = str(failure.exception)
        for part in parts:
            self.assertIn(part, sentence)
        self.assertEqual(content(self.document), self.before)
        return sentence


@unittest.skipUnless(host.serves(), "LIGHTWELL_ENGINE names no engine that serves hosts")
class WithEngine(InRoom):
    def test_grids_equal_a_run_of_the_command_line(self):
        grid, = run.illuminance(self.project)
        mean = float(np.mean(grid.lux))
        # A lamp of 5000 lm in 12 m2: between what comes directly and what would come with white walls.
        self.assertTrue(0.1 * LUMENS / (WIDTH * DEPTH) < mean < 5 * LUMENS / (WIDTH * DEPTH), mean)
        scene, file = run.session_of(self.document).folder / "scene" / "scene.rad", self.folder() / "desks.csv"
        subprocess.run([ENGINE, "illuminance", str(scene), "--grid", "Desks", "-o", str(file), "--accuracy", "5%"], check=True,
                       capture_output=True)
        with open(file, newline="") as text:
            rows = list(csv.DictReader(text))
        self.assertEqual(len(rows), 8 * 6)
        other = np.array([float(r["illuminance_lx"]) for r in rows])
        error = np.hypot(grid.error, [float(r["error_lx"]) for r in rows])
        self.assertLess(abs(mean - other.mean()), 3 * float(error.mean()) + 1e-6 * mean)
        self.assertLess(float(np.quantile(np.abs(np.array(grid.lux) - other) / np.maximum(error, 1e-3 * other + 1e-6), 0.9)), 4)

    def test_faces_get_their_illuminance_and_means_come_from_the_map(self):
        lights = {light.source: light for light in run.objects(self.project)}
        self.assertEqual(set(lights), {"Room", "Lamp", "Column"})
        shell = lights["Room"]
        self.assertEqual(len(shell.faces), 12)
        shape = self.document.getObject("Room").Shape
        floor = next(i for i, f in enumerate(shape.Faces) if abs(f.CenterOfMass.z) < 1e-6)
        outside = next(i for i, f in enumerate(shape.Faces) if f.CenterOfMass.z < -99)
        self.assertGreater(shell.faces[floor].front, 50)
        self.assertLess(shell.faces[outside].front, 1e-6)
        for face, light in zip(shape.Faces, shell.faces):
            self.assertAlmostEqual(light.area, face.Area * 1e-6, delta=0.02 * face.Area * 1e-6)
        colours = self.document.getObject("Room").ViewObject.DiffuseColor
        self.assertEqual(len(colours), 12)
        self.assertNotEqual(colours[floor], colours[outside])
        results.clear(self.project)
        self.assertEqual(content(self.document), self.before)

    def test_means_of_faces_equal_a_run_of_the_command_line(self):
        lights = {light.source: light for light in run.objects(self.project)}
        scene, baked = run.session_of(self.document).folder / "scene" / "scene.rad", self.folder()
        subprocess.run([ENGINE, "bake", str(scene), "--surface", "(no layer)", "--spacing", "0.5", "--accuracy", "5%",
                        "-o", str(baked)], check=True, capture_output=True)
        wanted = json.loads((baked / "maps.json").read_text())["layers"]["(no layer)"]["front"]["mean_lx"]
        faces = lights["Room"].faces + lights["Column"].faces
        area = sum(f.area for f in faces)
        mean, error = (sum(f.area * getattr(f, k) for f in faces) / area for k in ("front", "front_error"))
        self.assertGreater(wanted, 10)
        self.assertLess(abs(mean - wanted), 3 * math.sqrt(2) * error)
        self.assertLess(error, 0.1 * mean)

    def test_a_picture_stands_beside_the_model(self):
        plane = run.picture(self.project, "Eye")
        self.assertEqual(plane.TypeId, "Image::ImagePlane")
        self.assertAlmostEqual(plane.XSize.Value / plane.YSize.Value, 120 / 90, places=6)
        from lightwell_bridge import exr
        header, channels = exr.read(plane.Picture)
        self.assertEqual(header.size, (120, 90))
        self.assertGreater(float(np.mean(channels["Lightwell.Combined.G"])), 0)

    def test_a_change_is_simulated_with_the_same_engine(self):
        first = float(np.mean(run.illuminance(self.project)[0].lux))
        process = run.session_of(self.document).client
        self.document.getObject("Lamp").lw_lumens = 2 * LUMENS
        second = float(np.mean(run.illuminance(self.project)[0].lux))
        self.assertIs(run.session_of(self.document).client, process)
        self.assertAlmostEqual(second / first, 2, delta=0.1)

    def test_stopping_at_any_moment_leaves_the_document_as_it_was(self):
        self.project.Accuracy = 0.0005
        self.before = content(self.document)
        for delay in (0.0, 0.05, 0.3, 1.0):
            job = run.Job(self.project, [run.OBJECTS, run.ILLUMINANCE])
            begun = time.monotonic()
            while job.poll() and time.monotonic() - begun < delay:
                time.sleep(0.005)
            job.cancel()
            asked = time.monotonic()
            while job.poll():
                time.sleep(0.005)
            took = time.monotonic() - asked
            self.assertTrue(job.stopped, job.error)
            self.assertLess(took, STOPPED_WITHIN_S)
            self.assertEqual(content(self.document), self.before)

    def test_the_engine_ends_when_freecad_is_killed(self):
        told = self.folder() / "engine.pid"
        words = dict(os.environ, LIGHTWELL_PID=str(told), LIGHTWELL_SCRIPT=str(HERE / "inside_slow.py"))
        other = subprocess.Popen(["freecadcmd", str(HERE / "start.py")], env=words, stdin=subprocess.DEVNULL,
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(other.wait)
        self.addCleanup(other.kill)
        begun = time.monotonic()
        while not (told.exists() and told.read_text()):
            self.assertIsNone(other.poll(), "FreeCAD has ended by itself")
            self.assertLess(time.monotonic() - begun, 120)
            time.sleep(0.05)
        pid = int(told.read_text())
        self.assertTrue(alive(pid))
        other.kill()
        other.wait()
        killed = time.monotonic()
        while alive(pid):
            self.assertLess(time.monotonic() - killed, GONE_WITHIN_S)
            time.sleep(0.01)
        print(f"gone {1000 * (time.monotonic() - killed):.0f} ms after FreeCAD", file=host.ERRORS)

    def test_library_materials_are_chosen_by_the_layer_map(self):
        column = self.document.getObject("Column")
        group = self.document.addObject("App::DocumentObjectGroup", "Steel parts")
        group.Label = "Steel parts"
        group.addObject(column)
        self.project.LayerMap = ["(no layer) = white_paint", "Steel* = grey_50"]
        exported = run.write_scene(self.document, self.folder())
        self.assertEqual(exported.layers["Steel parts"]["material"], "grey_50")
        self.assertEqual(exported.layers["(no layer)"]["material"], "white_paint")
        self.before = content(self.document)
        self.project.LayerMap = ["(no layer) = whit_paint"]
        self.refused(lambda: run.illuminance(self.project), "whit_paint", "white_paint")
        self.project.LayerMap = ["B-NONE = white_paint"]
        self.refused(lambda: run.illuminance(self.project), "B-NONE", "matches no layer")
        self.project.LayerMap = ["white_paint"]
        self.refused(lambda: run.illuminance(self.project), "PATTERN = MATERIAL")

    def folder(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        return pathlib.Path(folder.name)

    def candela(self, exported, x, y, z):
        """Of a lamp there, by what is 45 degrees below it along +x, +y, -x and -y; far from all else."""
        points, file = self.folder() / "points.txt", self.folder() / "lux.csv"
        points.write_text("".join(f"{x + dx} {y + dy} {z - 1} 0 0 1\n" for dx, dy in ((1, 0), (0, 1), (-1, 0), (0, -1))))
        subprocess.run([ENGINE, "illuminance", str(exported.scene), "--grid", f"file:{points}", "--samples", "64", "-o", str(file)],
                       check=True, capture_output=True)
        with open(file, newline="") as text:
            return [float(row["illuminance_lx"]) * 2 * math.sqrt(2) for row in csv.DictReader(text)]

    def test_luminaires_with_a_photometric_file_shine_as_it_was_measured(self):
        """A box shines along its -z, a panel where its face looks; both turn with their object."""
        box = self.document.addObject("Part::Box", "Spot")
        box.Length, box.Width, box.Height = 10, 20, 12
        box.Placement = FreeCAD.Placement(FreeCAD.Vector(30010, 29995, 1000), FreeCAD.Rotation(FreeCAD.Vector(0, 0, 1), 90))
        panel = self.document.addObject("Part::Plane", "Panel")
        panel.Length, panel.Width = 20, 20
        panel.Placement = FreeCAD.Placement(FreeCAD.Vector(59990, 60010, 1000), FreeCAD.Rotation(FreeCAD.Vector(1, 0, 0), 180))
        for obj in (box, panel):
            project.make_luminaire(obj, ies=str(LOPSIDED))
        self.document.recompute()
        exported = run.write_scene(self.document, self.folder())
        self.assertAlmostEqual(exported.lights["Spot"]["lumens"], 983, delta=1)
        # The middle of the box, turned by 90 degrees: plane 0 looks along +y.
        np.testing.assert_allclose(self.candela(exported, 30, 30, 1.006), (100, 800, 300, 20), rtol=0.04)
        # The panel is turned about x: plane 0 still looks along +x, plane 90 with the light's frame.
        np.testing.assert_allclose(self.candela(exported, 60, 60, 1), (800, 300, 20, 100), rtol=0.04)
        self.assertIn("Spot", exported.objects)
        self.assertTrue(any("lopsided.ies has 983 lm" in note for note in exported.notes), exported.notes)

    def test_a_photometric_file_that_is_none_is_named_with_its_object(self):
        lamp = self.document.getObject("Lamp")
        broken = self.folder() / "broken.ies"
        broken.write_text(LOPSIDED.read_text()[:80])
        project.make_luminaire(lamp, ies=str(broken))
        exported = run.write_scene(self.document, self.folder())
        self.assertTrue(any("\"Lamp\"" in note and "broken.ies" in note for note in exported.notes), exported.notes)
        self.assertNotIn("Lamp", exported.lights)


class BadEngines(InRoom):
    def test_no_engine(self):
        self.project.Engine = "/nowhere/lightwell"
        self.before = content(self.document)
        self.refused(lambda: run.illuminance(self.project), "/nowhere/lightwell", "correct the path")

    def test_an_engine_of_another_protocol(self):
        self.fake("old")
        self.refused(lambda: run.illuminance(self.project), "protocol 0", "install versions that belong together")

    def test_a_program_that_is_no_engine(self):
        self.fake("chatter")
        self.refused(lambda: run.illuminance(self.project), "does not greet as a Lightwell engine")

    def test_an_engine_that_dies_and_one_that_is_killed(self):
        self.fake("dies")
        self.refused(lambda: run.illuminance(self.project), "out of memory")
        os.environ["FAKE"] = "kill"
        self.refused(lambda: run.picture(self.project, "Eye"), "was ended by signal 9", "The next start tries again")
        os.environ["FAKE"] = ""
        self.assertEqual(run.picture(self.project, "Eye").TypeId, "Image::ImagePlane")

    def test_a_full_disk_and_an_error_of_an_object(self):
        self.fake("full")
        self.refused(lambda: run.picture(self.project, "Eye"), "no space left", "make room")
        run.end(self.document)
        os.environ["FAKE"] = "error"
        self.refused(lambda: run.picture(self.project, "Eye"), "Desk 01", "-6 mm")

    def test_a_picture_of_wrong_channels(self):
        self.fake("black")
        self.refused(lambda: run.picture(self.project, "Eye"), "Lightwell.Combined.R")

    def test_an_engine_that_does_not_stop_is_ended(self):
        self.fake("hangs")
        job = run.Job(self.project, ["Eye"])
        begun = time.monotonic()
        while job.poll() and (job.fraction == 0 and time.monotonic() - begun < 20):
            time.sleep(0.01)
        process = run.session_of(self.document).client._process
        job.cancel()
        asked = time.monotonic()
        while job.poll():
            time.sleep(0.005)
        self.assertLess(time.monotonic() - asked, STOPPED_WITHIN_S)
        self.assertTrue(job.stopped)
        self.assertIsNotNone(process.wait(GONE_WITHIN_S))
        self.assertEqual(content(self.document), self.before)

    def test_stopping_takes_effect_at_once(self):
        self.fake("slow")
        for _ in range(3):
            job = run.Job(self.project, ["Eye"])
            begun = time.monotonic()
            while job.poll() and (job.fraction == 0 and time.monotonic() - begun < 20):
                time.sleep(0.01)
            job.cancel()
            asked = time.monotonic()
            while job.poll():
                time.sleep(0.005)
            self.assertLess(time.monotonic() - asked, STOPPED_WITHIN_S)
            self.assertTrue(job.stopped)


class HardDocuments(unittest.TestCase):
    """What cannot be translated is named; the rest goes on."""

    def setUp(self):
        self.document = FreeCAD.newDocument("hard")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def box(self, label="Box"):
        box = self.document.addObject("Part::Box", "Box")
        box.Label = label
        self.document.recompute()
        return box

    def export(self):
        self.document.recompute()
        return export.export_document(self.document, self.folder)

    def noted(self, exported, *parts):
        self.assertTrue(any(all(p in note for p in parts) for note in exported.notes), exported.notes)

    def test_a_document_without_a_face(self):
        self.document.addObject("Part::Feature", "Empty")
        with self.assertRaisesRegex(ValueError, "\"hard\" has no visible object with a face"):
            self.export()

    def test_an_object_without_a_face_is_left_out(self):
        self.box()
        line = self.document.addObject("Part::Feature", "Line")
        line.Shape = Part.makeLine(FreeCAD.Vector(), FreeCAD.Vector(1, 0, 0))
        self.assertEqual(set(self.export().objects), {"Box"})

    def test_a_link_of_scale_zero_is_named(self):
        box = self.box()
        link = self.document.addObject("App::Link", "Flat")
        link.LinkedObject = box
        link.ScaleVector = FreeCAD.Vector(1, 1, 0)
        exported = self.export()
        self.assertEqual(set(exported.objects), {"Box"})
        self.noted(exported, "\"Flat\"", "scale is zero")

    def test_a_link_to_nothing_is_named_or_left_out(self):
        self.box()
        self.document.addObject("App::Link", "Lost")
        self.assertEqual(set(self.export().objects), {"Box"})

    def test_names_of_all_kinds_arrive(self):
        labels = ["a/b", "Größe (M) 1", "窓 ガラス", "100 % #1", "\"quoted\"", "void", " "]
        for label in labels:
            self.box(label)
        exported = self.export()
        self.assertEqual(len(exported.objects), len(labels))
        from scene_text import Scene
        scene = Scene(exported.scene)
        self.assertEqual({s.source for s in scene.surfaces}, set(exported.objects))

    def test_a_scene_without_light_says_so(self):
        self.box()
        self.noted(self.export(), "no light")

    def test_a_missing_photometric_file_is_named(self):
        self.box("Floor")
        project.make_luminaire(self.box("Spot 3"), ies="/nowhere/spot.ies")
        exported = self.export()
        self.noted(exported, "\"Spot 3\"", "/nowhere/spot.ies")
        self.assertEqual(set(exported.objects), {"Floor"})

    def test_lumens_that_are_none_are_named(self):
        self.box("Floor")
        for lumens in (0.0, -5.0, math.nan):
            project.make_luminaire(self.box(f"Lamp {lumens}"), lumens)
        exported = self.export()
        self.assertEqual(set(exported.objects), {"Floor"})
        self.noted(exported, "Lamp -5.0", "-5.0 lm")

    def test_a_material_that_says_nothing_becomes_grey(self):
        box = self.box()
        import Arch
        material = Arch.makeMaterial("Odd")
        material.Material = {"DiffuseColor": "bluish", "Transparency": "a lot"}
        box.addProperty("App::PropertyLink", "Material")
        box.Material = material
        exported = self.export()
        self.assertEqual(exported.layers[material.Label]["material"], "matt, 50 %")
        self.noted(exported, material.Label, "no colour")

    def test_a_grid_on_what_is_gone_and_a_tolerance_that_is_none(self):
        box = self.box()
        lighting = project.make(self.document)
        grid = project.add_grid(lighting, box, "Face6")
        grid.Face = (box, ["Face9"])
        exported = run.write_scene(self.document, self.folder)
        self.noted(exported, grid.Label, "Face9")
        lighting.ChordTolerance = 0
        with self.assertRaisesRegex(run.Failed, "chord tolerance"):
            run.write_scene(self.document, self.folder)

    def test_a_view_that_looks_nowhere_and_a_time_that_is_none(self):
        self.box()
        lighting = project.make(self.document)
        view = project.add_view(lighting, "Eye", direction=(0, 0, 1))
        with self.assertRaisesRegex(run.Failed, "\"Eye\" looks along its up direction"):
            run.write_scene(self.document, self.folder)
        view.Direction = FreeCAD.Vector(0, 1, 0)
        lighting.SkyType, lighting.Time = "clear", "yesterday"
        with self.assertRaisesRegex(run.Failed, "yesterday"):
            run.write_scene(self.document, self.folder)


host.run(WithEngine, BadEngines, HardDocuments)
