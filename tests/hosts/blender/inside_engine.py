"""Pictures, a border, illuminance on objects and an animation with the real engine."""

import os
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bpy
from inside import PATH, addon, answer, fingerprint, render

scene, session = bpy.context.scene, addon("session")
scene.lightwell.quality, scene.lightwell.samples = "SAMPLES", 16
scene.lightwell.surface_spacing = 1.0
scene.lightwell.sky = "NONE"
scene.view_layers[0].use_pass_z = scene.view_layers[0].use_pass_normal = True
size = dict(resolution_x=96, resolution_y=60, resolution_percentage=100)
result = {}


def timed(name, work):
    start = time.monotonic()
    result[name] = work()
    result[name + " seconds"] = time.monotonic() - start


timed("whole", lambda: render("whole.exr", **size))
kept = session.session("render")
result["scene"] = str(kept.folder() / "scene.rad")
import shutil
shutil.copytree(kept.folder(), PATH / "kept")
result["load"] = kept.client.ask("load", scene=str(PATH / "kept" / "scene.rad"))
session.close_all()
border = dict(use_border=True, border_min_x=0.25, border_max_x=0.75, border_min_y=0.2, border_max_y=0.6)
timed("border", lambda: render("border.exr", **border))
scene.render.use_border = False
for camera in ("Camera plan", "Camera fisheye"):
    scene.camera = bpy.data.objects[camera]
    result[camera] = render(f"{camera}.exr")
scene.camera = bpy.data.objects["Camera main"]
before = fingerprint()
timed("illuminance", lambda: list(bpy.ops.lightwell.illuminance()))
result["report"] = bpy.data.texts["Lightwell results"].as_string()
result["table"] = bpy.data.texts["Lightwell results.csv"].as_string()
shown = {}
for obj in bpy.data.objects:
    if obj.type == "MESH" and "illuminance_lx" in obj.data.attributes:
        values = [v.value for v in obj.data.attributes["illuminance_lx"].data]
        shown[obj.name] = values
result["shown"] = shown
shutil.copytree(session.session("illuminance").folder(), PATH / "lit")
bpy.ops.lightwell.clear()
result["same"] = fingerprint() == before
answer(**result)
