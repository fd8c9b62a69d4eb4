"""The picture in the viewport: gets better while one looks, starts again when something changes."""

import math
import time
import weakref

import gpu
import numpy as np

from . import library_materials, session
from .exporter import Exporter
from .lightwell_bridge import exr
from .lightwell_bridge.client import FINAL, sentence_of
from .lightwell_bridge.scene_folder import number

LAYER = "Viewport"
# The viewports that are open, for those who want to know how they fare.
LIVE = weakref.WeakSet()
# The first pictures are small and coarse: something is there at once. Each is (divisor of the size, accuracy).
FIRST = ((6, 0.4), (2, 0.4))
# A view that is still being turned is not begun anew before it has rested this long.
SECONDS_OF_REST = 0.15


class Viewport:
    """update() takes the scene over, draw() shows the newest picture and asks for what is missing."""

    def __init__(self, engine):
        self._engine, self._name = engine, f"viewport-{id(self):x}"
        self._session = session.session(self._name)
        self._dirty, self._view, self._asked = True, None, None
        self._request, self._texture, self._changed, self._level = None, None, time.monotonic(), 0
        self._wish = {}
        self._cancelled, self.stop_seconds = {}, []  # when each was told to stop; until the engine said so
        self.failure, self.shown = None, 0  # pictures
        LIVE.add(self)

    def busy(self):
        """Whether a picture is still getting better."""
        return self._request is not None

    def update(self, context, depsgraph):
        """The scene has changed: what is under way is of no use any more."""
        self._stop()
        self.failure = None
        library_materials.known(session.engine_path())
        exported = Exporter(depsgraph, self._session.folder(), (context.region.width, context.region.height)).export()
        self._session.start(exported.scene_file)
        self._session.client.listener = self._wake
        self._asked = None

    def draw(self, context, depsgraph):
        size = (context.region.width, context.region.height)
        view = view_words(context.region_data, depsgraph.scene.unit_settings.scale_length)
        if (view, size) != self._view:
            self._view, self._changed = (view, size), time.monotonic()
            self._stop()
        self._collect()
        if self._asked != self._view and self.failure is None:
            if time.monotonic() - self._changed >= SECONDS_OF_REST or self._asked is None:
                self._wish = session.effort(depsgraph.scene.lightwell)
                self._level = 0
                self._ask()
            else:
                self._engine.tag_redraw()
        if self._texture is not None:
            self._paint(context, depsgraph.scene, size)

    def close(self):
        session.close(self._name)

    def _wake(self):
        try:
            self._engine.tag_redraw()
        except ReferenceError:
            pass  # the viewport is gone

    def _ask(self):
        """Asks for the picture of the present level: the coarse ones, then the one that was wished for."""
        view, size = self._view
        client = self._session.client
        if client is None:
            return
        divisor, wish = 1, dict(self._wish, progressive=True)
        if self._level < len(FIRST):
            divisor, accuracy = FIRST[self._level]
            wish = {"accuracy": accuracy, "seed": self._wish["seed"]}
        self._request = client.send("render", view=view, size=[max(side // divisor, 1) for side in size], layer=LAYER,
                                    file=str(self._session.folder() / "view.exr"), **wish)
        self._asked = self._view

    def _stop(self):
        if self._request is not None and self._session.client is not None:
            self._session.client.cancel(self._request)
            self._cancelled[self._request] = time.monotonic()
        self._request, self._asked = None, None

    def _collect(self):
        """Takes all that has come; only the newest picture is read."""
        client, newest = self._session.client, None
        if client is None:
            return
        for old, told in list(self._cancelled.items()):
            while (event := client.next_event(old)) is not None:
                if event["event"] in FINAL:
                    self.stop_seconds.append(event["arrived"] - told)
                    del self._cancelled[old]
                    break
        while self._request is not None and (event := client.next_event(self._request)) is not None:
            if event["event"] in ("partial", "result"):
                newest = event
            elif event["event"] == "progress":
                self._engine.update_progress(min(max(float(event.get("fraction", 0)), 0), 1))
            elif event["event"] == "error":
                self.failure = sentence_of(event)
                self._engine.update_stats("Lightwell", self.failure)
            if event["event"] in FINAL:
                self._request = None
        if self._request is None and newest is not None and self._level < len(FIRST):
            self._level += 1
            self._load(newest["file"])
            self._ask()
            return
        if newest is not None:
            self._load(newest["file"])
            error = newest.get("error")
            text = "done" if newest["event"] == "result" else f"{newest.get('samples', '?')} samples"
            self._engine.update_stats("Lightwell", text + (f", error {error:.1%}" if isinstance(error, float) else ""))

    def _load(self, file):
        _, picture = exr.read(file, [f"{LAYER}.Combined.{c}" for c in "RGBA"])
        pixels = np.stack([picture[f"{LAYER}.Combined.{c}"] for c in "RGBA"], axis=-1)[::-1]
        height, width = pixels.shape[:2]
        data = gpu.types.Buffer("FLOAT", width * height * 4, np.ascontiguousarray(pixels, dtype=np.float32).reshape(-1))
        self.shown += 1
        self._texture = gpu.types.GPUTexture((width, height), format="RGBA16F", data=data)

    def _paint(self, context, scene, size):
        from gpu_extras.presets import draw_texture_2d
        gpu.state.blend_set("ALPHA_PREMULT")
        self._engine.bind_display_space_shader(scene)
        draw_texture_2d(self._texture, (0, 0), *size)
        self._engine.unbind_display_space_shader()
        gpu.state.blend_set("NONE")


def view_words(region, scale):
    """What a 3D viewport shows, from its matrices: perspective, parallel, or through a camera with its shift."""
    place, lens = region.view_matrix.inverted(), region.window_matrix
    position, up = place.translation * scale, place.to_3x3().col[1].normalized()
    forward = -place.to_3x3().col[2].normalized()
    if region.is_perspective:
        letter, shift = "v", (lens[0][2] / 2, lens[1][2] / 2)
        extent = [math.degrees(2 * math.atan(1 / lens[i][i])) for i in (0, 1)]
    else:
        letter, shift = "l", (-lens[0][3] / 2, -lens[1][3] / 2)
        extent = [2 * scale / lens[i][i] for i in (0, 1)]
        # Blender draws a parallel view from far behind its pivot.
        position = position - forward * region.view_distance * scale * 10
    words = [f"-vt{letter} -vp", *position, "-vd", *forward, "-vu", *up, "-vh", extent[0], "-vv", extent[1],
             "-vs", shift[0], "-vl", shift[1]]
    return " ".join(word if isinstance(word, str) else number(word) for word in words)
