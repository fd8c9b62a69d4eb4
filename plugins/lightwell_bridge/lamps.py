"""Lamps of hosts as emitting surfaces: photometric quantities first, else watts times an efficacy that is shown.

What the watts of a host mean, P: a point or spot has the radiant intensity P/(4 pi) in every direction it lights; an area
has the radiance P/(4 A); a sun gives the irradiance P across its beam.
"""

import math
from dataclasses import dataclass
from typing import Optional

import numpy as np

from . import colour

# A lamp has an extent: shadows have edges. Smaller ones are taken as this.
LEAST_RADIUS_M = 0.001
LEAST_SUN_RAD = math.radians(0.05)
# An ellipse has no name in the language: a polygon, of the same area.
ELLIPSE_CORNERS = 64


@dataclass
class Lamp:
    """`matrix` takes the lamp's own frame (it shines along -z) to the world in metres."""

    name: str
    kind: str  # POINT, SPOT, AREA, SUN
    matrix: object
    watts: float = 0.0  # W; W/m2 of a sun
    tint: tuple = (1.0, 1.0, 1.0)  # linear Rec.709
    kelvin: Optional[float] = None
    lumens: Optional[float] = None  # in place of the watts; lux of a sun
    radius_m: float = 0.0
    angle_rad: float = math.pi  # full cone of a spot, full angle of a sun
    blend: float = 0.0  # soft share of a spot's cone
    shape: str = "RECTANGLE"  # RECTANGLE, DISK of an area
    size: tuple = (1.0, 1.0)  # of an area in its own frame, before the matrix
    efficacy: float = colour.LUMENS_PER_WATT


def add_lamp(folder, lamp, source=None):
    """Adds material and surface; returns (lumens that leave it or lux of a sun, notes)."""
    notes = []
    name = f"{lamp.name}.light"
    make = {"POINT": _add_point, "SPOT": _add_point, "AREA": _add_area, "SUN": _add_sun}[lamp.kind]
    amount = make(folder, lamp, name, source, notes)
    if lamp.lumens is None:
        unit = "lx" if lamp.kind == "SUN" else "lm"
        notes.append(f"lamp \"{lamp.name}\": {lamp.watts:g} {'W/m2' if lamp.kind == 'SUN' else 'W'} at "
                     f"{lamp.efficacy:g} lm/W: {amount:.0f} {unit}")
    return amount, notes


def hue(lamp):
    """Linear Rec.709, of any brightness."""
    if lamp.kelvin is None:
        return lamp.tint
    return tuple(t * c for t, c in zip(lamp.tint, colour.blackbody_hue(lamp.kelvin)))


def _radiance(lamp, per_watt, per_lumen):
    """Engine radiance from what one watt, or one lumen, makes of the lamp's radiance or luminance."""
    if lamp.lumens is not None:
        return colour.of_luminance(hue(lamp), lamp.lumens * per_lumen / colour.LUMENS_PER_WATT)
    scale = lamp.watts * per_watt * lamp.efficacy / colour.LUMENS_PER_WATT
    return tuple(c * scale for c in colour.from_rec709(hue(lamp)))


def _luminance(rgb):
    return colour.luminous(rgb) * colour.LUMENS_PER_WATT


def _add_point(folder, lamp, name, source, notes):
    radius = max(lamp.radius_m, LEAST_RADIUS_M)
    if lamp.radius_m < LEAST_RADIUS_M:
        notes.append(f"lamp \"{lamp.name}\": radius {lamp.radius_m:g} m, taken as {LEAST_RADIUS_M:g} m")
    matrix = np.asarray(lamp.matrix, dtype=float)
    disc = math.pi * radius ** 2  # what a sphere shows in every direction
    cone = 4 * math.pi
    if lamp.kind == "SPOT":
        cone = 2 * math.pi * (1 - math.cos(lamp.angle_rad / 2)) * (1 - lamp.blend / 2)
    rgb = _radiance(lamp, 1 / (4 * math.pi * disc), 1 / (cone * disc))
    if lamp.kind == "SPOT":
        beam = -matrix[:3, 2] / np.linalg.norm(matrix[:3, 2])
        folder.material("brightfunc", f"{lamp.name}.beam", words=(_beam(lamp), "."))
        folder.material("light", name, numbers=rgb, modifier=f"{lamp.name}.beam")
        folder.surface(name, "ring", lamp.name, (*matrix[:3, 3], *beam, 0, radius), source, light=True)
    else:
        folder.material("light", name, numbers=rgb)
        folder.surface(name, "sphere", lamp.name, (*matrix[:3, 3], radius), source, light=True)
    return _luminance(rgb) * disc * cone


def _beam(lamp):
    """Brightness of a disc that has the same intensity all over the cone, and the host's soft edge (a cubic in the
    cosine), as an expression of one word."""
    edge = math.cos(min(lamp.angle_rad, math.radians(179)) / 2)
    soft = (1 - edge) * lamp.blend
    inside = "1"
    if soft > 0:
        part = f"((abs(Rdot)-{edge!r})/{soft!r})"
        inside = f"if(abs(Rdot)-{edge + soft!r},1,{part}*{part}*(3-2*{part}))"
    return f"if(abs(Rdot)-{edge!r},{inside}/abs(Rdot),0)"


def _add_area(folder, lamp, name, source, notes):
    matrix = np.asarray(lamp.matrix, dtype=float)
    across, upwards = matrix[:3, 0] * lamp.size[0] / 2, matrix[:3, 1] * lamp.size[1] / 2
    centre, lengths = matrix[:3, 3], (np.linalg.norm(across), np.linalg.norm(upwards))
    round_shape = lamp.shape in ("DISK", "ELLIPSE")
    area = np.linalg.norm(np.cross(across, upwards)) * (math.pi if round_shape else 4)
    if not area > 0:
        raise ValueError(f"lamp \"{lamp.name}\" has no area: its size or scale is 0; make it larger or hide it")
    rgb = _radiance(lamp, 1 / (4 * area), 1 / (math.pi * area))
    folder.material("light", name, numbers=rgb)
    if round_shape and abs(lengths[0] - lengths[1]) < 1e-6 * max(lengths):
        normal = np.cross(upwards, across)
        folder.surface(name, "ring", lamp.name, (*centre, *(normal / np.linalg.norm(normal)), 0, lengths[0]), source, True)
    else:
        corners = [(-1, -1), (-1, 1), (1, 1), (1, -1)]
        if round_shape:
            turn = 2 * math.pi / ELLIPSE_CORNERS
            wider = math.sqrt(turn / math.sin(turn))
            corners = [(wider * math.cos(i * turn), -wider * math.sin(i * turn)) for i in range(ELLIPSE_CORNERS)]
        if np.dot(np.cross(upwards, across), -matrix[:3, 2]) < 0:
            corners.reverse()  # a mirrored lamp still shines along its -z
        points = [c for x, y in corners for c in centre + x * across + y * upwards]
        folder.surface(name, "polygon", lamp.name, points, source, light=True)
    return _luminance(rgb) * area * math.pi


def _add_sun(folder, lamp, name, source, notes):
    angle = max(lamp.angle_rad, LEAST_SUN_RAD)
    matrix = np.asarray(lamp.matrix, dtype=float)
    to_sun = matrix[:3, 2] / np.linalg.norm(matrix[:3, 2])
    projected = math.pi * math.sin(angle / 2) ** 2
    rgb = _radiance(lamp, 1 / projected, 1 / projected)
    folder.material("light", name, numbers=rgb)
    folder.surface(name, "source", lamp.name, (*to_sun, math.degrees(angle)), source, light=True)
    return _luminance(rgb) * projected
