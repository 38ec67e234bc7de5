"""osdtex -- textures the active object with a picture of a material.

An add-on for Blender from 3.4 on: a panel in the sidebar of the 3D view. The
object is the cage; the program osdtex bakes a texture onto its UVs, or onto an
atlas, and what comes back is a new object in its place: with creases, the
subdivision modifier and its UV rule, UDIM tiles and a Principled material.

In a script, without the panel:

    from osdtex_blender import work
    part = work.texture(bpy.context.object, work.Wish(exemplar="bark.png"))
"""

bl_info = {
    "name": "osdtex",
    "description": "Textures subdivision surfaces from a picture of a material",
    "author": "The osdtex authors",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > osdtex",
    "category": "Material",
}

from . import panel  # noqa: E402


def register():
    panel.register()


def unregister():
    panel.unregister()
