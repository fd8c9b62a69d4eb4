#!/usr/bin/env python3
"""hall.py FOLDER [LAMPS]: a market hall under a grid of small ceiling panels, with stalls that hide some of them.

Writes FOLDER/hall.rad and FOLDER/hall.txt (points 1 m above the floor, facing up). The flux of all panels together does
not depend on their number. 200 panels unless told: a point sees more than 50 of them.
"""

import pathlib
import random
import sys

WIDTH, DEPTH, HEIGHT = 60.0, 40.0, 9.0
PANELS_M2, RADIANCE = 12.0, 400.0  # area of all panels, W/(m^2 sr)
PANEL_DROP = 0.01
STALLS = 45


def surface(modifier, name, corners):
    numbers = " ".join(f"{c:.9g}" for corner in corners for c in corner)
    return f"{modifier} polygon {name}\n0\n0\n{3 * len(corners)} {numbers}\n\n"


def box(modifier, name, low, high):
    (x0, y0, z0), (x1, y1, z1) = low, high
    sides = [
        [(x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)],
        [(x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)],
        [(x1, y0, z0), (x1, y1, z0), (x1, y1, z1), (x1, y0, z1)],
        [(x1, y1, z0), (x0, y1, z0), (x0, y1, z1), (x1, y1, z1)],
        [(x0, y1, z0), (x0, y0, z0), (x0, y0, z1), (x0, y1, z1)],
    ]
    return "".join(surface(modifier, f"{name}.{i}", side) for i, side in enumerate(sides))


def panels(count):
    """On a grid of cells about 3 to 2, left to right and front to back."""
    columns = max(1, round((count * WIDTH / DEPTH) ** 0.5))
    rows = -(-count // columns)
    half = 0.5 * (PANELS_M2 / count) ** 0.5
    z = HEIGHT - PANEL_DROP
    text = ""
    for i in range(count):
        x, y = WIDTH * (i % columns + 0.5) / columns, DEPTH * (i // columns + 0.5) / rows
        text += surface("lamp", f"panel{i}", [(x - half, y - half, z), (x - half, y + half, z), (x + half, y + half, z),
                                              (x + half, y - half, z)])
    return text


def hall(count):
    text = "void plastic grey\n0\n0\n5 .5 .5 .5 0 0\n\n"
    text += f"void light lamp\n0\n0\n3 {RADIANCE} {RADIANCE} {RADIANCE}\n\n"
    text += surface("grey", "floor", [(0, 0, 0), (WIDTH, 0, 0), (WIDTH, DEPTH, 0), (0, DEPTH, 0)])
    text += surface("grey", "ceiling", [(0, 0, HEIGHT), (0, DEPTH, HEIGHT), (WIDTH, DEPTH, HEIGHT), (WIDTH, 0, HEIGHT)])
    numbers = random.Random(5)
    for i in range(STALLS):
        x, y = 2 + 6.4 * (i % 9), 2 + 7.6 * (i // 9)
        height = numbers.uniform(2, 6)
        text += box("grey", f"stall{i}", (x, y, 0), (x + numbers.uniform(1, 3), y + numbers.uniform(0.3, 3), height))
    return text + panels(count)


def points():
    numbers = random.Random(6)
    return "".join(
        f"{numbers.uniform(0.5, WIDTH - 0.5):.6f} {numbers.uniform(0.5, DEPTH - 0.5):.6f} 6.5 0 0 1\n" if i % 4 == 0 else
        f"{numbers.uniform(0.5, WIDTH - 0.5):.6f} {numbers.uniform(0.5, DEPTH - 0.5):.6f} 1 0 0 1\n"
        for i in range(1000))


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "hall.rad").write_text(hall(int(sys.argv[2]) if len(sys.argv) == 3 else 200))
    (folder / "hall.txt").write_text(points())
