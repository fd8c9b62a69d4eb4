"""An engine to talk to, and scenes for it."""

import json
import os
import pathlib
import queue
import subprocess
import sys
import tempfile
import threading
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "plugins"))
LIGHTWELL = os.environ.get("LIGHTWELL", str(ROOT / "build/release/lightwell"))
LONG = 120  # seconds that nothing here takes, on a busy machine too

try:
    import numpy  # noqa: F401
except ImportError:
    print("skipped: python3-numpy is not installed")
    sys.exit(77)

from lightwell_bridge.ply import PlyMesh  # noqa: E402
from lightwell_bridge.scene_folder import SceneFolder  # noqa: E402


class Engine:
    """`lightwell serve` without the bridge: lines as they are."""

    def __init__(self):
        self.process = subprocess.Popen([LIGHTWELL, "serve"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True, encoding="utf-8", bufsize=1)
        self.lines, self.number = queue.Queue(), 0
        threading.Thread(target=self._read, daemon=True).start()
        self.hello = self.next()

    def _read(self):
        for line in self.process.stdout:
            self.lines.put(json.loads(line))
        self.lines.put(None)

    def write(self, text):
        self.process.stdin.write(text + "\n")
        self.process.stdin.flush()

    def send(self, do, **fields):
        self.number += 1
        self.write(json.dumps({"id": self.number, "do": do, **fields}))
        return self.number

    def next(self, timeout=LONG):
        return self.lines.get(timeout=timeout)

    def until(self, number, kinds=("result", "error", "cancelled")):
        """All events of a request up to one of these kinds; those of others are passed over."""
        events = []
        while True:
            event = self.next()
            if event is None:
                raise AssertionError(f"the engine ended: {self.process.stderr.read()}")
            if event["id"] == number:
                events.append(event)
                if event["event"] in kinds:
                    return events

    def ask(self, do, **fields):
        """The last event of a request."""
        return self.until(self.send(do, **fields))[-1]

    def cancel(self, number):
        """Seconds until the target has ended."""
        start = time.monotonic()
        self.send("cancel", target=number)
        last = self.until(number)[-1]
        return time.monotonic() - start, last

    def close(self):
        if self.process.poll() is None:
            self.process.stdin.close()
            self.process.wait(LONG)
        self.process.stdout.close()
        self.process.stderr.close()


class WithEngine(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.path = pathlib.Path(place.name)
        self.engine = Engine()
        self.addCleanup(self.engine.close)

    def load(self, folder):
        answer = self.engine.ask("load", scene=str(folder.path / "scene.rad"))
        self.assertEqual(answer["event"], "result", answer)
        return answer


VIEW = "-vtv -vp 0.5 0.5 1.5 -vd 0.7 0.6 -0.2 -vu 0 0 1 -vh 60 -vv 45"
BOX = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]  # outwards


def box(x, y, z):
    return [(x * (i & 1), y * (i >> 1 & 1), z * (i >> 2)) for i in range(8)]


def room(path, desk=(1, 1, 0), wall=0.5, lamp=20):
    """4 x 3 x 2.5 m with grey walls, a lamp of 1 m2 facing down and a desk of 1.2 x 0.6 x 0.7 m.

    The walls look inwards: one object of six faces, floor and ceiling with materials of their own.
    """
    folder = SceneFolder(path)
    for name, value in (("Wall", wall), ("Floor", 0.3), ("Desk: Oak", 0.4)):
        folder.material("plastic", name, numbers=(value, value, value, 0, 0))
    folder.material("light", "Lamp", numbers=(lamp, lamp, lamp))
    folder.view("desk", VIEW)
    folder.grid("two", [(1, 1, 1, 0, 0, 1), (2, 2, 1, 0, 0, 1)], 1, 2, 1.0, [0, 1])
    walls = PlyMesh.of_faces(box(4, 3, 2.5), [face[::-1] for face in BOX], modifiers=["Wall", "Floor"],
                             face_modifiers=[1, 0, 0, 0, 0, 0])
    folder.mesh("Wall", "room", folder.part("room", walls), source="Building/Room 1")
    desk_part = folder.part("desk", PlyMesh.of_faces(box(1.2, 0.6, 0.7), BOX))
    folder.mesh("Desk: Oak", "desk", desk_part, [[1, 0, 0, desk[0]], [0, 1, 0, desk[1]], [0, 0, 1, desk[2]]],
                source="Furniture/Schreibtisch Ä")
    folder.surface("Lamp", "polygon", "lamp", (1.5, 1, 2.45, 1.5, 2, 2.45, 2.5, 2, 2.45, 2.5, 1, 2.45),
                   source="Lamps/Lamp", light=True)
    folder.save()
    return folder
