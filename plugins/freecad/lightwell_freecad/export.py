"""A document as a scene folder for the engine, and which face of which object each surface of it is."""

import json
import math

import numpy as np

from lightwell_bridge import colour, sky as skies
from lightwell_bridge.engine import EngineError, find_engine
from lightwell_bridge.library import add_library_material
from lightwell_bridge.luminaires import Measured, add_measured
from lightwell_bridge.ply import PlyMesh
from lightwell_bridge.scene_folder import SceneFolder

from . import curved, faces, grids, optics, photometry, walk
from .appearance import Appearance
from .layer_map import LayerMap

MANIFEST = "freecad.json"
DEFAULT_TOLERANCE_MM = 1.0
# Rounding of a rotation, per entry: below it a transform counts as one that keeps shapes.
SIMILAR = 1e-9


class Exported:
    """What an export did.

    objects   path -> {"owner", "label", "subname", "layer", "faces"}; each face: its index in the owner's shape, the
              `element` of the scene that stands for it, there `count` entries from `first` on, kind, areas, modifier
    notes     sentences: what was left out, assumed or only approximated, each with the object's label
    layers    name of a face's layer -> {"decided", "material", "faces", "area_m2"}
    """

    def __init__(self):
        self.objects, self.notes, self.layers, self.grids, self.lights = {}, [], {}, {}, {}
        self.scene = None

    def manifest(self):
        return {"objects": self.objects, "layers": self.layers, "grids": self.grids, "lights": self.lights,
                "notes": self.notes}


def export_document(document, folder_path, tolerance_mm=DEFAULT_TOLERANCE_MM, views=(), sky=None, more_grids=(), rules=(), library=None,
                    engine=None):
    """Writes the folder; nothing in the document changes.

    @param views  pairs of a name and the words of a view
    @param rules  pairs of a pattern for names of layers and a name in `library`, the engine's named materials
    @param sky    of lightwell_bridge.sky; None: luminaires only
    @param engine  gives the path of the engine, which reads photometric files; asked only when one is named
    @throws ValueError when there is nothing to export, or a tolerance that is no length
    """
    if not (math.isfinite(tolerance_mm) and tolerance_mm > 0):
        raise ValueError(f"the chord tolerance is {tolerance_mm} mm, expected more than 0")
    layer_map = LayerMap(rules, library or {})
    return _Export(document, folder_path, tolerance_mm, layer_map, engine).run(views, sky, more_grids)


class _Export:
    def __init__(self, document, folder_path, tolerance_mm, layer_map, engine):
        self.document, self.tolerance_mm, self.layer_map, self.engine = document, tolerance_mm, layer_map, engine
        self.folder, self.result = SceneFolder(folder_path), Exported()
        self.appearance = Appearance(document)
        self.translated = {}

    def run(self, views, sky, more_grids):
        placed = walk.placed_objects(self.document, lambda obj, why: self._note(obj.Label, f"left out: {why}"))
        for one in placed:
            try:
                self._place(one)
            except ValueError as error:
                self._note(one.owner.Label, f"left out: {error}")
        if not self.result.objects:
            raise ValueError(f"\"{self.document.Label}\" has no visible object with a face: there is nothing to light")
        self.layer_map.check()
        for grid in more_grids:
            self._grid(grid)
        for name, words in views:
            self.folder.view(name, words)
        if sky is not None:
            skies.add_sky(self.folder, sky)
        elif not self.result.lights:
            self.result.notes.append("There is no light: neither a luminaire nor a sky. Give an object lumens, or add a sky.")
        self.result.scene = self.folder.save()
        (self.folder.path / MANIFEST).write_text(json.dumps(self.result.manifest(), ensure_ascii=False, indent=1))
        return self.result

    def _note(self, label, text):
        self.result.notes.append(f"\"{label}\": {text}.")

    def _place(self, one):
        _check_matrix(one.matrix)
        role = getattr(one.owner, "lw_role", "")
        if role == "sensor plane":
            self._grid(grids.of_face(one, float(getattr(one.owner, "lw_spacing", 500.0))))
            return
        if role == "luminaire" and getattr(one.owner, "lw_ies", ""):
            self._measured(one)
            role = "body of a luminaire"
        if one.is_mesh():
            self._place_mesh(one)
            return
        matrix, (surfaces, keys, failed) = one.matrix, self._surfaces(one)
        for index, why in failed:
            self._note(one.owner.Label, f"face {index + 1} left out: {why}")
        if not surfaces:
            raise ValueError("none of its faces can be translated")
        modifiers = self._modifiers(one, surfaces, keys, role)
        record = _record_of(one)
        self._flat(one, surfaces, modifiers, matrix, record)
        self._round(one, surfaces, modifiers, matrix, record)
        self._analytic(one, surfaces, modifiers, matrix, record)
        record["faces"].sort(key=lambda f: f["face"])
        self.result.objects[one.path] = record

    # --- geometry

    def _surfaces(self, one):
        """The surfaces of a leaf, translated once however often it appears."""
        similar = _scale_of(one.matrix) is not None
        key = (one.leaf.Document.Name, one.leaf.Name, one.layer, one.group, similar)
        if key not in self.translated:
            shape, failed = one.shape(), []
            found = faces.surfaces_of(shape, self.tolerance_mm, lambda i, why: failed.append((i, why)))
            if not similar:
                found = [_as_facets(s, shape.Faces[s.index], self.tolerance_mm) for s in found]
            self.translated[key] = (found, optics.keys_of(one, self.appearance, shape), failed)
        return self.translated[key]

    def _flat(self, one, surfaces, modifiers, matrix, record):
        chosen = [s for s in surfaces if s.kind == "polygon"]
        if chosen:
            self._mesh(one, one.path, [(s, s.numbers, None) for s in chosen], modifiers, matrix, record)

    def _round(self, one, surfaces, modifiers, matrix, record):
        rows = [(s, p, n) for s in surfaces if s.kind == "facets" for p, n in zip(s.facets, s.normals)]
        if rows:
            self._mesh(one, one.path + " (round)", rows, modifiers, matrix, record)

    def _mesh(self, one, name, rows, modifiers, matrix, record):
        """Rows of (surface, corners, normals or None) as one part; records which entries stand for which face."""
        used = sorted({modifiers[s.index] for s, _, _ in rows})
        corners = [p for _, p, _ in rows]
        more = {}
        if rows[0][2] is not None:
            more["normals"] = np.concatenate([n for _, _, n in rows])
        if len(used) > 1:
            more.update(modifiers=used, face_modifiers=[used.index(modifiers[s.index]) for s, _, _ in rows])
        vertices, numbers = np.unique(np.concatenate(corners), axis=0, return_inverse=True)
        mesh = PlyMesh(vertices, [len(p) for p in corners], numbers.reshape(-1), **more)
        part = self.folder.part(one.leaf.Label, mesh)
        self.folder.mesh(used[0], name, part, _in_metres(matrix), one.path)
        scale = _scale_of(matrix)
        areas = mesh.areas(None if scale is not None else matrix)
        entries = {}
        for number, (surface, _, _) in enumerate(rows):
            entries.setdefault(surface.index, [surface, number, 0, 0.0])
            entries[surface.index][2] += 1
            entries[surface.index][3] += float(areas[number]) * (scale * scale if scale is not None else 1)
        for index, (surface, first, count, area) in entries.items():
            self._record(record, surface, name, first, count, area, modifiers[index], scale)

    def _analytic(self, one, surfaces, modifiers, matrix, record):
        scale = _scale_of(matrix)
        for s in surfaces:
            if s.kind in ("polygon", "facets"):
                continue
            kind, numbers = _moved(s.kind, s.numbers, matrix, scale)
            name = f"{one.path}#{s.index + 1}"
            self.folder.surface(modifiers[s.index], kind, name, numbers, one.path)
            self._record(record, s, name, 0, 1, s.exported_m2 * scale * scale, modifiers[s.index], scale)

    def _record(self, record, surface, element, first, count, area, modifier, scale):
        wanted = surface.area_m2 * scale * scale if scale is not None else None
        record["faces"].append({"face": surface.index, "element": element, "first": first, "count": count,
                                "kind": surface.kind, "area_m2": area, "host_area_m2": wanted, "modifier": modifier})
        layer = self.result.layers[modifier]
        layer["faces"] += 1
        layer["area_m2"] += area

    def _place_mesh(self, one):
        points, triangles = one.mesh()
        vertices = points * faces.METRES_PER_MM
        mesh = PlyMesh.of_faces(vertices, triangles)
        keep = mesh.areas() > 0
        if not keep.all():
            self._note(one.owner.Label, f"{int((~keep).sum())} triangles without area left out")
            mesh = PlyMesh.of_faces(vertices, [t for t, k in zip(triangles, keep) if k])
        if not len(mesh.sizes):
            raise ValueError("its mesh has no area")
        keys = optics.keys_of(one, self.appearance, None)
        area = float(mesh.areas(one.matrix).sum())
        modifier = self._modifier_of(one, keys[0], area, getattr(one.owner, "lw_role", ""))
        part = self.folder.part(one.leaf.Label, mesh)
        self.folder.mesh(modifier, one.path, part, _in_metres(one.matrix), one.path)
        self.result.layers[modifier]["faces"] += len(mesh.sizes)
        self.result.layers[modifier]["area_m2"] += area
        record = _record_of(one)
        record["faces"].append({"face": 0, "element": one.path, "first": 0, "count": len(mesh.sizes), "kind": "mesh",
                                "area_m2": area, "host_area_m2": area, "modifier": modifier})
        self.result.objects[one.path] = record

    # --- materials

    def _modifiers(self, one, surfaces, keys, role):
        """Index of a face -> name of its modifier, defined in the folder. What a file measured is a body as drawn."""
        scale = _scale_of(one.matrix) or 1.0
        area = sum(s.exported_m2 for s in surfaces) * scale * scale
        return {s.index: self._modifier_of(one, keys[s.index], area, role) for s in surfaces}

    def _modifier_of(self, one, key, area_m2, role):
        if role == "luminaire":
            return self._light(one, area_m2)
        name = key.name + (" (two sheets)" if key.identity()[1] else "")
        if name not in self.result.layers:
            self.result.layers[name] = {"decided": key.decided, "material": self._bind(name, key), "faces": 0, "area_m2": 0.0}
        return name

    def _bind(self, name, key):
        """Defines what the name of a layer stands for; returns it in words."""
        chosen = self.layer_map.material_for(key.name)
        if chosen is not None:
            emits = add_library_material(self.folder, chosen, chosen.name)
            self.folder.alias(name, chosen.name)
            if emits:
                self.result.lights[name] = {"material": chosen.name}
            return chosen.name
        if key.rgb is None and key.decided.startswith("material"):
            self.result.notes.append(f"Material \"{key.name}\" has no colour that can be read: taken as "
                                     f"{100 * optics.DEFAULT_REFLECTANCE:.0f} % grey.")
        kind, numbers = optics.material_of(key)
        material = f"{name} as drawn"
        self.folder.material(kind, material, numbers)
        self.folder.alias(name, material)
        return _in_words(kind, numbers)

    def _light(self, one, area_m2):
        lumens, kelvin = float(getattr(one.owner, "lw_lumens", 0.0)), optics.kelvin_of(one.owner)
        name = f"{one.path} (light)"
        if name not in self.result.layers:
            rgb = optics.light_of(lumens, kelvin, area_m2)
            self.folder.material("light", name, rgb)
            self.result.lights[one.path] = {"lumens": lumens, "kelvin": kelvin, "area_m2": area_m2,
                                            "cd_per_m2": lumens / (math.pi * area_m2)}
            self.result.layers[name] = {"decided": "luminaire", "material": f"light, {lumens:g} lm", "faces": 0, "area_m2": 0.0}
        return name

    def _measured(self, one):
        """The luminous opening of its photometric file, before or around the body as drawn."""
        place, body_m = photometry.place_of(one)
        hue = colour.blackbody_hue(optics.kelvin_of(one.owner))
        lamp = Measured(one.owner.Label, photometry.file_of(one.owner), place, colour=colour.of_luminance(hue, 1.0),
                        body_m=body_m)
        try:
            lumens, notes = add_measured(self.folder, self.engine or find_engine, lamp, one.path)
        except EngineError as error:
            raise ValueError(str(error)) from error
        self.result.notes += notes
        self.result.lights[one.path] = {"lumens": lumens, "file": str(lamp.file)}

    def _grid(self, grid):
        self.folder.grid(grid.name, grid.sensors, grid.rows, grid.columns, grid.spacing_m, grid.cells)
        self.result.grids[grid.name] = grid.facts()


def _record_of(one):
    return {"owner": one.owner.Name, "label": one.owner.Label, "subname": one.subname, "layer": one.layer, "faces": []}


def _in_words(kind, numbers):
    share = colour.luminous(numbers[:3])
    return f"glass, transmissivity {share:.2f}" if kind == "glass" else f"matt, {100 * share:.0f} %"


def _as_facets(surface, face, tolerance_mm):
    """For transforms under which a circle is none any more."""
    if surface.kind in ("polygon", "facets"):
        return surface
    if surface.kind == "ring":
        points, triangles = face.tessellate(tolerance_mm)
        normal = np.array(surface.numbers[3:6])
        polygons = [np.array([points[i] for i in t]) for t in triangles]
        facets = curved.Facets(polygons, [np.tile(normal, (3, 1)) for _ in polygons])
    else:
        facets = curved.facets_of(face, tolerance_mm)
    return faces.Surface(surface.index, "facets", surface.area_m2, facets.area() * 1e-6,
                         facets=[p * faces.METRES_PER_MM for p in facets.polygons], normals=facets.normals)


def _check_matrix(matrix):
    if not np.isfinite(matrix).all():
        raise ValueError("its placement has a number that is not finite")
    if abs(np.linalg.det(matrix[:3, :3])) < 1e-12:
        raise ValueError("its scale is zero")


def _scale_of(matrix):
    """The factor of a transform that keeps shapes, mirrored ones too; None for others."""
    linear = matrix[:3, :3]
    square = linear.T @ linear
    factor = np.trace(square) / 3
    if factor <= 0 or np.abs(square - factor * np.eye(3)).max() > SIMILAR * factor:
        return None
    scale = math.sqrt(factor)
    return 1.0 if abs(scale - 1) < SIMILAR else scale


def _in_metres(matrix):
    """The same transform for lengths in metres; None for the identity."""
    moved = matrix.copy()
    moved[:3, 3] *= faces.METRES_PER_MM
    return None if np.array_equal(moved, walk.IDENTITY) else moved


def _moved(kind, numbers, matrix, scale):
    """An analytic surface under a transform that keeps shapes."""
    place = _in_metres(matrix)
    if place is None:
        return kind, numbers
    point = lambda p: [float(v) for v in place[:3, :3] @ np.asarray(p) + place[:3, 3]]
    if kind in ("sphere", "bubble"):
        return kind, [*point(numbers[:3]), numbers[3] * scale]
    if kind in ("cylinder", "tube"):
        return kind, [*point(numbers[:3]), *point(numbers[3:6]), numbers[6] * scale]
    if kind in ("cone", "cup"):
        return kind, [*point(numbers[:3]), *point(numbers[3:6]), numbers[6] * scale, numbers[7] * scale]
    direction = place[:3, :3] @ np.asarray(numbers[3:6]) / scale
    return kind, [*point(numbers[:3]), *(float(v) for v in direction), numbers[6] * scale, numbers[7] * scale]
