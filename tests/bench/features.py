#!/usr/bin/python3
"""Only what a scene requires: what each stage counts over a list of scenes, and what an unused feature costs.

    features.py PROGRAM [--out FILE]

PROGRAM is lightwell. Each scene is a lamp over a floor and a wall, and one thing more. For each the table gives what its
stages built and traced, and CPU instructions as callgrind (valgrind) counts them, which are the same on a loaded machine,
less those of a program that only says its version. Then, for features that the scene does not use:

- switched off (`--without`): the stage is left out of the run. What is left is what its presence costs.
- defined but on no surface: the file names a material that it does not use.

A feature costs a scene that does not use it nothing when both are within 1 % of the scene as it is. Kept as
results/features.md beside this script.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

BASE = """void plastic wall
0
0
5 .5 .5 .5 0 0
void light lamp
0
0
3 10 10 10
lamp polygon panel
0
0
12 1.5 1.5 2.7  1.5 2.5 2.7  2.5 2.5 2.7  2.5 1.5 2.7
wall polygon floor
0
0
12 0 0 0  4 0 0  4 4 0  0 4 0
wall polygon north
0
0
12 0 4 0  4 4 0  4 4 3  0 4 3
"""
SQUARE = "0\n0\n12 4 0 0  4 0 3  4 4 3  4 4 0\n"
MATERIALS = {
    "mirror": "void mirror shiny\n0\n0\n3 .9 .9 .9\n",
    "pane": "void glass pane\n0\n0\n3 .9 .9 .9\n",
    "rough metal": "void metal rough\n0\n0\n5 .8 .8 .8 1 .3\n",
    "translucent sheet": "void trans sheet\n0\n0\n7 .8 .8 .8 0 0 .5 0\n",
    "pattern": "void brightfunc stripes\n2 if(sin(9*Py),1,.5) .\n0\n0\nstripes plastic striped\n0\n0\n5 .5 .5 .5 0 0\n",
    "haze": "void mist haze\n0\n0\n3 .001 .001 .001\n",
}
NAMES = {"mirror": "shiny", "pane": "pane", "rough metal": "rough", "translucent sheet": "sheet", "pattern": "striped"}
# What a scene uses of the techniques that can be switched off; the others must cost it nothing.
OPTIONAL = {"virtual": ("mirror",), "secondary": (), "gradients": (), "cache": ()}
GRID = ["--grid", "plane:0.8,0,0,4,4/0.5", "--samples", "512", "--threads", "1"]
TOLERANCE = 0.01


def scenes():
    yield "lamp, floor, wall", (), BASE
    for what, name in NAMES.items():
        yield what, (what,), BASE + MATERIALS[what] + f"{name} polygon extra\n{SQUARE}"


def instructions(words, folder):
    out = folder / "callgrind.out"
    done = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", *map(str, words)],
                          capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return int(re.search(r"Collected : (\d+)", done.stderr).group(1))


class Bench:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        self.start = instructions([program, "--version"], folder)

    def count(self, text, more=()):
        """@return  instructions, what the run says of itself"""
        scene, out = self.folder / "scene.rad", self.folder / "out.csv"
        scene.write_text(text)
        found = instructions([self.program, "illuminance", scene, *GRID, "-o", out, *more], self.folder) - self.start
        return found, json.loads((self.folder / "out.run.json").read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--out", type=pathlib.Path,
                        default=pathlib.Path(__file__).resolve().parent / "results" / "features.md")
    words = parser.parse_args()
    counted = ("| scene | instructions, millions | deep sites | bright discs | records | secondary sources | rays of ambient "
               "light | rays of values | shadow rays |\n|---|---|---|---|---|---|---|---|---|\n")
    unused = "| scene | unused feature | instructions without it / with it |  |\n|---|---|---|---|\n"
    worst = 0.0
    with tempfile.TemporaryDirectory() as temporary:
        bench = Bench(words.program, pathlib.Path(temporary))
        for name, uses, text in scenes():
            whole, run = bench.count(text)
            built, rays = run["built"], run["rays"]
            counted += (f"| {name} | {whole / 1e6:.1f} | {built['deep_sites']} | {built['bright_discs']} | "
                        f"{built['ambient_records']} | {built['secondary_sources']} | {rays['ambient']} | "
                        f"{rays['values']} | {rays['shadow']} |\n")
            print(counted.splitlines()[-1], flush=True)
            trials = [(f"`--without {technique}`", text, ("--without", technique))
                      for technique, users in OPTIONAL.items() if not set(users) & set(uses)]
            if not uses:
                trials += [(f"{what}, defined only", material + text, ()) for what, material in MATERIALS.items()]
            for feature, changed, options in trials:
                found = bench.count(changed, options)[0]
                ratio = whole / found if changed != text else found / whole
                read_once = feature.startswith("pattern")
                if not read_once:
                    worst = max(worst, abs(ratio - 1))
                verdict = (f"{abs(found - whole) / 1e6:.0f} million to read the library of functions, once" if read_once
                           else "" if abs(ratio - 1) <= TOLERANCE else "MISSED")
                unused += f"| {name} | {feature} | {ratio:.4f} | {verdict} |\n"
                print(unused.splitlines()[-1], flush=True)
    text = (f"# What features cost\n\nMade by `tests/bench/features.py build/release/lightwell`. {__doc__.split(chr(10), 4)[4]}\n"
            f"{counted}\n{unused}\nLargest difference: {100 * worst:.2f} %.\n")
    words.out.write_text(text)
    return 0 if worst <= TOLERANCE else 1


if __name__ == "__main__":
    sys.exit(main())
