"""A hall with many small lamps, of which a point sees at least half: shelves stand between the aisles.

    hall.py FOLDER LAMPS     writes hall_LAMPS.rad and hall.pts
"""

import math
import pathlib
import sys

from text import box, diffuse, lamp, level_grid, level_panel, room, write_points

LENGTH_M, WIDTH_M, HEIGHT_M = 48.0, 30.0, 8.0
LAMP_HEIGHT_M = 7.5
LAMPS_FLUX_PER_RADIANCE = 400.0  # W in all for a hall, shared by the lamps, so that each count lights it alike
SHELF_HEIGHT_M = 1.6
SHELVES = 6


def lamps(count):
    """`count` square panels that face down, about as many columns to a row as the hall is longer than wide."""
    columns = max(1, round(math.sqrt(count * LENGTH_M / WIDTH_M)))
    rows = math.ceil(count / columns)
    side = min(0.3, 0.4 * min(LENGTH_M / columns, WIDTH_M / rows))
    radiance = LAMPS_FLUX_PER_RADIANCE / (count * math.pi * side * side)
    text = lamp("panel", radiance)
    for index in range(count):
        x = LENGTH_M * (index % columns + 0.5) / columns
        y = WIDTH_M * (index // columns + 0.5) / rows
        text += level_panel("panel", f"lamp_{index}", (x - side / 2, y - side / 2), (x + side / 2, y + side / 2),
                            LAMP_HEIGHT_M, facing_up=False)
    return text


def scene(count, reflectance=0.4):
    """@param reflectance  of all surfaces; 0 leaves direct light alone"""
    text = f"# a hall with {count} lamps\n" + diffuse("wall", reflectance) + diffuse("shelf", reflectance)
    text += room("hall", (0, 0, 0), (LENGTH_M, WIDTH_M, HEIGHT_M), "wall")
    for index in range(SHELVES):
        y = WIDTH_M * (index + 1) / (SHELVES + 1)
        text += box("shelf", f"shelf_{index}", (3, y - 0.3, 0), (LENGTH_M - 3, y + 0.3, SHELF_HEIGHT_M))
    return text + lamps(count)


def points():
    return level_grid((0, 0), (LENGTH_M, WIDTH_M), 24, 15, 0.8)


if __name__ == "__main__":
    folder, number = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    (folder / f"hall_{number}.rad").write_text(scene(number))
    write_points(folder / "hall.pts", points())
