"""OpenEXR pictures as numpy arrays: what the engine writes (scan lines or tiles, uncompressed or ZIP), and plain files."""

import os
import struct
import zlib

import numpy as np

_MAGIC = 20000630
_TILED = 0x200
_UNREADABLE = 0x800 | 0x1000  # deep data, several parts
_TYPES = {0: np.dtype("<u4"), 1: np.dtype("<f2"), 2: np.dtype("<f4")}
_LINES = {0: 1, 2: 1, 3: 16}  # scan lines of a block, by compression: none, ZIPS, ZIP
_MOST_PIXELS = 1 << 28
# What is read between two looks at the caller's check.
_CHUNK = 1 << 22


class Header:
    """channels: names in the order of the file; size: (width, height) of the data; attributes: name to raw bytes."""

    def __init__(self, attributes, tiled, end):
        self.attributes, self.tiled, self.end = attributes, tiled, end
        self.types = _channel_types(attributes["channels"])
        self.channels = list(self.types)
        self.compression = attributes["compression"][0]
        left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
        self.left, self.top = left, top
        self.size = (right - left + 1, bottom - top + 1)
        if self.size[0] <= 0 or self.size[1] <= 0 or self.size[0] * self.size[1] > _MOST_PIXELS:
            raise ValueError(f"a picture of {self.size[0]} x {self.size[1]} pixels")

    def text(self, name):
        return self.attributes[name].decode("utf-8", "replace") if name in self.attributes else None


def read_header(path):
    """@throws ValueError that names the file and what is wrong with it"""
    with open(path, "rb") as file:
        data = file.read(1 << 20)
    return _named(path, lambda: _parse_header(data))


def read(path, wanted=None, check=lambda: None):
    """(header, {channel: array [row][column], float32, row 0 at the top}); `wanted`: only these channels.

    check  called every few milliseconds; what it raises ends the reading
    """
    data = _bytes_of(path, check)
    return _named(path, lambda: _read(data, wanted, check))


def _bytes_of(path, check):
    with open(path, "rb", buffering=0) as file:
        data, at = bytearray(os.fstat(file.fileno()).st_size), 0
        while at < len(data):
            check()
            count = file.readinto(memoryview(data)[at:at + _CHUNK])
            if not count:
                break
            at += count
    return memoryview(data)[:at]


def _named(path, work):
    try:
        return work()
    except (ValueError, KeyError, struct.error, zlib.error, IndexError) as error:
        raise ValueError(f"{path}: no readable OpenEXR picture: {error}") from error


def _parse_header(data):
    magic, version = struct.unpack_from("<iI", data)
    if magic != _MAGIC:
        raise ValueError("it does not begin as one")
    if version & _UNREADABLE:
        raise ValueError("deep data or several parts are not read here")
    data = bytes(data[:1 << 20])  # a header is short
    at, attributes = 8, {}
    while data[at] != 0:
        end = data.index(b"\0", at)
        name = data[at:end].decode("latin-1")
        at = data.index(b"\0", end + 1) + 1
        size = struct.unpack_from("<i", data, at)[0]
        if not 0 <= size <= len(data) - at:
            raise ValueError(f"attribute {name} is cut off")
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return Header(attributes, bool(version & _TILED), at + 1)


def _channel_types(data):
    types, at = {}, 0
    while data[at] != 0:
        end = data.index(b"\0", at)
        types[data[at:end].decode("utf-8", "replace")] = _TYPES[struct.unpack_from("<i", data, end + 1)[0]]
        at = end + 17
    return types


def _read(data, wanted, check):
    header = _parse_header(data)
    if header.compression not in _LINES:
        raise ValueError(f"compression {header.compression} is not read here (none, ZIPS or ZIP)")
    names = header.channels if wanted is None else [n for n in header.channels if n in set(wanted)]
    width, height = header.size
    picture = {}
    for name in names:
        check()
        picture[name] = np.full((height, width), np.nan, dtype=np.float32)
    for x, y, across, down, block in _blocks(data, header):
        check()
        _spread(header, picture, x, y, across, down, block)
    return header, picture


def _blocks(data, header):
    """(column, row, width, height, bytes) of each block that the file has; those not yet written have offset 0."""
    width, height = header.size
    if header.tiled:
        tile = struct.unpack_from("<II", header.attributes["tiles"])
        count = -(-width // tile[0]) * -(-height // tile[1])
    else:
        lines = _LINES[header.compression]
        count = -(-height // lines)
    for offset in struct.unpack_from(f"<{count}Q", data, header.end):
        if offset == 0:
            continue
        if header.tiled:
            column, row, _, _, size = struct.unpack_from("<5i", data, offset)
            x, y, start = column * tile[0], row * tile[1], offset + 20
            across, down = min(tile[0], width - x), min(tile[1], height - y)
        else:
            row, size = struct.unpack_from("<2i", data, offset)
            x, y, start = 0, row - header.top, offset + 8
            across, down = width, min(lines, height - y)
        if size < 0 or start + size > len(data) or x < 0 or y < 0 or across <= 0 or down <= 0:
            raise ValueError("a block of pixels is cut off")
        yield x, y, across, down, data[start:start + size]


def _spread(header, picture, x, y, across, down, block):
    wanted = sum(kind.itemsize for kind in header.types.values()) * across * down
    if header.compression and len(block) != wanted:
        block = _unzip(block, wanted)
    if len(block) != wanted:
        raise ValueError(f"a block has {len(block)} bytes, expected {wanted}")
    kinds = set(header.types.values())
    if len(kinds) == 1:  # the engine's own
        rows = np.frombuffer(block, dtype=kinds.pop()).reshape(down, len(header.types), across)
        for i, name in enumerate(header.types):
            if name in picture:
                picture[name][y:y + down, x:x + across] = rows[:, i]
        return
    at = 0
    for row in range(y, y + down):
        for name, kind in header.types.items():
            if name in picture:
                picture[name][row, x:x + across] = np.frombuffer(block, dtype=kind, count=across, offset=at)
            at += across * kind.itemsize


def _unzip(block, wanted):
    """zlib, then differences of bytes, then the two halves interleaved."""
    raw = zlib.decompressobj().decompress(block, wanted)
    steps = np.frombuffer(raw, dtype=np.uint8).astype(np.int64)
    steps[1:] -= 128
    whole = (np.cumsum(steps) & 255).astype(np.uint8)
    result = np.empty_like(whole)
    half = (len(whole) + 1) // 2
    result[0::2], result[1::2] = whole[:half], whole[half:]
    return result.tobytes()


def to_bytes(channels, attributes=()):
    """An uncompressed float picture; `channels`: name to [row][column]; `attributes`: (name, text) pairs."""
    names = sorted(channels)
    height, width = np.shape(channels[names[0]])
    listed = b"".join(n.encode() + struct.pack("<x4i", 2, 0, 1, 1) for n in names) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    entries = [("channels", "chlist", listed), ("compression", "compression", b"\0"), ("dataWindow", "box2i", window),
               ("displayWindow", "box2i", window), ("lineOrder", "lineOrder", b"\0"),
               ("pixelAspectRatio", "float", struct.pack("<f", 1)), ("screenWindowCenter", "v2f", bytes(8)),
               ("screenWindowWidth", "float", struct.pack("<f", 1))]
    entries += [(name, "string", text.encode()) for name, text in attributes]
    head = struct.pack("<iI", _MAGIC, 2)
    for name, kind, value in entries:
        head += name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value
    head += b"\0"
    line = 8 + 4 * width * len(names)
    offsets = struct.pack(f"<{height}Q", *(len(head) + 8 * height + line * i for i in range(height)))
    pixels = np.stack([np.asarray(channels[n], dtype="<f4") for n in names], axis=1)  # row, channel, column
    rows = b"".join(struct.pack("<2i", i, line - 8) + pixels[i].tobytes() for i in range(height))
    return head + offsets + rows


def check_for_layer(path, layer, size):
    """The sentence that says why a host would show black in place of this picture, or None.

    The host wants channels named LAYER.Combined.R and exactly its size, and says nothing when they are not so.
    """
    try:
        header = read_header(path)
    except (OSError, ValueError) as error:
        return str(error)
    missing = [f"{layer}.Combined.{c}" for c in "RGBA" if f"{layer}.Combined.{c}" not in header.types]
    if missing:
        return f"{path}: the picture has no channel {missing[0]}; it has {', '.join(header.channels[:6])}"
    if header.size != tuple(size):
        return f"{path}: the picture has {header.size[0]} x {header.size[1]} pixels, expected {size[0]} x {size[1]}"
    return None
