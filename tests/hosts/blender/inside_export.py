"""Exports the open file and tells what became of each object."""

import os
import sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from inside import WORDS, answer, export

exported = export()
parts = {}
for source, part in exported.parts.items():
    from lightwell.lightwell_bridge.ply import transformed
    points = transformed(part.mesh.vertices, part.matrix)
    areas = part.mesh.areas(part.matrix)
    used = part.mesh.face_modifiers if part.mesh.face_modifiers is not None else np.zeros(len(areas), dtype=int)
    by_material = {}
    for i, name in enumerate(part.modifiers):
        if (used == i).any():
            entry = by_material.setdefault(exported.material_of[name], [0, 0.0])
            entry[0] += int((used == i).sum())
            entry[1] += float(areas[used == i].sum())
    parts[source] = {"object": part.object_name, "layer": part.layer, "faces": len(areas), "area": float(areas.sum()),
                     "sizes": part.mesh.sizes.tolist(), "bbox": [points.min(axis=0).tolist(), points.max(axis=0).tolist()],
                     "cage": part.cage, "by_material": by_material, "edges": 0 if part.mesh.edges is None else len(part.mesh.edges),
                     "sharpness": [] if part.mesh.edges is None else sorted(set(part.mesh.edge_sharpness.tolist())),
                     "textured": part.mesh.uv is not None}
answer(parts=parts, notes=exported.notes, views=exported.views, lamps=exported.lamps,
       grids=[[g.name, len(g.sensors)] for g in exported.grids], scene=str(exported.scene_file),
       files=len(list(exported.scene_file.parent.joinpath("parts").iterdir())))
