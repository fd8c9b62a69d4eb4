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
        lights = [ObjectLight(part["object"], objects[part["object"]][0], _faces_of(part, objects[part["object"]][1]))
                  for part in parts if part["object"] in objects]
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise ValueError(f"{path}: no results of surfaces: {error!r}") from error
    notes = []
    missing = sorted(set(objects) - {light.source for light in lights})
    if missing:
        notes.append(f"no results for {len(missing)} objects, for example \"{missing[0]}\"")
    return lights, notes


def _faces_of(part, count):
    """One entry a face as written; a limit surface has one value for all of its cage, kept with the first face."""
    faces = [FaceLight(0.0, math.nan, math.nan, math.nan, math.nan) for _ in range(count)]
    for face in part["faces"]:
        if 0 <= face.get("face", -1) < count:
            faces[face["face"]] = _light(face)
    if all(face.area == 0 for face in faces):
        whole = _light(part)
        faces = [FaceLight(0.0, whole.front, 0.0, whole.back, 0.0) for _ in range(count)]
        faces[:1] = [whole]
    return faces


def _light(entry):
    return FaceLight(*(float(entry[name]) for name in ("area_m2", "front", "front_error", "back", "back_error")))


def mean_of_drawings(drawings):
    """One value a face for an object that is drawn several times: the mean of the drawings that have one."""
    side = drawings[0].side()
    values = np.array([light.lux(side) for light in drawings])
    known = np.isfinite(values)
    sums = np.where(known, values, 0.0).sum(axis=0)
    return np.where(known.any(axis=0), sums / np.maximum(known.sum(axis=0), 1), np.nan)
