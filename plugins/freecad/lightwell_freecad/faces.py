"""Faces of a shape as surfaces of the scene language: by their geometry, without meshing what needs no mesh.

    plane                               one polygon, holes entered over seams; a disc or annulus: `ring`
    whole cylinder, cone, sphere        `cylinder`/`tube`, `cone`/`cup`, `sphere`/`bubble` (out / in)
    everything else                     facets within the chord tolerance, with the surface's normals
"""

import numpy as np

from . import curved, outlines

METRES_PER_MM = 1e-3


class Surface:
    """One face.

    index     of the face in its shape
    kind      polygon, ring, cylinder, tube, cone, cup, sphere, bubble or facets
    numbers   what the scene language wants, metres; of a polygon its corners, n x 3
    facets    of kind facets: corners of each, n x 3, metres, and `normals`
    area_m2   of the face; exported_m2 of what stands for it
    """

    def __init__(self, index, kind, area_m2, exported_m2, numbers=None, facets=None, normals=None):
        self.index, self.kind, self.area_m2, self.exported_m2 = index, kind, area_m2, exported_m2
        self.numbers, self.facets, self.normals = numbers, facets, normals


def surfaces_of(shape, tolerance_mm, failed=lambda index, why: None):
    """The faces of a shape in order; `failed` hears of each that cannot be translated, and it is left out."""
    found = []
    for index, face in enumerate(shape.Faces):
        try:
            found.append(surface_of(face, index, tolerance_mm))
        except Exception as error:  # one broken face must not take the model with it: it is named and left out
            failed(index, str(error) or type(error).__name__)
    return found


def surface_of(face, index, tolerance_mm):
    if not face.Area > outlines.SAME_POINT_MM ** 2:
        raise ValueError("it has no area")
    kind = type(face.Surface).__name__
    if kind == "Plane":
        return _plane(face, index, tolerance_mm)
    if kind in ("Cylinder", "Cone", "Sphere") and curved.fills_its_box(face):
        whole = _whole(face, index, kind)
        if whole:
            return whole
    if kind not in ("Cylinder", "Cone", "Sphere", "Toroid") and _is_flat(face):
        return _plane(face, index, tolerance_mm)
    facets = curved.facets_of(face, tolerance_mm)
    return Surface(index, "facets", face.Area * 1e-6, facets.area() * 1e-6,
                   facets=[p * METRES_PER_MM for p in facets.polygons], normals=facets.normals)


def _is_flat(face):
    try:
        return face.findPlane(1e-7) is not None
    except Exception:  # no plane: some versions say so by an error
        return False


def _plane(face, index, tolerance_mm):
    u0, u1, v0, v1 = face.ParameterRange
    normal = np.array(face.normalAt((u0 + u1) / 2, (v0 + v1) / 2))
    ring = _ring(face, normal)
    if ring:
        return Surface(index, "ring", face.Area * 1e-6, np.pi * (ring[7] ** 2 - ring[6] ** 2), ring)
    outer = face.OuterWire
    holes = [w for w in face.Wires if not w.isSame(outer)]
    corners = outlines.turned(outlines.outline(outer, tolerance_mm), normal)
    inner = [outlines.turned(outlines.outline(w, tolerance_mm), -normal) for w in holes]
    polygon = outlines.joined(corners, inner) if inner else corners
    area = float(np.linalg.norm(outlines.vector_area(polygon)))
    return Surface(index, "polygon", face.Area * 1e-6, area * 1e-6, polygon * METRES_PER_MM)


def _ring(face, normal):
    circles = [outlines.circle_of(w) for w in face.Wires]
    if not 1 <= len(circles) <= 2 or any(c is None for c in circles):
        return None
    circles.sort(key=lambda c: c[1])
    if len(circles) == 2 and np.linalg.norm(circles[0][0] - circles[1][0]) > outlines.SAME_POINT_MM:
        return None
    inner = circles[0][1] if len(circles) == 2 else 0.0
    return [*(circles[-1][0] * METRES_PER_MM), *normal, inner * METRES_PER_MM, circles[-1][1] * METRES_PER_MM]


def _whole(face, index, kind):
    """The native surface when the face goes all the way round (a sphere: pole to pole), else None."""
    u0, u1, v0, v1 = face.ParameterRange
    if abs(u1 - u0 - 2 * np.pi) > 1e-9 or (kind == "Sphere" and abs(v1 - v0 - np.pi) > 1e-9):
        return None
    centres, radii = [], []
    for v in (v0, v1):
        one, other = np.array(face.valueAt(u0, v)), np.array(face.valueAt(u0 + np.pi, v))
        centres.append((one + other) / 2 * METRES_PER_MM)
        radii.append(float(np.linalg.norm(one - other)) / 2 * METRES_PER_MM)
    middle_u, middle_v = (u0 + u1) / 2, (v0 + v1) / 2
    centre = (np.array(face.valueAt(u0, middle_v)) + np.array(face.valueAt(u0 + np.pi, middle_v))) / 2
    outward = np.dot(face.normalAt(middle_u, middle_v), np.array(face.valueAt(middle_u, middle_v)) - centre) > 0
    if kind == "Sphere":
        radius = face.Surface.Radius * METRES_PER_MM
        centre = np.array(face.Surface.Center) * METRES_PER_MM
        return Surface(index, "sphere" if outward else "bubble", face.Area * 1e-6, 4 * np.pi * radius ** 2, [*centre, radius])
    length = float(np.linalg.norm(centres[1] - centres[0]))
    area = np.pi * (radii[0] + radii[1]) * float(np.hypot(length, radii[1] - radii[0]))
    if kind == "Cylinder":
        return Surface(index, "cylinder" if outward else "tube", face.Area * 1e-6, area, [*centres[0], *centres[1], radii[0]])
    return Surface(index, "cone" if outward else "cup", face.Area * 1e-6, area, [*centres[0], *centres[1], *radii])
