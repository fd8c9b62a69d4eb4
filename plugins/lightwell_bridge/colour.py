"""Colours of hosts (linear Rec.709, D65) in the engine's primaries, and what an efficacy makes of watts."""

import numpy as np

# Lumens of a watt of equal-energy white, as in the engine.
LUMENS_PER_WATT = 179.0
# Shares of the engine's three channels in luminance.
WEIGHTS = np.array([0.265, 0.670, 0.065])

_BRADFORD = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])


def _xyz(x, y):
    return np.array([x / y, 1.0, (1 - x - y) / y])


def _rgb_to_xyz(chromaticities, white):
    raw = np.column_stack([_xyz(x, y) for x, y in chromaticities])
    return raw * np.linalg.solve(raw, white)


def _rec709_to_engine():
    d65, equal_energy = _xyz(0.3127, 0.3290), np.ones(3)
    gain = np.diag((_BRADFORD @ equal_energy) / (_BRADFORD @ d65))
    adapt = np.linalg.inv(_BRADFORD) @ gain @ _BRADFORD
    source = _rgb_to_xyz([(0.64, 0.33), (0.30, 0.60), (0.15, 0.06)], d65)
    engine = _rgb_to_xyz([(0.64, 0.33), (0.29, 0.60), (0.15, 0.06)], equal_energy)
    return np.linalg.inv(engine) @ adapt @ source


_MATRIX = _rec709_to_engine()


def from_rec709(rgb):
    """Linear Rec.709 to the engine's channels, never negative; grey stays exactly grey."""
    red, green, blue = (float(c) for c in rgb)
    if red == green == blue:
        return (red, green, blue)
    return tuple(float(c) for c in np.maximum(_MATRIX @ (red, green, blue), 0.0))


def luminous(rgb_engine):
    """Luminance share of an engine colour: a reflectance, or radiance in units of white."""
    return float(np.dot(WEIGHTS, rgb_engine))


def of_luminance(rgb_rec709, wanted):
    """The engine colour with the hue of `rgb_rec709` whose luminance share is `wanted`; grey for black."""
    colour = from_rec709(rgb_rec709)
    share = luminous(colour)
    return (wanted,) * 3 if share <= 0 else tuple(c * wanted / share for c in colour)


def blackbody_hue(kelvin):
    """Linear Rec.709 hue of a black body (largest channel 1), 1000 to 40000 K.

    Source  Planck's law through the CIE 1931 observer, as the fit of Kim et al. 2002 for the locus
    """
    t = min(max(float(kelvin), 1667.0), 25000.0)
    i = 1e3 / t
    if t <= 4000:
        x = ((-0.2661239 * i - 0.2343589) * i + 0.8776956) * i + 0.179910
    else:
        x = ((-3.0258469 * i + 2.1070379) * i + 0.2226347) * i + 0.240390
    if t <= 2222:
        y = ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
    elif t <= 4000:
        y = ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
    else:
        y = ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483
    to_rgb = np.linalg.inv(_rgb_to_xyz([(0.64, 0.33), (0.30, 0.60), (0.15, 0.06)], _xyz(0.3127, 0.3290)))
    rgb = np.maximum(to_rgb @ _xyz(x, y), 0.0)
    return tuple(float(c) for c in rgb / rgb.max())
