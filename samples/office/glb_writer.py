"""Writes the drawing as binary glTF: metres, y up, float32; blocks are meshes shared by nested nodes."""
import json
import math
import struct
from layers import EMITTING_LAYERS, GLASS_LAYERS, LAYERS
from shapes import Insert, Note, Placement, area_vector, cross, dot, polygon_area, sub
from truth import Extent, MM2

ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER, FLOAT, UNSIGNED_SHORT = 34962, 34963, 5126, 5123


def to_float32(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


def in_file(point):
    """Millimetres, z up, to what the file holds: metres, y up, float32."""
    return tuple(to_float32(v) for v in (point[0] / 1000, point[2] / 1000, -point[1] / 1000))


def from_file(point):
    return (point[0] * 1000, -point[2] * 1000, point[1] * 1000)


def triangulated(corners):
    """Triangles of a plane polygon without holes, concave allowed: ears are cut off one after the other."""
    normal = area_vector(corners)
    rest, triangles = list(corners), []

    def turns_left(a, b, c):
        return dot(cross(sub(b, a), sub(c, b)), normal) > 0

    def is_ear(i):
        a, b, c = rest[i - 1], rest[i], rest[(i + 1) % len(rest)]
        if not turns_left(a, b, c):
            return False
        return not any(turns_left(a, b, p) and turns_left(b, c, p) and turns_left(c, a, p)
                       for p in rest if p not in (a, b, c))

    while len(rest) > 3:
        ear = next(i for i in range(1, len(rest) + 1) if is_ear(i % len(rest))) % len(rest)
        triangles.append((rest[ear - 1], rest[ear], rest[(ear + 1) % len(rest)]))
        del rest[ear]
    return triangles + [tuple(rest)]


class Glb:
    """Collects meshes, nodes and the buffer."""

    def __init__(self):
        self.nodes, self.meshes, self.materials, self.accessors, self.views = [], [], [], [], []
        self.buffer = bytearray()
        self.mesh_numbers, self.material_numbers, self.geometry = {}, {}, {}
        self.layers, self.extent = {}, Extent()

    def add_view(self, data, target):
        while len(self.buffer) % 4:
            self.buffer.append(0)
        self.views.append({"buffer": 0, "byteOffset": len(self.buffer), "byteLength": len(data), "target": target})
        self.buffer += data
        return len(self.views) - 1

    def shape_of(self, block, own_layer):
        """Points, indices and accessors of one layer of a block; shared by all meshes that show it."""
        key = (block.name, own_layer)
        if key in self.geometry:
            return self.geometry[key]
        numbers, indices = {}, []
        for record in block.records:
            if isinstance(record, (Insert, Note)) or record.layer != own_layer:
                continue
            for facet in record.facets():
                for triangle in triangulated(facet):
                    indices.extend(numbers.setdefault(in_file(p), len(numbers)) for p in triangle)
        points = list(numbers)
        flat = struct.pack("<%df" % (3 * len(points)), *(v for p in points for v in p))
        position = {"bufferView": self.add_view(flat, ARRAY_BUFFER), "componentType": FLOAT,
                    "count": len(points), "type": "VEC3", "min": [min(p[i] for p in points) for i in range(3)],
                    "max": [max(p[i] for p in points) for i in range(3)]}
        index = {"bufferView": self.add_view(struct.pack("<%dH" % len(indices), *indices), ELEMENT_ARRAY_BUFFER),
                 "componentType": UNSIGNED_SHORT, "count": len(indices), "type": "SCALAR"}
        self.accessors += [position, index]
        self.geometry[key] = (points, indices, len(self.accessors) - 2, len(self.accessors) - 1)
        return self.geometry[key]

    def mesh(self, block, own_layer, layer):
        key = (block.name, own_layer, layer)
        if key not in self.mesh_numbers:
            _, _, position, index = self.shape_of(block, own_layer)
            self.meshes.append({"name": "%s %s" % (block.name, layer), "primitives": [
                {"attributes": {"POSITION": position}, "indices": index, "material": self.material(layer)}]})
            self.mesh_numbers[key] = len(self.meshes) - 1
        return self.mesh_numbers[key]

    def material(self, layer):
        name, colour = LAYERS[layer][2], LAYERS[layer][1]
        if name not in self.material_numbers:
            material = {"name": name, "doubleSided": True, "pbrMetallicRoughness": {
                "baseColorFactor": [*colour, 1], "metallicFactor": 0, "roughnessFactor": 1}}
            if layer in GLASS_LAYERS:
                material["extensions"] = {"KHR_materials_transmission": {"transmissionFactor": 1}}
                material["pbrMetallicRoughness"]["roughnessFactor"] = 0
            if layer in EMITTING_LAYERS:
                material["emissiveFactor"] = [1, 1, 1]
            self.materials.append(material)
            self.material_numbers[name] = len(self.materials) - 1
        return self.material_numbers[name]

    def add_node(self, node):
        self.nodes.append(node)
        return len(self.nodes) - 1

    def add_block(self, block, place, inherited):
        """@return  numbers of the nodes that show the block"""
        children = []
        own_layers = dict.fromkeys(r.layer for r in block.records if not isinstance(r, (Insert, Note)))
        for own_layer in own_layers:
            layer = inherited if own_layer == "0" else own_layer
            children.append(self.add_node({"name": layer, "mesh": self.mesh(block, own_layer, layer),
                                           "extras": {"layer": layer}}))
            self.measure(block, own_layer, layer, place)
        for record in block.records:
            if isinstance(record, Insert):
                layer = inherited if record.layer == "0" else record.layer
                below = self.add_block(record.block, place.after(record.placement()), layer)
                children.append(self.add_node({"name": record.block.name, "children": below,
                                               "extras": {"layer": layer}, **movement(record)}))
        return children

    def measure(self, block, own_layer, layer, place):
        points, indices, _, _ = self.shape_of(block, own_layer)
        entry = self.layers.setdefault(layer, {"surfaces": 0, "triangles": 0, "areas": [], "exact": [], "error": 0.0})
        world = [place.point(from_file(p)) for p in points]
        for p in world:
            self.extent.include(p)
        entry["surfaces"] += 1
        entry["triangles"] += len(indices) // 3
        entry["areas"] += [polygon_area([world[i] for i in indices[k:k + 3]]) * MM2 for k in range(0, len(indices), 3)]
        for record in block.records:
            if not isinstance(record, (Insert, Note)) and record.layer == own_layer:
                entry["exact"] += [area * MM2 for area in record.surfaces(place)]
                entry["error"] = max(entry["error"], record.facet_error / 1000)


def movement(record):
    x, y, z = record.at
    node = {"translation": [x / 1000, z / 1000, -y / 1000]}
    if record.turn_deg:
        half = math.radians(record.turn_deg) / 2
        node["rotation"] = [0, math.sin(half), 0, math.cos(half)]
    if record.scale != (1, 1, 1):
        node["scale"] = [record.scale[0], record.scale[2], record.scale[1]]
    return node


def chunk(kind, data, filler):
    data += filler * (-len(data) % 4)
    return struct.pack("<I4s", len(data), kind) + data


def write_glb(model, file):
    """@return  the truth about the file, measured on the float32 points"""
    glb = Glb()
    top = glb.add_block(model, Placement(), "0")
    root = glb.add_node({"name": "office", "children": top})
    text = json.dumps({
        "asset": {"version": "2.0", "generator": "draw_office.py"},
        "extensionsUsed": ["KHR_materials_transmission"],
        "scene": 0, "scenes": [{"nodes": [root]}], "nodes": glb.nodes, "meshes": glb.meshes,
        "materials": glb.materials, "accessors": glb.accessors, "bufferViews": glb.views,
        "buffers": [{"byteLength": len(glb.buffer)}]}, separators=(",", ":"))
    body = chunk(b"JSON", text.encode("ascii"), b" ") + chunk(b"BIN\0", bytes(glb.buffer), b"\0")
    file.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body)
    return glb_truth(file.name, glb)


def glb_truth(name, glb):
    layers = {}
    for layer, entry in sorted(glb.layers.items()):
        layers[layer] = {"surfaces": entry["surfaces"], "triangles": entry["triangles"],
                         "area_m2": math.fsum(entry["areas"]), "area_relative_tolerance": 1e-5,
                         "exact_area_m2": math.fsum(entry["exact"]), "facet_error_m": entry["error"],
                         "material": LAYERS[layer][2]}
    return {
        "file": name,
        "unit": "m",
        "up": "y",
        "conventions": {"surface": "1 per primitive of a mesh, nodes expanded", "layer": "extras.layer of the node"},
        "surfaces": sum(entry["surfaces"] for entry in layers.values()),
        "triangles": sum(entry["triangles"] for entry in layers.values()),
        "area_m2": math.fsum(entry["area_m2"] for entry in layers.values()),
        "bounds_m": glb.extent.in_metres(),
        "bounds_frame": "z up, as after import",
        "layers": layers,
        "entities": {"nodes": len(glb.nodes), "meshes": len(glb.meshes), "materials": len(glb.materials),
                     "accessors": len(glb.accessors)},
        "skipped": {},
    }
