"""What the add-on keeps in the file: settings of the scene, and of materials, lamps and collections."""

import bpy
from bpy.props import (BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty,
                       StringProperty)

from .lightwell_bridge import sky


class MaterialSettings(bpy.types.PropertyGroup):
    use: StringProperty(name="Lightwell material", description="A material of Lightwell's library in place of the nodes, "
                        "for example grey_50 or glass_double_low_e. Empty: the nodes are read")
    pane: EnumProperty(name="Glass is", items=[
        ("AUTO", "Automatic", "A pane where the mesh is open, a solid body where it is closed"),
        ("THIN", "Thin pane", "One sheet stands for the whole pane: light goes straight through"),
        ("SOLID", "Solid body", "A closed body that refracts")], default="AUTO",
        description="Whether a transmitting surface is a pane or the boundary of a body")
    transmittance: FloatProperty(name="Transmittance", min=0, max=1, precision=3,
                                 description="Of the whole pane at normal incidence, as data sheets have it. "
                                             "0: from the base colour")
    luminance: FloatProperty(name="Luminance (cd/m²)", min=0, soft_max=20000,
                             description="What the emitting surface shows. 0: strength x colour is radiance in W/(m² sr)")


class LampSettings(bpy.types.PropertyGroup):
    lumens: FloatProperty(name="Lumens", min=0, soft_max=20000,
                          description="Luminous flux that leaves the lamp; lux for a sun. 0: the watts of Blender times "
                                      "the efficacy of the scene")
    ies: StringProperty(name="Photometric file", subtype="FILE_PATH", description="IES or EULUMDAT file of this lamp: its "
                        "light goes where it was measured, along the lamp's -z. Its lumens count unless Lumens says otherwise, "
                        "the watts of Blender do not. Empty: an IES texture of the lamp's nodes, or shining evenly")
    kelvin: FloatProperty(name="Colour temperature (K)", min=0, max=25000,
                          description="Hue of a black body of this temperature, for example 3000 for warm white. 0: the "
                                      "colour of the lamp alone")


class CollectionSettings(bpy.types.PropertyGroup):
    use: StringProperty(name="Lightwell material", description="A material of Lightwell's library for everything in this "
                        "collection. Empty: the objects' own materials")
    objects: IntProperty(description="How many objects renders draw of it, when it was last counted")
    faces: IntProperty(description="How many faces these objects have")


class ObjectSettings(bpy.types.PropertyGroup):
    use: StringProperty(name="Lightwell material", description="A material of Lightwell's library for this object. "
                        "Empty: that of the collection, or the object's own materials")
    is_grid: BoolProperty(name="Sensor grid", description="Sensors over the faces of this object: illuminance is computed "
                          "there. The object itself is not part of the scene")


class GridSettings(bpy.types.PropertyGroup):
    spacing: FloatProperty(name="Spacing (m)", default=0.25, min=0.01, soft_max=2, unit="NONE",
                           description="Distance of neighbouring sensors")
    height: FloatProperty(name="Height (m)", default=0.8, soft_min=0, soft_max=2,
                          description="Of the sensors above the faces of the object")


class SceneSettings(bpy.types.PropertyGroup):
    sky: EnumProperty(name="Sky", items=[
        ("WORLD", "From the world", "Background colour, or the sun of a sky texture with a clear sky after CIE"),
        ("NONE", "None", "Electric light only"),
        *((kind, kind.replace("-", " ").capitalize(), "CIE sky of a place and a time") for kind in sky.TYPES)],
        default="WORLD", description="Where daylight comes from")
    latitude: FloatProperty(name="Latitude", default=52.52, min=-90, max=90, precision=4, description="Of the place, in degrees; north is positive")
    longitude: FloatProperty(name="Longitude", default=13.40, min=-180, max=180, precision=4,
                             description="Of the place, in degrees; east is positive")
    time: StringProperty(name="Time", default="2026-03-21T12:00+01:00",
                         description="Local time with its offset from UTC: 2026-03-21T12:00+01:00")
    north: FloatProperty(name="North (°)", default=0, min=-360, max=360,
                         description="Direction of north in the model, counter-clockwise from +Y")
    turbidity: FloatProperty(name="Turbidity", default=2.45, min=1, max=30,
                             description="Haze of the air: 2 very clear, 2.5 clear, 5 hazy")
    ground: FloatProperty(name="Ground reflectance", default=0.2, min=0, max=1, description="Of the land around")
    efficacy: FloatProperty(name="Efficacy (lm/W)", default=179, min=1, max=683,
                            description="Lumens for each watt of Blender's lamps without lumens of their own. 179: "
                                        "white light as the engine counts it; 683: as glTF files count")
    quality: EnumProperty(name="Quality", items=[
        ("ACCURACY", "Accuracy", "Until the median error of a pixel or sensor is as stated"),
        ("TIME", "Time", "The best result in this time"),
        ("SAMPLES", "Samples", "This many paths for a pixel or sensor")], default="ACCURACY",
        description="What the effort is measured by")
    accuracy: FloatProperty(name="Accuracy (%)", default=5, min=0.2, max=50, description="One standard error, median")
    seconds: FloatProperty(name="Seconds", default=60, min=1, soft_max=3600,
                           description="How long a picture or a map may take")
    samples: IntProperty(name="Samples", default=64, min=1, soft_max=4096,
                         description="Paths for each pixel or sensor")
    seed: IntProperty(name="Seed", default=1, min=0, description="The same seed gives the same picture to the bit")
    chord: FloatProperty(name="Chord tolerance (m)", default=0.001, min=1e-6, max=1, precision=4,
                         description="How far facets of a limit surface may be from it")
    surface_spacing: FloatProperty(name="Spacing on surfaces (m)", default=0.25, min=0.01, soft_max=2,
                                   description="Of the points at which illuminance on objects is computed")
    false_colour_top: FloatProperty(name="Scale to (lx)", default=0, min=0, soft_max=10000,
                                    description="Upper end of the false colours. 0: from the results")
    keep_light: BoolProperty(name="Share light between frames", default=True,
                             description="An animation keeps ambient light from frame to frame while nothing but the "
                                         "camera moves")


CLASSES = (MaterialSettings, LampSettings, CollectionSettings, ObjectSettings, GridSettings, SceneSettings)
_OWNERS = ((bpy.types.Material, MaterialSettings, "lightwell"), (bpy.types.Light, LampSettings, "lightwell"),
           (bpy.types.Collection, CollectionSettings, "lightwell"), (bpy.types.Object, ObjectSettings, "lightwell"),
           (bpy.types.Object, GridSettings, "lightwell_grid"), (bpy.types.Scene, SceneSettings, "lightwell"))
_register_classes, _unregister_classes = bpy.utils.register_classes_factory(CLASSES)


def register():
    _register_classes()
    for owner, group, name in _OWNERS:
        setattr(owner, name, PointerProperty(type=group))


def unregister():
    for owner, _, name in _OWNERS:
        delattr(owner, name)
    _unregister_classes()
