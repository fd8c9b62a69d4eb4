#!/usr/bin/python3
"""Shadow rays that adaptive testing saves, and what 100,000 lamps cost beside 100.

    many_lamps.py [--lamps 120] [--many 100000] [--settings "threshold=.01;threshold=.1"]

The hall of tests/scenes/hall.py, 360 points, direct light alone by bench_direct_points (to be built first), one thread.
First how many lamps a point sees, from the geometry; then for each setting the shadow rays a point, their share of
those that test all lamps, and the RMS error against testing all; the shares at 1, 5 and 10 % error lie between
measured settings. Then the time for 100 and for `--many` lamps of the same total flux. Kept as results/many_lamps.json.
"""

import argparse
import json
import pathlib
import re
import sys
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
import hall
from errors import errors
from program import ROOT, run
from text import write_points

PROGRAM = ROOT / "build/release/tests/bench/bench_direct_points"
RESULTS = pathlib.Path(__file__).resolve().parent / "results"
ALL = "adaptive=0 tree=0 threshold=0"
SETTINGS = ";".join(f"threshold={threshold}" for threshold in (0.001, 0.003, 0.01, 0.03, 0.1, 0.2, 0.4, 0.8))
LINE = re.compile(r"lamps (\d+) built ([\d.]+) s gathers ([\d.]+) s .*shadow_rays ([\d.]+)/point")


def seen_lamps(count):
    """Lamps whose centre a point sees past the shelves, for each point."""
    centres = np.array(hall.lamp_places(count))
    counts = []
    for x, y, z, *_ in hall.points():
        way = centres - (x, y, z)
        free = np.ones(len(centres), bool)
        for low, high in hall.shelf_boxes():
            with np.errstate(divide="ignore", invalid="ignore"):
                a, b = (np.array(low) - (x, y, z)) / way, (np.array(high) - (x, y, z)) / way
            enter, leave = np.nanmax(np.minimum(a, b), axis=1), np.nanmin(np.maximum(a, b), axis=1)
            free &= ~((enter < leave) & (leave > 1e-9) & (enter < 1))
        counts.append(int(free.sum()))
    return counts


def gathers(scene, points, setting):
    done = run([PROGRAM, scene, points, *setting.split()]).demand()
    lamps, built, seconds, rays = LINE.search(done.errors).groups()
    return {"setting": setting, "lamps": int(lamps), "built_s": float(built), "gathers_s": float(seconds),
            "rays": float(rays), "memory_MB": done.memory_MB}, np.array(done.output.split(), float)


def between(ladder, goal):
    """Shadow rays at an error, between measured settings; None when none of them errs so little."""
    steps = sorted((row["error"]["rms"], row["rays"]) for row in ladder)
    below = [step for step in steps if step[0] <= goal]
    if not below:
        return None
    (e0, r0), above = below[-1], [step for step in steps if step[0] > goal]
    if not above or e0 <= 0:
        return r0
    e1, r1 = above[0]
    return r0 + (r1 - r0) * (np.log(goal / e0) / np.log(e1 / e0))


def savings(folder, points, settings, count):
    scene = folder / "hall.rad"
    scene.write_text(hall.scene(count, reflectance=0))
    seen = seen_lamps(count)
    print(f"{count} lamps, of which a point sees {min(seen)} to {max(seen)}, median {int(np.median(seen))}\n")
    every, right = gathers(scene, points, ALL)
    print("| setting | shadow rays a point | of all | RMS % | max % | CPU s |\n|---|---|---|---|---|---|")
    ladder = []
    for setting in settings:
        row, values = gathers(scene, points, setting)
        row["error"] = errors(values, right)
        ladder.append(row)
        print(f"| {setting} | {row['rays']:.1f} | {100 * row['rays'] / every['rays']:.0f} % | {100 * row['error']['rms']:.2f} "
              f"| {100 * row['error']['max']:.1f} | {row['gathers_s']:.4f} |")
    print(f"| all tested | {every['rays']:.1f} | 100 % | 0 | 0 | {every['gathers_s']:.4f} |\n")
    for goal in (0.01, 0.05, 0.1):
        rays = between(ladder, goal)
        print(f"at {100 * goal:g} % error: " + ("not reached" if rays is None else
                                             f"{100 * (1 - rays / every['rays']):.0f} % of the shadow rays saved"))
    return {"seen": seen, "all": every, "ladder": ladder}


def growth(folder, points, many):
    rows = []
    for count in (100, many):
        scene = folder / f"hall_{count}.rad"
        scene.write_text(hall.scene(count, reflectance=0))
        rows.append(gathers(scene, points, "threshold=.01")[0])
    few, lot = rows
    print(f"\n{lot['lamps']} lamps: {lot['gathers_s']:.3f} s for the gathers, {lot['gathers_s'] / few['gathers_s']:.2f} times "
          f"those of {few['lamps']} ({few['gathers_s']:.3f} s); building the lists takes {lot['built_s']:.2f} s")
    return rows


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lamps", type=int, default=120)
    parser.add_argument("--many", type=int, default=100000)
    parser.add_argument("--settings", default=SETTINGS)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as work:
        work = pathlib.Path(work)
        write_points(work / "hall.pts", hall.points())
        result = {"savings": savings(work, work / "hall.pts", asked.settings.split(";"), asked.lamps),
                  "growth": growth(work, work / "hall.pts", asked.many)}
    RESULTS.mkdir(exist_ok=True)
    (RESULTS / "many_lamps.json").write_text(json.dumps(result, indent=1) + "\n")
