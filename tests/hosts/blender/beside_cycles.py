#!/usr/bin/python3
"""beside_cycles.py OUT.png [WIDTH [alike]]: the office by Cycles, by Lightwell, and luminance over luminance, with numbers by layer.

With `alike`, matt surfaces are Diffuse BSDF in place of Principled, there is no sun, and nothing has photometric numbers.

Needs LIGHTWELL (the engine), Blender and the shared fixtures. Pictures are in W/(m2 sr) and exposed alike; the ratio's colours go from
one half (violet) over 1 (green) to 2 (yellow). Printed: median ratio of each layer, with the part of the picture it covers.
"""

import pathlib
import sys

import numpy as np

from blender import OFFICE, InBlender
from lightwell_bridge import exr, false_colour, png

WEIGHTS = (0.2126, 0.7152, 0.0722)
LIGHTWELL_SAMPLES, CYCLES_SAMPLES = 32, 96
# Each pixel beside its neighbours: the noise of both falls before they are divided.
SMOOTHED = 2
WHITE_SHARE = 0.95  # of the pixels within the exposure
GAP = 8


class Beside(InBlender):
    """Not a test: it measures."""

    def pictures(self, width, how):
        height = round(width * 0.625)
        self.answer = self.blender("inside_cycles.py", width, height, LIGHTWELL_SAMPLES, CYCLES_SAMPLES, how, file=OFFICE)
        return exr.read(self.path / "lightwell.exr")[1], exr.read(self.path / f"cycles_{CYCLES_SAMPLES}.exr")[1]


def colours(channels):
    return np.stack([channels[next(n for n in channels if n.endswith("Combined." + c))] for c in "RGB"], axis=-1)


def smoothed(luminance):
    padded = np.pad(luminance, SMOOTHED, mode="edge")
    side = 2 * SMOOTHED + 1
    return sum(padded[y:y + luminance.shape[0], x:x + luminance.shape[1]] for y in range(side) for x in range(side)) / side ** 2


def by_layer(ratio, index, lit):
    for number in np.unique(index[lit]).astype(int):
        here = lit & (index == number)
        low, middle, high = np.quantile(ratio[here], (0.1, 0.5, 0.9))
        yield number, here.mean(), low, middle, high


def main(out, width=320, how="as drawn"):
    Beside.setUpClass()
    try:
        ours, theirs = Beside("pictures").pictures(int(width), how)
    finally:
        Beside.tearDownClass()
    lightwell, cycles = colours(ours), colours(theirs)
    pair = [smoothed(p @ WEIGHTS) for p in (lightwell, cycles)]
    lit = pair[1] > 1e-3 * np.median(pair[1])
    ratio = np.where(lit, pair[0] / np.maximum(pair[1], 1e-12), 1.0)
    index = ours["ViewLayer.ObjectLayer.X"]
    for number, share, low, middle, high in by_layer(ratio, index, lit):
        print(f"layer {number:3}: {share:6.1%} of the picture, ratio {middle:.3f} ({low:.3f} to {high:.3f} in the middle 80 %)")
    print(f"all: mean luminance {pair[0].mean() / pair[1].mean():.3f}, median ratio {np.median(ratio[lit]):.3f}")
    white = np.quantile(pair[1], WHITE_SHARE)
    map_ = false_colour.encoded(false_colour.linear_colours((np.log2(np.clip(ratio, 0.5, 2)) + 1) / 2))
    gap = np.ones((ratio.shape[0], GAP, 3))
    shown = [false_colour.encoded(np.clip(p / white, 0, 1)) for p in (cycles, lightwell)]
    pathlib.Path(out).write_bytes(png.encode(np.concatenate([shown[0], gap, shown[1], gap, map_], axis=1)))


if __name__ == "__main__":
    main(*sys.argv[1:])
