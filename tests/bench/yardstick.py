#!/usr/bin/python3
"""Accuracy per second beside Radiance: error and CPU seconds of both on the same points, in one run.

    yardstick.py [ROW ...] --yardstick FOLDER [--ladder samples|accuracy|quality|time] [--also "--without cache"]
                 [--seeds 5] [--without-radiance]

Rows: a80 a95 a99 b c c_blended d d_point g g_curve (all without an argument). FOLDER has the scenes' generators and references;
$LIGHTWELL_YARDSTICK stands for it. Radiance's oconv and rtrace are looked for on the PATH. Each setting runs with every
seed; printed are medians: CPU seconds of one thread, apart the share that loading takes (one sensor, fewest samples),
errors relative to the reference with its noise subtracted in quadrature from the RMS, and when each goal was reached.
Kept as results/ROW.json beside this script.
"""

import argparse
import json
import os
import pathlib
import statistics
import sys
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
from errors import bias_and_noise, errors, median_errors, seconds_to_reach
from options import LADDERS, lightwell_ladder, radiance_settings
from program import illuminance, lightwell, run
from rows import BUILDERS, build
from text import LUMENS_PER_WATT, write_points

RESULTS = pathlib.Path(__file__).resolve().parent / "results"
CHANNELS = np.array([0.265, 0.670, 0.065])


def lightwell_run(row, folder, points, options, seed):
    """@return  the run and its values without 179 lm/W"""
    words = [*options.split(), "--seed", seed, "--threads", 1]
    done, table = illuminance(row.scene, points, folder / "lightwell.csv", words)
    return done, np.array(table["illuminance_lx"]) / LUMENS_PER_WATT


def radiance_run(octree, points, options):
    done = run(["rtrace", "-w", "-h", "-I", *options.split(), octree], input_file=points, folder=octree.parent).demand()
    return done, np.array([line.split() for line in done.output.splitlines()], float) @ CHANNELS


def measured(program, setting, options, row, tries):
    """@param tries  (run, values) of each seed"""
    values = [found[row.compared] for _, found in tries]
    return {"program": program, "setting": setting, "options": options,
            "cpu_s": statistics.median(done.cpu_s for done, _ in tries),
            "cpu_s_of_seeds": [done.cpu_s for done, _ in tries],
            "memory_MB": max(done.memory_MB for done, _ in tries),
            **median_errors([errors(found, row.reference, row.noise) for found in values]),
            **bias_and_noise(values, row.reference)}


def load_seconds(row, folder, also):
    one = folder / "one.pts"
    write_points(one, row.points[:1])
    return statistics.median(lightwell_run(row, folder, one, f"--samples 8 {also}", seed)[0].cpu_s for seed in (1, 2, 3))


def measure_row(row, folder, asked):
    points, octree = folder / "grid.pts", folder / "scene.oct"
    write_points(points, row.points)
    settings = []
    for options in lightwell_ladder(asked.ladder, row.name):
        words = f"{options} {asked.also}".strip()
        tries = [lightwell_run(row, folder, points, words, seed) for seed in range(1, asked.seeds + 1)]
        settings.append(measured("Lightwell", words, words, row, tries))
        print(line_of(settings[-1]), flush=True)
    if not asked.without_radiance:
        octree.write_bytes(b"")
        run(["bash", "-c", f"oconv '{row.scene}' > '{octree}'"], folder=folder).demand()
        for name, options in radiance_settings(row.name, row.room_ratio):
            tries = [radiance_run(octree, points, options) for _ in range(asked.seeds)]
            settings.append(measured("Radiance", name, options, row, tries))
            print(line_of(settings[-1]), flush=True)
    return settings


def line_of(setting):
    percent = " | ".join(f"{100 * setting[name]:{sign}.2f}" for name, sign in
                         (("mbe", "+"), ("rms", ""), ("p95", ""), ("max", ""), ("bias_rms", ""), ("noise_rms", "")))
    return (f"| {setting['program']} {setting['setting']} | {setting['cpu_s']:.3f} | {percent} "
            f"| {setting['memory_MB']:.0f} |")


def goal_lines(row, settings):
    for error, seconds in row.goals:
        parts = []
        for program in ("Lightwell", "Radiance"):
            ladder = [(s["cpu_s"], s["rms"]) for s in settings if s["program"] == program]
            if ladder:
                reached, why = seconds_to_reach(error, ladder)
                parts.append(f"{program} {'-' if reached is None else f'{reached:.3f} s'} {why}".strip())
        yield f"goal {100 * error:g} % in {seconds:g} s: " + "; ".join(parts)


def do_row(name, asked):
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work)
        row = build(name, asked.yardstick, folder)
        print(f"\n## {name}: {row.title} (noise of the reference {100 * row.noise:.2f} %)\n")
        load = load_seconds(row, folder, asked.also)
        print(f"loading takes {load:.3f} s of each of Lightwell's runs\n\n"
              "| setting | CPU s | MBE % | RMS % | P95 % | max % | bias % | noise % | MB |\n|---|---|---|---|---|---|---|---|---|")
        settings = measure_row(row, folder, asked)
    goals = list(goal_lines(row, settings))
    print("\n" + "\n".join(goals), flush=True)
    RESULTS.mkdir(exist_ok=True)
    kept = {"row": name, "title": row.title, "program": pathlib.Path(lightwell()).name, "ladder": asked.ladder, "seeds": asked.seeds,
            "reference_noise": row.noise, "load_s": load,
            "goals": goals, "settings": settings}
    (RESULTS / f"{name}.{asked.ladder}.json").write_text(json.dumps(kept, indent=1) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rows", nargs="*", metavar="ROW")
    parser.add_argument("--yardstick", type=pathlib.Path, default=os.environ.get("LIGHTWELL_YARDSTICK"))
    parser.add_argument("--ladder", choices=LADDERS, default="samples")
    parser.add_argument("--also", default="", help="more options of Lightwell for every setting")
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--without-radiance", action="store_true")
    asked = parser.parse_args()
    unknown = set(asked.rows) - set(BUILDERS)
    if unknown or not asked.yardstick or not (pathlib.Path(asked.yardstick) / "scenes").is_dir():
        parser.error(f"no row {', '.join(unknown)}" if unknown else "--yardstick: a folder with scenes/ and reference/")
    asked.yardstick = pathlib.Path(asked.yardstick).resolve()
    for name in asked.rows or BUILDERS:
        do_row(name, asked)


if __name__ == "__main__":
    main()
