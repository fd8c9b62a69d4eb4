"""Begins a render that takes minutes, and tells the number of the engine's process."""

import os
import sys
import threading
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bpy
from inside import PATH, WORDS, addon, render

os.environ["LIGHTWELL_ENGINE"] = WORDS[1]
lighting = bpy.context.scene.lightwell
lighting.quality, lighting.accuracy, lighting.sky = "ACCURACY", 0.5, "NONE"
kept = addon("session").session("render")


def tell():
    while kept.client is None or not hasattr(kept.client, "hello"):
        time.sleep(0.02)
    (PATH / "engine.pid").write_text(str(kept.client.hello["pid"]))


threading.Thread(target=tell, daemon=True).start()
render()
