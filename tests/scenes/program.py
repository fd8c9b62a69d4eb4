"""Runs a program and tells what it took; reads the tables that Lightwell writes."""

import csv
import dataclasses
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

TIME = "/usr/bin/time"
ROOT = pathlib.Path(__file__).resolve().parents[2]


@dataclasses.dataclass
class Run:
    """One finished child. `cpu_s` is user and system time of it and of its own children."""
    command: list
    status: int
    cpu_s: float
    wall_s: float
    memory_MB: float
    output: str
    errors: str

    def demand(self):
        """The run itself; ends the script with what the program said when it failed."""
        if self.status != 0:
            sys.exit(f"status {self.status}: {' '.join(map(str, self.command))}\n{self.errors[-2000:]}")
        return self


def lightwell():
    """The program to measure: $LIGHTWELL, else that of the release build."""
    return os.environ.get("LIGHTWELL", str(ROOT / "build/release/lightwell"))


def run(command, folder=None, input_file=None, timeout_s=3600.0, environment=None):
    """Output and errors go through files, so that a child never waits for its reader.

    GNU time starts the child where it is installed: the peak memory of a child that this interpreter starts is never
    below the interpreter's own."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err, tempfile.NamedTemporaryFile() as peak:
        start = time.monotonic()
        words = ([TIME, "-q", "-f", "%M", "-o", peak.name] if os.path.exists(TIME) else []) + list(map(str, command))
        with open(input_file or os.devnull, "rb") as source:
            child = subprocess.Popen(words, cwd=folder, stdin=source, stdout=out, stderr=err,
                                     env={**os.environ, **(environment or {})}, start_new_session=True)
        usage = _wait(child, start + timeout_s)
        wall = time.monotonic() - start
        out.seek(0), err.seek(0)
        kilobytes = float(peak.read().split()[-1]) if os.path.exists(TIME) else usage.ru_maxrss
        return Run(list(command), child.returncode, usage.ru_utime + usage.ru_stime, wall, kilobytes / 1024,
                   out.read().decode(errors="replace"), err.read().decode(errors="replace"))


def _wait(child, deadline):
    pause_s = 0.002
    while True:
        pid, status, usage = os.wait4(child.pid, os.WNOHANG)
        if pid:
            child.returncode = os.waitstatus_to_exitcode(status)
            return usage
        if time.monotonic() > deadline:
            os.killpg(child.pid, signal.SIGKILL)
        time.sleep(pause_s)


def read_table(file):
    """A grid's CSV as dictionary of columns, numbers as float."""
    with open(file, newline="") as source:
        rows = list(csv.DictReader(source))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


def illuminance(scene, points, output, options):
    """@return  the run and the table of `lightwell illuminance SCENE --grid file:POINTS`"""
    done = run([lightwell(), "illuminance", scene, "--grid", f"file:{points}", "-o", output, *options]).demand()
    return done, read_table(output)
