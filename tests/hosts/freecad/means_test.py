"""The illuminance of every object of the building, in FreeCAD and on the command line."""

import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import unittest

import host

host.show_main_window()

import FreeCAD

from lightwell_freecad import project, results, run

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from baked import Baked

ENGINE = os.environ.get("LIGHTWELL_ENGINE", "")
SPACING_M, ACCURACY = 1.0, 0.2
# Standard errors of a difference of two runs.
ERRORS = 4


@unittest.skipUnless(host.BUILDING.exists(), f"no {host.BUILDING}")
@unittest.skipUnless(host.serves(), "LIGHTWELL_ENGINE names no engine that serves hosts")
class Means(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.document = FreeCAD.openDocument(str(shutil.copy(host.BUILDING, cls.folder)))
        cls.project = project.make(cls.document)
        cls.project.Accuracy, cls.project.FaceSpacing = ACCURACY, 1000 * SPACING_M
        project.make_luminaire(cls.document.getObjectsByLabel("Bowl (mesh)")[0], 3000)
        cls.document.recompute()
        cls.lights = {light.source: light for light in run.objects(cls.project)}
        scene = run.session_of(cls.document).folder / "scene" / "scene.rad"
        subprocess.run([ENGINE, "bake", str(scene), "--all", "--spacing", str(SPACING_M), "--accuracy", str(ACCURACY), "--seed", "5",
                        "-o", str(cls.folder / "baked")], check=True, capture_output=True)
        cls.baked = Baked(cls.folder / "baked" / "maps.json")
        cls.exported = run.write_scene(cls.document, cls.folder / "again")

    @classmethod
    def tearDownClass(cls):
        run.end(cls.document)
        cls.temporary.cleanup()

    def test_the_mean_of_each_object_is_that_of_the_command_line(self):
        worst, shares = (0.0, ""), []
        for path, record in self.exported.objects.items():
            area, lux, error = self.lights[path].mean()
            side = self.lights[path].side()
            other_area, other = self.baked.mean({face["element"] for face in record["faces"]}, side)
            self.assertAlmostEqual(other_area, area, delta=1e-6 * area, msg=path)
            stated = ERRORS * 2 ** 0.5 * error + 1e-9
            worst = max(worst, (abs(lux - other) / stated, path))
            shares.append(error / lux if lux > 0 else 0.0)
            with self.subTest(path):
                self.assertLessEqual(abs(lux - other), stated, f"{lux} and {other} lx, error {error}")
        self.assertGreater(len(shares), 20)
        self.assertLess(statistics.median(shares), ACCURACY / 2, "too coarse to tell")
        print(f"{len(shares)} objects, worst {worst[0]:.2f} of {ERRORS} standard errors: {worst[1]}; error of the median "
              f"object {statistics.median(shares):.1%}", file=host.ERRORS)

    def test_the_table_has_the_same_means(self):
        group = next(o for o in self.project.Group if getattr(o, "LightwellRole", "") == "result")
        sheet = next(o for o in group.Group if o.TypeId == "Spreadsheet::Sheet")
        rows = {str(sheet.get(f"B{i}")): i for i in range(2, 200) if sheet.getContents(f"B{i}")}
        for path, light in self.lights.items():
            self.assertIn(path, rows)
            self.assertAlmostEqual(float(sheet.get(f"E{rows[path]}")), light.mean()[1], delta=0.06)


host.run(Means)
