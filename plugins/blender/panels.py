"""Panels: engine and quality under Render, the rest under Scene, and one for each material, lamp and object."""

import csv
import io

import bpy

from . import library_materials, show_results
from .scene_walk import Collections


class LightwellPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__
    engine: bpy.props.StringProperty(
        name="Engine", subtype="FILE_PATH",
        description="Path of the program lightwell. Empty: LIGHTWELL_ENGINE, bin/ beside the add-on, then PATH")

    def draw(self, context):
        row = self.layout.row()
        row.prop(self, "engine")
        row.operator("lightwell.check_engine")


class _ScenePanel(bpy.types.Panel):
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "scene"
    bl_parent_id = "LIGHTWELL_PT_scene"

    def lay(self, context):
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        return layout, context.scene.lightwell


class LIGHTWELL_PT_scene(bpy.types.Panel):
    bl_label, bl_idname = "Lightwell", "LIGHTWELL_PT_scene"
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "scene"

    def draw(self, context):
        column = self.layout.column(align=True)
        column.scale_y = 1.3
        column.operator("lightwell.illuminance", icon="LIGHT_SUN")
        row = column.row(align=True)
        row.operator("lightwell.clear", icon="LOOP_BACK")
        row.operator("lightwell.export_table", icon="FILE_TEXT")


class LIGHTWELL_PT_quality(_ScenePanel):
    bl_label = "Quality"

    def draw(self, context):
        layout, settings = self.lay(context)
        layout.prop(settings, "quality")
        layout.prop(settings, {"ACCURACY": "accuracy", "TIME": "seconds", "SAMPLES": "samples"}[settings.quality])
        layout.prop(settings, "seed")
        layout.prop(settings, "chord")
        layout.prop(settings, "surface_spacing")
        layout.prop(settings, "false_colour_top")
        layout.prop(settings, "keep_light")


class LIGHTWELL_PT_sky(_ScenePanel):
    bl_label = "Sky"

    def draw(self, context):
        layout, settings = self.lay(context)
        layout.prop(settings, "sky")
        if settings.sky not in ("WORLD", "NONE"):
            for name in ("latitude", "longitude", "time", "north", "turbidity", "ground"):
                layout.prop(settings, name)


class LIGHTWELL_PT_luminaires(_ScenePanel):
    bl_label = "Luminaires"

    def draw(self, context):
        layout, settings = self.lay(context)
        layout.prop(settings, "efficacy")
        for obj in context.scene.objects:
            if obj.type == "LIGHT":
                row = layout.row(align=True)
                row.use_property_split = False
                row.label(text=obj.name, icon=f"LIGHT_{obj.data.type}")
                row.prop(obj.data.lightwell, "lumens", text="lx" if obj.data.type == "SUN" else "lm")
                if not obj.data.lightwell.lumens:
                    row.label(text=f"{obj.data.energy:g} W" + ("/m²" if obj.data.type == "SUN" else ""))


class LIGHTWELL_PT_layers(_ScenePanel):
    bl_label = "Layers"

    def draw(self, context):
        layout, _ = self.lay(context)
        layout.use_property_split = False
        known = library_materials.known()
        for name, path in Collections(context.scene).paths.items():
            settings = bpy.data.collections[name].lightwell
            row = layout.row(align=True)
            row.alert = bool(settings.use and known and settings.use not in known)
            row.label(text=path, icon="OUTLINER_COLLECTION")
            row.prop(settings, "use", text="")
            row.label(text=f"{settings.objects} objects, {settings.faces} faces")
        row = layout.row(align=True)
        for operator in ("lightwell.count_layers", "lightwell.propose", "lightwell.clear_map", "lightwell.save_map",
                         "lightwell.load_map"):
            row.operator(operator)
        layout.operator("lightwell.export_scene")


class LIGHTWELL_PT_results(_ScenePanel):
    bl_label = "Results"

    @classmethod
    def poll(cls, context):
        return show_results.shown(context.scene)

    def draw(self, context):
        text = bpy.data.texts.get(show_results.TABLE)
        rows = csv.DictReader(io.StringIO(text.as_string() if text is not None else ""))
        for row in (row for row in rows if row["kind"] != "object"):
            line = self.layout.split(factor=0.5)
            icon = "MESH_GRID" if row["kind"] == "grid" else "OUTLINER_COLLECTION"
            line.label(text=row["name"].rsplit("/", 1)[-1] or "(scene)", icon=icon)
            line.label(text=f"{float(row['mean_lx']):.0f} ± {float(row['error_lx']):.0f} lx")
            if row["kind"] == "grid":
                line = self.layout.split(factor=0.5)
                line.label(text="minimum/mean", icon="BLANK1")
                line.label(text=f"{float(row['min_over_mean']):.2f}")
        self.layout.label(text=f"All numbers: text \"{show_results.TEXT}\"")


class _DataPanel(bpy.types.Panel):
    bl_label = "Lightwell"
    bl_space_type, bl_region_type = "PROPERTIES", "WINDOW"

    def fields(self, owner, *names):
        self.layout.use_property_split, self.layout.use_property_decorate = True, False
        for name in names:
            self.layout.prop(owner, name)


class LIGHTWELL_PT_material(_DataPanel):
    bl_context = "material"

    @classmethod
    def poll(cls, context):
        return context.material is not None

    def draw(self, context):
        self.fields(context.material.lightwell, "use", "pane", "transmittance", "luminance")
        entry = library_materials.known().get(context.material.lightwell.use)
        if entry is not None:
            self.layout.label(text=entry.description)


class LIGHTWELL_PT_lamp(_DataPanel):
    bl_context = "data"

    @classmethod
    def poll(cls, context):
        return context.light is not None

    def draw(self, context):
        self.fields(context.light.lightwell, "lumens", "kelvin", "ies")


class LIGHTWELL_PT_object(_DataPanel):
    bl_context = "object"

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH"

    def draw(self, context):
        self.fields(context.object.lightwell, "use", "is_grid")
        if context.object.lightwell.is_grid:
            self.fields(context.object.lightwell_grid, "spacing", "height")


CLASSES = (LightwellPreferences, LIGHTWELL_PT_scene, LIGHTWELL_PT_results, LIGHTWELL_PT_quality, LIGHTWELL_PT_sky, LIGHTWELL_PT_luminaires,
           LIGHTWELL_PT_layers, LIGHTWELL_PT_material, LIGHTWELL_PT_lamp, LIGHTWELL_PT_object)
register, unregister = bpy.utils.register_classes_factory(CLASSES)
