"""Scene text from Python: primitives, boxes, rooms and points. What the other generators of this folder are made of."""

import math
import pathlib

LUMENS_PER_WATT = 179.0


def primitive(modifier, kind, name, numbers=(), words=()):
    joined = "".join(f" {word}" for word in words)
    values = "".join(f" {value:.15g}" for value in numbers)
    return f"{modifier} {kind} {name}\n{len(words)}{joined}\n0\n{len(numbers)}{values}\n\n"


def diffuse(name, reflectance):
    """@param reflectance  one number or three channels"""
    channels = (reflectance,) * 3 if isinstance(reflectance, (int, float)) else tuple(reflectance)
    return primitive("void", "plastic", name, channels + (0, 0))


def lamp(name, radiance_W_per_m2_sr):
    return primitive("void", "light", name, (radiance_W_per_m2_sr,) * 3)


def polygon(material, name, *corners):
    return primitive(material, "polygon", name, [value for corner in corners for value in corner])


def sphere(material, name, centre, radius_m):
    return primitive(material, "sphere", name, (*centre, radius_m))


def faces(low, high):
    """The six rectangles of a box by name, corners counter-clockwise as seen from outside."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    return {
        "low_z": ((x0, y0, z0), (x0, y1, z0), (x1, y1, z0), (x1, y0, z0)),
        "high_z": ((x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)),
        "low_y": ((x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)),
        "high_y": ((x0, y1, z0), (x0, y1, z1), (x1, y1, z1), (x1, y1, z0)),
        "low_x": ((x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)),
        "high_x": ((x1, y0, z0), (x1, y1, z0), (x1, y1, z1), (x1, y0, z1)),
    }


def box(material, name, low, high, leave_out=()):
    return "".join(polygon(material, f"{name}_{face}", *corners) for face, corners in faces(low, high).items()
                   if face not in leave_out)


def room(name, low, high, materials):
    """A box seen from inside. @param materials  one name, or a dictionary by face with "other" for the rest"""
    by_face = materials if isinstance(materials, dict) else {"other": materials}
    return "".join(polygon(by_face.get(face, by_face.get("other")), f"{name}_{face}", *reversed(corners))
                   for face, corners in faces(low, high).items())


def level_panel(material, name, low, high, height_m, facing_up):
    (x0, y0), (x1, y1) = low, high
    corners = ((x0, y0, height_m), (x1, y0, height_m), (x1, y1, height_m), (x0, y1, height_m))
    return polygon(material, name, *(corners if facing_up else reversed(corners)))


def sun(radiance_W_per_m2_sr, to_sun, full_angle_deg=0.533):
    return lamp("solar", radiance_W_per_m2_sr) + primitive("solar", "source", "sun", (*to_sun, full_angle_deg))


def uniform_sky(radiance_W_per_m2_sr):
    return (primitive("void", "glow", "sky_glow", (radiance_W_per_m2_sr,) * 3 + (0,)) +
            primitive("sky_glow", "source", "sky", (0, 0, 1, 180)))


def level_grid(low, high, columns, rows, height_m):
    """Points that face up in the middle of the cells of a grid: (x, y, z, nx, ny, nz)."""
    (x0, y0), (x1, y1) = low, high
    return [(x0 + (x1 - x0) * (i + 0.5) / columns, y0 + (y1 - y0) * (j + 0.5) / rows, height_m, 0, 0, 1)
            for j in range(rows) for i in range(columns)]


def unit(vector):
    length = math.sqrt(sum(value * value for value in vector))
    return tuple(value / length for value in vector)


def write_points(file, points):
    text = "".join(" ".join(f"{value:.17g}" for value in point) + "\n" for point in points)
    pathlib.Path(file).write_text(text)
