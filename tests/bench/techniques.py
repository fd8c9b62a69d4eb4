#!/usr/bin/python3
"""What each technique buys: cost and error of each row with one technique after the other switched off.

    techniques.py [ROW ...] --yardstick FOLDER [--options "--samples 128"] [--seeds 3]

Rows as in yardstick.py (b c d without an argument). Printed is a table for engine/docs/techniques.md: CPU seconds of one
thread and RMS error relative to the reference, with its noise subtracted in quadrature, medians over the seeds.
"""

import argparse
import os
import pathlib
import tempfile

from options import TECHNIQUES
from rows import build
from yardstick import lightwell_run, measured, write_points


def lines_of(row, folder, asked):
    points = folder / "grid.pts"
    write_points(points, row.points)
    for name in ("", *TECHNIQUES):
        words = f"{asked.options} {'--without ' + name if name else ''}".strip()
        tries = [lightwell_run(row, folder, points, words, seed) for seed in range(1, asked.seeds + 1)]
        found = measured("Lightwell", name or "all", words, row, tries)
        yield (f"| {name or 'nothing'} | {found['cpu_s']:.3f} | {100 * found['rms']:.2f} | {100 * found['mbe']:+.2f} "
               f"| {100 * found['noise_rms']:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rows", nargs="*", default=["b", "c", "d"])
    parser.add_argument("--yardstick", type=pathlib.Path, default=os.environ.get("LIGHTWELL_YARDSTICK"))
    parser.add_argument("--options", default="--samples 128")
    parser.add_argument("--seeds", type=int, default=3)
    asked = parser.parse_args()
    for name in asked.rows:
        with tempfile.TemporaryDirectory() as work:
            row = build(name, asked.yardstick, pathlib.Path(work))
            print(f"\n## {name}: {row.title}, `{asked.options}`\n\n| without | CPU s | RMS % | MBE % | noise % |\n"
                  "|---|---|---|---|---|", flush=True)
            for line in lines_of(row, pathlib.Path(work), asked):
                print(line, flush=True)


if __name__ == "__main__":
    main()
