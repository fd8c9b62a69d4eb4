"""Pictures of the engine as image objects of the document."""

import numpy as np

from lightwell_bridge import exr, false_colour, png

from . import results

# The layer whose channels are asked for.
LAYER = "Lightwell"
# The picture is exposed so that this share of its pixels is not white.
SHOWN_SHARE = 0.98
# Width of the image object, mm.
WIDTH_MM = 3000.0


def show(project, view, file):
    """Puts a picture beside the model; returns the image object, whose property Picture names the OpenEXR file.

    @throws ValueError when the file is none that can be shown
    """
    header, channels = exr.read(str(file))
    names = [f"{LAYER}.Combined.{c}" for c in "RGB"]
    missing = [n for n in names if n not in channels]
    if missing:
        raise ValueError(f"{file}: the picture has no channel {missing[0]}; it has {', '.join(sorted(channels))}")
    rgb, exposure = exposed(np.stack([channels[n] for n in names], axis=-1))
    shown = file.with_suffix(".png")
    shown.write_bytes(png.encode(rgb))
    plane = results.show_picture(project, f"Picture {view}", str(shown), WIDTH_MM)
    if "Picture" not in plane.PropertiesList:
        plane.addProperty("App::PropertyString", "Picture", "Lightwell", "The picture in W/(m2 sr), OpenEXR")
        plane.addProperty("App::PropertyFloat", "Exposure", "Lightwell", "Factor from W/(m2 sr) to what is shown")
    plane.Picture, plane.Exposure = str(file), exposure
    return plane


def exposed(rgb):
    """(encoded sRGB, the factor) of linear values, so that all but the brightest hundredths are within range."""
    luminance = rgb @ np.array([0.2126, 0.7152, 0.0722])
    lit = luminance[np.isfinite(luminance) & (luminance > 0)]
    white = float(np.quantile(lit, SHOWN_SHARE)) if lit.size else 1.0
    scaled = np.clip(np.nan_to_num(rgb) / white, 0, 1)
    return false_colour.encoded(scaled), 1 / white
