"""Writes the drawing as DXF R2010 in millimetres: blocks stay blocks, round things stay circles and bulges."""
import ezdxf
from ezdxf.math import OCS, Vec3
from layers import LAYERS
from shapes import Band, Bent, Cylinder, Face, Insert, Note, Polyface, Solid, Strip, area_vector, unit


def write_dxf(model, blocks, file):
    """@return  the ezdxf document as written"""
    ezdxf.options.write_fixed_meta_data_for_testing = True  # no dates, no random ids: the same bytes each time
    document = ezdxf.new("R2010", setup=False)
    document.header["$INSUNITS"] = 4
    document.header["$MEASUREMENT"] = 1
    for name, (colour, _, _) in LAYERS.items():
        if name != "0":
            document.layers.add(name, color=colour)
    style = document.dimstyles.get("Standard")
    style.dxf.dimtxt, style.dxf.dimasz, style.dxf.dimexe, style.dxf.dimexo = 200, 150, 100, 100
    for name, block in blocks.items():
        write_records(block, document.blocks.new(name))
    write_records(model, document.modelspace())
    for name in sorted(document.entitydb.dxf_types_in_use()):
        document.classes.add_class(name)  # otherwise ezdxf adds them in the order of a set
    document.saveas(file)
    return document


def write_records(block, layout):
    for record in block.records:
        WRITERS[type(record)](layout, record, {"layer": record.layer})


def flat_points(corners):
    """Corners in the object frame of their plane: (extrusion, elevation, [(x, y)])."""
    normal = Vec3(unit(area_vector(corners)))
    frame = OCS(normal)
    points = [frame.from_wcs(Vec3(p)) for p in corners]
    return normal, points[0].z, [(p.x, p.y) for p in points]


def write_face(layout, record, attributes):
    corners = record.corners if len(record.corners) == 4 else (*record.corners, record.corners[2])
    layout.add_3dface(corners, dxfattribs=attributes)


def write_solid(layout, record, attributes):
    normal, elevation, points = flat_points(record.corners)
    a, b, c, d = [(x, y, elevation) for x, y in points]
    layout.add_solid((a, b, d, c), dxfattribs={**attributes, "extrusion": normal})


def write_bent(layout, record, attributes):
    layout.add_lwpolyline(record.points, format="xyb", close=True,
                          dxfattribs={**attributes, "elevation": record.elevation, "thickness": record.thickness})


def write_band(layout, record, attributes):
    points = [(*record.start, record.bulge), (*record.end, 0)]
    layout.add_lwpolyline(points, format="xyb", dxfattribs={
        **attributes, "elevation": record.elevation, "thickness": record.thickness, "const_width": record.width})


def write_polyface(layout, record, attributes):
    polyface = layout.add_polyface(dxfattribs=attributes)
    polyface.append_faces(record.faces)
    polyface.optimize()


def write_strip(layout, record, attributes):
    layout.add_line(record.start, record.end, dxfattribs={**attributes, "thickness": record.height})


def write_cylinder(layout, record, attributes):
    normal = Vec3(record.axis)
    attributes = {**attributes, "extrusion": normal}
    attributes["thickness"] = record.length
    layout.add_circle(OCS(normal).from_wcs(Vec3(record.base)), record.radius, dxfattribs=attributes)


def write_insert(layout, record, attributes):
    sx, sy, sz = record.scale
    layout.add_blockref(record.block.name, record.at, dxfattribs={
        **attributes, "rotation": record.turn_deg, "xscale": sx, "yscale": sy, "zscale": sz})


def write_note(layout, record, attributes):
    if record.kind == "TEXT":
        words, place, height = record.values
        layout.add_text(words, dxfattribs={**attributes, "insert": place, "height": height})
    elif record.kind == "LINE":
        layout.add_line(*record.values, dxfattribs=attributes)
    elif record.kind == "ARC":
        layout.add_arc(*record.values, dxfattribs=attributes)
    elif record.kind == "CIRCLE":
        layout.add_circle(*record.values, dxfattribs=attributes)
    elif record.kind == "LWPOLYLINE":
        points, elevation = record.values
        layout.add_lwpolyline(points, format="xy", close=True, dxfattribs={**attributes, "elevation": elevation})
    elif record.kind == "DIMENSION":
        begin, end, base, turn = record.values
        layout.add_linear_dim(base, begin, end, angle=turn, dimstyle="Standard", dxfattribs=attributes).render()


WRITERS = {Face: write_face, Solid: write_solid, Bent: write_bent, Band: write_band, Polyface: write_polyface,
           Strip: write_strip, Cylinder: write_cylinder, Insert: write_insert, Note: write_note}
