"""Curved faces that are no whole cylinder, cone or sphere: plane facets with the surface's own normals."""

import math

import numpy as np

from . import outlines

# Facets of a face are at most this many, so that a tolerance typed wrongly cannot fill the memory.
MOST_FACETS = 500_000


class Facets:
    """Polygons within the tolerance of a face, mm: `normals` has one unit vector a corner."""

    def __init__(self, polygons, normals):
        self.polygons, self.normals = polygons, normals

    def area(self):
        return sum(float(np.linalg.norm(outlines.vector_area(p))) for p in self.polygons)


def box_area(face):
    """Area of the surface over the face's range of parameters, mm2; None for surfaces without a formula here.

    A face as large as that is bounded by lines of constant parameters.
    """
    surface, kind = face.Surface, type(face.Surface).__name__
    u0, u1, v0, v1 = face.ParameterRange
    if kind == "Cylinder":
        return surface.Radius * (u1 - u0) * (v1 - v0)
    if kind == "Cone":
        sine = math.sin(surface.SemiAngle)
        return abs((u1 - u0) * (surface.Radius * (v1 - v0) + sine * (v1 * v1 - v0 * v0) / 2))
    if kind == "Sphere":
        return surface.Radius ** 2 * (u1 - u0) * (math.sin(v1) - math.sin(v0))
    if kind == "Toroid":
        minor = surface.MinorRadius
        return (u1 - u0) * minor * (surface.MajorRadius * (v1 - v0) + minor * (math.sin(v1) - math.sin(v0)))
    return None


def fills_its_box(face):
    box = box_area(face)
    return box is not None and abs(face.Area - box) <= 1e-7 * box


def facets_of(face, tolerance_mm):
    """The face as facets whose area is the face's own, as far as moving corners by the tolerance can make it so."""
    facets = _grid(face, tolerance_mm) if fills_its_box(face) else _triangles(face, tolerance_mm)
    return _with_area(facets, face.Area, tolerance_mm)


def _grid(face, tolerance_mm):
    """Plane quadrilaterals between lines of constant parameters; triangles where one of them is a point."""
    u0, u1, v0, v1 = face.ParameterRange
    surface, kind = face.Surface, type(face.Surface).__name__
    widest = max(float(np.linalg.norm(_at(face, u0, v) - _at(face, u0 + math.pi, v))) / 2 for v in (v0, v1, (v0 + v1) / 2))
    if kind == "Toroid":
        widest = surface.MajorRadius + surface.MinorRadius
    bend = {"Sphere": getattr(surface, "Radius", 0), "Toroid": getattr(surface, "MinorRadius", 0)}.get(kind)
    columns = outlines.chords(widest, u1 - u0, tolerance_mm)
    rows = outlines.chords(bend, v1 - v0, tolerance_mm) if bend else 1
    _check_count(columns * rows)
    us, vs = np.linspace(u0, u1, columns + 1), np.linspace(v0, v1, rows + 1)
    points = [[_at(face, u, v) for v in vs] for u in us]
    normals = [[_normal(face, u, v, (u0 + u1) / 2, (v0 + v1) / 2) for v in vs] for u in us]
    polygons, corner_normals = [], []
    for i in range(columns):
        for j in range(rows):
            ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            corners = np.array([points[a][b] for a, b in ring])
            kept = [k for k in range(4) if np.linalg.norm(corners[k] - corners[k - 1]) > outlines.SAME_POINT_MM]
            _append(polygons, corner_normals, corners[kept], np.array([normals[a][b] for a, b in ring])[kept])
    return Facets(polygons, corner_normals)


def _triangles(face, tolerance_mm):
    points, triangles = face.tessellate(tolerance_mm)
    _check_count(len(triangles))
    u0, u1, v0, v1 = face.ParameterRange
    normals = []
    for point in points:
        u, v = face.Surface.parameter(point)
        normals.append(_normal(face, u, v, (u0 + u1) / 2, (v0 + v1) / 2))
    points, normals = np.array(points), np.array(normals)
    polygons, corner_normals = [], []
    for triangle in triangles:
        _append(polygons, corner_normals, points[list(triangle)], normals[list(triangle)])
    return Facets(polygons, corner_normals)


def _append(polygons, corner_normals, corners, normals):
    """Turns the corners to the side of the normals; leaves out what has no area."""
    if len(corners) < 3:
        return
    area = outlines.vector_area(corners)
    if np.linalg.norm(area) <= outlines.SAME_POINT_MM ** 2:
        return
    step = 1 if np.dot(area, normals.sum(axis=0)) >= 0 else -1
    polygons.append(corners[::step])
    corner_normals.append(normals[::step])


def _with_area(facets, wanted_mm2, tolerance_mm):
    """Moves all corners along their normals by one distance, within the tolerance, so that the area becomes the wanted."""
    def moved(distance):
        return Facets([p + distance * n for p, n in zip(facets.polygons, facets.normals)], facets.normals)

    probe = tolerance_mm / 2
    area, distance = facets.area(), 0.0
    slope = (moved(probe).area() - area) / probe
    for _ in range(4):
        if slope == 0 or abs(area - wanted_mm2) <= 1e-12 * wanted_mm2:
            break
        distance += (wanted_mm2 - area) / slope
        if not abs(distance) <= tolerance_mm:
            return facets
        area = moved(distance).area()
    return moved(distance)


def _check_count(count):
    if count > MOST_FACETS:
        raise ValueError(f"{count} facets, at most {MOST_FACETS}: raise the chord tolerance")


def _at(face, u, v):
    return np.array(face.valueAt(u, v))


def _normal(face, u, v, middle_u, middle_v):
    """Unit normal out of the face; at a pole, of a point beside it."""
    for nudge in (0.0, 1e-6):
        try:
            normal = np.array(face.normalAt(u + nudge * (middle_u - u), v + nudge * (middle_v - v)))
        except Exception:  # OpenCascade has no normal at poles; the type of its error differs between versions
            continue
        length = np.linalg.norm(normal)
        if length > 0.5:
            return normal / length
    raise ValueError("a point without a normal")
