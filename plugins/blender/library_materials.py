"""Which material of Lightwell's library stands for what: object before material before collection."""

from .lightwell_bridge import library

_known = {}


def known(engine=None):
    """The library as the engine last told it; asks when an engine is given and none has answered."""
    if engine is not None and not _known:
        _known.update(library.read_library(engine))
    return _known


def choice(drawn, material):
    """The name that was chosen for this material on this object, or None: the material's nodes are read."""
    if drawn.original.lightwell.use:
        return drawn.original.lightwell.use
    if material is not None and material.lightwell.use:
        return material.lightwell.use
    return next((c.lightwell.use for c in drawn.collections if c.lightwell.use), None)


def add(folder, chosen, name, notes):
    """(name of the material in the folder, whether it emits): grey with a note when the library does not have it."""
    material = known().get(chosen)
    if material is None:
        notes.append(f"no material of the library is called \"{chosen}\": 50 % grey is taken. See the list under "
                     "Scene > Lightwell > Layers" if known() else
                     f"the library is not known yet, \"{chosen}\" is taken as 50 % grey: the engine was not found")
        folder.material("plastic", name, numbers=(0.5, 0.5, 0.5, 0, 0))
        return name, False
    return name, library.add_library_material(folder, material, name)
