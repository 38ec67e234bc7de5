"""panel -- what the artist sees: settings, a button, and how far it is."""

import bpy
from bpy.props import (
    BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty,
    StringProperty)

from . import osdtex_job, work

METHODS = [
    ("hierarchical", "Hierarchical", "Patches that follow the subdivision, for anything"),
    ("auto", "By the picture", "The method that suits the picture"),
    ("lapped", "Lapped", "Overlapping pieces, for sparse features"),
    ("vertex", "Made on the surface", "Texture made anew, texel by texel"),
    ("material", "Lattice", "For bricks, tiles and weaves"),
]


def same(*names):
    return [(n, n, "") for n in names]


class Settings(bpy.types.PropertyGroup):
    exemplar: StringProperty(
        name="Picture", subtype="FILE_PATH",
        description="A picture of the material, or the folder of its maps")
    scale: FloatProperty(
        name="Width", min=0.0, subtype="DISTANCE",
        description="Width of the picture on the surface, in scene units; 0: "
        "a fifth of the object's diagonal")
    method: EnumProperty(name="Method", items=METHODS)
    resolution: IntProperty(
        name="Resolution", default=2048, min=16, max=32768,
        description="Texels of a UDIM tile's side")
    scheme: EnumProperty(
        name="Scheme", items=same("catmark", "loop", "bilinear"))
    uvs: EnumProperty(name="UVs", items=same("auto", "own", "atlas", "charts"))
    constraints: StringProperty(
        name="Directions",
        description="An attribute of vectors, or of colours as in a normal map, "
        "that says which way the texture runs")
    sizes: StringProperty(
        name="Sizes",
        description="An attribute of numbers by which the texture is larger")
    follow: EnumProperty(
        name="Follow", items=[("none", "as it comes", "")]
        + same("smooth", "up", "edges", "curvature"))
    seed: IntProperty(name="Seed", default=1, min=0)
    folder: StringProperty(
        name="Folder", subtype="DIR_PATH",
        description="Where files go; empty: osdtex, beside the .blend")
    stage: StringProperty(options={"SKIP_SAVE"})
    percent: IntProperty(options={"SKIP_SAVE"}, subtype="PERCENTAGE", max=100)
    stop: BoolProperty(options={"SKIP_SAVE"})

    def wish(self, context):
        preferences = context.preferences.addons.get(__package__)
        return work.Wish(
            exemplar=self.exemplar, scale=self.scale, method=self.method,
            resolution=self.resolution, scheme=self.scheme, uvs=self.uvs,
            constraints=self.constraints, sizes=self.sizes,
            follow="" if self.follow == "none" else self.follow,
            seed=self.seed, folder=self.folder,
            program=preferences.preferences.program if preferences else "")


class Preferences(bpy.types.AddonPreferences):
    bl_idname = __package__
    program: StringProperty(
        name="Program", subtype="FILE_PATH",
        description="osdtex; empty: $OSDTEX, else the one on the path")

    def draw(self, _context):
        self.layout.prop(self, "program")


class Texture(bpy.types.Operator):
    """Texture the active object. Esc stops it"""

    bl_idname = "osdtex.texture"
    bl_label = "Texture"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        part = context.active_object
        return part is not None and part.type == "MESH" and part.mode == "OBJECT"

    def refuse(self, context, sentence):
        self.report({"ERROR"}, sentence)
        context.scene.osdtex.stage = ""
        return {"CANCELLED"}

    def execute(self, context):
        try:
            work.texture(
                context.active_object, context.scene.osdtex.wish(context))
        except osdtex_job.Failed as error:
            return self.refuse(context, str(error))
        return {"FINISHED"}

    def invoke(self, context, _event):
        if bpy.app.background:
            return self.execute(context)
        settings = context.scene.osdtex
        self.part = context.active_object
        try:
            self.job, self.result = work.begin(
                self.part, settings.wish(context))
        except osdtex_job.Failed as error:
            return self.refuse(context, str(error))
        settings.stop = False
        self.timer = context.window_manager.event_timer_add(
            0.2, window=context.window)
        context.window_manager.progress_begin(0, 100)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        settings = context.scene.osdtex
        if event.type == "ESC" or settings.stop:
            self.job.cancel()
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        settings.stage, settings.percent = self.job.stage, self.job.percent
        context.window_manager.progress_update(self.job.percent)
        for area in context.screen.areas:
            area.tag_redraw()
        if self.job.poll():
            return {"RUNNING_MODAL"}
        return self.end(context)

    def end(self, context):
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()
        context.scene.osdtex.stage = ""
        try:
            self.job.check()
            work.finish(self.part, self.result, 3)
        except osdtex_job.Failed as error:
            return self.refuse(context, str(error))
        for sentence in self.job.warnings():
            self.report({"WARNING"}, sentence)
        return {"FINISHED"}


class Stop(bpy.types.Operator):
    """Stop the program; nothing is written"""

    bl_idname = "osdtex.stop"
    bl_label = "Stop"

    def execute(self, context):
        context.scene.osdtex.stop = True
        return {"FINISHED"}


class Export(bpy.types.Operator):
    """Write the active object as a cage with its creases and corners"""

    bl_idname = "osdtex.export"
    bl_label = "Write the Cage"
    filepath: StringProperty(subtype="FILE_PATH")
    filter_glob: StringProperty(default="*.obj", options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        return Texture.poll(context)

    def invoke(self, context, _event):
        self.filepath = f"{context.active_object.name}.obj"
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        try:
            work.export_cage(
                context.active_object, bpy.path.abspath(self.filepath))
        except (osdtex_job.Failed, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class Panel(bpy.types.Panel):
    bl_idname = "OSDTEX_PT_panel"
    bl_label = "osdtex"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "osdtex"

    def draw(self, context):
        settings, layout = context.scene.osdtex, self.layout
        layout.use_property_split = True
        for name in ("exemplar", "scale", "method", "resolution", "uvs", "scheme",
                     "follow"):
            layout.prop(settings, name)
        part = context.active_object
        if part and part.type == "MESH":
            for name in ("constraints", "sizes"):
                layout.prop_search(settings, name, part.data, "attributes")
        for name in ("seed", "folder"):
            layout.prop(settings, name)
        if settings.stage:
            row = layout.row()
            row.label(text=f"{settings.stage} {settings.percent} %")
            row.operator("osdtex.stop", icon="X")
        else:
            layout.operator("osdtex.texture", icon="TEXTURE")
        layout.operator("osdtex.export", icon="EXPORT")


CLASSES = (Settings, Preferences, Texture, Stop, Export, Panel)


def register():
    for item in CLASSES:
        bpy.utils.register_class(item)
    bpy.types.Scene.osdtex = PointerProperty(type=Settings)


def unregister():
    del bpy.types.Scene.osdtex
    for item in reversed(CLASSES):
        bpy.utils.unregister_class(item)
