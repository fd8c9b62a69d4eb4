"""Rules from names of layers to named materials of the engine's library."""

import difflib
import fnmatch


class LayerMap:
    """The last rule whose pattern matches decides; names are compared as typed, * is any run, ? one character.

    A pattern matches the whole name of a face's layer ("A-GLAZ/Glass panel") or any of its parts between slashes.
    """

    def __init__(self, rules, library):
        self._rules, self._library, self._hits = list(rules), library, [0] * len(rules)
        for pattern, material in self._rules:
            if material not in library:
                near = difflib.get_close_matches(material, library, 3) or sorted(library)[:3]
                raise ValueError(f"layer map: \"{pattern} = {material}\": there is no such material; near are {', '.join(near)}"
                                 if library else
                                 f"layer map: \"{pattern} = {material}\": the engine that knows the materials was not found")

    def material_for(self, name):
        """The library's material for a name, or None: as drawn."""
        found = None
        for number, (pattern, material) in enumerate(self._rules):
            if any(fnmatch.fnmatchcase(part, pattern) for part in (name, *name.split("/"))):
                self._hits[number] += 1
                found = self._library[material]
        return found

    def check(self):
        """@throws ValueError for a rule that no layer of the document matches"""
        for (pattern, material), hits in zip(self._rules, self._hits):
            if not hits:
                raise ValueError(f"layer map: \"{pattern} = {material}\" matches no layer of the document")
