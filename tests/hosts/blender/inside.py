"""What every script inside Blender begins with: its words, and where its answer goes."""

import json
import pathlib
import sys

import bpy

WORDS = sys.argv[sys.argv.index("--") + 1:]
PATH = pathlib.Path(WORDS[0])


def addon(name):
    """A module of the add-on."""
    import importlib
    return importlib.import_module(f"lightwell.{name}")


def answer(**values):
    (PATH / "answer.json").write_text(json.dumps(values, ensure_ascii=False, default=float))


def export(size=(64, 40), folder="scene"):
    bpy.context.view_layer.update()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return addon("exporter").Exporter(depsgraph, PATH / folder, size).export()


def fingerprint():
    """What the document holds, to compare before and after: names, counts, modes, places, meshes, custom properties."""
    blocks = {kind: sorted(b.name for b in getattr(bpy.data, kind) if b.name != "Render Result") for kind in
              ("objects", "meshes", "materials", "images", "texts", "collections", "lights", "cameras", "worlds", "scenes")}
    objects = {o.name: [o.data.name if o.data else None, [list(row) for row in o.matrix_world], o.hide_render,
                        [[s.link, s.material.name if s.material else None] for s in o.material_slots]]
               for o in bpy.data.objects}
    meshes = {m.name: [len(m.vertices), len(m.polygons), sorted(a.name for a in m.attributes), m.users, m.use_fake_user,
                       [x.name if x else None for x in m.materials]] for m in bpy.data.meshes}
    props = {s.name: sorted(k for k in s.keys() if k != "lightwell") for s in bpy.data.scenes}
    return json.dumps([blocks, objects, meshes, props], ensure_ascii=False, sort_keys=True)


def render(file="picture.exr", **settings):
    """A final picture to a file; the error of the engine as text, or None."""
    scene = bpy.context.scene
    scene.render.engine = "LIGHTWELL"
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.color_depth = "32"
    scene.render.image_settings.exr_codec = "NONE"
    scene.render.filepath = str(PATH / file)
    for name, value in settings.items():
        setattr(scene.render, name, value)
    try:
        bpy.ops.render.render(write_still=True)
        return None
    except RuntimeError as error:
        return str(error)
