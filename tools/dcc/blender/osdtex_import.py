"""osdtex_import -- a baked cage into Blender, as it is meant to be shown.

    blender --python osdtex_import.py -- FOLDER/NAME_cage.obj

or, in a script of your own:

    import osdtex_import
    cage = osdtex_import.load("FOLDER/NAME_cage.obj")

Blender's OBJ importer brings the cage, its material and its texture. It loses
what OBJ has no standard word for, and this adds: creases and corners, the
subdivision modifier with the UV rule that the file states, the UDIM tiles of a
texture as one tiled image, and the other maps of a material: roughness,
metalness and normals as numbers, and heights as displacement. Works from
Blender 3.4 on.
"""

import math
import re
import sys
from pathlib import Path

import bmesh
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
        set_corners(mesh, tags.corners)


def set_corners(mesh, corners):
    """Before Blender 4 only bmesh makes the layer."""
    shape = bmesh.new()
    shape.from_mesh(mesh)
    layer = shape.verts.layers.crease.verify()
    shape.verts.ensure_lookup_table()
    for vertex, sharpness in corners.items():
        shape.verts[vertex][layer] = crease_of(sharpness)
    shape.to_mesh(mesh)
    shape.free()


def subdivide(cage, tags, levels):
    modifier = cage.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = modifier.render_levels = levels
    modifier.quality = 6
    modifier.uv_smooth = UV_SMOOTH[tags.fvar]
    modifier.boundary_smooth = "PRESERVE_CORNERS"
    modifier.use_limit_surface = True
    modifier.use_creases = True


def textures_of(cage):
    """For each material that the MTL named: its files by their keys."""
    found, name = {}, None
    for line in cage.with_suffix(".mtl").read_text(errors="replace").splitlines():
        key, _, value = line.strip().partition(" ")
        if key == "newmtl":
            name = value
        elif key in ("map_Kd", "map_Pr", "map_Pm", "norm", "disp"):
            found.setdefault(name, {})[key] = cage.parent / value
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


def image_of(path):
    if "<UDIM>" in path.name:
        return tiled_image(path)
    return bpy.data.images.load(str(path), check_existing=True)


def show_color(tree, surface, texture, cage):
    """The importer has done it but for tiles and spaces."""
    links = surface.inputs["Base Color"].links
    node = links[0].from_node if links else None
    if not node:
        node = tree.nodes.new("ShaderNodeTexImage")
        tree.links.new(node.outputs["Color"], surface.inputs["Base Color"])
    if "<UDIM>" in texture.name or not node.image:
        node.image = image_of(texture)
    set_space(node.image, cage)


def data_node(tree, path):
    """A map of numbers, which no colour space is to change."""
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = image_of(path)
    node.image.colorspace_settings.name = "Non-Color"
    return node.outputs["Color"]


def show_data(material, surface, files):
    tree = material.node_tree
    output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
    for key, socket in (("map_Pr", "Roughness"), ("map_Pm", "Metallic")):
        if key in files:
            tree.links.new(data_node(tree, files[key]), surface.inputs[socket])
    if "norm" in files:
        bend = tree.nodes.new("ShaderNodeNormalMap")
        tree.links.new(data_node(tree, files["norm"]), bend.inputs["Color"])
        tree.links.new(bend.outputs["Normal"], surface.inputs["Normal"])
    if "disp" in files:
        lift = tree.nodes.new("ShaderNodeDisplacement")
        lift.inputs["Midlevel"].default_value = 0.0
        lift.inputs["Scale"].default_value = 1.0
        tree.links.new(data_node(tree, files["disp"]), lift.inputs["Height"])
        tree.links.new(
            lift.outputs["Displacement"], output.inputs["Displacement"])
        if hasattr(material, "displacement_method"):
            material.displacement_method = "BOTH"
        else:
            material.cycles.displacement_method = "BOTH"
    drop_unused(tree)


def drop_unused(tree):
    """What the importer made of maps that are shown otherwise now."""
    for kind in ("NORMAL_MAP", "TEX_IMAGE"):
        for node in [n for n in tree.nodes if n.type == kind]:
            if not any(o.is_linked for o in node.outputs):
                tree.nodes.remove(node)


def files_of(textures, material):
    """Blender numbers a material whose name is taken."""
    if not material:
        return None
    plain = re.sub(r"\.\d{3,}$", "", material.name)
    return textures.get(material.name) or textures.get(plain)


def show_textures(mesh, path):
    textures = textures_of(path)
    for material in mesh.materials:
        files = files_of(textures, material)
        if not files or "map_Kd" not in files:
            continue
        surface = next(
            n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
        show_color(material.node_tree, surface, files["map_Kd"], path)
        show_data(material, surface, files)


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
