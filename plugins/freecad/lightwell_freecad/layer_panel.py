"""The task panel of the layer map: what each layer is made of, with proposals."""

import FreeCADGui
from PySide import QtCore, QtGui

from lightwell_bridge import layer_map as proposals, library

from . import project as projects, results, run

AS_DRAWN = "as drawn"
LEAST_HEIGHT = 420


class LayerPanel:
    """One row a layer: its name, what the document says, faces and area, and a list of materials to choose from."""

    def __init__(self, project):
        self.project = project
        program = run.program_of(project)
        self.library = library.read_library(program)
        session = run.session_of(project.Document)
        self.layers = run.write_scene(project.Document, session.folder / "layers", with_map=False).layers
        self.program = program
        self._build(dict(projects.rules_of(project)))

    def _build(self, chosen):
        self.form = QtGui.QWidget()
        self.form.setWindowTitle("Lightwell: layer map")
        layout = QtGui.QVBoxLayout(self.form)
        self.table = QtGui.QTableWidget(len(self.layers), 4)
        self.table.setHorizontalHeaderLabels(["Layer", "Material", "Faces", "Area m²"])
        self.boxes = {}
        for row, (name, facts) in enumerate(self.layers.items()):
            for column, text in ((0, name), (2, str(facts["faces"])), (3, f"{facts['area_m2']:.2f}")):
                item = QtGui.QTableWidgetItem(text)
                item.setFlags(QtCore.Qt.ItemIsEnabled | QtCore.Qt.ItemIsSelectable)
                item.setToolTip(f"{name}: {facts['decided']}; as drawn: {facts['material']}")
                self.table.setItem(row, column, item)
            self.boxes[name] = self._box(row, facts, chosen.get(_pattern(name)))
        self.table.verticalHeader().hide()
        self.table.setMinimumHeight(LEAST_HEIGHT)
        header = self.table.horizontalHeader()
        for column in range(4):
            header.setSectionResizeMode(column, QtGui.QHeaderView.Stretch if column < 2 else QtGui.QHeaderView.ResizeToContents)
        self.propose = QtGui.QPushButton("Propose for the rest")
        self.propose.setToolTip("Materials whose names fit the names of layers; what is chosen already stays")
        self.propose.clicked.connect(self.fill)
        layout.addWidget(self.table)
        layout.addWidget(self.propose)

    def _box(self, row, facts, chosen):
        box = QtGui.QComboBox()
        box.setSizeAdjustPolicy(QtGui.QComboBox.AdjustToMinimumContentsLength)
        box.addItem(f"{AS_DRAWN} ({facts['material']})", "")
        for name, material in self.library.items():
            box.addItem(f"{name}: {material.description}", name)
        box.setCurrentIndex(max(box.findData(chosen or ""), 0))
        if facts["decided"] == "luminaire":
            box.setEnabled(False)
        self.table.setCellWidget(row, 1, box)
        return box

    def fill(self):
        """Puts proposals where nothing is chosen."""
        found = proposals.propose(self.program, [n for n, b in self.boxes.items() if not b.currentData()])
        for name, material in found.items():
            if self.boxes[name].isEnabled():
                self.boxes[name].setCurrentIndex(max(self.boxes[name].findData(material), 0))

    def rules(self):
        """The lines of the project's layer map."""
        lines = {_pattern(name): box.currentData() for name, box in self.boxes.items() if box.currentData()}
        return [f"{pattern} = {material}" for pattern, material in lines.items()]

    def accept(self):
        with results.one_step(self.project.Document, "Lightwell: layer map"):
            self.project.LayerMap = self.rules()
        FreeCADGui.Control.closeDialog()
        return True

    def reject(self):
        FreeCADGui.Control.closeDialog()
        return True


def _pattern(name):
    """The name of a layer as a pattern for itself alone; both sheets of a pane are one layer."""
    return "".join(f"[{c}]" if c in "*?[" else c for c in name.replace(" (two sheets)", ""))
