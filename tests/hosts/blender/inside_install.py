"""Installs the zip as a person would, and looks at what it brings."""

import os
import sys
import zipfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bpy
from inside import PATH, WORDS, answer

bpy.ops.preferences.addon_install(filepath=WORDS[1], overwrite=True)
bpy.ops.preferences.addon_enable(module="lightwell")
bpy.ops.wm.save_userpref()
operators = [getattr(bpy.ops.lightwell, name).get_rna_type() for name in dir(bpy.ops.lightwell)]
tooltips = {op.identifier: op.description for op in operators}
fields = {}
for group in (bpy.types.Scene, bpy.types.Material, bpy.types.Light, bpy.types.Collection, bpy.types.Object):
    settings = group.bl_rna.properties["lightwell"].fixed_type
    fields.update({f"{group.__name__}.{p.identifier}": p.description for p in settings.properties
                   if p.identifier not in ("rna_type", "name")})
bpy.ops.lightwell.check_engine()
bpy.ops.preferences.addon_disable(module="lightwell")
bpy.ops.preferences.addon_enable(module="lightwell")
answer(tooltips=tooltips, fields=fields, names=zipfile.ZipFile(WORDS[1]).namelist(),
       engines=[e.bl_idname for e in bpy.types.RenderEngine.__subclasses__()], version=list(bpy.app.version))
