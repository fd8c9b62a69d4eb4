#!/usr/bin/python3
"""The office's files are what its script draws, and its truth agrees with what ezdxf finds in the drawing.

    office_files_test.py     status 0: all holds; 1: something differs, with a sentence for each; 2: no ezdxf
"""
import json
import math
import os
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


def daylight_map_differs_only_in_the_lamps():
    with_lamps, without = [
        [line for line in (OFFICE / name).read_text().splitlines() if not line.startswith("#")]
        for name in ("map.toml", "map_daylight.toml")]
    assert [line for line in with_lamps if line not in without] == ['use = "led_panel_8000cd"', 'side = "front"']
    assert [line for line in without if line not in with_lamps] == ['use = "acrylic_opal"']


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
          daylight_map_differs_only_in_the_lamps]


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
