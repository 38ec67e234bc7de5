#!/usr/bin/env python3
"""Blender imports what `osdtex map` writes: faces, vertices, UVs and, by way of
the MTL, the EXR; and Cycles shows what osdtex renders.

    test_import.py OSDTEX

The thresholds of the picture are those of test_blender.py, for its reason.
"""

import os
import sys
import tempfile
from pathlib import Path

from oracles import ROOT, need, run
from test_blender import MEAN, P99, camera_of

DATA = ROOT.parent / "shared/data"
CASES = [
    ("models/cages/creature.obj", "models/exemplars/pebbles_tile.png", "2"),
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


def blender(folder, camera):
    text = run(
        "blender", "-b", "--factory-startup", "--python-exit-code", "1",
        "--python", Path(__file__).parent / "blender_picture.py", "--",
        folder / "a.obj", "-", folder / "a_picture.exr", "NONE", "0", camera,
        env={**os.environ, "PATH": "/usr/bin:/bin"},
    )
    words = {}
    for line in text.splitlines():
        if line.startswith(("model ", "difference ")):
            words[line.split()[0]] = line.split()[1:]
    return words["model"], words["difference"]


def check(osdtex, cage, exemplar, scale, folder):
    run(
        osdtex, "map", cage, exemplar, "-o", folder / "a.obj", "--scale", scale,
        "-q", cwd=ROOT,
    )
    camera = camera_of(folder / "a.obj")
    run(
        osdtex, "render", folder / "a.obj", "-o", folder / "a_picture.exr",
        "--size", "320x240", "--samples", "16", "--unlit", "--camera", camera,
        "-q",
    )
    model, difference = blender(folder, camera)
    print(cage, *model, "difference", *difference, flush=True)
    faces, vertices, uvs = contents(folder / "a.obj")
    return (
        [int(model[0]), int(model[1])] == [faces, vertices]
        and abs(float(model[2]) - uvs) <= 1e-6 * faces
        and model[3] == "a.exr"
        and model[6] == "1"
        and float(difference[0]) <= MEAN
        and float(difference[1]) <= P99
    )


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
