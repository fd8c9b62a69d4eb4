"""Sensors in rows and columns over faces of any outline."""

from dataclasses import dataclass

import numpy as np

from .ply import transformed

MOST_SENSORS = 1_000_000
# Faces whose normals differ less lie in one plane; sensors lie within the outline by this share of the spacing.
LEVEL = 1 - 1e-6


@dataclass
class Grid:
    """`sensors`: x y z nx ny nz each; `cells`: its number for each of rows x columns, -1 for none.

    corners  (rows + 1) x (columns + 1) points of the cells, in metres, for display
    """

    name: str
    sensors: list
    rows: int
    columns: int
    spacing_m: float
    cells: list
    corners: object


def over_faces(name, mesh, matrix, spacing_m, height_m):
    """Sensors at the middles of square cells over the faces of a flat mesh, above its front.

    @throws ValueError when the faces are not flat, there is no face, or there would be too many sensors
    """
    points = transformed(mesh.vertices, matrix)
    faces = [points[face] for face in mesh.faces()]
    normals = [_normal(face) for face in faces]
    normals = [n for n in normals if n is not None]
    if not normals:
        raise ValueError("there is no face to put sensors over")
    normal = np.sum(normals, axis=0)
    if np.linalg.norm(normal) == 0 or any(n @ normal < LEVEL * np.linalg.norm(normal) for n in normals):
        raise ValueError("its faces do not lie in one plane; give each plane a grid of its own")
    normal /= np.linalg.norm(normal)
    across = _across(normal)
    frame = np.array([across, np.cross(normal, across)])
    flat = [face @ frame.T for face in faces]
    low, high = np.min(np.concatenate(flat), axis=0), np.max(np.concatenate(flat), axis=0)
    columns, rows = (max(1, int(np.ceil(extent / spacing_m - 1e-6))) for extent in high - low)
    if rows * columns > MOST_SENSORS:
        raise ValueError(f"{rows} x {columns} sensors at a spacing of {spacing_m:g} m; at most {MOST_SENSORS}")
    level = faces[0][0] @ normal + height_m
    start = (low + high) / 2 - np.array([columns, rows]) * spacing_m / 2
    x = start[0] + (np.arange(columns) + 0.5) * spacing_m
    y = start[1] + (np.arange(rows) + 0.5) * spacing_m
    centres = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    within = np.zeros(len(centres), dtype=bool)
    for outline in flat:
        within |= inside(centres, outline)
    cells = np.full(len(centres), -1)
    cells[within] = np.arange(int(within.sum()))
    if not within.any():
        raise ValueError(f"no sensor lies over its faces at a spacing of {spacing_m:g} m; choose a smaller one")
    sensors = np.column_stack([centres[within] @ frame + level * normal, np.tile(normal, (int(within.sum()), 1))])
    edges = np.stack(np.meshgrid(start[0] + np.arange(columns + 1) * spacing_m,
                                 start[1] + np.arange(rows + 1) * spacing_m), axis=-1).reshape(-1, 2)
    return Grid(name, sensors.tolist(), rows, columns, spacing_m, cells.tolist(), edges @ frame + level * normal)


def inside(points, outline):
    """Which points lie within an outline (even-odd rule)."""
    result = np.zeros(len(points), dtype=bool)
    for (x0, y0), (x1, y1) in zip(outline, np.roll(outline, -1, axis=0)):
        crosses = (y0 > points[:, 1]) != (y1 > points[:, 1])
        if y0 != y1:
            result ^= crosses & (points[:, 0] < (x1 - x0) * (points[:, 1] - y0) / (y1 - y0) + x0)
    return result


def _normal(face):
    vector = np.sum(np.cross(face - face[0], np.roll(face, -1, axis=0) - face[0]), axis=0)
    length = np.linalg.norm(vector)
    return vector / length if length > 0 else None


def _across(normal):
    """The direction of columns: +x of the world where that is possible."""
    x = np.array([1.0, 0, 0]) if abs(normal[0]) < 0.9 else np.array([0, 1.0, 0])
    x -= normal * (x @ normal)
    return x / np.linalg.norm(x)
