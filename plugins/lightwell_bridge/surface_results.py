"""What the engine says of the illuminance of surfaces (`surfaces`), by object and face."""

import json
import math

import numpy as np

from .results import FaceLight, ObjectLight


def read(path, objects):
    """(list of ObjectLight, notes). `objects`: {source: (layer, count of faces)} as they were written.

    @throws ValueError that names the file
    """
    try:
        with open(path, encoding="utf-8") as file:
            parts = json.load(file)["parts"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ValueError(f"{path}: no results of surfaces: {error!r}") from error
    lights, notes = [], []
    for part in parts:
        source = part["part"]
        if source not in objects:
            continue
        layer, count = objects[source]
        faces = [FaceLight(0.0, math.nan, math.nan, math.nan, math.nan) for _ in range(count)]
        for face in part["faces"]:
            if 0 <= face["face"] < count:
                faces[face["face"]] = FaceLight(face["area_m2"], *(_number(face[side][what]) for side in ("front", "back")
                                                                   for what in ("lx", "error_lx")))
        lights.append(ObjectLight(source, layer, faces))
    missing = sorted(set(objects) - {light.source for light in lights})
    if missing:
        notes.append(f"no results for {len(missing)} objects, for example \"{missing[0]}\"")
    return lights, notes


def _number(value):
    return math.nan if value is None else float(value)


def mean_of_drawings(drawings):
    """One value a face for an object that is drawn several times: the mean of the drawings that have one."""
    side = drawings[0].side()
    values = np.array([light.lux(side) for light in drawings])
    known = np.isfinite(values)
    sums = np.where(known, values, 0.0).sum(axis=0)
    return np.where(known.any(axis=0), sums / np.maximum(known.sum(axis=0), 1), np.nan)
