#!/usr/bin/python3
"""How well `--plan` foresees cost and error: runs each case and prints predicted beside reached.

    predictions.py LIGHTWELL FOLDER        FOLDER holds the yardstick scenes (box_0.8.rad, office.rad, ...)

A case holds when cost (CPU seconds) and error (median standard error) are both within a factor of 2.
"""
import json
import os
import subprocess
import sys
import tempfile

SAMPLES = os.path.join(os.path.dirname(__file__), "..", "..", "samples")
SKY = "--sky clear --place 52.5,13.4 --time 2026-03-21T12:00+01:00"

NO_NOISE = 1e-5  # errors below are of no use to anyone: two of them agree


def cases(folder):
    """(name, arguments) of each case; the effort is such that a run takes seconds."""
    at = lambda name: os.path.join(folder, name)
    office = os.path.join(SAMPLES, "office", "office.dxf")
    day, night = (os.path.join(SAMPLES, "office", m) for m in ("map_daylight.toml", "map.toml"))
    sphere_room = os.path.join(SAMPLES, "sphere_room", "sphere_room.rad")
    desks = "--grid layer:A-FLOR-OFFC@0.75/0.5"
    return [
        ("box 0.2", f"illuminance {at('box_0.2.rad')} --grid file:{at('box.pts')} --accuracy 0.5%"),
        ("box 0.95", f"illuminance {at('box_0.95.rad')} --grid file:{at('box.pts')} --accuracy 2%"),
        ("sphere 0.8", f"illuminance {at('sphere_0.8.rad')} --grid file:{at('sphere.pts')} --accuracy 1%"),
        ("office panels", f"illuminance {at('office.rad')} --grid file:{at('office.pts')} --accuracy 1%"),
        ("daylit office", f"illuminance {at('c/scene.rad')} {SKY} --grid file:{at('daylit.pts')} --accuracy 10%"),
        ("theatre", f"illuminance {at('theatre.rad')} --grid file:{at('theatre.pts')} --accuracy 20%"),
        ("ball, line", f"illuminance {at('ball.rad')} --grid file:{at('line.pts')} --accuracy 1%"),
        ("ball room, picture", f"render {sphere_room} --size 480x270 --accuracy 5% --view "
         "'-vtv -vp 9.4 0.6 1.7 -vd -0.72 0.69 -0.03 -vu 0 0 1 -vh 75 -vv 46.6921'"),
        ("drawn office, day", f"illuminance {office} --map {day} {SKY} {desks} --accuracy 5%"),
        ("drawn office, night", f"illuminance {office} --map {night} {desks} --accuracy 2%"),
        ("drawn office, outside", f"render {office} --map {day} {SKY} --size 480x270 --accuracy 5% --view "
         "'-vtv -vp -15 -20 1.45 -vd 0.62 0.78 0.08 -vu 0 0 1 -vh 55 -vv 32.6421'"),
    ]


def run(lightwell, arguments, folder):
    out = os.path.join(folder, "result" + (".exr" if arguments.startswith("render") else ".csv"))
    subprocess.run(f"{lightwell} {arguments} --plan -o {out}", shell=True, check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    with open(os.path.join(folder, "result.run.json")) as file:
        return json.load(file)


def main():
    lightwell, folder = sys.argv[1:3]
    print(f"{'case':24} {'cost':>8} {'reached':>8} {'ratio':>6}   {'error':>7} {'reached':>7} {'ratio':>6}  pilot")
    held = 0
    with tempfile.TemporaryDirectory() as temporary:
        for name, arguments in cases(folder):
            got = run(lightwell, arguments, temporary)
            expected = got["predicted"]
            cost = expected["cpu_seconds"] / max(got["cpu_seconds"], 1e-9)
            errors = [max(run["median_relative_error"], NO_NOISE) for run in (expected, got)]
            error = errors[0] / errors[1]
            good = all(0.5 <= ratio <= 2 for ratio in (cost, error))
            held += good
            print(f"{name:24} {expected['cpu_seconds']:8.2f} {got['cpu_seconds']:8.2f} {cost:6.2f}   "
                  f"{expected['median_relative_error']:7.2%} {got['median_relative_error']:7.2%} {error:6.2f}  "
                  f"{expected['pilot_cpu_seconds']:.2f} s{'' if good else '  MISSED'}", flush=True)
    print(f"{held} of {len(cases(folder))} within a factor of 2")


if __name__ == "__main__":
    main()
