"""Shapes of a drawing as plain records, with their exact areas and their facets.

Lengths are millimetres, z is up. A Block holds records in its own frame; an Insert places a block in another.
Nothing here knows a file format: dxf_writer, obj_writer and glb_writer do.
"""
import math
from dataclasses import dataclass, field


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scaled(a, factor):
    return (a[0] * factor, a[1] * factor, a[2] * factor)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(dot(a, a))


def unit(a):
    return scaled(a, 1 / length(a))


def area_vector(points):
    """Newell's rule, relative to the first corner: half the sum of the cross products of the edges."""
    total = (0.0, 0.0, 0.0)
    spokes = [sub(p, points[0]) for p in points]
    for a, b in zip(spokes[1:], spokes[2:]):
        total = add(total, cross(a, b))
    return scaled(total, 0.5)


def polygon_area(points):
    return length(area_vector(points))


def perpendicular_pair(axis):
    """Two unit vectors that make a right-handed frame with the axis."""
    helper = (0, 0, 1) if abs(axis[2]) < 0.9 else (1, 0, 0)
    first = unit(cross(helper, axis))
    return first, cross(axis, first)


class Placement:
    """An affine map: three columns and an origin."""

    def __init__(self, x=(1, 0, 0), y=(0, 1, 0), z=(0, 0, 1), origin=(0, 0, 0)):
        self.x, self.y, self.z, self.origin = x, y, z, origin

    def direction(self, v):
        return add(add(scaled(self.x, v[0]), scaled(self.y, v[1])), scaled(self.z, v[2]))

    def point(self, p):
        return add(self.origin, self.direction(p))

    def after(self, inner):
        """The map that applies `inner` first."""
        return Placement(self.direction(inner.x), self.direction(inner.y), self.direction(inner.z),
                         self.point(inner.origin))


def sides_for(radius):
    """Sides of the prism that stands for a cylinder in formats without curves: enough that the form is seen."""
    if radius <= 30:
        return 8
    return 16 if radius <= 150 else 48


@dataclass
class Face:
    """A triangle or a plane quadrilateral of its own (3DFACE)."""
    layer: str
    corners: tuple

    def facets(self):
        return [self.corners]

    def surfaces(self, place):
        return [polygon_area([place.point(p) for p in self.corners])]

    facet_error = 0.0


@dataclass
class Solid(Face):
    """A plane quadrilateral drawn as a filled area in its own plane (SOLID)."""


@dataclass
class Polyface:
    """Corners shared by triangles and plane quadrilaterals."""
    layer: str
    faces: list

    def facets(self):
        return self.faces

    def surfaces(self, place):
        return [polygon_area([place.point(p) for p in face]) for face in self.faces]

    facet_error = 0.0


@dataclass
class Strip:
    """A straight line raised by a height along z (LINE with thickness)."""
    layer: str
    start: tuple
    end: tuple
    height: float

    def facets(self):
        up = (0, 0, self.height)
        return [(self.start, self.end, add(self.end, up), add(self.start, up))]

    def surfaces(self, place):
        return [polygon_area([place.point(p) for p in self.facets()[0]])]

    facet_error = 0.0


@dataclass
class Cylinder:
    """A circle swept along its normal (CIRCLE with thickness): a side and two ends."""
    layer: str
    base: tuple
    axis: tuple  # unit vector
    radius: float
    length: float

    def facets(self):
        first, second = perpendicular_pair(self.axis)
        count = sides_for(self.radius)
        ring = []
        for i in range(count):
            angle = 2 * math.pi * i / count
            ring.append(add(self.base, add(scaled(first, self.radius * math.cos(angle)),
                                           scaled(second, self.radius * math.sin(angle)))))
        top = [add(p, scaled(self.axis, self.length)) for p in ring]
        sides = [(ring[i - 1], ring[i], top[i], top[i - 1]) for i in range(count)]
        return sides + [tuple(reversed(ring)), tuple(top)]

    def surfaces(self, place):
        first, second = perpendicular_pair(self.axis)
        u, v, along = place.direction(first), place.direction(second), place.direction(self.axis)
        assert abs(length(u) - length(v)) < 1e-9 and abs(dot(u, along)) < 1e-9, "the circle must stay a circle"
        radius = self.radius * length(u)
        end = math.pi * radius * radius
        return [2 * math.pi * radius * self.length * length(along), end, end]

    @property
    def facet_error(self):
        return self.radius * (1 - math.cos(math.pi / sides_for(self.radius)))


ARC_STEP = math.radians(5)  # of arcs in formats without curves


def arc_points(a, b, bulge, aside=0):
    """Points of a segment, both ends included; `aside` moves them to the right of the direction of travel."""
    if bulge == 0:
        along = unit((b[0] - a[0], b[1] - a[1], 0))
        return [(p[0] + along[1] * aside, p[1] - along[0] * aside) for p in (a, b)]
    centre, radius = arc_of(a, b, bulge)
    angle = 4 * math.atan(bulge)
    moved = radius + (aside if bulge > 0 else -aside)
    begin = math.atan2(a[1] - centre[1], a[0] - centre[0])
    steps = math.ceil(abs(angle) / ARC_STEP)
    turns = [begin + angle * i / steps for i in range(steps + 1)]
    return [(centre[0] + moved * math.cos(turn), centre[1] + moved * math.sin(turn)) for turn in turns]


@dataclass
class Bent:
    """A closed line of straight pieces and arcs raised by a height: bands without lid or floor (LWPOLYLINE)."""
    layer: str
    points: list  # (x, y, bulge); bulge = tan(arc angle / 4) of the segment that begins here
    elevation: float
    thickness: float

    def segments(self):
        return [(a[:2], b[:2], a[2]) for a, b in zip(self.points, self.points[1:] + self.points[:1])]

    def facets(self):
        quads = []
        for segment in self.segments():
            points = arc_points(*segment)
            quads += [wall_quad(p, q, self.elevation, self.thickness) for p, q in zip(points, points[1:])]
        return quads

    def surfaces(self, place):
        assert_unscaled(place)
        return [self.thickness * arc_length(*segment) for segment in self.segments()]

    @property
    def facet_error(self):
        return self.largest_radius() * (1 - math.cos(ARC_STEP / 2))

    def radii(self):
        return [arc_of(a, b, bulge)[1] for a, b, bulge in self.segments() if bulge]

    def largest_radius(self):
        return max(self.radii())

    def smallest_radius(self):
        return min(self.radii())


@dataclass
class Band:
    """An arc with a width and a height: a plate with two arcs and two straight ends (open LWPOLYLINE with width)."""
    layer: str
    start: tuple
    end: tuple
    bulge: float
    width: float
    elevation: float
    thickness: float

    def facets(self):
        right = arc_points(self.start, self.end, self.bulge, self.width / 2)
        left = arc_points(self.start, self.end, self.bulge, -self.width / 2)
        rim = right + left[::-1]
        quads = [wall_quad(rim[i - 1], rim[i], self.elevation, self.thickness) for i in range(len(rim))]
        lid = tuple((x, y, self.elevation + self.thickness) for x, y in rim)
        return quads + [lid, tuple((x, y, self.elevation) for x, y in reversed(rim))]

    def surfaces(self, place):
        assert_unscaled(place)
        middle, angle = arc_length(self.start, self.end, self.bulge), 4 * math.atan(abs(self.bulge))
        sides = [self.thickness * (middle + turn * angle * self.width / 2) for turn in (1, -1)]
        return sides + [self.thickness * self.width] * 2 + [self.width * middle] * 2

    @property
    def facet_error(self):
        return self.largest_radius() * (1 - math.cos(ARC_STEP / 2))

    def largest_radius(self):
        return arc_of(self.start, self.end, self.bulge)[1] + self.width / 2

    def smallest_radius(self):
        return arc_of(self.start, self.end, self.bulge)[1] - self.width / 2


def wall_quad(p, q, elevation, height):
    return ((*p, elevation), (*q, elevation), (*q, elevation + height), (*p, elevation + height))


def assert_unscaled(place):
    assert abs(length(place.x) - 1) < 1e-12 and abs(length(place.y) - 1) < 1e-12 and place.z == (0, 0, 1)


def arc_of(a, b, bulge):
    """Centre and radius of a bulged segment; positive bulges run counter-clockwise."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    chord = math.hypot(dx, dy)
    to_centre = (1 / bulge - bulge) / 4  # times the chord, to the left of it
    centre = ((a[0] + b[0]) / 2 - dy * to_centre, (a[1] + b[1]) / 2 + dx * to_centre)
    return centre, chord * (1 + bulge * bulge) / (4 * abs(bulge))


def arc_length(a, b, bulge):
    if bulge == 0:
        return math.hypot(b[0] - a[0], b[1] - a[1])
    return arc_of(a, b, bulge)[1] * 4 * math.atan(abs(bulge))


@dataclass
class Insert:
    """A block in place: scaled along its axes, turned about z, moved."""
    layer: str
    block: "Block"
    at: tuple
    turn_deg: float = 0
    scale: tuple = (1, 1, 1)

    def placement(self):
        quarter = {0: (1, 0), 90: (0, 1), 180: (-1, 0), 270: (0, -1)}
        angle = math.radians(self.turn_deg)
        c, s = quarter.get(self.turn_deg % 360, (math.cos(angle), math.sin(angle)))
        sx, sy, sz = self.scale
        return Placement((sx * c, sx * s, 0), (-sy * s, sy * c, 0), (0, 0, sz), self.at)


@dataclass
class Note:
    """What has no surface: kind is LINE, TEXT, ARC, CIRCLE, LWPOLYLINE or DIMENSION."""
    layer: str
    kind: str
    values: tuple


@dataclass
class Block:
    name: str
    records: list = field(default_factory=list)

    def face(self, layer, *corners):
        self.records.append(Face(layer, corners))

    def polyface(self, layer, faces):
        self.records.append(Polyface(layer, faces))

    def box(self, layer, low, high, omit=""):
        """@param omit  letters of the sides to leave out: w e s n d(own) u(p)"""
        (x0, y0, z0), (x1, y1, z1) = low, high
        sides = {
            "w": ((x0, y1, z0), (x0, y0, z0), (x0, y0, z1), (x0, y1, z1)),
            "e": ((x1, y0, z0), (x1, y1, z0), (x1, y1, z1), (x1, y0, z1)),
            "s": ((x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)),
            "n": ((x1, y1, z0), (x0, y1, z0), (x0, y1, z1), (x1, y1, z1)),
            "d": ((x0, y1, z0), (x1, y1, z0), (x1, y0, z0), (x0, y0, z0)),
            "u": ((x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)),
        }
        self.polyface(layer, [corners for side, corners in sides.items() if side not in omit])

    def cylinder(self, layer, base, axis, radius, long):
        self.records.append(Cylinder(layer, base, axis, radius, long))

    def insert(self, layer, block, at, turn_deg=0, scale=(1, 1, 1)):
        self.records.append(Insert(layer, block, at, turn_deg, scale))

    def note(self, layer, kind, *values):
        self.records.append(Note(layer, kind, values))


def expanded(block, place=Placement(), inherited="0"):
    """Every shape with inserts followed: (record, placement, layer). Layer 0 in a block takes the insert's layer."""
    for record in block.records:
        layer = inherited if record.layer == "0" else record.layer
        if isinstance(record, Insert):
            yield from expanded(record.block, place.after(record.placement()), layer)
        elif not isinstance(record, Note):
            yield record, place, layer


def blocks_of(block, found=None):
    """All blocks below this one, innermost first, each once."""
    found = {} if found is None else found
    for record in block.records:
        if isinstance(record, Insert) and record.block.name not in found:
            blocks_of(record.block, found)
            found[record.block.name] = record.block
    return found
