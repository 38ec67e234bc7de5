"""blender_picture -- in Blender: import a model, show its texture, render with
Cycles, and compare with a picture of osdtex.

    blender -b --factory-startup --python blender_picture.py -- \
        MODEL.obj TEXTURE.exr PICTURE.exr UV_SMOOTH LEVEL X,Y,Z,TX,TY,TZ,FOV

A level above 0 subdivides with the modifier. TEXTURE `-` shows the picture that
the importer itself loaded by way of the MTL.

Prints `model FACES VERTICES UVS IMAGE WIDTH HEIGHT FLOAT` and `difference MEAN
P99 MAX of PIXELS`.
"""

import math
import sys

import bpy
import numpy as np
from mathutils import Matrix, Vector

CAGE, TEXTURE, PICTURE, UV_SMOOTH, LEVEL, CAMERA = sys.argv[
    sys.argv.index("--") + 1 :
]
WIDTH, HEIGHT = 320, 240


def tags():
    for line in open(CAGE):
        words = line.split()
        if words[:2] == ["t", "crease"]:
            yield (int(words[3]), int(words[4])), float(words[5])
        if words[:2] == ["t", "corner"]:
            yield (int(words[3]),), float(words[4])


def import_cage():
    # The axes as they are.
    bpy.ops.wm.obj_import(filepath=CAGE, forward_axis="Y", up_axis="Z")
    parts = [o for o in bpy.context.selected_objects if o.type == "MESH"]
    assert len(parts) == 1, "one object is expected"
    return parts[0]


def set_creases(mesh):
    """OBJ readers lose them. Blender squares what it is given, times ten."""
    edges = {tuple(sorted(e.vertices)): e for e in mesh.edges}
    sharp = {key: s for key, s in tags()}
    corners = [key for key in sharp if len(key) == 1]
    layer = None
    if corners:
        mesh.vertex_creases.new()
        layer = mesh.vertex_creases[0].data
    for key, sharpness in sharp.items():
        crease = math.sqrt(min(sharpness, 10.0) / 10.0)
        if len(key) == 2:
            edges[tuple(sorted(key))].crease = crease
        else:
            layer[key[0]].value = crease


def subdivide(cage):
    modifier = cage.modifiers.new("subdivision", "SUBSURF")
    modifier.levels = modifier.render_levels = int(LEVEL)
    modifier.quality = 6
    modifier.uv_smooth = UV_SMOOTH
    modifier.boundary_smooth = "PRESERVE_CORNERS"
    modifier.use_limit_surface = True
    modifier.use_creases = True


def picture_of(mesh):
    if TEXTURE != "-":
        return bpy.data.images.load(TEXTURE)
    found = [
        node.image
        for material in mesh.materials
        for node in material.node_tree.nodes
        if node.type == "TEX_IMAGE" and node.image
    ]
    assert len(set(found)) == 1, "one picture is expected"
    return found[0]


def describe(mesh, image):
    """What came in; UVS is a sum over all corners, which no order changes."""
    uvs = np.empty(2 * len(mesh.loops), np.float32)
    mesh.uv_layers.active.data.foreach_get("uv", uvs)
    print(
        "model %d %d %.6f %s %d %d %d"
        % (
            len(mesh.polygons), len(mesh.vertices), uvs.sum(dtype=np.float64),
            image.name, image.size[0], image.size[1], image.is_float,
        )
    )


def show_texture(mesh):
    material = bpy.data.materials.new("baked")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    light = tree.nodes.new("ShaderNodeEmission")
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image = picture_of(mesh)
    # The numbers as they are: both pictures stay in the bake's space.
    texture.image.colorspace_settings.name = "Non-Color"
    texture.extension = "REPEAT" if TEXTURE == "-" else "EXTEND"
    describe(mesh, texture.image)
    tree.links.new(texture.outputs["Color"], light.inputs["Color"])
    tree.links.new(light.outputs[0], output.inputs["Surface"])
    mesh.materials.clear()
    mesh.materials.append(material)


def set_camera():
    x, y, z, tx, ty, tz, fov = (float(v) for v in CAMERA.split(","))
    eye, target = Vector((x, y, z)), Vector((tx, ty, tz))
    back = (eye - target).normalized()
    right = Vector((0.0, 1.0, 0.0)).cross(back).normalized()
    up = back.cross(right)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.sensor_fit = "VERTICAL"
    camera.data.angle = math.radians(fov)
    camera.data.clip_start, camera.data.clip_end = 1e-3, 1e5
    camera.matrix_world = Matrix.Translation(eye) @ Matrix(
        (right, up, back)
    ).transposed().to_4x4()
    bpy.context.scene.collection.objects.link(camera)
    bpy.context.scene.camera = camera


def render(path):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 64
    scene.cycles.seed = 1
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 1.0
    scene.render.film_transparent = True
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_mode = "RGBA"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


def pixels(path):
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    out = np.empty(WIDTH * HEIGHT * 4, np.float32)
    image.pixels.foreach_get(out)
    return out.reshape(HEIGHT, WIDTH, 4)


def inside(alpha):
    """Pixels that the model covers with all their neighbours."""
    full = alpha > 0.999
    out = full.copy()
    for dy in (-1, 0, 1):
        for dx in (-1, 0, 1):
            out &= np.roll(np.roll(full, dy, 0), dx, 1)
    return out


def main():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    cage = import_cage()
    if int(LEVEL) > 0:
        set_creases(cage.data)
        subdivide(cage)
    show_texture(cage.data)
    set_camera()
    path = PICTURE[:-4] + "_cycles.exr"
    render(path)
    ours, theirs = pixels(PICTURE), pixels(path)
    mask = inside(theirs[..., 3])
    d = np.abs(ours - theirs)[..., :3].max(axis=2)[mask]
    print(
        "difference %.5f %.5f %.5f of %d"
        % (d.mean(), np.percentile(d, 99), d.max(), mask.sum())
    )


main()
