"""Buttons that are done at once: the engine's version, layer maps, results away, files out."""

import pathlib

import bpy
from bpy.props import StringProperty

from . import library_materials, session, show_results
from .exporter import Exporter
from .lightwell_bridge import layer_map
from .lightwell_bridge.engine import version_of
from .scene_walk import GEOMETRY, Collections, drawn_objects


class _Operator(bpy.types.Operator):
    """Ends in a sentence whatever happens."""

    def execute(self, context):
        try:
            self.report({"INFO"}, f"Lightwell: {self.work(context)}")
            return {"FINISHED"}
        except (session.EngineError, ValueError, OSError, UnicodeError) as error:
            self.report({"ERROR"}, f"Lightwell: {error}")
            return {"CANCELLED"}


class LIGHTWELL_OT_check_engine(_Operator):
    """Look for the Lightwell engine and say which one was found, or where it was looked for"""
    bl_idname, bl_label = "lightwell.check_engine", "Test"

    def work(self, context):
        path = session.engine_path()
        version = version_of(path)
        return f"{version} at {path}, {len(library_materials.known(path))} materials"


class LIGHTWELL_OT_clear(_Operator):
    """Take the results away: every object gets its own mesh and materials back, and what was made is removed"""
    bl_idname, bl_label, bl_options = "lightwell.clear", "Remove results", {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return show_results.shown(context.scene)

    def work(self, context):
        return f"{show_results.clear(context.scene)} objects are as they were"


class LIGHTWELL_OT_propose(_Operator):
    """Choose a Lightwell material by name for each collection that has none, as the engine proposes it for drawings"""
    bl_idname, bl_label, bl_options = "lightwell.propose", "Propose materials", {"REGISTER", "UNDO"}

    def work(self, context):
        paths = Collections(context.scene).paths
        free = {path: name for name, path in paths.items() if not bpy.data.collections[name].lightwell.use}
        found = layer_map.propose(session.engine_path(), list(free))
        for path, use in found.items():
            bpy.data.collections[free[path]].lightwell.use = use
        return f"{len(found)} of {len(free)} collections without a material got one by their name; please check them"


class LIGHTWELL_OT_clear_map(_Operator):
    """Forget the Lightwell materials of collections: the objects' own materials count again"""
    bl_idname, bl_label, bl_options = "lightwell.clear_map", "Forget", {"REGISTER", "UNDO"}

    def work(self, context):
        chosen = [c for c in bpy.data.collections if c.lightwell.use]
        for collection in chosen:
            collection.lightwell.use = ""
        return f"{len(chosen)} collections have no Lightwell material any more"


class LIGHTWELL_OT_save_map(_Operator):
    """Write which Lightwell materials were chosen for collections, materials and objects as JSON"""
    bl_idname, bl_label = "lightwell.save_map", "Save map"
    filepath: StringProperty(subtype="FILE_PATH", default="lightwell_map.json")

    def invoke(self, context, event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def work(self, context):
        rules = {kind: {block.name: block.lightwell.use for block in blocks if block.lightwell.use}
                 for kind, blocks in _blocks().items()}
        pathlib.Path(bpy.path.abspath(self.filepath)).write_text(layer_map.to_json(rules), encoding="utf-8")
        return f"{sum(map(len, rules.values()))} choices in {self.filepath}"


class LIGHTWELL_OT_load_map(_Operator):
    """Read choices of Lightwell materials from JSON; names that this file does not have are counted"""
    bl_idname, bl_label, bl_options = "lightwell.load_map", "Load map", {"REGISTER", "UNDO"}
    filepath: StringProperty(subtype="FILE_PATH")

    def invoke(self, context, event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def work(self, context):
        rules = layer_map.from_json(pathlib.Path(bpy.path.abspath(self.filepath)).read_text(encoding="utf-8"))
        set_ones, unknown = 0, []
        for kind, blocks in _blocks().items():
            for name, use in rules[kind].items():
                block = blocks.get(name)
                if block is None:
                    unknown.append(name)
                else:
                    block.lightwell.use = use
                    set_ones += 1
        return f"{set_ones} choices taken over" + (f"; not in this file: {', '.join(unknown[:5])}" if unknown else "")


class LIGHTWELL_OT_export_table(_Operator):
    """Write means, minima, maxima and uniformity of objects, layers and grids as CSV"""
    bl_idname, bl_label = "lightwell.export_table", "Export CSV"
    filepath: StringProperty(subtype="FILE_PATH", default="lightwell.csv")

    @classmethod
    def poll(cls, context):
        return show_results.TABLE in bpy.data.texts

    def invoke(self, context, event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def work(self, context):
        text = bpy.data.texts[show_results.TABLE].as_string()
        pathlib.Path(bpy.path.abspath(self.filepath)).write_text(text, encoding="utf-8")
        return f"{text.count(chr(10)) - 1} rows in {self.filepath}"


class LIGHTWELL_OT_export_scene(_Operator):
    """Write the scene folder that the engine reads, for the command line: scene.rad, parts/ and textures/"""
    bl_idname, bl_label = "lightwell.export_scene", "Export scene"
    directory: StringProperty(subtype="DIR_PATH")

    def invoke(self, context, event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def work(self, context):
        if not self.directory:
            raise ValueError("no folder was chosen")
        library_materials.known(session.engine_path())
        render = context.scene.render
        exported = Exporter(context.evaluated_depsgraph_get(), bpy.path.abspath(self.directory),
                            (render.resolution_x, render.resolution_y)).export()
        for note in exported.notes:
            print(f"Lightwell: {note}")
        return f"{exported.scene_file}: {len(exported.parts)} objects, {len(exported.lamps)} lamps, " \
               f"{len(exported.notes)} notes in the console"


class LIGHTWELL_OT_count_layers(_Operator):
    """Count again what each collection holds as it is drawn in renders"""
    bl_idname, bl_label = "lightwell.count_layers", "Count"

    def work(self, context):
        counts = {}
        for drawn in drawn_objects(context.evaluated_depsgraph_get(), GEOMETRY):
            faces = len(drawn.original.data.polygons) if drawn.original.type == "MESH" else 0
            entry = counts.setdefault(drawn.layer, [0, 0])
            entry[0], entry[1] = entry[0] + 1, entry[1] + faces
        for name, path in Collections(context.scene).paths.items():
            settings = bpy.data.collections[name].lightwell
            settings.objects, settings.faces = counts.get(path, (0, 0))
        return f"{sum(c[0] for c in counts.values())} objects on {len(counts)} layers"


def _blocks():
    return {"collections": bpy.data.collections, "materials": bpy.data.materials, "objects": bpy.data.objects}


CLASSES = (LIGHTWELL_OT_check_engine, LIGHTWELL_OT_clear, LIGHTWELL_OT_propose, LIGHTWELL_OT_clear_map, LIGHTWELL_OT_save_map,
           LIGHTWELL_OT_load_map, LIGHTWELL_OT_export_table, LIGHTWELL_OT_export_scene, LIGHTWELL_OT_count_layers)
register, unregister = bpy.utils.register_classes_factory(CLASSES)
