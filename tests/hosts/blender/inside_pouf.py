"""The subdivided pouf alone: Blender's own mesh at level 6 as coordinates, and the scene folder with its cage."""

import os
import sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bpy
from inside import PATH, answer, export

for obj in list(bpy.data.objects):
    if obj.type not in ("CAMERA",) and obj.name != "Pouf (subdivision)":
        bpy.data.objects.remove(obj)
scene, pouf = bpy.context.scene, bpy.data.objects["Pouf (subdivision)"]
scene.render.engine = "LIGHTWELL"
world = scene.world
world.use_nodes, world.color = False, (1, 1, 1)
creases = {}
for crease in (0.35, 0.7):
    for edge in pouf.data.edges:
        if all(pouf.data.vertices[v].co.z > 0.4 for v in edge.vertices):
            edge.crease = crease
    pouf.modifiers[0].levels = pouf.modifiers[0].render_levels = 6
    exported = export(folder=f"pouf{crease}")
    mesh = pouf.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    points = np.zeros(len(mesh.vertices) * 3, dtype=np.float32)
    mesh.vertices.foreach_get("co", points)
    points = points.reshape(-1, 3) + np.array(pouf.matrix_world)[:3, 3]
    faces = np.zeros(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", faces)
    np.savez(PATH / f"pouf{crease}.npz", points=points, faces=faces.reshape(-1, 4))
    creases[crease] = str(exported.scene_file)
answer(creases=creases)
