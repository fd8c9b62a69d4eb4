"""The engine's illuminance of surfaces, gathered by the faces of the document."""

import json
import math

from lightwell_bridge.results import FaceLight, ObjectLight

from .optics import DEFAULT


def read(file, exported):
    """ObjectLights in the order of `exported.objects`; faces follow those of each object's record, the triangles of a
    mesh object its mesh. A face that the engine gives no value has NaN.

    @throws ValueError that names the file
    """
    try:
        with open(file, encoding="utf-8") as text:
            parts = {part["object"]: part for part in json.load(text)["parts"]}
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ValueError(f"{file}: no illuminance of surfaces: {error!r}") from error
    found = []
    for path, record in exported.objects.items():
        values = {face["id"]: face for face in parts.get(path, {}).get("faces", [])}
        light = ObjectLight(path, record["layer"] or DEFAULT)
        for face in record["faces"]:
            if face["kind"] == "mesh":
                light.faces += [_gathered([values.get(f"{face['element']}/{i}")]) for i in range(face["count"])]
            elif face["kind"] in ("polygon", "facets"):
                entries = range(face["first"], face["first"] + face["count"])
                light.faces.append(_gathered([values.get(f"{face['element']}/{i}") for i in entries]))
            else:
                light.faces.append(_gathered([values.get(face["element"])]))
        found.append(light)
    return found


def _gathered(entries):
    """One face of many pieces: means by area; sensors share ambient light, so errors add as they are."""
    entries = [e for e in entries if e is not None]
    area = sum(e["area_m2"] for e in entries)
    if not area > 0:
        return FaceLight(0.0, math.nan, math.nan, math.nan, math.nan)
    return FaceLight(area, *(sum(e["area_m2"] * e[key] for e in entries) / area
                             for key in ("front", "front_error", "back", "back_error")))
