"""Wires of plane faces as corners of polygons. Lengths are in millimetres, as FreeCAD has them."""

import math

import numpy as np

# A circle has at least this many chords, however small it is.
LEAST_CHORDS = 24
# Ends of edges that belong together are this close, mm: ten times OpenCascade's own tolerance.
SAME_POINT_MM = 1e-6


def chords(radius_mm, angle_rad, tolerance_mm):
    """How many chords keep an arc within the tolerance."""
    by_sagitta = math.pi
    if tolerance_mm < radius_mm:
        by_sagitta = 2 * math.acos(1 - tolerance_mm / radius_mm)
    return max(1, math.ceil(angle_rad / min(by_sagitta, 2 * math.pi / LEAST_CHORDS) - 1e-9))


def outline(wire, tolerance_mm):
    """Corners of a closed wire in order, n x 3, the first not repeated.

    Arcs of circles become chords that enclose the same area as the arc: their corners lie outside the circle by two
    thirds of the sagitta, their middles inside by one third.

    @throws ValueError when the wire does not close
    """
    runs = [_points(edge, tolerance_mm) for edge in wire.OrderedEdges if not edge.Degenerated]
    if not runs:
        raise ValueError("a boundary without length")
    corners = list(runs[0])
    if len(runs) > 1 and _gap(corners[-1], runs[1]) > _gap(corners[0], runs[1]):
        corners.reverse()
    for run in runs[1:]:
        if np.linalg.norm(run[0] - corners[-1]) > np.linalg.norm(run[-1] - corners[-1]):
            run = run[::-1]
        if np.linalg.norm(run[0] - corners[-1]) > 1e3 * SAME_POINT_MM:
            raise ValueError("its boundary does not close")
        corners.extend(run[1:])
    if np.linalg.norm(corners[0] - corners[-1]) > 1e3 * SAME_POINT_MM:
        raise ValueError("its boundary does not close")
    return np.array(corners[:-1])


def circle_of(wire):
    """(centre, radius) of a wire that is one whole circle, else None."""
    edges = [e for e in wire.Edges if not e.Degenerated]
    curves = [e.Curve for e in edges]
    if not curves or any(type(c).__name__ != "Circle" for c in curves):
        return None
    centre, radius = curves[0].Center, curves[0].Radius
    if any((c.Center - centre).Length > SAME_POINT_MM or abs(c.Radius - radius) > SAME_POINT_MM for c in curves):
        return None
    turn = sum(e.LastParameter - e.FirstParameter for e in edges)
    return (np.array(centre), radius) if abs(turn - 2 * math.pi) < 1e-9 else None


def joined(outer, holes):
    """One outline: each hole entered and left over a seam that crosses no edge. `outer` turns about `holes` the other way."""
    polygon = [np.asarray(p) for p in outer]
    plane = _plane_axes(np.asarray(outer))
    left = [list(h) for h in holes]
    while left:
        number, i, j = _seam(polygon, left, plane)
        hole = left.pop(number)
        polygon[i + 1:i + 1] = hole[j:] + hole[:j + 1] + [polygon[i]]
    return np.array(polygon)


def turned(corners, normal):
    """The same corners counter-clockwise about the normal."""
    corners = np.asarray(corners)
    return corners if np.dot(vector_area(corners), normal) >= 0 else corners[::-1]


def vector_area(corners):
    rays = corners - corners[0]
    return np.cross(rays[1:-1], rays[2:]).sum(axis=0) / 2


def _points(edge, tolerance_mm):
    """Along the edge, both ends included."""
    first, last, curve = edge.FirstParameter, edge.LastParameter, edge.Curve
    kind = type(curve).__name__
    if kind in ("Line", "LineSegment"):
        return [np.array(edge.valueAt(first)), np.array(edge.valueAt(last))]
    if kind == "Circle":
        return _arc(edge, curve, first, last, tolerance_mm)
    return [np.array(p) for p in edge.discretize(Deflection=tolerance_mm)]


def _arc(edge, circle, first, last, tolerance_mm):
    whole = abs(last - first - 2 * math.pi) < 1e-9
    count = chords(circle.Radius, last - first, tolerance_mm)
    step, centre = (last - first) / count, np.array(circle.Center)
    if whole:
        k = math.sqrt(step / math.sin(step))
    elif count < 3:
        k = 1.0
    else:
        # Corners within are moved out by k, the ends stay: 2 k + (n - 2) k^2 = n step / sin(step).
        inner, wanted = count - 2, count * step / math.sin(step)
        k = (math.sqrt(1 + inner * wanted) - 1) / inner
    points = []
    for i in range(count + 1):
        on_circle = np.array(edge.valueAt(first + i * step))
        moves = whole or 0 < i < count
        points.append(centre + k * (on_circle - centre) if moves else on_circle)
    return points


def _gap(point, run):
    return min(np.linalg.norm(run[0] - point), np.linalg.norm(run[-1] - point))


def _plane_axes(corners):
    normal = vector_area(corners)
    drop = int(np.argmax(np.abs(normal)))
    return [axis for axis in range(3) if axis != drop]


def _seam(polygon, holes, plane):
    """(hole, corner of the polygon, corner of the hole) of the shortest seam that crosses nothing."""
    flat = np.array(polygon)[:, plane]
    rings = [flat] + [np.array(h)[:, plane] for h in holes]
    starts = np.concatenate(rings)
    ends = np.concatenate([np.roll(r, -1, axis=0) for r in rings])
    for number, hole in enumerate(rings[1:]):
        distance = np.linalg.norm(flat[:, None] - hole[None], axis=2)
        for place in np.argsort(distance, axis=None, kind="stable"):
            i, j = np.unravel_index(place, distance.shape)
            if not _crosses(flat[i], hole[j], starts, ends):
                return number, int(i), int(j)
    raise ValueError("a hole that no seam can reach")


def _crosses(a, b, starts, ends):
    """Whether the open segment a b properly crosses one of the others."""
    def side(p, q, r):
        return (q[..., 0] - p[..., 0]) * (r[..., 1] - p[..., 1]) - (q[..., 1] - p[..., 1]) * (r[..., 0] - p[..., 0])
    scale = float(np.abs(b - a).max()) * max(float(np.abs(ends - starts).max()), 1e-300)
    small = 1e-12 * scale
    first, second = side(a, b, starts), side(a, b, ends)
    third, fourth = side(starts, ends, a), side(starts, ends, b)
    return bool(np.any((first * second < -small * small) & (third * fourth < -small * small)))
