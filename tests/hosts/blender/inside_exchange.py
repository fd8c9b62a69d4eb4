"""The office as the add-on writes it, and as Blender's own exporters do: OBJ and GLB, with a side file that says the rest.

For all three the picture on the carpet is its plain colour and the pouf its cage: neither format carries them.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bpy
from inside import PATH, answer, export

carpet = bpy.data.materials["Carpet"].node_tree
base = carpet.nodes["Principled BSDF"].inputs["Base Color"]
carpet.links.remove(base.links[0])
pouf = bpy.data.objects["Pouf (subdivision)"]
pouf.modifiers.clear()
exported = export()
bpy.ops.wm.obj_export(filepath=str(PATH / "office.obj"), export_object_groups=True, export_material_groups=True, forward_axis="Y",
                      up_axis="Z")
bpy.ops.export_scene.gltf(filepath=str(PATH / "office.glb"), export_format="GLB", use_renderable=True, use_visible=True)
answer(scene=str(exported.scene_file), notes=exported.notes)
