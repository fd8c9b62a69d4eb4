"""The rows of the yardstick that compare points with a reference: scene, points, reference values, goals."""

import dataclasses
import math
import pathlib
import re
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
from errors import compared_with
from text import diffuse, lamp, sphere

RADIOSITY_STEP = 2.3e-4  # of the last extrapolation, relative: the table says so itself
REFERENCES = pathlib.Path(__file__).resolve().parent / "references"


@dataclasses.dataclass
class Row:
    name: str
    title: str
    scene: pathlib.Path
    points: list            # (x, y, z, nx, ny, nz)
    reference: np.ndarray   # by compared point, luminous weights applied, without 179 lm/W
    compared: np.ndarray    # indices of the points that the reference has
    noise: float            # relative standard error of a point of the reference
    goals: list             # (relative RMS error, CPU seconds)
    room_ratio: float       # for Radiance's ambient resolution


def read_reference(file):
    """Lines `x,y,z,dx,dy,dz,value[,standard error]` under comments. @return  values, relative noise of a point"""
    table = np.loadtxt(file, delimiter=",", comments="#", ndmin=2)
    values = table[:, 6]
    noise = float(np.sqrt(np.mean((table[:, 7] / compared_with(values)) ** 2))) if table.shape[1] > 7 else 0.0
    return table[:, :6], values, noise


def matching(points, wanted):
    """Index of each wanted place among the points."""
    key = lambda place: tuple(round(float(value), 3) for value in place[:3])  # millimetres: tables have few digits
    places = {key(point): index for index, point in enumerate(points)}
    return np.array([places[key(place)] for place in wanted])


def _row(name, title, scene, points, file, goals, room_ratio, noise=None):
    """@param file  reference; without it all values are unknown and every point counts"""
    if not file.exists():
        return Row(name, title, scene, points, np.full(len(points), np.nan), np.arange(len(points)), 0.0, goals, room_ratio)
    places, values, found_noise = read_reference(file)
    return Row(name, title, scene, points, values, matching(points, places), found_noise if noise is None else noise,
               goals, room_ratio)


def sphere_row(yardstick, folder, reflectance, goals):
    """A bulb in a closed sphere; exact."""
    import a_box
    name = f"a{round(100 * reflectance)}"
    scene, points = folder / f"{name}.rad", a_box.sphere_pts()
    scene.write_text(diffuse("wall", reflectance) + lamp("lamp", a_box.LE) + sphere("wall", "shell", (0, 0, 0), a_box.R) +
                     sphere("lamp", "bulb", (0, 0, 0), a_box.r))
    exact = np.array([a_box.sphere_exact(reflectance, math.dist(point[:3], (0, 0, 0))) for point in points])
    return Row(name, f"closed sphere, reflectance {reflectance}", scene, points, exact, np.arange(len(points)), 0.0,
               goals, 1.0)


def office_row(yardstick, folder):
    import b_office
    b_office.gen(str(folder))
    return _row("b", "office, 216 points", folder / "office.rad", b_office.grid(),
                yardstick / "reference/b_office.csv", [(0.004, 0.15), (0.001, 1.7)], 1.5, RADIOSITY_STEP)


def blended_sky(text):
    """The scene's clear sky as skybright.cal has it, which blends it into the ground over the horizon."""
    start, end = text.index("void brightfunc"), text.index("skyfunc glow")
    numbers = [float(word) for word in text[start:end].split()[8:]]
    x, y, z, zenith, ground = numbers
    angle = math.acos(z)
    norm = (0.91 + 10 * math.exp(-3 * angle) + 0.45 * z * z) * 0.273853
    function = f"void brightfunc skyfunc\n2 skybr skybright.cal\n0\n7 1 {zenith:g} {ground:g} {norm:.9g} {x} {y} {z}\n\n"
    return text[:start] + function + text[end:]


def daylit_row(yardstick, folder, blended):
    import c_daylit
    c_daylit.gen(str(folder))
    text = (folder / "sky.rad").read_text() + (folder / "scene.rad").read_text()
    name = "c_blended" if blended else "c"
    scene = folder / f"{name}.rad"
    scene.write_text(blended_sky(text) if blended else text)
    title = "daylit office, 120 points" + (", sky of skybright.cal" if blended else "")
    return _row(name, title, scene, c_daylit.grid(), REFERENCES / f"{name}_daylit.csv",
                [(0.05, 0.2), (0.016, 2.0)], 25.7)


DIFFERENCE = """
{ The clear sky as its formula gives it, minus the one that skybright.cal blends into the ground; A1-A5 as in sky.cal }
blended_clear = A4*(.91 + 10*exp(-3*acos(cl(cg))) + .45*cg*cg)*if(Dz-.01, 1-exp(-.32/Dz), 1)/(phi(acos(A3))*.273853);
blended = ((Dz+1.01)^10*blended_clear + (Dz+1.01)^-10*A5)/((Dz+1.01)^10 + (Dz+1.01)^-10);
difference = skyL - blended;
pos = if(difference, difference, 0);
neg = if(difference, 0, -difference);
"""


def difference_sky(blended_scene, part):
    """The daylit office under one part, "pos" or "neg", of the difference between its two skies, without the sun."""
    folder = blended_scene.parent
    (folder / "difference.cal").write_text((folder / "sky.cal").read_text() + DIFFERENCE)
    sky = (folder / "sky.rad").read_text()
    sky = sky[sky.index("void brightfunc"):].replace("skyL sky.cal", f"{part} difference.cal")
    return sky + (folder / "scene.rad").read_text()


THEATRE_STEP = 3  # every third point has a reference
SHORT_FOCUS = 1e-6  # m behind the lamp


def theatre_row(yardstick, folder, points_behind):
    """Direct light alone: all surfaces black, so that nothing else is computed.

    @param points_behind  the beams as given: their light falls off from a point a metre behind the lamp, the length of
    the vector that aims it; else from the lamp itself"""
    import d_theatre
    d_theatre.gen(str(folder))
    text = (folder / "theatre.rad").read_text()
    name = "d" if points_behind else "d_point"
    if not points_behind:
        text = re.sub(r"(spotlight \w+\n0\n0\n7 \S+ \S+ \S+ \S+) (\S+) (\S+) (\S+)", lambda found: " ".join(
            [found[1], *(f"{float(found[axis]) * SHORT_FOCUS:.12g}" for axis in (2, 3, 4))]), text)
    scene = folder / f"{name}.rad"
    scene.write_text(re.sub(r"(plastic \w+\n0\n0\n5) [^\n]*", r"\1 0 0 0 0 0", text))
    title = "theatre, soft shadows, 27,000 points" + ("" if points_behind else ", beams without focal length")
    return _row(name, title, scene, d_theatre.grid(), REFERENCES / f"{name}_theatre.csv", [(0.02, 1.0)], 1.5)


def ball_row(yardstick, folder):
    import g_sphere_room
    g_sphere_room.gen(str(folder))
    return _row("g", "line beside the ball, 120 points", folder / "ball.rad", g_sphere_room.line(),
                REFERENCES / "g_line.csv", [(0.01, 1.6)], 1.25)


CURVE_STEPS = 20  # between two points of the line: then they are so many that they share records


def curve_row(yardstick, folder):
    """The same line as a curve through interpolated records (the paper's Figure 3), compared at the points of the line."""
    import g_sphere_room
    g_sphere_room.gen(str(folder))
    line = np.array(g_sphere_room.line())
    between = [a + (b - a) * step / CURVE_STEPS for a, b in zip(line, line[1:]) for step in range(CURVE_STEPS)]
    points = [tuple(point) for point in [*between, line[-1]]]
    return _row("g_curve", f"curve beside the ball, {len(points)} points", folder / "ball.rad", points,
                REFERENCES / "g_line.csv", [(0.01, 1.6)], 1.25)


BUILDERS = {
    "a80": lambda y, f: sphere_row(y, f, 0.8, [(0.001, 0.2)]),
    "a95": lambda y, f: sphere_row(y, f, 0.95, [(0.001, 0.2)]),
    "a99": lambda y, f: sphere_row(y, f, 0.99, [(0.001, 0.2)]),
    "b": office_row,
    "c": lambda y, f: daylit_row(y, f, blended=False),
    "c_blended": lambda y, f: daylit_row(y, f, blended=True),
    "d": lambda y, f: theatre_row(y, f, points_behind=True),
    "d_point": lambda y, f: theatre_row(y, f, points_behind=False),
    "g": ball_row,
    "g_curve": curve_row,
}


def build(name, yardstick, folder, with_reference=True):
    """@param yardstick  folder with scenes/ (generators) and reference/ (tables)
    @param with_reference  False: the scene and points alone, before there is a reference"""
    if str(yardstick / "scenes") not in sys.path:
        sys.path.insert(0, str(yardstick / "scenes"))
    row = BUILDERS[name](yardstick, folder)
    if name.startswith("d") and not with_reference:
        row.compared = np.arange(0, len(row.points), THEATRE_STEP)
    if with_reference and np.isnan(row.reference).any():
        sys.exit(f"row {name} has no reference yet: reference.py {name} makes it")
    return row
