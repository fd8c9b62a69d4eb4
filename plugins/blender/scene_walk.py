"""What Blender would draw: objects with their place, layer and materials, from a dependency graph."""

from dataclasses import dataclass

from .lightwell_bridge.names import UniqueNames

GEOMETRY = {"MESH", "CURVE", "SURFACE", "META", "FONT"}


@dataclass
class Drawn:
    """One object as it is drawn once. `matrix` takes its own frame to the world, in scene units."""

    evaluated: object
    original: object
    parent: object  # the original of the object that instances it, or None
    matrix: object
    layer: str  # path of the collection, "" for the scene's own
    collections: list  # that one and those around it, nearest first
    source: str  # unique path of this drawing


class Collections:
    """Paths of the collections of a scene, and what hides them."""

    def __init__(self, scene):
        self.paths, self._chains, self._hidden = {}, {"": []}, set()
        self._visit(scene.collection, "", False)

    def _visit(self, collection, path, hidden):
        for child in collection.children:
            name = child.name.replace("/", "∕")
            below = f"{path}/{name}" if path else name
            if child.name in self.paths:
                continue
            self.paths[child.name] = below
            self._chains[below] = [child] + self._chains[path]
            gone = hidden or child.hide_render
            if gone:
                self._hidden.add(child.name)
            self._visit(child, below, gone)

    def layer_of(self, original):
        """The object's first collection, in the order of the scene."""
        own = {c.name for c in original.users_collection}
        return next((path for name, path in self.paths.items() if name in own), "")

    def around(self, layer):
        """The collections of a path, nearest first."""
        return self._chains[layer]

    def hides(self, original):
        """Whether every collection of the object is switched off for renders."""
        own = [c.name for c in original.users_collection if c.name in self.paths]
        return bool(own) and all(name in self._hidden for name in own)


def drawn_objects(depsgraph, types):
    """Yields each Drawn of the given types; what `hide_render` hides is left out also in a viewport's graph."""
    collections, names = Collections(depsgraph.scene_eval), UniqueNames()
    for number, instance in enumerate(depsgraph.object_instances):
        evaluated = instance.instance_object if instance.is_instance else instance.object
        if evaluated is None or evaluated.type not in types:
            continue
        original = evaluated.original
        parent = instance.parent.original if instance.is_instance and instance.parent else None
        placed = parent or original
        if placed.hide_render or original.hide_render or collections.hides(placed):
            continue
        if not instance.is_instance and not instance.show_self:
            continue
        layer = collections.layer_of(placed)
        path = [p for p in (layer, *(o.name.replace("/", "∕") for o in (parent, original) if o)) if p]
        yield Drawn(evaluated, original, parent, instance.matrix_world.copy(), layer,
                    collections.around(layer), names.of(number, "/".join(path)))
