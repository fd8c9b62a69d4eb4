"""The project in the tree: views, sensor grids, sky, layer map and quality. Everything works without a window too.

    from lightwell_freecad import project, run
    p = project.make(FreeCAD.ActiveDocument)
    p.SkyType, p.Time = "overcast", "2026-03-21T12:00+01:00"
    project.add_grid(p, wall, "Face3", spacing_mm=500)
    run.illuminance(p)
"""

import math

from lightwell_bridge import sky as skies
from lightwell_bridge.scene_folder import number

from . import grids, icon_files, walk
from .features import Feature, View

ELECTRIC_ONLY = "electric only"
VIEW_KINDS = {"perspective": "v", "parallel": "l", "fisheye hemispherical": "h", "fisheye angular": "a",
              "cylindrical": "c"}


class Project(Feature):
    kind = "Project"
    PROPERTIES = (
        ("App::PropertyEnumeration", "SkyType", "Sky", "The CIE sky that shines in; without one only luminaires shine",
         [ELECTRIC_ONLY, *skies.TYPES]),
        ("App::PropertyFloat", "Latitude", "Sky", "Degrees, north positive; taken from the site of the document", 52.5),
        ("App::PropertyFloat", "Longitude", "Sky", "Degrees, east positive; taken from the site of the document", 13.4),
        ("App::PropertyFloat", "North", "Sky", "Direction of north, degrees counter-clockwise from +Y: the site's declination", 0.0),
        ("App::PropertyString", "Time", "Sky", "Local time with its offset from UTC: 2026-03-21T12:00+01:00",
         "2026-03-21T12:00+01:00"),
        ("App::PropertyFloat", "Turbidity", "Sky", "Haze of a clear sky: 2 in the mountains, 3 in a town", 2.45),
        ("App::PropertyFloat", "GroundReflectance", "Sky", "Share of light that the ground outside reflects", 0.2),
        ("App::PropertyStringList", "LayerMap", "Materials",
         "One rule a line, PATTERN = MATERIAL, the last that matches wins: A-WALL* = white_paint", None),
        ("App::PropertyFloat", "Accuracy", "Quality", "Median relative standard error to reach, 0.05 is 5 %", 0.05),
        ("App::PropertyFloat", "Seconds", "Quality", "The best result in this time; 0: as accurate as asked", 0.0),
        ("App::PropertyInteger", "Width", "Quality", "Columns of pictures", 800),
        ("App::PropertyInteger", "Height", "Quality", "Rows of pictures", 600),
        ("App::PropertyLength", "ChordTolerance", "Quality",
         "How far facets may lie from curved faces that are no whole cylinder, cone or sphere", 1.0),
        ("App::PropertyLength", "FaceSpacing", "Quality", "Distance of sensors on faces, for the illuminance of objects",
         250.0),
        ("App::PropertyString", "Engine", "Engine",
         "The program lightwell; empty: the preference, LIGHTWELL_ENGINE, beside the workbench, PATH", ""),
        ("App::PropertyString", "SavedColours", "Engine", "Colours of objects that now show results", ""),
    )


class ViewPoint(Feature):
    kind = "View"
    PROPERTIES = (
        ("App::PropertyEnumeration", "Kind", "View", "Projection", list(VIEW_KINDS)),
        ("App::PropertyVector", "Position", "View", "Where the eye is, mm", (0, 0, 1600)),
        ("App::PropertyVector", "Direction", "View", "Where it looks", (0, 1, 0)),
        ("App::PropertyVector", "Up", "View", "What is up in the picture", (0, 0, 1)),
        ("App::PropertyFloat", "Angle", "View", "Across the picture, degrees; of a parallel view its width in mm", 60.0),
    )


class SensorGrid(Feature):
    kind = "Grid"
    PROPERTIES = (
        ("App::PropertyLinkSub", "Face", "Grid", "The plane face that it covers", None),
        ("App::PropertyLength", "Spacing", "Grid", "Distance of the sensors", 500.0),
        ("App::PropertyDistance", "Offset", "Grid", "Height above the face: 750 mm over a floor is desks", 0.0),
    )


def make(document):
    """The project of a document: the one it has, or a new one with the place of its site."""
    existing = find(document)
    if existing is not None:
        return existing
    obj = document.addObject("App::DocumentObjectGroupPython", "Lightwell")
    obj.Label = "Lightwell"
    Project(obj)
    obj.setEditorMode("SavedColours", 2)
    _show(obj, "lightwell")
    for site in document.Objects:
        if walk.kind_of(site) == "Site":
            take_site(obj, site)
            break
    return obj


def find(document):
    """The project of a document, or None."""
    return next((o for o in document.Objects if walk.kind_of(o) == "LightwellProject"), None)


def take_site(project, site):
    """Place, north and time zone of an Arch site."""
    for name, value in (("Latitude", getattr(site, "Latitude", None)), ("Longitude", getattr(site, "Longitude", None)),
                        ("North", getattr(site, "Declination", None))):
        if value is not None:
            setattr(project, name, float(getattr(value, "Value", value)))
    zone = int(getattr(site, "TimeZone", 0) or 0)
    if zone:
        project.Time = project.Time[:16] + f"{'-' if zone < 0 else '+'}{abs(zone):02d}:00"


def add_view(project, label="View", kind="perspective", position=(0, 0, 1600), direction=(0, 1, 0), up=(0, 0, 1), angle=60.0):
    obj = project.Document.addObject("App::FeaturePython", "LightwellView")
    ViewPoint(obj)
    obj.Label, obj.Kind, obj.Angle = label, kind, angle
    obj.Position, obj.Direction, obj.Up = position, direction, up
    _show(obj, "view")
    project.addObject(obj)
    return obj


def add_grid(project, owner, face=None, spacing_mm=500.0, offset_mm=0.0, label=None):
    """A grid over a plane face, "Face3" for example; without one the largest plane face that looks up, else the largest."""
    name = face or _best_face(owner)
    obj = project.Document.addObject("App::FeaturePython", "LightwellGrid")
    SensorGrid(obj)
    obj.Label = label or f"Grid on {owner.Label}"
    obj.Face, obj.Spacing, obj.Offset = (owner, [name]), spacing_mm, offset_mm
    _show(obj, "grid")
    project.addObject(obj)
    return obj


def make_luminaire(obj, lumens=1000.0, kelvin=4000, ies=""):
    """Makes an object shine: evenly, from all its fronts, or as a photometric file has measured it."""
    for kind, name, tip, value in (("App::PropertyString", "lw_role", "What it does in a lighting simulation", "luminaire"),
                                   ("App::PropertyFloat", "lw_lumens", "Luminous flux, lm", float(lumens)),
                                   ("App::PropertyInteger", "lw_cct", "Colour temperature, K", int(kelvin)),
                                   ("App::PropertyString", "lw_ies", "IES or EULUMDAT file: its light and its lumens count, "
                                    "towards the object's -z; empty: evenly, with lw_lumens", str(ies))):
        if name not in obj.PropertiesList:
            obj.addProperty(kind, name, "Lightwell", tip)
        if value != "":
            setattr(obj, name, value)
    return obj


def views_of(project):
    """(name, words) of each view."""
    return [(o.Label, view_words(o, project)) for o in project.Group if walk.kind_of(o) == "LightwellView"]


def view_words(view, project):
    """The view in the words of the scene language.

    @throws ValueError when it looks nowhere
    """
    if view.Direction.Length < 1e-9 or view.Up.cross(view.Direction).Length < 1e-9 * view.Direction.Length:
        raise ValueError(f"view \"{view.Label}\" looks along its up direction or nowhere")
    aspect = project.Width / max(project.Height, 1)
    letter, across = VIEW_KINDS[view.Kind], view.Angle
    if letter == "v":
        if not 0 < across < 180:
            raise ValueError(f"view \"{view.Label}\": {across:g} degrees, expected more than 0 and less than 180")
        upwards = math.degrees(2 * math.atan(math.tan(math.radians(across) / 2) / aspect))
    elif letter == "l":
        across, upwards = across * 1e-3, across * 1e-3 / aspect
    else:
        upwards = across if letter in "ha" else across / aspect
    words = [f"-vt{letter}", "-vp", *(c * 1e-3 for c in view.Position), "-vd", *view.Direction, "-vu", *view.Up,
             "-vh", across, "-vv", upwards]
    return " ".join(w if isinstance(w, str) else number(w) for w in words)


def grids_of(project, problem):
    """The grids of the project; `problem` hears a sentence for each that cannot be made."""
    found = []
    for obj in project.Group:
        if walk.kind_of(obj) == "LightwellGrid":
            try:
                found.append(_grid(obj))
            except ValueError as error:
                problem(f"\"{obj.Label}\": {error}.")
    return found


def sky_of(project):
    """The bridge's sky, or None for electric light only."""
    if project.SkyType == ELECTRIC_ONLY:
        return None
    return skies.Sky(project.SkyType, project.Latitude, project.Longitude, project.Time, project.North, project.Turbidity,
                     project.GroundReflectance)


def rules_of(project):
    """(pattern, material) of the layer map.

    @throws ValueError for a line that is no rule
    """
    rules = []
    for line in project.LayerMap:
        pattern, sign, material = (part.strip() for part in line.partition("="))
        if not line.strip():
            continue
        if not (pattern and sign and material):
            raise ValueError(f"layer map: \"{line}\" is no rule; expected PATTERN = MATERIAL, for example A-WALL* = white_paint")
        rules.append((pattern, material))
    return rules


def _grid(obj):
    owner, names = obj.Face if obj.Face else (None, [])
    if owner is None or not names:
        raise ValueError("it lies on no face; choose one")
    shape = owner.Shape.copy()
    shape.Placement = owner.getGlobalPlacement()
    number_of_face = int("".join(c for c in names[0] if c.isdigit()) or 0)
    if not 1 <= number_of_face <= len(shape.Faces):
        raise ValueError(f"\"{owner.Label}\" has no {names[0]} any more; choose another face")
    face = shape.Faces[number_of_face - 1]
    if type(face.Surface).__name__ != "Plane":
        raise ValueError(f"{names[0]} of \"{owner.Label}\" is curved; a grid needs a plane face")
    return grids.on_plane_face(face, obj.Label, obj.Name, float(obj.Spacing.Value), float(obj.Offset.Value))


def _best_face(owner):
    flat = [(i, f) for i, f in enumerate(owner.Shape.Faces, 1) if type(f.Surface).__name__ == "Plane"]
    if not flat:
        raise ValueError(f"\"{owner.Label}\" has no plane face; a grid needs one")
    looks_up = [(i, f) for i, f in flat if f.normalAt(*f.ParameterRange[::2]).z > 0.99]
    return f"Face{max(looks_up or flat, key=lambda pair: pair[1].Area)[0]}"


def _show(obj, icon):
    if obj.ViewObject is not None:
        View(obj.ViewObject, icon_files.icon(icon))
