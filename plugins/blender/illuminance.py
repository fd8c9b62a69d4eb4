"""The Illuminance button: the scene to the engine, illuminance of its surfaces and grids back onto the objects."""

import bpy

from . import library_materials, session, show_results
from .exporter import Exporter
from .lightwell_bridge import false_colour, results, surface_results
from .lightwell_bridge.client import FINAL, sentence_of


class Job:
    """Requests one after the other; step() takes what has come and returns True when all is there."""

    def __init__(self, context):
        self.scene = context.scene
        library_materials.known(session.engine_path())
        show_results.clear(self.scene)
        context.view_layer.update()
        depsgraph = context.evaluated_depsgraph_get()
        self._session = session.session("illuminance")
        render = self.scene.render
        self.exported = Exporter(depsgraph, self._session.folder(), (render.resolution_x, render.resolution_y)).export()
        self._session.start(self.exported.scene_file)
        self.notes, self.grids, self.objects = list(self.exported.notes), [], []
        self.text, self.fraction, self._number, self._current = "beginning", 0.0, None, None
        self._work = [("grid", grid) for grid in self.exported.grids]
        if self.exported.parts:
            self._work.append(("surfaces", None))
        if not self._work:
            raise ValueError("there is nothing to compute: no object with faces, and no sensor grid")
        self._total = len(self._work)

    def step(self, timeout=0.0):
        """@throws EngineError, ValueError"""
        client = self._session.client
        if self._number is None:
            if not self._work:
                return True
            self._current = self._work.pop(0)
            self._number = client.send(**self._request(*self._current))
        event = client.next_event(self._number, timeout)
        if event is None:
            return False
        if event["event"] == "progress":
            done = self._total - len(self._work) - 1
            self.fraction = (done + min(max(float(event.get("fraction", 0)), 0), 1)) / self._total
            self.text = f"{self._current[0]}: {event.get('phase', '')}"
        elif event["event"] in FINAL:
            self._number = None
            if event["event"] == "error":
                raise session.EngineError(sentence_of(event))
            if event["event"] == "cancelled":
                raise session.EngineError("stopped")
            self._take(event)
        return False

    def cancel(self):
        """Stops what is under way; the engine stays."""
        if self._number is not None:
            number, self._number = self._number, None
            for _ in self._session.client.events(number, stop=lambda: True):
                pass

    def _request(self, kind, grid):
        settings, folder = self.scene.lightwell, self._session.folder()
        if kind == "grid":
            return dict(session.effort(settings), do="illuminance", grid=grid.name, file=str(folder / "grid.csv"))
        return dict(session.effort(settings), do="surfaces", parts=["*"], spacing=settings.surface_spacing,
                    file=str(folder / "faces.json"))

    def _take(self, event):
        kind, grid = self._current
        self.notes += [n if isinstance(n, str) else n.get("text", str(n)) for n in event.get("notes", ())]
        if kind == "grid":
            light = results.read_grid_csv(event["file"], grid.name)
            light.rows, light.columns, light.cells = grid.rows, grid.columns, grid.cells
            self.grids.append((grid, light))
        else:
            sizes = {source: (part.layer, len(part.mesh.sizes)) for source, part in self.exported.parts.items()}
            self.objects, notes = surface_results.read(event["file"], sizes)
            self.notes += notes

    # --- showing

    def show(self):
        """Puts everything onto the objects; returns a sentence."""
        lights = [light for _, light in self.grids]
        top = self.scene.lightwell.false_colour_top or false_colour.scale_top(
            [v for light in lights for v in light.lux] + [v for o in self.objects for v in o.lux()])
        display = show_results.Display(self.scene, top)
        for name, drawings in self._by_object().items():
            obj = bpy.data.objects.get(name)
            if obj is None:
                continue
            part = self.exported.parts[drawings[0].source]
            values = surface_results.mean_of_drawings(drawings)
            if len(drawings) > 1:
                self.notes.append(f"object \"{name}\" is drawn {len(drawings)} times: it shows the mean of them; the table "
                                  "has each")
            if not part.original_faces or not display.show_object(obj, values):
                self.notes.append(f"object \"{name}\": its faces are made by modifiers; its mean is in the table")
        for grid, light in self.grids:
            display.show_grid(grid, light.lux)
        notes = list(dict.fromkeys(self.notes))
        display.finish(results.report(self.objects, lights, notes), results.table(self.objects, lights))
        return (f"illuminance of {len(self.objects)} objects and {len(self.grids)} grids, scale to {top:g} lx; numbers in the "
                f"text \"{show_results.TEXT}\"")

    def _by_object(self):
        drawings = {}
        for light in self.objects:
            drawings.setdefault(self.exported.parts[light.source].object_name, []).append(light)
        return drawings


class LIGHTWELL_OT_illuminance(bpy.types.Operator):
    """Compute the illuminance of all surfaces and sensor grids and show it on the objects. Esc stops"""
    bl_idname, bl_label, bl_options = "lightwell.illuminance", "Illuminance", {"REGISTER"}

    _job = _timer = None

    def execute(self, context):
        """All at once, for scripts."""
        try:
            job = Job(context)
            while not job.step(0.1):
                pass
            self.report({"INFO"}, f"Lightwell: {job.show()}")
            return {"FINISHED"}
        except (session.EngineError, ValueError, OSError) as error:
            self.report({"ERROR"}, f"Lightwell: {error}")
            return {"CANCELLED"}

    def invoke(self, context, event):
        try:
            self._job = Job(context)
        except (session.EngineError, ValueError, OSError) as error:
            self.report({"ERROR"}, f"Lightwell: {error}")
            return {"CANCELLED"}
        self._timer = context.window_manager.event_timer_add(0.1, window=context.window)
        context.window_manager.progress_begin(0, 100)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        try:
            if event.type == "ESC":
                self._job.cancel()
                return self._end(context, {"WARNING"}, "stopped; nothing was changed", {"CANCELLED"})
            if event.type != "TIMER":
                return {"PASS_THROUGH"}
            if self._job.step():
                return self._end(context, {"INFO"}, self._job.show(), {"FINISHED"})
            context.window_manager.progress_update(int(100 * self._job.fraction))
            context.workspace.status_text_set(f"Lightwell: {self._job.text} {self._job.fraction:.0%}   Esc stops")
            return {"RUNNING_MODAL"}
        except (session.EngineError, ValueError, OSError) as error:
            return self._end(context, {"ERROR"}, str(error), {"CANCELLED"})

    def _end(self, context, kind, sentence, result):
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
        self.report(kind, f"Lightwell: {sentence}")
        return result


CLASSES = (LIGHTWELL_OT_illuminance,)
register, unregister = bpy.utils.register_classes_factory(CLASSES)
