"""Lines of equal value over a grid of sensors, by linear interpolation between them."""

import numpy as np


def lines(values, level):
    """Segments as pairs of (row, column), in units of the sensors' distance; none where a value is missing.

    values   rows x columns, NaN where there is no sensor
    """
    segments = []
    rows, columns = values.shape
    for row in range(rows - 1):
        for column in range(columns - 1):
            corners = [(row, column), (row, column + 1), (row + 1, column + 1), (row + 1, column)]
            at = [values[c] for c in corners]
            if not np.isfinite(at).all():
                continue
            crossings = [_crossing(corners[k - 1], corners[k], at[k - 1], at[k], level)
                         for k in range(4) if (at[k - 1] < level) != (at[k] < level)]
            if len(crossings) == 4 and (np.mean(at) < level) == (at[0] < level):
                # A saddle whose middle is on the side of the first corner: cut off the other two.
                crossings = crossings[1:] + crossings[:1]
            segments += [(crossings[k], crossings[k + 1]) for k in range(0, len(crossings), 2)]
    return segments


def _crossing(a, b, value_a, value_b, level):
    share = (level - value_a) / (value_b - value_a)
    return (a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]))
