"""A hall with many small lamps, of which a point sees at least half: shelves stand between the aisles.

    hall.py FOLDER LAMPS     writes hall_LAMPS.rad and hall.pts
"""

import math
import pathlib
import sys

from text import box, diffuse, lamp, level_grid, level_panel, room, write_points

LENGTH_M, WIDTH_M, HEIGHT_M = 48.0, 30.0, 8.0
LAMP_HEIGHT_M = 7.5
FLUX_W = 400.0  # of all lamps together, so that each count lights the hall alike
SHELF_HEIGHT_M = 2.2
SHELVES = 6


def _spacing(count):
    """About as many columns to a row as the hall is longer than wide. @return  columns, rows"""
    columns = max(1, round(math.sqrt(count * LENGTH_M / WIDTH_M)))
    return columns, math.ceil(count / columns)


def lamp_places(count):
    columns, rows = _spacing(count)
    return [(LENGTH_M * (index % columns + 0.5) / columns, WIDTH_M * (index // columns + 0.5) / rows, LAMP_HEIGHT_M)
            for index in range(count)]


def lamps(count):
    """`count` square panels that face down."""
    columns, rows = _spacing(count)
    side = min(0.3, 0.4 * min(LENGTH_M / columns, WIDTH_M / rows))
    radiance = FLUX_W / (count * math.pi * side * side)
    return lamp("panel", radiance) + "".join(
        level_panel("panel", f"lamp_{index}", (x - side / 2, y - side / 2), (x + side / 2, y + side / 2), z, facing_up=False)
        for index, (x, y, z) in enumerate(lamp_places(count)))


def shelf_boxes():
    ys = [WIDTH_M * (index + 1) / (SHELVES + 1) for index in range(SHELVES)]
    return [((3, y - 0.3, 0), (LENGTH_M - 3, y + 0.3, SHELF_HEIGHT_M)) for y in ys]


def scene(count, reflectance=0.4):
    """@param reflectance  of all surfaces; 0 leaves direct light alone"""
    text = f"# a hall with {count} lamps\n" + diffuse("wall", reflectance) + diffuse("shelf", reflectance)
    text += room("hall", (0, 0, 0), (LENGTH_M, WIDTH_M, HEIGHT_M), "wall")
    for index, (low, high) in enumerate(shelf_boxes()):
        text += box("shelf", f"shelf_{index}", low, high)
    return text + lamps(count)


def points():
    return level_grid((0, 0), (LENGTH_M, WIDTH_M), 24, 15, 0.8)


if __name__ == "__main__":
    folder, number = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    (folder / f"hall_{number}.rad").write_text(scene(number))
    write_points(folder / "hall.pts", points())
