"""The office by its lamps, once by Lightwell and once by Cycles with each count of samples, through the same camera."""

import os
import resource
import shutil
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bpy
from inside import PATH, WORDS, addon, answer, render

scene = bpy.context.scene


def alike():
    """Where the same words mean other light in Cycles: photometric numbers, which it does not read; the sun, which comes
    through panes here and is stopped by them there; the matt part of Principled, which is rough there (Burley) and
    Lambert's here."""
    for block in (*bpy.data.objects, *bpy.data.materials):
        for name in [name for name in block.keys() if name.startswith("lw_")]:
            del block[name]
    for obj in bpy.data.objects:
        obj.hide_render = obj.hide_render or obj.type == "LIGHT" and obj.data.type == "SUN"
    for material in bpy.data.materials:
        tree = material.node_tree
        old = tree.nodes.get("Principled BSDF") if material.use_nodes else None
        if old is None or old.inputs["Metallic"].default_value > 0 or old.inputs["Transmission"].default_value > 0 or \
                old.inputs["Emission Strength"].default_value * max(old.inputs["Emission"].default_value[:3]) > 0:
            continue
        matt, colour = tree.nodes.new("ShaderNodeBsdfDiffuse"), old.inputs["Base Color"]
        matt.inputs["Color"].default_value = colour.default_value
        for link in colour.links:
            tree.links.new(link.from_socket, matt.inputs["Color"])
        for link in list(old.outputs["BSDF"].links):
            tree.links.new(matt.outputs["BSDF"], link.to_socket)


def dark_backs():
    """Emission from fronts alone, as in Lightwell: in Cycles panels shine onto the ceiling that they hang from, too."""
    for material in bpy.data.materials:
        tree = material.node_tree
        old = tree.nodes.get("Principled BSDF") if material.use_nodes else None
        if old is not None and old.inputs["Emission Strength"].default_value * max(old.inputs["Emission"].default_value[:3]) > 0:
            side, front = tree.nodes.new("ShaderNodeNewGeometry"), tree.nodes.new("ShaderNodeMath")
            front.operation, front.inputs[0].default_value = "MULTIPLY_ADD", 0
            tree.links.new(side.outputs["Backfacing"], front.inputs[0])
            front.inputs[1].default_value = -old.inputs["Emission Strength"].default_value
            front.inputs[2].default_value = old.inputs["Emission Strength"].default_value
            tree.links.new(front.outputs[0], old.inputs["Emission Strength"])


if WORDS[5] == "alike":
    alike()
size = dict(resolution_x=int(WORDS[1]), resolution_y=int(WORDS[2]), resolution_percentage=100)
# The skies of the two are different models: lamps, emitting panels and the sun lamp alone.
scene.lightwell.sky = "NONE"
scene.world.use_nodes, scene.world.color = False, (0, 0, 0)
scene.lightwell.quality, scene.lightwell.samples = "SAMPLES", int(WORDS[3])
scene.view_layers[0].use_pass_z = True
result = {"lightwell": render("lightwell.exr", **size)}
if WORDS[5] == "alike":
    dark_backs()
scene.render.engine = "CYCLES"
cycles = scene.cycles
cycles.use_denoising, cycles.use_adaptive_sampling = False, False
cycles.pixel_filter_type = "BOX"  # as Lightwell's
cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 32
cycles.sample_clamp_indirect = cycles.sample_clamp_direct = cycles.blur_glossy = 0


def timed(samples):
    """(CPU seconds, seconds) of a render, with what makes the scene ready."""
    used, start = resource.getrusage(resource.RUSAGE_SELF), time.monotonic()
    cycles.samples, scene.render.filepath = samples, str(PATH / f"cycles_{samples}.exr")
    bpy.ops.render.render(write_still=True)
    now = resource.getrusage(resource.RUSAGE_SELF)
    return now.ru_utime + now.ru_stime - used.ru_utime - used.ru_stime, time.monotonic() - start


result["cycles"] = {samples: timed(int(samples)) for samples in WORDS[4].split(",")}
shutil.copytree(addon("session").session("render").folder(), PATH / "scene", dirs_exist_ok=True)
answer(**result)
