"""Illuminance on the very objects, as attributes and colours; and everything undone again.

What is changed is written into the scene under STATE before it is changed. Objects get copies of their meshes, so that
objects that share a mesh show values of their own; the meshes they had are kept with a fake user meanwhile.
"""

import json

import bpy
import numpy as np

from .lightwell_bridge import false_colour

STATE = "lightwell_shown"
NAME = "Lightwell results"
MATERIAL, LEGEND, TEXT, TABLE = "Lightwell false colour", "Lightwell legend", "Lightwell results", "Lightwell results.csv"
VALUE, COLOUR = "illuminance_lx", "illuminance_colour"


def shown(scene):
    return STATE in scene


class Display:
    """show_object() and show_grid() for each, then finish(). `top`: lx at the upper end of the colours."""

    def __init__(self, scene, top):
        clear(scene)
        self.scene, self.top = scene, top
        self.state = {"objects": {}, "made_collection": None}
        self.material = _false_colour_material()

    def show_object(self, obj, lux):
        """One value a face of the object's own mesh: a float attribute, a colour attribute and the material."""
        if obj.type != "MESH" or len(obj.data.polygons) != len(lux) or obj.data.library is not None:
            return False
        if obj.name in self.state["objects"]:
            _colour_mesh(obj.data, np.asarray(lux, dtype=float), self.top)
            return True
        kept = obj.data
        self.state["objects"][obj.name] = {
            "mesh": kept.name, "fake_user": kept.use_fake_user,
            "slots": [[slot.link, slot.material.name if slot.link == "OBJECT" and slot.material else None]
                      for slot in obj.material_slots]}
        self._save()
        kept.use_fake_user = True
        obj.data = kept.copy()
        obj.data.use_fake_user = False
        _colour_mesh(obj.data, np.asarray(lux, dtype=float), self.top)
        if not obj.data.materials:
            obj.data.materials.append(None)
        for i in range(len(obj.data.materials)):
            obj.data.materials[i] = self.material
        for slot in obj.material_slots:
            slot.link = "DATA"
        return True

    def show_grid(self, grid, lux):
        """Cells of a sensor grid as an object of its own."""
        mesh = bpy.data.meshes.new(f"{grid.name} (lx)")
        used = [(i, sensor) for i, sensor in enumerate(grid.cells) if sensor >= 0]
        across = grid.columns + 1
        faces = [[(row := i // grid.columns) * across + (column := i % grid.columns), row * across + column + 1,
                  (row + 1) * across + column + 1, (row + 1) * across + column] for i, _ in used]
        scale = self.scene.unit_settings.scale_length
        corners = sorted({v for face in faces for v in face})
        place = {v: n for n, v in enumerate(corners)}
        mesh.from_pydata((np.asarray(grid.corners)[corners] / scale).tolist(), [], [[place[v] for v in f] for f in faces])
        mesh.materials.append(self.material)
        _colour_mesh(mesh, np.array([lux[sensor] for _, sensor in used], dtype=float), self.top)
        obj = bpy.data.objects.new(f"{grid.name} (lx)", mesh)
        obj.hide_render = True
        self._collection().objects.link(obj)

    def finish(self, report, table):
        """Legend, text and table."""
        _make_legend(self.top)
        for name, text in ((TEXT, report), (TABLE, table)):
            block = bpy.data.texts.get(name) or bpy.data.texts.new(name)
            block.from_string(text)
        self._save()

    def _collection(self):
        collection = bpy.data.collections.get(NAME)
        if collection is None:
            collection = bpy.data.collections.new(NAME)
            self.scene.collection.children.link(collection)
        self.state["made_collection"] = collection.name
        self._save()
        return collection

    def _save(self):
        self.scene[STATE] = json.dumps(self.state)


def clear(scene):
    """Gives every object its own mesh and materials back and removes all that was made; returns how many objects."""
    if STATE not in scene:
        return 0
    state = json.loads(scene[STATE])
    for name, was in state["objects"].items():
        obj, kept = bpy.data.objects.get(name), bpy.data.meshes.get(was["mesh"])
        if obj is None or kept is None:
            continue
        copy = obj.data
        obj.data = kept
        for slot, (link, material) in zip(obj.material_slots, was["slots"]):
            slot.link = link
            if link == "OBJECT":
                slot.material = bpy.data.materials.get(material) if material else None
        if copy is not kept and copy.users == 0:
            bpy.data.meshes.remove(copy)
    for was in reversed(list(state["objects"].values())):
        kept = bpy.data.meshes.get(was["mesh"])
        if kept is not None:
            kept.use_fake_user = was["fake_user"]
    _remove_made(state)
    del scene[STATE]
    return len(state["objects"])


def _remove_made(state):
    collection = bpy.data.collections.get(state["made_collection"] or "")
    if collection is not None:
        for obj in list(collection.objects):
            mesh = obj.data
            bpy.data.objects.remove(obj)
            if mesh.users == 0:
                bpy.data.meshes.remove(mesh)
        bpy.data.collections.remove(collection)
    for blocks, names in ((bpy.data.materials, (MATERIAL,)), (bpy.data.images, (LEGEND,)), (bpy.data.texts, (TEXT, TABLE))):
        for name in names:
            block = blocks.get(name)
            if block is not None:
                blocks.remove(block)


def _colour_mesh(mesh, lux, top):
    """The values on faces, and their colours on corners: they only display the map, means come from the results."""
    values = mesh.attributes.get(VALUE) or mesh.attributes.new(VALUE, "FLOAT", "FACE")
    values.data.foreach_set("value", np.nan_to_num(lux, nan=-1.0).astype(np.float32))
    sizes = np.zeros(len(mesh.polygons), dtype=np.int32)
    mesh.polygons.foreach_get("loop_total", sizes)
    rgba = np.ones((len(lux), 4), dtype=np.float32)
    rgba[:, :3] = false_colour.linear_colours(np.nan_to_num(lux, nan=0.0) / top)
    rgba[~np.isfinite(lux), :3] = 0.18
    colours = mesh.color_attributes.get(COLOUR) or mesh.color_attributes.new(COLOUR, "FLOAT_COLOR", "CORNER")
    colours.data.foreach_set("color", np.repeat(rgba, sizes, axis=0).reshape(-1))
    mesh.color_attributes.active_color = colours
    mesh.update()


def _false_colour_material():
    """The colour attribute as light of its own: it looks the same under every lamp."""
    material = bpy.data.materials.get(MATERIAL) or bpy.data.materials.new(MATERIAL)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    attribute, emission = nodes.new("ShaderNodeAttribute"), nodes.new("ShaderNodeEmission")
    output = nodes.new("ShaderNodeOutputMaterial")
    attribute.attribute_name = COLOUR
    attribute.location, emission.location, output.location = (-400, 0), (-150, 0), (100, 0)
    links.new(attribute.outputs["Color"], emission.inputs["Color"])
    links.new(emission.outputs[0], output.inputs["Surface"])
    return material


def _make_legend(top):
    picture = false_colour.legend(top)[::-1]
    height, width = picture.shape[:2]
    image = bpy.data.images.get(LEGEND)
    if image is not None:
        bpy.data.images.remove(image)
    image = bpy.data.images.new(LEGEND, width, height, alpha=True)
    image.pixels.foreach_set(np.ascontiguousarray(picture, dtype=np.float32).reshape(-1))
    image.update()
    image.pack()
    image.use_fake_user = True
    return image
