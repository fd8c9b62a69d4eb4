"""The commands of the workbench. Each ends in a result or a sentence."""

import math

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from . import icon_files, project as projects, results, run, walk


class Command:
    """One button: `icon`, `text`, `tip`; do(document) is called, a ValueError or Failed becomes a message."""

    icon = text = tip = ""
    needs_document = True

    def GetResources(self):
        return {"Pixmap": icon_files.icon(self.icon), "MenuText": self.text, "ToolTip": self.tip}

    def IsActive(self):
        return FreeCAD.ActiveDocument is not None or not self.needs_document

    def Activated(self, *_):
        try:
            self.do(FreeCAD.ActiveDocument)
        except (run.Failed, ValueError, OSError) as error:
            tell(str(error))

    def do(self, document):
        raise NotImplementedError


class MakeProject(Command):
    icon, text = "project", "Project"
    tip = ("Adds the lighting project to the tree: sky, layer map, accuracy. Place and north come from the site of the "
           "document; all values are properties that can be edited below the tree")

    def do(self, document):
        with results.one_step(document, "Lightwell: project"):
            project = projects.make(document)
        select(project)


class AddView(Command):
    icon, text = "view", "View from here"
    tip = "Keeps what the 3D window shows now as a view that can be rendered"

    def do(self, document):
        view = FreeCADGui.ActiveDocument.ActiveView
        with results.one_step(document, "Lightwell: view"):
            select(view_from_window(projects.make(document), view))


class AddGrid(Command):
    icon, text = "grid", "Sensor grid"
    tip = "Sensors over the selected plane face, 0.5 m apart. Spacing and height above the face are properties of the grid"

    def do(self, document):
        chosen = [s for s in FreeCADGui.Selection.getSelectionEx(document.Name) if hasattr(s.Object, "Shape")]
        if not chosen:
            raise ValueError("Select a plane face first: a floor, or the top of a table.")
        with results.one_step(document, "Lightwell: sensor grid"):
            project = projects.make(document)
            for selected in chosen:
                faces = [n for n in selected.SubElementNames if n.startswith("Face")] or [None]
                for face in faces:
                    grid = projects.add_grid(project, selected.Object, face)
        document.recompute()
        select(grid)


class MakeLuminaire(Command):
    icon, text = "luminaire", "Luminaire"
    tip = ("Makes the selected objects shine: all their fronts, evenly, or as an IES file has it. Lumens, colour temperature "
           "and the file are properties of the object in the group Lightwell")

    def do(self, document):
        chosen = FreeCADGui.Selection.getSelection(document.Name)
        if not chosen:
            raise ValueError("Select the objects that shine first.")
        with results.one_step(document, "Lightwell: luminaire"):
            for obj in chosen:
                projects.make_luminaire(obj)
        select(chosen[0])


class EditLayers(Command):
    icon, text = "layers", "Layer map"
    tip = ("What each layer, material and face colour is made of: names of the engine's materials, with proposals, faces "
           "and areas")

    def do(self, document):
        from .layer_panel import LayerPanel
        FreeCADGui.Control.showDialog(LayerPanel(projects.make(document)))


class Illuminate(Command):
    icon, text = "illuminance", "Illuminance"
    tip = "Illuminance of the sensor grids and of every face, as colours on the same objects, with a table and a legend in lx"

    def do(self, document):
        start(projects.make(document), [run.OBJECTS, run.ILLUMINANCE], "Illuminance")


class Render(Command):
    icon, text = "render", "Render views"
    tip = "Renders each view of the project, or the selected ones; the pictures stand beside the model"

    def do(self, document):
        project = projects.find(document)
        views = [o for o in FreeCADGui.Selection.getSelection(document.Name) if walk.kind_of(o) == "LightwellView"]
        names = [o.Label for o in views] or [name for name, _ in (projects.views_of(project) if project else [])]
        if not names:
            raise ValueError("There is no view yet: turn the 3D window to what you want to see and choose View from here.")
        start(project, names, "Render")


class RemoveResults(Command):
    icon, text = "restore", "Remove results"
    tip = "Takes colours, grids, tables and pictures away: the document is as it was"

    def do(self, document):
        project = projects.find(document)
        if project is None or not results.shown(project):
            raise ValueError("There are no results to remove.")
        results.clear(project)


class Settings(Command):
    icon, text, needs_document = "settings", "Engine", False
    tip = "Where the program lightwell is; shows which one is used and its version"

    def do(self, document):
        from lightwell_bridge.engine import EngineError, version_of
        parameters = FreeCAD.ParamGet(run.PREFERENCES)
        path, good = QtGui.QInputDialog.getText(
            FreeCADGui.getMainWindow(), "Lightwell engine",
            "Path of the program lightwell (empty: LIGHTWELL_ENGINE, beside the workbench, PATH):",
            QtGui.QLineEdit.Normal, parameters.GetString("Engine", ""))
        if not good:
            return
        parameters.SetString("Engine", path.strip())
        program = run.program_of()
        try:
            tell(f"{program} is {version_of(program)}.")
        except EngineError as error:
            raise ValueError(str(error)) from error


COMMANDS = {"Lightwell_Project": MakeProject, "Lightwell_View": AddView, "Lightwell_Grid": AddGrid,
            "Lightwell_Luminaire": MakeLuminaire, "Lightwell_Layers": EditLayers, "Lightwell_Illuminance": Illuminate,
            "Lightwell_Render": Render, "Lightwell_Remove": RemoveResults, "Lightwell_Settings": Settings}


def register():
    """Makes the commands known to FreeCAD; returns their names in order."""
    for name, command in COMMANDS.items():
        FreeCADGui.addCommand(name, command())
    return list(COMMANDS)


def start(project, wishes, title):
    """Runs a job in a task panel."""
    from .job_panel import JobPanel
    FreeCADGui.Control.closeDialog()
    panel = JobPanel(run.Job(project, wishes), title)
    FreeCADGui.Control.showDialog(panel)
    return panel


def view_from_window(project, view):
    """A view of what a 3D window shows."""
    camera = view.getCameraNode()
    direction = view.getViewDirection()
    up = view.getUpDirection() if hasattr(view, "getUpDirection") else FreeCAD.Vector(0, 0, 1)
    position = FreeCAD.Vector(*camera.position.getValue().getValue())
    if view.getCameraType() == "Perspective":
        kind = "perspective"
        aspect = project.Width / project.Height
        angle = math.degrees(2 * math.atan(math.tan(camera.heightAngle.getValue() / 2) * aspect))
    else:
        kind, angle = "parallel", camera.height.getValue() * project.Width / project.Height
    return projects.add_view(project, "View", kind, position, direction, up, angle)


def select(obj):
    FreeCADGui.Selection.clearSelection()
    FreeCADGui.Selection.addSelection(obj)


def tell(sentence):
    """A message, also in the report view."""
    FreeCAD.Console.PrintWarning(f"Lightwell: {sentence}\n")
    if FreeCADGui.getMainWindow() is not None and FreeCADGui.getMainWindow().isVisible():
        box = QtGui.QMessageBox(QtGui.QMessageBox.Information, "Lightwell", sentence, QtGui.QMessageBox.Ok,
                                FreeCADGui.getMainWindow())
        box.setModal(False)
        box.setAttribute(QtCore.Qt.WA_DeleteOnClose)
        box.show()
