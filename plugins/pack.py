#!/usr/bin/env python3
"""pack.py HOST OUTPUT_FOLDER: the add-on of a host with the bridge inside, as a folder and as a zip to install."""

import pathlib
import shutil
import sys
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
# Folder here, name of the package inside the zip.
HOSTS = {"blender": "lightwell", "freecad": "Lightwell"}
BRIDGE = "lightwell_bridge"
LEFT_OUT = shutil.ignore_patterns("__pycache__", "*.pyc", "tutorial*", "CMakeLists.txt")
# The same bytes every time.
STAMP = (2026, 1, 1, 0, 0, 0)


def pack(host, output):
    """Returns the zip; the same content as a folder stands beside it."""
    output = pathlib.Path(output)
    folder = output / host / HOSTS[host]
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(HERE / host, folder, ignore=LEFT_OUT)
    shutil.copytree(HERE / BRIDGE, folder / BRIDGE, ignore=LEFT_OUT)
    shutil.copy(HERE.parent / "LICENSE", folder / "LICENSE")
    archive = output / f"lightwell-{host}.zip"
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as out:
        for file in sorted(p for p in folder.rglob("*") if p.is_file()):
            entry = zipfile.ZipInfo(file.relative_to(folder.parent).as_posix(), STAMP)
            entry.external_attr = 0o644 << 16
            out.writestr(entry, file.read_bytes(), zipfile.ZIP_DEFLATED)
    return archive


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in (*HOSTS, "all"):
        sys.exit(f"{__doc__}\nHOST is one of {', '.join(HOSTS)}, or all")
    for chosen in HOSTS if sys.argv[1] == "all" else [sys.argv[1]]:
        print(pack(chosen, sys.argv[2]))
