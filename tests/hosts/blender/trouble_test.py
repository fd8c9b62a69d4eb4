"""What goes wrong ends in a sentence; the document is unchanged and the next render works."""

import os
import pathlib
import signal
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from processes import alive
from blender import OFFICE, ROOT, InBlender, run

FAKE = ROOT / "tests/bridge/fake_engine.py"
# After this time an engine that was started is at its picture.
BUSY_S = 1.5
GONE_WITHIN_S = 6


class Trouble(InBlender):
    def setUp(self):
        result = self.once("inside_trouble.py", FAKE, file=OFFICE, environment={"PATH": "/usr/bin:/bin"}.items(), fails=True)
        self.found, self.changed = result["found"], result["changed"]

    def expect(self, name, *sentences):
        for sentence in sentences:
            self.assertIn(sentence, str(self.found[name]), name)

    def test_no_engine_says_where_it_was_looked_for(self):
        self.expect("no engine", "not found. Looked at preference: not set; LIGHTWELL_ENGINE: not set; beside the add-on")
        self.expect("wrong path", "no Lightwell engine at /nowhere/lightwell (LIGHTWELL_ENGINE)")

    def test_an_engine_of_another_version_is_refused(self):
        self.expect("version", "speaks protocol 0", "this add-on protocol 1")
        self.expect("no greeting", "does not greet as a Lightwell engine")

    def test_an_engine_that_dies_or_is_killed_leaves_a_sentence(self):
        self.expect("dies", "ended with status 4; it said: out of memory")
        self.expect("killed", "was ended by signal 9")
        self.expect("illuminance", "ended with status 4")

    def test_a_full_disk_and_a_bad_object_are_named(self):
        self.expect("disk full", "no space left on the device (make room)")
        self.expect("bad object", "object \"Desk 01\": thickness is -6 mm")

    def test_a_picture_that_blender_would_show_black_is_refused(self):
        self.expect("black", "no channel ViewLayer.Combined.R")
        self.expect("small", "has 60 x 36 pixels, expected 64 x 40")

    def test_without_a_camera_it_says_so(self):
        self.expect("no camera", "no camera")

    def test_after_each_trouble_the_document_is_as_it_was_and_rendering_works(self):
        self.assertEqual(self.changed, [])
        for name, text in self.found.items():
            if name.endswith(", then"):
                self.assertIsNone(text, name)

    def test_objects_that_show_nothing_are_named(self):
        self.expect("notes", "object \\\"Nichts ∕ 無\\\" has no face".replace("\\", ""))
        self.expect("notes", "object \"Furniture/Desks/Desk 02\": its scale is 0, nothing is left",
                    "object \"Furniture/Desks/Desk 03\": its scale is 0 in one direction")
        self.assertNotIn("Furniture/Desks/Desk 02", self.found["sources"])
        self.assertIn("Furniture/Desks/Desk 03", self.found["sources"])

    def test_materials_that_cannot_be_translated_and_missing_pictures_are_named(self):
        self.expect("notes", "material \"Geheimnis 50 % \"x\" #1\" has a Toon BSDF shader, which is not read")
        self.expect("notes", "material \"Tapete 壁紙\": image \"gone\" is missing")
        self.expect("notes", "object \"Architecture/Walls/Door leaf\" has no material")
        self.expect("notes", "\"no_such_material\"")

    def test_names_with_blanks_slashes_and_letters_of_all_kinds_arrive(self):
        self.assertIn("Furniture/Desks/Tisch ∕ Büro: 机 #1", self.found["sources"])
        self.assertIsNone(self.found["render with all that"])

    def test_a_scene_without_light_and_a_time_that_is_none_are_said(self):
        self.expect("dark", "the scene has no light")
        self.expect("time", "\"noon\" is no time with an offset from UTC")


class Stopping(InBlender):
    """Ctrl-C in a background render; Blender killed."""

    def test_a_render_that_is_interrupted_ends_at_once_and_takes_the_engine_with_it(self):
        process, pid = self.busy(FAKE)
        start = time.monotonic()
        process.send_signal(signal.SIGINT)
        output, _ = process.communicate(timeout=30)
        self.assertLess(time.monotonic() - start, 5, output)
        self.assert_gone(pid)

    def test_the_engine_ends_when_blender_is_killed(self):
        for engine in (FAKE, os.environ["LIGHTWELL"]):
            process, pid = self.busy(engine)
            self.assertTrue(alive(pid))
            process.kill()
            process.communicate()
            print(f"gone {1000 * self.assert_gone(pid):.0f} ms after Blender")

    def busy(self, engine):
        """A Blender whose engine is at work, and the number of the engine's process."""
        told = self.path / "engine.pid"
        told.unlink(missing_ok=True)
        process = self.start("inside_slow.py", engine, file=OFFICE, environment={"FAKE": "slow"}.items())
        for _ in range(600):
            if told.exists() and told.read_text():
                break
            time.sleep(0.1)
        time.sleep(BUSY_S)
        return process, int(told.read_text())

    def assert_gone(self, pid):
        """Seconds until it was."""
        start = time.monotonic()
        while alive(pid):
            self.assertLess(time.monotonic() - start, GONE_WITHIN_S)
            time.sleep(0.02)
        return time.monotonic() - start


if __name__ == "__main__":
    run()
