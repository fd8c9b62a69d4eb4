#!/usr/bin/python3
"""Draws the theatre: theatre.rad and theatre_black.rad (materials), stage.rad, lamps.rad, seat.rad.

    draw_theatre.py [FOLDER]      folder to write to; this one by default

Every run writes the same bytes. boxes(), rounds(), curtains() and lamps() are all there is to the geometry near the
stage; reference.py uses them too. Metres; the stage's floor is z = 0, its front edge y = 0, the hall lies at y < 0.
"""
import math
import sys
from pathlib import Path

LUMENS_PER_WATT = 179.0
LAMP_RADIUS, HOUSING_RADIUS, HOUSING_LENGTH = 0.07, 0.1, 0.3
FOCUS_BEHIND = 1e-4  # distance of the beam's apex behind the lens: none, so that each lens is a plain disc
MATERIALS = {  # reflectance, then share and roughness of the sheen
    "boards": (0.16, 0.11, 0.08, 0.03, 0.08), "black_cloth": (0.03, 0.03, 0.03, 0, 0), "plaster": (0.45, 0.40, 0.34, 0, 0),
    "red_velvet": (0.34, 0.03, 0.04, 0, 0), "backdrop": (0.4, 0.46, 0.62, 0, 0), "stone": (0.44, 0.4, 0.34, 0, 0),
    "white_cloth": (0.6, 0.57, 0.52, 0, 0), "gold": (0.52, 0.36, 0.12, 0.1, 0.15), "carpet": (0.12, 0.04, 0.05, 0, 0),
    "iron": (0.05, 0.05, 0.05, 0, 0)}
TINTS = {"warm": (1.0, 0.72, 0.42), "cool": (0.5, 0.74, 1.3), "rose": (1.2, 0.45, 0.62), "white": (1.0, 0.95, 0.86)}


def boxes():
    """(material, low corner, high corner)."""
    found = [("boards", (-9, 0, -1.1), (9, 9.5, 0)),
             ("plaster", (-9, -0.3, -1.1), (-6, 0, 8)), ("plaster", (6, -0.3, -1.1), (9, 0, 8)),
             ("plaster", (-6, -0.3, 6), (6, 0, 8)),
             ("gold", (-6.15, -0.42, -0.1), (-5.85, -0.3, 6.15)), ("gold", (5.85, -0.42, -0.1), (6.15, -0.3, 6.15)),
             ("gold", (-5.85, -0.42, 5.85), (5.85, -0.3, 6.15)),
             ("stone", (-3.2, 5.6, 0), (3.2, 7.6, 0.9)), ("stone", (-3.2, 5.2, 0), (3.2, 5.6, 0.6)),
             ("stone", (-3.2, 4.8, 0), (3.2, 5.2, 0.3)), ("stone", (-2.95, 6.45, 4.0), (2.95, 6.95, 4.35)),
             ("stone", (3.6, 2.6, 0), (4.6, 3.6, 0.45)), ("stone", (-4.7, 3.0, 0), (-3.9, 3.8, 0.8))]
    return found


def rounds():
    """Upright cones and cylinders, then spheres: (material, x, y, low z, high z, low radius, high radius)."""
    columns = [("stone", x, 6.7, 0.9, 4.0, 0.26, 0.21) for x in (-2.6, -1.3, 1.3, 2.6)]
    people = [(-3.1, 2.2, 0, "white_cloth"), (-1.5, 3.4, 0, "white_cloth"), (-0.3, 1.7, 0, "red_velvet"),
              (0.9, 2.9, 0, "gold"), (2.3, 1.9, 0, "white_cloth"), (0.0, 6.2, 0.9, "gold"), (4.1, 3.1, 0.45, "white_cloth"),
              (-4.3, 5.4, 0, "red_velvet"), (4.6, 5.6, 0, "red_velvet")]
    gowns = [(m, x, y, z, z + 1.45, 0.38, 0.12) for x, y, z, m in people]
    heads = [(x, y, z + 1.58, 0.15) for x, y, z, _ in people]
    return columns + gowns, heads


def curtains():
    """Folded cloth: (material, low z, high z, points along its foot)."""
    def folds(start, end, count, depth):
        points = []
        for i in range(2 * count + 1):
            t, aside = i / (2 * count), depth * (1 if i % 2 else -1) / 2
            points.append((round(start[0] + t * (end[0] - start[0]) + aside * (start[0] == end[0]), 4),
                           round(start[1] + t * (end[1] - start[1]) + aside * (start[0] != end[0]), 4)))
        return points
    legs = [("black_cloth", 0.0, 8.0, folds((side * 5.6, y), (side * 7.6, y), 5, 0.12))
            for y in (2.0, 4.4, 6.9) for side in (-1, 1)]
    front = [("red_velvet", 0.0, 6.0, folds((side * 4.9, 0.25), (side * 6.3, 0.25), 7, 0.2)) for side in (-1, 1)]
    return legs + front


def lamps():
    """(tint, strength in cd/m^2, full angle in degrees, centre, aim): six bars of eighteen spotlights."""
    bars = [(-1.6, 7.3, 3.4, "white", 15, 0.7e6), (0.9, 6.6, 1.8, "warm", 17, 0.8e6), (2.5, 6.6, 3.0, "cool", 17, 0.9e6),
            (4.1, 6.6, 4.6, "rose", 17, 1.0e6), (5.7, 6.6, 6.6, "warm", 17, 1.0e6), (7.3, 6.6, 8.9, "cool", 24, 0.5e6)]
    found = []
    for number, (y, z, target_y, tint, angle, strength) in enumerate(bars):
        for i in range(18):
            x = -5.1 + 0.6 * i
            cross = 1.1 if i % 2 else -1.1  # neighbours cross their beams
            aim = (round(0.72 * x + cross - x, 4), round(target_y + 0.35 * math.sin(i + number) - y, 4), round(-z, 4))
            colour = tint if i % 4 else "white"
            found.append((colour, strength, angle, (round(x, 4), y, z), aim))
    return found


def primitive(material, kind, name, numbers):
    return "%s %s %s 0 0 %d %s\n" % (material, kind, name, len(numbers), " ".join("%g" % n for n in numbers))


def box_text(material, name, low, high):
    (a, b, c), (d, e, f) = low, high
    faces = ((a, b, c, a, e, c, d, e, c, d, b, c), (a, b, f, d, b, f, d, e, f, a, e, f), (a, b, c, d, b, c, d, b, f, a, b, f),
             (a, e, c, a, e, f, d, e, f, d, e, c), (a, b, c, a, b, f, a, e, f, a, e, c), (d, b, c, d, e, c, d, e, f, d, b, f))
    return "".join(primitive(material, "polygon", "%s_%d" % (name, i), face) for i, face in enumerate(faces))


def stage_text():
    text = "# The stage with its set, and the hall. Drawn by draw_theatre.py.\n"
    for number, (material, low, high) in enumerate(boxes()):
        text += box_text(material, "box_%d" % number, low, high)
    upright, heads = rounds()
    for number, (material, x, y, low, high, wide, narrow) in enumerate(upright):
        text += primitive(material, "cone", "round_%d" % number, (x, y, low, x, y, high, wide, narrow))
        text += primitive(material, "ring", "lid_%d" % number, (x, y, high, 0, 0, 1, 0, narrow))
    for number, (x, y, z, radius) in enumerate(heads):
        text += primitive("stone", "sphere", "head_%d" % number, (x, y, z, radius))
    for number, (material, low, high, foot) in enumerate(curtains()):
        for i, (a, b) in enumerate(zip(foot, foot[1:])):
            text += primitive(material, "polygon", "fold_%d_%d" % (number, i), (*a, low, *b, low, *b, high, *a, high))
    walls = (("backdrop", (-9, 9.3, 0, 9, 9.3, 0, 9, 9.3, 10, -9, 9.3, 10)),
             ("black_cloth", (-9, 0, 0, -9, 9.3, 0, -9, 9.3, 10, -9, 0, 10)),
             ("black_cloth", (9, 0, 0, 9, 0, 10, 9, 9.3, 10, 9, 9.3, 0)),
             ("black_cloth", (-9, 0, 10, -9, 9.3, 10, 9, 9.3, 10, 9, 0, 10)),
             ("black_cloth", (-9, 0, 8, 9, 0, 8, 9, 0, 10, -9, 0, 10)),
             ("plaster", (-9, -15, -1.1, -9, 0, -1.1, -9, 0, 8, -9, -15, 8)),
             ("plaster", (9, -15, -1.1, 9, -15, 8, 9, 0, 8, 9, 0, -1.1)),
             ("plaster", (-9, -15, 8, -9, 0, 8, 9, 0, 8, 9, -15, 8)),
             ("plaster", (-9, -15, -1.1, -9, -15, 8, 9, -15, 8, 9, -15, -1.1)),
             ("carpet", (-9, -15, -1.1, 9, -15, -1.1, 9, 0, -1.1, -9, 0, -1.1)))
    for number, (material, corners) in enumerate(walls):
        text += primitive(material, "polygon", "wall_%d" % number, corners)
    for number, (y, z) in enumerate(sorted({(lamp[3][1], lamp[3][2]) for lamp in lamps()})):
        text += primitive("iron", "cylinder", "bar_%d" % number, (-6.5, y, z + 0.45, 6.5, y, z + 0.45, 0.03))
    return text + "!xform -n seats -t -6.9 -12 0 -a 24 -t .6 0 0 -a 9 -t 0 1.1 0 seat.rad\n"


def seat_text():
    return ("# One seat of the hall.\n" + box_text("red_velvet", "seat", (-0.25, -0.25, -0.75), (0.25, 0.25, -0.62))
            + box_text("red_velvet", "back", (-0.25, -0.33, -1.1), (0.25, -0.25, -0.2)))


def lamps_text():
    text = "# 108 spotlights on six bars. Drawn by draw_theatre.py.\n"
    for number, (tint, strength, angle, centre, aim) in enumerate(lamps()):
        length = math.sqrt(sum(a * a for a in aim))
        way = [a / length for a in aim]
        colour = TINTS[tint]
        level = strength / LUMENS_PER_WATT / (0.265 * colour[0] + 0.670 * colour[1] + 0.065 * colour[2])
        name = "spot_%d" % number
        text += "void spotlight %s 0 0 7 %s %g %g %g %g\n" % (
            name, " ".join("%.6g" % (level * c) for c in colour), angle, *(FOCUS_BEHIND * w for w in way))
        text += primitive(name, "ring", name + "_lens", (*centre, *way, 0, LAMP_RADIUS))
        behind = [round(c - HOUSING_LENGTH * w, 6) for c, w in zip(centre, way)]
        text += primitive("iron", "cylinder", name + "_housing", (*centre, *behind, HOUSING_RADIUS))
        text += primitive("iron", "ring", name + "_end", (*behind, *way, 0, HOUSING_RADIUS))
    return text


def materials_text(black):
    text = "# The theatre%s. Drawn by draw_theatre.py.\n" % (" with everything black: direct light alone" if black else "")
    for name, numbers in MATERIALS.items():
        text += "void plastic %s 0 0 5 %s\n" % (name, "0 0 0 0 0" if black else " ".join("%g" % n for n in numbers))
    return text + "!xform stage.rad\n!xform lamps.rad\n"


def main(arguments):
    folder = Path(arguments[0]) if arguments else Path(__file__).resolve().parent
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in (("theatre.rad", materials_text(False)), ("theatre_black.rad", materials_text(True)),
                       ("stage.rad", stage_text()), ("lamps.rad", lamps_text()), ("seat.rad", seat_text())):
        (folder / name).write_text(text)


if __name__ == "__main__":
    main(sys.argv[1:])
