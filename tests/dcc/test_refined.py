#!/usr/bin/env python3
"""A baked cage, subdivided, looks as the refined mapping does.

    test_refined.py OSDTEX

Both are rendered by osdtex itself with so many rays that no filter has a say:
what is left is what the bake changed. The refined mesh gets the coordinates of
the cage by the rule "linear all", computed here and not by osdtex.
"""

import re
import sys
import tempfile
from pathlib import Path

import objs
from oracles import ROOT, need, run, within_tolerance

CAGES = ["creature", "sphere", "creased"]

# Its triangles fill half of their blocks, and 4096 texels are too few for the
# tolerance; that the difference is one of resolution shows when it is doubled.
CONVERGING = "ngons_and_triangles"


def compare(osdtex, cage, folder, resolution=4096):
    run(
        osdtex, "map", ROOT / f"models/cages/{cage}.obj",
        ROOT / "models/exemplars/pebbles_tile.png", "-o", folder / "a.obj",
        "--level", "3", "--bake", "--uvs", "atlas", "--resolution",
        str(resolution), "-q", cwd=ROOT,
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
    return within_tolerance(folder / "a_picture.exr", folder / "b_picture.exr")


def mean_error(osdtex, cage, resolution):
    with tempfile.TemporaryDirectory() as folder:
        _, text = compare(osdtex, cage, Path(folder), resolution)
    return float(re.search(r"Mean error = (\S+)", text).group(1))


def main():
    need("idiff")
    osdtex = Path(sys.argv[1]).resolve()
    failed = []
    for cage in CAGES:
        with tempfile.TemporaryDirectory() as folder:
            ok, text = compare(osdtex, cage, Path(folder))
        print(cage, "agrees" if ok else text)
        if not ok:
            failed.append(cage)
    coarse, fine = (mean_error(osdtex, CONVERGING, n) for n in (4096, 8192))
    print(f"{CONVERGING}: mean error {coarse} at 4096, {fine} at 8192")
    if fine > 0.5 * coarse:
        failed.append(CONVERGING)
    sys.exit(f"not within tolerance: {failed}" if failed else 0)


main()
