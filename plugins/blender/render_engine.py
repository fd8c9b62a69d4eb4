"""The render engine: final pictures with their passes, and the viewport."""

import time
import traceback

import bpy
import numpy as np

from . import library_materials, session
from .exporter import Exporter, Stopped
from .lightwell_bridge import exr
from .lightwell_bridge.client import sentence_of
from .viewport import Viewport

# Passes beside Combined: name, channels, kind for the compositor.
PASSES = (("Illuminance", "X", "VALUE"), ("Luminance", "X", "VALUE"), ("Error", "X", "VALUE"),
          ("ObjectLayer", "X", "VALUE"))
# Each word on the progress makes Blender draw, and keys wait for that.
SECONDS_BETWEEN_WORDS = 0.5
_BUILT_IN = (("Depth", "Z", "VALUE", "use_pass_z"), ("Normal", "XYZ", "VECTOR", "use_pass_normal"))


class LightwellEngine(bpy.types.RenderEngine):
    bl_idname = "LIGHTWELL"
    bl_label = "Lightwell"
    bl_use_preview = False
    bl_use_eevee_viewport = True
    bl_use_shading_nodes_custom = False
    _viewport = None

    # An exception that leaves one of these functions can end Blender: each ends in a sentence here.

    def render(self, depsgraph):
        try:
            self._render(depsgraph)
        except Stopped:
            pass
        except Exception as error:  # the edge to the host
            if not (self.test_break() and isinstance(error, session.EngineError)):
                self._complain(error)

    def view_update(self, context, depsgraph):
        try:
            if self._viewport is None:
                self._viewport = Viewport(self)
            self._viewport.update(context, depsgraph)
        except Exception as error:  # the edge to the host
            self._complain(error)

    def view_draw(self, context, depsgraph):
        try:
            if self._viewport is not None:
                self._viewport.draw(context, depsgraph)
        except Exception as error:  # the edge to the host
            self._complain(error)

    def __del__(self):
        try:
            if self._viewport is not None:
                self._viewport.close()
        except ReferenceError:
            pass  # Blender ends, and the engine's process with it

    def update_render_passes(self, scene=None, renderlayer=None):
        self.register_pass(scene, renderlayer, "Combined", 4, "RGBA", "COLOR")
        for name, channels, kind in PASSES:
            self.register_pass(scene, renderlayer, name, len(channels), channels, kind)
        for name, channels, kind, wanted in _BUILT_IN:
            if getattr(renderlayer, wanted):
                self.register_pass(scene, renderlayer, name, len(channels), channels, kind)

    # --- a final picture

    def _complain(self, error):
        if not isinstance(error, (session.EngineError, ValueError, OSError)):
            traceback.print_exc()
        self.report({"ERROR"}, f"Lightwell: {error}")
        self.update_stats("Lightwell", str(error))

    def _render(self, depsgraph):
        scene, layer = depsgraph.scene, depsgraph.view_layer_eval
        scale = scene.render.resolution_percentage / 100
        size = [max(1, int(scene.render.resolution_x * scale)), max(1, int(scene.render.resolution_y * scale))]
        if scene.camera is None:
            raise ValueError("the scene has no camera; add one or make one active")
        kept = session.session("render")
        self.update_stats("Lightwell", "writing the scene")
        library_materials.known(session.engine_path())
        exported = Exporter(depsgraph, kept.folder(), size, self.test_break).export()
        self._tell(exported.notes)
        if scene.camera.name not in exported.views:
            raise ValueError(f"camera \"{scene.camera.name}\" has no view that the engine knows; see the notes above")
        kept.start(exported.scene_file, self.test_break)
        region = _region(scene.render, size)
        request = dict(session.effort(scene.lightwell), view=exported.views[scene.camera.name], size=size, region=region,
                       layer=layer.name, file=str(kept.folder() / "picture.exr"), progressive=True)
        if scene.lightwell.keep_light and self.is_animation:
            request["ambient_file"] = str(session.kept_light(exported.scene_file))
        self._collect(kept.client, request, layer, [region[2] - region[0], region[3] - region[1]])

    def _tell(self, notes):
        for note in notes:
            print(f"Lightwell: {note}")
        if notes:
            self.report({"INFO"}, f"Lightwell: {len(notes)} notes on the scene, in the console: {notes[0]}")

    def _collect(self, client, request, layer, size):
        told = 0
        for event in client.events(client.send("render", **request), self.test_break, leave=True):
            kind = event["event"]
            if kind == "progress":
                if time.monotonic() - told >= SECONDS_BETWEEN_WORDS:
                    told = time.monotonic()
                    self._tell_progress(event)
            elif kind == "partial":
                self._show(event["file"], layer, size)
            elif kind == "result":
                self._show(event["file"], layer, size)
                self._tell([_text(note) for note in event.get("notes", ())])
                if isinstance(event.get("error"), (int, float)):
                    self.update_stats("Lightwell", f"median standard error {event['error']:.1%}")
            elif kind == "error":
                raise session.EngineError(sentence_of(event))

    def _tell_progress(self, event):
        self.update_progress(min(max(float(event.get("fraction", 0)), 0), 1))
        left = event.get("seconds_left")
        self.update_stats("Lightwell", str(event.get("phase", "")) +
                          (f", {left:.0f} s left" if isinstance(left, (int, float)) else ""))

    def _check(self):
        """@throws Stopped"""
        if self.test_break():
            raise Stopped

    def _show(self, file, layer, size):
        """Puts a picture file into the render result, pass by pass: Blender's own reader takes a second for a large one
        and cannot be stopped. An exception between begin and end would end Blender.

        @throws Stopped
        """
        problem = exr.check_for_layer(file, layer.name, size)
        if problem:
            raise ValueError(problem)
        for name, channels, _ in PASSES:
            self.add_pass(name, len(channels), channels, layer=layer.name)
        _, picture = exr.read(file, check=self._check)
        result, whole = self.begin_result(0, 0, *size), False
        try:
            for render_pass in next(l for l in result.layers if l.name == layer.name).passes:
                self._check()
                _fill(render_pass, [picture.get(f"{layer.name}.{render_pass.name}.{c}") for c in render_pass.channel_id])
            self._check()
            whole = True
        finally:
            self.end_result(result, cancel=not whole)


def _fill(render_pass, channels):
    """Rows of a pass come from below; one that the picture does not have stays black."""
    if any(channel is None for channel in channels):
        return
    height, width = channels[0].shape
    pixels = np.empty((height, width, len(channels)), dtype=np.float32)
    for i, channel in enumerate(channels):
        pixels[:, :, i] = channel[::-1]
    # Numbers of several channels are wanted in two dimensions, single ones in one.
    render_pass.rect.foreach_set(pixels.reshape(-1, len(channels)) if len(channels) > 1 else pixels.reshape(-1))


def _text(note):
    return note if isinstance(note, str) else str(note.get("text", note))


def _region(render, size):
    """Columns and rows of the border, row 0 at the top; the whole picture without one."""
    if not render.use_border:
        return [0, 0, *size]
    low_x, high_x, low_y, high_y = (int(np.float32(share) * extent) for share, extent in (
        (render.border_min_x, size[0]), (render.border_max_x, size[0]), (render.border_min_y, size[1]),
        (render.border_max_y, size[1])))
    return [low_x, size[1] - high_y, max(high_x, low_x + 1), max(size[1] - low_y, size[1] - high_y + 1)]


def _panels():
    """Panels of Blender that make sense with this engine too."""
    left_out = {"VIEWLAYER_PT_filter", "VIEWLAYER_PT_layer_passes", "RENDER_PT_simplify"}
    for panel in bpy.types.Panel.__subclasses__():
        engines = getattr(panel, "COMPAT_ENGINES", ())
        if "BLENDER_RENDER" in engines and panel.__name__ not in left_out:
            yield panel


def register():
    bpy.utils.register_class(LightwellEngine)
    for panel in _panels():
        panel.COMPAT_ENGINES.add("LIGHTWELL")


def unregister():
    for panel in _panels():
        panel.COMPAT_ENGINES.discard("LIGHTWELL")
    bpy.utils.unregister_class(LightwellEngine)
