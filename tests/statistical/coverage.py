#!/usr/bin/python3
"""Do stated 95 % intervals hold the truth in 95 of 100 runs, and are they no wider than they must be?

    coverage.py [SCENE ...] [--runs 200] [--effort 1] [--false-alarm 0.01] [--json FILE] [-- OPTION ...]

Each scene of tests/scenes/trust_scenes.py is computed with `--runs` seeds, and the truth by plain path tracing with many
more samples. Counted are runs, for one sensor and for the mean of the grid. Status 1 when a count falls short of the
honest one (182 of 200) or a width exceeds 1.5 times the needed one. What follows `--` goes to `lightwell illuminance`
in place of the scene's samples. Seconds for `--runs 20`, minutes for 200.
"""

import argparse
import json
import math
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
from intervals import Quantity, half_width, least_hits
from program import illuminance
from text import write_points
from trust_scenes import BIASED, SCENES

# Samples of a run: where a replicate's mean is nearly normal. Rare bright paths need more of them.
SAMPLES = {"easy": 128, "bright_walls": 512, "bright_slit": 512, "small_source": 16384, "glossy": 2048, "sun_opening": 16384}
# Samples of the truth, by plain path tracing, to those of a run: its error must be a fraction of a run's.
TRUTH_FACTOR, TRUTH_FACTORS = 64, {"bright_walls": 1024, "bright_slit": 1024}
TRUTH_SEED = 990001
MEAN_ERROR = "mean_error_lx"
UNSTATED_MEAN = "mean, if independent"  # shown, never failed
PLAIN = ["--unbiased"]  # options that make grids plain path tracing
WIDEST = 1.5
SENSOR = 5  # the one that stands for all; any other would do


def measure(scene_file, points_file, folder, seed, options):
    """@return  {quantity: (value, standard error, bias estimate)} and CPU seconds.

    The mean's error is the program's where it states one (`mean_error_lx` in map.run.json); else it is that of
    independent sensors, which those that share a cache are not: `mean, if independent`."""
    run, table = illuminance(scene_file, points_file, folder / "map.csv", [*options, "--seed", seed, "--threads", 1])
    stated = json.loads((folder / "map.run.json").read_text())["settings"]
    values, errors = table["illuminance_lx"], table["error_lx"]
    biases = table.get("bias_lx", [0.0] * len(values))
    count = len(values)
    independent = math.sqrt(sum(error * error for error in errors)) / count
    name = "mean" if MEAN_ERROR in stated else UNSTATED_MEAN
    return {"sensor": (values[SENSOR], errors[SENSOR], biases[SENSOR]),
            name: (sum(values) / count, float(stated.get(MEAN_ERROR, independent)), sum(biases) / count)}, run.cpu_s


def coverage(name, runs, effort, folder, options):
    """@return  a summary for each quantity of the scene"""
    text, points = (SCENES | BIASED)[name]()
    scene_file, points_file = folder / f"{name}.rad", folder / f"{name}.pts"
    scene_file.write_text(text)
    write_points(points_file, points)
    samples = max(16, round(SAMPLES[name] * effort))
    truths, _ = measure(scene_file, points_file, folder, TRUTH_SEED, ["--samples", samples * TRUTH_FACTORS.get(name, TRUTH_FACTOR), *PLAIN])
    quantities = [Quantity(kind, truth[0], truth[1]) for kind, truth in truths.items()]
    seconds = 0.0
    for seed in range(1, runs + 1):
        found, cpu_s = measure(scene_file, points_file, folder, seed, options or ["--samples", samples])
        seconds += cpu_s
        for quantity, estimate in zip(quantities, found.values()):
            quantity.add(*estimate)
    return [{"scene": name, "samples": samples, "options": options, "cpu_s_a_run": seconds / runs,
             "truth_half_width": half_width(quantity.truth_error) / quantity.truth, **quantity.summary()}
            for quantity in quantities]


def table_line(row):
    return (f"| {row['scene']} | {row['quantity']} | {row['hits']} of {row['runs']} | {row['hits_with_bias']} | {row['width_ratio']:.2f} "
            f"| {100 * row['relative_spread']:.2f} % | {100 * row['relative_bias']:+.2f} +- "
            f"{100 * row['relative_bias_error']:.2f} % | {100 * row['stated_relative_bias']:+.2f} % "
            f"| {row['cpu_s_a_run']:.3f} |")


def words():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", choices=[*SCENES, *BIASED, []], default=[])
    parser.add_argument("--runs", type=int, default=200)
    parser.add_argument("--effort", type=float, default=1.0, help="factor of the samples of each run")
    parser.add_argument("--false-alarm", type=float, default=0.01, help="of one count, decides the least hits")
    parser.add_argument("--json", type=pathlib.Path)
    own, _, rest = " ".join(sys.argv[1:]).partition(" -- ")
    return parser.parse_args(own.split()), rest.split()


def main():
    asked, options = words()
    least, failed, rows = least_hits(asked.runs, false_alarm=asked.false_alarm), False, []
    print(f"intervals must hold in at least {least} of {asked.runs} runs and be at most {WIDEST} times as wide as needed")
    print("| scene | quantity | holds | widened by bias | width / needed | spread | true bias | stated bias | CPU s |\n"
          "|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name in asked.scenes or SCENES:
            for row in coverage(name, asked.runs, asked.effort, pathlib.Path(folder), options):
                print(table_line(row), flush=True)
                claimed = row["quantity"] != UNSTATED_MEAN
                failed |= claimed and (row["hits"] < least or row["width_ratio"] > WIDEST)
                rows.append(row)
    if asked.json:
        asked.json.write_text(json.dumps({"least": least, "rows": rows}, indent=1) + "\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
