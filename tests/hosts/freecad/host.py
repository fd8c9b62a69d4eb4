"""What tests inside FreeCAD share: finding the packages and the fixtures, running, leaving."""

import faulthandler
import os
import pathlib
import subprocess
import sys
import unittest

# In a window FreeCAD puts its report view in the place of sys.stderr.
ERRORS = open(2, "w", buffering=1, closefd=False)
faulthandler.enable(ERRORS)
ROOT = pathlib.Path(__file__).resolve().parents[3]
SHARED = pathlib.Path(os.environ.get("LIGHTWELL_SHARED") or ROOT.parent / "shared")
BUILDING = SHARED / "fixtures" / "hosts" / "freecad_building" / "building.FCStd"

for folder in (ROOT / "plugins", ROOT / "plugins" / "freecad", pathlib.Path(__file__).parent):
    # An installed workbench is found by FreeCAD itself.
    if folder.name == "freecad" and "tests" in folder.parts or "LIGHTWELL_INSTALLED" not in os.environ:
        sys.path.insert(0, str(folder))


def show_main_window():
    """View providers, hence colours, also without a screen (QT_QPA_PLATFORM=offscreen)."""
    import FreeCADGui
    FreeCADGui.showMainWindow()


def serves():
    """Whether LIGHTWELL_ENGINE names an engine that speaks to hosts."""
    engine = os.environ.get("LIGHTWELL_ENGINE")
    if not engine:
        return False
    done = subprocess.run([engine, "serve"], input="", capture_output=True, text=True, timeout=60)
    return '"hello"' in done.stdout


def run(*cases):
    """Runs the cases (LIGHTWELL_CASE picks one: CLASS or CLASS.TEST) and ends the host with their status."""
    chosen = os.environ.get("LIGHTWELL_CASE")
    suite = unittest.TestSuite()
    for case in cases:
        if chosen and chosen.startswith(case.__name__ + "."):
            suite.addTest(case(chosen.partition(".")[2]))
        elif not chosen or case.__name__ == chosen:
            suite.addTests(unittest.defaultTestLoader.loadTestsFromTestCase(case))
    result = unittest.TextTestRunner(stream=ERRORS, verbosity=2).run(suite)
    ERRORS.flush()
    # FreeCAD can crash while it takes its window down, after everything is done.
    os._exit(0 if result.wasSuccessful() and result.testsRun else 1)
