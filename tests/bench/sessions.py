#!/usr/bin/python3
"""What a user's session takes: the second view from a kept cache, two threads, the samples, a forest.

    sessions.py second-view [--cache "--ambient-file FILE"] [--options "--accuracy 5%"]
    sessions.py threads [--options "--samples 256"] [--pairs 5]
    sessions.py samples
    sessions.py forest --yardstick FOLDER [--options "..."]

second-view  CPU seconds of two views of the sample office by day: the second alone, and after the first with its kept cache
             (goal: under 30 % of the second alone)
threads      wall time of two runs side by side, one thread each, over twice that of one run with two threads, alternating, the
             median of the pairs (goal: at least 0.93; a machine with nothing else to do)
samples      wall seconds of samples/run, and until its first picture (goals: 60 and 10 s)
forest       the picture of the yardstick's forest, 400 x 300: CPU seconds and memory above an empty run, beside Radiance
             (goals: a fifth; 10 MB)
Results are kept in results/ beside this script.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
from program import ROOT, lightwell, run
from text import diffuse, lamp, level_panel, room

RESULTS = pathlib.Path(__file__).resolve().parent / "results"
OFFICE = ROOT / "samples/office"
DAYLIGHT = ["--sky", "clear", "--place", "52.5,13.4", "--time", "2026-03-21T12:00+01:00"]
VIEWS = ("-vtv -vp 0.8 1.45 5.1 -vd 1 0.16 -0.14 -vh 75 -vv 47", "-vtv -vp 14 1.45 5.1 -vd -1 0.2 -0.14 -vh 75 -vv 47")
FOREST_VIEW = "-vtv -vp -42 -55 7 -vd .6 .78 -.02 -vu 0 0 1 -vh 55 -vv 42"


def keep(name, result):
    RESULTS.mkdir(exist_ok=True)
    (RESULTS / f"{name}.json").write_text(json.dumps(result, indent=1) + "\n")


def office_view(folder, number, words):
    return run([lightwell(), "render", OFFICE / "office.dxf", "--map", OFFICE / "map_daylight.toml", *DAYLIGHT, "--view",
                VIEWS[number], "--size", "320x200", "-o", folder / f"view{number}.exr", "--threads", 1, *words]).demand()


def second_view(asked, folder):
    cache = asked.cache.replace("FILE", str(folder / "office.cache")).split()
    alone = office_view(folder, 1, asked.options.split())
    first = office_view(folder, 0, asked.options.split() + cache)
    second = office_view(folder, 1, asked.options.split() + cache)
    result = {"alone_s": alone.cpu_s, "first_s": first.cpu_s, "second_s": second.cpu_s,
              "share": second.cpu_s / alone.cpu_s, "share_of_first": second.cpu_s / first.cpu_s}
    print(f"second view alone {alone.cpu_s:.2f} s; first view {first.cpu_s:.2f} s; second with the cache kept "
          f"{second.cpu_s:.2f} s: {100 * result['share']:.0f} % of alone, {100 * result['share_of_first']:.0f} % of the first")
    keep("second_view", result)


def closed_room(folder):
    scene = folder / "room.rad"
    scene.write_text(diffuse("wall", 0.6) + room("room", (0, 0, 0), (4, 3, 2.5), "wall") + lamp("panel", 20) +
                     level_panel("panel", "lamp", (1.5, 1), (2.5, 2), 2.49, facing_up=False))
    return scene


def side_by_side(command, count, folder):
    """Wall seconds until the last of `count` runs started together is done."""
    start = time.monotonic()
    children = [subprocess.Popen([*map(str, command), "-o", str(folder / f"run{i}.exr")], stdout=subprocess.DEVNULL,
                                 stderr=subprocess.DEVNULL) for i in range(count)]
    if any(child.wait() != 0 for child in children):
        sys.exit(f"failed: {command}")
    return time.monotonic() - start


def threads(asked, folder):
    command = [lightwell(), "render", closed_room(folder), "--view", "-vp 0.3 0.3 1.5 -vd 1 0.7 -0.2 -vh 70 -vv 50", "--size",
               "480x320", *asked.options.split()]
    shares, load = [], os.getloadavg()[0]
    for pair in range(asked.pairs):
        order = (1, 2) if pair % 2 == 0 else (2, 1)
        wall = {count: side_by_side(command + ["--threads", count], 2 // count, folder) for count in order}
        shares.append(wall[1] / (2 * wall[2]))
        print(f"two runs of one thread {wall[1]:.2f} s, one of two threads {wall[2]:.2f} s: {shares[-1]:.3f}", flush=True)
    result = {"shares": shares, "median": statistics.median(shares), "load_before": load}
    print(f"median {result['median']:.3f} (load of the machine before: {load:.1f})")
    keep("threads", result)


def samples(asked, folder):
    pictures = ROOT / "out"
    before = time.time()
    start = time.monotonic()
    child = subprocess.Popen([ROOT / "samples/run"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    first = None
    while child.poll() is None:
        time.sleep(0.1)
        if first is None and any(not file.name.endswith(".partial.exr") and file.stat().st_mtime > before
                                 for file in pictures.rglob("*.exr")):
            first = time.monotonic() - start
    result = {"status": child.returncode, "wall_s": time.monotonic() - start, "first_picture_s": first}
    print(f"samples/run: {result['wall_s']:.1f} s, first picture after {first or float('nan'):.1f} s, status {child.returncode}")
    keep("samples", result)


def forest(asked, folder):
    sys.path.insert(0, str(asked.yardstick / "scenes"))
    import f_forest
    f_forest.gen(str(folder))
    for file in folder.glob("*.rad"):
        (folder / f"octrees_{file.name}").write_text(file.read_text())
        file.write_text(file.read_text().replace(".oct", ".rad"))
    picture = ["--view", FOREST_VIEW, "--size", "400x300", "-o", folder / "forest.exr", "--threads", 1]
    ours = run([lightwell(), "render", folder / "forest.rad", *picture, *asked.options.split()]).demand()
    empty = run([lightwell(), "render", closed_room(folder), *picture, "--samples", 8]).demand()
    result = {"cpu_s": ours.cpu_s, "memory_MB": ours.memory_MB, "empty_MB": empty.memory_MB}
    print(f"Lightwell {ours.cpu_s:.2f} s, {ours.memory_MB - empty.memory_MB:.1f} MB above an empty run's {empty.memory_MB:.1f}")
    for name in ("needle", "branch", "tree", "stand", "forest"):
        (folder / f"{name}.rad").write_text((folder / f"octrees_{name}.rad").read_text())
    build = run(["bash", "build.sh"], folder=folder).demand()
    theirs = run(["rpict", "-ab", "0", "-ps", "1", "-x", "400", "-y", "300", *FOREST_VIEW.split(), "forest.oct"],
                 folder=folder).demand()
    result |= {"radiance_cpu_s": theirs.cpu_s, "radiance_MB": theirs.memory_MB, "radiance_build_s": build.cpu_s}
    print(f"Radiance {theirs.cpu_s:.2f} s and {build.cpu_s:.2f} s for its octrees, {theirs.memory_MB:.1f} MB")
    keep("forest", result)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("second-view", "threads", "samples", "forest"))
    parser.add_argument("--cache", default="--ambient-file FILE", help="option that keeps a cache, with the word FILE in it")
    parser.add_argument("--options", default="--samples 16")
    parser.add_argument("--pairs", type=int, default=5)
    parser.add_argument("--yardstick", type=pathlib.Path, default=os.environ.get("LIGHTWELL_YARDSTICK"))
    asked = parser.parse_args()
    asked.yardstick = pathlib.Path(asked.yardstick).resolve() if asked.yardstick else None
    with tempfile.TemporaryDirectory() as folder:
        {"second-view": second_view, "threads": threads, "samples": samples, "forest": forest}[asked.what](
            asked, pathlib.Path(folder))


if __name__ == "__main__":
    main()
