"""blender_picture -- in Blender: import a model, show its texture, render with
Cycles, and compare with a picture of osdtex.

    blender -b --factory-startup --python blender_picture.py -- \
        MODEL.obj PICTURE.exr UV_SMOOTH LEVEL X,Y,Z,TX,TY,TZ,FOV

At level 0 the model is what the importer makes of it. Above, it is a baked cage
and loaded by tools/dcc/blender/osdtex_import.py, with another rule for UVs
unless UV_SMOOTH is `-`; a .usda by Blender's own importer, with subdivision.
Textures are taken as Blender loads them: nothing is said about their colours.

Prints `map SOCKET FILE SPACE` for each texture that a surface gets, `model FACES VERTICES UVS`, `image NAME WIDTH HEIGHT FLOAT SOURCE SPACE`
and `difference MEAN P99 MAX DELTA_E of PIXELS`; Delta E is the mean distance in
CIELAB (1976).
"""

import math
import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix, Vector

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tools/dcc/blender"))

import osdtex_import  # noqa: E402

MODEL, PICTURE, UV_SMOOTH, LEVEL, CAMERA = sys.argv[sys.argv.index("--") + 1 :]
WIDTH, HEIGHT = 320, 240


def import_usd():
    """The mesh where the file has it, whatever its unit and its axes are."""
    bpy.ops.wm.usd_import(filepath=MODEL, import_subdivision=True)
    part = next(o for o in bpy.data.objects if o.type == "MESH")
    part.matrix_world = Matrix.Identity(4)
    for modifier in part.modifiers:
        modifier.levels = modifier.render_levels = int(LEVEL)
        modifier.quality = 6
    assert len(part.modifiers) == 1, "subdivision is expected"
    return part


def import_model():
    """The axes as they are."""
    if MODEL.endswith(".usda"):
        return import_usd()
    if int(LEVEL) > 0:
        part = osdtex_import.load(MODEL, int(LEVEL), "Y", "Z")
        if UV_SMOOTH != "-":
            part.modifiers[0].uv_smooth = UV_SMOOTH
        return part
    bpy.ops.wm.obj_import(filepath=MODEL, forward_axis="Y", up_axis="Z")
    parts = [o for o in bpy.context.selected_objects if o.type == "MESH"]
    assert len(parts) == 1, "one object is expected"
    return parts[0]


def describe(mesh):
    """What came in; UVS is a sum over all corners, which no order changes."""
    uvs = np.empty(2 * len(mesh.loops), np.float32)
    mesh.uv_layers.active.data.foreach_get("uv", uvs)
    print(
        "model %d %d %.6f"
        % (
            len(mesh.polygons), len(mesh.vertices), uvs.sum(dtype=np.float64),
        )
    )


def end_of(socket):
    """Where what an image gives comes in, through nodes that only part or turn
    it over."""
    for link in socket.links:
        to = link.to_node
        if to.type in ("SEPARATE_COLOR", "SEPRGB", "NORMAL_MAP", "DISPLACEMENT"):
            return end_of(to.outputs[0])
        return link.to_socket.name


def describe_maps(tree):
    for node in tree.nodes:
        if node.type == "TEX_IMAGE" and node.outputs["Color"].links:
            print(
                "map %s %s %s" % (
                    end_of(node.outputs["Color"]).replace(" ", "_"),
                    Path(node.image.filepath).name,
                    node.image.colorspace_settings.name.replace(" ", "_")))


def glow(mesh):
    """The texture without light on it: its node stays as it was imported."""
    for material in mesh.materials:
        tree = material.node_tree
        describe_maps(tree)
        texture = next(
            n for n in tree.nodes if n.type == "TEX_IMAGE" and "Base Color" in
            [link.to_socket.name for link in n.outputs["Color"].links])
        for output in tree.nodes:
            if output.type == "OUTPUT_MATERIAL":
                for link in list(output.inputs["Displacement"].links):
                    tree.links.remove(link)
        output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
        light = tree.nodes.new("ShaderNodeEmission")
        tree.links.new(texture.outputs["Color"], light.inputs["Color"])
        tree.links.new(light.outputs[0], output.inputs["Surface"])
        image = texture.image
        print(
            "image %s %d %d %d %s %s"
            % (
                image.name.replace(" ", "_"), image.size[0], image.size[1],
                image.is_float, image.source, image.colorspace_settings.name,
            )
        )


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
    """The numbers of a picture, both of which are linear Rec.709."""
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


def lab(rgb):
    """CIELAB of linear Rec.709, white D65."""
    to_xyz = np.array([
        [0.4123908, 0.3575843, 0.1804808], [0.2126390, 0.7151687, 0.0721923],
        [0.0193308, 0.1191948, 0.9505322]])
    t = rgb.clip(0, None) @ to_xyz.T / to_xyz.sum(axis=1)
    f = np.where(t > (6 / 29) ** 3, np.cbrt(t), t / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.stack([
        116 * f[..., 1] - 16, 500 * (f[..., 0] - f[..., 1]),
        200 * (f[..., 1] - f[..., 2])], axis=-1)


def main():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    part = import_model()
    describe(part.data)
    glow(part.data)
    set_camera()
    path = PICTURE[:-4] + "_cycles.exr"
    render(path)
    ours, theirs = pixels(PICTURE), pixels(path)
    mask = inside(theirs[..., 3])
    ours, theirs = ours[mask][:, :3], theirs[mask][:, :3]
    d = np.abs(ours - theirs).max(axis=1)
    e = np.linalg.norm(lab(ours) - lab(theirs), axis=1)
    print(
        "difference %.5f %.5f %.5f %.4f of %d"
        % (d.mean(), np.percentile(d, 99), d.max(), e.mean(), mask.sum())
    )


main()
