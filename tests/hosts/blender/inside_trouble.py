"""One trouble after the other in the same Blender; after each, the document is as it was and a good render works."""

import os
import signal
import sys
import threading
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bpy
from inside import WORDS, addon, answer, export, fingerprint, render

FAKE_ENGINE = WORDS[1]
session = addon("session")
found, changed = {}, []
bpy.context.scene.render.resolution_x, bpy.context.scene.render.resolution_y = 64, 40
bpy.context.scene.render.resolution_percentage = 100


def fake(kind):
    os.environ["FAKE"] = kind
    os.environ["LIGHTWELL_ENGINE"] = FAKE_ENGINE
    session.close_all()


def check(name, work):
    """Runs one trouble; notes what was said and whether the document changed."""
    before = fingerprint()
    found[name] = work()
    if fingerprint() != before:
        changed.append(name)


def no_engine():
    session.close_all()
    os.environ.pop("LIGHTWELL_ENGINE", None)
    return render()


def wrong_path():
    session.close_all()
    os.environ["LIGHTWELL_ENGINE"] = "/nowhere/lightwell"
    return render()


def with_fake(kind):
    def work():
        fake(kind)
        return render()
    return work


def killed():
    fake("slow")
    kept = session.session("render")
    threading.Timer(1.5, lambda: os.kill(kept.client.hello["pid"], signal.SIGKILL)).start()
    return render()


def no_camera():
    fake("")
    camera, bpy.context.scene.camera = bpy.context.scene.camera, None
    try:
        return render()
    finally:
        bpy.context.scene.camera = camera


def illuminance():
    fake("dies")
    try:
        bpy.ops.lightwell.illuminance()
        return None
    except RuntimeError as error:
        return str(error)


for name, work in (("no engine", no_engine), ("wrong path", wrong_path), ("version", with_fake("old")),
                   ("no greeting", with_fake("chatter")), ("dies", with_fake("dies")), ("killed", killed),
                   ("disk full", with_fake("full")), ("bad object", with_fake("error")), ("black", with_fake("black")),
                   ("small", with_fake("small")), ("no camera", no_camera), ("illuminance", illuminance)):
    check(name, work)
    fake("")
    found[name + ", then"] = render("after.exr")


def scene_troubles():
    """Objects and materials that are in the way; the notes of an export name each."""
    fake("")
    scene = bpy.context.scene
    empty = bpy.data.objects.new("Nichts / 無", bpy.data.meshes.new("nothing"))
    flat = bpy.data.objects["Desk 02"]
    scene.collection.objects.link(empty)
    scale, flat.scale = flat.scale.copy(), (0, 0, 0)
    squashed = bpy.data.objects["Desk 03"]
    squashed_scale, squashed.scale = squashed.scale.copy(), (1, 1, 0)
    material = bpy.data.materials.new("Geheimnis 50 % \"x\" #1")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.remove(nodes["Principled BSDF"])
    toon = nodes.new("ShaderNodeBsdfToon")
    material.node_tree.links.new(toon.outputs[0], nodes["Material Output"].inputs[0])
    missing = bpy.data.images.new("gone", 4, 4)
    missing.source, missing.filepath = "FILE", "//no such folder/gone.png"
    missing.reload()
    textured = bpy.data.materials.new("Tapete 壁紙")
    textured.use_nodes = True
    image = textured.node_tree.nodes.new("ShaderNodeTexImage")
    image.image = missing
    textured.node_tree.links.new(image.outputs[0], textured.node_tree.nodes["Principled BSDF"].inputs["Base Color"])
    desk = bpy.data.objects["Desk 01"]
    desk.name = "Tisch / Büro: 机 #1"
    desk.data = desk.data.copy()
    desk.data.materials[0], desk.data.materials[1] = material, textured
    bare = bpy.data.objects["Door leaf"]
    bare.data.materials.clear()
    bpy.data.objects["Ceiling"].lightwell.use = "no_such_material"
    exported = export(folder="troubles")
    return exported


exported = scene_troubles()
found["notes"] = exported.notes
found["sources"] = list(exported.parts)
found["render with all that"] = render()

for obj in list(bpy.data.objects):
    if obj.type == "LIGHT" or "LED" in obj.name:
        bpy.data.objects.remove(obj)
bpy.context.scene.lightwell.sky = "NONE"
found["dark"] = export(folder="dark").notes
bpy.context.scene.lightwell.sky = "clear"
bpy.context.scene.lightwell.time = "noon"
found["time"] = render()
answer(found=found, changed=changed)
