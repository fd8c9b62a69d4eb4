"""A small reader of scene folders, for tests: it shares nothing with what writes them except the PLY reader."""

import math
import pathlib
import urllib.parse

import numpy as np

from lightwell_bridge import ply

SURFACES = ("sphere", "bubble", "cylinder", "tube", "cone", "cup", "ring", "polygon", "mesh", "subdivision", "instance")


class Surface:
    """kind, name, modifier, numbers; a mesh has its file, matrix, areas and points in the model."""

    def __init__(self, modifier, kind, name, words, numbers, source, folder):
        self.modifier, self.kind, self.name, self.source = modifier, kind, name, source
        self.numbers, self.words = numbers, words
        if kind == "mesh":
            self._read_mesh(folder)

    def _read_mesh(self, folder):
        self.file = self.words[0]
        self.matrix = np.eye(4)
        if len(self.words) > 1:
            assert self.words[1] == "-affine" and len(self.words) == 14, self.words
            self.matrix[:3] = np.array([float(w) for w in self.words[2:]]).reshape(3, 4)
        self.mesh = ply.from_bytes((folder / self.file).read_bytes())
        self.face_areas = self.mesh.areas(self.matrix)
        names, indices = self.mesh.modifiers, self.mesh.face_modifiers
        self.face_names = [self.modifier] * len(self.mesh.sizes) if indices is None else [names[i] for i in indices]

    def area(self):
        n = self.numbers
        if self.kind == "mesh":
            return float(self.face_areas.sum())
        if self.kind in ("sphere", "bubble"):
            return 4 * math.pi * n[3] ** 2
        if self.kind == "ring":
            return math.pi * abs(n[7] ** 2 - n[6] ** 2)
        length = math.dist(n[:3], n[3:6])
        if self.kind in ("cylinder", "tube"):
            return 2 * math.pi * n[6] * length
        return math.pi * (n[6] + n[7]) * math.hypot(length, n[7] - n[6])

    def bounds(self):
        """Lowest and highest corner."""
        n = self.numbers
        if self.kind == "mesh":
            points = ply.transformed(self.mesh.vertices, self.matrix)
            return points.min(axis=0), points.max(axis=0)
        centre = np.array(n[:3])
        if self.kind in ("sphere", "bubble"):
            return centre - n[3], centre + n[3]
        if self.kind == "ring":
            return _disc(centre, np.array(n[3:6]), n[7])
        other = np.array(n[3:6])
        radii = (n[6], n[6]) if len(n) == 7 else (n[6], n[7])
        boxes = [_disc(c, other - centre, r) for c, r in zip((centre, other), radii)]
        return np.minimum(boxes[0][0], boxes[1][0]), np.maximum(boxes[0][1], boxes[1][1])


def _disc(centre, axis, radius):
    reach = radius * np.sqrt(np.maximum(0, 1 - (axis / np.linalg.norm(axis)) ** 2))
    return centre - reach, centre + reach


class Scene:
    """surfaces in order; modifiers name -> (kind, words, numbers); views, grids as lines."""

    def __init__(self, file):
        self.folder = pathlib.Path(file).parent
        self.surfaces, self.modifiers, self.views, self.grids, self.source = [], {}, {}, {}, None
        words = []
        for line in pathlib.Path(file).read_text().splitlines():
            if line.startswith("#@"):
                self._mark(line.split())
            elif line.strip() and line[0] not in "#!":
                words += line.split()
                words = self._take(words)
        assert not words, words

    def _mark(self, words):
        if words[0] == "#@from":
            self.source = decoded(words[1])
        elif words[0] == "#@view":
            self.views[decoded(words[1])] = words[2:]
        elif words[0] == "#@grid":
            self.grid = self.grids.setdefault(decoded(words[1]), {"size": words[2:], "sensors": [], "cells": []})
        elif words[0] == "#@grid-sensor":
            self.grid["sensors"].append([float(w) for w in words[1:]])
        elif words[0] == "#@grid-cells":
            self.grid["cells"] += [int(w) for w in words[1:]]

    def _take(self, words):
        """One primitive off the front, when it is whole."""
        if len(words) >= 4 and words[1] == "alias":
            self.modifiers[decoded(words[2])] = ("alias", [decoded(words[3])], [])
            return words[4:]
        at, lists = 3, []
        for _ in range(3):
            if len(words) <= at or len(words) < at + 1 + int(words[at]):
                return words
            lists.append(words[at + 1:at + 1 + int(words[at])])
            at += 1 + int(words[at])
        modifier, kind, name = decoded(words[0]), words[1], decoded(words[2])
        numbers = [float(w) for w in lists[2]]
        if kind in SURFACES or kind == "source":
            self.surfaces.append(Surface(modifier, kind, name, lists[0], numbers, self.source, self.folder))
            self.source = None
        else:
            self.modifiers[name] = (kind, lists[0], numbers)
        return words[at:]

    def of(self, path):
        """The surfaces of an object, and of the elements of an array of that path."""
        return [s for s in self.surfaces if s.source == path or (s.source or "").startswith(path + "/")]


def decoded(word):
    return urllib.parse.unquote(word)
