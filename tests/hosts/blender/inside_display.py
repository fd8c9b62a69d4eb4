"""Puts made-up values onto the objects of the office, looks at them, and takes them away again."""

import os
import sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bpy
from inside import PATH, addon, answer, export, fingerprint

show_results, results = addon("show_results"), addon("lightwell_bridge.results")
scene = bpy.context.scene
# One object with a material of its own on its slot, which must come back too.
door = bpy.data.objects["Door leaf"]
door.material_slots[0].link = "OBJECT"
door.material_slots[0].material = bpy.data.materials["Steel chrome"]
bpy.context.view_layer.update()
before = fingerprint()
exported = export()
display = show_results.Display(scene, 500.0)
shown = {}
for i, (source, part) in enumerate(exported.parts.items()):
    obj = bpy.data.objects[part.object_name]
    values = np.linspace(10 * i, 10 * i + 5, len(part.mesh.sizes))
    shown[part.object_name] = [bool(part.original_faces and display.show_object(obj, values)), values[0], values[-1]]
grid = exported.grids[0]
display.show_grid(grid, np.linspace(0, 500, len(grid.sensors)))
display.finish("numbers in lx\n", "kind,name\n")


def seen(name):
    mesh = bpy.data.objects[name].data
    values = np.zeros(len(mesh.polygons), dtype=np.float32)
    mesh.attributes["illuminance_lx"].data.foreach_get("value", values)
    return [float(values[0]), float(values[-1]), mesh.color_attributes.active_color.name,
            [m.name for m in mesh.materials], [s.material.name for s in bpy.data.objects[name].material_slots]]


values = {name: seen(name) for name in shown if shown[name][0]}
bpy.ops.wm.save_as_mainfile(filepath=str(PATH / "shown.blend"))
bpy.ops.wm.open_mainfile(filepath=str(PATH / "shown.blend"))
scene = bpy.context.scene
kept = seen("Bürostuhl 02")
legend = bpy.data.images["Lightwell legend"]
pixels = np.array(legend.pixels[:]).reshape(legend.size[1], legend.size[0], 4)
grid_object = bpy.data.objects["Floor (lx)"]
report = {"shown": shown, "values": values, "kept": kept, "legend": list(legend.size), "bright": float(pixels[:, :, :3].max()),
          "grid_faces": len(grid_object.data.polygons), "grid_area": sum(p.area for p in grid_object.data.polygons),
          "grid_normal": grid_object.data.polygons[0].normal[2], "texts": sorted(t.name for t in bpy.data.texts)}
bpy.ops.lightwell.export_table(filepath=str(PATH / "table.csv"))
report["table"] = (PATH / "table.csv").read_text()
bpy.ops.lightwell.clear()
bpy.context.view_layer.update()
after = fingerprint()
report["same"] = before == after
report["before"], report["after"] = before, after
report["again"] = show_results.clear(scene)
answer(**report)
