#!/usr/bin/python3
"""Direct illuminance 1.5 m above the stage, by points on each lamp and shadow rays; prints expected.json.

    reference.py [POINTS]      a side, so POINTS^2 on each lamp; 8 by default

Written apart from the engine: each point of a lens sends its radiance into the cone about the lamp's aim; what stands
on the stage, the proscenium and the curtains block it. Needs numpy.
"""
import json
import math
import sys

import numpy as np

import draw_theatre as drawing

HEIGHT = 1.5
COLUMNS, ROWS, CORNER, SPACING = 20, 12, (-5.0, 1.0), 0.5


def sensors():
    return np.array([(CORNER[0] + (i + 0.5) * SPACING, CORNER[1] + (j + 0.5) * SPACING, HEIGHT)
                     for j in range(ROWS) for i in range(COLUMNS)])


def blocked(starts, ends):
    """Whether anything stands between the points, for each pair."""
    ways = ends - starts
    found = np.zeros(len(starts), bool)
    with np.errstate(divide="ignore", invalid="ignore"):
        for _, low, high in drawing.boxes():
            a, b = (np.array(low) - starts) / ways, (np.array(high) - starts) / ways
            enter, leave = np.minimum(a, b).max(1), np.maximum(a, b).min(1)
            found |= (enter < leave) & (leave > 1e-9) & (enter < 1)
        upright, heads = drawing.rounds()
        for _, x, y, low, high, wide, narrow in upright:
            found |= hits_cone(starts, ways, x, y, low, high, wide, narrow)
        for x, y, z, radius in heads:
            p = starts - np.array([x, y, z])
            a, b, c = (ways ** 2).sum(1), (p * ways).sum(1), (p ** 2).sum(1) - radius ** 2
            t = -b / a
            found |= (c < 0) | ((b * b > a * c) & (t > 0) & (t < 1))
        for _, low, high, foot in drawing.curtains():
            for a, b in zip(foot, foot[1:]):
                found |= hits_fold(starts, ways, np.array(a), np.array(b), low, high)
    return found


def hits_cone(starts, ways, x, y, low, high, wide, narrow):
    slope = (narrow - wide) / (high - low)
    px, py, pr = starts[:, 0] - x, starts[:, 1] - y, wide + slope * (starts[:, 2] - low)
    dx, dy, dr = ways[:, 0], ways[:, 1], slope * ways[:, 2]
    a, b, c = dx ** 2 + dy ** 2 - dr ** 2, px * dx + py * dy - pr * dr, px ** 2 + py ** 2 - pr ** 2
    found = np.zeros(len(starts), bool)
    root = np.sqrt(np.maximum(b * b - a * c, 0))
    for t in ((-b - root) / a, (-b + root) / a):
        z = starts[:, 2] + t * ways[:, 2]
        found |= (b * b > a * c) & (t > 1e-9) & (t < 1) & (z > low) & (z < high)
    t = (high - starts[:, 2]) / ways[:, 2]
    beside = (px + t * dx) ** 2 + (py + t * dy) ** 2
    return found | ((t > 1e-9) & (t < 1) & (beside < narrow ** 2))


def hits_fold(starts, ways, a, b, low, high):
    along = b - a
    normal = np.array([-along[1], along[0]])
    t = ((a - starts[:, :2]) @ normal) / (ways[:, :2] @ normal)
    met = starts + t[:, None] * ways
    u = ((met[:, :2] - a) @ along) / (along @ along)
    return (t > 1e-9) & (t < 1) & (u > 0) & (u < 1) & (met[:, 2] > low) & (met[:, 2] < high)


def lens_points(centre, way, side, generator):
    """One point in each of side x side cells of equal area."""
    cell = np.stack(np.meshgrid(np.arange(side), np.arange(side)), -1).reshape(-1, 2)
    u = (cell + generator.random(cell.shape)) / side
    radius, turn = drawing.LAMP_RADIUS * np.sqrt(u[:, 0]), 2 * math.pi * u[:, 1]
    aside = np.cross(way, [1.0, 0, 0])
    aside /= np.linalg.norm(aside)
    other = np.cross(way, aside)
    return centre + (radius * np.cos(turn))[:, None] * aside + (radius * np.sin(turn))[:, None] * other


def main(arguments):
    side = int(arguments[0]) if arguments else 8
    generator = np.random.default_rng(108)
    points = sensors()
    found = np.zeros(len(points))
    for _, strength, angle, centre, aim in drawing.lamps():
        way = np.array(aim) / np.linalg.norm(aim)
        lens = lens_points(np.array(centre), way, side, generator)
        starts, ends = np.repeat(points, len(lens), 0), np.tile(lens, (len(points), 1))
        to_lamp = ends - starts
        squared = (to_lamp ** 2).sum(1)
        cosine_lamp, cosine_here = -(to_lamp @ way) / np.sqrt(squared), to_lamp[:, 2] / np.sqrt(squared)
        lit = np.flatnonzero((cosine_lamp > math.cos(math.radians(angle / 2))) & (cosine_here > 0))
        lit = lit[~blocked(starts[lit], ends[lit])]
        area = math.pi * drawing.LAMP_RADIUS ** 2 / len(lens)
        np.add.at(found, lit // len(lens), strength * area * cosine_lamp[lit] * cosine_here[lit] / squared[lit])
    rows = found.reshape(ROWS, COLUMNS)
    print(json.dumps({
        "about": "Direct illuminance 1.5 m above the stage (reference.py, %d points on each lamp)" % side ** 2,
        "unit": "lx", "lamps": len(drawing.lamps()),
        "rows": [{"y_m": CORNER[1] + (j + 0.5) * SPACING, "mean_lx": round(float(row.mean()), 2)}
                 for j, row in enumerate(rows)],
        "mean_lx": round(float(found.mean()), 2), "largest_lx": round(float(found.max()), 1)}, indent=1))


if __name__ == "__main__":
    main(sys.argv[1:])
