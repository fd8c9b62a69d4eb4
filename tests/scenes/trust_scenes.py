"""Five small scenes for intervals: an easy room, reflectance 0.95, a small bright source, gloss, sun through an opening.

Each is a function that returns (scene text, points); SCENES lists them by name.
"""

from text import box, diffuse, lamp, level_grid, level_panel, primitive, room, sphere, sun, uniform_sky, unit

LOW, HIGH = (0, 0, 0), (4, 3, 2.5)
PANEL_HEIGHT_M = 2.49


def _points(height_m=0.8):
    return level_grid((0, 0), (4, 3), 4, 3, height_m)


def _panel(radiance, height_m=PANEL_HEIGHT_M):
    return lamp("panel", radiance) + level_panel("panel", "lamp", (1.5, 1), (2.5, 2), height_m, facing_up=False)


def easy():
    """Grey walls, a panel of 1 m2 below the ceiling, a table: nothing that a path could miss."""
    text = diffuse("wall", 0.5) + room("room", LOW, HIGH, "wall") + _panel(20)
    return text + box("wall", "table", (1, 1, 0.7), (1.8, 2, 0.74)), _points()


def bright_walls():
    """The same without the table, the panel flush with the ceiling, reflectance 0.95: light is reflected twenty times."""
    return diffuse("wall", 0.95) + room("room", LOW, HIGH, "wall") + _panel(20, HIGH[2] - 1e-4), _points()


def bright_slit():
    """The same with a slit of 1 cm above the panel, which swallows 1 % of the light: finer than what is interpolated."""
    return diffuse("wall", 0.95) + room("room", LOW, HIGH, "wall") + _panel(20), _points()


def small_source():
    """A bulb of 5 mm, 6 cm below the ceiling in a dish: all light comes by way of a small bright patch."""
    dish = [(x, y) for x, y in ((1.9, 1.4), (2.1, 1.4), (2.1, 1.6), (1.9, 1.6))]
    text = diffuse("wall", 0.5) + room("room", LOW, HIGH, "wall") + lamp("bulb", 2e5)
    text += sphere("bulb", "lamp", (2, 1.5, 2.44), 0.005)
    return text + box("wall", "dish", (*dish[0], 2.40), (*dish[2], 2.41)), _points()


def glossy():
    """Walls that gleam (roughness 0.1) around a lamp which a screen hides from the points."""
    text = primitive("void", "metal", "gleam", (0.7, 0.7, 0.7, 0.9, 0.1)) + diffuse("wall", 0.4)
    text += room("room", LOW, HIGH, {"low_x": "gleam", "high_x": "gleam", "low_y": "gleam", "other": "wall"})
    text += _panel(60) + box("wall", "screen", (1.2, 0.7, 2.0), (2.8, 2.3, 2.02))
    return text, _points()


def sun_opening():
    """Sun and sky through an opening of 0.3 m: a bright patch on the floor lights the rest."""
    to_sun = unit((-0.6, 0.1, 0.5))
    text = diffuse("wall", 0.5) + sun(2e6, to_sun) + uniform_sky(10)
    sides = room("room", LOW, HIGH, {"other": "wall"})
    text += sides[:sides.index("wall polygon room_low_x")] + sides[sides.index("wall polygon room_high_x"):]
    low, high = (1.35, 1.6), (1.65, 1.9)  # of the opening, y and z
    for name, (y0, z0), (y1, z1) in (("below", (0, 0), (3, low[1])), ("above", (0, high[1]), (3, 2.5)),
                                     ("left", (0, low[1]), (low[0], high[1])), ("right", (high[0], low[1]), (3, high[1]))):
        text += box("wall", f"front_{name}", (-0.1, y0, z0), (0, y1, z1))
    return text, _points(0.6)


SCENES = {function.__name__: function for function in (easy, bright_walls, small_source, glossy, sun_opening)}
# Where bias is known to be beyond the noise: shown when asked for.
BIASED = {"bright_slit": bright_slit}
