#!/usr/bin/python3
"""How well `--plan` foresees cost and error: runs each case and prints predicted beside reached.

    predictions.py [CASE ...] --yardstick FOLDER        FOLDER has the scenes' generators; all cases without an argument

A case holds when cost and error (median standard error) are both within a factor of 2. Cost is judged by rays, which are
the same each time and on every machine; CPU seconds, which are not, are printed beside them. Kept as
results/predictions.json beside this script.
"""
import argparse
import json
import os
import pathlib
import shlex
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
from program import ROOT, lightwell, run
from rows import build
from text import write_points

RESULTS = pathlib.Path(__file__).resolve().parent / "results"
SAMPLES = ROOT / "samples"
SKY = "--sky clear --place 52.5,13.4 --time 2026-03-21T12:00+01:00"
NO_NOISE = 1e-5  # errors below are of no use to anyone: two of them agree


def yardstick_rows():
    """(case, row of the yardstick, options) of maps over the row's own points."""
    return [("sphere", "a80", "--accuracy 1%"), ("white sphere", "a99", "--accuracy 2%"),
            ("office", "b", "--accuracy 0.5%"), ("daylit office", "c_blended", "--accuracy 5%"),
            ("theatre", "d_point", "--accuracy 20%"), ("ball, line", "g", "--accuracy 1%")]


def sample_cases():
    """(case, arguments) of the samples."""
    office = SAMPLES / "office/office.dxf"
    day, night = (SAMPLES / "office" / name for name in ("map_daylight.toml", "map.toml"))
    desks = "--grid layer:A-FLOR-OFFC@0.75/0.5"
    return [
        ("ball room, picture", f"render {SAMPLES}/sphere_room/sphere_room.rad --size 480x270 --accuracy 5% --view "
         "'-vtv -vp 9.4 0.6 1.7 -vd -0.72 0.69 -0.03 -vu 0 0 1 -vh 75 -vv 46.6921'"),
        ("drawn office, day", f"illuminance {office} --map {day} {SKY} {desks} --accuracy 5%"),
        ("drawn office, night", f"illuminance {office} --map {night} {desks} --accuracy 2%"),
        ("drawn office, outside", f"render {office} --map {day} {SKY} --size 480x270 --accuracy 5% --view "
         "'-vtv -vp -15 -20 1.45 -vd 0.62 0.78 0.08 -vu 0 0 1 -vh 55 -vv 32.6421'"),
        ("drawn office, fine map", f"illuminance {office} --map {night} --grid layer:A-FLOR-OFFC@0.75/0.1 "
         "--accuracy 10%"),
    ]


def cases(yardstick, folder):
    """(case, function that writes its files and returns its arguments): scenes are made when they are needed."""
    def of_row(row, options):
        made = build(row, yardstick, folder)
        write_points(folder / f"{row}.pts", made.points)
        return f"illuminance {made.scene} --grid file:{folder}/{row}.pts {options}"
    for name, row, options in yardstick_rows():
        yield name, lambda row=row, options=options: of_row(row, options)
    for name, arguments in sample_cases():
        yield name, lambda arguments=arguments: arguments


def predicted_and_reached(arguments, folder):
    out = folder / ("result" + (".exr" if arguments.startswith("render") else ".csv"))
    run([lightwell(), *shlex.split(arguments), "--plan", "--threads", "1", "-o", out]).demand()
    got = json.loads((folder / "result.run.json").read_text())
    errors = [max(some["median_relative_error"], NO_NOISE) for some in (got["predicted"], got)]
    return {"rays": [got["predicted"]["rays"], got["rays"]["all"]], "error": errors,
            "cpu_s": [got["predicted"]["cpu_seconds"], got["cpu_seconds"]],
            "samples": [got["predicted"]["samples"], got["samples"]], "pilot_cpu_s": got["predicted"]["pilot_cpu_seconds"]}


def ratio(pair):
    return pair[0] / max(pair[1], 1e-12)


def holds(found):
    return all(0.5 <= ratio(found[what]) <= 2 for what in ("rays", "error"))


def line_of(name, found):
    rays, error, cpu = found["rays"], found["error"], found["cpu_s"]
    return (f"| {name} | {rays[0] / 1e6:.2f} | {rays[1] / 1e6:.2f} | {ratio(rays):.2f} | {100 * error[0]:.2f} "
            f"| {100 * error[1]:.2f} | {ratio(error):.2f} | {cpu[0]:.1f} | {cpu[1]:.1f} | {found['pilot_cpu_s']:.1f} "
            f"|{'' if holds(found) else ' missed'}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="CASE")
    parser.add_argument("--yardstick", type=pathlib.Path, default=os.environ.get("LIGHTWELL_YARDSTICK"))
    asked = parser.parse_args()
    if not asked.yardstick or not (pathlib.Path(asked.yardstick) / "scenes").is_dir():
        parser.error("--yardstick: a folder with scenes/")
    print("| case | Mrays expected | reached | ratio | error % expected | reached | ratio | CPU s expected | reached "
          "| pilot |\n|---|---|---|---|---|---|---|---|---|---|")
    results = {}
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        for name, arguments in cases(pathlib.Path(asked.yardstick).resolve(), folder):
            if asked.cases and name not in asked.cases:
                continue
            results[name] = predicted_and_reached(arguments(), folder)
            print(line_of(name, results[name]), flush=True)
    held = sum(holds(found) for found in results.values())
    print(f"\n{held} of {len(results)} within a factor of 2 by rays and error")
    if not asked.cases:
        RESULTS.mkdir(exist_ok=True)
        (RESULTS / "predictions.json").write_text(json.dumps({"held": held, "cases": results}, indent=1) + "\n")


if __name__ == "__main__":
    main()
