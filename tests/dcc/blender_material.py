"""blender_material -- in Blender: a baked material, as the script that comes
along shows it, and its shape in silhouette with and without displacement.

    blender -b --factory-startup --python blender_material.py -- CAGE.obj LEVEL

Prints `map SOCKET FILE SPACE` for each texture that the surface gets, `space`
of the colour, and `holes N of M`: pixels that the displaced model leaves open
of those that the plain one covers with some margin.
"""

import sys
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tools/dcc/blender"))

import osdtex_import  # noqa: E402

CAGE, LEVEL = sys.argv[sys.argv.index("--") + 1 :]
SIDE, MARGIN = 256, 6


def describe(material):
    tree = material.node_tree
    for node in tree.nodes:
        if node.type != "TEX_IMAGE":
            continue
        for link in node.outputs["Color"].links:
            print(
                "map %s %s %s" % (
                    link.to_socket.name.replace(" ", "_"),
                    Path(node.image.filepath).name,
                    node.image.colorspace_settings.name.replace(" ", "_")))


def set_camera(part):
    points = np.array([part.matrix_world @ v.co for v in part.data.vertices])
    low, high = points.min(axis=0), points.max(axis=0)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type = "ORTHO"
    camera.data.ortho_scale = 1.2 * float((high - low).max())
    camera.location = (*(0.5 * (low + high))[:2], high[2] + 10.0)
    camera.data.clip_end = 1e4
    bpy.context.scene.collection.objects.link(camera)
    bpy.context.scene.camera = camera


def covered(path):
    """Alpha of each pixel, from its very middle."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 1
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 0
    scene.cycles.filter_width = 0.01
    scene.render.film_transparent = True
    scene.render.resolution_x = scene.render.resolution_y = SIDE
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_mode = "RGBA"
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(path)
    out = np.empty(SIDE * SIDE * 4, np.float32)
    image.pixels.foreach_get(out)
    return out.reshape(SIDE, SIDE, 4)[..., 3] > 0.5


def eroded(mask):
    for _ in range(MARGIN):
        grown = mask.copy()
        for axis in (0, 1):
            for by in (-1, 1):
                grown &= np.roll(mask, by, axis)
        mask = grown
    return mask


def main():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    part = osdtex_import.load(CAGE, int(LEVEL), "Y", "Z")
    for material in part.data.materials:
        describe(material)
    set_camera(part)
    folder = Path(CAGE).parent
    displaced = covered(str(folder / "displaced.exr"))
    for material in part.data.materials:
        tree = material.node_tree
        output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
        for link in list(output.inputs["Displacement"].links):
            tree.links.remove(link)
    plain = covered(str(folder / "plain.exr"))
    inside = eroded(plain)
    print("moved %d" % (displaced != plain).sum())
    print("holes %d of %d" % ((inside & ~displaced).sum(), inside.sum()))


main()
