"""osdtex_import -- a baked cage into Blender, as it is meant to be shown.

    blender --python osdtex_import.py -- FOLDER/NAME_cage.obj

or, in a script of your own:

    import osdtex_import
    cage = osdtex_import.load("FOLDER/NAME_cage.obj")

Blender's OBJ importer brings the cage, its material and its texture. It loses
what OBJ has no standard word for, and this adds: creases and corners, the
subdivision modifier with the UV rule that the file states, and the UDIM tiles
of a texture as one tiled image. Works from Blender 3.4 on.
"""

import math
import re
import sys
from pathlib import Path

import bpy

# The words of OpenSubdiv for how UVs are smoothed, and the modifier's.
UV_SMOOTH = {
    "none": "SMOOTH_ALL",
    "cornersOnly": "PRESERVE_CORNERS",
    "cornersPlus1": "PRESERVE_CORNERS_AND_JUNCTIONS",
    "cornersPlus2": "PRESERVE_CORNERS_JUNCTIONS_AND_CONCAVE",
    "boundaries": "PRESERVE_BOUNDARIES",
    "all": "NONE",
}
# colorspace of NAME.mtlx, and the names of the space in Blender's own
# configurations, old and new. Linear Rec.709 is what an EXR is taken to be.
SPACES = {"acescg": ("ACEScg", "Linear ACEScg", "lin_ap1_scene")}


class Tags:
    """What the cage says behind what importers read."""

    def __init__(self, path):
        self.creases, self.corners, self.fvar = {}, {}, "all"
        for line in Path(path).read_text(errors="replace").splitlines():
            words = line.split()
            if words[:2] == ["t", "crease"]:
                self.creases[tuple(sorted(map(int, words[3:5])))] = float(words[5])
            elif words[:2] == ["t", "corner"]:
                self.corners[int(words[3])] = float(words[4])
            elif "face-varying interpolation" in line:
                self.fvar = line.split('"')[1]


def crease_of(sharpness):
    """Blender squares what it is given, and takes that times ten."""
    return math.sqrt(min(sharpness, 10.0) / 10.0)


def attribute(mesh, name, domain):
    return mesh.attributes.get(name) or mesh.attributes.new(
        name, "FLOAT", domain)


def set_creases(mesh, tags):
    edges = {tuple(sorted(e.vertices)): e for e in mesh.edges}
    creases = {edges[k]: s for k, s in tags.creases.items() if k in edges}
    if bpy.app.version >= (4, 0, 0):
        if creases:
            layer = attribute(mesh, "crease_edge", "EDGE").data
            for edge, sharpness in creases.items():
                layer[edge.index].value = crease_of(sharpness)
        if tags.corners:
            layer = attribute(mesh, "crease_vert", "POINT").data
            for vertex, sharpness in tags.corners.items():
                layer[vertex].value = crease_of(sharpness)
        return
    for edge, sharpness in creases.items():
        edge.crease = crease_of(sharpness)
    if tags.corners:
        layer = (mesh.vertex_creases or [mesh.vertex_creases.new()])[0].data
        for vertex, sharpness in tags.corners.items():
            layer[vertex].value = crease_of(sharpness)


def subdivide(cage, tags, levels):
    modifier = cage.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = modifier.render_levels = levels
    modifier.quality = 6
    modifier.uv_smooth = UV_SMOOTH[tags.fvar]
    modifier.boundary_smooth = "PRESERVE_CORNERS"
    modifier.use_limit_surface = True
    modifier.use_creases = True


def textures_of(cage):
    """For each material that the MTL named: the file of its map_Kd."""
    found, name = {}, None
    for line in cage.with_suffix(".mtl").read_text(errors="replace").splitlines():
        key, _, value = line.strip().partition(" ")
        if key == "newmtl":
            name = value
        elif key == "map_Kd":
            found[name] = cage.parent / value
    return found


def tiled_image(path):
    """All tiles of NAME.<UDIM>.exr as one image."""
    before, after = path.name.split("<UDIM>")
    pattern = re.compile(re.escape(before) + r"(\d{4})" + re.escape(after))
    numbers = sorted(
        int(m.group(1)) for m in map(pattern.fullmatch, (
            p.name for p in path.parent.iterdir())) if m)
    if not numbers:
        raise FileNotFoundError(f"there are no tiles {path}")
    image = bpy.data.images.load(
        str(path.parent / f"{before}{numbers[0]}{after}"), check_existing=True)
    image.source = "TILED"
    for number in numbers:
        if image.tiles.get(number) is None:
            image.tiles.new(tile_number=number)
    for tile in [t for t in image.tiles if t.number not in numbers]:
        image.tiles.remove(tile)
    return image


def set_space(image, cage):
    """Only where the texture is in another space than linear Rec.709."""
    document = cage.parent / (cage.name[: -len("_cage.obj")] + ".mtlx")
    if not document.exists():
        return
    said = re.search(r'colorspace="(\w+)"', document.read_text())
    known = {
        item.identifier
        for item in type(image.colorspace_settings)
        .bl_rna.properties["name"].enum_items
    }
    for name in SPACES.get(said.group(1) if said else "", ()):
        if name in known:
            image.colorspace_settings.name = name
            return


def show_textures(mesh, path):
    textures = textures_of(path)
    for material in mesh.materials:
        texture = textures.get(material.name) if material else None
        if not texture:
            continue
        nodes = material.node_tree.nodes
        node = next((n for n in nodes if n.type == "TEX_IMAGE"), None)
        if not node:
            node = nodes.new("ShaderNodeTexImage")
            surface = next(n for n in nodes if n.type == "BSDF_PRINCIPLED")
            material.node_tree.links.new(
                node.outputs["Color"], surface.inputs["Base Color"])
        if "<UDIM>" in texture.name:
            node.image = tiled_image(texture)
        elif not node.image:
            node.image = bpy.data.images.load(str(texture), check_existing=True)
        set_space(node.image, path)


def load(path, levels=3, forward="NEGATIVE_Z", up="Y"):
    """Imports FOLDER/NAME_cage.obj and returns its object."""
    path = Path(path).resolve()
    tags = Tags(path)
    bpy.ops.wm.obj_import(filepath=str(path), forward_axis=forward, up_axis=up)
    parts = [o for o in bpy.context.selected_objects if o.type == "MESH"]
    if len(parts) > 1:
        with bpy.context.temp_override(
                active_object=parts[0], selected_editable_objects=parts):
            bpy.ops.object.join()
    cage = parts[0]
    set_creases(cage.data, tags)
    subdivide(cage, tags, levels)
    show_textures(cage.data, path)
    return cage


if __name__ == "__main__" and "--" in sys.argv:
    for argument in sys.argv[sys.argv.index("--") + 1 :]:
        load(argument)
