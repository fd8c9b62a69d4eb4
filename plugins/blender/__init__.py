# SPDX-License-Identifier: MIT
# MIT is compatible with the GPL, under which Blender asks its add-ons to be; the engine is a program of its own.
"""Lightwell in Blender: pictures and illuminance in absolute units, on the very objects."""

bl_info = {
    "name": "Lightwell",
    "author": "The Lightwell developers",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Render > Engine, Scene > Lightwell",
    "description": "Lighting simulation in absolute units: pictures, illuminance maps on objects, sensor grids",
    "category": "Render",
}


def _modules():
    from . import illuminance, legend_overlay, operators, panels, properties, render_engine, session
    return properties, operators, illuminance, panels, legend_overlay, render_engine, session


def register():
    for module in _modules():
        module.register()


def unregister():
    for module in reversed(_modules()):
        module.unregister()
