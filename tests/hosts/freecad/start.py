"""Runs the script of tests that LIGHTWELL_SCRIPT names inside FreeCAD; whatever goes wrong in it ends the host."""

import os
import runpy
import traceback

try:
    runpy.run_path(os.environ["LIGHTWELL_SCRIPT"])
except BaseException:
    with open(2, "w", closefd=False) as errors:
        traceback.print_exc(file=errors)
finally:
    os._exit(1)
