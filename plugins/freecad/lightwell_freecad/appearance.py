"""Colours of a document: from its view providers, or without a user interface from the file it was saved to."""

import struct
import xml.etree.ElementTree
import zipfile

# Colours closer than this are one: FreeCAD keeps 8 bits a channel.
_SAME_COLOUR = 0.5 / 255


class Appearance:
    """Answers the same with and without a window; knows nothing of documents that were never saved with one."""

    def __init__(self, document):
        self._saved = {}
        if not any(o.ViewObject is not None for o in document.Objects) and document.FileName:
            self._saved = _saved_colours(document.FileName)

    def known(self, obj):
        return obj.ViewObject is not None or obj.Name in self._saved

    def face_colours(self, obj, count):
        """(red, green, blue, transparency) of each face when they differ, else None."""
        if obj.ViewObject is not None:
            colours = [tuple(c) for c in getattr(obj.ViewObject, "DiffuseColor", None) or []]
        else:
            colours = self._saved.get(obj.Name, {}).get("DiffuseColor", [])
        if len(colours) != count or count < 2:
            return None
        differ = any(abs(a - b) > _SAME_COLOUR for c in colours for a, b in zip(c, colours[0]))
        return colours if differ else None

    def object_colour(self, obj):
        """((red, green, blue), transparency) of the whole object, else None."""
        if obj.ViewObject is not None:
            rgb = getattr(obj.ViewObject, "ShapeColor", None)
            transparency = getattr(obj.ViewObject, "Transparency", 0)
        else:
            saved = self._saved.get(obj.Name, {})
            rgb, transparency = saved.get("ShapeColor"), saved.get("Transparency", 0)
        return None if rgb is None else (tuple(rgb[:3]), transparency / 100)


def _saved_colours(file):
    """Name of an object -> its colours, from the part of a .FCStd file that belongs to the user interface."""
    found = {}
    try:
        with zipfile.ZipFile(file) as archive:
            if "GuiDocument.xml" not in archive.namelist():
                return {}
            root = xml.etree.ElementTree.fromstring(archive.read("GuiDocument.xml"))
            for provider in root.iter("ViewProvider"):
                found[provider.get("name")] = _colours_of(provider, archive)
    except (OSError, zipfile.BadZipFile, xml.etree.ElementTree.ParseError, KeyError, struct.error):
        return {}
    return found


def _colours_of(provider, archive):
    values = {}
    for entry in provider.iter("Property"):
        name = entry.get("name")
        if name == "ShapeColor" and entry.find("PropertyColor") is not None:
            values[name] = _unpacked(int(entry.find("PropertyColor").get("value")))
        elif name == "Transparency" and entry.find("Integer") is not None:
            values[name] = int(entry.find("Integer").get("value"))
        elif name == "DiffuseColor" and entry.find("ColorList") is not None and entry.find("ColorList").get("file"):
            data = archive.read(entry.find("ColorList").get("file"))
            count = struct.unpack_from("<I", data)[0]
            values[name] = [_unpacked(c) for c in struct.unpack_from(f"<{count}I", data, 4)]
    return values


def _unpacked(value):
    return tuple(((value >> shift) & 255) / 255 for shift in (24, 16, 8, 0))
