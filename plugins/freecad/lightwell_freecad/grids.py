"""Sensor grids on plane faces."""

import math

import numpy as np

from .faces import METRES_PER_MM

# More sensors than this is a spacing typed in the wrong unit.
MOST_SENSORS = 1_000_000


class Grid:
    """Sensors at the centres of square cells, metres; row 0 is the highest along the plane's second axis, as in maps.

    cells   rows x columns numbers of sensors, -1 where a cell's centre is off the face
    frame   upper left corner of the cells, the direction of columns, the direction of rows (down)
    owner   name of the document object it lies on
    """

    def __init__(self, name, owner, rows, columns, spacing_m, sensors, cells, frame):
        self.name, self.owner, self.rows, self.columns, self.spacing_m = name, owner, rows, columns, spacing_m
        self.sensors, self.cells, self.frame = sensors, cells, frame

    def facts(self):
        origin, along, down = self.frame
        return {"owner": self.owner, "rows": self.rows, "columns": self.columns, "spacing_m": self.spacing_m,
                "cells": self.cells, "origin": list(origin), "along": list(along), "down": list(down),
                "sensors": [list(s[:3]) for s in self.sensors]}


def of_face(placed, spacing_mm):
    """The grid over the first plane face of an object that is marked as a sensor plane."""
    shape = placed.shape()
    shape.transformShape(_freecad_matrix(placed.matrix))
    flat = [f for f in shape.Faces if type(f.Surface).__name__ == "Plane"]
    if not flat:
        raise ValueError("a sensor plane needs a plane face")
    return on_plane_face(flat[0], placed.owner.Label, placed.owner.Name, spacing_mm)


def on_plane_face(face, name, owner, spacing_mm, offset_mm=0.0):
    """Sensors over a plane face, `offset_mm` in front of it, facing its front."""
    if not (math.isfinite(spacing_mm) and spacing_mm > 0):
        raise ValueError(f"its spacing is {spacing_mm} mm, expected more than 0")
    u0, u1, v0, v1 = face.ParameterRange
    normal = np.array(face.normalAt((u0 + u1) / 2, (v0 + v1) / 2))
    along, up = _axes(normal)
    corners = np.array([tuple(v.Point) for v in face.Vertexes] + [tuple(p) for e in face.Edges for p in e.discretize(24)])
    ends = [(float((corners @ axis).min()), float((corners @ axis).max())) for axis in (along, up)]
    columns, rows = (max(1, math.floor((high - low) / spacing_mm + 1e-9)) for low, high in ends)
    if rows * columns > MOST_SENSORS:
        raise ValueError(f"{rows} x {columns} sensors, at most {MOST_SENSORS}: its spacing is {spacing_mm} mm")
    depth = float(corners[0] @ normal)
    starts = [(low + high - n * spacing_mm) / 2 for (low, high), n in zip(ends, (columns, rows))]
    sensors, cells = [], []
    point_type = type(face.Vertexes[0].Point)
    for row in range(rows):
        for column in range(columns):
            place = (along * (starts[0] + (column + 0.5) * spacing_mm) + up * (starts[1] + (rows - row - 0.5) * spacing_mm) +
                     normal * depth)
            if not face.isInside(point_type(*place), 1e-4, True):
                cells.append(-1)
                continue
            cells.append(len(sensors))
            sensors.append([*((place + normal * offset_mm) * METRES_PER_MM), *normal])
    if not sensors:
        raise ValueError(f"no sensor fits on it at a spacing of {spacing_mm} mm")
    top = starts[1] + rows * spacing_mm
    origin = (along * starts[0] + up * top + normal * (depth + offset_mm)) * METRES_PER_MM
    return Grid(name, owner, rows, columns, spacing_mm * METRES_PER_MM, sensors, cells, (origin, along, -up))


def _axes(normal):
    """Two axes of the plane: level faces have x and y."""
    helper = np.array([1.0, 0, 0]) if abs(normal[0]) < 0.9 else np.array([0, 1.0, 0])
    if abs(normal[2]) < 0.9:
        helper = np.cross([0, 0, 1.0], normal)
    along = helper - normal * (helper @ normal)
    along /= np.linalg.norm(along)
    return along, np.cross(normal, along)


def _freecad_matrix(matrix):
    import FreeCAD
    return FreeCAD.Matrix(*[float(v) for v in matrix.reshape(-1)])
