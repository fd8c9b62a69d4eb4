"""The office by its lamps, once by Cycles and once by Lightwell, through the same camera."""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bpy
from inside import PATH, WORDS, answer, render

scene = bpy.context.scene
size = dict(resolution_x=int(WORDS[1]), resolution_y=int(WORDS[2]), resolution_percentage=100)
# The skies of the two are different models: lamps, emitting panels and the sun lamp alone.
scene.lightwell.sky = "NONE"
scene.world.use_nodes, scene.world.color = False, (0, 0, 0)
scene.lightwell.quality, scene.lightwell.samples = "SAMPLES", int(WORDS[3])
scene.view_layers[0].use_pass_z = True
result = {"lightwell": render("lightwell.exr", **size)}
scene.render.engine = "CYCLES"
cycles = scene.cycles
cycles.samples, cycles.use_denoising, cycles.use_adaptive_sampling = int(WORDS[4]), False, False
cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 32
cycles.sample_clamp_indirect = cycles.sample_clamp_direct = cycles.blur_glossy = 0
scene.render.filepath = str(PATH / "cycles.exr")
bpy.ops.render.render(write_still=True)
answer(**result)
