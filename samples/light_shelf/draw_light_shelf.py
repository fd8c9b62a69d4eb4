#!/usr/bin/python3
"""Draws the room with a light shelf: room.rad, shelf.rad, sky.rad, line.txt.

    draw_light_shelf.py [FOLDER]      folder to write to; this one by default

Every run writes the same bytes. rectangles() is all there is to the geometry; reference.py uses it too.
"""
import math
import sys
from pathlib import Path

WIDTH, DEPTH, HEIGHT = 6.0, 9.0, 3.0  # x; y, away from the facade at y = 0; z
WINDOW, CLERESTORY = (0.9, 2.1), (2.2, 2.9)  # from sill to head, both from x = 0.3 to 5.7
SIDES = (0.3, 5.7)
SHELF_OUT, SHELF_IN, SHELF_LOW, SHELF_TOP = -0.7, 1.0, 2.13, 2.17
GROUND = (-200.0, 206.0, -400.0, 0.0)
ALTITUDE, EAST_OF_SOUTH, SUN_WIDTH = 35.0, 10.0, 0.533  # degrees
SUN_NORMAL_LX, SKY_LX, LUMENS_PER_WATT = 80000.0, 12000.0, 179.0
REFLECTANCES = {"floor": 0.2, "wall": 0.5, "ceiling": 0.8, "facade": 0.5, "ground": 0.2, "underside": 0.7}
MIRROR_REFLECTANCE, GLASS_TRANSMISSIVITY, GLASS_INDEX = 0.85, 0.95, 1.52
SENSOR_X, SENSOR_Z, SENSORS = 3.1, 0.8, 18  # a line into the depth, every 0.5 m, facing up


def rectangles():
    """(part, material, axis, coordinate, (low, high) of the next axis, (low, high) of the one after, facing)."""
    full = (0.0, WIDTH)
    room = [("room", "floor", 2, 0.0, full, (0.0, DEPTH), 1), ("room", "ceiling", 2, HEIGHT, full, (0.0, DEPTH), -1),
            ("room", "wall", 0, 0.0, (0.0, DEPTH), (0.0, HEIGHT), 1),
            ("room", "wall", 0, WIDTH, (0.0, DEPTH), (0.0, HEIGHT), -1),
            ("room", "wall", 1, DEPTH, (0.0, HEIGHT), full, -1),
            ("room", "ground", 2, 0.0, GROUND[:2], GROUND[2:], 1)]
    for low, high, x in ((0.0, WINDOW[0], full), (WINDOW[1], CLERESTORY[0], full), (CLERESTORY[1], HEIGHT, full),
                         (*WINDOW, (0.0, SIDES[0])), (*WINDOW, (SIDES[1], WIDTH)),
                         (*CLERESTORY, (0.0, SIDES[0])), (*CLERESTORY, (SIDES[1], WIDTH))):
        room.append(("room", "facade", 1, 0.0, (low, high), x, 1))
    room += [("room", "glass", 1, 0.0, WINDOW, SIDES, 1), ("room", "glass", 1, 0.0, CLERESTORY, SIDES, 1)]
    depth, edge = (SHELF_OUT, SHELF_IN), (SHELF_LOW, SHELF_TOP)
    shelf = [("shelf", "mirror", 2, SHELF_TOP, SIDES, depth, 1), ("shelf", "underside", 2, SHELF_LOW, SIDES, depth, -1),
             ("shelf", "underside", 1, SHELF_OUT, edge, SIDES, -1), ("shelf", "underside", 1, SHELF_IN, edge, SIDES, 1),
             ("shelf", "underside", 0, SIDES[0], depth, edge, -1), ("shelf", "underside", 0, SIDES[1], depth, edge, 1)]
    return room + shelf


def to_sun():
    up, turn = math.radians(ALTITUDE), math.radians(EAST_OF_SOUTH)
    return math.cos(up) * math.sin(turn), -math.cos(up) * math.cos(turn), math.sin(up)


def sun_radiance():
    """W/(m^2 sr) of a disc that gives SUN_NORMAL_LX on a surface that faces it: E = pi L sin^2(half angle)."""
    return SUN_NORMAL_LX / LUMENS_PER_WATT / (math.pi * math.sin(math.radians(SUN_WIDTH / 2)) ** 2)


def sky_radiance():
    return SKY_LX / LUMENS_PER_WATT / math.pi


def polygon(number, part, material, axis, at, first, second, facing):
    corners = []
    for u, v in ((0, 0), (1, 0), (1, 1), (0, 1))[::facing]:
        corner = [0.0, 0.0, 0.0]
        corner[axis], corner[(axis + 1) % 3], corner[(axis + 2) % 3] = at, first[u], second[v]
        corners.append("  %g %g %g" % tuple(corner))
    return "%s polygon %s_%d\n0\n0\n12\n%s\n" % (material, part, number, "\n".join(corners))


def material_text(name):
    if name == "glass":
        return "void glass glass\n0\n0\n3 %g %g %g\n" % ((GLASS_TRANSMISSIVITY,) * 3)
    if name == "mirror":
        return "void mirror mirror\n0\n0\n3 %g %g %g\n" % ((MIRROR_REFLECTANCE,) * 3)
    return "void plastic %s\n0\n0\n5 %g %g %g 0 0\n" % ((name,) + (REFLECTANCES[name],) * 3)


def part_text(part, title):
    mine = [r for r in rectangles() if r[0] == part]
    text = "# %s Drawn by draw_light_shelf.py. Metres, z up, south is -y.\n\n" % title
    for name in sorted({r[1] for r in mine}):
        text += material_text(name) + "\n"
    return text + "\n".join(polygon(i, *r) for i, r in enumerate(mine))


def sky_text():
    sun = "%.9g %.9g %.9g" % to_sun()
    return ("# Sun and a uniform sky. Drawn by draw_light_shelf.py.\n\n"
            "void light sun_light\n0\n0\n3 %.9g %.9g %.9g\n\nsun_light source sun\n0\n0\n4 %s %g\n\n"
            "void glow sky_light\n0\n0\n4 %.9g %.9g %.9g 0\n\nsky_light source sky\n0\n0\n4 0 0 1 180\n"
            % ((sun_radiance(),) * 3 + (sun, SUN_WIDTH) + (sky_radiance(),) * 3))


def sensors():
    return [(SENSOR_X, (i + 0.5) * DEPTH / SENSORS, SENSOR_Z) for i in range(SENSORS)]


def main(arguments):
    folder = Path(arguments[0]) if arguments else Path(__file__).resolve().parent
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "room.rad").write_text(part_text("room", "A side-lit room with clear glazing."))
    (folder / "shelf.rad").write_text(part_text("shelf", "A light shelf: a mirror on top, white below."))
    (folder / "sky.rad").write_text(sky_text())
    (folder / "line.txt").write_text("".join("%g %g %g 0 0 1\n" % s for s in sensors()))


if __name__ == "__main__":
    main(sys.argv[1:])
