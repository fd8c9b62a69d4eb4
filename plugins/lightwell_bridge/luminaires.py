"""Luminaires as photometric files (IES, EULUMDAT) measured them: the engine reads a file and writes it as a part."""

import hashlib
import json
import math
import pathlib
import subprocess

import numpy as np

from .engine import EngineError

SECONDS_TO_ANSWER = 60
# A tilt counts for lamps whose light depends on it, in tables of whole degrees.
TILT_STEP_DEG = 0.1
# An instance turns and moves a luminaire; its light knows no scale.
LEAST_AXIS = 1e-12


class Measured:
    """How one luminaire stands in the scene.

    file     IES or EULUMDAT
    matrix   4 x 4, metres: it shines along -z, plane 0 looks along +x; lengths of its axes do not count
    lumens   that leave it, in place of those of the file; factor on the light beside that
    colour   of the light in the engine's primaries, of luminance 1; None: white
    body_m   size of the body about the origin that must not stand in its light
    """

    def __init__(self, name, file, matrix, lumens=None, factor=1.0, colour=None, body_m=(0.0, 0.0, 0.0)):
        self.name, self.file, self.matrix = name, pathlib.Path(file), np.asarray(matrix, dtype=float)
        self.lumens, self.factor, self.colour, self.body_m = lumens, factor, colour, body_m


def add_measured(folder, engine, lamp, source=None):
    """Places the luminaire; returns (lumens that leave it, notes).

    @param engine  function that gives the engine's path; asked only when there is a file to read
    @throws ValueError for a file that is missing or cannot be read, in the engine's words; EngineError
    """
    if not lamp.file.is_file():
        raise ValueError(f"lamp \"{lamp.name}\": there is no photometric file {lamp.file}; correct the path or clear it")
    place = _turned(lamp)
    engine = engine()
    flux = float(_asked(engine, lamp, [])["lumens"])
    if not (flux > 0 and math.isfinite(lamp.factor) and lamp.factor > 0):
        raise ValueError(f"lamp \"{lamp.name}\": {flux * lamp.factor:g} lm, expected more than 0")
    share = lamp.factor if lamp.lumens is None else lamp.lumens / flux
    if not (math.isfinite(share) and share > 0):
        raise ValueError(f"lamp \"{lamp.name}\": {lamp.lumens} lm, expected more than 0")
    part, notes = _written(folder, engine, lamp, share, _tilt_deg(place))
    folder.instance(lamp.name, part, place, source, light=True)
    if lamp.lumens is None:
        notes.append(f"lamp \"{lamp.name}\": {lamp.file.name} has {flux:.0f} lm" +
                     (f", times {share:g}" if share != 1 else ""))
    return flux * share, notes


def _turned(lamp):
    """The matrix with axes of length 1, at right angles; mirrored where it was."""
    axes = lamp.matrix[:3, :3]
    up = axes[:, 2] / max(np.linalg.norm(axes[:, 2]), LEAST_AXIS)
    across = axes[:, 0] - up * np.dot(up, axes[:, 0])
    length = np.linalg.norm(across)
    if not (np.isfinite(lamp.matrix).all() and length > LEAST_AXIS and abs(np.linalg.norm(up) - 1) < 1e-6):
        raise ValueError(f"lamp \"{lamp.name}\": its scale is 0 or its place is no finite number")
    across = across / length
    second = np.cross(up, across) * (1 if np.linalg.det(axes) >= 0 else -1)
    return np.column_stack([across, second, up, lamp.matrix[:3, 3]])


def _tilt_deg(place):
    """Between straight down and where it shines."""
    return round(math.degrees(math.acos(min(max(place[2, 2], -1.0), 1.0))) / TILT_STEP_DEG) * TILT_STEP_DEG


def _asked(engine, lamp, words):
    """The engine's account of the file as JSON; `notes` are its sentences."""
    try:
        done = subprocess.run([str(engine), "luminaire", str(lamp.file), "--json", *words], capture_output=True, text=True,
                              encoding="utf-8", errors="replace", timeout=SECONDS_TO_ANSWER, stdin=subprocess.DEVNULL)
    except (OSError, subprocess.SubprocessError) as error:
        raise EngineError(f"{engine} does not read {lamp.file}: {error}") from error
    if done.returncode != 0:
        raise ValueError(f"lamp \"{lamp.name}\": {done.stderr.strip().removeprefix('lightwell: ')[-400:]}")
    try:
        return dict(json.loads(done.stdout), notes=[line for line in done.stderr.splitlines() if line])
    except ValueError as error:
        raise EngineError(f"{engine} says nothing that is known of {lamp.file}: {error}") from error


def _written(folder, engine, lamp, share, tilt_deg):
    """(file of the part, notes); equal luminaires share it."""
    listed = [",".join(repr(float(v)) for v in values) for values in (lamp.body_m, lamp.colour or (1, 1, 1))]
    tilt = math.radians(tilt_deg)
    words = [f"--body={listed[0]}", f"--colour={listed[1]}", f"--share={share!r}",
             f"--aim={math.sin(tilt)!r},0,{-math.cos(tilt)!r}"]
    digest = hashlib.sha256(lamp.file.read_bytes() + "\n".join(words).encode()).hexdigest()
    part = folder.luminaire(lamp.file.stem, digest)
    if (folder.path / part).is_file():
        return part, []
    return part, _asked(engine, lamp, ["--scene", str(folder.path / part), *words])["notes"]
