"""The engine's library of named materials."""

import json
import subprocess

SECONDS_TO_ANSWER = 30


class LibraryMaterial:
    """name, type (plastic, glass, light, ...), description, source of the numbers, reflectance (three channels)."""

    def __init__(self, entry):
        self.name, self.type, self.description = entry["name"], entry["type"], entry["description"]
        self.source, self.reflectance = entry["source"], entry["reflectance"]
        self.luminance = entry["luminance_cd_per_m2"]
        # `void TYPE NAME`, no words, no integers, then a count and the numbers.
        self.numbers = [float(v) for v in entry["text"].split()[6:]]


def read_library(engine):
    """{name: LibraryMaterial} as the engine at this path lists it.

    @throws ValueError with a sentence when it cannot be asked
    """
    try:
        answer = subprocess.run([str(engine), "materials", "--json"], capture_output=True, text=True, encoding="utf-8",
                                check=True, timeout=SECONDS_TO_ANSWER, stdin=subprocess.DEVNULL)
        return {entry["name"]: LibraryMaterial(entry) for entry in json.loads(answer.stdout)}
    except (OSError, subprocess.SubprocessError, ValueError, KeyError, TypeError) as error:
        raise ValueError(f"{engine} does not list its materials: {error}") from error


def add_library_material(folder, material, name):
    """Defines a material of the library in a scene folder under a name; returns whether it emits light."""
    folder.material(material.type, name, numbers=material.numbers)
    return material.luminance > 0
