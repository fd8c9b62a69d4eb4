"""The zip that people install."""

import ast
import shutil

from blender import InBlender, ROOT, run


class Install(InBlender):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        shutil.rmtree(cls.path / "scripts" / "addons" / "lightwell")

    def setUp(self):
        self.result = self.once("inside_install.py", self.archive, addon=False)

    def test_it_installs_and_brings_the_engine_and_all_buttons(self):
        self.assertIn("LIGHTWELL", self.result["engines"])
        self.assertGreaterEqual(len(self.result["tooltips"]), 9)
        self.assertIn("Lightwell: lightwell 0.", self.said)

    def test_every_button_and_field_teaches_in_a_sentence(self):
        for name, text in {**self.result["tooltips"], **self.result["fields"]}.items():
            self.assertGreater(len(text.split()), 3, name)

    def test_one_zip_serves_old_and_new_blenders(self):
        names = self.result["names"]
        for name in ("lightwell/__init__.py", "lightwell/blender_manifest.toml", "lightwell/lightwell_bridge/client.py",
                     "lightwell/LICENSE"):
            self.assertIn(name, names)
        self.assertFalse([n for n in names if "__pycache__" in n or not n.startswith("lightwell/")])

    def test_the_bridge_knows_no_host(self):
        for file in (ROOT / "plugins/lightwell_bridge").glob("*.py"):
            for node in ast.walk(ast.parse(file.read_text())):
                imported = [a.name for a in node.names] if isinstance(node, ast.Import) else \
                    [node.module or ""] if isinstance(node, ast.ImportFrom) else []
                for name in imported:
                    self.assertNotIn(name.split(".")[0], ("bpy", "mathutils", "gpu", "FreeCAD", "FreeCADGui", "Part"), file.name)


if __name__ == "__main__":
    run()
