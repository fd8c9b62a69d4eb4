"""Illuminance on faces and grids: numbers for people, and as CSV. Means are those of the map, weighted by area."""

import csv
import io
import math
from dataclasses import dataclass, field

import numpy as np

# A front with less than this share of the light on the back looks into a wall, or at nothing: a dim room below a sunlit roof has more.
DARK_SHARE = 1e-4


@dataclass
class FaceLight:
    """One face: m2, lx on its front and back with one standard error each."""

    area: float
    front: float
    front_error: float
    back: float
    back_error: float


@dataclass
class ObjectLight:
    """Faces of one drawing of an object, in the order of its mesh."""

    source: str
    layer: str
    faces: list = field(default_factory=list)

    def side(self):
        """The side that is shown: "front", where faces look; "back" when the front is dark beside it.

        Not the brighter one: the sun on its roof says nothing about a ceiling.
        """
        front, back = (sum(f.area * lux for f in self.faces if math.isfinite(lux := getattr(f, side)))
                       for side in ("front", "back"))
        return "back" if front < DARK_SHARE * back else "front"

    def lux(self, side=None):
        """n values of a side, that of side() when none is named."""
        return np.array([getattr(face, side or self.side()) for face in self.faces], dtype=float)

    def mean(self, side=None):
        """(m2, lx, one standard error) over the faces that have a value."""
        return mean_of(self.faces, side or self.side())


@dataclass
class GridLight:
    """Sensors of one grid; `lux` and `error` in their order."""

    name: str
    lux: object
    error: object
    rows: int = 0
    columns: int = 0
    cells: list = field(default_factory=list)

    def summary(self):
        """mean, min, max, uniformity (minimum/mean), error: one standard error of the mean, at most."""
        lux = np.asarray(self.lux, dtype=float)
        lux = lux[np.isfinite(lux)]
        if not len(lux):
            return {"mean": math.nan, "min": math.nan, "max": math.nan, "uniformity": math.nan, "error": math.nan, "points": 0}
        mean, error = float(lux.mean()), np.asarray(self.error, dtype=float)
        return {"mean": mean, "min": float(lux.min()), "max": float(lux.max()),
                "uniformity": float(lux.min()) / mean if mean > 0 else 0.0,
                "error": float(np.nansum(error)) / len(lux), "points": len(lux)}


def mean_of(faces, side):
    """(m2, lx, error): mean over faces by area. Errors add as they are, since faces share ambient light: it is at most that."""
    area = weighted = errors = 0.0
    for face in faces:
        lux, error = getattr(face, side), getattr(face, f"{side}_error")
        if face.area > 0 and math.isfinite(lux):
            area += face.area
            weighted += face.area * lux
            errors += face.area * (error if math.isfinite(error) else 0.0)
    return (area, weighted / area, errors / area) if area > 0 else (0.0, math.nan, math.nan)


def by_layer(objects):
    """{layer: (m2, lx, error)}: each object by the side that is shown."""
    layers = {}
    for light in objects:
        area, lux, error = light.mean()
        if area > 0:
            layers.setdefault(light.layer, []).append((area, lux, error))
    result = {}
    for layer, means in sorted(layers.items()):
        area = sum(m[0] for m in means)
        result[layer] = (area, *(sum(m[0] * m[i] for m in means) / area for i in (1, 2)))
    return result


def read_grid_csv(path, name):
    """What the engine writes for a grid: x,y,z,nx,ny,nz,illuminance_lx,error_lx.

    @throws ValueError that names the file
    """
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        return GridLight(name, [float(r["illuminance_lx"]) for r in rows], [float(r["error_lx"]) for r in rows])
    except (OSError, KeyError, TypeError, ValueError) as error:
        raise ValueError(f"{path}: no results of a grid: {error!r}") from error


def report(objects, grids, notes=()):
    """The numbers as text with units."""
    lines = ["Lightwell: illuminance in lx, each with one standard error", ""]
    if grids:
        lines += ["Sensor grids", f"  {'grid':<32} {'mean':>10} {'+-':>8} {'minimum':>10} {'maximum':>10} {'min/mean':>9}"]
        for grid in grids:
            s = grid.summary()
            lines.append(f"  {grid.name:<32} {s['mean']:10.1f} {s['error']:8.2f} {s['min']:10.1f} {s['max']:10.1f} "
                         f"{s['uniformity']:9.2f}")
        lines.append("")
    for title, entries in (("Layers", by_layer(objects)), ("Objects", {o.source: o.mean() for o in objects})):
        if entries:
            lines += [title, f"  {'':<48} {'area m2':>10} {'mean lx':>10} {'+-':>8}"]
            lines += [f"  {name or '(scene)':<48} {area:10.3f} {lux:10.1f} {error:8.2f}"
                      for name, (area, lux, error) in entries.items()]
            lines.append("")
    if notes:
        lines += ["Notes", *(f"  {note}" for note in notes)]
    return "\n".join(lines) + "\n"


def table(objects, grids):
    """The same numbers as CSV: kind, name, layer, area, mean, error, minimum, maximum, uniformity; of objects the side that
    these belong to, and the mean of the other side."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["kind", "name", "layer", "area_m2", "mean_lx", "error_lx", "min_lx", "max_lx", "min_over_mean", "side",
                     "other_side_lx"])
    for grid in grids:
        s = grid.summary()
        writer.writerow(["grid", grid.name, "", "", s["mean"], s["error"], s["min"], s["max"], s["uniformity"], "", ""])
    for layer, (area, lux, error) in by_layer(objects).items():
        writer.writerow(["layer", layer, layer, area, lux, error, "", "", "", "", ""])
    for light in objects:
        area, lux, error = light.mean()
        values = light.lux()
        values = values[np.isfinite(values)]
        low, high = (values.min(), values.max()) if len(values) else ("", "")
        side = light.side()
        other = light.mean("front" if side == "back" else "back")[1]
        writer.writerow(["object", light.source, light.layer, area, lux, error, low, high, "", side, other])
    return out.getvalue()
