"""Blocks that are placed many times: windows, doors, luminaires, furniture, trees. Layer 0 takes the insert's layer.

Things that stand on one another keep a gap of 1 mm, so that no two surfaces coincide.
"""
import math
from shapes import Block, Solid

UP = (0, 0, 1)


def glazed_frame(name, width, height, mullions, frame_layer, pane_layer, bar=60):
    """Fills an opening of a 300 mm wall; x along the wall, y inwards from the outer skin, z from the sill.

    The outer rim touches the reveals, so the frame leaves no gap; where bars meet there are no hidden ends.
    """
    block = Block(name)
    outer, inner = (100, 170)
    w, h = width, height
    rim = [(0, 0), (w, 0), (w, h), (0, h)]
    hole = [(bar, bar), (w - bar, bar), (w - bar, h - bar), (bar, h - bar)]
    faces = []
    for i in range(4):
        a, b, c, d = rim[i], rim[(i + 1) % 4], hole[(i + 1) % 4], hole[i]
        faces.append(tuple((x, outer, z) for x, z in (a, b, c, d)))
        faces.append(tuple((x, inner, z) for x, z in (b, a, d, c)))
        faces.append(((d[0], outer, d[1]), (c[0], outer, c[1]), (c[0], inner, c[1]), (d[0], inner, d[1])))
    block.polyface(frame_layer, faces)
    centres = [bar / 2] + [w * (i + 1) / (mullions + 1) for i in range(mullions)] + [w - bar / 2]
    for centre in centres[1:-1]:
        block.box(frame_layer, (centre - bar / 2, outer, bar), (centre + bar / 2, inner, h - bar), omit="du")
    for left, right in zip(centres, centres[1:]):
        x0, x1 = left + bar / 2, right - bar / 2
        block.face(pane_layer, (x0, 135, bar), (x1, 135, bar), (x1, 135, h - bar), (x0, 135, h - bar))
    return block


def door_leaf():
    """Hinge at the origin, closed along x, 900 wide."""
    block = Block("DOOR")
    block.box("A-DOOR", (5, 5, 10), (895, 45, 2090))
    for y, axis in ((4, (0, -1, 0)), (46, (0, 1, 0))):
        block.cylinder("A-DOOR-HDWR", (830, y, 1050), axis, 10, 50)
        block.box("A-DOOR-HDWR", (720, min(y + axis[1] * 51, y + axis[1] * 66), 1041),
                  (845, max(y + axis[1] * 51, y + axis[1] * 66), 1059))
    return block


def exit_door():
    """Fills an opening of 1000 x 2100 in a 300 mm wall."""
    block = Block("DOOR-EXIT")
    block.box("A-DOOR", (0, 100, 0), (1000, 160, 2100), omit="weud")
    block.cylinder("A-DOOR-HDWR", (80, 161, 1000), (0, 1, 0), 12, 60)
    block.box("A-DOOR-HDWR", (60, 222, 985), (940, 245, 1015))
    return block


def luminaire(name, as_solid):
    """Panel of 600 x 600 below the ceiling (z = 0); the sheet faces down, inside a frame."""
    block = Block(name)
    half, hole, top, bottom, sheet = 300, 280, -1, -60, -50
    rim = [(-half, -half), (half, -half), (half, half), (-half, half)]
    inside = [(x * hole / half, y * hole / half) for x, y in rim]
    faces = [tuple((x, y, top) for x, y in rim)]
    for i in range(4):
        a, b, c, d = rim[i], rim[(i + 1) % 4], inside[(i + 1) % 4], inside[i]
        faces.append(((*a, bottom), (*b, bottom), (*b, top), (*a, top)))
        faces.append(((*b, bottom), (*a, bottom), (*d, bottom), (*c, bottom)))
        faces.append(((*c, bottom), (*d, bottom), (*d, sheet), (*c, sheet)))
    block.polyface("E-LITE-FRAM", faces)
    corners = tuple((x, y, sheet) for x, y in reversed(inside))
    if as_solid:
        block.records.append(Solid("E-LITE-PANL", corners))
    else:
        block.face("E-LITE-PANL", *corners)
    return block


def monitor():
    block = Block("MONITOR")
    block.box("I-FURN-SCRN", (-110, -90, 1), (110, 90, 13))
    block.cylinder("0", (0, 30, 14), UP, 20, 265)
    block.box("0", (-310, 5, 130), (310, 29, 490))
    block.face("I-FURN-SCRN", (-300, 4, 140), (300, 4, 140), (300, 4, 480), (-300, 4, 480))
    return block


def drawers():
    block = Block("DRAWERS")
    block.box("0", (0, 0, 30), (400, 550, 600))
    for low, high in ((35, 375), (385, 595)):
        block.box("0", (4, -15, low), (396, -1, high))
        block.cylinder("I-FURN-METL", (140, -28, high - 40), (1, 0, 0), 6, 120)
    return block


def desk(monitor_block, drawers_block):
    """1600 x 800 at 720, all that lies flat on it below 750 mm; the seat is on the side of small y."""
    block = Block("DESK")
    block.box("0", (-800, 0, 695), (800, 800, 720))
    for x in (-760, 760):
        for y in (40, 760):
            block.cylinder("I-FURN-METL", (x, y, 1), UP, 25, 693)
    block.box("0", (-700, 770, 350), (700, 788, 690))
    block.box("I-FURN-SCRN", (-220, 170, 721), (220, 310, 740))
    block.insert("I-FURN-METL", monitor_block, (0, 560, 720))
    block.insert("0", drawers_block, (330, 120, 0))
    return block


def task_chair():
    """Looks towards +y."""
    block = Block("CHAIR-TASK")
    block.box("0", (-240, -230, 440), (240, 230, 500))
    block.box("0", (-220, -260, 560), (220, -215, 980))
    block.box("I-FURN-METL", (-30, -285, 300), (30, -262, 760))
    block.cylinder("I-FURN-METL", (0, 0, 86), UP, 30, 353)
    for axis in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0)):
        block.cylinder("I-FURN-METL", (axis[0] * 32, axis[1] * 32, 70), axis, 18, 270)
    return block


def visitor_chair():
    block = Block("CHAIR-VISIT")
    block.box("0", (-230, -230, 440), (230, 230, 470))
    block.box("0", (-220, -225, 620), (220, -200, 860))
    for x in (-215, 215):
        block.cylinder("I-FURN-METL", (x, 215, 1), UP, 12, 438)
        block.cylinder("I-FURN-METL", (x, -240, 1), UP, 12, 840)
    return block


def table(name, long, deep):
    block = Block(name)
    block.box("0", (-long / 2, -deep / 2, 692), (long / 2, deep / 2, 720))
    for x in (-long / 2 + 400, long / 2 - 400):
        block.box("I-FURN-METL", (x - 30, -deep / 2 + 200, 1), (x + 30, deep / 2 - 200, 691))
    return block


def round_table():
    block = Block("TABLE-ROUND")
    block.cylinder("0", (0, 0, 421), UP, 400, 25)
    block.cylinder("I-FURN-METL", (0, 0, 13), UP, 40, 407)
    block.cylinder("I-FURN-METL", (0, 0, 1), UP, 250, 11)
    return block


def sofa():
    """Looks towards +y."""
    block = Block("SOFA")
    block.box("0", (-900, -400, 60), (900, 400, 400))
    block.box("0", (-900, -400, 401), (900, -201, 800))
    for x in (-900, 751):
        block.box("0", (x, -200, 401), (x + 149, 400, 580))
    for x in (-850, 850):
        for y in (-350, 350):
            block.cylinder("I-FURN-METL", (x, y, 1), UP, 20, 58)
    return block


def sunshade():
    """Three fins and two brackets over a window of 3000 mm, in front of the outer skin (y < 0), z above the sill."""
    block = Block("SUNSHADE")
    for i in range(3):
        block.box("0", (-100, -195 - 190 * i, 2000), (3100, -45 - 190 * i, 2015))
    for x in (300, 2660):
        block.box("0", (x, -620, 2016), (x + 40, -1, 2056))
    return block


def uneven(i, j):
    """A fixed number in [0.86, 1.14] for each place: leaves are not a sphere."""
    return 0.86 + 0.28 * ((i * 7919 + j * 104729 + i * j * 1299709) % 1009) / 1008


def tree():
    """4.8 m high; the crown is a closed uneven body of triangles."""
    block = Block("TREE")
    block.cylinder("L-PLNT-TREE", (0, 0, -50), UP, 120, 2400)
    around, rows = 12, 9

    def corner(i, j):
        if j in (0, rows):
            return (0, 0, 3400 + (-1450 if j == 0 else 1450))
        polar, turn = math.pi * j / rows, 2 * math.pi * i / around
        radius = uneven(i % around, j)
        return (round(1300 * radius * math.sin(polar) * math.cos(turn)),
                round(1300 * radius * math.sin(polar) * math.sin(turn)),
                round(3400 - 1450 * radius * math.cos(polar)))

    faces = []
    for i in range(around):
        faces.append((corner(0, 0), corner(i + 1, 1), corner(i, 1)))
        for j in range(1, rows - 1):
            a, b, c, d = corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)
            faces += [(a, b, c), (a, c, d)]
        faces.append((corner(0, rows), corner(i, rows - 1), corner(i + 1, rows - 1)))
    block.polyface("L-PLNT-FOLI", faces)
    return block
