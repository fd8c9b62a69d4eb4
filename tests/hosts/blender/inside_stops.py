"""With a screen: Escape at many moments of a final picture."""

import json
import os
import subprocess
import sys
import threading
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bpy
from inside import PATH, WORDS, addon

found = {"errors": []}


def press_escape(pressed):
    """As a person does; `pressed` gets the time."""
    pressed.append(time.monotonic())
    subprocess.run(["xdotool", "key", "Escape"], check=True)


# Moments after Render is pressed: Blender writes the scene, the engine reads it, makes it ready, traces.
WHILE_TRACING_S = (0.02, 0.1, 0.2, 0.4, 0.8, 1.2, 1.7, 2.3, 3.0, 4.5)
# An engine that has a large picture with all passes three times a second: most of these moments lie within one.
WHILE_TAKING_OVER_S = (1.0, 1.13, 1.27, 1.4, 1.55, 1.7, 1.85, 2.1, 2.35, 2.6)
SLOW_S, TRIES = 0.2, 3
LOST_KEY_S = 5.0  # after which it is pressed again
ended, completed = [], []


def stop_final_renders():
    """Escape at several moments of a final picture: seconds until Blender says that the render has ended."""
    scene = bpy.context.scene
    scene.render.engine = "LIGHTWELL"
    scene.lightwell.quality, scene.lightwell.accuracy, scene.lightwell.sky = "ACCURACY", 0.5, "NONE"
    bpy.context.preferences.view.show_splash = False
    bpy.context.preferences.view.render_display_type = "NONE"
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 1920, 1200, 100
    bpy.utils.register_class(Idle)
    bpy.app.handlers.render_cancel.append(lambda *_: ended.append(time.monotonic()))
    bpy.app.handlers.render_complete.append(lambda *_: completed.append(True))
    subprocess.run(["xdotool", "mousemove", "700", "400"], check=True)
    # Without a graphics card a 3D view takes half a second to draw, for which the keys wait.
    for area in bpy.context.window_manager.windows[0].screen.areas:
        area.type = "TEXT_EDITOR"
    yield 1.0
    # The first render makes Blender draw what it has not drawn before.
    yield from stop_at((1.0,), "first")
    yield from stop_at(WHILE_TRACING_S, "tracing")
    addon("session").close_all()
    os.environ.update(LIGHTWELL_ENGINE=WORDS[1], FAKE="pictures")
    yield from stop_at(WHILE_TAKING_OVER_S, "taking_over")
    found["renders_completed"] = len(completed)


def stop_at(moments, name):
    """`name`: for each moment (seconds, seconds of Blender alone) of each try. A slow stop is tried again, after one of
    an engine that does nothing: other programs hold up the window now and then, and so does Blender itself.
    """
    found[name] = []
    for delay in moments:
        found[name].append([])
        while len(found[name][-1]) < TRIES and not any(0 < s < SLOW_S for s, _ in found[name][-1]):
            seconds = yield from stop_once(delay)
            alone = 0
            if seconds >= SLOW_S:
                bpy.context.scene.render.engine = Idle.bl_idname
                alone = yield from stop_once(delay)
                bpy.context.scene.render.engine = "LIGHTWELL"
            found[name][-1].append((seconds, alone))


class Idle(bpy.types.RenderEngine):
    """Does nothing until it is stopped: what Blender itself needs for that."""
    bl_idname = bl_label = "IDLE"

    def render(self, depsgraph):
        while not self.test_break():
            time.sleep(0.01)


def stop_once(delay):
    """Seconds from the key to the end of the render; below 0 when it ended of its own."""
    ended.clear()
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
        bpy.ops.render.render("INVOKE_DEFAULT")
    yield delay
    pressed = []
    while not ended or not pressed:
        # In a thread: Blender's own turn of the loop sees the key.
        presser = threading.Thread(target=press_escape, args=(pressed,), daemon=True)
        presser.start()
        waited = time.monotonic()
        while (not ended or presser.is_alive()) and time.monotonic() - waited < LOST_KEY_S:
            yield 0.01
    yield 0.3
    return ended[0] - pressed[0]


running = stop_final_renders()


def tick():
    try:
        return next(running)
    except StopIteration:
        pass
    except Exception:
        import traceback
        found["errors"].append(traceback.format_exc())
    (PATH / "answer.json").write_text(json.dumps(found))
    os._exit(0)  # whatever Blender is at


bpy.app.timers.register(tick, first_interval=2.0)
