"""Files that come with the workbench."""

import pathlib

FOLDER = pathlib.Path(__file__).parent / "icons"


def icon(name):
    """Path of an icon, as FreeCAD wants it."""
    return str(FOLDER / f"{name}.svg")
