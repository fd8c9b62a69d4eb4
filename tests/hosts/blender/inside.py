"""What every script inside Blender begins with: its words, and where its answer goes."""

import json
import pathlib
import sys

import bpy

WORDS = sys.argv[sys.argv.index("--") + 1:]
PATH = pathlib.Path(WORDS[0])


def addon(name):
    """A module of the add-on."""
    import importlib
    return importlib.import_module(f"lightwell.{name}")


def answer(**values):
    (PATH / "answer.json").write_text(json.dumps(values, ensure_ascii=False, default=float))


def export(size=(64, 40), folder="scene"):
    bpy.context.view_layer.update()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return addon("exporter").Exporter(depsgraph, PATH / folder, size).export()
