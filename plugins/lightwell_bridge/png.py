"""PNG pictures of 8 bits a channel, for programs that show no others."""

import struct
import zlib

import numpy as np

_SIGNATURE = b"\x89PNG\r\n\x1a\n"


def encode(rgb):
    """The file of a picture: h x w x 3, encoded sRGB from 0 to 1, row 0 at the top; not a number becomes black."""
    bytes_ = np.round(255 * np.clip(np.nan_to_num(np.asarray(rgb, dtype=float)), 0, 1)).astype(np.uint8)
    height, width, channels = bytes_.shape
    if channels != 3:
        raise ValueError(f"a picture of {channels} channels, expected 3")
    rows = np.zeros((height, 1 + 3 * width), dtype=np.uint8)
    rows[:, 1:] = bytes_.reshape(height, -1)
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (_SIGNATURE + _chunk(b"IHDR", head) + _chunk(b"sRGB", b"\0") + _chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)) +
            _chunk(b"IEND", b""))


def size(path):
    """(width, height) of a file.

    @throws ValueError that names the file
    """
    with open(path, "rb") as file:
        head = file.read(24)
    if len(head) < 24 or head[:8] != _SIGNATURE:
        raise ValueError(f"{path}: no PNG picture")
    return struct.unpack(">II", head[16:24])


def _chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
