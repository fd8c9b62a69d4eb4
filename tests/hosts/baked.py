"""Means of objects from what `lightwell bake` writes: what the hosts show is compared with it."""

import json


class Baked:
    """`file` is maps.json. Faces of a mesh are named NAME/NUMBER, joined ones NAME/FIRST+; other surfaces by their name."""

    def __init__(self, file):
        self._surfaces = json.loads(file.read_text(encoding="utf-8"))["surfaces"]

    def mean(self, names, side):
        """(m2, mean lx by area) over all surfaces of these meshes and of these names."""
        found = [s for s in self._surfaces if s["surface"] in names or s["surface"].rpartition("/")[0] in names]
        area = sum(s["area_m2"] for s in found)
        return (area, sum(s["area_m2"] * s[side]["mean_lx"] for s in found) / area) if area > 0 else (0.0, 0.0)
