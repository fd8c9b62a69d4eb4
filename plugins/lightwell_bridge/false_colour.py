"""False colours of illuminance: the engine's own scale (dark violet to light yellow), and its legend as pixels."""

import math

import numpy as np

from .legend_font import text_mask

# Place, hue in degrees, chroma in CIE L*a*b*; lightness rises evenly. The same curve as the engine's.
_KNOTS = np.array([(0.00, 315, 34), (0.14, 303, 52), (0.28, 288, 48), (0.42, 246, 31), (0.56, 186, 33), (0.70, 144, 50),
                   (0.84, 112, 70), (1.00, 96, 31)])
_DARKEST, _LIGHTEST = 14.0, 94.0
_WHITE = np.array([0.95047, 1.0, 1.08883])
_TO_RGB = np.array([[3.2404542, -1.5371385, -0.4985314], [-0.9692660, 1.8760108, 0.0415560],
                    [0.0556434, -0.2040259, 1.0572252]])
_ROUND_ENDS = (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)
_ROUND_STEPS = (1.0, 2.0, 2.5, 5.0, 10.0)
# The brightest hundredth does not set the scale.
_SHOWN = 0.99
_LEGEND_STEPS = 6


def linear_colours(places):
    """n x 3 linear Rec.709 for places in [0, 1]; what is no number goes to the low end."""
    places = np.clip(np.nan_to_num(np.asarray(places, dtype=float), nan=0.0), 0, 1)
    hue, chroma = np.radians(_KNOTS[:, 1]), _KNOTS[:, 2]
    a, b = (_through_knots(chroma * f(hue), places) for f in (np.cos, np.sin))
    fy = (_DARKEST + (_LIGHTEST - _DARKEST) * places + 16) / 116
    xyz = _WHITE * np.stack([_from_lab(fy + a / 500), _from_lab(fy), _from_lab(fy - b / 200)], axis=-1)
    return np.clip(xyz @ _TO_RGB.T, 0, 1)


def encoded(linear):
    """sRGB of linear values, both 0 to 1."""
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 1e-9) ** (1 / 2.4) - 0.055)


def scale_top(values):
    """A round number that nearly all of the values do not exceed."""
    finite = np.sort(np.asarray(values, dtype=float)[np.isfinite(values)])
    top = finite[math.ceil(_SHOWN * (len(finite) - 1))] if len(finite) else 0.0
    if not top > 0:
        return 1.0
    power = 10.0 ** math.floor(math.log10(top))
    return next(end * power for end in _ROUND_ENDS if end * power >= top * (1 - 1e-9))


def steps(top):
    """Round values from 0 to the top for a legend."""
    power = 10.0 ** math.floor(math.log10(top / _LEGEND_STEPS))
    step = next((s * power for s in _ROUND_STEPS if s * power * _LEGEND_STEPS >= top * (1 - 1e-9)), 10 * power)
    return [i * step for i in range(int(top / step * (1 + 1e-9)) + 1)]


def legend(top, unit="lx", title="Illuminance", height=480):
    """h x w x 4 encoded sRGB and alpha, row 0 at the top: a bar with numbers and their unit."""
    width, scale = 300, 3
    picture = np.ones((height, width, 4))
    picture[:, :, :3] = 0.13
    upper, lower, left, right = 110, height - 30, 24, 74
    bar = encoded(linear_colours(np.linspace(1, 0, lower - upper)))
    picture[upper:lower, left:right, :3] = bar[:, None, :]
    _write(picture, title, 20, 20, scale)
    _write(picture, unit, 20, 60, scale)
    for value in steps(top):
        y = int(round(lower - 1 - (lower - 1 - upper) * value / top))
        picture[y, left:right + 10, :3] = 0.9
        _write(picture, f"{value:g}", right + 20, y - 7 * scale // 2, scale)
    return picture


def _write(picture, text, x, y, scale):
    mask = np.kron(text_mask(text), np.ones((scale, scale), dtype=bool))
    rows, columns = mask.shape
    y = min(max(y, 0), picture.shape[0] - rows)
    columns = min(columns, picture.shape[1] - x)
    picture[y:y + rows, x:x + columns, :3][mask[:, :columns]] = 0.95


def _from_lab(f):
    limit = 6 / 29
    return np.where(f > limit, f ** 3, 3 * limit * limit * (f - 4 / 29))


def _through_knots(values, places):
    """Cubic Hermite curve, slopes from the neighbours."""
    at = _KNOTS[:, 0]
    last = len(at) - 1
    i = np.clip(np.searchsorted(at, places, side="left") - 1, 0, last - 1)
    before, after = np.maximum(np.arange(last + 1) - 1, 0), np.minimum(np.arange(last + 1) + 1, last)
    slope = (values[after] - values[before]) / (at[after] - at[before])
    step = at[i + 1] - at[i]
    t = (places - at[i]) / step
    rise = t * t * (3 - 2 * t)
    return values[i] * (1 - rise) + values[i + 1] * rise + step * t * (1 - t) * ((1 - t) * slope[i] - t * slope[i + 1])
