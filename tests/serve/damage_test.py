"""Lines that are no requests, and scenes that cannot be used: a sentence each, and the engine goes on."""

import json
import unittest

from engine import WithEngine, room


class Damage(WithEngine):
    def refused(self, line):
        self.engine.write(line if isinstance(line, str) else json.dumps(line))
        event = self.engine.next()
        while event["event"] == "progress":
            event = self.engine.next()
        self.assertEqual(event["event"], "error", (str(line)[:100], event))
        return event

    def still_works(self):
        answer = self.engine.ask("render", view="desk", size=[8, 6], samples=8, file=str(self.path / "ok.exr"))
        self.assertEqual(answer["event"], "result", answer)

    def test_lines_that_are_no_requests(self):
        self.load(room(self.path))
        picture = {"id": 9, "do": "render", "view": "desk", "file": "a.exr"}
        for line, id_, sentence in (
                ("", None, None), ("{", None, "the line is no JSON"), ("\x00\x01\xff", None, "the line is no JSON"),
                ("[1, 2]", None, "the line is no JSON object"), ("null", None, "the line is no JSON object"),
                ({"do": "quit"}, None, "\"id\" is missing"), ({"id": "7", "do": "quit"}, None, "\"id\" is missing"),
                ({"id": 1e300, "do": "quit"}, None, "\"id\" is missing"),
                ({"id": 2 ** 63, "do": "quit"}, None, "\"id\" is missing"), ({"id": 5}, 5, "\"do\" is missing"),
                ({"id": 5, "do": "dance"}, 5, "\"do\" is \"dance\", which is not known"),
                ({"id": 5, "do": ["load"]}, 5, "\"do\" is missing or no text"),
                ({"id": 5, "do": "load"}, 5, "load needs \"scene\""),
                ({"id": 5, "do": "load", "scene": 7}, 5, "\"scene\" is missing or no text"),
                ({"id": 5, "do": "load", "scene": "a\0b"}, 5, "\"scene\" is empty or holds a zero byte"),
                ({**picture, "colour": 1}, 9, "\"colour\" is no word of render"),
                ({**picture, "size": [0, 5]}, 9, "\"size\" is 0, expected a number from 1"),
                ({**picture, "size": [100000, 5]}, 9, "\"size\" is 100000, expected a number from 1"),
                ({**picture, "size": [2.5, 5]}, 9, "\"size\" is 2.5, expected a whole number"),
                ({**picture, "size": "8x6"}, 9, "\"size\" is no list of 2 numbers"),
                ({**picture, "region": [3, 3, 3, 4]}, 9, "\"region\" is empty"),
                ({**picture, "accuracy": 0}, 9, "\"accuracy\" is 0, expected"),
                ({**picture, "accuracy": "5%"}, 9, "\"accuracy\" is \"5%\", expected a number"),
                ({**picture, "samples": 10 ** 9}, 9, "\"samples\" is 1000000000, expected"),
                ({**picture, "samples": 8, "seconds": 3}, 9, "more than one of \"accuracy\""),
                ({**picture, "seed": -1}, 9, "\"seed\" is -1, expected"),
                ({**picture, "progressive": 1}, 9, "\"progressive\" is neither true nor false"),
                ({"id": 6, "do": "surfaces", "file": "x", "parts": []}, 6, "\"parts\" is no list of names"),
                ({"id": 6, "do": "surfaces", "file": "x", "spacing": 0}, 6, "\"spacing\" is 0, expected"),
                ({"id": 6, "do": "plan"}, 6, "plan needs either \"view\" or \"grid\""),
                ({"id": 6, "do": "cancel", "target": 99}, 6, "request 99 is neither running nor waiting")):
            if sentence is None:
                self.engine.write(line)  # an empty line is nothing
                continue
            event = self.refused(line)
            self.assertEqual(event["id"], id_, event)
            self.assertTrue(event["text"].startswith(sentence), (line, event))
        self.engine.number = 100
        self.still_works()

    def test_a_line_without_an_end_does_not_fill_the_memory(self):
        self.engine.process.stdin.write("x" * (17 << 20))
        self.engine.write("")
        event = self.engine.next()
        self.assertEqual((event["event"], event["id"]), ("error", None))
        self.assertIn("longer than 16 MB", event["text"])
        self.load(room(self.path))

    def test_requests_that_cannot_be_met(self):
        self.assertIn("no scene is loaded", self.refused({"id": 1, "do": "edit"})["text"])
        self.assertIn("no scene is loaded",
                      self.refused({"id": 1, "do": "render", "view": "v", "file": "a.exr"})["text"])
        self.load(room(self.path))
        file = str(self.path / "a.exr")
        for fields, sentence in (
                ({"do": "load", "scene": str(self.path / "gone.rad")}, "gone.rad"),
                ({"do": "load", "scene": str(self.path)}, str(self.path))):
            event = self.refused({"id": 2, **fields})
            self.assertIn(sentence, event["text"] + event.get("file", ""))
        self.load(room(self.path))
        for fields, sentence in (
                ({"do": "render", "view": "nowhere", "file": file}, "neither a view of the scene"),
                ({"do": "render", "view": "-vp 0 0 0 -vd 0 0 0", "file": file}, "direction"),
                ({"do": "render", "view": "desk", "size": [8, 6], "region": [0, 0, 9, 6], "file": file},
                 "is not inside the picture"),
                ({"do": "render", "view": "desk", "size": [8, 6], "samples": 8, "file": str(self.path / "no/a.exr")}, "no/a.exr"),
                ({"do": "illuminance", "grid": "nowhere", "file": str(self.path / "a.csv")}, "is no grid of the scene"),
                ({"do": "illuminance", "grid": "two", "file": str(self.path / "a.xyz")}, "the ending says no format"),
                ({"do": "surfaces", "parts": ["Nobody*"], "file": str(self.path / "a.json")}, "no object with an area"),
                ({"do": "surfaces", "spacing": 1e-5, "file": str(self.path / "a.json")}, "texels")):
            event = self.refused({"id": 3, **fields})
            self.assertIn(sentence, event["text"], event)
        self.engine.number = 100
        self.still_works()

    def test_scenes_that_cannot_be_used_name_the_line_the_object_and_the_way_out(self):
        for text, line, object_, sentence in (
                ("Gone mesh Desk 1 parts/x.ply 0 0\n", 1, "Desk", "modifier \"Gone\" is not defined above"),
                ("void plastic W 0 0 5 .5 .5 .5 0 0\nW mesh D%20%C3%84 1 x.ply 0 0\n", 2, "D Ä", "\"x.ply\" is not found"),
                ("void plastic W 0 0 5 1.5 1.5 1.5 0 0\n", 1, "W", "1.5"),
                ("void plastic W 0 0 5 .5 .5 .5 0 0\nW sphere s 0 0 4 0 0 0 nan\n", 2, "s", "nan")):
            (self.path / "bad.rad").write_text(text)
            event = self.engine.ask("load", scene=str(self.path / "bad.rad"))
            self.assertEqual((event["event"], event.get("line"), event.get("object")), ("error", line, object_), event)
            self.assertIn(sentence, event["text"], event)
            self.assertTrue(event["file"].endswith("bad.rad"), event)

    def test_a_scene_without_light_is_loaded_but_gives_no_picture(self):
        (self.path / "dark.rad").write_text("void plastic W 0 0 5 .5 .5 .5 0 0\nW sphere s 0 0 4 0 0 0 1\n")
        self.assertEqual(self.engine.ask("load", scene=str(self.path / "dark.rad"))["kind"], "scene")
        event = self.engine.ask("render", view="-vp 0 -5 0 -vd 0 1 0", size=[8, 6], samples=8, file=str(self.path / "a.exr"))
        self.assertIn("nothing in the scene emits light", event["text"])
        self.assertIn("way_out", event)


if __name__ == "__main__":
    unittest.main()
