#!/usr/bin/python3
"""Plants the forest: nine scene files that place each other, from a spray of needles to the whole.

    draw_forest.py [FOLDER]      folder to write to; this one by default

Every run writes the same bytes and prints how many needles and leaves stand in the forest. Metres, z up.
"""
import math
import random
import sys
from pathlib import Path

SUN_ALTITUDE, SUN_AZIMUTH = 38.0, 205.0  # degrees; from north over east: a little west of south
SUN_WIDTH, SUN_NORMAL_LX, SKY_LX, LUMENS_PER_WATT = 0.533, 80000.0, 13000.0, 179.0
SIZES = {"needles a spray": 120, "sprays a branch": 45, "branches a spruce": 84, "leaves a twig": 26, "twigs a branch": 14,
         "branches a birch": 44, "spruces a stand": 9, "birches a stand": 3, "stands": 14, "lone birches": 4}


class Text:
    def __init__(self, title):
        self.lines = ["# " + title + " Planted by draw_forest.py."]

    def material(self, kind, name, *numbers):
        self.lines.append("void %s %s 0 0 %d %s" % (kind, name, len(numbers), " ".join("%.7g" % n for n in numbers)))

    def surface(self, material, kind, name, *numbers):
        self.lines.append("%s %s %s 0 0 %d %s" % (material, kind, name, len(numbers), " ".join("%.7g" % n for n in numbers)))

    def place(self, name, file, *words):
        text = ["%.4g" % w if isinstance(w, float) else str(w) for w in words]
        self.lines.append("void instance %s %d %s %s 0 0" % (name, 1 + len(text), file, " ".join(text)))

    def write(self, path):
        path.write_text("\n".join(self.lines) + "\n")


def spray(dice):
    text = Text("A spray of needles along x, 0.2 m long.")
    text.material("plastic", "needle", 0.07, 0.19, 0.065, 0.02, 0.1)
    for i in range(SIZES["needles a spray"]):
        x, angle, length = dice.uniform(0, 0.18), dice.uniform(0, 2 * math.pi), dice.uniform(0.025, 0.045)
        out = 0.8 * length
        text.surface("needle", "cone", "n%d" % i, x, 0, 0, x + 0.6 * length, out * math.cos(angle), out * math.sin(angle),
                     0.0011, 0.0003)
    return text


def spruce_branch(dice):
    text = Text("A branch of a spruce along x, 1.7 m long.")
    text.material("plastic", "twig_bark", 0.16, 0.11, 0.08, 0, 0)
    text.surface("twig_bark", "cone", "wood", 0, 0, 0, 1.7, 0, -0.12, 0.016, 0.003)
    for i in range(SIZES["sprays a branch"]):
        x = 0.15 + 1.5 * i / SIZES["sprays a branch"]
        side = 1 if i % 2 else -1
        width = 0.36 * (1.75 - x) / 1.6
        text.place("s%d" % i, "spray.rad", "-s", dice.uniform(1.0, 1.7), "-rx", dice.uniform(0, 360), "-rz",
                   side * dice.uniform(25, 60), "-t", x, side * dice.uniform(0.1, 1.0) * width,
                   dice.uniform(-0.05, 0.05) - 0.07 * x)
    return text


def spruce(dice):
    text = Text("A spruce of 11 m.")
    text.material("plastic", "spruce_bark", 0.17, 0.11, 0.08, 0, 0)
    text.surface("spruce_bark", "cone", "trunk", 0, 0, -0.2, 0, 0, 10.8, 0.2, 0.015)
    count = SIZES["branches a spruce"]
    for i in range(count):
        z = 0.7 + 9.9 * (i / count) ** 1.05
        text.place("b%d" % i, "spruce_branch.rad", "-s", 1.32 * (1.04 - z / 11), "-ry", 4 + 20 * (1 - z / 11) + dice.uniform(-5, 5),
                   "-rz", (137.508 * i + dice.uniform(-15, 15)) % 360, "-t", 0, 0, z)
    return text


def birch_twig(dice):
    text = Text("A twig of a birch with its leaves, hanging.")
    text.material("trans", "leaf", 0.33, 0.42, 0.13, 0.03, 0.1, 0.4, 0)
    for i in range(SIZES["leaves a twig"]):
        x, y, z = dice.uniform(-0.12, 0.12), dice.uniform(-0.12, 0.12), -dice.uniform(0, 0.55)
        turn, tilt, size = dice.uniform(0, 2 * math.pi), dice.uniform(-0.9, 0.9), dice.uniform(0.035, 0.06)
        along = (math.cos(turn) * math.cos(tilt), math.sin(turn) * math.cos(tilt), math.sin(tilt))
        aside = (-math.sin(turn), math.cos(turn), 0)
        corners = []
        for a, b in ((0, 0), (0.45, 0.38), (1, 0), (0.45, -0.38)):
            corners += [c + size * (a * u + b * v) for c, u, v in zip((x, y, z), along, aside)]
        text.surface("leaf", "polygon", "l%d" % i, *corners)
    return text


def birch_branch(dice):
    text = Text("A branch of a birch along x, 2 m long.")
    text.material("plastic", "birch_twig_bark", 0.2, 0.15, 0.12, 0, 0)
    text.surface("birch_twig_bark", "cone", "wood", 0, 0, 0, 1.9, 0, 0.25, 0.02, 0.004)
    for i in range(SIZES["twigs a branch"]):
        x = 0.35 + 1.6 * i / SIZES["twigs a branch"]
        text.place("t%d" % i, "birch_twig.rad", "-s", dice.uniform(0.8, 1.3), "-rz", dice.uniform(0, 360), "-t", x,
                   dice.uniform(-0.3, 0.3), 0.13 * x + dice.uniform(-0.05, 0.15))
    return text


def birch(dice):
    text = Text("A birch of 9 m.")
    text.material("plastic", "birch_bark", 0.62, 0.6, 0.55, 0, 0)
    text.surface("birch_bark", "cone", "trunk", 0, 0, -0.2, 0.15, 0.1, 8.4, 0.13, 0.02)
    count = SIZES["branches a birch"]
    for i in range(count):
        z = 2.6 + 5.8 * i / count
        text.place("b%d" % i, "birch_branch.rad", "-s", 0.55 + 0.55 * math.sin(math.pi * (z - 2.2) / 7.4), "-ry",
                   -dice.uniform(15, 45), "-rz", (137.508 * i + dice.uniform(-20, 20)) % 360, "-t", 0, 0, z)
    return text


def stand(dice):
    text = Text("A stand of spruces and birches, 16 m across.")
    spots = []
    while len(spots) < SIZES["spruces a stand"] + SIZES["birches a stand"]:
        spot = (dice.uniform(-7.5, 7.5), dice.uniform(-7.5, 7.5))
        if math.hypot(*spot) < 7.5 and all(math.dist(spot, s) > 2.3 for s in spots):
            spots.append(spot)
    for i, (x, y) in enumerate(spots):
        kind = "spruce.rad" if i < SIZES["spruces a stand"] else "birch.rad"
        text.place("t%d" % i, kind, "-s", dice.uniform(0.75, 1.3), "-rz", dice.uniform(0, 360), "-t", x, y, 0)
    return text


def cabin():
    text = Text("A cabin of logs, 5 m x 4 m, its door to the south.")
    text.material("plastic", "log", 0.38, 0.25, 0.15, 0, 0)
    text.material("plastic", "roof", 0.24, 0.1, 0.08, 0, 0)
    text.material("plastic", "door", 0.12, 0.2, 0.22, 0, 0)
    text.material("plastic", "dark_pane", 0.03, 0.035, 0.04, 0.06, 0)
    text.material("plastic", "stone_chimney", 0.34, 0.32, 0.3, 0, 0)
    for i in range(10):
        z = 0.13 + 0.25 * i
        for name, ends in (("s", (-2.7, -2, 2.7, -2)), ("n", (-2.7, 2, 2.7, 2)), ("w", (-2.5, -2.2, -2.5, 2.2)),
                           ("e", (2.5, -2.2, 2.5, 2.2))):
            a, b, c, d = ends
            lift = 0.0 if name in "sn" else 0.125
            text.surface("log", "cylinder", "log_%s%d" % (name, i), a, b, z + lift, c, d, z + lift, 0.14)
            for end, (x, y, nx, ny) in enumerate(((a, b, a - c, b - d), (c, d, c - a, d - b))):
                text.surface("log", "ring", "end_%s%d_%d" % (name, i, end), x, y, z + lift, nx, ny, 0, 0, 0.14)
    ridge, eaves = 4.3, 2.45
    for side in (-1, 1):
        text.surface("roof", "polygon", "roof_%d" % side, -3.1, 2.6 * side, eaves, 3.1, 2.6 * side, eaves, 3.1, 0, ridge, -3.1, 0,
                     ridge)
        text.surface("log", "polygon", "gable_%d" % side, 2.5 * side, -2, 2.6, 2.5 * side, 2, 2.6, 2.5 * side, 0, 4.2)
    text.surface("door", "polygon", "door", -0.5, -2.16, 0.05, 0.5, -2.16, 0.05, 0.5, -2.16, 2.05, -0.5, -2.16, 2.05)
    for i, x in enumerate((-1.7, 1.7)):
        text.surface("dark_pane", "polygon", "window_%d" % i, x - 0.45, -2.16, 1.0, x + 0.45, -2.16, 1.0, x + 0.45, -2.16, 1.9,
                     x - 0.45, -2.16, 1.9)
    text.surface("stone_chimney", "cylinder", "chimney", 1.5, 0.7, 3.2, 1.5, 0.7, 4.9, 0.3)
    text.surface("stone_chimney", "ring", "chimney_top", 1.5, 0.7, 4.9, 0, 0, 1, 0.18, 0.3)
    return text


def forest(dice):
    text = Text("The forest around its clearing, with a cabin and a pond; sun and a uniform sky.")
    text.material("plastic", "grass", 0.12, 0.2, 0.06, 0, 0)
    text.material("plastic", "path", 0.36, 0.3, 0.22, 0, 0)
    text.material("metal", "water", 0.3, 0.33, 0.35, 1, 0)
    text.material("plastic", "rock", 0.22, 0.21, 0.19, 0, 0)
    text.surface("grass", "polygon", "ground", -150, -150, 0, 150, -150, 0, 150, 150, 0, -150, 150, 0)
    text.surface("water", "ring", "pond", -4.5, -4, 0.02, 0, 0, 1, 0, 4.6)
    for i in range(34):
        turn = dice.uniform(0, 2 * math.pi)
        size = dice.uniform(0.07, 0.34) ** 1.1
        text.surface("rock", "sphere", "rock_%d" % i, -4.5 + 4.7 * math.cos(turn), -4 + 4.7 * math.sin(turn), 0.1 * size, size)
    text.surface("path", "polygon", "path", 3.2, 4.9, 0.01, 4.3, 4.9, 0.01, 4.9, -4, 0.01, 7.2, -26, 0.01, 5.4, -26, 0.01, 3.5, -4,
                 0.01)
    text.place("cabin", "cabin.rad", "-rz", -8, "-t", 3.6, 7.4, 0)
    ring = [(19.5 * math.cos(a), 4 + 19.5 * math.sin(a)) for a in (math.radians(-20 + 31 * i) for i in range(8))]
    ring += [(-28 + 14 * i, 36 - abs(i - 2) * 1.5) for i in range(5)] + [(-27, -9)]
    for i, (x, y) in enumerate(ring):
        text.place("stand_%d" % i, "stand.rad", "-rz", dice.uniform(0, 360), "-t", float(x), float(y), 0)
    for i, (x, y) in enumerate(((-8.6, 1.6), (8.2, 1.2), (-11.5, -6.0), (9.5, -7.5))):
        text.place("birch_%d" % i, "birch.rad", "-s", dice.uniform(0.8, 1.0), "-rz", dice.uniform(0, 360), "-t", x, y, 0)
    up, turn = math.radians(SUN_ALTITUDE), math.radians(SUN_AZIMUTH)
    sun = SUN_NORMAL_LX / LUMENS_PER_WATT / (math.pi * math.sin(math.radians(SUN_WIDTH / 2)) ** 2)
    blue = (0.78, 1.0303, 1.585)  # of luminance 1 with the weights 0.265, 0.670, 0.065
    sky = SKY_LX / LUMENS_PER_WATT / math.pi
    text.material("light", "sun_light", sun, sun, sun)
    text.lines.append("sun_light source sun 0 0 4 %.9g %.9g %.9g %g" % (
        math.cos(up) * math.sin(turn), math.cos(up) * math.cos(turn), math.sin(up), SUN_WIDTH))
    text.material("glow", "sky_light", *(sky * b for b in blue), 0)
    text.lines.append("sky_light source sky 0 0 4 0 0 1 180")
    return text


def counts():
    n = SIZES
    spruce_needles = n["needles a spray"] * n["sprays a branch"] * n["branches a spruce"]
    birch_leaves = n["leaves a twig"] * n["twigs a branch"] * n["branches a birch"]
    return {"needles": spruce_needles * n["spruces a stand"] * n["stands"],
            "leaves": birch_leaves * (n["birches a stand"] * n["stands"] + n["lone birches"])}


def main(arguments):
    folder = Path(arguments[0]) if arguments else Path(__file__).resolve().parent
    folder.mkdir(parents=True, exist_ok=True)
    for number, make in enumerate((spray, spruce_branch, spruce, birch_twig, birch_branch, birch, stand, forest)):
        make(random.Random(1994 + number)).write(folder / (make.__name__ + ".rad"))
    cabin().write(folder / "cabin.rad")
    print(counts())


if __name__ == "__main__":
    main(sys.argv[1:])
