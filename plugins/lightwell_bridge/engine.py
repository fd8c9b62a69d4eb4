"""Finding the engine, and whether it speaks our protocol."""

import json
import os
import pathlib
import shutil
import subprocess

PROTOCOL = 1
ENVIRONMENT = "LIGHTWELL_ENGINE"
PROGRAM = "lightwell.exe" if os.name == "nt" else "lightwell"
SECONDS_TO_GREET = 20


class EngineError(Exception):
    """A sentence for people: what was wrong, and the way out."""


def find_engine(preference=None, beside=None):
    """The path of the engine: the preference, the environment variable, beside the package (bin/), on PATH.

    @param beside  folder of the add-on; its bin/ is looked at
    @throws EngineError that lists where it was looked for
    """
    looked = []
    beside = pathlib.Path(beside or pathlib.Path(__file__).resolve().parent.parent)
    for what, path in (("preference", preference), (ENVIRONMENT, os.environ.get(ENVIRONMENT)),
                       ("beside the add-on", beside / "bin" / PROGRAM), ("on PATH", shutil.which(PROGRAM))):
        if path and _runnable(path):
            return pathlib.Path(path)
        looked.append(f"{what}: {path or 'not set' if what != 'on PATH' else path or 'not there'}")
        if path and what in ("preference", ENVIRONMENT):
            raise EngineError(f"there is no Lightwell engine at {path} ({what}); correct the path or clear it")
    raise EngineError("the Lightwell engine was not found. Looked at " + "; ".join(looked) +
                      ". Install it, or set its path in the preferences of the add-on")


def _runnable(path):
    path = pathlib.Path(path)
    if not path.is_file():
        return False
    if not os.access(path, os.X_OK):
        try:
            path.chmod(path.stat().st_mode | 0o111)  # a zip may have lost the bit
        except OSError:
            return False
    return True


def check_hello(line, path):
    """The greeting of the engine as a dictionary.

    @throws EngineError when it is no greeting, or of another protocol
    """
    try:
        hello = json.loads(line)
        protocol = hello["protocol"]
    except (ValueError, KeyError, TypeError):
        raise EngineError(f"{path} does not greet as a Lightwell engine; it says \"{line.strip()[:80]}\"") from None
    if hello.get("event") != "hello" or protocol != PROTOCOL:
        raise EngineError(f"{path} speaks protocol {protocol} (engine {hello.get('engine', '?')}), this add-on protocol "
                          f"{PROTOCOL}; install versions that belong together")
    return hello


def version_of(path):
    """What `lightwell --version` prints.

    @throws EngineError when it does not run
    """
    try:
        answer = subprocess.run([str(path), "--version"], capture_output=True, text=True, timeout=SECONDS_TO_GREET,
                                stdin=subprocess.DEVNULL)
    except (OSError, subprocess.SubprocessError) as error:
        raise EngineError(f"{path} does not run: {error}") from error
    if answer.returncode != 0 or not answer.stdout.strip():
        raise EngineError(f"{path} does not tell its version (status {answer.returncode}): {answer.stderr.strip()[:200]}")
    return answer.stdout.strip()
