"""Two animations of two frames: only the camera moves, then a desk moves too; and stills of the same frames."""

import os
import pathlib
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bpy
from inside import PATH, addon, answer, render

scene, session = bpy.context.scene, addon("session")
scene.lightwell.quality, scene.lightwell.accuracy = "ACCURACY", 20
scene.lightwell.sky = "NONE"
scene.view_layers[0].use_pass_z = True
scene.frame_start, scene.frame_end = 1, 2
camera, desk = scene.camera, bpy.data.objects["Desk 03"]
size = dict(resolution_x=64, resolution_y=40, resolution_percentage=100)
result = {}


def kept():
    folder = session.work_folder() / "light"
    return sorted(p.name for p in folder.iterdir()) if folder.is_dir() else []


def frames(name):
    """Renders all frames to NAME0001.exr, NAME0002.exr; the error of the engine or None."""
    render(name + "first.exr", **size)  # sets format and size
    scene.render.filepath = str(PATH / name)
    try:
        bpy.ops.render.render(animation=True)
        return None
    except RuntimeError as error:
        return str(error)


for frame, x in ((1, 0.4), (2, 0.7)):
    camera.location.x = x
    camera.keyframe_insert("location", frame=frame)
scene.frame_set(1)
result["camera"] = frames("camera")
result["kept by the camera"] = kept()
for frame, x in ((1, desk.location.x), (2, desk.location.x - 1.0)):
    desk.location.x = x
    desk.keyframe_insert("location", frame=frame)
scene.frame_set(1)
result["desk"] = frames("desk")
result["kept by the desk"] = kept()
session.close_all()
scene.frame_set(2)
result["still"] = render("still0002.exr", **size)
answer(**result)
