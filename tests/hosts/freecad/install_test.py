"""The packed workbench, unpacked into Mod/ as a user would: FreeCAD finds it, and every button is there."""

import pathlib
import tempfile
import unittest
import xml.etree.ElementTree

import host

host.show_main_window()

import FreeCAD
import FreeCADGui


class Installed(unittest.TestCase):
    def test_the_workbench_has_its_commands_with_icons_and_tips(self):
        self.assertIn("LightwellWorkbench", FreeCADGui.listWorkbenches())
        FreeCADGui.activateWorkbench("LightwellWorkbench")
        from lightwell_freecad import commands
        self.assertTrue(pathlib.Path(commands.__file__).is_relative_to(FreeCAD.getUserAppDataDir()), commands.__file__)
        known = FreeCADGui.listCommands()
        for name, command in commands.COMMANDS.items():
            self.assertIn(name, known)
            words = command().GetResources()
            self.assertTrue(pathlib.Path(words["Pixmap"]).is_file(), words)
            xml.etree.ElementTree.parse(words["Pixmap"])
            self.assertGreater(len(words["ToolTip"]), 40)

    def test_the_metadata_name_files_that_are_there(self):
        folder = pathlib.Path(FreeCAD.getUserAppDataDir()) / "Mod" / "Lightwell"
        root = xml.etree.ElementTree.parse(folder / "package.xml").getroot()
        space = {"m": root.tag[1:].partition("}")[0]}
        self.assertTrue((folder / root.find("m:icon", space).text).is_file())
        self.assertTrue((folder / root.find("m:license", space).get("file")).is_file())
        self.assertEqual(root.find(".//m:classname", space).text, "LightwellWorkbench")
        metadata = FreeCAD.Metadata(str(folder / "package.xml"))
        self.assertEqual(metadata.Name, "Lightwell")

    def test_a_document_is_exported_as_a_scene(self):
        document = FreeCAD.newDocument("plain")
        box = document.addObject("Part::Box", "Box")
        document.recompute()
        import lightwell_freecad.exporter as exporter
        self.assertIn("lightwell_freecad.exporter", FreeCAD.getExportType("rad"))
        with tempfile.TemporaryDirectory() as folder:
            exporter.export([box], folder + "/box.rad")
            self.assertIn("mesh Box", (pathlib.Path(folder) / "box" / "scene.rad").read_text())

    def test_a_button_that_cannot_do_its_work_says_why(self):
        from lightwell_freecad import commands
        FreeCAD.newDocument("empty")
        said = []
        kept, commands.tell = commands.tell, said.append
        self.addCleanup(setattr, commands, "tell", kept)
        for command in (commands.AddGrid, commands.MakeLuminaire, commands.Render, commands.RemoveResults):
            command().Activated()
        self.assertEqual(len(said), 4)
        for part in ("Select a plane face", "Select the objects", "There is no view", "no results to remove"):
            self.assertTrue(any(part in sentence for sentence in said), said)


host.run(Installed)
