"""What the objects of Lightwell in the tree have in common: properties by table, and how they are saved."""


class Feature:
    """Proxy of a scripted object: `kind` names it, `PROPERTIES` lists (type, name, group, tooltip, default)."""

    kind = "Feature"
    PROPERTIES = ()

    def __init__(self, obj):
        obj.Proxy = self
        self.ensure(obj)

    def ensure(self, obj):
        """Adds the properties that are missing, also to objects saved by an earlier version."""
        for kind, name, group, tooltip, default in self.PROPERTIES:
            if name not in obj.PropertiesList:
                obj.addProperty(kind, name, group, tooltip)
                if isinstance(default, list) and kind == "App::PropertyEnumeration":
                    setattr(obj, name, default)
                    setattr(obj, name, default[0])
                elif default is not None:
                    setattr(obj, name, default)

    def onDocumentRestored(self, obj):
        obj.Proxy = self
        self.ensure(obj)

    def execute(self, obj):
        """Nothing is computed on recompute: a simulation starts when it is asked for."""

    @property
    def Type(self):
        return "Lightwell" + self.kind

    # Saved documents hold no state of proxies: FreeCAD up to 0.20 asks by the first pair of names, later by the second.
    def __getstate__(self):
        return None

    def __setstate__(self, state):
        return None

    dumps, loads = __getstate__, __setstate__


class View:
    """Shows an icon in the tree."""

    def __init__(self, provider, icon):
        self._icon = icon
        provider.Proxy = self

    def attach(self, provider):
        self._provider = provider

    def getIcon(self):
        return self._icon

    def __getstate__(self):
        return self._icon

    def __setstate__(self, state):
        self._icon = state

    dumps, loads = __getstate__, __setstate__
