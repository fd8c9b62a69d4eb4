#!/usr/bin/python3
"""Irradiance on the floor of the sphere room by brute force; prints the table of expected.json's `line`.

    reference.py [PATHS]      paths for each twelfth of the line; 4,000,000 by default, a few minutes

Paths leave the floor with cosine-distributed directions and collect radiance only where they meet a lamp: no light
is sampled, nothing is stored. Written apart from the engine; needs numpy.
"""
import json
import sys
import numpy as np

SIZE = np.array([10.0, 10.0, 4.0])
BALL, BALL_RADIUS, BALL_REFLECTANCE = np.array([6.0, 5.0, 1.2]), 1.0, 0.6
LAMPS = [(2.5, 2.5), (7.5, 2.5), (2.5, 7.5), (7.5, 7.5)]
HALF, LAMP_Z, TRAY_Z, TRAY_REFLECTANCE, LAMP_RADIANCE = 0.5, 3.2, 3.18, 0.5, 40.0
# reflectance of the low and high wall of each axis: west (red), east; south, north; floor, ceiling
WALLS = np.array([[[.6, .2, .2], [.5, .5, .5]], [[.5, .5, .5], [.5, .5, .5]], [[.4, .4, .4], [.8, .8, .8]]])
WEIGHTS = np.array([0.265, 0.670, 0.065])  # of the three channels in brightness
LUMENS_PER_WATT = 179
NUDGE_M = 1e-9
BOUNCES = 60
BATCH = 200_000  # paths followed together; a multiple of the ten sensors


def cosine_directions(normals, generator):
    """Unit vectors distributed as cosine about the normals: a point of the unit sphere moved by the normal."""
    z = generator.uniform(-1, 1, len(normals))
    turn = generator.uniform(0, 2 * np.pi, len(normals))
    r = np.sqrt(1 - z * z)
    ways = normals + np.stack([r * np.cos(turn), r * np.sin(turn), z], 1)
    return ways / np.maximum(np.linalg.norm(ways, axis=1, keepdims=True), 1e-300)


def first_hits(origins, ways):
    """@return  points, normals, reflectances (n x 3) and whether the lit side of a lamp was met"""
    count = np.arange(len(origins))
    with np.errstate(divide="ignore", invalid="ignore"):
        along = np.where(ways > 0, (SIZE - origins) / ways, np.where(ways < 0, -origins / ways, np.inf))
    axis = np.argmin(along, 1)
    distance, high = along[count, axis], (ways[count, axis] > 0).astype(int)
    normals = np.zeros_like(ways)
    normals[count, axis] = 1 - 2 * high
    reflectances, lit = WALLS[axis, high], np.zeros(len(origins), bool)
    from_centre = origins - BALL
    half_b = np.einsum("ij,ij->i", from_centre, ways)
    root = half_b ** 2 - np.einsum("ij,ij->i", from_centre, from_centre) + BALL_RADIUS ** 2
    to_ball = -half_b - np.sqrt(np.maximum(root, 0))
    met = (root > 0) & (to_ball > NUDGE_M) & (to_ball < distance)
    distance = np.where(met, to_ball, distance)
    normals[met] = (from_centre[met] + to_ball[met, None] * ways[met]) / BALL_RADIUS
    reflectances[met] = BALL_REFLECTANCE
    for height, is_lamp in ((LAMP_Z, True), (TRAY_Z, False)):
        with np.errstate(divide="ignore", invalid="ignore"):
            t = (height - origins[:, 2]) / ways[:, 2]
            x, y = origins[:, 0] + t * ways[:, 0], origins[:, 1] + t * ways[:, 1]
        over = np.zeros(len(origins), bool)
        for cx, cy in LAMPS:
            over |= (np.abs(x - cx) < HALF) & (np.abs(y - cy) < HALF)
        met = over & (t > NUDGE_M) & (t < distance)
        distance = np.where(met, t, distance)
        normals[met] = np.where(ways[met, 2:] > 0, -1.0, 1.0) * np.array([0, 0, 1.0])
        # The back of a lamp absorbs what little gets between lamp and tray.
        reflectances[met] = 0 if is_lamp else TRAY_REFLECTANCE
        lit = np.where(met, is_lamp & (ways[:, 2] < 0), lit)
    return origins + distance[:, None] * ways, normals, reflectances, lit


def irradiance(points, generator):
    """One path for each point; an estimate of the irradiance in W/m^2, brightness-weighted."""
    found = np.zeros(len(points))
    index = np.arange(len(points))
    kept = np.ones((len(points), 3))
    normals = np.tile([0.0, 0.0, 1.0], (len(points), 1))
    for _ in range(BOUNCES):
        ways = cosine_directions(normals, generator)
        points, normals, reflectances, lit = first_hits(points + NUDGE_M * normals, ways)
        found[index[lit]] += kept[lit] @ WEIGHTS * LAMP_RADIANCE * np.pi
        kept = kept * reflectances
        chance = np.minimum(kept.max(1) * 2, 1)  # end faint paths by chance, without bias
        goes_on = (generator.random(len(kept)) < chance) & ~lit & (chance > 0)
        index, kept = index[goes_on], kept[goes_on] / chance[goes_on, None]
        points, normals = points[goes_on], normals[goes_on]
        if len(index) == 0:
            break
    return found


def main(arguments):
    paths = int(arguments[0]) if arguments else 4_000_000
    generator = np.random.default_rng(1994)
    rows = []
    for part in range(12):
        # the ten sensors of this twelfth, in turn
        y = (10 * part + np.arange(BATCH) % 10 + 0.5) / 12
        points = np.stack([np.full(BATCH, 6.875), y, np.full(BATCH, 0.001)], 1)
        batches = [irradiance(points, generator) * LUMENS_PER_WATT for _ in range(-(-paths // BATCH))]
        found = np.concatenate(batches)
        rows.append({"sensors": [10 * part, 10 * part + 9], "mean_lx": round(float(found.mean()), 2),
                     "standard_error_lx": round(float(found.std() / np.sqrt(len(found))), 2)})
        print(rows[-1], file=sys.stderr)
    print(json.dumps(rows, indent=1))


if __name__ == "__main__":
    main(sys.argv[1:])
