"""With a screen: the viewport shows pictures, panels are laid out, results are on the model; screenshots of each."""

import json
import os
import subprocess
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bpy
from inside import PATH, WORDS, addon, fingerprint

OUT = WORDS[1]
found = {"errors": []}


def areas(kind):
    return [a for a in bpy.context.window_manager.windows[0].screen.areas if a.type == kind]


def shot(name):
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
        bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=2)
        bpy.ops.screen.screenshot(filepath=os.path.join(OUT, name))


def prepare():
    """A large 3D view beside the properties of the scene."""
    scene = bpy.context.scene
    scene.render.engine = "LIGHTWELL"
    scene.lightwell.quality, scene.lightwell.accuracy = "ACCURACY", 20
    scene.lightwell.surface_spacing = 0.5
    scene.lightwell.sky = "NONE"
    bpy.context.preferences.view.show_splash = False
    # Drawing large pictures without a graphics card holds up the keys.
    bpy.context.preferences.view.render_display_type = "NONE"
    for kind in ("DOPESHEET_EDITOR", "TIMELINE"):
        for area in areas(kind):
            area.ui_type = "TIMELINE"
    properties = areas("PROPERTIES")[0]
    properties.spaces[0].context = "SCENE"
    view = areas("VIEW_3D")[0]
    region = view.spaces[0].region_3d
    region.view_perspective = "CAMERA"
    view.spaces[0].overlay.show_extras = False
    view.spaces[0].show_gizmo = False
    bpy.ops.lightwell.count_layers()
    open_panels()
    # Where no tip covers a panel.
    subprocess.run(["xdotool", "mousemove", "640", "892"], check=True)


def open_panels():
    """Panels that are closed at first hide what the picture is to show: the other panels of the scene give way."""
    for cls in bpy.types.Panel.__subclasses__():
        if getattr(cls, "bl_context", "") == "scene" and not cls.__name__.startswith("LIGHTWELL"):
            try:
                bpy.utils.unregister_class(cls)
            except RuntimeError:
                pass


def viewport():
    return next(iter(addon("viewport").LIVE), None)


def steps():
    """Each yield gives Blender time to draw."""
    prepare()
    yield 1.0
    large = areas("VIEW_3D")[0]
    large.type = "PROPERTIES"
    yield 0.5
    large.spaces[0].context = "SCENE"
    yield 1.0
    shot("panels.png")
    large.type = "VIEW_3D"
    large.spaces[0].region_3d.view_perspective = "CAMERA"
    yield 0.5
    view = areas("VIEW_3D")[0].spaces[0]
    view.shading.type = "RENDERED"
    start = time.monotonic()
    while time.monotonic() - start < 120 and (viewport() is None or viewport().shown == 0):
        yield 0.2
    found["first_picture_s"] = time.monotonic() - start
    while time.monotonic() - start < 130 and viewport() is not None and viewport().busy():
        yield 0.2
    shot("viewport.png")
    desk = bpy.data.objects["Desk 03"]
    for step in range(6):
        desk.location.x += 0.02
        yield 0.7
    found["stop_seconds"] = list(viewport().stop_seconds) if viewport() else []
    found["failure"] = viewport().failure if viewport() else "no viewport"
    view.shading.type = "SOLID"
    desk.location.x -= 0.12
    yield 0.5
    before = fingerprint()
    bpy.ops.lightwell.illuminance()
    view.shading.light, view.shading.color_type = "FLAT", "VERTEX"
    view.region_3d.view_perspective = "CAMERA"
    yield 1.0
    shot("results.png")
    report = bpy.data.texts["Lightwell results"].as_string()
    open(os.path.join(OUT, "results.txt"), "w", encoding="utf-8").write(report)
    found["report"] = report
    bpy.ops.lightwell.clear()
    found["same"] = fingerprint() == before


running = steps()


def tick():
    try:
        return next(running)
    except StopIteration:
        pass
    except Exception as error:
        import traceback
        found["errors"].append(traceback.format_exc())
    (PATH / "answer.json").write_text(json.dumps(found, ensure_ascii=False, default=str))
    bpy.ops.wm.quit_blender()
    return None


bpy.app.timers.register(tick, first_interval=2.0)
