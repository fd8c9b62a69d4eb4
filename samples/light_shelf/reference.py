#!/usr/bin/python3
"""Illuminance along the depth of the room by brute force; prints expected.json.

    reference.py [PATHS]      paths for each sensor, with and without the shelf; 400,000 by default

Written apart from the engine: paths scatter from grey surfaces, pass or leave panes by chance, and meet the sky by
chance; the sun is looked for at each surface, straight on and by way of the mirror. Needs numpy. Left out: the sun
that panes throw back onto the ground (below 0.1 % inside).
"""
import json
import math
import sys

import numpy as np

import draw_light_shelf as drawing

NUDGE_M = 1e-7
BOUNCES = 100
BATCH = 100_000


class Room:
    def __init__(self, with_shelf, generator):
        self.generator = generator
        self.faces = [r for r in drawing.rectangles() if with_shelf or r[0] == "room"]
        names = [r[1] for r in self.faces]
        self.glass = np.array([name == "glass" for name in names] + [False])
        self.mirror = np.array([name == "mirror" for name in names] + [False])
        self.reflectance = np.array([drawing.REFLECTANCES.get(name, 0.0) for name in names] + [0.0])
        self.axis = np.array([r[2] for r in self.faces] + [0])

    def hits(self, points, ways):
        """@return  distances and numbers of the faces met first; the number of faces where there is none"""
        nearest, face = np.full(len(points), np.inf), np.full(len(points), len(self.faces))
        for number, (_, _, axis, at, first, second, _) in enumerate(self.faces):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            with np.errstate(divide="ignore", invalid="ignore"):
                t = (at - points[:, axis]) / ways[:, axis]
                a, b = points[:, u] + t * ways[:, u], points[:, v] + t * ways[:, v]
            met = (t > NUDGE_M) & (t < nearest) & (a > first[0]) & (a < first[1]) & (b > second[0]) & (b < second[1])
            nearest, face = np.where(met, t, nearest), np.where(met, number, face)
        return nearest, face

    def towards(self, points, ways):
        """Follows rays through panes. @return  share that passes, the face that ends them, the points there"""
        share, points, faces = np.ones(len(points)), points.copy(), np.full(len(points), len(self.faces))
        active = np.arange(len(points))
        while len(active):
            distance, face = self.hits(points[active], ways[active])
            faces[active] = face
            met = face < len(self.faces)
            points[active[met]] += distance[met, None] * ways[active[met]]
            active = active[self.glass[face]]
            share[active] *= pane(np.abs(ways[active, 1]))[0]
        return share, faces, points

    def sun_on(self, points, normals):
        """Irradiance from the sun, W/m^2, in units of its normal irradiance: straight on and by way of the mirror."""
        ways = self.sun_directions(len(points))
        found, cosines = np.zeros(len(points)), np.einsum("ij,ij->i", ways, normals)
        lit = np.flatnonzero(cosines > 0)
        share, face, _ = self.towards(points[lit], ways[lit])
        found[lit] += np.where(face == len(self.faces), share * cosines[lit], 0)
        if not self.mirror.any():
            return found
        down = ways * np.array([1, 1, -1])
        cosines = np.einsum("ij,ij->i", down, normals)
        near = np.flatnonzero((cosines > 0) & (points[:, 2] > drawing.SHELF_TOP))
        share, face, at = self.towards(points[near], down[near])
        seen = self.mirror[face]
        near, share, at = near[seen], share[seen], at[seen]
        rest, face, _ = self.towards(at, ways[near])
        reflected = drawing.MIRROR_REFLECTANCE * share * rest * cosines[near]
        found[near] += np.where(face == len(self.faces), reflected, 0)
        return found

    def sun_directions(self, count):
        u, turn = self.generator.random(count), self.generator.uniform(0, 2 * math.pi, count)
        sine = np.sqrt(u) * math.sin(math.radians(drawing.SUN_WIDTH / 2))
        axis = np.array(drawing.to_sun())
        aside = np.cross(axis, [0, 0, 1])
        aside /= np.linalg.norm(aside)
        other = np.cross(axis, aside)
        return (np.sqrt(1 - sine ** 2)[:, None] * axis + (sine * np.cos(turn))[:, None] * aside
                + (sine * np.sin(turn))[:, None] * other)


def pane(cosine):
    """Transmittance and reflectance of a pane for light without polarization, all passes inside summed."""
    n = drawing.GLASS_INDEX
    inside = np.sqrt(1 - (1 - cosine ** 2) / n ** 2)
    passed = drawing.GLASS_TRANSMISSIVITY ** (1 / inside)
    transmitted, reflected = 0, 0
    for surface in ((cosine - n * inside) / (cosine + n * inside), (inside - n * cosine) / (inside + n * cosine)):
        r = surface ** 2
        transmitted = transmitted + 0.5 * (1 - r) ** 2 * passed / (1 - (r * passed) ** 2)
        reflected = reflected + 0.5 * r * (1 + ((1 - r) * passed) ** 2 / (1 - (r * passed) ** 2))
    return transmitted, reflected


def cosine_directions(normals, generator):
    z, turn = generator.uniform(-1, 1, len(normals)), generator.uniform(0, 2 * math.pi, len(normals))
    r = np.sqrt(1 - z * z)
    ways = normals + np.stack([r * np.cos(turn), r * np.sin(turn), z], 1)
    return ways / np.maximum(np.linalg.norm(ways, axis=1, keepdims=True), 1e-300)


def illuminances(room, sensor, count):
    """One estimate for each path, lx."""
    generator = room.generator
    found, index = np.zeros(count), np.arange(count)
    points, normals = np.tile(np.array(sensor), (count, 1)), np.tile([0.0, 0.0, 1.0], (count, 1))
    found += drawing.SUN_NORMAL_LX * room.sun_on(points, normals)
    ways = cosine_directions(normals, generator)
    for _ in range(BOUNCES):
        distance, face = room.hits(points, ways)
        gone = face == len(room.faces)
        found[index[gone & (ways[:, 2] > 0)]] += drawing.SKY_LX
        index, points, ways, distance, face = (a[~gone] for a in (index, points, ways, distance, face))
        if len(index) == 0:
            break
        points = points + distance[:, None] * ways
        side = np.zeros_like(ways)
        rows = np.arange(len(index))
        side[rows, room.axis[face]] = -np.sign(ways[rows, room.axis[face]])
        through, back = pane(np.abs(ways[:, 1]))
        chance = generator.random(len(index))
        glass, mirror = room.glass[face], room.mirror[face] & (side[:, 2] > 0)
        turned = (glass & (chance >= through) & (chance < through + back)) | \
            (mirror & (chance < drawing.MIRROR_REFLECTANCE))
        ways[turned, room.axis[face][turned]] *= -1
        diffuse = ~glass & ~room.mirror[face]
        kept = turned | (glass & (chance < through)) | (diffuse & (chance < room.reflectance[face]))
        here = np.flatnonzero(diffuse)
        sun = room.sun_on(points[here] + NUDGE_M * side[here], side[here])
        found[index[here]] += drawing.SUN_NORMAL_LX * room.reflectance[face[here]] * sun
        ways[here] = cosine_directions(side[here], generator)
        points[here] += NUDGE_M * side[here]
        index, points, ways = index[kept], points[kept], ways[kept]
    return found


def rows_of(with_shelf, paths, generator):
    room = Room(with_shelf, generator)
    for sensor in drawing.sensors():
        found = np.concatenate([illuminances(room, sensor, BATCH) for _ in range(-(-paths // BATCH))])
        row = {"y_m": sensor[1], "mean_lx": round(float(found.mean()), 1),
               "standard_error_lx": round(float(found.std() / math.sqrt(len(found))), 1)}
        print(with_shelf, row, file=sys.stderr, flush=True)
        yield row


def main(arguments):
    paths = int(arguments[0]) if arguments else 400_000
    generator = np.random.default_rng(1994)
    print(json.dumps({
        "about": "Illuminance on line.txt by brute force (reference.py, %d paths for each sensor)" % paths,
        "unit": "lx",
        "with_shelf": list(rows_of(True, paths, generator)),
        "without_shelf": list(rows_of(False, paths, generator))}, indent=1))


if __name__ == "__main__":
    main(sys.argv[1:])
