"""Small inputs for the tests of the command line, made from scratch."""

# A closed room of 4 x 3 x 2.5 m, grey walls, with a square lamp below the ceiling.
ROOM_RAD = """\
void plastic wall 0 0 5 0.5 0.5 0.5 0 0
void light lamp 0 0 3 20 20 20
lamp polygon lamp_1 0 0 12 1.5 1 2.45  1.5 2 2.45  2.5 2 2.45  2.5 1 2.45
wall polygon floor 0 0 12 0 0 0  4 0 0  4 3 0  0 3 0
wall polygon ceiling 0 0 12 0 0 2.5  0 3 2.5  4 3 2.5  4 0 2.5
wall polygon south 0 0 12 0 0 0  0 0 2.5  4 0 2.5  4 0 0
wall polygon north 0 0 12 0 3 0  4 3 0  4 3 2.5  0 3 2.5
wall polygon west 0 0 12 0 0 0  0 3 0  0 3 2.5  0 0 2.5
wall polygon east 0 0 12 4 0 0  4 0 2.5  4 3 2.5  4 3 0
"""

VIEW = "-vtv -vp 0.5 0.5 1.5 -vd 0.7 0.6 -0.2 -vu 0 0 1 -vh 60 -vv 45"

# Two layers, in millimetres: a floor of 2 x 1 m and a wall of 2 x 0.5 m.
OBJ = """\
o Floor
v 0 0 0
v 2000 0 0
v 2000 1000 0
v 0 1000 0
f 1 2 3 4
o Wall
v 0 0 500
v 2000 0 500
f 1 5 6 2
"""


def face_dxf(layers, unit_code=6):
    """A drawing with one 3DFACE (1 x 1 drawing units, level, facing up) on each layer; unit 6 is the metre."""
    tags = [(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1015"), (9, "$INSUNITS"), (70, unit_code),
            (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")]
    for index, layer in enumerate(layers):
        tags += [(0, "3DFACE"), (8, layer)]
        for corner, (x, y) in enumerate(((0, 0), (1, 0), (1, 1), (0, 1))):
            tags += [(10 + corner, x + 2 * index), (20 + corner, y), (30 + corner, 0)]
    tags += [(0, "ENDSEC"), (0, "EOF")]
    return "".join(f"{code:3d}\n{value}\n" for code, value in tags)
