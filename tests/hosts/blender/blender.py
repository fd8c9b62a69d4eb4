"""Starts Blender with the packed add-on and a script, in a folder and with settings of its own."""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
SHARED = pathlib.Path(os.environ.get("LIGHTWELL_SHARED", ROOT.parent / "shared"))
OFFICE = SHARED / "fixtures/hosts/blender_office/office.blend"
TRUTH = OFFICE.with_name("truth.json")
SKIPPED = 77
SECONDS = 300

sys.path[:0] = [str(ROOT / "plugins")]


class InBlender(unittest.TestCase):
    """`self.blender(script, ...)` runs a script of this folder inside and returns what it saved as answer.json.

    `fails`: Blender may end with a status, as it does after a render with an error.
    """

    @classmethod
    def setUpClass(cls):
        from pack import pack
        cls._place = tempfile.TemporaryDirectory(prefix="lightwell blender ü ")
        cls.path = pathlib.Path(cls._place.name)
        cls.archive = pack("blender", cls.path / "packed")
        addons = cls.path / "scripts" / "addons"
        addons.mkdir(parents=True)
        shutil.copytree(cls.path / "packed" / "blender" / "lightwell", addons / "lightwell")

    @classmethod
    def tearDownClass(cls):
        cls._place.cleanup()

    def start(self, script, *words, file=None, screen=False, environment=(), addon=True, **more):
        """The running process; what it prints goes to a pipe."""
        command = ["blender", *([] if screen else ["-b"]), "--factory-startup", "--python-exit-code", "5"]
        if screen:
            command = ["xvfb-run", "-a", "-s", "-screen 0 1280x900x24", *command, "--window-geometry", "0", "0", "1280", "900"]
        if addon:
            command += ["--addons", "lightwell"]
        if file is not None:
            command.append(str(file))
        command += ["-P", str(HERE / script), "--", str(self.path), *map(str, words)]
        settings = dict(os.environ, BLENDER_USER_SCRIPTS=str(self.path / "scripts"), LIBGL_ALWAYS_SOFTWARE="1",
                        BLENDER_USER_CONFIG=str(self.path / "config"), LIGHTWELL_ENGINE=os.environ["LIGHTWELL"],
                        PYTHONDONTWRITEBYTECODE="1", **dict(environment))
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                                env=settings, cwd=self.path, start_new_session=True, **more)

    def once(self, *words, **more):
        """The answer of a run that all tests of the class share; the first that asks has it made."""
        if "_answer" not in vars(type(self)):
            type(self)._answer = None
            type(self)._answer = self.blender(*words, **more)
            type(self).said = self.output
        self.assertIsNotNone(self._answer, "Blender did not answer the first test of this class")
        return self._answer

    def blender(self, script, *words, fails=False, **more):
        answer = self.path / "answer.json"
        answer.unlink(missing_ok=True)
        process = self.start(script, *words, **more)
        try:
            output, _ = process.communicate(timeout=SECONDS)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)  # with the screen and the engines
            output, _ = process.communicate()
            raise AssertionError(f"Blender did not end within {SECONDS} s; it said: {output[-4000:]}") from None
        self.output = output
        if not fails:
            self.assertEqual(process.returncode, 0, output[-6000:])
            self.assertTrue(answer.exists(), output[-6000:])
        return json.loads(answer.read_text()) if answer.exists() else None


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def run():
    """Runs the tests of the calling file."""
    for program in ("blender", "xvfb-run"):
        if shutil.which(program) is None:
            skip(f"{program} is not installed")
    if not OFFICE.exists():
        skip(f"{OFFICE} is not here")
    program = unittest.main(exit=False)
    if program.result.testsRun == len(program.result.skipped) > 0:
        sys.exit(SKIPPED)
    sys.exit(0 if program.result.wasSuccessful() else 1)
