"""Read by FreeCAD at its start, with and without a window: documents can be exported as scenes for the engine."""

FreeCAD.addExportType("Lightwell scene folder (*.rad)", "lightwell_freecad.exporter")
