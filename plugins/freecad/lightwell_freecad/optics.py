"""What faces are made of: the rule that names their layer, and what it means when no layer map says more.

The most particular thing that is known about a face decides:

    part of a window > colour of the face > material of the object > Draft layer > group > default
"""

import math

from lightwell_bridge import colour

DEFAULT = "(no layer)"
DEFAULT_REFLECTANCE = 0.5
USUAL_KELVIN = 4000.0
# No painted surface is whiter: a colour that says more is lowered to it.
HIGHEST_REFLECTANCE = 0.9


class Key:
    """Name of a face's layer, and what the document knows of it.

    name     what the layer map sees: "A-GLAZ/Glass panel"
    decided  which step of the rule it was, for the report
    rgb      sRGB as typed in FreeCAD, 0 to 1; None: nothing known
    transmitted   share of light that passes, 0 to 1
    closed   the faces bound a solid, so that light passes two of them
    """

    def __init__(self, name, decided, rgb=None, transmitted=0.0, closed=False):
        self.name, self.decided, self.rgb = name, decided, rgb
        self.transmitted, self.closed = transmitted, closed

    def identity(self):
        return (self.name, self.closed and self.transmitted > 0)


def keys_of(placed, appearance, shape):
    """One key for each face of a shape, or a list with one key for a mesh."""
    leaf, count = placed.leaf, len(shape.Faces) if shape is not None else 1
    closed = _faces_of_solids(shape) if shape is not None else [leaf.Mesh.isSolid()]
    parts = _window_parts(leaf, shape) if shape is not None else None
    colours = appearance.face_colours(leaf, count)
    materials = _materials(leaf, shape, count)
    rest = _of_layer_or_group(placed, appearance)
    keys = []
    for i in range(count):
        if parts:
            key = _of_part(parts[i], colours[i] if colours else None, rest)
        elif colours:
            key = _of_colour(colours[i])
        elif materials[i] is not None:
            key = _of_material(materials[i])
        else:
            key = rest
        name = key.name if key is rest or placed.layer is None else f"{placed.layer}/{key.name}"
        keys.append(Key(name, key.decided, key.rgb, key.transmitted, closed[i]))
    return keys


def material_of(key):
    """(kind, numbers) in the scene language of what is only known by its colour."""
    if key.rgb is None:
        return "plastic", (DEFAULT_REFLECTANCE,) * 3 + (0, 0)
    linear = [_linear(c) for c in key.rgb]
    if key.transmitted > 0:
        share = math.sqrt(key.transmitted) if key.closed else key.transmitted
        return "glass", (_transmissivity(min(share, 1.0)),) * 3
    return "plastic", tuple(min(c, HIGHEST_REFLECTANCE) for c in colour.from_rec709(linear)) + (0, 0)


def kelvin_of(owner):
    """Colour temperature of a luminaire.

    @throws ValueError when it is none
    """
    kelvin = float(getattr(owner, "lw_cct", 0) or USUAL_KELVIN)
    if not 1000 <= kelvin <= 40000:
        raise ValueError(f"its colour temperature is {kelvin} K, expected 1000 to 40000")
    return kelvin


def light_of(lumens, kelvin, area_m2):
    """Numbers of a `light` that leaves `area_m2` with that flux, the same in all directions."""
    if not (lumens > 0 and math.isfinite(lumens)):
        raise ValueError(f"it shall give {lumens} lm, expected more than 0")
    luminance = lumens / (math.pi * area_m2)
    return colour.of_luminance(colour.blackbody_hue(kelvin), luminance / colour.LUMENS_PER_WATT)


def _of_part(part, rgba, rest):
    name, kind, transparency = part
    glazed = "glass" in kind.lower() or transparency > 0
    rgb = rgba[:3] if rgba else (1.0, 1.0, 1.0) if glazed else rest.rgb
    passed = (rgba[3] if rgba else transparency) if glazed else 0.0
    if glazed and passed <= 0:
        passed = 0.85
    return Key(f"{name} ({kind})", "part of a window", rgb, passed)


def _of_colour(rgba):
    name = "colour #" + "".join("%02X" % round(255 * c) for c in rgba[:3])
    if rgba[3] > 0.004:
        name += f" {round(100 * rgba[3])}%"
    return Key(name, "colour of the face", rgba[:3], rgba[3])


def _of_material(material):
    values = dict(getattr(material, "Material", None) or {})
    rgb = _numbers(values.get("DiffuseColor") or values.get("Color") or "")
    try:
        passed = float(values.get("Transparency", 0)) / 100
    except ValueError:
        passed = 0.0
    return Key(material.Label, "material of the object", rgb[:3] if len(rgb) >= 3 else None, min(max(passed, 0.0), 1.0))


def _of_layer_or_group(placed, appearance):
    own = appearance.object_colour(placed.leaf)
    rgb, passed = own if own else (None, 0.0)
    if placed.layer is not None:
        return Key(placed.layer, "layer", rgb, passed)
    if placed.group is not None:
        return Key(placed.group, "group", rgb, passed)
    return Key(DEFAULT, "default", rgb, passed)


def _numbers(text):
    try:
        return [float(w) for w in str(text).strip("()[] ").split(",")]
    except ValueError:
        return []


def _materials(leaf, shape, count):
    """The material of each face: those of a layered wall go by its solids, one after the other."""
    material = getattr(leaf, "Material", None)
    if material is None or not hasattr(material, "Label"):
        return [None] * count
    layers = getattr(material, "Materials", None)
    if not layers:
        return [material] * count
    solids = [s.Faces for s in shape.Solids] if shape is not None else []
    if len(solids) != len(layers) or sum(len(f) for f in solids) != count:
        return [layers[0]] * count
    return [layer for layer, faces in zip(layers, solids) for _ in faces]


def _window_parts(leaf, shape):
    """(name, type, transparency) of each face of an Arch window, whose solids come in the order of its parts."""
    words = list(getattr(leaf, "WindowParts", None) or [])
    parts = [words[i:i + 5] for i in range(0, len(words) - 4, 5)]
    if not parts or len(parts) != len(shape.Solids) or sum(len(s.Faces) for s in shape.Solids) != len(shape.Faces):
        return None
    return [(part[0], part[1], 0.85 if "glass" in part[1].lower() else 0.0)
            for part, solid in zip(parts, shape.Solids) for _ in solid.Faces]


def _faces_of_solids(shape):
    inside = {face.hashCode() for solid in shape.Solids for face in solid.Faces}
    return [face.hashCode() in inside for face in shape.Faces]


def _linear(c):
    """sRGB to linear."""
    return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4


def _transmissivity(transmittance):
    """What `glass` of index 1.52 wants for a pane of that transmittance at normal incidence, at most 1.

    Source  transmittance of a pane with all reflections between its faces, solved for what one passage lets through
    """
    if transmittance <= 0:
        return 0.0
    reflected = ((1.52 - 1) / (1.52 + 1)) ** 2
    passed = (1 - reflected) ** 2
    # T = passed t / (1 - reflected^2 t^2)
    root = math.sqrt(passed ** 2 + 4 * (transmittance * reflected) ** 2)
    return min((root - passed) / (2 * transmittance * reflected ** 2), 1.0)
