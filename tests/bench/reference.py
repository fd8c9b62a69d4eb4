#!/usr/bin/python3
"""Makes a reference table from many independent runs; their spread gives the standard error of each point.

    reference.py ROW --runs N --yardstick FOLDER --keep FOLDER

    g                     Lightwell, plain path tracing, 131,072 samples a point and run
    c_blended             Radiance without cache: mirrored suns, 900 divisions, any number of bounces; and Lightwell, plain path
                          tracing, 32,768 samples, --lightwell-runs of them; weighted by their noise
    c                     the same plus the small difference that the other sky makes, found by Radiance by itself
    d, d_point            bench_exhaustive_spots (to be built first): 8192 places on every lamp; one run is all there is

Each run is kept as a file in --keep, and a call goes on where the last one stopped. Writes a file of references/ with the
columns x,y,z,dx,dy,dz,value,standard error; value without 179 lm/W.
"""

import argparse
import os
import pathlib
import sys
import tempfile
import time

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
from errors import compared_with
from program import ROOT, illuminance, run
from rows import BUILDERS, REFERENCES, build, difference_sky
from text import LUMENS_PER_WATT, write_points

CHANNELS = np.array([0.265, 0.670, 0.065])
BRUTE = "-u+ -aa 0 -as 0 -lr -24 -lw 1e-8 -ds 0 -dj 1 -dt 0 -dc 1 -dr 2 -st 0 -ss 1 -ab 12 -ad 900"
PLACES = 8192
EXHAUSTIVE = ROOT / "build/release/tests/bench/bench_exhaustive_spots"
SAMPLES = 131072
SAMPLES_BESIDE = 32768  # where Radiance is asked as well
COMMANDS = {"g": f"lightwell illuminance --samples {SAMPLES}", "c": f"rtrace {BRUTE}", "c_blended": f"rtrace {BRUTE}",
            "d": f"bench_exhaustive_spots, {PLACES} places on each lamp",
            "d_point": f"bench_exhaustive_spots, {PLACES} places on each lamp"}
FILES = {"g": "g_line.csv", "c": "c_daylit.csv", "c_blended": "c_blended_daylit.csv", "d": "d_theatre.csv",
         "d_point": "d_point_theatre.csv"}


def rtrace(scene, points, options):
    octree = scene.with_suffix(".oct")
    run(["bash", "-c", f"oconv '{scene}' > '{octree}'"], folder=scene.parent).demand()
    done = run(["rtrace", "-w", "-h", "-I", *options.split(), octree], input_file=points, folder=scene.parent).demand()
    return np.array([line.split() for line in done.output.splitlines()], float) @ CHANNELS


def one_run(row, points, number):
    if row.name == "g":
        words = ["--samples", SAMPLES, "--seed", number, "--threads", 1]
        return np.array(illuminance(row.scene, points, row.scene.with_suffix(".csv"), words)[1]["illuminance_lx"]) / \
            LUMENS_PER_WATT
    time.sleep(1.1)  # rtrace -u+ takes its seed from the clock, in whole seconds
    return rtrace(row.scene, points, COMMANDS[row.name].removeprefix("rtrace "))


def difference(row, points):
    """What the sky as given adds to the blended one, relative errors of a few per cent being small in it."""
    found = []
    for part in ("pos", "neg"):
        scene = row.scene.with_name(f"difference_{part}.rad")
        scene.write_text(difference_sky(row.scene, part))
        found.append(rtrace(scene, points, BRUTE))
    return found[0] - found[1]


def exhaustive(row, points, keep):
    """@return  values and standard errors"""
    keep.mkdir(parents=True, exist_ok=True)
    file = keep / "exhaustive.txt"
    if not file.exists():
        file.write_text(run([EXHAUSTIVE, row.scene, points, PLACES]).demand().output)
    return np.loadtxt(file).T


def kept_runs(row, points, keep, count):
    keep.mkdir(parents=True, exist_ok=True)
    for number in range(1, count + 1):
        file = keep / f"run_{number}.txt"
        if not file.exists():
            np.savetxt(file, one_run(row, points, number), fmt="%.9g")
            print(f"{row.name}: run {number} of {count}", file=sys.stderr)
    return np.array([np.loadtxt(keep / f"run_{number}.txt") for number in range(1, count + 1)])


def beside(row, points, keep, count):
    """Plain path tracing by Lightwell. @return  mean values and their standard errors, from those that the runs state"""
    found = []
    for number in range(1, count + 1):
        file = keep / f"lightwell_{number}.txt"
        if not file.exists():
            words = ["--samples", SAMPLES_BESIDE, "--seed", number, "--threads", 1, "--unbiased"]
            table = illuminance(row.scene, points, row.scene.with_suffix(".csv"), words)[1]
            np.savetxt(file, np.column_stack([table["illuminance_lx"], table["error_lx"]]) / LUMENS_PER_WATT, fmt="%.9g")
        found.append(np.loadtxt(file))
    values, errors = np.array(found).transpose(2, 0, 1)
    return values.mean(axis=0), np.sqrt((errors ** 2).sum(axis=0)) / count


def weighted(first, second):
    """Two independent estimates by the inverse of their mean variances; says how they differ on standard output."""
    variances = [float(np.mean((error / compared_with(values)) ** 2)) for values, error in (first, second)]
    share = variances[1] / sum(variances)
    difference = (second[0] - first[0]) / compared_with(first[0])
    print(f"the two differ by {100 * difference.mean():+.2f} % in the mean, {100 * np.sqrt(np.mean(difference ** 2)):.2f} % RMS "
          f"a point; expected from their noise {100 * np.sqrt(sum(variances)):.2f} %")
    return (share * first[0] + (1 - share) * second[0],
            np.hypot(share * first[1], (1 - share) * second[1]))


def estimate(asked, row, points):
    """@return  values, standard errors, and how many runs they come from, in words"""
    if asked.row.startswith("d"):
        return *exhaustive(row, points, asked.keep), ""
    runs = kept_runs(row, points, asked.keep, asked.runs)
    values, error = runs.mean(axis=0), runs.std(axis=0, ddof=1) / np.sqrt(len(runs))
    how = f", {len(runs)} independent runs"
    if asked.lightwell_runs and asked.row.startswith("c"):
        values, error = weighted((values, error), beside(row, points, asked.keep, asked.lightwell_runs))
        how += f"; and lightwell illuminance --unbiased --samples {SAMPLES_BESIDE}, {asked.lightwell_runs} runs"
    if asked.row == "c":
        values = values + difference(row, points)
    return values, error, how


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("row", choices=FILES)
    parser.add_argument("--runs", type=int, default=16)
    parser.add_argument("--lightwell-runs", type=int, default=0, help="of c and c_blended, beside those of Radiance")
    parser.add_argument("--yardstick", type=pathlib.Path, default=os.environ.get("LIGHTWELL_YARDSTICK"))
    parser.add_argument("--keep", type=pathlib.Path, required=True)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work)
        base = build("c_blended" if asked.row == "c" else asked.row, pathlib.Path(asked.yardstick).resolve(), folder,
                     with_reference=False)
        places = [base.points[index] for index in base.compared]
        write_points(folder / "grid.pts", places)
        values, error, how = estimate(asked, base, folder / "grid.pts")
    noise = 100 * np.sqrt(np.mean((error / compared_with(values)) ** 2))
    header = (f"{asked.row}: {COMMANDS[asked.row]}{how}, noise of a point {noise:.2f} %\n"
              "x,y,z,dx,dy,dz,value,standard_error")
    REFERENCES.mkdir(exist_ok=True)
    np.savetxt(REFERENCES / FILES[asked.row], np.column_stack([np.array(places), values, error]), delimiter=",",
               fmt="%.9g", header=header)
    print(header)


if __name__ == "__main__":
    main()
