"""A Blender scene as a scene folder, and what is needed to bring results back to the same objects."""

from dataclasses import dataclass, field

import numpy as np

from . import library_materials, light_and_view, mesh_export, sensor_grids, session
from .lightwell_bridge import looks
from .lightwell_bridge.lamps import add_lamp
from .lightwell_bridge.luminaires import add_measured
from .lightwell_bridge.names import UniqueNames
from .lightwell_bridge.scene_folder import SceneFolder
from .material_nodes import LookReader, Pictures
from .scene_walk import GEOMETRY, drawn_objects


@dataclass
class Part:
    """One object as exported: `faces` in the order of the results."""

    source: str
    object_name: str
    layer: str
    mesh: object  # PlyMesh
    matrix: object  # 3 x 4, to metres
    cage: bool
    modifiers: list
    original_faces: bool  # face i of the results is polygon i of the object's own mesh


@dataclass
class Exported:
    """`parts` by source; `layer_of` and `material_of` by the name of the modifier."""

    scene_file: object = None
    parts: dict = field(default_factory=dict)
    layer_of: dict = field(default_factory=dict)
    material_of: dict = field(default_factory=dict)
    lamps: dict = field(default_factory=dict)  # name: lumens, or lux of a sun
    views: dict = field(default_factory=dict)
    grids: list = field(default_factory=list)
    notes: list = field(default_factory=list)


class Stopped(Exception):
    """Somebody asked for the end of it."""


class Exporter:
    """export() walks the graph once. `view_size`: pixels of the pictures, which decide the shape of views; `stop` is
    asked at every object.
    """

    def __init__(self, depsgraph, path, view_size, stop=lambda: False):
        self.depsgraph, self.scene = depsgraph, depsgraph.scene
        self.scale = self.scene.unit_settings.scale_length
        self.size, self.stop = view_size, stop
        self.folder, self.out = SceneFolder(path), Exported()
        self._pictures = Pictures(self.folder, self.out.notes)
        self._looks = LookReader(self.out.notes, self._pictures)
        self._modifiers, self._materials, self._prototypes = UniqueNames(), {}, {}
        self._lit = False

    def export(self):
        """@throws Stopped"""
        for drawn in drawn_objects(self.depsgraph, GEOMETRY | {"LIGHT"}):
            if self.stop():
                raise Stopped
            if drawn.original.lightwell.is_grid:
                continue
            if drawn.evaluated.type == "LIGHT":
                self._add_lamp(drawn)
            else:
                self._add_object(drawn)
        sky = light_and_view.add_sky(self.folder, self.scene, self.scene.lightwell.efficacy, self.out.notes)
        if not (sky or self._lit):
            self.out.notes.append("the scene has no light: no lamp, no emitting material, no sky; everything will be "
                                  "black. Choose a sky under Scene > Lightwell")
        self._add_views()
        for grid in sensor_grids.grids_of(self.scene, self.depsgraph, self.out.notes):
            self.folder.grid(grid.name, grid.sensors, grid.rows, grid.columns, grid.spacing_m, grid.cells)
            self.out.grids.append(grid)
        if not self.out.parts and not self._lit:
            self.out.notes.append("the scene has no surfaces that are drawn in renders")
        self.out.notes = list(dict.fromkeys(self.out.notes))
        self.out.scene_file = self.folder.save()
        return self.out

    def _add_lamp(self, drawn):
        try:
            lamp = light_and_view.lamp_of(drawn, self.scale, self.scene.lightwell.efficacy, self.out.notes)
            measured = light_and_view.measured_lamp(lamp, drawn.original.data, self.folder, self.out.notes)
            if measured is not None:
                amount, notes = add_measured(self.folder, session.engine_path, measured, drawn.source)
            else:
                amount, notes = add_lamp(self.folder, lamp, drawn.source)
        except (ValueError, OSError, session.EngineError) as error:
            self.out.notes.append(str(error))
            return
        self.out.lamps[lamp.name] = amount
        self.out.notes += notes
        self._lit = self._lit or amount > 0

    def _add_object(self, drawn):
        matrix = np.array(drawn.matrix, dtype=float)[:3] * self.scale
        if not np.isfinite(matrix).all():
            self.out.notes.append(f"object \"{drawn.source}\": its place is no finite number; left out")
            return
        modifier = mesh_export.cage_modifier(drawn.original)
        mesh, slots = self._mesh_of(drawn, modifier)
        if mesh is None or len(mesh.sizes) == 0:
            if drawn.evaluated.type == "MESH" or mesh is not None:
                self.out.notes.append(f"object \"{drawn.source}\" has no face: nothing of it is seen")
            return
        if abs(np.linalg.det(matrix[:, :3])) < 1e-12 * max(np.abs(matrix[:, :3]).max(), 1e-30) ** 3:
            mesh, matrix = self._flattened(mesh, matrix, drawn)
            if mesh is None:
                return
        part = self.folder.part(drawn.original.data.name if drawn.original.data else drawn.original.name, mesh)
        place = dict(matrix=matrix, source=drawn.source)
        if modifier is not None:
            self.folder.subdivision(slots[0], drawn.source, part, self.scene.lightwell.chord, **place)
        else:
            self.folder.mesh(slots[0], drawn.source, part, **place)
        own = drawn.original.type == "MESH" and len(drawn.original.data.polygons) == len(mesh.sizes)
        self.out.parts[drawn.source] = Part(drawn.source, drawn.original.name, drawn.layer, mesh, matrix,
                                            modifier is not None, slots, own)

    def _mesh_of(self, drawn, modifier):
        """(PlyMesh or None, names of the slots); equal objects share the mesh."""
        mesh = drawn.original.data if modifier is not None else drawn.evaluated.to_mesh()
        if mesh is None:
            return None, []
        try:
            slots = self._slot_names(drawn, mesh)
            changed = len(drawn.original.modifiers) or drawn.original.type != "MESH" or drawn.original.mode == "EDIT"
            key = (drawn.original.name if changed else drawn.original.data.name, tuple(slots), modifier is not None)
            shapes = getattr(drawn.original.data, "shape_keys", None)
            if key not in self._prototypes or shapes is not None:
                self._prototypes[key] = (mesh_export.cage_of(drawn.original, modifier, slots) if modifier is not None
                                         else mesh_export.polygons_of(mesh, slots))
            return self._prototypes[key], slots
        finally:
            if modifier is None:
                drawn.evaluated.to_mesh_clear()

    def _flattened(self, mesh, matrix, drawn):
        """A mesh whose scale is 0 along a direction: its corners are moved here; nothing is left of it at scale 0."""
        from .lightwell_bridge.ply import transformed
        mesh = type(mesh)(transformed(mesh.vertices, matrix), mesh.sizes, mesh.corners, modifiers=mesh.modifiers,
                          face_modifiers=mesh.face_modifiers, uv=mesh.uv)
        if not mesh.areas().max() > 0:
            self.out.notes.append(f"object \"{drawn.source}\": its scale is 0, nothing is left of it; left out")
            return None, None
        self.out.notes.append(f"object \"{drawn.source}\": its scale is 0 in one direction; taken flat as it is")
        return mesh, np.eye(4)[:3]

    # --- materials

    def _slot_names(self, drawn, mesh):
        """The modifier of each slot: named after layer and material, bound to the material by an alias."""
        materials = [slot.material for slot in drawn.evaluated.material_slots] or [None]
        closed = None
        names = []
        for material in materials:
            material = material.original if material is not None else None
            if material is not None and closed is None:
                closed = mesh_export.is_closed(mesh)
            chosen = library_materials.choice(drawn, material)
            names.append(self._bound(drawn, material, chosen, bool(closed)))
        return names

    def _bound(self, drawn, material, chosen, closed):
        """A name for (layer, material) - or for this object, when it has a choice or lumens of its own."""
        lumens = drawn.original.get("lw_lumens") if drawn.original.type == "MESH" else None
        label = material.name if material is not None else "no material"
        key = (drawn.layer, label, chosen, closed, drawn.source if lumens else None)
        alias = self._modifiers.of(key, f"{drawn.layer or self.scene.name}: {label}")
        if not self.folder.knows(alias):
            self.folder.alias(alias, self._material(material, chosen, closed, drawn, lumens))
            self.out.layer_of[alias], self.out.material_of[alias] = drawn.layer, chosen or label
        return alias

    def _material(self, material, chosen, closed, drawn, lumens):
        key = (chosen or (material.name if material else None), closed and not chosen, drawn.source if lumens else None)
        if key in self._materials:
            return self._materials[key]
        wanted = chosen or (material.name if material is not None else "no material")
        name = self._modifiers.of(("material", *key), wanted)
        if chosen:
            name, emits = library_materials.add(self.folder, chosen, name, self.out.notes)
            self._lit = self._lit or emits
        else:
            if material is None:
                self.out.notes.append(f"object \"{drawn.source}\" has no material: taken as a dull grey of 50 %")
            look = self._looks.look_of(material, closed)
            look.name = name
            if lumens and look.emits():
                look.luminance = float(lumens) / (np.pi * self._emitting_area(drawn, material))
            self.out.notes += looks.add_look(self.folder, look, self.scene.lightwell.efficacy)
            self._lit = self._lit or look.emits() or any(part.emits() for _, part in look.mixed)
        self._materials[key] = name
        return name

    def _emitting_area(self, drawn, material):
        """World area of the object's faces of this material, m2."""
        slots = [s.material.original if s.material else None for s in drawn.evaluated.material_slots]
        mesh = mesh_export.polygons_of(drawn.original.data, ["x"] * max(len(slots), 2), normals=False)
        areas = mesh.areas(np.array(drawn.matrix, dtype=float)[:3] * self.scale)
        chosen = [i for i, m in enumerate(slots) if m == material]
        return float(areas[np.isin(mesh.face_modifiers, chosen)].sum()) or 1.0

    # --- views

    def _add_views(self):
        from .lightwell_bridge.views import view_words
        for obj in self.scene.objects:
            if obj.type != "CAMERA":
                continue
            try:
                camera = light_and_view.camera_of(obj.evaluated_get(self.depsgraph), self.scene, self.size, self.out.notes)
            except ValueError as error:
                self.out.notes.append(str(error))
                continue
            self.out.views[obj.name] = view_words(camera)
            self.folder.view(obj.name, self.out.views[obj.name])
