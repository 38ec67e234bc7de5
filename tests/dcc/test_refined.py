#!/usr/bin/env python3
"""A baked cage, subdivided, looks as the refined mapping does.

    test_refined.py OSDTEX

Both are rendered by osdtex itself with so many rays that no filter has a say:
what is left is what the bake changed. The refined mesh gets the coordinates of
the cage by the rule "linear all", computed here and not by osdtex.
"""

import sys
import tempfile
from pathlib import Path

import objs
from oracles import ROOT, need, run, within_tolerance

CAGES = ["creature", "sphere", "creased", "ngons_and_triangles"]


def compare(osdtex, cage, folder):
    run(
        osdtex, "map", ROOT / f"models/cages/{cage}.obj",
        ROOT / "models/exemplars/pebbles_tile.png", "-o", folder / "a.obj",
        "--level", "3", "--bake", "--uvs", "atlas", "--resolution", "4096",
        "-q", cwd=ROOT,
    )
    leaf = objs.Obj(folder / "a.obj")
    leaves = objs.linear_leaves(objs.Obj(folder / "a_cage.obj"), len(leaf.faces))
    objs.write_with_uvs(leaf, leaves, folder / "b.obj", "a.1001.exr")
    for name in "ab":
        run(
            osdtex, "render", folder / f"{name}.obj", "-o",
            folder / f"{name}_picture.exr", "--size", "320x240", "--samples",
            "16", "--unlit", "-q",
        )
    ok, text = within_tolerance(
        folder / "a_picture.exr", folder / "b_picture.exr"
    )
    print(cage, "agrees" if ok else text)
    return ok


def main():
    need("idiff")
    osdtex = Path(sys.argv[1]).resolve()
    failed = []
    for cage in CAGES:
        with tempfile.TemporaryDirectory() as folder:
            if not compare(osdtex, cage, Path(folder)):
                failed.append(cage)
    sys.exit(f"not within tolerance: {failed}" if failed else 0)


main()
