"""Results on the document: colours on the same objects, grids as points and surfaces, a table, a legend, pictures.

Everything that is made here is in one group below the project, and clear() takes it all away again: colours of the
objects are as they were before. Each call is one step of FreeCAD's undo.
"""

import contextlib
import csv
import json
import math

import FreeCAD
import numpy as np

from lightwell_bridge import false_colour, png, results as numbers

from . import contours, walk

GROUP = "LightwellResults"
MM_PER_M = 1000.0
# The legend stands this share of the model's width beside it.
LEGEND_GAP, LEGEND_SHARE = 0.1, 0.5
# Share of the area within the scale.
SHOWN_AREA = 0.95
# Of the table.
COLUMNS = "ABCDEFGHIJK"
# Surfaces and lines of a grid are drawn this far in front of each other, so that neither hides the other.
LIFT_MM = 2.0


@contextlib.contextmanager
def one_step(document, name):
    """All of it is one step of undo; when it fails nothing of it stays."""
    document.openTransaction(name)
    try:
        yield
    except BaseException:
        document.abortTransaction()
        raise
    document.commitTransaction()


def show(project, exported, objects, grids, folder, notes=()):
    """Shows illuminance: `objects` are ObjectLights whose faces follow those of `exported.objects`, `grids` GridLights.

    @return the group of results
    """
    document = project.Document
    with one_step(document, "Lightwell: show illuminance"):
        _clear(project)
        group = _group(project)
        top = scale_top(objects, grids, exported)
        for grid in grids:
            _show_grid(group, exported.grids[grid.name], grid, top)
        _table(group, objects, grids, notes)
        _legend(group, document, folder, top)
        # Windows of Arch, and meshes, put their own colours back when they are recomputed.
        document.recompute()
        _colour_objects(project, exported, objects, top)
        for obj in group.Group:
            if obj.TypeId == "Mesh::Feature":
                _colour_mesh(obj)
        project.purgeTouched()
    return group


def scale_top(objects, grids, exported):
    """A round number that SHOWN_AREA of the area shown does not exceed: lamps and what is close to them go beyond."""
    pairs = [(lux, face.area) for light in objects for lux, face in zip(light.lux(), light.faces)]
    for grid in grids:
        pairs += [(lux, exported.grids[grid.name]["spacing_m"] ** 2) for lux in grid.lux]
    values = np.array([p for p in pairs if math.isfinite(p[0]) and p[1] > 0]).reshape(-1, 2)
    if not len(values):
        return 1.0
    values = values[np.argsort(values[:, 0])]
    covered = np.cumsum(values[:, 1])
    return false_colour.scale_top([values[np.searchsorted(covered, SHOWN_AREA * covered[-1]), 0]])


def show_picture(project, label, file, width_mm):
    """A picture (PNG) as an image object beside the model; keeps what is shown."""
    document = project.Document
    with one_step(document, "Lightwell: show picture"):
        group = _group(project)
        for old in list(group.Group):
            if old.Label == label:
                document.removeObject(old.Name)
        low, high = _bounds(document)
        size = png.size(file)
        place = FreeCAD.Vector((low[0] + high[0]) / 2, high[1] + LEGEND_GAP * (high[1] - low[1]), (low[2] + high[2]) / 2)
        rotation = FreeCAD.Rotation(FreeCAD.Vector(1, 0, 0), 90)
        plane = _image(group, label, file, width_mm, width_mm * size[1] / size[0], place, rotation)
    document.recompute()
    return plane


def shown(project):
    """Whether there are results to remove."""
    return bool(project.SavedColours) or _existing_group(project) is not None


def clear(project):
    """Removes all results; colours are as they were before the first were shown."""
    with one_step(project.Document, "Lightwell: remove results"):
        _clear(project)
    project.Document.recompute()


def _clear(project):
    document = project.Document
    saved = json.loads(project.SavedColours or "{}")
    for name, look in saved.items():
        obj = document.getObject(name)
        if obj is not None:
            _restore(obj, look)
    if saved:
        project.SavedColours = ""
    group = _existing_group(project)
    if group is not None:
        for obj in list(group.Group):
            document.removeObject(obj.Name)
        document.removeObject(group.Name)


# --- colours on objects

def _colour_objects(project, exported, objects, top):
    by_owner = {}
    for light in objects:
        record = exported.objects[light.source]
        by_owner.setdefault(record["owner"], []).append((record, light))
    saved = {}
    for name, pairs in by_owner.items():
        obj = project.Document.getObject(name)
        if obj is not None and obj.ViewObject is not None:
            saved[name] = _paint(obj, pairs, top)
    project.SavedColours = json.dumps(saved)


def _paint(obj, pairs, top):
    """Colours one object; returns what it looked like."""
    view = obj.ViewObject
    if obj.isDerivedFrom("Mesh::Feature"):
        # Every triangle of a mesh has the value of the mesh's map at it, in the order of the triangles.
        colours = _colours(pairs[0][1].lux(), top)
        look = {"kind": "mesh", "coloring": bool(view.Coloring)}
        if "FaceColors" not in obj.PropertiesList:
            obj.addProperty("App::PropertyColorList", "FaceColors", "Lightwell", "Illuminance as colours")
            look["added"] = True
        else:
            look["colours"] = [list(c) for c in obj.FaceColors]
        obj.FaceColors = [(*c, 0.0) for c in colours]
        _colour_mesh(obj)
        return look
    if obj.hasExtension("App::LinkBaseExtension"):
        look = {"kind": "link", "colours": {k: list(c) for k, c in view.getElementColors().items()}}
        wanted = {}
        for record, light in pairs:
            for face, colour in zip(record["faces"], _colours(light.lux(), top)):
                wanted[f"{record['subname']}Face{face['face'] + 1}"] = (*colour, 0.0)
        view.setElementColors(wanted)
        return look
    look = {"kind": "shape", "colours": [list(c) for c in view.DiffuseColor]}
    before = view.DiffuseColor if len(view.DiffuseColor) == len(obj.Shape.Faces) else [view.DiffuseColor[0]] * len(obj.Shape.Faces)
    after = [tuple(c) for c in before]
    for record, light in pairs:
        for face, colour in zip(record["faces"], _colours(light.lux(), top)):
            after[face["face"]] = (*colour, before[face["face"]][3])
    _set_colours(view, after)
    return look


def _set_colours(view, colours):
    """Windows of Arch would put the colours of their parts back at once: they are asked not to while this is done."""
    proxy = getattr(view, "Proxy", None)
    guarded = hasattr(type(proxy), "colorize")
    if guarded:
        proxy.colorize = lambda *_, **__: None
    try:
        view.DiffuseColor = colours
    finally:
        if guarded:
            del proxy.colorize


def _colour_mesh(obj):
    """Shows the colours of a mesh's triangles, also when they were shown before."""
    if obj.ViewObject is not None:
        obj.ViewObject.Coloring = False
        obj.ViewObject.Coloring = True


def _restore(obj, look):
    view = obj.ViewObject
    if view is None:
        return
    if look["kind"] == "shape":
        _set_colours(view, [tuple(c) for c in look["colours"]])
    elif look["kind"] == "link":
        view.setElementColors({k: tuple(c) for k, c in look["colours"].items()})
    else:
        view.Coloring = look["coloring"]
        if look.get("added"):
            obj.removeProperty("FaceColors")
        else:
            obj.FaceColors = [tuple(c) for c in look["colours"]]


def _colours(lux, top):
    """sRGB of each value; grey where there is none."""
    lux = np.asarray(lux, dtype=float)
    rgb = false_colour.encoded(false_colour.linear_colours(lux / top))
    rgb[~np.isfinite(lux)] = 0.5
    return [tuple(float(c) for c in row) for row in rgb]


# --- grids

def _show_grid(group, facts, grid, top):
    """Points with their values, a coloured surface of one square a sensor, and lines of equal illuminance."""
    lux = np.asarray(grid.lux, dtype=float)
    places = np.array(facts["sensors"]).reshape(-1, 3) * MM_PER_M
    _points(group, grid, places, lux, top)
    if facts["rows"] * facts["columns"] == 0:
        return
    cells = np.array(facts["cells"]).reshape(facts["rows"], facts["columns"])
    spread = np.where(cells >= 0, lux[np.maximum(cells, 0)], np.nan)
    origin, along, down = (np.array(facts[k]) for k in ("origin", "along", "down"))
    frame = (origin * MM_PER_M - np.cross(along, down) * LIFT_MM, along, down)
    spacing = facts["spacing_m"] * MM_PER_M
    _surface(group, grid, spread, frame, spacing, top)
    _contours(group, grid, spread, frame, spacing)


def _points(group, grid, places, lux, top):
    import Points
    obj = _result(group, "Points::Feature", f"Sensors of {grid.name}")
    cloud = Points.Points()
    cloud.addPoints([FreeCAD.Vector(*p) for p in places])
    obj.Points = cloud
    for kind, name, tip, values in (("App::PropertyFloatList", "Illuminance", "lx at each point", [float(v) for v in lux]),
                                    ("App::PropertyFloatList", "Error", "One standard error, lx", [float(v) for v in grid.error]),
                                    ("App::PropertyColorList", "Color", "Illuminance as colours", [(*c, 0.0) for c in _colours(lux, top)])):
        obj.addProperty(kind, name, "Lightwell", tip)
        setattr(obj, name, values)
    if obj.ViewObject is not None:
        obj.ViewObject.DisplayMode, obj.ViewObject.PointSize = "Color", 5


def _surface(group, grid, spread, frame, spacing, top):
    import Mesh
    origin, along, down = frame
    triangles, colours = [], []
    for (row, column), value in np.ndenumerate(spread):
        if math.isfinite(value):
            a, b, c, d = (FreeCAD.Vector(*(origin + along * spacing * (column + x) + down * spacing * (row + y)))
                          for x, y in ((0, 1), (1, 1), (1, 0), (0, 0)))
            triangles += [a, b, c, a, c, d]
            colours += [(*_colours([value], top)[0], 0.0)] * 2
    obj = _result(group, "Mesh::Feature", f"Illuminance of {grid.name}")
    obj.Mesh = Mesh.Mesh([triangles[i:i + 3] for i in range(0, len(triangles), 3)])
    obj.addProperty("App::PropertyColorList", "FaceColors", "Lightwell", "Illuminance as colours")
    obj.FaceColors = colours
    if obj.ViewObject is not None:
        obj.ViewObject.Lighting = "Two side"


def _contours(group, grid, spread, frame, spacing):
    import Part
    origin, along, down = frame
    normal = -np.cross(along, down)
    edges, colours = [], []
    for level in false_colour.steps(false_colour.scale_top(grid.lux))[1:]:
        for a, b in contours.lines(spread, level):
            ends = [FreeCAD.Vector(*(origin + along * spacing * (c + 0.5) + down * spacing * (r + 0.5) + normal * LIFT_MM))
                    for r, c in (a, b)]
            if (ends[0] - ends[1]).Length > 1e-6:
                edges.append(Part.makeLine(*ends))
                colours.append(level)
    if not edges:
        return
    obj = _result(group, "Part::Feature", f"Lines of equal illuminance of {grid.name}")
    obj.Shape = Part.makeCompound(edges)
    obj.addProperty("App::PropertyFloatList", "Levels", "Lightwell", "lx of each edge")
    obj.Levels = colours
    if obj.ViewObject is not None:
        obj.ViewObject.LineColor, obj.ViewObject.LineWidth = (0.1, 0.1, 0.1), 2


# --- table, legend, pictures

def _table(group, objects, grids, notes):
    sheet = _result(group, "Spreadsheet::Sheet", "Illuminance")
    rows = list(csv.reader(numbers.table(objects, grids).splitlines()))
    rows += [[]] + [["note", note] for note in notes]
    for row, cells in enumerate(rows, 1):
        for column, text in enumerate(cells):
            if text:
                sheet.set(f"{COLUMNS[column]}{row}", _cell(text))
    sheet.setColumnWidth("B", 280)
    sheet.setStyle(f"A1:{COLUMNS[-1]}1", "bold", "add")


def _cell(text):
    """Numbers rounded to what their error makes meaningful to read; text as text."""
    try:
        return f"{float(text):.6g}"
    except ValueError:
        return "'" + text


def _legend(group, document, folder, top):
    picture = false_colour.legend(top)
    file = folder / "legend.png"
    file.write_bytes(png.encode(picture[:, :, :3]))
    low, high = _bounds(document)
    tall = LEGEND_SHARE * max(high[:2] - low[:2])
    wide = tall * picture.shape[1] / picture.shape[0]
    rotation = _to_the_eye()
    right = np.array(rotation.multVec(FreeCAD.Vector(1, 0, 0)))
    reach = float(np.abs(right) @ (high - low)) / 2 + LEGEND_GAP * tall + wide / 2
    place = FreeCAD.Vector(*((low + high) / 2 + reach * right))
    _image(group, "Legend (lx)", str(file), wide, tall, place, rotation)


def _to_the_eye():
    """Turns a picture so that the 3D window sees it straight on; without a window it stands upright and faces the front."""
    if FreeCAD.GuiUp:
        import FreeCADGui
        view = getattr(FreeCADGui.ActiveDocument, "ActiveView", None)
        if hasattr(view, "getCameraOrientation"):
            return view.getCameraOrientation()
    return FreeCAD.Rotation(FreeCAD.Vector(1, 0, 0), 90)


def _image(group, label, file, width_mm, height_mm, place, rotation):
    obj = _result(group, "Image::ImagePlane", label)
    obj.ImageFile = str(file)
    obj.XSize, obj.YSize = width_mm, height_mm
    obj.Placement = FreeCAD.Placement(place, rotation)
    return obj


def _existing_group(project):
    return next((o for o in project.Group if getattr(o, "LightwellRole", "") == "result"), None)


def _group(project):
    group = _existing_group(project)
    if group is None:
        group = project.Document.addObject("App::DocumentObjectGroup", GROUP)
        group.Label = "Results"
        _mark(group)
        project.addObject(group)
    return group


def _result(group, kind, label):
    obj = group.Document.addObject(kind, "LightwellResult")
    obj.Label = label
    _mark(obj)
    group.addObject(obj)
    return obj


def _mark(obj):
    obj.addProperty("App::PropertyString", "LightwellRole", "Lightwell", "Made by a simulation; no part of the model", 4)
    obj.LightwellRole = "result"


def _bounds(document):
    """Corners of everything that is in the model, mm."""
    boxes = []
    for one in walk.placed_objects(document):
        box = one.leaf.Mesh.BoundBox if one.is_mesh() else one.owner.Shape.BoundBox if hasattr(one.owner, "Shape") else None
        if box is not None and box.isValid():
            boxes.append(box)
    if not boxes:
        return np.zeros(3), np.full(3, 1000.0)
    return (np.array([min(getattr(b, k) for b in boxes) for k in ("XMin", "YMin", "ZMin")]),
            np.array([max(getattr(b, k) for b in boxes) for k in ("XMax", "YMax", "ZMax")]))
