"""The client with an engine that misbehaves in every way that was thought of: each ends in a sentence, none hangs."""

import os
import pathlib
import signal
import tempfile
import time
import unittest
import unittest.mock

import program
from lightwell_bridge import client as client_module, exr
from lightwell_bridge.client import Client, sentence_of
from lightwell_bridge.engine import EngineError, find_engine, version_of

FAKE = pathlib.Path(__file__).with_name("fake_engine.py")


class WithFake(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.path = pathlib.Path(place.name)
        self.addCleanup(os.environ.pop, "FAKE", None)

    def client(self, fake="", **more):
        os.environ["FAKE"] = fake
        client = Client(FAKE, **more)
        self.addCleanup(client.close)
        return client

    def render(self, client, **more):
        return client.send("render", view="v", size=[8, 4], file=str(self.path / "a.exr"), layer="L", **more)


class Requests(WithFake):
    def test_a_picture_comes_back_with_its_progress(self):
        client = self.client()
        self.assertEqual(client.ask("load", scene="x")["kind"], "scene")
        events = list(client.events(self.render(client)))
        self.assertEqual([e["event"] for e in events], ["progress"] * 3 + ["result"])
        self.assertIsNone(exr.check_for_layer(events[-1]["file"], "L", (8, 4)))

    def test_two_requests_do_not_get_each_others_events(self):
        client = self.client("slow")
        first, second = self.render(client), client.send("load", scene="x")
        self.assertEqual(client.next_event(second, 5)["kind"], "scene")
        self.assertEqual(client.next_event(first, 5)["event"], "progress")

    def test_a_request_stops_when_it_is_told_to(self):
        client = self.client("slow")
        number = self.render(client)
        start = time.monotonic()
        events = list(client.events(number, stop=lambda: time.monotonic() - start > 0.3))
        self.assertEqual(events[-1]["event"], "cancelled")
        self.assertLess(time.monotonic() - start, 3)
        self.assertEqual(client.ask("load", scene="x")["kind"], "scene")

    @unittest.mock.patch.object(client_module, "SECONDS_LEFT_ALONE", 0.5)
    def test_a_request_that_is_left_ends_at_once_and_the_next_one_is_answered(self):
        client = self.client("slow")
        stops = iter([False, False, True])
        events = list(client.events(self.render(client), stop=lambda: next(stops), leave=True))
        self.assertEqual(events[-1]["event"], "cancelled")
        self.assertEqual(client.ask("load", scene="x")["kind"], "scene")
        time.sleep(0.6)  # longer than it may go on
        self.assertIsNone(client.next_event(self.render(client), 0))
        self.assertEqual(client.ask("load", scene="x")["kind"], "scene")

    @unittest.mock.patch.object(client_module, "SECONDS_LEFT_ALONE", 0.5)
    def test_a_request_that_had_already_ended_when_it_was_left_is_not_waited_for(self):
        client = self.client()
        number = self.render(client)
        client.ask("load", scene="x")
        time.sleep(0.5)  # all its events have come
        client.next_event(number, 0)
        self.assertEqual([e["event"] for e in client.events(number, stop=lambda: True, leave=True)], ["cancelled"])
        time.sleep(0.6)
        self.assertEqual(client.ask("load", scene="x")["kind"], "scene")

    def test_closing_ends_the_process(self):
        client = self.client("slow")
        self.render(client)
        pid = client.hello["pid"]
        client.close()
        with self.assertRaises(ProcessLookupError):
            os.kill(pid, 0)


class Trouble(WithFake):
    def test_an_engine_of_another_kind_or_version_is_refused_with_what_it_is(self):
        for fake, sentence in (("old", "speaks protocol 0 .engine 0.0.1., this add-on protocol 1"),
                               ("chatter", "does not greet as a Lightwell engine; it says \"usage"),
                               ("mute", "does not greet within 0.5 s")):
            with self.assertRaisesRegex(EngineError, sentence):
                self.client(fake, seconds=0.5 if fake == "mute" else 20)
        with self.assertRaisesRegex(EngineError, "does not start"):
            Client(self.path / "absent")
        with self.assertRaisesRegex(EngineError, "ended with status 1"):
            Client("/bin/false")

    def test_an_engine_that_dies_says_its_last_words(self):
        client = self.client("dies")
        with self.assertRaisesRegex(EngineError, "ended with status 4; it said: out of memory"):
            client.ask("load", scene="x")
        with self.assertRaises(EngineError):
            client.ask("load", scene="x")

    def test_an_engine_that_is_killed_is_missed(self):
        client = self.client("slow")
        number = self.render(client)
        os.kill(client.hello["pid"], signal.SIGKILL)
        with self.assertRaisesRegex(EngineError, "was ended by signal 9"):
            list(client.events(number))

    def test_an_engine_that_does_not_stop_is_ended(self):
        client = self.client("hangs")
        with self.assertRaisesRegex(EngineError, "did not stop within 2 s and was ended"):
            list(client.events(self.render(client), stop=lambda: True))
        self.assertFalse(client.alive())

    @unittest.mock.patch.object(client_module, "SECONDS_LEFT_ALONE", 0.5)
    def test_an_engine_that_goes_on_with_what_was_left_is_ended_by_the_next_request(self):
        client = self.client("hangs")
        list(client.events(self.render(client), stop=lambda: True, leave=True))
        self.assertTrue(client.alive())
        with self.assertRaisesRegex(EngineError, "did not stop within 0.5 s and was ended"):
            list(client.events(self.render(client)))
        self.assertFalse(client.alive())

    def test_an_error_names_the_object_and_the_way_out(self):
        client = self.client("error")
        with self.assertRaisesRegex(EngineError, "object \"Desk 01\": thickness is -6 mm, expected > 0 .correct it."):
            client.ask("render", view="v", size=[8, 4], file="x")
        self.assertEqual(sentence_of({"file": "a.rad", "line": 3, "text": "bad"}), "a.rad:3: bad")


class Finding(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.path = pathlib.Path(place.name)
        for name in ("LIGHTWELL_ENGINE", "PATH"):
            if name in os.environ:
                self.addCleanup(os.environ.__setitem__, name, os.environ[name])
            else:
                self.addCleanup(os.environ.pop, name, None)
        os.environ.pop("LIGHTWELL_ENGINE", None)
        os.environ["PATH"] = str(self.path / "empty")

    def program(self, folder):
        path = self.path / folder / "lightwell"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("#!/bin/sh\necho lightwell 0.1.0\n")
        path.chmod(0o644)  # as a zip leaves it
        return path

    def test_the_order_is_preference_environment_beside_path(self):
        path = self.program("on_path")
        path.chmod(0o755)
        os.environ["PATH"] = str(path.parent)
        self.assertEqual(find_engine(beside=self.path), path)
        beside = self.program("bin")
        self.assertEqual(find_engine(beside=self.path), beside)
        os.environ["LIGHTWELL_ENGINE"] = str(self.program("variable"))
        self.assertEqual(find_engine(beside=self.path).parent.name, "variable")
        self.assertEqual(find_engine(self.program("chosen"), beside=self.path).parent.name, "chosen")
        self.assertEqual(version_of(beside), "lightwell 0.1.0")

    def test_what_was_looked_at_is_listed(self):
        with self.assertRaisesRegex(EngineError, "not found. Looked at preference: not set; LIGHTWELL_ENGINE: not set; "
                                                 "beside the add-on: .*bin/lightwell; on PATH: not there"):
            find_engine(beside=self.path)
        with self.assertRaisesRegex(EngineError, "no Lightwell engine at /nowhere .preference."):
            find_engine("/nowhere", beside=self.path)


if __name__ == "__main__":
    program.run()
