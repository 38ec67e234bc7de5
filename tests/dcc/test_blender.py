#!/usr/bin/env python3
"""Blender subdivides a baked cage as tools/dcc/blender/osdtex_import.py loads it,
and Cycles shows what osdtex renders of the refined mapping, in the same
colours.

    test_blender.py OSDTEX

Nothing is said to Blender about colours. UVs by another rule, or a texture in
another space than Blender takes it to be in, are far beyond the thresholds
(tested too).
"""

import sys
import tempfile
from pathlib import Path

from blenders import DELTA_E, all_blenders, debian, is_alike, look, own_picture
from oracles import ROOT, need, run

STONES, GRASS = "stones_open.png", "grass_tile.png"
# Cage, exemplar, level, coordinates to bake onto, side of a tile and its density.
# Quads that are large in the picture are bent: that they are cut where Blender
# cuts them is seen in fine grass on few faces.
CASES = [
    ("creased", STONES, 4, "atlas", 2048, None),
    ("ngons_and_triangles", STONES, 4, "atlas", 2048, None),
    ("uv_seams", STONES, 4, "own", 2048, None),
    ("uv_seams", GRASS, 3, "own", 2048, None),
    ("creature", GRASS, 3, "atlas", 2048, None),
    ("creature", GRASS, 3, "atlas", 1024, 250),
]


def bake(osdtex, case, folder, *more):
    cage, exemplar, level, uvs, side, density = case
    if density:
        more += ("--texels-per-unit", density)
    run(
        osdtex, "map", ROOT / f"models/cages/{cage}.obj",
        ROOT / "models/exemplars" / exemplar, "-o", folder / "a.obj", "--level",
        level, "--bake", "--uvs", uvs, "--resolution",
        side, *more, "-q", cwd=ROOT,
    )
    return own_picture(osdtex, folder)


def is_tiled(folder, said):
    """Several tiles, and all of them in one image."""
    tiles = sorted(p.name for p in folder.glob("a.1*.exr"))
    return len(tiles) > 1 and said["image"][4] == "TILED"


def check(osdtex, case, folder):
    camera = bake(osdtex, case, folder)
    ok = True
    for name, blender in all_blenders():
        said = look(blender, folder / "a_cage.obj", camera, case[2])
        print(name, *case, said, flush=True)
        ok = ok and is_alike(said)
        ok = ok and (case[5] is None or is_tiled(folder, said))
    return ok


def faults_are_seen(osdtex, folder):
    """Blender's default rule for UVs, and ACEScg numbers taken for Rec.709: so
    that osdtex_import cannot know better, without NAME.mtlx."""
    case = ("creature", GRASS, 3, "atlas", 1024, None)
    camera = bake(osdtex, case, folder, "--to", "ACEScg")
    (folder / "a.mtlx").unlink()
    colours = look(debian(), folder / "a_cage.obj", camera, 3)
    rule = look(debian(), folder / "a_cage.obj", camera, 3, "SMOOTH_ALL")
    print("wrong on purpose", colours, rule, flush=True)
    return float(colours["difference"][3]) > 3 * DELTA_E and not is_alike(rule)


def main():
    need("blender")
    osdtex = Path(sys.argv[1]).resolve()
    failed = []
    for case in CASES:
        with tempfile.TemporaryDirectory() as folder:
            if not check(osdtex, case, Path(folder)):
                failed.append(case)
    with tempfile.TemporaryDirectory() as folder:
        if not faults_are_seen(osdtex, Path(folder)):
            failed.append("faults go unseen")
    sys.exit(f"not within thresholds: {failed}" if failed else 0)


main()
