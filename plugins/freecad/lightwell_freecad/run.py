"""Simulations of a document: write its scene, ask the engine, show what it found. With and without a window.

    job = run.Job(project, [run.ILLUMINANCE])      # grids; or run.OBJECTS, or the name of a view
    while job.poll():                              # a window calls this from a timer
        print(job.fraction, job.text)
        time.sleep(0.05)

illuminance(), objects() and picture() do that and come back when they are done.
"""

import pathlib
import tempfile
import threading
import time

import FreeCAD

from lightwell_bridge import library, results as numbers
from lightwell_bridge.client import FINAL, Client, sentence_of
from lightwell_bridge.engine import EngineError, find_engine

from . import export, faces_file, pictures, project as projects, results

PREFERENCES = "User parameter:BaseApp/Preferences/Mod/Lightwell"
# What a job can be asked for beside the names of views.
ILLUMINANCE, OBJECTS = "illuminance of grids", "illuminance of objects"
# How often a call that waits looks whether something has come, s.
WAIT_S = 0.02
MM_PER_M = 1000.0
# An engine that was told to stop and goes on for this time is ended, s; nobody waits for it.
GRACE_S = 2.0


class Failed(Exception):
    """A sentence for people: what went wrong, where, and the way out."""


class _Session:
    """The engine and the folder of one document, kept from job to job."""

    def __init__(self):
        self.temporary = tempfile.TemporaryDirectory(prefix="lightwell-")
        self.folder = pathlib.Path(self.temporary.name)
        self.client, self.loaded = None, False
        self.stop_seconds = []  # of each request that was stopped: until the engine said that it has
        self._leaving = None

    def ready(self, program):
        """A running engine: the last one when it still lives and is the one that is wanted.

        @throws EngineError
        """
        self._settle()
        if self.client is not None and (not self.client.alive() or self.client.path != program):
            self.end()
        if self.client is None:
            self.client = Client(program)
        return self.client

    def leave(self, number):
        """Stops a request without waiting: the engine stays for the next job, or is ended when it does not listen.

        @throws EngineError when the engine is gone
        """
        self.client.cancel(number)
        self._leaving = threading.Thread(target=self._wait_for_end, args=(self.client, number, time.monotonic()), daemon=True)
        self._leaving.start()

    def _wait_for_end(self, client, number, told):
        try:
            while time.monotonic() - told < GRACE_S:
                event = client.next_event(number, WAIT_S)
                if event is not None and event["event"] in FINAL:
                    self.stop_seconds.append(event["arrived"] - told)
                    return
        except EngineError:
            pass  # it is gone, which is an end too
        client.close()

    def _settle(self):
        if self._leaving is not None:
            self._leaving.join()
            self._leaving = None

    def end(self):
        self._settle()
        if self.client is not None:
            self.client.close()
        self.client, self.loaded = None, False


_sessions = {}


def session_of(document):
    return _sessions.setdefault(document.Name, _Session())


def end(document):
    """Ends the engine of a document and forgets its scene."""
    session = _sessions.pop(document.Name, None)
    if session is not None:
        session.end()
        session.temporary.cleanup()


def program_of(project=None):
    """Path of the engine: of the project, the preference, and what the bridge finds.

    @throws Failed that names where it was looked for
    """
    own = project.Engine if project is not None else ""
    preference = own or FreeCAD.ParamGet(PREFERENCES).GetString("Engine", "")
    try:
        return find_engine(preference or None)
    except EngineError as error:
        raise Failed(str(error)) from error


def write_scene(document, folder, with_map=True):
    """The scene of a document with what its project says; changes nothing in it.

    @param with_map  false: everything as drawn, whatever the layer map says

    @throws Failed
    """
    project = projects.find(document)
    try:
        if project is None:
            return export.export_document(document, folder, engine=program_of)
        rules, problems = projects.rules_of(project) if with_map else [], []
        known = library.read_library(program_of(project)) if rules else {}
        grids = projects.grids_of(project, problems.append)
        exported = export.export_document(document, folder, float(project.ChordTolerance.Value), projects.views_of(project),
                                          projects.sky_of(project), grids, rules, known, lambda: program_of(project))
        exported.notes += problems
        return exported
    except (ValueError, OSError) as error:
        raise Failed(str(error)) from error


def illuminance(project, told=lambda job: None):
    """Simulates all grids and shows them; returns their GridLights.

    @throws Failed
    """
    return _wait(Job(project, [ILLUMINANCE]), told).grids


def objects(project, told=lambda job: None):
    """Simulates the faces of all objects, and the grids; returns ObjectLights.

    @throws Failed
    """
    return _wait(Job(project, [OBJECTS, ILLUMINANCE]), told).objects


def picture(project, view, told=lambda job: None):
    """Renders a view and shows it as an image object, which is returned. The OpenEXR file is in its property Picture.

    @throws Failed
    """
    return _wait(Job(project, [view]), told).pictures[0]


def _wait(job, told):
    while job.poll():
        told(job)
        time.sleep(WAIT_S)
    told(job)
    if job.error:
        raise Failed(job.error)
    if job.stopped:
        raise Failed("The simulation was stopped; nothing was changed.")
    return job


class Job:
    """One run: poll() carries it on without waiting and says whether it goes on.

    fraction   0 to 1 of the present request; text what it is, phase where the engine is in it; seconds_left or None
    error      a sentence, once it has failed; stopped: it was told to end. In both cases the document is unchanged
    notes      sentences about what was assumed or left out
    """

    def __init__(self, project, wishes):
        self.project, self.wishes = project, list(wishes)
        self.fraction, self.text, self.phase, self.seconds_left = 0.0, "writing the scene", "", None
        self.error, self.stopped, self.notes = "", False, []
        self.objects, self.grids, self.pictures = [], [], []
        self._work, self._request = self._steps(), None
        self._session = session_of(project.Document)
        self._done = False

    def poll(self):
        if self._done:
            return False
        try:
            self._carry_on()
        except StopIteration:
            self._done = True
        except (Failed, EngineError, OSError, ValueError) as error:
            self._fail(str(error))
        return not self._done

    def cancel(self):
        """Ends the job at once; the engine is told to stop, and the next job waits for that."""
        if self._done:
            return
        self.stopped, self.text = True, "stopped"
        try:
            if self._request is not None:
                self._session.leave(self._request)
        except EngineError:
            pass  # it is gone: the next job starts another
        self._fail("")

    def _fail(self, sentence):
        self._done, self.error = True, sentence
        self._work.close()

    def _carry_on(self):
        """One step: starts the next request, or looks for an event of the present one."""
        if self._request is None:
            self._request = next(self._work)
            return
        event = self._session.client.next_event(self._request)
        if event is None:
            return
        if event["event"] == "progress":
            self.fraction = min(max(float(event.get("fraction") or 0), 0.0), 1.0)
            self.phase, self.seconds_left = str(event.get("phase") or ""), event.get("seconds_left")
        elif event["event"] == "error":
            raise Failed(sentence_of(event))
        elif event["event"] == "cancelled":
            raise Failed("the engine stopped the simulation by itself")
        elif event["event"] == "result":
            self._request = None
            self._request = self._work.send(event)

    # --- what is done, request by request

    def _steps(self):
        """Yields the number of each request and gets its result."""
        exported = write_scene(self.project.Document, self._session.folder / "scene")
        self.notes += exported.notes
        self._check_wishes(exported)
        client = self._session.ready(program_of(self.project))
        yield from self._load(client, exported)
        for wish in self.wishes:
            if wish == ILLUMINANCE:
                for name in exported.grids:
                    yield from self._grid(client, name, exported)
            elif wish == OBJECTS:
                yield from self._faces(client, exported)
            else:
                yield from self._picture(client, wish)
        if OBJECTS in self.wishes or ILLUMINANCE in self.wishes:
            results.show(self.project, exported, self.objects, self.grids, self._session.folder, self.notes)

    def _check_wishes(self, exported):
        known = dict(projects.views_of(self.project))
        for wish in self.wishes:
            if wish == ILLUMINANCE and not exported.grids and OBJECTS not in self.wishes:
                raise Failed("There is no sensor grid: select a face and choose Sensor grid, or set lw_role of an object to "
                             "\"sensor plane\".")
            if wish not in (ILLUMINANCE, OBJECTS) and wish not in known:
                raise Failed(f"There is no view \"{wish}\"; known are {', '.join(known) or 'none: add one first'}.")

    def _load(self, client, exported):
        self.text = "reading the scene"
        if self._session.loaded:
            self._session.loaded = False  # until the engine has said that it is
            event = yield client.send("edit")
        else:
            event = yield client.send("load", scene=str(exported.scene))
        self._session.loaded = True
        self.notes += _notes(event)

    def _effort(self):
        return {"seconds": self.project.Seconds} if self.project.Seconds > 0 else {"accuracy": self.project.Accuracy}

    def _grid(self, client, name, exported):
        self.text, self.fraction = f"illuminance of {name}", 0.0
        file = self._session.folder / f"grid-{len(self.grids)}.csv"
        event = yield client.send("illuminance", grid=name, file=str(file), **self._effort())
        grid = numbers.read_grid_csv(file, name)
        facts = exported.grids[name]
        if len(grid.lux) != len(facts["sensors"]):
            raise Failed(f"grid \"{name}\": {len(grid.lux)} results for {len(facts['sensors'])} sensors")
        grid.rows, grid.columns, grid.cells = facts["rows"], facts["columns"], facts["cells"]
        self.grids.append(grid)
        self.notes += _notes(event)

    def _faces(self, client, exported):
        self.text, self.fraction = "illuminance of objects", 0.0
        file = self._session.folder / "faces.json"
        event = yield client.send("surfaces", parts=["*"], file=str(file), accuracy=self.project.Accuracy,
                                  spacing=float(self.project.FaceSpacing.Value) / MM_PER_M)
        self.objects = faces_file.read(file, exported)
        self.notes += _notes(event)

    def _picture(self, client, view):
        self.text, self.fraction = f"picture {view}", 0.0
        file = self._session.folder / f"picture-{len(self.pictures)}.exr"
        event = yield client.send("render", view=view, size=[self.project.Width, self.project.Height], file=str(file),
                                  layer=pictures.LAYER, **self._effort())
        self.pictures.append(pictures.show(self.project, view, file))
        self.notes += _notes(event)


def _notes(event):
    found = []
    for note in event.get("notes") or []:
        found.append(note if isinstance(note, str) else f"{note.get('place', '')}: {note.get('text', '')}")
    return found
