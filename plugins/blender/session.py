"""The engine that this Blender keeps running, and the folder it works in."""

import atexit
import hashlib
import os
import pathlib
import re
import shutil
import tempfile

from .lightwell_bridge.client import Client
from .lightwell_bridge.engine import EngineError, find_engine

# Kept light of scenes that were rendered before; older ones are thrown away.
KEPT_LIGHTS = 4

_folder = None


def work_folder():
    """A folder of this Blender's own, removed when it ends."""
    global _folder
    if _folder is None or not _folder.is_dir():
        _folder = pathlib.Path(tempfile.mkdtemp(prefix="lightwell-"))
        atexit.register(shutil.rmtree, _folder, ignore_errors=True)
    return _folder


def engine_path():
    """@throws EngineError that lists where it was looked for"""
    import bpy
    addon = bpy.context.preferences.addons.get(__package__)
    preference = bpy.path.abspath(addon.preferences.engine) if addon and addon.preferences.engine else None
    return find_engine(preference, beside=pathlib.Path(__file__).parent)


class Session:
    """One engine and one scene folder. start() loads the scene the first time and tells of changes afterwards."""

    def __init__(self, name):
        self.name, self.client, self._loaded = name, None, False

    def folder(self):
        path = work_folder() / self.name
        path.mkdir(exist_ok=True)
        return path

    def start(self, scene_file, stop=lambda: False):
        """The engine's account of the scene.

        @throws EngineError
        """
        if self.client is None or not self.client.alive():
            self.close()
            self.client, self._loaded = Client(engine_path()), False
        if self._loaded:
            return self.client.ask("edit", stop, leave=True)
        answer = self.client.ask("load", stop, leave=True, scene=str(scene_file))
        self._loaded = True
        return answer

    def close(self):
        if self.client is not None:
            self.client.close()
        self.client, self._loaded = None, False


_sessions = {}


def session(name):
    """One session for final renders, one for each viewport, one for illuminance."""
    if name not in _sessions:
        _sessions[name] = Session(name)
    return _sessions[name]


def close(name):
    """Ends the engine of a session."""
    if name in _sessions:
        _sessions.pop(name).close()


def close_all():
    for name in list(_sessions):
        close(name)


atexit.register(close_all)


def effort(settings):
    """The wish of the scene's settings, as the engine takes it."""
    if settings.quality == "TIME":
        return {"seconds": settings.seconds, "seed": settings.seed}
    if settings.quality == "SAMPLES":
        return {"samples": settings.samples, "seed": settings.seed}
    return {"accuracy": settings.accuracy / 100, "seed": settings.seed}


def kept_light(scene_file):
    """A file of ambient light for this scene, whatever camera looks at it.

    Parts are named after their content, so the text without its views says what the scene is.
    """
    text = re.sub(r"^#@(view|grid).*\n", "", pathlib.Path(scene_file).read_text(encoding="utf-8"), flags=re.MULTILINE)
    folder = work_folder() / "light"
    folder.mkdir(exist_ok=True)
    path = folder / (hashlib.sha256(text.encode()).hexdigest()[:24] + ".amb")
    others = sorted((p for p in folder.iterdir() if p != path), key=os.path.getmtime)
    for old in others[:max(0, len(others) - KEPT_LIGHTS + 1)]:
        old.unlink()
    return path


def unregister():
    close_all()


def register():
    pass


__all__ = ["EngineError", "Session", "close", "close_all", "effort", "engine_path", "kept_light", "session", "work_folder"]
