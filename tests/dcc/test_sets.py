#!/usr/bin/env python3
"""Materials made of photographs, height from lightness and normals from height,
come out of Blender as they went in: each map in its place, data as numbers, and
the colours of osdtex's own picture.

Debian's Blender loads them by the script that comes along, the current one by
its USD importer, as it is.

    test_sets.py OSDTEX
"""

import sys
import tempfile
from pathlib import Path

import numpy as np
from blenders import all_blenders, look, own_picture
from oracles import ROOT, need, run
from PIL import Image

TEXTURES = ROOT.parent / "shared/data/textures"
CASES = [
    ("creature", "cobbles_666.png"), ("torus", "weave_640.png"),
    ("jack", "bricks_1024.png")]
DELTA_E = 1.5
PLACES = {
    "Base_Color": "", "Normal": "_normal", "Roughness": "_roughness",
    "Displacement": "_height"}


def make_set(photograph, folder):
    """NAME_color, NAME_height, NAME_normal_gl and NAME_roughness."""
    image = Image.open(photograph).convert("RGB")
    height = np.asarray(image.convert("L"), np.float64) / 255
    for axis in (0, 1):
        height = (np.roll(height, 1, axis) + height + np.roll(height, -1, axis)) / 3
    dx = (np.roll(height, -1, 1) - np.roll(height, 1, 1)) * 4
    dy = (np.roll(height, 1, 0) - np.roll(height, -1, 0)) * 4
    normal = np.stack([-dx, -dy, np.ones_like(dx)], -1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    image.save(folder / "photo_color.png")
    for name, data in (
            ("height", height), ("normal_gl", 0.5 + 0.5 * normal),
            ("roughness", 0.9 - 0.5 * height)):
        Image.fromarray((255 * data + 0.5).astype(np.uint8)).save(
            folder / f"photo_{name}.png")


def is_right(said):
    """Colours of a bake are linear, so `raw` says the same of them."""
    maps = said["maps"]
    ok = set(maps) == set(PLACES)
    for socket, ending in PLACES.items():
        file, space = maps.get(socket, ("", ""))
        ok = ok and file == f"a{ending}.1001.exr"
        ok = ok and (socket == "Base_Color" or space == "Non-Color")
    return ok and float(said["difference"][3]) <= DELTA_E


def check(osdtex, cage, photograph, folder):
    (folder / "set").mkdir()
    make_set(TEXTURES / photograph, folder / "set")
    run(
        osdtex, "map", ROOT / f"models/cages/{cage}.obj", "--material",
        folder / "set", "-o", folder / "a.obj", "--level", "3", "--bake", "--uvs",
        "atlas", "--resolution", "2048", "-q")
    camera = own_picture(osdtex, folder)
    ok = True
    for name, blender in all_blenders():
        model = "a_cage.obj" if name.startswith("Debian") else "a.usda"
        said = look(blender, folder / model, camera, 3)
        print(name, cage, photograph, said, flush=True)
        ok = ok and is_right(said)
    return ok


def main():
    need("blender")
    if not TEXTURES.exists():
        print("skipped: there are no photographs beside the tree")
        sys.exit(77)
    osdtex = Path(sys.argv[1]).resolve()
    failed = []
    for cage, photograph in CASES:
        with tempfile.TemporaryDirectory() as folder:
            if not check(osdtex, cage, photograph, Path(folder)):
                failed.append(photograph)
    sys.exit(f"not as they went in: {failed}" if failed else 0)


main()
