"""Who may include whom: the order of the folders, USES, and outside headers behind HIDES."""

import pathlib
import re

from cmake_folders import read_folders, reach

INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')

# Folders in the order of includes: each includes only folders of an earlier row. `importers` and what casts light
# are two branches that never see each other.
BASE_ROWS = [
    {"engine/base"},
    {"engine/sampling", "engine/pictures", "engine/sky"},
    {"materials/functions", "materials/measured"},
    {"materials/patterns"},
    {"materials"},
    {"engine/scene"},
    {"engine/geometry"},
]
LIGHT_ROWS = [
    {"engine/accel"},
    {"engine/transport"},
    {"engine/sources", "engine/plan"},
    {"engine/direct", "engine/specular", "engine/ambient"},
    {"engine/simulate"},
    {"engine/control"},
]
IMPORT_ROWS = [
    {"importers"},
    {"importers/generators"},
    {"importers/dxf", "importers/obj", "importers/gltf", "importers/radiance", "importers/assimp",
     "importers/surfaces", "importers/export"},
    {"importers/formats"},
    {"importers/project"},
]
TOP_ROWS = [{"engine"}, {"plugins"}, {"tests", "samples"}]  # "engine" is engine/lightwell.h

# Outside headers, by the CMake package word that HIDES names. tests/unit get GTest from lightwell_test().
PACKAGES = {
    "embree3/": "embree",
    "tbb/": "TBB",
    "oneapi/": "TBB",
    "OpenEXR/": "OpenEXR",
    "Imf": "OpenEXR",
    "Imath/": "Imath",
    "Iex": "OpenEXR",
    "png.h": "PNG",
    "jpeglib.h": "JPEG",
    "nlohmann/": "nlohmann_json",
    "toml++/": "tomlplusplus",
    "fmt/": "fmt",
    "CLI/": "CLI11",
    "draco/": "draco",
    "meshoptimizer.h": "meshoptimizer",
    "pugixml.hpp": "pugixml",
    "tiny_gltf.h": "tinygltf",
    "OpenMesh/": "OpenMeshCore",
    "opensubdiv/": "OpenSubdiv",
    "assimp/": "assimp",
    "gtest/": "GTest",
    "rapidcheck": "rapidcheck",
}
# Packages of headers alone, without a target to name in HIDES: the folder that may include them.
HEADERS_ONLY = {"tinygltf": "gltf"}
SYSTEM = re.compile(
    r"^([a-z_0-9]+|sys/[a-z]+\.h|(malloc|unistd|fcntl|iconv|signal|poll|dlfcn|spawn|setjmp|immintrin|xmmintrin|pmmintrin|emmintrin|"
    r"stdio|stdlib|stdint|string|time|errno)\.h)$")


def _row_of(folder):
    """(branch, row): branch 0 base, 1 light, 2 import, 3 top; None when the folder has no place in the order."""
    for branch, rows in enumerate((BASE_ROWS, LIGHT_ROWS, IMPORT_ROWS, TOP_ROWS)):
        for row, folders in enumerate(rows):
            if folder in folders:
                return branch, row
    top = folder.split("/")[0]
    if top in ("plugins", "tests", "samples"):
        return _row_of(top)
    return _row_of("materials") if top == "materials" else None


def may_include(includer, included):
    """True when the order of folders allows `includer` to include a header of `included`."""
    if includer == included or includer.startswith("tests"):
        return True
    above, below = _row_of(includer), _row_of(included)
    if above is None or below is None:
        return False
    if above[0] == below[0]:
        return above[1] > below[1] or (above == below and above[0] == 3)
    return below[0] == 0 or above[0] == 3


def _owner(folder, folders_by_path):
    """The folder itself, or the nearest one above it that has a target: materials/library belongs to materials."""
    for candidate in (folder, *map(str, pathlib.PurePosixPath(folder).parents)):
        if candidate in folders_by_path:
            return candidate
    return folder


def _project_includes(folder, line_place, header, target, folders_by_path, uses_of):
    included = _owner(str(pathlib.PurePosixPath(header).parent), folders_by_path)
    if included.startswith("tests") and folder.startswith("tests"):
        return
    if not may_include(folder, included):
        yield f"{line_place}: {folder} may not include {included} (order of folders, README.md)"
    if target is None or included == folder or included == "engine":
        return
    name = folders_by_path.get(included)
    if name is None:
        yield f"{line_place}: {included} is no lightwell_library folder"
    elif not any(name in reach(used, uses_of) for used in target.uses):
        yield f"{line_place}: \"{header}\" needs {name} in USES of {target.name}"


def _outside_includes(line_place, header, is_header_file, target):
    package = next((p for prefix, p in PACKAGES.items() if header.startswith(prefix)), None)
    if package is None:
        if not SYSTEM.match(header):
            yield f"{line_place}: <{header}> is neither a standard header nor one of a known package"
        return
    if is_header_file and not (package == "GTest" and line_place.startswith("tests/")):
        yield f"{line_place}: <{header}> of {package} in a header; outside packages stay in .cpp files"
    if target is None or (target.is_test and package == "GTest") or HEADERS_ONLY.get(package) == target.name:
        return
    if not any(package.lower() in hidden.lower() for hidden in target.hides):
        yield f"{line_place}: <{header}> needs {package} in HIDES of {target.name}"


def _target_of(file, folder, targets):
    """The target that compiles the file; for headers and mains, the first of the folder."""
    mine = [t for t in targets if t.path == folder]
    for target in mine:
        if file.name in target.sources:
            return target
    return mine[0] if mine else None


def check_includes(root):
    """Yields one line for each include that points the wrong way or is not declared."""
    root = pathlib.Path(root)
    targets = read_folders(root)
    libraries = [t for t in targets if not t.is_test]
    folders_by_path = {t.path: t.name for t in libraries}
    uses_of = {t.name: t.uses for t in libraries}
    for top in ("engine", "materials", "importers", "plugins", "tests", "samples"):
        for file in sorted((root / top).rglob("*")):
            if file.suffix not in (".h", ".cpp"):
                continue
            folder = _owner(file.parent.relative_to(root).as_posix(), folders_by_path)
            target = _target_of(file, folder, targets)
            for number, line in enumerate(file.read_text(errors="replace").splitlines(), 1):
                match = INCLUDE.match(line)
                if not match:
                    continue
                place = f"{file.relative_to(root)}:{number}"
                if match[1] == '"':
                    yield from _project_includes(folder, place, match[2], target, folders_by_path, uses_of)
                else:
                    yield from _outside_includes(place, match[2], file.suffix == ".h", target)
