#!/usr/bin/python3
"""The full validation in numbers: worst deviation over tolerance for each table, and what deliberate errors do.

    validation.py PROGRAM --tables FOLDER [--rows FILE.json] [--out FILE]

PROGRAM is lightwell. FOLDER holds the tables (classical.json, radiosity.json, ...) whose cases the rows are named by. --rows
takes the output of an earlier `lightwell validate --full --json` instead of running it again. The five deliberate
errors are run with the rows that are named for a technique. Kept as results/validation.md beside this script.
"""

import argparse
import json
import pathlib
import resource
import subprocess
import sys

FILES = ["classical", "cie171_electric", "cie171_daylight", "daylight", "radiosity", "extremes"]
TECHNIQUES = ["direct", "specular", "ambient", "sky", "glass"]
T_95 = 2.365  # of eight replicates: half width of the interval over standard error

HEAD = """# Full validation

Made by `tests/bench/validation.py build/release/lightwell --tables FOLDER`. A row passes when its deviation is at most its
tolerance and three standard errors, and its standard error at most a third of the tolerance.

"""


def validate(program, *words):
    """@return  the report, CPU seconds of both processors together"""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([program, "validate", "--full", "--json", *words], capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return json.loads(done.stdout), after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def strain(row):
    allowed = row["tolerance"] + 3 * row["half_width_95"] / T_95
    return abs(row["deviation"]) / allowed if allowed > 0 else float(row["deviation"] != 0)


def by_table(rows, tables):
    text = "| table | cases run | rows | worst deviation / (tolerance + 3 errors) | at | worst deviation / tolerance |\n"
    text += "| --- | --- | --- | --- | --- | --- |\n"
    for name in FILES:
        ids = {case["id"] for case in json.loads((tables / f"{name}.json").read_text())["cases"]}
        mine = [row for row in rows if row["case"] in ids]
        if not mine:
            continue
        worst = max(mine, key=strain)
        plain = max(abs(row["deviation"]) / row["tolerance"] for row in mine if row["tolerance"] > 0) if any(
            row["tolerance"] > 0 for row in mine) else 0
        text += (f"| {name} | {len({row['case'] for row in mine})} of {len(ids)} | {len(mine)} | {strain(worst):.2f} "
                 f"| {worst['case']}, {worst['quantity']} | {plain:.2f} |\n")
    return text


def by_perturbation(program):
    text = "| 2 % put into | rows named for a technique that fail | others |\n| --- | --- | --- |\n"
    for technique in TECHNIQUES:
        report, _ = validate(program, "--case", "detects_", "--perturb", technique)
        failed = [row["case"] for row in report["rows"] if not row["passed"]]
        text += f"| {technique} | {', '.join(failed) or 'none'} | {len(report['rows']) - len(failed)} pass |\n"
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--tables", type=pathlib.Path, required=True)
    parser.add_argument("--rows", type=pathlib.Path)
    parser.add_argument("--out", default=pathlib.Path(__file__).resolve().parent / "results" / "validation.md")
    words = parser.parse_args()
    cost = ""
    if words.rows:
        report = json.loads(words.rows.read_text())
    else:
        report, cpu_s = validate(words.program)
        cost = f" {cpu_s:.0f} CPU seconds, all processors together."
    rows = report["rows"]
    cost = cost or f" {sum(row['cpu_seconds'] for row in rows):.0f} CPU seconds in the rows."
    failed = [row for row in rows if not row["passed"]]
    text = HEAD + f"{len(rows) - len(failed)} of {len(rows)} rows pass, version {report['version']}, seed {report['seed']}.{cost}\n\n"
    for row in failed:
        text += f"- FAILED: {row['case']}, {row['quantity']}: {row['reason']}\n"
    text += by_table(rows, words.tables) + "\n" + by_perturbation(words.program)
    pathlib.Path(words.out).write_text(text)
    print(text)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
