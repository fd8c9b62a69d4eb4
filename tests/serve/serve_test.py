"""lightwell serve, request by request, with numbers that come from elsewhere."""

import csv
import json
import math
import pathlib
import subprocess
import tempfile
import unittest

from engine import BOX, LIGHTWELL, VIEW, Engine, WithEngine, box, room

import numpy as np
from lightwell_bridge import exr
from lightwell_bridge.client import Client
from lightwell_bridge.ply import PlyMesh
from lightwell_bridge.scene_folder import SceneFolder

CHANNELS = ["Combined.A", "Combined.B", "Combined.G", "Combined.R", "Depth.Z", "Error.X", "Illuminance.X",
            "Luminance.X", "Normal.X", "Normal.Y", "Normal.Z", "ObjectLayer.X"]


# 96 x 64 pixels are square in it, so that the command line makes the same size.
SQUARE_PIXELS = VIEW.replace("-vv 45", f"-vv {2 * np.degrees(np.arctan(np.tan(np.radians(30)) * 64 / 96)):.12g}")


def command_line(*words):
    subprocess.run([LIGHTWELL, *map(str, words)], check=True, capture_output=True)


class Protocol(WithEngine):
    def test_the_first_line_is_a_greeting_with_version_and_process(self):
        self.assertEqual(self.engine.hello["event"], "hello")
        self.assertEqual(self.engine.hello["protocol"], 1)
        self.assertEqual(self.engine.hello["pid"], self.engine.process.pid)
        said = subprocess.run([LIGHTWELL, "--version"], capture_output=True, text=True, check=True).stdout
        self.assertEqual("lightwell " + self.engine.hello["engine"], said.strip())

    def test_requests_are_answered_in_their_order_and_quit_at_once(self):
        scene = str(room(self.path).path / "scene.rad")
        numbers = [self.engine.send("load", scene=scene), self.engine.send("edit"),
                   self.engine.send("render", view="desk", size=[2000, 1500], accuracy=0.002, file=str(self.path / "a.exr"))]
        finals = []
        while len(finals) < 2:
            event = self.engine.next()
            if event["event"] == "result":
                finals.append(event["id"])
        self.assertEqual(finals, numbers[:2])
        number = self.engine.send("quit")
        self.assertEqual(self.engine.until(number)[-1]["kind"], "quit")
        self.assertEqual(self.engine.process.wait(20), 0)
        self.assertEqual([p.name for p in self.path.iterdir() if "exr" in p.name], [])

    def test_progress_only_grows_and_comes_at_most_ten_times_a_second(self):
        self.load(room(self.path))
        number = self.engine.send("render", view="desk", size=[48, 36], accuracy=0.2, file=str(self.path / "a.exr"))
        events = self.engine.until(number)
        told = [e["fraction"] for e in events if e["event"] == "progress"]
        self.assertEqual(told, sorted(told))
        self.assertLessEqual(len(told), 1 + 10 * (events[-1]["seconds"] + 1))
        self.assertTrue(all(e["phase"] for e in events if e["event"] == "progress"))


class Scenes(WithEngine):
    def test_layers_and_objects_arrive_with_their_faces_areas_and_bounds(self):
        answer = self.load(room(self.path))
        layers = {layer["name"]: layer for layer in answer["layers"]}
        self.assertEqual(set(layers), {"Wall", "Floor", "Desk: Oak", "Lamp"})
        self.assertEqual((layers["Wall"]["faces"], layers["Floor"]["faces"]), (5, 1))
        self.assertAlmostEqual(layers["Wall"]["area_m2"], 12 + 2 * (10 + 7.5), places=12)
        self.assertAlmostEqual(layers["Floor"]["area_m2"], 12, places=12)
        self.assertAlmostEqual(layers["Desk: Oak"]["area_m2"], 2 * (0.72 + 0.84 + 0.42), places=12)
        self.assertEqual(layers["Wall"]["corners"], {"4": 5})
        parts = {part["name"]: part for part in answer["parts"]}
        self.assertEqual(set(parts), {"Building/Room 1", "Furniture/Schreibtisch Ä", "Lamps/Lamp"})
        self.assertEqual(parts["Furniture/Schreibtisch Ä"]["low"], [1, 1, 0])
        for value, expected in zip(parts["Furniture/Schreibtisch Ä"]["high"], (2.2, 1.6, 0.7)):
            self.assertAlmostEqual(value, expected, places=12)
        self.assertEqual((answer["views"], answer["grids"]), (["desk"], ["two"]))
        self.assertEqual(answer["surfaces"], 13)

    def test_faces_of_any_number_of_corners_and_subdivided_cages_are_counted_as_they_are(self):
        folder = SceneFolder(self.path)
        folder.material("plastic", "Grey", numbers=(0.5, 0.5, 0.5, 0, 0))
        folder.material("light", "Lamp", numbers=(1, 1, 1))
        points = [(np.cos(a), np.sin(a), 0) for a in np.arange(7) * 2 * np.pi / 7]
        folder.mesh("Grey", "a", folder.part("a", PlyMesh.of_faces(points, [list(range(7)), [0, 1, 2]])))
        cage = PlyMesh.of_faces(box(1, 1, 1), BOX, boundary="smooth")
        folder.subdivision("Grey", "b", folder.part("b", cage), 1e-3, source="Ball")
        folder.save()
        parts = {part["name"]: part for part in self.load(folder)["parts"]}
        self.assertEqual(parts["a"]["corners"], {"3": 1, "7": 1})
        self.assertEqual(parts["Ball"]["corners"], {"4": 6})
        # The limit surface of a cube of side 1 is 136/162 of it across: from a face point's limit, 272/324.
        self.assertAlmostEqual(parts["Ball"]["high"][0] - parts["Ball"]["low"][0], 272 / 324, places=6)

    def test_a_drawing_without_light_is_refused_as_the_command_line_does(self):
        (self.path / "floor.obj").write_text("o Floor\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3 4\n")
        answer = self.engine.ask("load", scene=str(self.path / "floor.obj"))
        self.assertEqual(answer["event"], "error")
        self.assertIn("nothing in the scene emits light", answer["text"])

    def test_a_plan_says_what_a_picture_will_take(self):
        self.load(room(self.path))
        plan = self.engine.ask("plan", view="desk", size=[48, 36], accuracy=0.2)["plan"]
        self.assertGreater(plan["expected"]["cpu_seconds"], 0)
        self.assertEqual(plan["expected"]["wanted_accuracy"], 0.2)
        self.assertTrue(any(stage["on"] for stage in plan["stages"]))


class Results(WithEngine):
    def test_a_picture_for_blender_holds_the_values_of_the_command_line(self):
        folder = room(self.path)
        answer = self.load(folder)
        result = self.engine.ask("render", view=SQUARE_PIXELS, size=[96, 64], samples=16, seed=3,
                                 layer="ViewLayer", file=str(self.path / "a.exr"))
        self.assertEqual(result["kind"], "picture", result)
        self.assertEqual((result["width"], result["height"], result["samples"]), (96, 64, 16))
        header, own = exr.read(self.path / "a.exr")
        self.assertEqual(header.channels, [f"ViewLayer.{name}" for name in CHANNELS])
        self.assertIsNone(exr.check_for_layer(self.path / "a.exr", "ViewLayer", (96, 64)))
        command_line("render", folder.path / "scene.rad", "--view", SQUARE_PIXELS, "--size", "96x64", "--samples", 16,
                     "--seed", 3, "-o", self.path / "b.exr")
        _, other = exr.read(self.path / "b.exr")
        luminance = 179 * (0.265 * other["R"] + 0.67 * other["G"] + 0.065 * other["B"])
        np.testing.assert_allclose(own["ViewLayer.Luminance.X"], luminance, rtol=1e-5)
        np.testing.assert_array_equal(own["ViewLayer.Illuminance.X"], other["illuminance.Y"])
        # White adapts to white: grey stays grey.
        np.testing.assert_allclose(own["ViewLayer.Combined.R"], other["R"], rtol=2e-3)
        np.testing.assert_allclose(own["ViewLayer.Combined.B"], other["B"], rtol=2e-3)
        self.assertEqual(set(np.unique(own["ViewLayer.Combined.A"])), {1.0})
        names = answer["layers"]
        shown = {names[int(i)]["name"] for i in np.unique(own["ViewLayer.ObjectLayer.X"]) if i >= 0}
        self.assertTrue({"Wall", "Floor", "Desk: Oak"} <= shown, shown)
        floor = own["ViewLayer.ObjectLayer.X"] == [n["name"] for n in names].index("Floor")
        # All but its edges, which mix with what is beside them.
        self.assertGreater((own["ViewLayer.Normal.Z"][floor] > 0.999).mean(), 0.8)

    def test_a_region_has_the_bits_of_the_whole(self):
        self.load(room(self.path))
        for name, more in (("whole", {}), ("part", {"region": [10, 5, 40, 30]})):
            answer = self.engine.ask("render", view="desk", size=[64, 48], samples=8, layer="V",
                                     file=str(self.path / f"{name}.exr"), **more)
            self.assertEqual(answer["event"], "result", answer)
        _, whole = exr.read(self.path / "whole.exr")
        header, part = exr.read(self.path / "part.exr")
        self.assertEqual(header.size, (30, 25))
        for name in part:
            np.testing.assert_array_equal(part[name], whole[name][5:30, 10:40], name)

    def test_a_progressive_picture_is_whole_each_time_and_gets_better(self):
        self.load(room(self.path))
        number = self.engine.send("render", view="desk", size=[96, 72], accuracy=0.1, progressive=True, layer="V",
                                  file=str(self.path / "a.exr"))
        partials, last = [], None
        while last is None:
            event = self.engine.next()
            self.assertNotEqual(event["event"], "error", event)
            if event["id"] == number and event["event"] == "partial":
                _, channels = exr.read(event["file"])
                self.assertTrue(np.isfinite(channels["V.Combined.R"]).all())
                if not partials:  # the first has a quarter of the pixels a side
                    blocks = channels["V.Combined.R"].reshape(18, 4, 24, 4)
                    np.testing.assert_array_equal(blocks, blocks[:, :1, :, :1].repeat(4, axis=1).repeat(4, axis=3))
                partials.append(event)
            elif event["id"] == number and event["event"] == "result":
                last = event
        self.assertEqual(len(partials), 4)
        self.assertEqual(partials[0]["samples"], 8)
        self.assertLess(partials[-1]["error"], partials[0]["error"])
        self.assertLess(last["error"], 0.15)

    def test_a_progressive_picture_in_a_given_time_takes_about_that_time(self):
        self.load(room(self.path))
        answer = self.engine.ask("render", view="desk", size=[64, 48], seconds=4, progressive=True,
                                 file=str(self.path / "a.exr"))
        self.assertEqual(answer["event"], "result", answer)
        self.assertLess(answer["seconds"], 60)

    def test_a_grid_is_that_of_the_command_line_to_the_bit(self):
        folder = room(self.path)
        self.load(folder)
        answer = self.engine.ask("illuminance", grid="plane:0.85,0.5,0.5,3.5,2.5/0.5", accuracy=0.05,
                                 file=str(self.path / "a.csv"))
        self.assertEqual(answer["kind"], "grid", answer)
        command_line("illuminance", folder.path / "scene.rad", "--grid", "plane:0.85,0.5,0.5,3.5,2.5/0.5", "--accuracy",
                     "5%", "-o", self.path / "b.csv")
        self.assertEqual((self.path / "a.csv").read_text(), (self.path / "b.csv").read_text())
        with open(self.path / "a.csv", newline="", encoding="utf-8") as file:
            lux = [float(row["illuminance_lx"]) for row in csv.DictReader(file)]
        self.assertEqual(answer["points"], len(lux))
        self.assertAlmostEqual(answer["mean"], sum(lux) / len(lux), places=9)
        self.assertEqual((answer["min"], answer["max"]), (min(lux), max(lux)))

    def test_faces_have_means_of_their_maps_that_agree_with_a_fine_grid(self):
        folder = room(self.path)
        self.load(folder)
        answer = self.engine.ask("surfaces", parts=["Building/*", "*Ä"], spacing=0.25, accuracy=0.02,
                                 file=str(self.path / "faces.json"))
        self.assertEqual(answer["kind"], "surfaces", answer)
        found = json.loads((self.path / "faces.json").read_text(encoding="utf-8"))
        parts = {part["object"]: part for part in found["parts"]}
        self.assertEqual(set(parts), {"Building/Room 1", "Furniture/Schreibtisch Ä"})
        faces = parts["Building/Room 1"]["faces"]
        self.assertEqual([face["face"] for face in faces], list(range(6)))
        self.assertAlmostEqual(sum(face["area_m2"] for face in faces), 59, places=9)
        floor = faces[0]
        self.assertEqual((floor["layer"], floor["map"]["kind"]), ("Floor", "plane"))
        self.assertEqual(len(floor["map"]["front"]), floor["map"]["rows"] * floor["map"]["columns"])
        values = [v for v in floor["map"]["front"] if v is not None]
        self.assertAlmostEqual(floor["front"], float(np.mean(values)), delta=1e-4 * floor["front"])
        # The back of the walls sees nothing; means of objects are those of their faces by area.
        self.assertEqual(max(face["back"] for face in faces), 0)
        mean = sum(f["area_m2"] * f["front"] for f in faces) / 59
        self.assertAlmostEqual(parts["Building/Room 1"]["front"], mean, places=6)
        command_line("illuminance", folder.path / "scene.rad", "--grid", "layer:Floor@0/0.25", "--accuracy", "2%", "--seed",
                     7, "-o", self.path / "floor.csv")
        run = json.loads((self.path / "floor.run.json").read_text())
        with open(self.path / "floor.csv", newline="", encoding="utf-8") as file:
            fine = float(np.mean([float(row["illuminance_lx"]) for row in csv.DictReader(file)]))
        stated = math.hypot(floor["front_error"], float(run["settings"]["mean_error_lx"]))
        self.assertLess(abs(floor["front"] - fine), 3 * stated)
        # Wide enough to hold, narrow enough to tell: ten lux in a hundred would be seen.
        self.assertLess(3 * stated, 0.1 * fine)


class Edits(WithEngine):
    def full_run(self, folder):
        """What a fresh engine says of the scene as it is now."""
        fresh = Engine()
        try:
            self.assertEqual(fresh.ask("load", scene=str(folder.path / "scene.rad"))["event"], "result")
            fresh.ask("illuminance", grid="two", accuracy=0.2, file=str(self.path / "fresh.csv"))
        finally:
            fresh.close()
        return (self.path / "fresh.csv").read_text()

    def after_edit(self):
        answer = self.engine.ask("edit")
        self.assertEqual(answer["event"], "result", answer)
        self.engine.ask("illuminance", grid="two", accuracy=0.2, file=str(self.path / "edited.csv"))
        return answer, (self.path / "edited.csv").read_text()

    def test_moved_objects_new_materials_and_lamps_equal_a_full_run_to_the_bit(self):
        folder = room(self.path)
        self.load(folder)
        seen = []
        for change in ({"desk": (2, 1, 0)}, {"wall": 0.8}, {"lamp": 40}):
            answer, edited = self.after_edit_of(change)
            self.assertEqual(answer["kept"], {"mesh_files": 2, "read_files": 0, "light": False})
            self.assertEqual(edited, self.full_run(folder))
            seen.append(edited)
        self.assertEqual(len(set(seen)), 3)

    def after_edit_of(self, change):
        room(self.path, **change)
        return self.after_edit()

    def test_a_new_mesh_alone_is_read_again(self):
        folder = room(self.path)
        self.load(folder)
        folder = room(self.path)
        extra = folder.part("extra", PlyMesh.of_faces([(0, 0, 1), (1, 0, 1), (0, 1, 1)], [[0, 1, 2]]))
        folder.mesh("Wall", "extra", extra)
        folder.save()
        answer, edited = self.after_edit()
        self.assertEqual(answer["kept"], {"mesh_files": 2, "read_files": 1, "light": False})
        self.assertEqual(edited, self.full_run(folder))

    def test_a_new_view_keeps_all_that_was_made_ready(self):
        folder = room(self.path)
        self.load(folder)
        folder.view("other", VIEW)
        folder.save()
        answer = self.engine.ask("edit")
        self.assertEqual(answer["views"], ["desk", "other"])
        self.assertTrue(answer["kept"]["light"])
        answer = self.engine.ask("render", view="other", size=[16, 12], samples=8, file=str(self.path / "a.exr"))
        self.assertEqual(answer["event"], "result", answer)

    def test_a_damaged_scene_is_told_and_the_one_before_still_serves(self):
        folder = room(self.path)
        self.load(folder)
        scene = folder.path / "scene.rad"
        good = scene.read_text(encoding="utf-8")
        scene.write_text(good + "\nGone mesh x\n1 parts/gone.ply\n0\n0\n", encoding="utf-8")
        answer = self.engine.ask("edit")
        self.assertEqual((answer["event"], answer["object"]), ("error", "x"))
        self.assertIn("is not defined above", answer["text"])
        answer = self.engine.ask("render", view="desk", size=[16, 12], samples=8, file=str(self.path / "a.exr"))
        self.assertEqual(answer["event"], "result", answer)

    def test_the_bridge_s_client_speaks_with_the_engine(self):
        folder = room(self.path)
        with Client(pathlib.Path(LIGHTWELL)) as client:
            self.assertEqual(client.ask("load", scene=str(folder.path / "scene.rad"))["kind"], "scene")
            number = client.send("render", view="desk", size=[32, 24], samples=8, layer="V", file=str(self.path / "a.exr"))
            self.assertEqual(list(client.events(number))[-1]["kind"], "picture")


if __name__ == "__main__":
    unittest.main()
