"""From the numbers of a host's material to a material of the scene language, by one stated rule.

1. A material with an emission is an emitter: its radiance is colour x strength in W/(m2 sr), or its luminance when one is
   given. It does not reflect.
2. Transmission of at least one half: a pane of glass when it is thin, with the transmittance that is given or else
   the base colour taken as that of the whole pane; a solid dielectric when it is closed.
3. Metallic of at least one half: metal of the base colour. In between, a mixture of both.
4. Else plastic: the base colour below, a coating of specularity 0.08 x specular above.

The roughness of hosts is the square root of the slope of the highlight's Gaussian: slope = roughness^2. Highlights
wider than `widest_slope` are left to the diffuse part.
"""

from dataclasses import dataclass, field
from typing import Optional

from . import colour, names

WIDEST_SLOPE = 0.4
# Beyond these no real surface reflects; what goes beyond is noted, not changed.
USUAL_REFLECTANCE = 0.95
BLACK = 1e-6


@dataclass
class Look:
    """A host's material. Colours are linear Rec.709."""

    name: str
    base: tuple = (0.8, 0.8, 0.8)
    metallic: float = 0.0
    roughness: float = 0.5
    specular: float = 0.5
    transmission: float = 0.0
    index: float = 1.45
    emission: tuple = (0.0, 0.0, 0.0)
    strength: float = 0.0  # W/(m2 sr) at colour 1
    luminance: Optional[float] = None  # cd/m2, in place of colour x strength
    transmittance: Optional[float] = None  # of a thin pane as a whole
    thin: bool = True
    picture: Optional[str] = None  # file in the scene folder, over the texture coordinates
    picture_aspect: float = 1.0  # width over height
    mixed: list = field(default_factory=list)  # (share, Look) in place of the above

    def emits(self):
        return (self.luminance or 0) > 0 or (self.strength > 0 and max(self.emission) > BLACK)


def add_look(folder, look, efficacy=colour.LUMENS_PER_WATT):
    """Defines the look's material in the folder under its name; returns notes for people."""
    notes = []
    if look.mixed:
        _add_mixture(folder, look, efficacy, notes)
    elif look.emits():
        _add_emitter(folder, look, efficacy)
    elif look.transmission >= 0.5:
        _add_glass(folder, look, notes)
    elif look.metallic in (0.0, 1.0):
        _add_reflector(folder, look, look.name, "metal" if look.metallic else "plastic", notes)
    else:
        parts = [(1 - look.metallic, "plastic"), (look.metallic, "metal")]
        for _, kind in parts:
            _add_reflector(folder, look, f"{look.name}.{kind}", kind, notes)
        _mix(folder, look.name, *(f"{look.name}.{kind}" for _, kind in reversed(parts)), look.metallic)
    return notes


def radiance(look, efficacy=colour.LUMENS_PER_WATT):
    """Engine radiance of an emitting look, W/(m2 sr) of 179 lm/W."""
    if look.luminance:
        hue = look.emission if max(look.emission) > BLACK else (1.0, 1.0, 1.0)
        return colour.of_luminance(hue, look.luminance / colour.LUMENS_PER_WATT)
    scale = look.strength * efficacy / colour.LUMENS_PER_WATT
    return tuple(c * scale for c in colour.from_rec709(look.emission))


def _add_emitter(folder, look, efficacy):
    folder.material("light", look.name, numbers=radiance(look, efficacy))


def _add_glass(folder, look, notes):
    if not look.thin:
        # The base colour tints each of the two passes through the boundary in hosts; here it is the body, per metre.
        body = tuple(min(max(c, 0.0), 1.0) for c in colour.from_rec709(look.base))
        folder.material("dielectric", look.name, numbers=(*body, max(look.index, 1.0001), 0))
        return
    index = look.index if look.index > 1 else 1.52
    whole = colour.from_rec709(look.base)
    if look.transmittance is not None:
        whole = colour.of_luminance(look.base, look.transmittance)
    highest = clear_transmittance(index)
    if max(whole) > highest:
        notes.append(f"material \"{look.name}\": transmittance {max(whole):.3f} is more than a clear pane of index "
                     f"{index:g} lets through ({highest:.3f}); taken as clear")
    tau = [transmissivity(min(c, highest), index) for c in whole]
    folder.material("glass", look.name, numbers=(*tau, index))


def clear_transmittance(index):
    """Of a clear pane at normal incidence, all interreflections within counted."""
    boundary = ((index - 1) / (index + 1)) ** 2
    return (1 - boundary) / (1 + boundary)


def transmissivity(transmittance, index):
    """What one passage through the pane leaves, from the transmittance of the whole at normal incidence."""
    boundary = ((index - 1) / (index + 1)) ** 2
    passed, back = (1 - boundary) ** 2, transmittance * boundary ** 2
    if transmittance <= 0:
        return 0.0
    # transmittance = passed t / (1 - boundary^2 t^2), solved for t.
    return min(1.0, ((passed ** 2 + 4 * back * transmittance) ** 0.5 - passed) / (2 * back)) if back > 0 else transmittance


def _add_reflector(folder, look, name, kind, notes):
    slope = look.roughness ** 2
    rgb = tuple(max(c, 0.0) for c in colour.from_rec709(look.base)) if look.picture is None else (1.0, 1.0, 1.0)
    if max(rgb) > USUAL_REFLECTANCE and look.picture is None:
        notes.append(f"material \"{look.name}\": reflectance {max(rgb):.3f}, real surfaces stay below "
                     f"{USUAL_REFLECTANCE}; taken as it is (at most 1)")
        rgb = tuple(min(c, 1.0) for c in rgb)
    if kind == "metal":
        specularity, slope = (1.0, slope) if slope <= WIDEST_SLOPE else (0.0, 0.0)
    else:
        specularity = 0.08 * min(max(look.specular, 0.0), 1.0)
        if slope > WIDEST_SLOPE or specularity == 0:
            specularity = slope = 0.0
    pattern = "void"
    if look.picture is not None:
        pattern = f"{look.name}.picture"
        folder.material("colorpict", pattern, words=picture_words(look.picture, look.picture_aspect))
    folder.material(kind, name, numbers=(*rgb, specularity, slope), modifier=pattern)


def picture_words(file, aspect):
    """A picture repeated over texture coordinates of 0 to 1; the language counts the shorter side as 1."""
    across = "frac(Lu)" + (f"*{aspect!r}" if aspect > 1 else "")
    upwards = "frac(Lv)" + (f"*{1 / aspect!r}" if aspect < 1 else "")
    return ("red", "green", "blue", file, ".", across, upwards)


def _add_mixture(folder, look, efficacy, notes):
    parts = [(share, part) for share, part in look.mixed if share > 0]
    if any(part.emits() for _, part in parts):
        share, brightest = max(((s, p) for s, p in parts if p.emits()), key=lambda entry: entry[0])
        notes.append(f"material \"{look.name}\": a mixture with an emitter is taken as the emitter alone, "
                     f"{share:.0%} of it")
        folder.material("light", look.name, numbers=tuple(share * c for c in radiance(brightest, efficacy)))
        return
    total, known = 0.0, None
    for number, (share, part) in enumerate(parts):
        part.name = f"{look.name}.{number + 1}"
        notes.extend(add_look(folder, part, efficacy))
        total += share
        if known is None:
            known = part.name
            continue
        mixture = look.name if number == len(parts) - 1 else f"{look.name}.{number + 1}.mixed"
        _mix(folder, mixture, part.name, known, share / total)
        known = mixture
    if known != look.name:
        folder.alias(look.name, known)


def _mix(folder, name, foreground, background, share):
    folder.material("mixfunc", name, words=(names.encoded(foreground), names.encoded(background), repr(float(share)), "."))
