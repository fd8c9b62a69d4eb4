"""A reader of OpenEXR files of its own: one flat part, tiles, float channels, ZIP or no compression."""

import itertools
import struct
import zlib


def windows_and_pixels(data):
    """@return  dataWindow and displayWindow as (x0, y0, x1, y1), and {channel: {(x, y): four bytes}}"""
    magic, version = struct.unpack_from("<II", data)
    assert magic == 20000630 and version & 0xff == 2 and version & 0x200, "no tiled OpenEXR file"
    attributes, at = {}, 8
    while data[at]:
        name, at = _name(data, at)
        kind, at = _name(data, at)
        size = struct.unpack_from("<I", data, at)[0]
        attributes[name], at = data[at + 4:at + 4 + size], at + 4 + size
    window = struct.unpack("<4i", attributes["dataWindow"])
    side = struct.unpack_from("<I", attributes["tiles"])[0]
    channels = list(_channels(attributes["channels"]))
    columns, rows = ((window[i + 2] - window[i]) // side + 1 for i in (0, 1))
    pixels = {name: {} for name in channels}
    for offset in struct.unpack_from("<%dQ" % (columns * rows), data, at + 1):
        if offset:
            _read_tile(data, offset, window, side, channels, attributes["compression"][0], pixels)
    return window, struct.unpack("<4i", attributes["displayWindow"]), pixels


def _name(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def _channels(text):
    at = 0
    while text[at]:
        name, at = _name(text, at)
        assert struct.unpack_from("<I", text, at)[0] == 2, "channel %s is not float" % name
        at += 16
        yield name


def _read_tile(data, offset, window, side, channels, compression, pixels):
    column, row, _, _, size = struct.unpack_from("<5i", data, offset)
    x0, y0 = window[0] + column * side, window[1] + row * side
    width, height = min(side, window[2] - x0 + 1), min(side, window[3] - y0 + 1)
    packed = data[offset + 20:offset + 20 + size]
    values = _unpacked(packed) if compression in (2, 3) and size < 4 * width * height * len(channels) else packed
    at = 0
    for y in range(y0, y0 + height):
        for name in channels:
            for x in range(x0, x0 + width):
                pixels[name][x, y] = values[at:at + 4]
                at += 4


def _unpacked(packed):
    """Each byte is stored as its difference to the one before plus 128; even bytes first, then odd ones."""
    summed = bytes(itertools.accumulate(zlib.decompress(packed), lambda a, b: (a + b - 128) & 0xff))
    half = (len(summed) + 1) // 2
    values = bytearray(len(summed))
    values[0::2], values[1::2] = summed[:half], summed[half:]
    return bytes(values)
