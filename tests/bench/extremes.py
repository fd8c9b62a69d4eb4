#!/usr/bin/python3
"""The torture set as a table: every case with the largest deviation found, beside Radiance's.

    extremes.py PROGRAM [--out FILE]

PROGRAM is the built test program (build/release/tests/extremes/test_extremes). Each of its rows is the worst item of a
case: deviation and tolerance relative to the expected value, and what Radiance 6.1a gives on the like where that was
measured. Cases without a number (odd, empty, ambiguous or wrong scenes) are tests of their own and stand as passed or
failed. Kept as results/extremes.md beside this script.
"""

import argparse
import pathlib
import re
import subprocess
import sys

HEAD = """# Extremes

Made by `tests/bench/extremes.py build/release/tests/extremes/test_extremes`. Deviation and tolerance are relative. Radiance
6.1a on the like, measured apart; "-": not measured.

| case | item | deviation | tolerance | Radiance 6.1a |
| --- | --- | --- | --- | --- |
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--out", default=pathlib.Path(__file__).resolve().parent / "results" / "extremes.md")
    words = parser.parse_args()
    done = subprocess.run([words.program], capture_output=True, text=True)
    rows = [line for line in done.stdout.splitlines() if line.startswith("| ")]
    verdicts = re.findall(r"^\[\s+(OK|FAILED|SKIPPED)\s+\] Extremes\.(\w+) \(", done.stdout, re.MULTILINE)
    if not rows or not verdicts:
        sys.exit(f"{words.program}: no rows; is the table of extremes beside the repository?")
    text = HEAD + "\n".join(sorted(rows, key=lambda row: row.split(" | ")[0])) + "\n\n| test | verdict |\n| --- | --- |\n"
    for verdict, name in verdicts:
        sentence = re.sub(r"(?<!^)([A-Z])", lambda m: " " + m.group(1).lower(), name)
        text += f"| {sentence} | {'passed' if verdict == 'OK' else verdict.lower()} |\n"
    pathlib.Path(words.out).write_text(text)
    print(text)
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
