"""Where the light of a measured luminaire leaves the object that a document draws for it."""

import itertools
import pathlib

import numpy as np

from .faces import METRES_PER_MM

# Faces of a panel look the same way, but for rounding.
SAME_WAY = 1e-6


def file_of(owner):
    """Path of its photometric file; relative ones count from the document's folder."""
    file = pathlib.Path(owner.lw_ies)
    document = pathlib.Path(owner.Document.FileName)
    return file if file.is_absolute() or not owner.Document.FileName else document.parent / file


def place_of(one):
    """(4 x 4 matrix in metres, size of the body in metres along its axes).

    The light goes where a panel's faces look, else along the object's own -z; plane 0 of the file looks along the object's
    x axis. The origin is the middle of the object.
    """
    low, high, aim = _extent(one)
    axes = one.matrix[:3, :3] @ _frame(aim)
    axes = axes / np.linalg.norm(axes, axis=0)
    corners = np.array(list(itertools.product(*zip(low, high))))
    corners = corners @ one.matrix[:3, :3].T + one.matrix[:3, 3]
    within = corners @ axes
    middle = axes @ (within.min(axis=0) + within.max(axis=0)) / 2
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = axes, middle * METRES_PER_MM
    return matrix, tuple(float(v) for v in np.ptp(within, axis=0) * METRES_PER_MM)


def _extent(one):
    """Bounds of the leaf in its own coordinates, and where its light goes there."""
    down = np.array([0.0, 0.0, -1.0])
    if one.is_mesh():
        points, _ = one.mesh()
        return points.min(axis=0), points.max(axis=0), down
    shape = one.shape()
    box = shape.BoundBox
    normals = [tuple(f.normalAt(0, 0)) for f in shape.Faces if type(f.Surface).__name__ == "Plane"]
    flat = len(normals) == len(shape.Faces) and all(np.dot(normals[0], n) > 1 - SAME_WAY for n in normals)
    return ((box.XMin, box.YMin, box.ZMin), (box.XMax, box.YMax, box.ZMax),
            np.array(normals[0]) if flat else down)


def _frame(aim):
    """Columns: x as near to the object's as can be, y, and up against the light."""
    up = -aim / np.linalg.norm(aim)
    along = next(a for a in np.eye(3) if abs(np.dot(a, up)) < 0.9)
    across = along - up * np.dot(up, along)
    across = across / np.linalg.norm(across)
    return np.column_stack([across, np.cross(up, across), up])
