"""The sky of a place and a time, as lines of the scene language."""

import datetime
import re
from dataclasses import dataclass

TYPES = ("clear", "clear-no-sun", "intermediate", "intermediate-no-sun", "overcast", "uniform")
_OPTIONS = {"clear": "+s", "clear-no-sun": "-s", "intermediate": "+i", "intermediate-no-sun": "-i", "overcast": "-c",
            "uniform": "-u"}


@dataclass
class Sky:
    """Latitude north and longitude east positive; `time` is ISO 8601 with its offset from UTC."""

    type: str = "clear"
    latitude_deg: float = 52.5
    longitude_deg: float = 13.4
    time: str = "2026-03-21T12:00+01:00"
    north_deg: float = 0.0  # direction of north, counter-clockwise from +y
    turbidity: float = 2.45
    ground_reflectance: float = 0.2


# Sky and ground: what the brightness function shines on.
_DOME = """skyfunc glow sky_glow
0
0
4 1 1 1 0
sky_glow source sky
0
0
4 0 0 1 180
skyfunc glow ground_glow
0
0
4 1 1 1 0
ground_glow source ground
0
0
4 0 0 -1 180
"""


def moment(text):
    """(local time, offset from UTC in hours) of "2026-03-21T12:00+01:00".

    @throws ValueError that shows the form
    """
    match = re.fullmatch(r"(\d{4}-\d{2}-\d{2}T\d{2}:\d{2}(?::\d{2})?)(Z|[+-]\d{2}:\d{2})", text.strip())
    try:
        if match:
            time = datetime.datetime.fromisoformat(match[1] + match[2].replace("Z", "+00:00"))
            return time, time.utcoffset().total_seconds() / 3600
    except ValueError:
        pass
    raise ValueError(f"\"{text}\" is no time with an offset from UTC; expected for example 2026-03-21T12:00+01:00")


def sky_text(sky):
    """Sun, sky and ground.

    @throws ValueError when a value is out of its range
    """
    if sky.type not in TYPES:
        raise ValueError(f"\"{sky.type}\" is no sky; expected one of {', '.join(TYPES)}")
    for what, value, low, high in (("latitude", sky.latitude_deg, -90, 90), ("longitude", sky.longitude_deg, -180, 180),
                                   ("turbidity", sky.turbidity, 1, 30),
                                   ("ground reflectance", sky.ground_reflectance, 0, 1)):
        if not low <= value <= high:
            raise ValueError(f"sky: {what} is {value:g}, expected {low} to {high}")
    time, offset_h = moment(sky.time)
    hours = time.hour + time.minute / 60 + time.second / 3600
    command = (f"!gensky {time.month} {time.day} {hours:.5f} -y {time.year} {_OPTIONS[sky.type]} -a {sky.latitude_deg!r} "
               f"-o {-sky.longitude_deg!r} -m {-15 * offset_h!r} -t {sky.turbidity!r} -g {sky.ground_reflectance!r}")
    return f"# {sky.type} sky, {sky.time}\n{command}\n{_DOME}"


def add_sky(folder, sky):
    """Puts sky.rad into the folder and names it in the scene, turned so that north is where the host has it."""
    folder.file("sky.rad", sky_text(sky).encode())
    folder.text(f"# north {sky.north_deg:g} degrees counter-clockwise from +y\n!xform -rz {sky.north_deg!r} sky.rad",
                light=True)


def sky_text_of_sun(kind, altitude_deg, azimuth_deg):
    """The same for a sun that is given by its place: azimuth clockwise from +y."""
    return (f"# {kind} sky, sun at altitude {altitude_deg:g}, {azimuth_deg:g} degrees clockwise from +y\n"
            f"!gensky -ang {altitude_deg!r} {(azimuth_deg - 180)!r} {_OPTIONS[kind]}\n{_DOME}")


def uniform_text(rgb):
    """One radiance from everywhere, W/(m2 sr)."""
    numbers = " ".join(repr(float(c)) for c in rgb)
    return f"void glow world_glow\n0\n0\n4 {numbers} 0\nworld_glow source world\n0\n0\n4 0 0 1 360\n"
