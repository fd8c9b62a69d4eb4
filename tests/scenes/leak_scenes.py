"""Scenes in which interpolated light would go where it cannot: thin walls, a gap under a door, shelves, a folded curtain.

Each is a function that returns (scene text, points, view words). In `sealed` every point is dark; elsewhere plain path
tracing says what is right. SCENES lists them by name.
"""

import math

from text import box, diffuse, lamp, level_panel, polygon, room

ROOM_LOW, ROOM_HIGH = (-4, -3, 0), (4, 3, 2.5)
THIN_M = 0.001


def _lit_room(wall=0.6):
    """A room of 8 x 6 m with its lamp over the half where x < 0."""
    text = diffuse("wall", wall) + lamp("panel", 40) + room("room", ROOM_LOW, ROOM_HIGH, "wall")
    return text + level_panel("panel", "lamp", (-2.6, -0.5), (-1.6, 0.5), 2.45, facing_up=False)


def sealed():
    """A box of 1 mm walls in a bright room: no light inside. Points a tenth of a millimetre to half a metre from them."""
    text = _lit_room() + diffuse("sheet", 0.9)
    low, high, thin = (0.5, -0.5, 0.8), (1.5, 0.5, 1.6), THIN_M
    text += box("sheet", "outside", low, high)
    inner_low, inner_high = [value + thin for value in low], [value - thin for value in high]
    text += room("inside", inner_low, inner_high, "sheet")
    points = []
    for gap in (1e-4, 1e-3, 0.01, 0.1, 0.4):
        for x in (inner_low[0] + gap, inner_high[0] - gap):
            for y in (inner_low[1] + gap, 0.0, inner_high[1] - gap):
                points += [(x, y, inner_low[2] + gap, 0, 0, 1), (x, y, inner_high[2] - gap, 0, 0, -1),
                           (x, y, 1.2, 1 if x > 1 else -1, 0, 0)]
    return text, points, "-vtv -vp 0.55 -0.45 1.5 -vd 1 1 -0.6 -vu 0 0 1 -vh 80 -vv 80"


def _partition(gap_m):
    """A wall of 1 cm across the room at x = 0, open by `gap_m` at the floor over the width of a door."""
    thick, door = 0.005, 0.45
    text = box("wall", "left", (-thick, -3, 0), (thick, -door, 2.5)) + box("wall", "right", (-thick, door, 0), (thick, 3, 2.5))
    return text + box("wall", "door", (-thick, -door, gap_m), (thick, door, 2.5))


def door_gap():
    """Light that comes under a door through 2 cm, and nowhere else. A few points stand on the lit side."""
    points = [(0.02 + 0.06 * i, y, 0, 0, 0, 1) for i in range(10) for y in (-1.5, -0.2, 0.2, 1.5)]
    points += [(-0.02 - 0.06 * i, y, 0, 0, 0, 1) for i in range(5) for y in (-1.5, 0, 1.5)]
    return _lit_room() + _partition(0.02), points, "-vtv -vp 3 -1.5 1.5 -vd -1 0.4 -0.45 -vu 0 0 1 -vh 70 -vv 60"


def partition():
    """A partition of 1 mm that ends 0.5 m below the ceiling: bright on one side of its foot, dim on the other. What falls on
    its dim side has come by at least two surfaces."""
    text = _lit_room() + box("wall", "screen", (0, -3, 0), (THIN_M, 3, 2.0))
    points = [(x, y, 0, 0, 0, 1) for x in (-0.3, -0.1, -0.03, -0.01, 0.011, 0.031, 0.101, 0.301) for y in (-2, -1, 0, 1, 2)]
    points += [(0.011, y, z, 1, 0, 0) for y in (-1.5, 0, 1.5) for z in (0.5, 1.2)]
    return text, points, "-vtv -vp 3 -1.5 1.5 -vd -1 0.4 -0.45 -vu 0 0 1 -vh 70 -vv 60"


def shelves():
    """Boards of 5 mm, 5 cm apart and 0.4 m deep, against the wall opposite the lamp: darker with every centimetre."""
    text = _lit_room() + diffuse("board", 0.7)
    for index in range(12):
        z = 0.3 + 0.05 * index
        text += box("board", f"board_{index}", (3.6, -1, z), (4, 1, z + 0.005))
    points = [(3.62 + 0.09 * i, y, 0.3 + 0.05 * board + 0.005, 0, 0, 1) for board in (2, 6, 10) for i in range(5)
              for y in (-0.6, 0, 0.6)]
    return text, points, "-vtv -vp 2.6 -0.6 0.75 -vd 1 0.4 -0.15 -vu 0 0 1 -vh 60 -vv 45"


def curtain():
    """A curtain folded every 12 cm, 8 cm deep, before the wall at x = 4."""
    text = _lit_room() + diffuse("cloth", 0.6)
    folds, depth, half_pitch = 40, 0.08, 0.06
    corner = lambda k: (3.7 + (depth if k % 2 else 0), -1.2 + half_pitch * k)
    for k in range(folds):
        (x0, y0), (x1, y1) = corner(k), corner(k + 1)
        text += polygon("cloth", f"fold_{k}", (x0, y0, 0.02), (x1, y1, 0.02), (x1, y1, 2.4), (x0, y0, 2.4))
    points = []
    for k in range(6, 30, 4):
        (x0, y0), (x1, y1) = corner(k), corner(k + 1)
        normal = (-(y1 - y0), x1 - x0)
        size = math.hypot(*normal)
        for share in (0.1, 0.3, 0.5, 0.7, 0.9):
            points.append((x0 + share * (x1 - x0) + 1e-5 * normal[0] / size, y0 + share * (y1 - y0) + 1e-5 * normal[1] / size,
                           1.2, normal[0] / size, normal[1] / size, 0))
    return text, points, "-vtv -vp 2.2 -0.5 1.3 -vd 1 0.3 -0.05 -vu 0 0 1 -vh 50 -vv 40"


SCENES = {function.__name__: function for function in (sealed, door_gap, partition, shelves, curtain)}
