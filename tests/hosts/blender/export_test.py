"""The office as the add-on writes it, against what Blender itself said of it when it was made (truth.json)."""

import json
import math

from blender import OFFICE, TRUTH, InBlender, run

# Areas of truth.json are rounded to 1e-5 m2, Blender's coordinates are single precision.
LEAST, SHARE = 1e-5, 1e-6


class Export(InBlender):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.truth = json.loads(TRUTH.read_text())

    def setUp(self):
        self.answer = self.once("inside_export.py", file=OFFICE)
        self.parts = self.answer["parts"]

    def drawn(self):
        """{object: [parts]} that truth.json expects: hidden and excluded ones are left out, instances are many."""
        return {name: count for name, count in self.truth["instances"]["drawn_count_by_object"].items()
                if not self.truth["objects"][name]["hide_render"] and name != "Guide box"}

    def assert_close(self, found, wanted, what):
        self.assertLessEqual(abs(found - wanted), max(LEAST, SHARE * abs(wanted)), f"{what}: {found} and {wanted}")

    def test_every_object_arrives_as_often_as_it_is_drawn(self):
        found = {}
        for part in self.parts.values():
            found[part["object"]] = found.get(part["object"], 0) + 1
        self.assertEqual(found, self.drawn())

    def test_faces_sizes_area_and_bounds_of_each_object_are_those_of_blender(self):
        for source, part in self.parts.items():
            wanted = self.truth["objects"][part["object"]]["cage"]
            sizes = part["sizes"]
            counted = (part["faces"], sizes.count(3), sizes.count(4), sum(s > 4 for s in sizes), max(sizes))
            self.assertEqual(counted, tuple(wanted[k] for k in ("faces", "tris", "quads", "ngons", "largest_ngon")), source)
            self.assert_close(part["area"], wanted["area"], source)
            if not source.startswith("Furniture/Chairs/Stool instance"):
                for found, expected in zip(sum(part["bbox"], []), sum(wanted["bbox"], [])):
                    self.assert_close(found, expected, source)
            for material, entry in wanted["by_material"].items():
                self.assertEqual(part["by_material"][material][0], entry["faces"], source)
                self.assert_close(part["by_material"][material][1], entry["area"], source)

    def test_layers_are_the_collections_with_their_faces_and_areas(self):
        totals = {}
        for part in self.parts.values():
            entry = totals.setdefault(part["layer"], [0, 0, 0.0, 0])
            if part["object"].startswith("Asset stool"):
                continue  # truth.json counts the faces of collection instances with their own collection
            entry[0] += part["faces"]
            entry[1] += sum(s > 4 for s in part["sizes"])
            entry[2] += part["area"]
            entry[3] += 1
        wanted = {path: c for path, c in self.truth["collections"].items()
                  if c["mesh_faces"] and not c["hide_render"] and not c["excluded_from_view_layer"]}
        self.assertEqual(set(totals), set(wanted))
        for path, collection in wanted.items():
            self.assertEqual(totals[path][:2], [collection["mesh_faces"], collection["ngons"]], path)
            # The area of a collection is the sum of its objects' areas, each rounded.
            self.assertAlmostEqual(totals[path][2], collection["area"], delta=LEAST / 2 * (totals[path][3] + 1), msg=path)

    def test_instances_of_a_collection_stand_where_they_are(self):
        stools = sorted(p["bbox"][0][0] + p["bbox"][1][0] for s, p in self.parts.items() if s.endswith("/Asset stool"))
        for found, x in zip(stools, (4.6, 5.1, 5.6)):
            self.assertAlmostEqual(found / 2, x, places=3)
        self.assertTrue(all(p["layer"] == "Furniture/Chairs" for p in self.parts.values() if "stool" in p["object"]))

    def test_one_mesh_of_many_objects_is_written_once(self):
        self.assertEqual(self.answer["files"], len({json.dumps([self.truth["objects"][p["object"]]["data"], p["layer"]])
                                                   for p in self.parts.values()}))

    def test_the_pouf_is_a_cage_with_the_sharpness_of_its_creases(self):
        pouf = self.parts["Furniture/Soft seating/Pouf (subdivision)"]
        self.assertTrue(pouf["cage"])
        self.assertEqual(pouf["edges"], self.truth["objects"]["Pouf (subdivision)"]["creased_edges"]["count"])
        for found, wanted in zip(pouf["sharpness"], (10 * 0.35 ** 2, 10)):
            # Blender 3.4 keeps creases in 255 steps.
            self.assertAlmostEqual(found, wanted, delta=10 * 2 * 0.35 / 255)

    def test_cameras_look_where_they_looked(self):
        for name, camera in self.truth["cameras"].items():
            words = self.answer["views"][name]
            for word, wanted in (("-vp", camera["position"]), ("-vd", camera["forward"]), ("-vu", camera["up"])):
                found = [float(v) for v in words.split(f"{word} ")[1].split()[:3]]
                for a, b in zip(found, wanted):
                    self.assertAlmostEqual(a, b, delta=2e-6, msg=f"{name} {word}")
        angle = float(self.answer["views"]["Camera main"].split("-vh ")[1].split()[0])
        self.assertAlmostEqual(math.radians(angle), self.truth["cameras"]["Camera main"]["angle_x_rad"], delta=2e-6)
        self.assertIn("-vh 6.5 ", self.answer["views"]["Camera plan"] + " ")
        self.assertTrue(self.answer["views"]["Camera fisheye"].startswith("-vta "))

    def test_lamps_have_the_lumens_of_their_watts(self):
        """Luminous flux from watts, colour and shape by hand; colours count by the engine's weights."""
        from lightwell_bridge import colour
        for name, lamp in self.truth["lights"].items():
            watts = lamp["radiant_power_W_or_irradiance"] * colour.luminous(colour.from_rec709(lamp["color"])) * 179
            share = {"AREA": math.pi / 4, "SUN": 1, "POINT": 1,
                     "SPOT": (1 - math.cos(lamp.get("spot_size_rad", 0) / 2)) / 2 * (1 - lamp.get("blend", 0) / 2)}
            self.assertAlmostEqual(self.answer["lamps"][name] / (watts * share[lamp["kind"]]), 1, places=5, msg=name)

    def test_what_was_assumed_is_said_with_the_names_of_things(self):
        notes = "\n".join(self.answer["notes"])
        self.assertIn("lamp \"Bulb\": 15 W at 179 lm/W", notes)
        self.assertIn("sky texture's sun (altitude 35.0", notes)
        self.assertNotIn("has no material", notes)
        self.assertEqual(self.answer["grids"], [["Floor", 384]])


if __name__ == "__main__":
    run()
