"""PNG pictures: read back by what the format itself says."""

import pathlib
import struct
import tempfile
import unittest
import zlib

import program
import numpy as np
from lightwell_bridge import png


def chunks(data):
    """(kind, content) of each part; its checksum must be right."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at = 8
    while at < len(data):
        length, = struct.unpack_from(">I", data, at)
        body = data[at + 4:at + 8 + length]
        assert struct.unpack_from(">I", data, at + 8 + length)[0] == zlib.crc32(body)
        yield body[:4], body[4:]
        at += 12 + length


class Png(unittest.TestCase):
    def test_pixels_are_those_of_the_picture(self):
        picture = np.random.default_rng(1).random((5, 7, 3))
        picture[0, 0] = (np.nan, -1, 2)
        parts = dict(chunks(png.encode(picture)))
        self.assertEqual(struct.unpack(">IIBBBBB", parts[b"IHDR"]), (7, 5, 8, 2, 0, 0, 0))
        rows = np.frombuffer(zlib.decompress(parts[b"IDAT"]), dtype=np.uint8).reshape(5, 22)
        self.assertEqual(rows[:, 0].tolist(), [0] * 5)
        pixels = rows[:, 1:].reshape(5, 7, 3)
        self.assertEqual(pixels[0, 0].tolist(), [0, 0, 255])
        self.assertLessEqual(float(np.abs(pixels[1:] / 255 - picture[1:]).max()), 0.5 / 255 + 1e-9)

    def test_the_size_is_read_and_other_files_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.png"
            path.write_bytes(png.encode(np.zeros((5, 7, 3))))
            self.assertEqual(png.size(path), (7, 5))
            path.write_bytes(b"GIF89a")
            with self.assertRaisesRegex(ValueError, "a.png: no PNG picture"):
                png.size(path)

    def test_a_picture_of_other_channels_is_refused(self):
        with self.assertRaisesRegex(ValueError, "4 channels, expected 3"):
            png.encode(np.zeros((2, 2, 4)))


if __name__ == "__main__":
    program.run()
