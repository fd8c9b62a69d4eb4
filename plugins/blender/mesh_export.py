"""Blender meshes as polygons with all their corners, or as control cages with their creases."""

import numpy as np

from .lightwell_bridge.ply import PlyMesh

# OpenSubdiv's sharpness of a crease is 10 crease^2 (measured: plugins/blender/README.md); 1 is infinitely sharp.
SHARPEST = 10.0


def cage_modifier(obj):
    """The subdivision modifier whose limit surface the object is, or None.

    Only when it is the one modifier that is on for renders, and Blender itself shows the limit surface.
    """
    on = [m for m in obj.modifiers if m.show_render]
    if obj.type != "MESH" or len(on) != 1 or on[0].type != "SUBSURF" or obj.mode == "EDIT":
        return None
    last = on[0]
    usable = last.subdivision_type == "CATMULL_CLARK" and last.use_limit_surface and last.render_levels > 0
    return last if usable and len(obj.data.polygons) else None


def cage_of(obj, modifier, slots):
    """The control cage of `obj` (an original object) as a PlyMesh; `slots` as in polygons_of()."""
    mesh = obj.data
    edges = sharpness = points = point_sharpness = None
    if modifier.use_creases:
        crease = edge_creases(mesh)
        marked = np.flatnonzero(crease > 0)
        if len(marked):
            ends = np.zeros(len(mesh.edges) * 2, dtype=np.int32)
            mesh.edges.foreach_get("vertices", ends)
            edges, sharpness = ends.reshape(-1, 2)[marked], sharpness_of(crease[marked], modifier.quality)
        corner = vertex_creases(mesh)
        marked = np.flatnonzero(corner > 0)
        if len(marked):
            points, point_sharpness = marked, sharpness_of(corner[marked], modifier.quality)
    return polygons_of(mesh, slots, normals=False, edges=edges, edge_sharpness=sharpness, points=points,
                       point_sharpness=point_sharpness,
                       boundary="smooth" if modifier.boundary_smooth == "ALL" else "sharp_corners")


def sharpness_of(crease, quality):
    """What Blender makes of creases from 0 to 1: it stops sharpening after `quality` levels, but 1 stays sharp."""
    return np.where(crease >= 1, SHARPEST, np.minimum(10 * crease.astype(float) ** 2, quality))


def edge_creases(mesh):
    """One number an edge; Blender 4 keeps them as an attribute."""
    values = np.zeros(len(mesh.edges), dtype=np.float32)
    attribute = mesh.attributes.get("crease_edge")
    if attribute is not None:
        attribute.data.foreach_get("value", values)
    elif len(mesh.edges) and hasattr(mesh.edges[0], "crease"):
        mesh.edges.foreach_get("crease", values)
    return values


def vertex_creases(mesh):
    """One number a vertex; Blender 4 keeps them as an attribute."""
    values = np.zeros(len(mesh.vertices), dtype=np.float32)
    attribute = mesh.attributes.get("crease_vert")
    if attribute is not None:
        attribute.data.foreach_get("value", values)
    elif len(getattr(mesh, "vertex_creases", ())):
        mesh.vertex_creases[0].data.foreach_get("value", values)
    return values


def polygons_of(mesh, slots, normals=True, **more):
    """The mesh as it is, in scene units.

    slots    name of the modifier of each material slot, at least one
    normals  whether faces that are shaded smooth get the normals of Blender
    """
    count, corners = len(mesh.polygons), len(mesh.loops)
    sizes, indices = np.zeros(count, dtype=np.int32), np.zeros(corners, dtype=np.int32)
    mesh.polygons.foreach_get("loop_total", sizes)
    mesh.loops.foreach_get("vertex_index", indices)
    points = np.zeros(len(mesh.vertices) * 3, dtype=np.float32)
    mesh.vertices.foreach_get("co", points)
    material = np.zeros(count, dtype=np.int32)
    mesh.polygons.foreach_get("material_index", material)
    if len(slots) > 1:
        more["modifiers"], more["face_modifiers"] = list(slots), np.clip(material, 0, len(slots) - 1)
    if mesh.uv_layers.active is not None:
        uv = np.zeros(corners * 2, dtype=np.float32)
        (mesh.uv_layers.active.data).foreach_get("uv", uv)
        more["uv"] = uv
    if normals and _any_smooth(mesh):
        more["normals"] = _corner_normals(mesh)
    return PlyMesh(points, sizes, indices, **more)


def _any_smooth(mesh):
    smooth = np.zeros(len(mesh.polygons), dtype=bool)
    mesh.polygons.foreach_get("use_smooth", smooth)
    return bool(smooth.any())


def _corner_normals(mesh):
    """One unit vector a corner: flat faces have their own normal."""
    if hasattr(mesh, "calc_normals_split"):
        mesh.calc_normals_split()
    normals = np.zeros(len(mesh.loops) * 3, dtype=np.float32)
    if hasattr(mesh, "corner_normals"):
        mesh.corner_normals.foreach_get("vector", normals)
    else:
        mesh.loops.foreach_get("normal", normals)
    normals = normals.reshape(-1, 3)
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.where(lengths > 0, normals / np.maximum(lengths, 1e-30), [[0, 0, 1]])


def is_closed(mesh):
    """Whether every edge has two faces: what decides between a solid of glass and a pane."""
    users = np.zeros(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("edge_index", users)
    return len(users) > 0 and bool((np.bincount(users, minlength=len(mesh.edges)) == 2).all())
