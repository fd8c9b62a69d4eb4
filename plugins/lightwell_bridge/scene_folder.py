"""A scene folder: scene.rad in the scene language, parts/ with meshes, textures/ with pictures, luminaires/ as measured.

    folder = SceneFolder("/tmp/job")
    folder.material("plastic", "Oak", numbers=(0.4, 0.28, 0.15, 0, 0))
    folder.alias("Furniture: Oak", "Oak")
    part = folder.part("desk", PlyMesh.of_faces(...))
    folder.mesh("Furniture: Oak", "Desk 01", part, matrix, source="Furniture/Desk 01")
    folder.save()

Names are as the host has them; they become words of the language here. Files that stay the same are not written
again, so that an engine that holds the scene sees what has changed.
"""

import hashlib
import math
import os
import pathlib
import shutil

from . import names, ply

SCENE = "scene.rad"
PARTS, TEXTURES, LUMINAIRES = "parts", "textures", "luminaires"

# What a surface of the scene language takes: the count of its numbers (a polygon takes any multiple of 3 from 9 on).
_SURFACES = {"sphere": 4, "bubble": 4, "cylinder": 7, "tube": 7, "cone": 8, "cup": 8, "ring": 8, "source": 4,
             "polygon": None}


class SceneFolder:
    """Collects the text; save() writes it."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        for folder in (self.path, self.path / PARTS, self.path / TEXTURES, self.path / LUMINAIRES):
            folder.mkdir(parents=True, exist_ok=True)
        self._head, self._modifiers, self._lights, self._surfaces, self._marks = [], [], [], [], []
        self._files, self._known, self._part_names = set(), {}, {}

    # --- modifiers

    def comment(self, text):
        """A line for people, at the head of the scene."""
        self._head.append("# " + " ".join(text.split()))

    def material(self, kind, name, numbers=(), words=(), modifier="void"):
        """A material, pattern, texture or mixture. `words` are written as they are; encode names among them.

        An equal definition of a known name is ignored, another one is an error.
        """
        _finite(numbers, f"{kind} \"{name}\"")
        self._define(name, _primitive(modifier, kind, name, words, numbers))

    def alias(self, layer, material):
        """What stands in a face's place for layer and material means this material, with its pattern (`inherit`)."""
        self._define(layer, f"inherit alias {names.encoded(layer)} {names.encoded(material)}\n")

    def knows(self, name):
        return name in self._known

    def _define(self, name, text):
        if name == "void" or self._known.setdefault(name, text) != text:
            raise ValueError(f"the name \"{name}\" stands for two different modifiers")
        if text not in self._modifiers:
            self._modifiers.append(text)

    # --- surfaces

    def part(self, wanted, mesh):
        """Writes one prototype; returns the file to name in mesh() and subdivision(). Equal meshes share a file."""
        data = ply.to_bytes(mesh)
        digest = hashlib.sha256(data).hexdigest()
        if digest not in self._part_names:
            file = f"{PARTS}/{_file_stem(wanted)}-{digest[:12]}.ply"
            self._write(file, data)
            self._part_names[digest] = file
        return self._part_names[digest]

    def part_text(self, wanted, text):
        """A prototype of several surfaces as scene text, for instance()."""
        digest = hashlib.sha256(text.encode()).hexdigest()
        file = f"{PARTS}/{_file_stem(wanted)}-{digest[:12]}.rad"
        self._write(file, text.encode())
        return file

    def texture(self, wanted, data, suffix):
        """A picture; returns the file to name in a pattern."""
        file = f"{TEXTURES}/{_file_stem(wanted)}-{hashlib.sha256(data).hexdigest()[:12]}{suffix}"
        self._write(file, data)
        return file

    def luminaire(self, wanted, digest):
        """The file, named after the digest of its content, that the engine writes a luminaire to; save() keeps it."""
        file = f"{LUMINAIRES}/{_file_stem(wanted)}-{digest[:12]}.rad"
        self._files.add(file)
        return file

    def file(self, name, data):
        """Another file of the folder, for instance a sky that the text refers to."""
        self._write(name, data)

    def mesh(self, modifier, name, part, matrix=None, source=None):
        """Polygons of a part, moved by a 3 x 4 or 4 x 4 matrix; `source` is the path of the object in the host."""
        self._place("mesh", modifier, name, part, matrix, source, ())

    def subdivision(self, modifier, name, part, chord_tolerance_m, matrix=None, source=None):
        """The Catmull-Clark limit surface of a part that is a control cage."""
        self._place("subdivision", modifier, name, part, matrix, source, (chord_tolerance_m,))

    def instance(self, name, part, matrix=None, source=None, light=False):
        """A prototype of scene text."""
        self._place("instance", "void", name, part, matrix, source, (), light)

    def surface(self, modifier, kind, name, numbers, source=None, light=False):
        """A polygon, sphere, bubble, cylinder, tube, cone, cup, ring or source."""
        text = surface_text(modifier, kind, name, numbers)
        (self._lights if light else self._surfaces).append(_from(source) + text)

    def text(self, text, light=False):
        """Lines of the language, as they are."""
        (self._lights if light else self._surfaces).append(text.rstrip("\n") + "\n")

    def _place(self, kind, modifier, name, part, matrix, source, numbers, light=False):
        words = [part] + transform_words(matrix)
        (self._lights if light else self._surfaces).append(_from(source) + _primitive(modifier, kind, name, words, numbers))

    # --- views and grids

    def view(self, name, words):
        """A view in the words of the command line, as one text."""
        self._marks.append(f"#@view {names.encoded(name)} {words}\n")

    def grid(self, name, sensors, rows, columns, spacing_m, cells=()):
        """Sensors (x y z nx ny nz each); `cells` has the sensor's number for each cell of rows x columns, -1 for none."""
        lines = [f"#@grid {names.encoded(name)} {rows} {columns} {number(spacing_m)}"]
        for sensor in sensors:
            _finite(sensor, f"grid \"{name}\"")
            lines.append("#@grid-sensor " + " ".join(number(v) for v in sensor))
        step = max(columns, 1)
        lines += ["#@grid-cells " + " ".join(str(c) for c in cells[i:i + step]) for i in range(0, len(cells), step)]
        self._marks.append("\n".join(lines) + "\n")

    # --- files

    def save(self):
        """Writes scene.rad and removes parts and pictures that nothing names any more; returns its path."""
        chapters = (["# Lengths in metres, z up\n"] + [line + "\n" for line in self._head], self._marks,
                    self._modifiers, self._lights, self._surfaces)
        self._write(SCENE, "\n".join("".join(chapter) for chapter in chapters if chapter).encode())
        for folder in (PARTS, TEXTURES):
            for file in (self.path / folder).iterdir():
                if file.is_file() and f"{folder}/{file.name}" not in self._files:
                    file.unlink()
        for entry in (self.path / LUMINAIRES).iterdir():  # NAME.rad and NAME.parts/
            if f"{LUMINAIRES}/{entry.stem}.rad" not in self._files:
                shutil.rmtree(entry) if entry.is_dir() else entry.unlink()
        return self.path / SCENE

    def _write(self, file, data):
        self._files.add(file)
        path = self.path / file
        if path.is_file() and path.stat().st_size == len(data) and path.read_bytes() == data:
            return
        temporary = path.with_name(path.name + ".part")
        temporary.write_bytes(data)
        os.replace(temporary, path)


def surface_text(modifier, kind, name, numbers):
    """One surface as text.

    @throws ValueError when the count of numbers is not what the kind takes
    """
    if kind not in _SURFACES:
        raise ValueError(f"\"{kind}\" is no surface of the scene language")
    wanted = _SURFACES[kind]
    if (len(numbers) != wanted) if wanted else (len(numbers) < 9 or len(numbers) % 3):
        raise ValueError(f"{kind} \"{name}\" has {len(numbers)} numbers, expected {wanted or '9, 12, 15, ...'}")
    _finite(numbers, f"{kind} \"{name}\"")
    return _primitive(modifier, kind, name, (), numbers)


def transform_words(matrix):
    """`-affine` and its 12 numbers, row by row; nothing for no matrix or the identity."""
    if matrix is None:
        return []
    rows = [[float(v) for v in row[:4]] for row in list(matrix)[:3]]
    _finite([v for row in rows for v in row], "a transform")
    if rows == [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]:
        return []
    return ["-affine"] + [number(v) for row in rows for v in row]


def number(value):
    """The shortest text that reads back as the same double."""
    value = float(value)
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)


def _finite(numbers, what):
    if not all(math.isfinite(v) for v in numbers):
        raise ValueError(f"{what}: a number is not finite")


def _primitive(modifier, kind, name, words, numbers):
    head = f"{_modifier(modifier)} {kind} {names.encoded(name)}\n"
    return head + _list(words) + "0\n" + _list([number(v) for v in numbers])


def _modifier(name):
    return "void" if name == "void" else names.encoded(name)


def _list(words):
    return f"{len(words)} {' '.join(str(w) for w in words)}".rstrip() + "\n"


def _from(source):
    return "" if source is None else f"#@from {names.encoded(source)}\n"


def _file_stem(name):
    """Letters, digits and dashes of a name: no blank or umlaut of a model reaches a path."""
    stem = "".join(c if c.isascii() and c.isalnum() else "-" for c in name).strip("-")
    return stem[:40] or "part"
