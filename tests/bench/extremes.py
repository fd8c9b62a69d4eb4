#!/usr/bin/python3
"""The torture set as a table: every case with the largest deviation found, beside Radiance's.

    extremes.py PROGRAM --tables FOLDER [--lightwell PROGRAM] [--most CPU_S] [--out FILE]

PROGRAM is the built test program (build/release/tests/extremes/test_extremes); FOLDER holds extremes.json. Each row is the
worst item of a case: deviation and tolerance relative to the expected value, what Radiance 6.1a gives on the like where that
was measured, and the verdict of the test that it belongs to. Cases of behaviour (odd, empty, ambiguous or wrong scenes) have
a verdict alone; rays that leak are counted by `lightwell validate`. Each test runs by itself and may take --most CPU
seconds; one that takes more stands as not ended. Kept as results/extremes.md beside this script.
"""

import argparse
import json
import os
import pathlib
import re
import resource
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Cases without a number of their own, and the tests that hold them.
BEHAVIOUR = {
    "ext_coincident": ["CoincidentSurfacesAnswerAsOne"],
    "ext_non_finite": ["WhatIsNotANumberOrNotPossibleIsRefusedByName", "WhatHasNoAreaAndWhatIsNotFlatIsNoTrouble",
                       "EmptyScenesAreBlackAndScenesOfLightAloneAreLit"],
    "ext_determinism": ["TheNumberOfThreadsChangesNoBit"],
}
RADIANCE = {"ext_coincident": "eight squares on one another: never ends"}

HEAD = """# Extremes

Made by `tests/bench/extremes.py build/release/tests/extremes/test_extremes --tables FOLDER`. Deviation and tolerance are
relative, the largest over the places of an item. Radiance 6.1a on the like, measured apart; "-": not measured. Beyond a
reflectance of 0.9999 the interval must hold the truth, and that alone. Where a deviation is above its tolerance and the row
passes, the stated standard error explains it.

| case | item | deviation | tolerance | Radiance 6.1a | verdict |
| --- | --- | --- | --- | --- | --- |
"""


def tests_of(program):
    listed = subprocess.run([program, "--gtest_list_tests"], capture_output=True, text=True, check=True).stdout
    return [line.strip() for line in listed.splitlines() if line.startswith("  ")]


def run_test(program, name, most_s):
    """@return  rows of its table, verdict, CPU seconds"""
    def bound():
        resource.setrlimit(resource.RLIMIT_CPU, (most_s, most_s))
    before = os.times()
    done = subprocess.run([program, f"--gtest_filter=Extremes.{name}"], capture_output=True, text=True, preexec_fn=bound)
    after = os.times()
    cpu_s = after.children_user + after.children_system - before.children_user - before.children_system
    rows = [line for line in done.stdout.splitlines() if line.startswith("| ")]
    if done.returncode < 0:
        return rows, f"not ended in {most_s} CPU s", cpu_s
    if "[  SKIPPED ]" in done.stdout:
        return rows, "skipped", cpu_s
    return rows, "passed" if done.returncode == 0 else "FAILED", cpu_s


def leak_row(program):
    done = subprocess.run([program, "validate", "--case", "ext_light_leak", "--json"], capture_output=True, text=True)
    rows = json.loads(done.stdout)["rows"]
    passed = all(row["passed"] for row in rows)
    return (f"| ext_light_leak | {len(rows)} rows: boxes of 6 and 12, turned, scaled, far | "
            f"{max(abs(row['deviation']) for row in rows):.2g} | 0 | - | {'passed' if passed else 'FAILED'} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--tables", type=pathlib.Path, required=True)
    parser.add_argument("--lightwell", default=ROOT / "build/release/lightwell")
    parser.add_argument("--most", type=int, default=120)
    parser.add_argument("--out", type=pathlib.Path,
                        default=pathlib.Path(__file__).resolve().parent / "results" / "extremes.md")
    words = parser.parse_args()
    rows, verdicts, seconds = [], {}, {}
    for name in tests_of(words.program):
        found, verdicts[name], seconds[name] = run_test(words.program, name, words.most)
        print(f"{name}: {verdicts[name]}, {seconds[name]:.0f} CPU s", flush=True)
        rows += [line.rstrip().rstrip("|").rstrip() + f" | {verdicts[name]} |" for line in found]
    for case, names in BEHAVIOUR.items():
        passed = all(verdicts.get(name) == "passed" for name in names)
        rows.append(f"| {case} | behaviour | - | - | {RADIANCE.get(case, '-')} | {'passed' if passed else 'FAILED'} |")
    rows.append(leak_row(words.lightwell))
    held = {row.split(" | ")[0].strip("| ") for row in rows}
    wanted = {case["id"] for case in json.loads((words.tables / "extremes.json").read_text())["cases"]}
    rows += [f"| {case} | - | - | - | - | NOT RUN |" for case in sorted(wanted - held)]
    text = HEAD + "\n".join(sorted(rows, key=lambda row: row.split(" | ")[0]))
    text += "\n\n| test | verdict | CPU s |\n| --- | --- | --- |\n"
    for name, verdict in verdicts.items():
        sentence = re.sub(r"(?<!^)([A-Z])", lambda m: " " + m.group(1).lower(), name)
        text += f"| {sentence} | {verdict} | {seconds[name]:.1f} |\n"
    words.out.write_text(text)
    print(text)
    return 0 if all(verdict == "passed" for verdict in verdicts.values()) and wanted <= held else 1


if __name__ == "__main__":
    sys.exit(main())
