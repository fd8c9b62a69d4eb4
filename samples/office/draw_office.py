#!/usr/bin/python3
"""Draws the sample office as office.dxf, office.obj with office.mtl, and office.glb, each with its truth.

    draw_office.py [FOLDER]      folder to write to; this one by default

Every run writes the same bytes. Needs ezdxf 0.18; shares no code with the importers.
"""
import json
import sys
from pathlib import Path

import building
import dxf_writer
import glb_writer
import obj_writer
import truth
from shapes import blocks_of


def write_truth(folder, facts):
    text = json.dumps(facts, indent=1, ensure_ascii=True) + "\n"
    (folder / (facts["file"] + ".truth.json")).write_text(text, encoding="utf-8")


def main(arguments):
    folder = Path(arguments[0]) if arguments else Path(__file__).resolve().parent
    folder.mkdir(parents=True, exist_ok=True)
    model = building.office()
    blocks = blocks_of(model)
    dxf_writer.write_dxf(model, blocks, folder / "office.dxf")
    write_truth(folder, truth.dxf_truth(model, blocks))
    write_truth(folder, obj_writer.write_obj(model, folder / "office.obj"))
    write_truth(folder, glb_writer.write_glb(model, folder / "office.glb"))


if __name__ == "__main__":
    main(sys.argv[1:])
