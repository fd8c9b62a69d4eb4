"""The task panel of a running job: progress, time left, stop, and what was noted."""

import FreeCADGui
from PySide import QtCore, QtGui

# How often the panel looks for news, ms.
TICK_MS = 40


class JobPanel:
    """`form` is what FreeCAD shows; the job is carried on by a timer, so that the window stays alive."""

    def __init__(self, job, title):
        self.job = job
        self.form = QtGui.QWidget()
        self.form.setWindowTitle(f"Lightwell: {title}")
        layout = QtGui.QVBoxLayout(self.form)
        self.label = QtGui.QLabel(job.text)
        self.label.setWordWrap(True)
        self.bar = QtGui.QProgressBar()
        self.bar.setRange(0, 1000)
        self.stop = QtGui.QPushButton("Stop")
        self.stop.setToolTip("Ends the simulation within a moment; nothing is changed")
        self.stop.clicked.connect(self.cancel)
        self.notes = QtGui.QPlainTextEdit()
        self.notes.setReadOnly(True)
        self.notes.setToolTip("What was assumed, approximated or left out")
        for widget in (self.label, self.bar, self.stop, self.notes):
            layout.addWidget(widget)
        self.timer = QtCore.QTimer(self.form)
        self.timer.timeout.connect(self.tick)
        self.timer.start(TICK_MS)

    def tick(self):
        going_on = self.job.poll()
        left = self.job.seconds_left
        phase = f": {self.job.phase}" if self.job.phase else ""
        self.label.setText(self.job.text + phase + (f", {left:.0f} s left" if left is not None and going_on else ""))
        self.bar.setValue(int(1000 * self.job.fraction))
        if going_on:
            return
        self.timer.stop()
        self.stop.setEnabled(False)
        if self.job.error:
            self.label.setText(self.job.error)
        elif self.job.stopped:
            self.label.setText("Stopped; nothing was changed.")
        else:
            self.bar.setValue(1000)
            self.label.setText("Done. The results are in the tree, below the project.")
        self.notes.setPlainText("\n".join(self.job.notes))

    def cancel(self):
        self.job.cancel()
        self.tick()

    # --- what FreeCAD asks of a panel

    def getStandardButtons(self):
        return int(QtGui.QDialogButtonBox.Close)

    def reject(self):
        if self.timer.isActive():
            self.cancel()
            return False
        FreeCADGui.Control.closeDialog()
        return True
