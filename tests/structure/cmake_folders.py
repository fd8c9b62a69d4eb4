"""The folders of the source tree as their CMakeLists.txt declare them: target, USES and HIDES."""

import pathlib
import re
from dataclasses import dataclass, field

CALL = re.compile(r"\b(lightwell_library|lightwell_test)\s*\(([^)]*)\)")
KEYWORDS = ("SOURCES", "USES", "HIDES", "LABEL")


@dataclass
class Folder:
    """One call of lightwell_library or lightwell_test."""

    path: str  # relative to the root, "engine/scene"
    name: str  # "scene"
    is_test: bool
    sources: list = field(default_factory=list)
    uses: list = field(default_factory=list)
    hides: list = field(default_factory=list)


def _without_comments(text):
    return re.sub(r"#.*", "", text)


def _words_by_keyword(arguments):
    lists, current = {"": []}, ""
    for word in arguments.split():
        if word in KEYWORDS:
            current = word
            lists.setdefault(word, [])
        else:
            lists[current].append(word)
    return lists


def read_folders(root):
    """All declared folders, in no particular order; several targets of one folder are several entries."""
    root = pathlib.Path(root)
    found = []
    for top in ("engine", "materials", "importers", "plugins", "tests"):
        for listfile in sorted((root / top).rglob("CMakeLists.txt")):
            folder = listfile.parent.relative_to(root).as_posix()
            for call, arguments in CALL.findall(_without_comments(listfile.read_text())):
                lists = _words_by_keyword(arguments)
                if not lists[""] or lists[""][0].startswith("$") or lists[""][0] == "name":
                    continue
                found.append(Folder(folder, lists[""][0], call == "lightwell_test", lists.get("SOURCES", []),
                                    lists.get("USES", []), lists.get("HIDES", [])))
    return found


def reach(name, uses_of):
    """The names that `name` reaches through USES, itself included."""
    reached, open_names = set(), [name]
    while open_names:
        current = open_names.pop()
        if current not in reached:
            reached.add(current)
            open_names.extend(uses_of.get(current, ()))
    return reached
