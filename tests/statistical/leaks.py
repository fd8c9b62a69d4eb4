#!/usr/bin/python3
"""No light where none can be, and the right light beside thin things.

    leaks.py [SCENE ...] [--settings "--quality draft;--quality normal"] [--plain=--unbiased] [--samples 16384]
             [--largest 0.1] [--pictures FOLDER] [--json FILE]

Scenes of tests/scenes/leak_scenes.py. Inside a sealed box every value must be 0 exactly. Elsewhere each setting is compared with
plain path tracing: the difference beyond three standard errors of both, relative to the value and to the mean of the
points. `--pictures` also renders each scene with each setting and plainly, as NAME.png to be looked at. Status 1 when
light leaked or a difference exceeds `--largest` of the right value (points darker than a twentieth of the mean: of
that).
"""

import argparse
import json
import math
import pathlib
import statistics
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
from leak_scenes import SCENES
from program import illuminance, lightwell, run
from text import write_points

DARKEST_SHARE = 0.05  # a leak that no eye could tell from the light around it
SIGMAS = 3.0
PICTURE = ["--size", "320x240", "--png"]


def compare(found, right):
    """@return  measures of one setting, differences reduced by three standard errors of both"""
    truth = right["illuminance_lx"]
    mean = statistics.fmean(truth)
    scales = [max(value, DARKEST_SHARE * mean) for value in truth]
    differences = [value - expected for value, expected in zip(found["illuminance_lx"], truth)]
    noise = [math.hypot(a, b) for a, b in zip(found["error_lx"], right["error_lx"])]
    beyond = [max(abs(difference) - SIGMAS * error, 0) for difference, error in zip(differences, noise)]
    relative = [difference / scale for difference, scale in zip(differences, scales)]
    worst = max(range(len(truth)), key=lambda i: beyond[i] / scales[i])
    return {"rms": math.sqrt(statistics.fmean(value * value for value in relative)), "mbe": statistics.fmean(relative),
            "largest_beyond_noise": beyond[worst] / scales[worst], "worst_point": worst,
            "worst_found_lx": found["illuminance_lx"][worst], "worst_right_lx": truth[worst],
            "brightest_beyond_of_mean": max(beyond) / mean}


def pictures(name, scene, view, settings, plain, folder):
    for label, options in [("plain", plain)] + [(f"setting{i}", s) for i, s in enumerate(settings)]:
        output = folder / f"{name}_{label}.exr"
        run([lightwell(), "render", scene, "--view", view, "-o", output, *PICTURE, *options]).demand()


def check(name, asked, folder):
    text, points, view = SCENES[name]()
    scene, points_file = folder / f"{name}.rad", folder / f"{name}.pts"
    scene.write_text(text)
    write_points(points_file, points)
    if asked.pictures:
        pictures(name, scene, view, asked.settings, asked.plain, asked.pictures)
    right = illuminance(scene, points_file, folder / "right.csv", ["--samples", asked.samples, "--seed", 7, *asked.plain])[1]
    if name == "sealed":
        right = {key: [0.0] * len(points) for key in right}
    for options in asked.settings:
        done, found = illuminance(scene, points_file, folder / "found.csv", [*options, "--threads", 1])
        row = {"scene": name, "options": options, "cpu_s": done.cpu_s}
        if name == "sealed":
            brightest = max(found["illuminance_lx"])
            row |= {"leak_lx": brightest, "failed": brightest != 0}
        else:
            row |= compare(found, right)
            row["failed"] = row["largest_beyond_noise"] > asked.largest
        yield row


def line_of(row):
    words = " ".join(row["options"])
    if row["scene"] == "sealed":
        return f"| sealed | {words} | brightest {row['leak_lx']:g} lx | | | | {row['cpu_s']:.2f} |"
    return (f"| {row['scene']} | {words} | RMS {100 * row['rms']:.2f} % | {100 * row['mbe']:+.2f} % "
            f"| {100 * row['largest_beyond_noise']:.1f} % ({row['worst_found_lx']:.3g} for {row['worst_right_lx']:.3g} lx) "
            f"| {100 * row['brightest_beyond_of_mean']:.2f} % | {row['cpu_s']:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    parser.add_argument("--settings", default="--quality draft;--quality normal;--quality fine")
    parser.add_argument("--plain", default="--unbiased", help="options that make a grid plain path tracing")
    parser.add_argument("--samples", type=int, default=16384)
    parser.add_argument("--largest", type=float, default=0.1)
    parser.add_argument("--pictures", type=pathlib.Path)
    parser.add_argument("--json", type=pathlib.Path)
    asked = parser.parse_args()
    asked.settings = [words.split() for words in asked.settings.split(";")]
    asked.plain = asked.plain.split()
    rows = []
    print("| scene | setting | error | mean error | worst beyond noise | of the mean | CPU s |\n|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name in asked.scenes or SCENES:
            for row in check(name, asked, pathlib.Path(folder)):
                print(line_of(row), flush=True)
                rows.append(row)
    if asked.json:
        asked.json.write_text(json.dumps(rows, indent=1) + "\n")
    return 1 if any(row["failed"] for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
