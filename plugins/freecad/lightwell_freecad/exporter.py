"""File > Export: the visible document as a scene folder. The file that is chosen becomes a folder of its name."""

import pathlib

import FreeCAD

from . import run


def export(objects, filename):
    """What FreeCAD calls. All visible objects are written: light comes from everywhere, not from a selection."""
    target = pathlib.Path(filename)
    document = objects[0].Document if objects else FreeCAD.ActiveDocument
    exported = run.write_scene(document, target.with_suffix(""))
    for note in exported.notes:
        FreeCAD.Console.PrintWarning(f"Lightwell: {note}\n")
    FreeCAD.Console.PrintMessage(f"Lightwell: the scene is {exported.scene}\n")
