#!/usr/bin/env -S /usr/bin/python3 -B
"""An engine that behaves as the environment variable FAKE says: for hosts' tests of what seldom happens.

FAKE: empty (well), old (protocol 0), mute (no greeting), chatter (no JSON), dies (at load), kill (in a render), hangs
(in a render, deaf to cancel), error (render names an object), full (render says the disk is full), black (a picture with
wrong channels), small (a picture of the wrong size), slow (a render of a minute that can be stopped), pictures (a new
picture with all passes as soon as the host has had time to take the last one, for a minute)
"""

import json
import os
import pathlib
import signal
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "plugins"))
FAKE = os.environ.get("FAKE", "")
stopped = set()
drawing = threading.Lock()


def say(**event):
    sys.stdout.write(json.dumps(event) + "\n")
    sys.stdout.flush()


def picture(request, names="{layer}.Combined.{c}", shrink=0):
    import numpy as np
    from lightwell_bridge import exr
    width, height = request["size"]
    region = request.get("region") or [0, 0, width, height]
    shape = (region[3] - region[1] - shrink, region[2] - region[0] - shrink)
    channels = {names.format(layer=request.get("layer"), c=c): np.full(shape, 0.25 * (i + 1)) for i, c in enumerate("RGBA")}
    pathlib.Path(request["file"]).write_bytes(exr.to_bytes(channels))


PASSES = ("Illuminance.X", "Luminance.X", "Error.X", "ObjectLayer.X", "Depth.Z", "Normal.X", "Normal.Y", "Normal.Z")


def pictures(request):
    """So that a host that is stopped at any moment is most probably taking a picture over."""
    import numpy as np
    from lightwell_bridge import exr
    number, (width, height) = request["id"], request["size"]
    with drawing:  # it takes seconds, and those that were stopped meanwhile shall not repeat it
        if not pathlib.Path(request["file"]).exists():
            values = np.random.default_rng(1).random((height, width))
            names = [f"Combined.{c}" for c in "RGBA"] + list(PASSES)
            channels = {f"{request['layer']}.{name}": values for name in names}
            pathlib.Path(request["file"]).write_bytes(exr.to_bytes(channels))
    for _ in range(200):
        if number in stopped:
            return say(event="cancelled", id=number)
        say(event="partial", id=number, file=request["file"], samples=8, error=0.1)
        time.sleep(0.3)
    say(event="result", id=number, kind="picture", file=request["file"], error=0.05, seconds=60, notes=[])


def render(request):
    number = request["id"]
    if FAKE == "pictures":
        return pictures(request)
    if FAKE == "kill":
        os.kill(os.getpid(), signal.SIGKILL)
    if FAKE == "error":
        return say(event="error", id=number, text="thickness is -6 mm, expected > 0", object="Desk 01", way_out="correct it")
    if FAKE == "full":
        return say(event="error", id=number, text=f"{request['file']}: no space left on the device", way_out="make room")
    for step in range(600 if FAKE in ("slow", "hangs") else 3):
        if number in stopped and FAKE != "hangs":
            return say(event="cancelled", id=number)
        say(event="progress", id=number, fraction=step / 600, phase="pixels", seconds_left=60 - step / 10)
        time.sleep(0.1 if FAKE in ("slow", "hangs") else 0)
    if FAKE == "black":
        picture(request, "{c}")
    else:
        picture(request, shrink=4 if FAKE == "small" else 0)
    say(event="result", id=number, kind="picture", file=request["file"], error=0.05, seconds=0.1, notes=[])


def main():
    if sys.argv[1:2] == ["materials"]:
        print("[]")
        return
    if sys.argv[1:2] == ["--version"]:
        print("lightwell 0.0.1")
        return
    if FAKE == "mute":
        sys.stdin.read()
        return
    if FAKE == "chatter":
        print("usage: something else", flush=True)
    say(event="hello", protocol=0 if FAKE == "old" else 1, engine="0.0.1", pid=os.getpid())
    for line in sys.stdin:
        request = json.loads(line)
        if request["do"] == "cancel":
            stopped.add(request["target"])
        elif request["do"] == "quit":
            return
        elif request["do"] in ("load", "edit"):
            if FAKE == "dies":
                print("out of memory", file=sys.stderr)
                sys.exit(4)
            say(event="result", id=request["id"], kind="scene", surfaces=0, layers=[], notes=[])
        else:
            threading.Thread(target=render, args=(request,), daemon=True).start()


if __name__ == "__main__":
    main()
    os._exit(0)
