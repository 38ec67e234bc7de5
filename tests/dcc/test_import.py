#!/usr/bin/env python3
"""Blender imports what `osdtex map` writes: faces, vertices, UVs and, by way of
the MTL, the EXR; and Cycles shows what osdtex renders, in the same colours,
with nothing said to it.

    test_import.py OSDTEX
"""

import sys
import tempfile
from pathlib import Path

from blenders import all_blenders, is_alike, look, own_picture
from oracles import ROOT, need, run

DATA = ROOT.parent / "shared/data"
CASES = [
    ("models/cages/creature.obj", "models/exemplars/grass_tile.png", "2"),
    (DATA / "cages/spot_control_mesh.obj", DATA / "textures/cobbles_666.png", "3"),
    (DATA / "cages/suzanne.obj", DATA / "textures/water_300.png", "2"),
]


def contents(obj):
    """Faces, vertices and the sum of all corners' UVs of a file."""
    uvs, vertices, faces, total = [], 0, 0, 0.0
    for line in obj.read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices += 1
        elif words[:1] == ["vt"]:
            uvs.append(float(words[1]) + float(words[2]))
        elif words[:1] == ["f"]:
            faces += 1
            total += sum(uvs[int(w.split("/")[1]) - 1] for w in words[1:])
    return faces, vertices, total


def check(osdtex, cage, exemplar, scale, folder):
    run(
        osdtex, "map", cage, exemplar, "-o", folder / "a.obj", "--scale", scale,
        "-q", cwd=ROOT,
    )
    camera = own_picture(osdtex, folder)
    faces, vertices, uvs = contents(folder / "a.obj")
    ok = True
    for name, blender in all_blenders():
        said = look(blender, folder / "a.obj", camera)
        print(name, cage, said, flush=True)
        model, image = said["model"], said["image"]
        ok = ok and (
            [int(model[0]), int(model[1])] == [faces, vertices]
            and abs(float(model[2]) - uvs) <= 1e-6 * faces
            and image[0] == "a.exr" and image[3] == "1" and is_alike(said)
        )
    return ok


def main():
    need("blender")
    osdtex = Path(sys.argv[1]).resolve()
    failed = []
    for cage, exemplar, scale in CASES:
        if not (ROOT / cage).exists():
            print(f"{cage} is not there: left out")
            continue
        with tempfile.TemporaryDirectory() as folder:
            if not check(osdtex, cage, exemplar, scale, Path(folder)):
                failed.append(str(cage))
    sys.exit(f"not as written: {failed}" if failed else 0)


main()
