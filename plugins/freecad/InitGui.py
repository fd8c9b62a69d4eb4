"""Read by FreeCAD at the start of its user interface: the workbench with its commands."""


class LightwellWorkbench(FreeCADGui.Workbench):
    MenuText = "Lightwell"
    ToolTip = "Lighting simulation in absolute units, with the results on the objects of the document"

    def __init__(self):
        # FreeCAD runs this file without a name of its own: modules are found only by importing them.
        from lightwell_freecad import icon_files
        self.__class__.Icon = icon_files.icon("lightwell")

    def Initialize(self):
        from lightwell_freecad import commands
        names = commands.register()
        self.appendToolbar("Lightwell", names)
        self.appendMenu("Lightwell", names)

    def GetClassName(self):
        return "Gui::PythonWorkbench"


FreeCADGui.addWorkbench(LightwellWorkbench())
