"""The office building: 24 m x 12 m, two storeys of 3.5 m. Millimetres; x east, y north, z up, ground floor at 0."""
from shapes import Band, Bent, Block, Strip, length, scaled, sub
import furniture

LONG, DEEP, WALL = 24000, 12000, 300
STOREY, CEILING, SILL, HEAD = 3500, 2800, 850, 2700
ROOF, PARAPET = 7000, 7400
BAYS = [2100 + 3960 * i for i in range(6)]
ENTRANCE_BAY, EXIT_BAY = 3, 5
PARTITION_W, PARTITION_E = 8000, 16000  # centre lines of the walls beside the reception hall
OPENING = (9570, 9850, 14100, 11350)    # stair opening in the upper floor: x0, y0, x1, y1
OFFICE_EAST = 15950
PANEL_ROWS = (2200, 5000, 8800)
UP = (0, 0, 1)


def wall(block, origin, along, inwards, long, thickness, u_inner, rows, openings, layer_at):
    """A wall as its two skins and the reveals of its openings, cut on one grid so that corners always meet.

    @param u_inner   where the inner skin begins and ends (corners of outer walls are mitred)
    @param rows      heights at which the skins are cut; all sills and heads are among them
    @param openings  (u0, u1, z0, z1)
    @param layer_at  layer for a place along the wall
    """
    cuts = sorted({0, long} | {u for o in openings for u in o[:2]} | set(layer_at.cuts))

    def at(u, depth, z):
        return (origin[0] + along[0] * u + inwards[0] * depth, origin[1] + along[1] * u + inwards[1] * depth,
                origin[2] + z)

    def inner(u):
        return min(max(u, u_inner[0]), u_inner[1])

    def is_open(u, z):
        return any(o[0] < u < o[1] and o[2] < z < o[3] for o in openings)

    faces = {}
    for u0, u1 in zip(cuts, cuts[1:]):
        into = faces.setdefault(layer_at((u0 + u1) / 2), [])
        for z0, z1 in zip(rows, rows[1:]):
            u, z = (u0 + u1) / 2, (z0 + z1) / 2
            if not is_open(u, z):
                into.append((at(u0, 0, z0), at(u1, 0, z0), at(u1, 0, z1), at(u0, 0, z1)))
                i0, i1 = inner(u0), inner(u1)
                into.append((at(i1, thickness, z0), at(i0, thickness, z0), at(i0, thickness, z1),
                             at(i1, thickness, z1)))
                continue
            for other, a, b in (((u, z0 - 1), (u1, z0), (u0, z0)), ((u, z1 + 1), (u0, z1), (u1, z1)),
                                ((u0 - 1, z), (u0, z0), (u0, z1)), ((u1 + 1, z), (u1, z1), (u1, z0))):
                if not is_open(*other):
                    into.append((at(a[0], 0, a[1]), at(b[0], 0, b[1]), at(b[0], thickness, b[1]),
                                 at(a[0], thickness, a[1])))
    for layer, quads in faces.items():
        block.polyface(layer, quads)


class OneLayer:
    cuts = ()

    def __init__(self, layer):
        self.layer = layer

    def __call__(self, u):
        return self.layer


class AccentBetween:
    """The accent layer from cuts[0] to cuts[1], else the partition's."""

    def __init__(self, *cuts):
        self.cuts = cuts

    def __call__(self, u):
        return "A-WALL-ACNT" if self.cuts[0] < u < self.cuts[1] else "A-WALL-PRTN"


def outer_walls(block):
    rows_window = [SILL, HEAD, STOREY + SILL, STOREY + HEAD]
    both = [(z + SILL, z + HEAD) for z in (0, STOREY)]
    south = [(x - 1500, x + 1500, *z) for x in BAYS for z in both]
    south.remove((BAYS[ENTRANCE_BAY] - 1500, BAYS[ENTRANCE_BAY] + 1500, *both[0]))
    south.append((BAYS[ENTRANCE_BAY] - 1000, BAYS[ENTRANCE_BAY] + 1000, 0, 2500))
    north = [(x - 1200, x + 1200, *z) for x in BAYS for z in both]
    exit_from_east = LONG - BAYS[EXIT_BAY]  # u runs westwards on the north wall
    north.remove((exit_from_east - 1200, exit_from_east + 1200, *both[0]))
    north.append((exit_from_east - 500, exit_from_east + 500, 0, 2100))
    side = [(4100, 5900, *z) for z in both]
    sides = (
        ((0, 0), (1, 0), (0, 1), LONG, south, [2500]),
        ((LONG, 0), (0, 1), (-1, 0), DEEP, side, []),
        ((LONG, DEEP), (-1, 0), (0, -1), LONG, north, [2100]),
        ((0, DEEP), (0, -1), (1, 0), DEEP, [(DEEP - o[1], DEEP - o[0], o[2], o[3]) for o in side], []),
    )
    for start, along, inwards, long, openings, more_rows in sides:
        rows = sorted([-200, 0, PARAPET] + rows_window + more_rows)
        wall(block, (*start, 0), along, inwards, long, WALL, (WALL, long - WALL), rows, openings, OneLayer("A-WALL"))
    rim = [(0, 0), (LONG, 0), (LONG, DEEP), (0, DEEP)]
    hole = [(WALL, WALL), (LONG - WALL, WALL), (LONG - WALL, DEEP - WALL), (WALL, DEEP - WALL)]
    block.polyface("A-WALL", [tuple((*p, PARAPET) for p in (rim[i - 1], rim[i], hole[i], hole[i - 1]))
                              for i in range(4)])


def windows(block):
    wide = furniture.glazed_frame("WINDOW-3000", 3000, HEAD - SILL, 2, "A-GLAZ-FRAM", "A-GLAZ")
    middle = furniture.glazed_frame("WINDOW-2400", 2400, HEAD - SILL, 1, "A-GLAZ-FRAM", "A-GLAZ")
    narrow = furniture.glazed_frame("WINDOW-1800", 1800, HEAD - SILL, 1, "A-GLAZ-FRAM", "A-GLAZ")
    entrance = furniture.glazed_frame("ENTRANCE", 2000, 2500, 1, "A-DOOR-FRAM", "A-GLAZ", bar=90)
    shade = furniture.sunshade()
    for level in (0, STOREY):
        z = level + SILL
        for bay, x in enumerate(BAYS):
            if (level, bay) == (0, ENTRANCE_BAY):
                block.insert("A-GLAZ", entrance, (x - 1000, 0, 0))
            else:
                block.insert("A-GLAZ", wide, (x - 1500, 0, z))
                block.insert("A-SHAD", shade, (x - 1500, 0, z))
            if (level, bay) == (0, EXIT_BAY):
                block.insert("A-DOOR", furniture.exit_door(), (x + 500, DEEP, 0), 180)
            else:
                block.insert("A-GLAZ", middle, (x + 1200, DEEP, z), 180)
        block.insert("A-GLAZ", narrow, (LONG, 4100, z), 90)
        block.insert("A-GLAZ", narrow, (0, 5900, z), 270)


def level_quad(layer, block, x0, y0, x1, y1, z, facing_up):
    corners = ((x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z))
    block.face(layer, *(corners if facing_up else reversed(corners)))


def around_opening(x_cuts=()):
    """The inside of the building as rectangles that leave the stair opening out and share whole edges."""
    xs = sorted({WALL, OPENING[0], OPENING[2], LONG - WALL} | set(x_cuts))
    ys = [WALL, OPENING[1], OPENING[3], DEEP - WALL]
    for x0, x1 in zip(xs, xs[1:]):
        for y0, y1 in zip(ys, ys[1:]):
            if not (OPENING[0] <= x0 < OPENING[2] and y0 == OPENING[1]):
                yield x0, y0, x1, y1


def floors_and_ceilings(block):
    for x0, x1, layer in ((WALL, PARTITION_W, "A-FLOR"), (PARTITION_W, PARTITION_E, "A-FLOR-HALL"),
                          (PARTITION_E, LONG - WALL, "A-FLOR")):
        level_quad(layer, block, x0, WALL, x1, DEEP - WALL, 0, True)
    for x0, y0, x1, y1 in around_opening([OFFICE_EAST]):
        office = x1 <= OFFICE_EAST and y1 <= OPENING[1]
        level_quad("A-FLOR-OFFC" if office else "A-FLOR", block, x0, y0, x1, y1, STOREY, True)
    for x0, y0, x1, y1 in around_opening():
        level_quad("A-CLNG", block, x0, y0, x1, y1, CEILING, False)
        level_quad("S-SLAB", block, x0, y0, x1, y1, STOREY - 300, False)
    inside = (WALL, WALL, LONG - WALL, DEEP - WALL)
    level_quad("A-CLNG", block, *inside, STOREY + CEILING, False)
    level_quad("S-SLAB", block, *inside, ROOF - 200, False)
    level_quad("A-ROOF", block, *inside, ROOF, True)
    x0, y0, x1, y1 = OPENING
    rim = [(x0, y0), (x0, y1), (x1, y1), (x1, y0)]  # clockwise: the fascia faces into the opening
    block.polyface("A-CLNG-FASC", [((*a, CEILING), (*b, CEILING), (*b, STOREY), (*a, STOREY))
                                   for a, b in zip(rim[-1:] + rim, rim)])


def partitions(block, door):
    rows = [-20, 2100, CEILING + 50]  # ends are buried in floor and plenum
    west_doors = [(1800 - 250, 2700 - 250, -20, 2100), (8500 - 250, 9400 - 250, -20, 2100)]
    long = DEEP - 2 * WALL + 100  # both ends stand 50 mm inside the outer walls
    wall(block, (PARTITION_W + 50, WALL - 50, 0), (0, 1), (-1, 0), long, 100, (0, long), rows, west_doors,
         AccentBetween(2750, 7750))
    wall(block, (WALL - 50, 6950, 0), (1, 0), (0, 1), PARTITION_W - WALL + 30, 100, (0, PARTITION_W - WALL + 30), rows,
         [], OneLayer("A-WALL-PRTN"))
    east_long = LONG - WALL + 50 - PARTITION_E
    wall(block, (PARTITION_E, 6950, STOREY), (1, 0), (0, 1), east_long, 100, (0, east_long), rows, [],
         OneLayer("A-WALL-PRTN"))
    block.insert("A-DOOR", door, (PARTITION_W + 5, 1800, 0), 90)
    block.insert("A-DOOR", door, (PARTITION_W - 5, 9400, 0), 200)  # stands open into the northern meeting room
    for level, passages in ((0, (1,)), (STOREY, (4, 7))):
        glass_partition(block, level, passages)


def glass_partition(block, level, passages):
    """Posts 1260 mm apart with panes between them as lines with a height; a passage has no pane."""
    x, ys = PARTITION_E, [330 + 1260 * i for i in range(10)]
    for y in ys:
        block.box("A-GLAZ-FRAM", (x - 30, y - 30, level - 10), (x + 30, y + 30, level + CEILING + 10))
    for i, (y0, y1) in enumerate(zip(ys, ys[1:])):
        block.box("A-GLAZ-FRAM", (x - 25, y0 + 30, level + 2200), (x + 25, y1 - 30, level + 2250), omit="sn")
        block.records.append(Strip("A-GLAZ-PRTN", (x, y0 + 30, level + 2250), (x, y1 - 30, level + 2250), 550))
        if i not in passages:
            block.records.append(Strip("A-GLAZ-PRTN", (x, y0 + 30, level + 1), (x, y1 - 30, level + 1), 2199))


STEPS, RISE, GOING, STAIR_FOOT = 20, 175, 270, 14700
STAIR_Y = (9900, 11300)


def stairs(block):
    y0, y1 = STAIR_Y
    for i in range(STEPS - 1):
        east, west, z = STAIR_FOOT - GOING * i, STAIR_FOOT - GOING * (i + 1), RISE * (i + 1)
        under_east, under_west = max(0, RISE * (i - 2)), max(0, RISE * (i - 1))  # runs parallel to the treads
        block.face("A-FLOR-STRS", (east, y0, z - RISE), (east, y1, z - RISE), (east, y1, z), (east, y0, z))
        block.face("A-FLOR-STRS", (west, y0, z), (east, y0, z), (east, y1, z), (west, y1, z))
        block.face("A-FLOR-STRS", (west, y0, under_west), (east, y0, under_east), (east, y0, z), (west, y0, z))
        block.face("A-FLOR-STRS", (east, y1, under_east), (west, y1, under_west), (west, y1, z), (east, y1, z))
    block.face("A-FLOR-STRS", (STAIR_FOOT - 2 * GOING, y0, 0), (STAIR_FOOT - 2 * GOING, y1, 0),
               (OPENING[0], y1, RISE * (STEPS - 3)), (OPENING[0], y0, RISE * (STEPS - 3)))


def rail(block, start, end, radius):
    run = sub(end, start)
    block.cylinder("A-FLOR-HRAL", start, scaled(run, 1 / length(run)), radius, length(run))


def railings(block):
    for y in (STAIR_Y[0] + 40, STAIR_Y[1] - 40):
        for i in range(0, STEPS - 1, 3):
            block.cylinder("A-FLOR-HRAL", (STAIR_FOOT - GOING * i - 135, y, RISE * (i + 1) + 1), UP, 15, 890)
        foot, head = (STAIR_FOOT - 135, y, RISE + 920), (STAIR_FOOT - 135 - GOING * 18, y, RISE * 19 + 920)
        rail(block, foot, head, 25)
        for lower in (350, 630):
            rail(block, (foot[0], y, foot[2] - lower), (head[0], y, head[2] - lower), 8)
    x0, y0, x1, y1 = OPENING
    for i in range(7):
        block.cylinder("A-FLOR-HRAL", (x0 + 60 + 750 * i, y0 - 60, STOREY + 1), UP, 15, 970)
    for i in range(3):
        block.cylinder("A-FLOR-HRAL", (x1 + 60, y0 + 640 + 650 * i, STOREY + 1), UP, 15, 970)
    for height, radius in ((1000, 25), (700, 8), (400, 8)):
        rail(block, (x0 + 30, y0 - 60, STOREY + height), (x1 + 60, y0 - 60, STOREY + height), radius)
        rail(block, (x1 + 60, y0 - 30, STOREY + height), (x1 + 60, y1, STOREY + height), radius)


def columns(block):
    for level in (0, STOREY):
        for x in (4080, 12000, 19920):
            block.cylinder("S-COLS", (x, 7400, level - 20), UP, 200, CEILING + 40)


def reception(block):
    """A counter bent around its centre, open to the west: a body of lines and arcs, and a plate on it."""
    desk = Block("RECEPTION")
    desk.records.append(Bent("0", [(0, -2050, 1), (0, 2050, 0), (0, 1550, -1), (0, -1550, 0)], 1, 1057))
    desk.records.append(Band("0", (0, -1800), (0, 1800), 1, 640, 1060, 40))
    block.insert("I-FURN-RECP", desk, (9300, 5250, 0))
    block.cylinder("I-FURN-RUG", (13980, 6300, 1), UP, 1300, 4)


def furnish_ground(block, parts):
    for x, y, turn, mirrored in office_places([(19920, 2500)]) + office_places([(19920, 9300)]):
        place_desk(block, parts, x, y, 0, turn, mirrored)
    for y in (3600, 9400):
        meeting(block, parts, 4080, y, 0)
    block.insert("I-FURN-CHAR", parts["task_chair"], (9700, 5250, 0), 260)
    for x, y, turn in ((13980, 7900, 180), (15350, 6300, 90)):
        block.insert("I-FURN-SOFA", parts["sofa"], (x, y, 0), turn)
    block.insert("I-FURN", parts["round_table"], (13980, 6300, 5))


def furnish_upper(block, parts):
    for x, y, turn, mirrored in office_places([(x, 3500) for x in BAYS[:4]] + [(x, 8000) for x in BAYS[:2]]):
        place_desk(block, parts, x, y, STOREY, turn, mirrored)
    for y in (3600, 9400):
        meeting(block, parts, 19920, y, STOREY)
    block.insert("I-FURN-SOFA", parts["sofa"], (12500, 8000, STOREY), 180, (1.2, 1.2, 1.2))
    block.insert("I-FURN", parts["round_table"], (12500, 6800, STOREY), 0, (0.8, 0.8, 1.1))


def office_places(centres):
    """Four desks around each centre, people facing east and west; (x, y, turn, mirrored)."""
    places = []
    for x, y in centres:
        for dy, mirrored in ((-805, False), (805, True)):
            places.append((x - 805, y + dy, 270, mirrored))
            places.append((x + 805, y + dy, 90, not mirrored))
    return places


def place_desk(block, parts, x, y, level, turn, mirrored):
    block.insert("I-FURN", parts["desk"], (x, y, level), turn, (-1, 1, 1) if mirrored else (1, 1, 1))
    away, twist = (-1 if turn == 270 else 1), (15 if mirrored else -10)
    block.insert("I-FURN-CHAR", parts["task_chair"], (x + away * 450, y, level), turn + twist)


def meeting(block, parts, x, y, level):
    block.insert("I-FURN", parts["table"], (x, y, level))
    for i in (-1.5, -0.5, 0.5, 1.5):
        block.insert("I-FURN-CHAR", parts["visitor_chair"], (x + 700 * i, y - 750, level))
        block.insert("I-FURN-CHAR", parts["visitor_chair"], (x + 700 * i, y + 750, level), 180)


def luminaires(block):
    for level, name, as_solid in ((0, "PANEL-SOLID", True), (STOREY, "PANEL-FACE", False)):
        lamp = furniture.luminaire(name, as_solid)
        for x in BAYS:
            for y in PANEL_ROWS:
                block.insert("E-LITE-FRAM", lamp, (x, y, level + CEILING))


def site(block):
    level_quad("L-SITE", block, -18000, -26000, 42000, 14000, -150, True)
    level_quad("L-SITE-PAVE", block, 12500, -26000, 15460, -1600, -140, True)
    block.box("L-SITE-PAVE", (11900, -1550, -160), (16060, -1, -10), omit="d")
    trees = ((-11800, -8800, 0, (1, 1, 1)), (3500, -12500, 75, (1.3, 1.3, 1.3)), (21500, -10500, 140, (1, 1, 1.15)),
             (30500, -6000, 205, (1.2, 1.2, 1.2)), (-3800, 9500, 270, (1.4, 1.4, 1.4)),
             (33500, 6500, 330, (-1.3, 1.3, 1.5)))
    tree = furniture.tree()
    for x, y, turn, scale in trees:
        block.insert("L-PLNT-TREE", tree, (x, y, -150), turn, scale)


def annotation(block):
    texts = (("MEETING 1", 3000, 1200, 0), ("MEETING 2", 3000, 11000, 0), ("RECEPTION", 10500, 8600, 0),
             ("OFFICE EAST", 19000, 6000, 0), ("OPEN OFFICE", 6000, 5400, STOREY), ("MEETING 3", 19000, 1200, STOREY),
             ("MEETING 4", 19000, 11000, STOREY))
    for words, x, y, z in texts:
        block.note("A-ANNO-TEXT", "TEXT", words, (x, y, z), 250)
    for x in [0, *BAYS, LONG]:
        block.note("A-ANNO-GRID", "LINE", (x, -2500, 0), (x, DEEP + 1500, 0))
    for y in (0, DEEP):
        block.note("A-ANNO-GRID", "LINE", (-2500, y, 0), (LONG + 1500, y, 0))
    for x0, x1 in zip([0, *BAYS], [*BAYS, LONG]):
        block.note("A-ANNO-DIMS", "DIMENSION", (x0, 0), (x1, 0), (x0, -2000), 0)
    block.note("A-ANNO-DIMS", "DIMENSION", (0, 0), (0, DEEP), (-2000, 0), 90)
    for x0, x1, z in ((WALL, PARTITION_W - 50, 0), (PARTITION_W + 50, PARTITION_E, 0), (WALL, PARTITION_E, STOREY)):
        block.note("A-ANNO-AREA", "LWPOLYLINE", [(x0, WALL), (x1, WALL), (x1, 6900), (x0, 6900)], z)
    block.note("A-ANNO-SYMB", "CIRCLE", (-3000, -2250, 0), 750)
    block.note("A-ANNO-SYMB", "ARC", (8000, 1800, 0), 900, 0, 90)
    block.note("A-ANNO-SYMB", "ARC", (8000, 9400, 0), 900, 180, 270)
    for a, b in (((-3000, -3000), (-3000, -1500)), ((-3000, -1500), (-3200, -1900)), ((-3000, -1500), (-2800, -1900))):
        block.note("A-ANNO-SYMB", "LINE", (*a, 0), (*b, 0))


def office():
    """The whole drawing as one block."""
    model = Block("MODEL")
    parts = {"desk": furniture.desk(furniture.monitor(), furniture.drawers()), "task_chair": furniture.task_chair(),
             "visitor_chair": furniture.visitor_chair(), "table": furniture.table("TABLE", 3200, 1100),
             "round_table": furniture.round_table(), "sofa": furniture.sofa()}
    site(model)
    outer_walls(model)
    windows(model)
    floors_and_ceilings(model)
    partitions(model, furniture.door_leaf())
    stairs(model)
    railings(model)
    columns(model)
    reception(model)
    luminaires(model)
    furnish_ground(model, parts)
    furnish_upper(model, parts)
    annotation(model)
    return model
