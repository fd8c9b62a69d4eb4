#!/usr/bin/python3
"""The samples light_shelf, theatre and forest give the numbers that their READMEs promise.

    light_test.py NAME      NAME of a check; the program in the environment variable LIGHTWELL
"""
import csv
import json
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

SAMPLES = Path(__file__).resolve().parents[2] / "samples"
PROGRAM = os.environ.get("LIGHTWELL", "lightwell")


def run(*words):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def column(file, *names):
    with open(file) as lines:
        return [tuple(float(row[n]) for n in names) for row in csv.DictReader(lines)]


def scripts_draw_the_files():
    for sample, script, tells in (("light_shelf", "draw_light_shelf.py", ""), ("theatre", "draw_theatre.py", ""),
                                  ("forest", "draw_forest.py", "{'needles': 57153600, 'leaves': 736736}")):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([sys.executable, "-B", SAMPLES / sample / script, folder], check=True,
                                  capture_output=True, text=True)
            assert done.stdout.strip() == tells, done.stdout
            made = {path.name: path.read_bytes() for path in Path(folder).iterdir()}
        kept = {path.name: path.read_bytes() for path in (SAMPLES / sample).iterdir() if path.name in made}
        assert len(made) >= 4 and made == kept, "%s is not what %s draws" % (sample, script)


def light_shelf_agrees_with_its_reference():
    """The sun by way of the mirror is most of the light from 1 to 4 m, so that its absence cannot pass."""
    expected = json.loads((SAMPLES / "light_shelf/expected.json").read_text())
    with tempfile.TemporaryDirectory() as folder:
        for name, key in (("shelf", "with_shelf"), ("plain", "without_shelf")):
            run("run", SAMPLES / ("light_shelf/project_%s.toml" % name), "--only", "depth_" + name, "--unbiased",
                "--samples", 65536, "-o", folder)
            found = column(Path(folder) / ("depth_%s.csv" % name), "y", "illuminance_lx", "error_lx")
            assert len(found) == len(expected[key]) == 18
            for (y, value, error), row in zip(found, expected[key]):
                allowed = 4 * math.hypot(error, row["standard_error_lx"]) + 0.02 * row["mean_lx"]
                assert y == row["y_m"] and allowed < 0.25 * row["mean_lx"]
                assert abs(value - row["mean_lx"]) < allowed, "%s at %g m: %g lx, expected %g" % (key, y, value, row["mean_lx"])


def theatre_has_the_direct_light_of_its_reference():
    expected = json.loads((SAMPLES / "theatre/expected.json").read_text())
    with tempfile.TemporaryDirectory() as folder:
        run("run", SAMPLES / "theatre/project_direct.toml", "-o", folder)
        found = column(Path(folder) / "stage_direct.csv", "y", "illuminance_lx")
    assert len(found) == 240
    mean = sum(value for _, value in found) / len(found)
    assert abs(mean / expected["mean_lx"] - 1) < expected["relative_tolerance_of_mean"], "mean %g lx" % mean
    for row in expected["rows"]:
        values = [value for y, value in found if abs(y - row["y_m"]) < 1e-9]
        mean = sum(values) / len(values)
        assert abs(mean / row["mean_lx"] - 1) < expected["relative_tolerance_of_rows"], "y = %g m: %g lx" % (row["y_m"], mean)


def forest_lets_through_the_light_it_should():
    with tempfile.TemporaryDirectory() as folder:
        run("run", SAMPLES / "forest/project.toml", "--only", "above_trees", "--only", "under_trees", "--unbiased",
            "--samples", 512, "-o", folder)
        above = [value for value, in column(Path(folder) / "above_trees.csv", "illuminance_lx")]
        under = [value for value, in column(Path(folder) / "under_trees.csv", "illuminance_lx")]
    open_air = 80000 * math.sin(math.radians(38)) + 13000
    assert len(above) == 4 and all(abs(value / open_air - 1) < 0.01 for value in above), above
    mean = sum(under) / len(under)
    assert len(under) == 56 and abs(mean / UNDER_TREES_LX - 1) < 0.03, "mean under trees %g lx" % mean


def forest_takes_less_than_ten_megabytes():
    """Peak of the process above that of a scene with a single polygon, one thread each."""
    with tempfile.TemporaryDirectory() as folder:
        empty = Path(folder) / "empty.rad"
        empty.write_text("void glow g 0 0 4 1 1 1 0\ng source s 0 0 4 0 0 1 180\nvoid plastic p 0 0 5 .5 .5 .5 0 0\n"
                         "p polygon f 0 0 12 0 0 0 1 0 0 1 1 0 0 1 0\n")
        def peak_bytes(scene):
            words = [PROGRAM, "illuminance", str(scene), "--grid", "plane:20,-8,-8,8,8/8", "--samples", "8", "--unbiased",
                     "--threads", "1", "-o", folder + "/e.csv"]
            child = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = 0
            assert status == 0
            return usage.ru_maxrss * 1024
        more = peak_bytes(SAMPLES / "forest/forest.rad") - peak_bytes(empty)
    assert more < 10e6, "%.1f MB" % (more / 1e6)


UNDER_TREES_LX = 30240.0
CHECKS = {check.__name__: check for check in (
    scripts_draw_the_files, light_shelf_agrees_with_its_reference, theatre_has_the_direct_light_of_its_reference,
    forest_lets_through_the_light_it_should, forest_takes_less_than_ten_megabytes)}

if __name__ == "__main__":
    CHECKS[sys.argv[1]]()
