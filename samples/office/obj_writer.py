"""Writes the drawing as OBJ with MTL: millimetres, z up, blocks flattened, flat faces with all their corners."""
import math
from layers import EMITTING_LAYERS, GLASS_LAYERS, LAYERS
from shapes import cross, dot, expanded, polygon_area
from truth import Extent, MM2

DIGITS = 4  # after the point, in mm: areas hold to about 1e-7 of a metre times the perimeter


def mirrored(place):
    return dot(cross(place.x, place.y), place.z) < 0


def number(value):
    text = "%.*f" % (DIGITS, value)
    text = text.rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


class Corners:
    """Numbers of corners by their written text, so that each is written once."""

    def __init__(self):
        self.numbers, self.lines, self.extent = {}, [], Extent()

    def add(self, point):
        """@return  number from 1, and the point as written"""
        text = " ".join(number(v) for v in point)
        if text not in self.numbers:
            self.numbers[text] = len(self.numbers) + 1
            self.lines.append("v " + text)
            self.extent.include(tuple(float(word) for word in text.split()))
        return self.numbers[text], tuple(float(word) for word in text.split())


def write_obj(model, file):
    """@return  the truth about the file, measured on the numbers as written"""
    corners, groups = Corners(), {}
    for record, place, layer in expanded(model):
        group = groups.setdefault(layer, {"lines": [], "areas": [], "exact": [], "facet_error": 0.0})
        for facet in record.facets():
            points = [place.point(p) for p in facet]
            written = [corners.add(p) for p in (reversed(points) if mirrored(place) else points)]
            group["lines"].append("f " + " ".join(str(n) for n, _ in written))
            group["areas"].append(polygon_area([p for _, p in written]) * MM2)
        group["exact"] += [area * MM2 for area in record.surfaces(place)]
        group["facet_error"] = max(group["facet_error"], record.facet_error / 1000)
    materials = write_mtl(file.with_suffix(".mtl"), sorted(groups))
    with open(file, "w", encoding="ascii", newline="\n") as out:
        out.write("# Sample office, drawn by draw_office.py\n# unit: mm\n# up: z\nmtllib %s\n" % (file.stem + ".mtl"))
        out.write("\n".join(corners.lines) + "\n")
        for layer in sorted(groups):
            out.write("g %s\nusemtl %s\n" % (layer, materials[layer]))
            out.write("\n".join(groups[layer]["lines"]) + "\n")
    return obj_truth(file.name, corners, groups, materials)


def write_mtl(file, layers):
    """@return  layer -> material name"""
    names = {layer: LAYERS[layer][2] for layer in layers}
    written = set()
    with open(file, "w", encoding="ascii", newline="\n") as out:
        out.write("# Materials of the sample office: diffuse colours; glass and light are better given by map.toml\n")
        for layer in layers:
            if names[layer] in written:
                continue
            written.add(names[layer])
            out.write("newmtl %s\nKd %g %g %g\nillum 1\n" % (names[layer], *LAYERS[layer][1]))
            if layer in GLASS_LAYERS:
                out.write("d 0.1\nNi 1.52\n")
            if layer in EMITTING_LAYERS:
                out.write("Ke 1 1 1\n")
    return names


def obj_truth(name, corners, groups, materials):
    layers = {}
    for layer, group in sorted(groups.items()):
        layers[layer] = {"surfaces": len(group["lines"]), "area_m2": math.fsum(group["areas"]),
                         "area_relative_tolerance": 1e-6, "exact_area_m2": math.fsum(group["exact"]),
                         "facet_error_m": group["facet_error"], "material": materials[layer]}
    return {
        "file": name,
        "unit": "mm",
        "up": "z",
        "conventions": {"f": "1 surface per face, any number of corners", "layer": "name of the group (g)"},
        "surfaces": sum(entry["surfaces"] for entry in layers.values()),
        "area_m2": math.fsum(entry["area_m2"] for entry in layers.values()),
        "bounds_m": corners.extent.in_metres(),
        "layers": layers,
        "entities": {"v": len(corners.lines), "f": sum(entry["surfaces"] for entry in layers.values()),
                     "g": len(layers), "usemtl": len(layers), "mtllib": 1},
        "skipped": {},
    }
