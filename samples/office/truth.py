"""What a reader must find in each file: counted and measured on the shapes, not on the files."""
import math
from shapes import Band, Bent, Cylinder, Note, add, expanded, perpendicular_pair

MM2 = 1e-6  # m^2
ENTITY = {"Face": "3DFACE", "Solid": "SOLID", "Bent": "LWPOLYLINE", "Band": "LWPOLYLINE", "Polyface": "POLYLINE",
          "Strip": "LINE", "Cylinder": "CIRCLE", "Insert": "INSERT"}
CHORD_TOLERANCE_MM = 0.5  # within which a reader may replace an arc by straight pieces


def entity_name(record):
    return record.kind if isinstance(record, Note) else ENTITY[type(record).__name__]


def count_entities(block):
    counts = {}
    for record in block.records:
        counts[entity_name(record)] = counts.get(entity_name(record), 0) + 1
    return dict(sorted(counts.items()))


def skipped_entities(block):
    counts = {}
    for record in block.records:
        if isinstance(record, Note):
            of_layer = counts.setdefault(record.layer, {})
            of_layer[record.kind] = of_layer.get(record.kind, 0) + 1
    return {layer: dict(sorted(kinds.items())) for layer, kinds in sorted(counts.items())}


class Extent:
    def __init__(self):
        self.low, self.high = [math.inf] * 3, [-math.inf] * 3

    def include(self, point, radii=(0, 0, 0)):
        for i in range(3):
            self.low[i] = min(self.low[i], point[i] - radii[i])
            self.high[i] = max(self.high[i], point[i] + radii[i])

    def in_metres(self):
        return {"low": [v / 1000 for v in self.low], "high": [v / 1000 for v in self.high]}


def include_exactly(extent, record, place):
    if not isinstance(record, Cylinder):
        for facet in record.facets():
            for p in facet:
                extent.include(place.point(p))
        return
    u, v = (place.direction(tuple(record.radius * c for c in e)) for e in perpendicular_pair(record.axis))
    radii = [math.hypot(a, b) for a, b in zip(u, v)]
    end = add(record.base, tuple(record.length * c for c in record.axis))
    for p in (record.base, end):
        extent.include(place.point(p), radii)


def exact_layers(model):
    """Surfaces and areas with circles and arcs as they are."""
    layers, extent = {}, Extent()
    for record, place, layer in expanded(model):
        entry = layers.setdefault(layer, {"surfaces": 0, "area_m2": [], "area_relative_tolerance": 1e-9})
        areas = record.surfaces(place)
        entry["surfaces"] += len(areas)
        entry["area_m2"] += [area * MM2 for area in areas]
        if isinstance(record, (Bent, Band)):
            # Arcs in straight pieces lose at most 4/3 sagitta / outer radius of their area.
            bound = CHORD_TOLERANCE_MM / record.smallest_radius()
            entry["area_relative_tolerance"] = max(entry["area_relative_tolerance"], bound)
            entry["surfaces_depend_on_chords"] = True
        include_exactly(extent, record, place)
    for entry in layers.values():
        entry["area_m2"] = math.fsum(entry["area_m2"])
    return dict(sorted(layers.items())), extent.in_metres()


def dxf_truth(model, blocks):
    layers, bounds = exact_layers(model)
    return {
        "file": "office.dxf",
        "unit": "mm",
        "up": "z",
        "conventions": {
            "CIRCLE with thickness": "3 surfaces: side and two ends",
            "LWPOLYLINE with thickness": "1 surface per segment, no lid; bulged segments may be cut in pieces",
            "LWPOLYLINE with thickness and width": "per segment two sides, lid and floor, and the two ends",
            "LINE with thickness": "1 surface",
            "POLYLINE (polyface)": "1 surface per face",
            "3DFACE, SOLID": "1 surface",
            "LINE, ARC, CIRCLE, LWPOLYLINE without thickness and width, TEXT, DIMENSION": "no surface, skipped",
        },
        "surfaces": sum(entry["surfaces"] for entry in layers.values()),
        "area_m2": math.fsum(entry["area_m2"] for entry in layers.values()),
        "bounds_m": bounds,
        "layers": layers,
        "entities": {"modelspace": count_entities(model),
                     "blocks": {name: count_entities(block) for name, block in sorted(blocks.items())}},
        "skipped": skipped_entities(model),
    }
