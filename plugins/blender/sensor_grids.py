"""Sensor grids over the faces of objects."""

from dataclasses import dataclass

import numpy as np

from . import mesh_export
from .lightwell_bridge import grids


@dataclass
class HostGrid(grids.Grid):
    object_name: str = ""


def grids_of(scene, depsgraph, notes):
    """A grid for each object that is marked as one, and each with the custom property `lw_grid_height`."""
    scale = scene.unit_settings.scale_length
    made = []
    for obj in scene.objects:
        height = obj.get("lw_grid_height")
        if obj.type != "MESH" or not (obj.lightwell.is_grid or height is not None) or obj.hide_render:
            continue
        settings = obj.lightwell_grid
        mesh = mesh_export.polygons_of(obj.data, ["x"], normals=False)
        matrix = np.array(obj.evaluated_get(depsgraph).matrix_world, dtype=float)[:3] * scale
        try:
            grid = grids.over_faces(obj.name, mesh, matrix, settings.spacing,
                                    settings.height if height is None or obj.lightwell.is_grid else float(height))
        except ValueError as error:
            notes.append(f"grid \"{obj.name}\": {error}")
            continue
        made.append(HostGrid(**vars(grid), object_name=obj.name))
    return made
