"""What of a document is in the model: visible objects with a shape or a mesh, links and arrays element by element."""

import numpy as np

from lightwell_bridge.names import UniqueNames

IDENTITY = np.eye(4)
# Containers of Arch show what they contain; their own shape repeats it.
_CONTAINERS = {"Site", "Building", "BuildingPart", "Project", "Floor", "Layer", "LayerContainer", "MaterialContainer"}


class Placed:
    """One object, or one element of an array, in the model.

    path     "LAYER/LABEL", unique; of an element "LAYER/LABEL/NUMBER"
    owner    the document object that a user sees and that gets results; leaf the one that has the geometry
    subname  how the owner names the leaf: "" or "0." or "Group.Box."
    matrix   4 x 4, millimetres, from the leaf's own coordinates to the model's
    """

    def __init__(self, path, owner, leaf, subname, matrix, layer, group):
        self.path, self.owner, self.leaf, self.subname = path, owner, leaf, subname
        self.matrix, self.layer, self.group = matrix, layer, group

    def is_mesh(self):
        return self.leaf.isDerivedFrom("Mesh::Feature")

    def shape(self):
        """The leaf's shape in its own coordinates."""
        shape = self.leaf.Shape.copy()
        shape.Placement = type(shape.Placement)()
        return shape

    def mesh(self):
        """(points n x 3, triangles) in the leaf's own coordinates."""
        mesh = self.leaf.Mesh.copy()
        mesh.Placement = type(mesh.Placement)()
        points, triangles = mesh.Topology
        return np.array([tuple(p) for p in points]).reshape(-1, 3), triangles


def kind_of(obj):
    """The Draft or Arch type of an object: "Wall", "Layer", ..., or nothing."""
    return getattr(getattr(obj, "Proxy", None), "Type", "") or ""


def layers_of(document):
    """Name of an object -> the Draft layer it is in."""
    return {member.Name: layer for layer in document.Objects if kind_of(layer) == "Layer"
            for member in layer.Group}


def placed_objects(document, skipped=lambda obj, why: None):
    """Everything that is visible, in the order of the document; `skipped` hears why an object with a face is not."""
    layers, names, found = layers_of(document), UniqueNames(), []
    for obj in document.Objects:
        if not _has_geometry(obj):
            continue
        layer = layers.get(obj.Name)
        hidden = _why_hidden(obj, layer)
        if hidden:
            skipped(obj, hidden)
            continue
        found.extend(_elements(obj, layer, names, skipped))
    return found


def _has_geometry(obj):
    if kind_of(obj) in _CONTAINERS or _belongs_to_a_body(obj) or getattr(obj, "LightwellRole", "") in ("result", "view"):
        return False
    return _is_link(obj) or _is_leaf(obj)


def _is_leaf(obj):
    if obj.isDerivedFrom("Mesh::Feature"):
        return obj.Mesh.CountFacets > 0
    shape = getattr(obj, "Shape", None)
    return hasattr(shape, "Faces") and not shape.isNull() and len(shape.Faces) > 0


def _is_link(obj):
    return obj.hasExtension("App::LinkBaseExtension") and not obj.isDerivedFrom("App::LinkElement")


def _belongs_to_a_body(obj):
    """Steps of a PartDesign body; the body itself shows the last of them."""
    parent = obj.getParentGeoFeatureGroup()
    return parent is not None and parent.TypeId == "PartDesign::Body"


def _why_hidden(obj, layer):
    if not obj.Visibility:
        return "it is hidden"
    if layer is not None and not layer.Visibility:
        return f"its layer \"{layer.Label}\" is off"
    parent = obj.getParentGeoFeatureGroup()
    while parent is not None:
        if not parent.Visibility:
            return f"it is in \"{parent.Label}\", which is hidden"
        parent = parent.getParentGeoFeatureGroup()
    return None


def _group_label(obj):
    group = obj.getParentGroup() or obj.getParentGeoFeatureGroup()
    if group is None:
        group = next((p for p in obj.InList if kind_of(p) in ("BuildingPart", "Building", "Floor")), None)
    return group.Label if group is not None else None


def _elements(obj, layer, names, skipped):
    wanted = f"{layer.Label}/{obj.Label}" if layer is not None else obj.Label
    path = names.of(obj.Name, wanted)
    label, group = layer.Label if layer is not None else None, _group_label(obj)
    base = _matrix_of_parents(obj)
    if not _is_link(obj):
        matrix = base @ _matrix((obj if obj.isDerivedFrom("Mesh::Feature") else obj.Shape).Placement.Matrix)
        return [Placed(path, obj, obj, "", matrix, label, group)]
    leaves = list(_leaves(obj, "", skipped))
    found = []
    for number, (leaf, subname, matrix) in enumerate(leaves):
        own = path if len(leaves) == 1 else f"{path}/{number}"
        found.append(Placed(own, obj, leaf, subname, base @ matrix, label, group))
    return found


def _leaves(link, subname, skipped, depth=0):
    """(object with geometry, its name below the link, matrix) of everything that a link or array shows."""
    if depth > 32:
        raise ValueError(f"\"{link.Label}\" leads to itself over links")
    obj = link if not subname else link.getSubObject(subname, retType=1)
    if obj is None:
        skipped(link, f"its element {subname} leads to nothing")
        return
    if subname and not obj.Visibility and not obj.isDerivedFrom("App::LinkElement") and _named_by_container(subname):
        skipped(link, f"its part \"{obj.Label}\" is hidden")
        return
    leaf = obj.getLinkedObject(True)
    below = [subname + s for s in obj.getSubObjects()]
    if leaf.TypeId == "PartDesign::Body" or (_is_leaf(leaf) and not _is_link(leaf)):
        below = below if not subname and _counts_elements(below) else []
    if not below:
        if _is_leaf(leaf):
            yield leaf, subname, _matrix(link.getSubObject(subname, retType=4)) @ _beyond(obj)
        elif subname == "":
            skipped(link, "what it links to has no face")
        return
    for deeper in below:
        yield from _leaves(link, deeper, skipped, depth + 1)


def _beyond(obj):
    """From the leaf's own coordinates to those of a link before its placement: scales, and placements it takes over."""
    if not (obj.hasExtension("App::LinkBaseExtension") and getattr(obj, "LinkedObject", None) is not None):
        return IDENTITY
    target = obj.LinkedObject
    placement = _matrix(target.Placement.Matrix) if obj.LinkTransform and hasattr(target, "Placement") else IDENTITY
    return np.diag([*(float(v) for v in obj.ScaleVector), 1.0]) @ placement @ _beyond(target)


def _counts_elements(subnames):
    return bool(subnames) and all(s.rstrip(".").isdigit() for s in subnames)


def _named_by_container(subname):
    """Members of a container obey their own visibility; elements of an array show what they link to anyway."""
    return not subname.rstrip(".").split(".")[-1].isdigit()


def _matrix_of_parents(obj):
    parent = obj.getParentGeoFeatureGroup()
    return IDENTITY if parent is None else _matrix(parent.getGlobalPlacement().Matrix)


def _matrix(matrix):
    return np.array(matrix.A).reshape(4, 4)
