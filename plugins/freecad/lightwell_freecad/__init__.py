"""Lightwell in FreeCAD: the document as a scene folder, the engine as a child process, the results on the objects."""
