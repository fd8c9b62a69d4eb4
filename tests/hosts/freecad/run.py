#!/usr/bin/env python3
"""run.py SCRIPT CLASS [--installed] [--window]: one class of tests inside FreeCAD; status 77 (skipped) where it is not installed.

Without a screen: Qt draws off screen; with --window under Xvfb, where pictures of the window can be taken.
With --installed the packed workbench is unpacked where FreeCAD looks for it, as a user would; otherwise it is the source.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import zipfile

SKIPPED = 77
LONGEST_S = 570


def main(script, case, *options):
    with tempfile.TemporaryDirectory() as home:
        return start(script, case, options, home)


def start(script, case, options, home):
    """FreeCAD's status, with settings of its own in `home`."""
    window = "--window" in options
    program = shutil.which("freecad" if window else "freecadcmd")
    if program is None:
        print("skipped: FreeCAD is not installed (Debian: apt install freecad freecad-python3)")
        return SKIPPED
    folder = pathlib.Path(__file__).parent
    words = [program, str(folder / "start.py")]
    environment = dict(os.environ, LIGHTWELL_CASE=case, QTWEBENGINE_DISABLE_SANDBOX="1", PYTHONDONTWRITEBYTECODE="1",
                       FREECAD_USER_HOME=home, LIGHTWELL_SCRIPT=str(folder / script))
    if "--installed" in options:
        install(home)
        environment["LIGHTWELL_INSTALLED"] = "1"
    if window:
        if shutil.which("xvfb-run") is None:
            print("skipped: xvfb-run is not installed (Debian: apt install xvfb)")
            return SKIPPED
        words = ["xvfb-run", "-a", "-s", "-screen 0 1600x1000x24", *words]
        environment.update(QT_QPA_PLATFORM="xcb", LIBGL_ALWAYS_SOFTWARE="1")
    else:
        environment["QT_QPA_PLATFORM"] = "offscreen"
    done = subprocess.run(words, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, timeout=LONGEST_S, errors="replace", text=True)
    sys.stderr.write(done.stderr[-20000:])
    ran = any(line.startswith("Ran ") for line in done.stderr.splitlines())
    return done.returncode if ran else done.returncode or 1


def install(home):
    """Packs the workbench and unpacks the zip into Mod/."""
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "plugins"))
    from pack import pack
    with zipfile.ZipFile(pack("freecad", pathlib.Path(home) / "packed")) as archive:
        archive.extractall(pathlib.Path(home) / "Mod")


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
