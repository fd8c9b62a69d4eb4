"""The legend of the false colours in every 3D view while results are shown."""

import bpy
import gpu
import numpy as np

from . import show_results

_handle = None
_textures = {}  # by name and size of the image: what was drawn last
MARGIN = 16


def _draw():
    context = bpy.context
    image = bpy.data.images.get(show_results.LEGEND)
    if image is None or not show_results.shown(context.scene) or image.size[0] == 0:
        _textures.clear()
        return
    from gpu_extras.presets import draw_texture_2d
    width, height = image.size
    key = (image.as_pointer(), context.scene[show_results.STATE])
    if key not in _textures:
        _textures.clear()
        pixels = np.zeros(width * height * 4, dtype=np.float32)
        image.pixels.foreach_get(pixels)
        # Blender encodes what is drawn here once more; the image holds encoded values.
        pixels = np.where(pixels <= 0.04045, pixels / 12.92, ((pixels + 0.055) / 1.055) ** 2.4).astype(np.float32)
        data = gpu.types.Buffer("FLOAT", len(pixels), pixels)
        _textures[key] = gpu.types.GPUTexture((width, height), format="RGBA16F", data=data)
    scale = min(0.6, (context.region.height - 2 * MARGIN) / height)
    place = (context.region.width - width * scale - MARGIN, MARGIN)
    gpu.state.blend_set("ALPHA")
    draw_texture_2d(_textures[key], place, width * scale, height * scale)
    gpu.state.blend_set("NONE")


def register():
    global _handle
    if not bpy.app.background:
        _handle = bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_PIXEL")


def unregister():
    global _handle
    if _handle is not None:
        bpy.types.SpaceView3D.draw_handler_remove(_handle, "WINDOW")
        _handle = None
    _textures.clear()
