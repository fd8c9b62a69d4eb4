"""Lamps with photometric files over a floor, each far from the others; exports them."""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bpy
from inside import WORDS, answer, export

FILE = WORDS[1]
for obj in list(bpy.data.objects):
    bpy.data.objects.remove(obj)
scene = bpy.context.scene
scene.lightwell.sky = "NONE"
bpy.ops.mesh.primitive_plane_add(size=1000)
black = bpy.data.materials.new("Black")
black.use_nodes = True
black.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0, 0, 0, 1)
black.node_tree.nodes["Principled BSDF"].inputs["Specular"].default_value = 0
bpy.context.object.data.materials.append(black)
text = bpy.data.texts.new("inside.ies")
text.write(open(FILE).read())


def lamp(name, x, kind="POINT", watts=1.0, turn=0.0):
    data = bpy.data.lights.new(name, kind)
    data.energy = watts
    obj = bpy.data.objects.new(name, data)
    obj.location, obj.rotation_euler.z = (x, 0, 2), turn
    scene.collection.objects.link(obj)
    return data


def texture(data, mode, strength=1.0, **more):
    data.use_nodes = True
    node = data.node_tree.nodes.new("ShaderNodeTexIES")
    node.mode, node.inputs["Strength"].default_value = mode, strength
    for name, value in more.items():
        setattr(node, name, value)
    data.node_tree.links.new(node.outputs[0], data.node_tree.nodes["Emission"].inputs["Strength"])


texture(lamp("outside", 0), "EXTERNAL", filepath=FILE)
texture(lamp("inside", 30, watts=4.0), "INTERNAL", strength=0.5, ies=text)
chosen = lamp("chosen", 60, "SPOT", watts=100.0, turn=1.5707963267948966)
chosen.lightwell.ies = FILE
dimmed = lamp("dimmed", 90, "AREA")
dimmed.lightwell.ies, dimmed.lightwell.lumens = FILE, 500
lamp("lost", 120).lightwell.ies = "//no such folder/gone.ies"
texture(lamp("without a text", 150), "INTERNAL")
lamp("sunny", 180, "SUN", watts=0).lightwell.ies = FILE
exported = export()
answer(scene=str(exported.scene_file), lamps=exported.lamps, notes=exported.notes)
