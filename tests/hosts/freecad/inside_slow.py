"""Begins a job that takes minutes, tells the number of the engine's process (to the file LIGHTWELL_PID), and goes on."""

import os
import pathlib
import time

import host

host.show_main_window()

import FreeCAD

from lightwell_freecad import project, run

document = FreeCAD.newDocument("slow")
for label in ("Room", "Lamp"):
    box = document.addObject("Part::Box", label)
box.Placement.Base = FreeCAD.Vector(0, 0, 100)
project.make_luminaire(box, 1000)
document.recompute()
lighting = project.make(document)
lighting.Accuracy, lighting.FaceSpacing = 0.0005, 0.5
job = run.Job(lighting, [run.OBJECTS])
while job.poll():
    if job.text == "illuminance of objects" and job.phase:
        pathlib.Path(os.environ["LIGHTWELL_PID"]).write_text(str(run.session_of(document).client.hello["pid"]))
    time.sleep(0.01)
