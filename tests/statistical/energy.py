#!/usr/bin/python3
"""Energy: what lamps send out is absorbed or escapes, and closed spheres obey 1 / (1 - reflectance).

    energy.py [--samples 1024] [--sets 8] [--options "..."] [--json FILE]

`balance`: a room with a table, a screen and an opening to the black outside. Sensors lie on every surface and in the
opening at random places, new ones in each of `--sets` runs, so that the spread of the runs holds both the noise of the
light and that of the places. Absorbed = illuminance times 1 - reflectance; lamps absorb all that meets them.
`furnace`: a bulb in a closed sphere of reflectance 0.5 to 0.999; E = pi L f / (1 - reflectance (1 - f)), with f the
bulb's share of the sphere seen from the wall. Status 1 when a difference exceeds 5.4 standard errors (of eight runs) and what
`--bias` allows (relative; rounding alone for plain path tracing).
"""

import argparse
import json
import math
import pathlib
import random
import statistics
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
from program import illuminance
from text import LUMENS_PER_WATT, box, diffuse, faces, lamp, level_panel, polygon, sphere, write_points

LAMP_RADIANCE = 20.0
REFLECTANCES = {"wall": 0.6, "floor": 0.3, "table": 0.5, "screen": 0.8}
LIFT_M = 1e-6  # sensors above their surface
ROUNDING = 1e-5  # of sums, and of what a table prints
SIGMAS = 5.41  # Student, eight runs: one honest row in a thousand


class Rectangles:
    """Surfaces that are written as scene text and can be covered with sensors."""

    def __init__(self):
        self.text, self.items = "", []

    def add(self, material, corners, absorbs):
        self.text += polygon(material, f"{material}_{len(self.items)}", *corners) if material else ""
        self.items.append((corners, absorbs))

    def add_box(self, material, low, high, absorbs, inward=False):
        for corners in faces(low, high).values():
            self.add(material, corners[::-1] if inward else corners, absorbs)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def sensors_on(corners, count, generator):
    """Points in cells of a grid over a rectangle. @return  points, area that each stands for"""
    o, along, across = corners[0], *(tuple(corner[i] - corners[0][i] for i in range(3)) for corner in (corners[1], corners[3]))
    normal = cross(along, across)
    area = math.hypot(*normal)
    normal = tuple(value / area for value in normal)
    points = []
    for i in range(count):
        for j in range(count):
            u, v = (i + generator.random()) / count, (j + generator.random()) / count
            place = tuple(o[k] + u * along[k] + v * across[k] + LIFT_M * normal[k] for k in range(3))
            points.append((*place, *normal))
    return points, area / (count * count)


def room():
    """@return  rectangles, emitted flux in W. An opening of 1 m2 in the wall at y = 0 faces black surroundings."""
    parts = Rectangles()
    parts.text = "".join(diffuse(name, value) for name, value in REFLECTANCES.items()) + lamp("panel", LAMP_RADIANCE)
    shell = faces((0, 0, 0), (4, 3, 2.5))
    for face, corners in shell.items():
        if face != "low_y":
            material = "floor" if face == "low_z" else "wall"
            parts.add(material, corners[::-1], 1 - REFLECTANCES[material])
    front = lambda x0, z0, x1, z1: ((x0, 0, z0), (x0, 0, z1), (x1, 0, z1), (x1, 0, z0))
    for rectangle in (front(0, 0, 4, 1), front(0, 2, 4, 2.5), front(0, 1, 1.5, 2), front(2.5, 1, 4, 2)):
        parts.add("wall", rectangle, 1 - REFLECTANCES["wall"])
    parts.add(None, front(1.5, 1, 2.5, 2), 1.0)
    parts.add_box("table", (0.6, 1.2, 0.7), (1.8, 2.2, 0.75), 1 - REFLECTANCES["table"])
    parts.add_box("screen", (2.6, 0.8, 0.0), (2.65, 2.2, 1.6), 1 - REFLECTANCES["screen"])
    low, high, height = (1.5, 1.0), (2.5, 2.0), 2.4
    corners = ((low[0], low[1], height), (low[0], high[1], height), (high[0], high[1], height), (high[0], low[1], height))
    parts.text += level_panel("panel", "lamp", low, high, height, facing_up=False)
    parts.add(None, corners, 1.0)
    parts.add(None, corners[::-1], 1.0)
    return parts, math.pi * LAMP_RADIANCE * 1.0


def balance(asked, folder):
    parts, emitted = room()
    scene, points_file = folder / "room.rad", folder / "room.pts"
    scene.write_text(parts.text)
    sums = []
    for number in range(asked.sets):
        generator, points, weights = random.Random(number), [], []
        for corners, absorbs in parts.items:
            found, area = sensors_on(corners, 5, generator)
            points += found
            weights += [area * absorbs / LUMENS_PER_WATT] * len(found)
        write_points(points_file, points)
        words = ["--samples", asked.samples, "--seed", number + 1, *asked.options.split()]
        table = illuminance(scene, points_file, folder / "room.csv", words)[1]
        sums.append(sum(weight * lux for weight, lux in zip(weights, table["illuminance_lx"])) / emitted)
    return {"what": "absorbed and escaped / emitted", "found": statistics.fmean(sums), "expected": 1.0,
            "error": statistics.stdev(sums) / math.sqrt(len(sums))}


def furnace(asked, folder, reflectance):
    radius, bulb, radiance, off_m = 1.0, 0.05, 1000.0, 0.01
    scene, points_file = folder / "sphere.rad", folder / "sphere.pts"
    scene.write_text(diffuse("wall", reflectance) + lamp("bulb", radiance) + sphere("wall", "shell", (0, 0, 0), radius) +
                     sphere("bulb", "lamp", (0, 0, 0), bulb))
    share = (bulb / radius) ** 2
    wall = math.pi * radiance * share / (1 - reflectance * (1 - share))
    seen = (bulb / (radius - off_m)) ** 2
    expected = (math.pi * radiance * seen + reflectance * wall * (1 - seen)) * LUMENS_PER_WATT
    directions = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (-0.6, 0.8, 0), (0.6, 0, -0.8), (0, -0.6, 0.8)]
    write_points(points_file, [(*((radius - off_m) * v for v in d), *(-v for v in d)) for d in directions])
    means = []
    for seed in range(1, asked.sets + 1):
        words = ["--samples", asked.samples, "--seed", seed, *asked.options.split()]
        values = illuminance(scene, points_file, folder / "sphere.csv", words)[1]["illuminance_lx"]
        means.append(statistics.fmean(values) / expected)
    return {"what": f"closed sphere, reflectance {reflectance:g}", "found": statistics.fmean(means), "expected": 1.0,
            "error": statistics.stdev(means) / math.sqrt(len(means))}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--samples", type=int, default=1024)
    parser.add_argument("--sets", type=int, default=8)
    parser.add_argument("--options", default="", help="more options of `lightwell illuminance`")
    parser.add_argument("--bias", type=float, default=ROUNDING)
    parser.add_argument("--json", type=pathlib.Path)
    asked = parser.parse_args()
    rows, failed = [], False
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work)
        jobs = [lambda: balance(asked, folder)]
        jobs += [lambda r=r: furnace(asked, folder, r) for r in (0.5, 0.8, 0.95, 0.99, 0.999)]
        for job in jobs:
            row = job()
            row["failed"] = abs(row["found"] - row["expected"]) > SIGMAS * row["error"] + asked.bias
            failed |= row["failed"]
            rows.append(row)
            print(f"{row['what']:35s} {row['found']:.5f} +- {row['error']:.5f}{'   FAILED' if row['failed'] else ''}", flush=True)
    if asked.json:
        asked.json.write_text(json.dumps(rows, indent=1) + "\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
