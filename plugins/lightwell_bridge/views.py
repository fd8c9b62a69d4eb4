"""Cameras as views in the words of the scene language."""

import math
from dataclasses import dataclass
from typing import Optional

import numpy as np

from .scene_folder import number

WIDEST_CYLINDER_UP = math.radians(150)


@dataclass
class Camera:
    """Looks along -z of `matrix`, up is +y; lengths in metres, angles in radians.

    fit: which side of the picture `sensor` measures: HORIZONTAL, VERTICAL, or AUTO, the longer one
    shift: of the picture's centre, in units of that side
    """

    kind: str  # PERSPECTIVE, PARALLEL, EQUIDISTANT, CYLINDRICAL
    matrix: object
    width: int
    height: int
    lens: float = 50.0
    sensor: float = 36.0
    fit: str = "AUTO"
    shift: tuple = (0.0, 0.0)
    scale_m: float = 6.0  # side of a parallel view
    fisheye_rad: float = math.pi
    longitude_rad: float = 2 * math.pi
    latitude_rad: float = math.pi
    near_m: float = 0.0
    aperture_m: float = 0.0  # diameter of the lens
    focus_m: Optional[float] = None


def view_words(camera):
    """The words of a view whose picture has square pixels and the camera's size."""
    matrix = np.asarray(camera.matrix, dtype=float)
    forward, up = -matrix[:3, 2], matrix[:3, 1]
    forward, up = forward / np.linalg.norm(forward), up / np.linalg.norm(up)
    letter, horizontal, vertical = _extent(camera)
    side = camera.width if _fits_width(camera) else camera.height
    words = [f"-vt{letter}", "-vp", *matrix[:3, 3], "-vd", *forward, "-vu", *up, "-vh", horizontal, "-vv", vertical]
    for word, amount, across in (("-vs", camera.shift[0], camera.width), ("-vl", camera.shift[1], camera.height)):
        if amount:
            words += [word, amount * side / across]
    if camera.near_m > 0:
        words += ["-vo", camera.near_m]
    if camera.aperture_m > 0:
        words += ["-pd", camera.aperture_m, "-pf", camera.focus_m or 1.0]
    return " ".join(word if isinstance(word, str) else number(word) for word in words)


def _fits_width(camera):
    return camera.fit == "HORIZONTAL" or (camera.fit == "AUTO" and camera.width >= camera.height)


def _extent(camera):
    """The letter of the view and its two extents: degrees, or metres of a parallel view."""
    aspect = camera.width / camera.height
    if camera.kind == "EQUIDISTANT":
        # The circle of the angle fits the shorter side; pixels stay square.
        angle = math.degrees(camera.fisheye_rad)
        return "a", min(angle * max(aspect, 1), 360.0), min(angle * max(1 / aspect, 1), 360.0)
    if camera.kind == "CYLINDRICAL":
        return _cylinder(camera, aspect)
    across, upwards = (1.0, 1 / aspect) if _fits_width(camera) else (aspect, 1.0)
    if camera.kind == "PARALLEL":
        return "l", across * camera.scale_m, upwards * camera.scale_m
    half = camera.sensor / (2 * camera.lens)
    return "v", *(math.degrees(2 * math.atan(half * side)) for side in (across, upwards))


def _cylinder(camera, aspect):
    longitude = camera.longitude_rad
    return "c", math.degrees(longitude), math.degrees(min(2 * math.atan(longitude / (2 * aspect)), WIDEST_CYLINDER_UP))
