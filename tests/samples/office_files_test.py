#!/usr/bin/python3
"""The office's files are what its script draws, and what they hold agrees with their truth: ezdxf reads the DXF, short
readers of this file the OBJ and the GLB.

    office_files_test.py     status 0: all holds; 1: something differs, with a sentence for each; 2: no ezdxf
"""
import json
import math
import os
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
OFFICE = ROOT / "samples" / "office"
DRAWN = ["office.dxf", "office.obj", "office.mtl", "office.glb"]
DRAWN += [name + ".truth.json" for name in DRAWN if not name.endswith(".mtl")]


def remade_files_are_the_same():
    """Drawn again under two orders of Python's hash tables, every file has the same bytes."""
    for hash_seed in ("1", "20260321"):
        with tempfile.TemporaryDirectory() as folder:
            environment = {**os.environ, "PYTHONHASHSEED": hash_seed, "PYTHONDONTWRITEBYTECODE": "1"}
            subprocess.run([sys.executable, str(OFFICE / "draw_office.py"), folder], check=True, env=environment)
            assert sorted(p.name for p in Path(folder).iterdir()) == sorted(DRAWN), "another set of files was drawn"
            for name in DRAWN:
                same = (Path(folder) / name).read_bytes() == (OFFICE / name).read_bytes()
                assert same, "%s differs from what draw_office.py draws; run it again and commit" % name


def audit_finds_nothing():
    document = drawing()
    auditor = document.audit()
    assert not auditor.errors and not auditor.fixes, [e.message for e in auditor.errors + auditor.fixes]
    assert document.header["$INSUNITS"] == 4, "the drawing must be in millimetres"


def areas_agree_with_ezdxf():
    """Inserts expanded by ezdxf's own rules; circles and bands by closed forms."""
    truth = json.loads((OFFICE / "office.dxf.truth.json").read_text())
    found = {}
    for entity, layer in expanded(drawing().modelspace()):
        for area in surface_areas(entity):
            found.setdefault(layer, []).append(area * 1e-6)
    assert sorted(found) == sorted(truth["layers"]), "layers: %s" % sorted(found)
    for layer, expected in truth["layers"].items():
        area = math.fsum(found[layer])
        assert len(found[layer]) == expected["surfaces"], "%s: %d surfaces" % (layer, len(found[layer]))
        # ezdxf turns inserts by an angle in degrees, so quarter turns are not exact
        assert abs(area - expected["area_m2"]) <= 1e-9 * expected["area_m2"], "%s: %.12g m2" % (layer, area)


def entity_counts_agree_with_ezdxf():
    truth = json.loads((OFFICE / "office.dxf.truth.json").read_text())
    document = drawing()
    assert count(document.modelspace()) == truth["entities"]["modelspace"]
    for name, expected in truth["entities"]["blocks"].items():
        assert count(document.blocks.get(name)) == expected, "block %s" % name


def obj_agrees_with_its_truth():
    """Faces read line by line, areas by the cross products of a fan."""
    truth = json.loads((OFFICE / "office.obj.truth.json").read_text())
    points, areas, layer = [], {}, None
    for line in (OFFICE / "office.obj").read_text().splitlines():
        word, *rest = line.split() or [""]
        if word == "v":
            points.append([float(v) / 1000 for v in rest])
        elif word == "g":
            layer = rest[0]
        elif word == "f":
            areas.setdefault(layer, []).append(fan_area([points[int(i) - 1] for i in rest]))
    compare(areas, truth)
    expect_bounds(points, truth)


def glb_agrees_with_its_truth():
    """Nodes walked with matrices made of their rotation quaternions."""
    truth = json.loads((OFFICE / "office.glb.truth.json").read_text())
    data = (OFFICE / "office.glb").read_bytes()
    magic, version, total, json_length, kind = struct.unpack_from("<4sIII4s", data)
    assert (magic, version, total, kind) == (b"glTF", 2, len(data), b"JSON")
    model, body = json.loads(data[20:20 + json_length]), data[28 + json_length:]
    meshes = [mesh_triangles(model, mesh, body) for mesh in model["meshes"]]
    areas, triangles, points = {}, {}, []

    def walk(number, to_world):
        node = model["nodes"][number]
        move = node_map(node)
        here = lambda p: to_world(move(p))
        if "mesh" in node:
            layer = node["extras"]["layer"]
            world = [[here(p) for p in triangle] for triangle in meshes[node["mesh"]]]
            points.extend((p[0], -p[2], p[1]) for triangle in world for p in triangle)
            areas.setdefault(layer, []).append(math.fsum(fan_area(triangle) for triangle in world))
            triangles[layer] = triangles.get(layer, 0) + len(world)
        for child in node.get("children", ()):
            walk(child, here)

    for root in model["scenes"][model["scene"]]["nodes"]:
        walk(root, lambda p: p)
    compare(areas, truth)
    expect_bounds(points, truth)
    assert triangles == {layer: entry["triangles"] for layer, entry in truth["layers"].items()}


def daylight_map_differs_only_in_the_lamps():
    with_lamps, without = [
        [line for line in (OFFICE / name).read_text().splitlines() if not line.startswith("#")]
        for name in ("map.toml", "map_daylight.toml")]
    assert [line for line in with_lamps if line not in without] == ['use = "led_panel_8000cd"', 'side = "front"']
    assert [line for line in without if line not in with_lamps] == ['use = "acrylic_opal"']


def compare(areas, truth):
    assert sorted(areas) == sorted(truth["layers"]), "layers: %s" % sorted(areas)
    for layer, expected in truth["layers"].items():
        assert len(areas[layer]) == expected["surfaces"], "%s: %d surfaces" % (layer, len(areas[layer]))
        area = math.fsum(areas[layer])
        assert abs(area - expected["area_m2"]) <= 1e-9 * area, "%s: %.12g m2" % (layer, area)
        lost = expected["exact_area_m2"] - expected["area_m2"]
        assert abs(lost) <= 0.03 * expected["exact_area_m2"], "%s: prisms of another size" % layer


def expect_bounds(points, truth):
    for i in range(3):
        assert abs(min(p[i] for p in points) - truth["bounds_m"]["low"][i]) < 1e-9
        assert abs(max(p[i] for p in points) - truth["bounds_m"]["high"][i]) < 1e-9


def fan_area(corners):
    total = [0.0, 0.0, 0.0]
    x, y, z = corners[0]
    for p, q in zip(corners[1:], corners[2:]):
        a, b, c = p[0] - x, p[1] - y, p[2] - z
        d, e, f = q[0] - x, q[1] - y, q[2] - z
        total = [total[0] + b * f - c * e, total[1] + c * d - a * f, total[2] + a * e - b * d]
    return math.sqrt(sum(v * v for v in total)) / 2


def mesh_triangles(model, mesh, body):
    primitive = mesh["primitives"][0]
    positions, indices = (model["accessors"][n] for n in (primitive["attributes"]["POSITION"], primitive["indices"]))
    start = model["bufferViews"][positions["bufferView"]]["byteOffset"]
    flat = struct.unpack_from("<%df" % (3 * positions["count"]), body, start)
    start = model["bufferViews"][indices["bufferView"]]["byteOffset"]
    order = struct.unpack_from("<%dH" % indices["count"], body, start)
    assert max(order) < positions["count"]
    return [[flat[3 * i:3 * i + 3] for i in order[k:k + 3]] for k in range(0, len(order), 3)]


def node_map(node):
    tx, ty, tz = node.get("translation", (0, 0, 0))
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    sx, sy, sz = node.get("scale", (1, 1, 1))
    columns = ((1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)),
               (2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)),
               (2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)))
    (a, b, c), (d, e, f), (g, h, i) = columns

    def apply(p):
        u, v, r = p[0] * sx, p[1] * sy, p[2] * sz
        return (a * u + d * v + g * r + tx, b * u + e * v + h * r + ty, c * u + f * v + i * r + tz)
    return apply


def drawing():
    import ezdxf
    return ezdxf.readfile(OFFICE / "office.dxf")


def count(layout):
    counts = {}
    for entity in layout:
        counts[entity.dxftype()] = counts.get(entity.dxftype(), 0) + 1
    return dict(sorted(counts.items()))


def expanded(entities, inherited="0"):
    for entity in entities:
        layer = inherited if entity.dxf.layer == "0" else entity.dxf.layer
        if entity.dxftype() == "INSERT":
            yield from expanded(entity.virtual_entities(), layer)
        else:
            yield entity, layer


THICK = ("LINE", "CIRCLE", "LWPOLYLINE")


def surface_areas(entity):
    kind = entity.dxftype()
    thickness = entity.dxf.get("thickness", 0) if kind in THICK else 0
    if kind in ("3DFACE", "SOLID"):
        a, b, c, d = entity.wcs_vertices() if kind == "3DFACE" else solid_corners(entity)
        return [quad_area(a, b, c, d)]
    if kind == "POLYLINE":
        return [sum_of_triangles([v.dxf.location for v in face[:-1]]) for face in entity.faces()]
    if kind == "LINE" and thickness:
        return [entity.dxf.start.distance(entity.dxf.end) * abs(thickness)]
    if kind == "CIRCLE" and thickness:
        radius = entity.dxf.radius
        return [2 * math.pi * radius * abs(thickness), math.pi * radius ** 2, math.pi * radius ** 2]
    if kind == "LWPOLYLINE" and thickness:
        return list(polyline_areas(entity, abs(thickness)))
    return []


def solid_corners(solid):
    corners = solid.vertices()  # in the order of an outline
    return solid.ocs().points_to_wcs(corners)


def quad_area(a, b, c, d):
    return ((c - a).cross(d - b)).magnitude / 2


def sum_of_triangles(corners):
    first = corners[0]
    return sum(((p - first).cross(q - first)).magnitude for p, q in zip(corners[1:], corners[2:])) / 2


def polyline_areas(entity, thickness):
    from ezdxf.math import bulge_to_arc
    points = entity.get_points("xyb")
    pairs = list(zip(points, points[1:] + points[:1]))
    width = entity.dxf.get("const_width", 0)
    for (x0, y0, bulge), (x1, y1, _) in pairs if entity.closed else pairs[:-1]:
        if bulge == 0:
            yield math.hypot(x1 - x0, y1 - y0) * thickness
            continue
        _, begin, end, radius = bulge_to_arc((x0, y0), (x1, y1), bulge)
        angle = (end - begin) % (2 * math.pi)
        if not width:
            yield radius * angle * thickness
            continue
        outer, inner = radius + width / 2, radius - width / 2
        yield from (outer * angle * thickness, inner * angle * thickness, width * thickness, width * thickness)
        yield from [angle / 2 * (outer ** 2 - inner ** 2)] * 2


CHECKS = [remade_files_are_the_same, audit_finds_nothing, areas_agree_with_ezdxf, entity_counts_agree_with_ezdxf,
          obj_agrees_with_its_truth, glb_agrees_with_its_truth, daylight_map_differs_only_in_the_lamps]


def main():
    try:
        import ezdxf  # noqa: F401
    except ImportError:
        print("skipped: python3-ezdxf is not installed")
        return 2
    failures = 0
    for check in CHECKS:
        try:
            check()
            print("ok      " + check.__name__.replace("_", " "))
        except AssertionError as error:
            failures += 1
            print("FAILED  %s: %s" % (check.__name__.replace("_", " "), error))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
