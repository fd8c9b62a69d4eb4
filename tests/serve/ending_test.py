"""How work stops: when the host asks, when the host is gone, when the engine is."""

import json
import os
import pathlib
import random
import signal
import statistics
import subprocess
import sys
import time
import unittest

from engine import LIGHTWELL, WithEngine, room

import numpy as np
from lightwell_bridge import exr
from lightwell_bridge.client import Client
from lightwell_bridge.engine import EngineError
from lightwell_bridge.ply import PlyMesh
from lightwell_bridge.scene_folder import SceneFolder

# Nine of ten requests stop within this time; what a machine full of other work may make of the tenth.
SOON_S, MOST_S = 0.2, 1.0


def gone(pid, seconds=15):
    """Whether the process ends within that time."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        try:
            os.kill(pid, 0)
            with open(f"/proc/{pid}/stat", encoding="ascii") as stat:
                if stat.read().rsplit(")", 1)[1].split()[0] == "Z":
                    return True
        except (ProcessLookupError, FileNotFoundError):
            return True
        time.sleep(0.02)
    return False


class Cancelling(WithEngine):
    def measure(self, ask, delays):
        """Seconds that each cancelled request still took, by the phase that it was in."""
        took = {}
        for delay in delays:
            number = ask()
            time.sleep(delay)
            seconds, last = self.engine.cancel(number)
            if last["event"] == "cancelled":
                took[delay] = seconds
        self.assertGreater(len(took), len(delays) * 2 // 3)
        values = sorted(took.values())
        print(f"{len(values)} cancelled: median {1000 * statistics.median(values):.0f} ms, most {1000 * values[-1]:.0f} ms")
        self.assertLess(values[int(0.9 * (len(values) - 1))], SOON_S, took)
        self.assertLess(values[-1], MOST_S, took)

    def test_a_large_picture_stops_at_any_moment(self):
        self.load(room(self.path))
        chance = random.Random(4)
        file = self.path / "a.exr"
        self.measure(lambda: self.engine.send("render", view="desk", size=[1920, 1440], accuracy=0.01, layer="V",
                                              file=str(file)), [chance.uniform(0, 4) for _ in range(20)])
        self.assertFalse(file.exists())

    def test_a_progressive_picture_stops_and_its_last_partial_stays_readable(self):
        self.load(room(self.path))
        file = self.path / "a.exr"
        number = self.engine.send("render", view="desk", size=[320, 240], accuracy=0.005, progressive=True, layer="V",
                                  file=str(file))
        self.engine.until(number, ("partial",))
        seconds, last = self.engine.cancel(number)
        self.assertEqual(last["event"], "cancelled")
        self.assertLess(seconds, MOST_S)
        self.assertTrue(np.isfinite(exr.read(file)[1]["V.Combined.R"]).all())
        self.assertEqual([p.name for p in self.path.iterdir() if p.name.startswith("a.")], ["a.exr"])

    def test_grids_and_surfaces_stop(self):
        self.load(room(self.path))
        for do, fields in (("illuminance", {"grid": "plane:0.85,0.1,0.1,3.9,2.9/0.02", "file": str(self.path / "a.csv")}),
                           ("surfaces", {"spacing": 0.02, "file": str(self.path / "a.json")}),
                           ("plan", {"view": "desk", "size": [1920, 1080]})):
            self.measure(lambda: self.engine.send(do, accuracy=0.005, **fields), [0.05, 0.2, 0.4, 0.7])

    def test_loading_a_large_scene_stops(self):
        folder = SceneFolder(self.path)
        folder.material("plastic", "Grey", numbers=(0.5, 0.5, 0.5, 0, 0))
        folder.material("light", "Lamp", numbers=(1, 1, 1))
        side = np.arange(400)
        x, y = np.meshgrid(side, side)
        points = np.stack([x, y, np.sin(x * 0.1) * np.cos(y * 0.1)], axis=-1).reshape(-1, 3)
        at = (y * 400 + x)[:-1, :-1].ravel()
        quads = np.stack([at, at + 1, at + 401, at + 400], axis=-1)
        mesh = PlyMesh(points, np.full(len(quads), 4), quads.ravel())
        for i in range(4):
            folder.mesh("Grey", f"ground {i}", folder.part("ground", mesh), [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, i]])
            mesh.vertices = mesh.vertices + [0, 0, 1e-3]  # another file each
        folder.save()
        self.measure(lambda: self.engine.send("load", scene=str(folder.path / "scene.rad")), [0.05, 0.15, 0.3, 0.5])

    def test_what_waits_is_taken_out_of_the_queue_at_once(self):
        self.load(room(self.path))
        first = self.engine.send("render", view="desk", size=[1920, 1440], accuracy=0.01, file=str(self.path / "a.exr"))
        second = self.engine.send("render", view="desk", size=[8, 6], samples=8, file=str(self.path / "b.exr"))
        seconds, last = self.engine.cancel(second)
        self.assertEqual(last["event"], "cancelled")
        self.assertLess(seconds, MOST_S)
        self.engine.cancel(first)
        self.assertFalse((self.path / "b.exr").exists())


HOST = """
import subprocess, sys, time
engine = subprocess.Popen([sys.argv[1], "serve"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
engine.stdin.write(sys.argv[2])
engine.stdin.flush()
print(engine.stdout.readline(), flush=True)
time.sleep(600)
"""


class Ending(WithEngine):
    def busy(self):
        """An engine at work on a picture that takes long."""
        self.load(room(self.path))
        number = self.engine.send("render", view="desk", size=[1920, 1440], accuracy=0.01, file=str(self.path / "a.exr"))
        self.engine.until(number, ("progress",))

    def test_it_ends_when_its_input_ends_and_leaves_no_half_result(self):
        self.busy()
        self.engine.process.stdin.close()
        self.assertTrue(gone(self.engine.process.pid))
        self.assertEqual(self.engine.process.wait(10), 0)
        self.assertEqual([p.name for p in self.path.iterdir() if p.name.startswith("a.")], [])

    def test_it_ends_when_nobody_reads_any_more(self):
        process = subprocess.Popen([LIGHTWELL, "serve"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        process.stdout.readline()
        process.stdout.close()
        process.stdin.write('{"id":1,"do":"edit"}\n')
        process.stdin.flush()
        self.assertTrue(gone(process.pid))
        process.stdin.close()

    def test_killing_the_host_ends_the_engine(self):

        scene = str(room(self.path).path / "scene.rad")
        requests = "".join(json.dumps(r) + "\n" for r in (
            {"id": 1, "do": "load", "scene": scene},
            {"id": 2, "do": "render", "view": "desk", "size": [1920, 1440], "accuracy": 0.01, "file": str(self.path / "a.exr")}))
        host = subprocess.Popen([sys.executable, "-c", HOST, LIGHTWELL, requests], stdout=subprocess.PIPE, text=True)
        pid = json.loads(host.stdout.readline())["pid"]
        time.sleep(1)
        host.send_signal(signal.SIGKILL)
        host.wait()
        host.stdout.close()
        self.assertTrue(gone(pid), "the engine outlives its host")

    def test_sigterm_ends_it_in_order(self):
        self.busy()
        self.engine.process.send_signal(signal.SIGTERM)
        self.assertEqual(self.engine.process.wait(15), 0)

    def test_killing_the_engine_leaves_the_client_with_a_sentence(self):
        folder = room(self.path)
        with Client(pathlib.Path(LIGHTWELL)) as client:
            client.ask("load", scene=str(folder.path / "scene.rad"))
            number = client.send("render", view="desk", size=[1920, 1440], accuracy=0.01, file=str(self.path / "b.exr"))
            client.next_event(number, 20)
            os.kill(client.hello["pid"], signal.SIGKILL)
            with self.assertRaisesRegex(EngineError, "was ended by signal 9"):
                list(client.events(number))


if __name__ == "__main__":
    unittest.main()
