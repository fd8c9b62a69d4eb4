"""What every test file of the bridge begins and ends with."""

import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "plugins"))
SKIPPED = 77


def run():
    """Runs the tests of the calling file; without numpy they are skipped."""
    program = unittest.main(exit=False)
    sys.exit(0 if program.result.wasSuccessful() else 1)


try:
    import numpy  # noqa: F401
except ImportError:
    print("skipped: python3-numpy is not installed")
    sys.exit(SKIPPED)
