"""Materials proposed for layers by their names, as the engine proposes them for drawings; maps as JSON."""

import json
import os
import re
import subprocess
import tempfile

SECONDS_TO_ANSWER = 60


def propose(engine, layers):
    """{layer: name of a material of the library} for those that the engine has an idea for.

    @throws ValueError with a sentence when the engine does not answer
    """
    if not layers:
        return {}
    words = {f"layer{number}_{_plain(layer)}": layer for number, layer in enumerate(layers)}
    with tempfile.TemporaryDirectory(prefix="lightwell-") as folder:
        drawing, answer = os.path.join(folder, "layers.obj"), os.path.join(folder, "map.toml")
        with open(drawing, "w", encoding="utf-8") as file:
            file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + "".join(f"g {word}\nf 1 2 3\n" for word in words))
        try:
            subprocess.run([str(engine), "layers", drawing, "--propose", answer], check=True, capture_output=True,
                           timeout=SECONDS_TO_ANSWER, stdin=subprocess.DEVNULL)
            with open(answer, encoding="utf-8") as file:
                text = file.read()
        except (OSError, subprocess.SubprocessError) as error:
            raise ValueError(f"{engine} proposes no materials: {error}") from error
    found = re.findall(r'^layer = "([^"]*)"\nuse = "([^"]*)"', text, re.MULTILINE)
    return {words[word]: use for word, use in found if word in words and use != "grey_50"}


def _plain(layer):
    """The last part of the path with what else it says, as one word."""
    return re.sub(r"[\s\"\\#*?\[\]]+", "_", layer.replace("/", "_"))


def to_json(rules):
    """A map as text: {"collections": {path: material}, "materials": {...}, "objects": {...}}."""
    return json.dumps(rules, ensure_ascii=False, indent=1, sort_keys=True) + "\n"


def from_json(text):
    """@throws ValueError that says what a map is"""
    try:
        rules = json.loads(text)
    except ValueError as error:
        raise ValueError(f"no layer map: {error}") from error
    kinds = ("collections", "materials", "objects")
    good = isinstance(rules, dict) and all(
        isinstance(rules.get(kind, {}), dict) and all(isinstance(v, str) for v in rules.get(kind, {}).values()) for kind in kinds)
    if not good or not set(rules) <= set(kinds):
        raise ValueError("no layer map: expected {\"collections\": {name: material}, \"materials\": {}, \"objects\": {}}")
    return {kind: rules.get(kind, {}) for kind in kinds}
