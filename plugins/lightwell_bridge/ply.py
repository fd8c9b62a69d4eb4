"""Meshes of a scene folder: polygons with all their corners, as binary little endian PLY."""

import re

import numpy as np

from . import names

_NUMPY_TYPES = {"char": "i1", "uchar": "u1", "short": "<i2", "ushort": "<u2", "int": "<i4", "uint": "<u4",
                "float": "<f4", "double": "<f8", "int8": "i1", "uint8": "u1", "int16": "<i2", "uint16": "<u2",
                "int32": "<i4", "uint32": "<u4", "float32": "<f4", "float64": "<f8"}


class PlyMesh:
    """Polygons: face i has the next `sizes[i]` entries of `corners`, counter-clockwise as seen from its front.

    vertices   n x 3, metres
    modifiers  names; `face_modifiers[i]` is the index of the name of face i; without them the scene line says it
    uv         one pair a corner; `normals` one unit vector a corner
    edges, edge_sharpness      creases of a control cage (m x 2 vertices)
    points, point_sharpness    its sharp corners
    boundary   of a cage: "smooth" or "sharp_corners"; None: no cage
    """

    def __init__(self, vertices, sizes, corners, **more):
        self.vertices = np.ascontiguousarray(vertices, dtype="<f8").reshape(-1, 3)
        self.sizes = np.ascontiguousarray(sizes, dtype="<u4")
        self.corners = np.ascontiguousarray(corners, dtype="<u4")
        self.modifiers = list(more.pop("modifiers", []))
        self.face_modifiers = _array(more.pop("face_modifiers", None), "<u2", None)
        self.uv = _array(more.pop("uv", None), "<f4", 2)
        self.normals = _array(more.pop("normals", None), "<f4", 3)
        self.edges = _array(more.pop("edges", None), "<i4", 2)
        self.edge_sharpness = _array(more.pop("edge_sharpness", None), "<f4", None)
        self.points = _array(more.pop("points", None), "<i4", None)
        self.point_sharpness = _array(more.pop("point_sharpness", None), "<f4", None)
        self.boundary = more.pop("boundary", None)
        if more:
            raise TypeError(f"PlyMesh has no {sorted(more)}")
        self._check()

    @classmethod
    def of_faces(cls, vertices, faces, **more):
        """From a list of lists of vertex numbers."""
        return cls(vertices, [len(f) for f in faces], [v for f in faces for v in f], **more)

    def faces(self):
        """Arrays of vertex numbers, one a face."""
        return np.split(self.corners, np.cumsum(self.sizes)[:-1]) if len(self.sizes) else []

    def areas(self, matrix=None):
        """Area of each face, m2, of its vector area; `matrix` is 3 x 4 or 4 x 4."""
        points = self.vertices if matrix is None else transformed(self.vertices, matrix)
        if not len(self.sizes):
            return np.zeros(0)
        starts = np.cumsum(self.sizes.astype(np.int64)) - self.sizes
        first = np.repeat(points[self.corners[starts]], self.sizes, axis=0)
        rays = points[self.corners] - first
        following = np.arange(1, len(self.corners) + 1)
        following[starts + self.sizes - 1] = starts
        return np.linalg.norm(np.add.reduceat(np.cross(rays, rays[following]), starts, axis=0), axis=1) / 2

    def _check(self):
        if int(self.sizes.sum()) != len(self.corners):
            raise ValueError(f"faces want {int(self.sizes.sum())} corners, there are {len(self.corners)}")
        if len(self.sizes) and self.sizes.min() < 3:
            raise ValueError(f"a face has {int(self.sizes.min())} corners, expected at least 3")
        if len(self.corners) and self.corners.max() >= len(self.vertices):
            raise ValueError(f"a face names vertex {int(self.corners.max())} of {len(self.vertices)}")
        if not np.isfinite(self.vertices).all():
            raise ValueError("a vertex is no finite number")
        for what, array, wanted in (("modifier", self.face_modifiers, len(self.sizes)), ("uv", self.uv, len(self.corners)),
                                    ("normal", self.normals, len(self.corners))):
            if array is not None and len(array) != wanted:
                raise ValueError(f"{len(array)} entries of {what}, expected {wanted}")


def _array(values, dtype, width):
    if values is None:
        return None
    array = np.ascontiguousarray(values, dtype=dtype)
    return array if width is None else array.reshape(-1, width)


def transformed(points, matrix):
    """Points under a 3 x 4 or 4 x 4 matrix that acts on columns."""
    matrix = np.asarray(matrix, dtype=float)
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def to_bytes(mesh):
    """The whole file."""
    lines = ["ply", "format binary_little_endian 1.0"]
    lines += [f"comment modifier {i} {names.encoded(name)}" for i, name in enumerate(mesh.modifiers)]
    if mesh.boundary is not None:
        lines.append(f"comment boundary {mesh.boundary}")
    lines += [f"element vertex {len(mesh.vertices)}", *(f"property double {axis}" for axis in "xyz"),
              f"element face {len(mesh.sizes)}", "property list uint uint vertex_indices"]
    fields = [(mesh.corners.reshape(-1, 1), mesh.sizes, 1)]
    if mesh.face_modifiers is not None:
        lines.append("property ushort modifier")
        fields.append((mesh.face_modifiers.reshape(-1, 1), None, 1))
    for values, name, width in ((mesh.uv, "s_t", 2), (mesh.normals, "normals", 3)):
        if values is not None:
            lines.append(f"property list uint float {name}")
            fields.append((values, mesh.sizes, width))
    blocks = [mesh.vertices.tobytes(), _records(len(mesh.sizes), fields)]
    for element, ids, values, words in (("edge", mesh.edges, mesh.edge_sharpness, ("vertex1", "vertex2")),
                                        ("corner", mesh.points, mesh.point_sharpness, ("vertex",))):
        if ids is not None and len(ids):
            lines += [f"element {element} {len(ids)}", *(f"property int {word}" for word in words),
                      "property float sharpness"]
            record = np.dtype([("ids", "<i4", (len(words),)), ("sharpness", "<f4")])
            rows = np.zeros(len(ids), dtype=record)
            rows["ids"], rows["sharpness"] = ids.reshape(-1, len(words)), values
            blocks.append(rows.tobytes())
    return ("\n".join(lines) + "\nend_header\n").encode() + b"".join(blocks)


def _records(count, fields):
    """Rows of different length, interleaved without a loop: each field is (values, sizes or None, values a corner)."""
    lengths = np.zeros(count, dtype=np.int64)
    for values, sizes, width in fields:
        item = values.dtype.itemsize * width
        lengths += item if sizes is None else 4 + item * sizes.astype(np.int64)
    data, at = np.zeros(int(lengths.sum()), dtype=np.uint8), np.cumsum(lengths) - lengths
    for values, sizes, width in fields:
        item = values.dtype.itemsize * width
        raw = np.ascontiguousarray(values).view(np.uint8).reshape(-1, item)
        if sizes is None:
            data[at[:, None] + np.arange(item)] = raw
            at = at + item
            continue
        counts = (sizes * width).astype("<u4").view(np.uint8).reshape(-1, 4)
        data[at[:, None] + np.arange(4)] = counts
        wide = sizes.astype(np.int64)
        within = np.arange(len(raw)) - np.repeat(np.cumsum(wide) - wide, wide)
        data[(np.repeat(at + 4, wide) + within * item)[:, None] + np.arange(item)] = raw
        at = at + 4 + item * wide
    return data.tobytes()


def from_bytes(data):
    """Reads what to_bytes() wrote, and other binary little endian files of polygons."""
    end = data.find(b"end_header\n")
    if not data.startswith(b"ply") or end < 0:
        raise ValueError("no PLY file: the header is missing")
    header = data[:end].decode("utf-8").splitlines()
    if "format binary_little_endian 1.0" not in header:
        raise ValueError("a PLY file of another format than binary_little_endian 1.0")
    elements = []
    for words in (line.split() for line in header):
        if words[:1] == ["element"]:
            elements.append((words[1], int(words[2]), []))
        elif words[:1] == ["property"]:
            elements[-1][2].append(words[1:])
    at, tables = end + len(b"end_header\n"), {}
    for name, count, properties in elements:
        tables[name], at = _read_element(data, at, count, properties)
    return _mesh_of(tables, header)


def _read_element(data, at, count, properties):
    if all(p[0] != "list" for p in properties):
        record = np.dtype([(p[1], _NUMPY_TYPES[p[0]]) for p in properties])
        if at + count * record.itemsize > len(data):
            raise ValueError(f"the file ends within its {count} entries")
        return np.frombuffer(data, dtype=record, count=count, offset=at), at + count * record.itemsize
    columns = {p[-1]: [] for p in properties}
    for _ in range(count):
        for p in properties:
            length = 1
            if p[0] == "list":
                kind = np.dtype(_NUMPY_TYPES[p[1]])
                length, at = int(np.frombuffer(data, dtype=kind, count=1, offset=at)[0]), at + kind.itemsize
            kind = np.dtype(_NUMPY_TYPES[p[-2]])
            if at + length * kind.itemsize > len(data):
                raise ValueError(f"the file ends within its {count} faces")
            values = np.frombuffer(data, dtype=kind, count=length, offset=at)
            columns[p[-1]].append(values if p[0] == "list" else values[0])
            at += length * kind.itemsize
    return columns, at


def _mesh_of(tables, header):
    vertex, face = tables["vertex"], tables["face"]
    more = {}
    found = [re.fullmatch(r"comment modifier (\d+) (\S+)", line) for line in header]
    more["modifiers"] = [names.decoded(m[2]) for m in sorted((m for m in found if m), key=lambda m: int(m[1]))]
    for line in header:
        if line.startswith("comment boundary "):
            more["boundary"] = line.split()[2]
    if "modifier" in face:
        more["face_modifiers"] = face["modifier"]
    for name, key in (("s_t", "uv"), ("normals", "normals")):
        if name in face:
            more[key] = np.concatenate(face[name]) if face[name] else np.zeros(0)
    if "edge" in tables:
        edge = tables["edge"]
        more["edges"], more["edge_sharpness"] = np.column_stack([edge["vertex1"], edge["vertex2"]]), edge["sharpness"]
    if "corner" in tables:
        more["points"], more["point_sharpness"] = tables["corner"]["vertex"], tables["corner"]["sharpness"]
    polygons = face["vertex_indices"]
    return PlyMesh(np.column_stack([vertex[axis] for axis in "xyz"]), [len(p) for p in polygons],
                   np.concatenate(polygons) if polygons else [], **more)
