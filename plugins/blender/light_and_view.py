"""Lamps, cameras and the world of Blender in the terms of the bridge."""

import hashlib
import math

import bpy
import numpy as np

from .lightwell_bridge import colour, sky
from .lightwell_bridge.lamps import Lamp, hue
from .lightwell_bridge.luminaires import Measured
from .lightwell_bridge.views import Camera

_FISHEYES = {"FISHEYE_EQUIDISTANT": "EQUIDISTANT"}


def lamp_of(drawn, scale, efficacy, notes):
    """@param scale  metres in a scene unit"""
    data, settings = drawn.original.data, drawn.original.data.lightwell
    lamp = Lamp(drawn.source.rsplit("/", 1)[-1], data.type, _metres(drawn.matrix, scale), watts=data.energy,
                tint=tuple(data.color), efficacy=efficacy,
                lumens=settings.lumens or data.get("lw_lumens") or drawn.original.get("lw_lumens") or None,
                kelvin=settings.kelvin or data.get("lw_cct") or None)
    if data.type in ("POINT", "SPOT"):
        lamp.radius_m = data.shadow_soft_size * scale
    if data.type == "SPOT":
        lamp.angle_rad, lamp.blend = data.spot_size, data.spot_blend
    if data.type == "SUN":
        lamp.angle_rad = data.angle
    if data.type == "AREA":
        lamp.shape = data.shape
        lamp.size = (data.size, data.size_y if data.shape in ("RECTANGLE", "ELLIPSE") else data.size)
        if data.spread < math.pi - 1e-4:
            notes.append(f"lamp \"{drawn.source}\": a spread of {math.degrees(data.spread):.0f} degrees is not modelled; "
                         "it shines as a diffuse panel")
    return lamp


# Axes of a photometric file in the lamp's frame: plane 0 along -y, as Cycles has it, plane 90 along +x.
FRAME_OF_FILES = np.array([[0.0, 1.0, 0.0, 0.0], [-1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]])


def measured_lamp(lamp, data, folder, notes):
    """The lamp as a photometric file has it, or None when it names none.

    A file in the lamp's Lightwell settings shines as measured. That of an IES texture in its nodes shines as in Cycles: the
    file's candelas times the watts times the texture's strength.
    @throws ValueError, OSError
    """
    path, factor = data.lightwell.ies, 1.0
    if path:
        file = bpy.path.abspath(path, library=data.library)
    else:
        node = _ies_node(data)
        if node is None:
            return None
        file, factor = _file_of(node, data, folder), data.energy * node.inputs["Strength"].default_value
    if lamp.kind == "SUN":
        notes.append(f"lamp \"{lamp.name}\": a sun has no photometric file; {file} is not used")
        return None
    if lamp.kind != "POINT":
        notes.append(f"lamp \"{lamp.name}\": size and cone are those of its photometric file")
    matrix = np.asarray(lamp.matrix, dtype=float) @ FRAME_OF_FILES
    return Measured(lamp.name, file, matrix, lumens=lamp.lumens, factor=factor, colour=colour.of_luminance(hue(lamp), 1.0))


def _ies_node(data):
    nodes = data.node_tree.nodes if data.use_nodes and data.node_tree else ()
    return next((n for n in nodes if n.type == "TEX_IES" and n.outputs[0].is_linked), None)


def _file_of(node, data, folder):
    """A text block of the file becomes a file beside the scene."""
    if node.mode == "EXTERNAL":
        return bpy.path.abspath(node.filepath, library=data.library)
    if node.ies is None:
        raise ValueError(f"lamp \"{data.name}\": its IES texture names no text")
    name = f"luminaires/{hashlib.sha256(node.ies.name.encode()).hexdigest()[:12]}.ies"
    folder.file(name, node.ies.as_string().encode())
    return folder.path / name


def _metres(matrix, scale):
    """Axes and place of a matrix in metres; axes keep their scale, for sizes."""
    rows = [[float(v) * scale for v in row] for row in matrix]
    rows[3] = [0.0, 0.0, 0.0, 1.0]
    return rows


def camera_of(obj, scene, size, notes):
    """The view of a camera object for a picture of `size` pixels.

    @throws ValueError for a kind of camera that the engine does not have
    """
    data, scale = obj.data, scene.unit_settings.scale_length
    camera = Camera("PERSPECTIVE", _metres(obj.matrix_world, scale), *size, lens=data.lens, fit=data.sensor_fit,
                    sensor=data.sensor_height if data.sensor_fit == "VERTICAL" else data.sensor_width,
                    shift=(data.shift_x, data.shift_y), near_m=data.clip_start * scale)
    if data.type == "ORTHO":
        camera.kind, camera.scale_m = "PARALLEL", data.ortho_scale * scale
    elif data.type == "PANO":
        _panorama(obj, camera, notes)
    if data.dof.use_dof and data.type == "PERSP":
        focus = data.dof.focus_distance
        if data.dof.focus_object is not None:
            away = data.dof.focus_object.matrix_world.translation - obj.matrix_world.translation
            focus = abs(away.dot(obj.matrix_world.to_3x3().col[2].normalized()))
        camera.aperture_m = data.lens / 1000 / max(data.dof.aperture_fstop, 0.01)
        camera.focus_m = max(focus * scale, 1e-3)
    if scene.render.pixel_aspect_x != scene.render.pixel_aspect_y:
        notes.append(f"camera \"{obj.name}\": pixels are taken as square")
    return camera


def _panorama(obj, camera, notes):
    settings = obj.data if hasattr(obj.data, "panorama_type") else obj.data.cycles
    kind = settings.panorama_type
    camera.shift = (0.0, 0.0)
    if kind in _FISHEYES:
        camera.kind, camera.fisheye_rad = _FISHEYES[kind], settings.fisheye_fov
    elif kind == "EQUIRECTANGULAR":
        camera.kind, camera.longitude_rad = "CYLINDRICAL", settings.longitude_max - settings.longitude_min
        notes.append(f"camera \"{obj.name}\": an equirectangular panorama becomes a cylindrical one: heights are in "
                     "perspective")
    else:
        raise ValueError(f"camera \"{obj.name}\": there is no view of the kind {kind}; use perspective, orthographic, "
                         "fisheye equidistant or equirectangular")


def add_sky(folder, scene, efficacy, notes):
    """Sun, sky and ground as the scene's settings say; returns whether there is any."""
    settings = scene.lightwell
    if settings.sky == "NONE":
        return False
    if settings.sky == "WORLD":
        return _add_world(folder, scene, efficacy, notes)
    sky.add_sky(folder, sky.Sky(settings.sky, settings.latitude, settings.longitude, settings.time, settings.north,
                                settings.turbidity, settings.ground))
    return True


def _add_world(folder, scene, efficacy, notes):
    world = scene.world
    if world is None:
        return False
    background, strength = tuple(world.color), 1.0
    node = None
    if world.use_nodes and world.node_tree:
        node = next((n for n in world.node_tree.nodes if n.type == "BACKGROUND"), None)
    if node is not None:
        background, strength = tuple(node.inputs["Color"].default_value[:3]), node.inputs["Strength"].default_value
        links = node.inputs["Color"].links
        source = links[0].from_node if links else None
        if source is not None and source.type == "TEX_SKY":
            return _add_sky_texture(folder, source, notes)
        if source is not None:
            notes.append(f"world \"{world.name}\": {source.bl_label} is not read; its colour is taken all around")
    rgb = tuple(c * strength * efficacy / colour.LUMENS_PER_WATT for c in colour.from_rec709(background))
    if max(rgb) <= 0:
        return False
    folder.text(sky.uniform_text(rgb), light=True)
    return True


def _add_sky_texture(folder, node, notes):
    """The direction of its sun, under the clear sky of CIE: its own brightness is no physical one."""
    if node.sky_type == "NISHITA":
        altitude, azimuth = math.degrees(node.sun_elevation), math.degrees(node.sun_rotation)
    else:
        x, y, z = node.sun_direction
        altitude, azimuth = math.degrees(math.asin(max(-1, min(1, z)))), math.degrees(math.atan2(x, y))
    kind = "clear" if node.sky_type != "NISHITA" or node.sun_disc else "clear-no-sun"
    notes.append(f"world: the sky texture's sun (altitude {altitude:.1f}, {azimuth:.1f} degrees clockwise from +Y) under "
                 f"a {kind.replace('-', ' ')} sky after CIE; set place and time for the real one")
    folder.file("sky.rad", sky.sky_text_of_sun(kind, altitude, azimuth).encode())
    folder.text("!xform sky.rad", light=True)
    return True
