"""What tests inside FreeCAD share: finding the packages and the fixtures, running, leaving."""

import os
import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
SHARED = pathlib.Path(os.environ.get("LIGHTWELL_SHARED") or ROOT.parent / "shared")
BUILDING = SHARED / "fixtures" / "hosts" / "freecad_building" / "building.FCStd"

for folder in (ROOT / "plugins", ROOT / "plugins" / "freecad", pathlib.Path(__file__).parent):
    sys.path.insert(0, str(folder))


def show_main_window():
    """View providers, hence colours, also without a screen (QT_QPA_PLATFORM=offscreen)."""
    import FreeCADGui
    FreeCADGui.showMainWindow()


def run(*cases):
    """Runs the cases (a name of one in LIGHTWELL_CASE picks it) and ends the host with their status."""
    chosen = os.environ.get("LIGHTWELL_CASE")
    suite = unittest.TestSuite()
    for case in cases:
        if not chosen or case.__name__ == chosen:
            suite.addTests(unittest.defaultTestLoader.loadTestsFromTestCase(case))
    result = unittest.TextTestRunner(stream=sys.stderr, verbosity=2).run(suite)
    sys.stdout.flush()
    sys.stderr.flush()
    # FreeCAD can crash while it takes its window down, after everything is done.
    os._exit(0 if result.wasSuccessful() and result.testsRun else 1)
