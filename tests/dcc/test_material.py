#!/usr/bin/env python3
"""Blender shows a baked material by the script that comes along: every map in
its place, data as numbers, and a displaced creature without a hole.

    test_material.py OSDTEX
"""

import os
import sys
import tempfile
from pathlib import Path

from oracles import ROOT, need, oracle_python, run

SCRIPT = Path(__file__).parent / "blender_material.py"
# The socket that a map goes to, and what it is called in Blender.
SOCKETS = {
    "Base_Color": "", "Color": "_normal", "Roughness": "_roughness",
    "Metallic": "_metalness", "Height": "_height",
}


def blenders():
    yield "Debian's Blender", [
        "blender", "-b", "--factory-startup", "--python-exit-code", "1",
        "--python", SCRIPT]
    python, reason = oracle_python("bpy")
    if reason:
        print(f"left out, the current Blender: {reason}", flush=True)
    else:
        yield "the current Blender", [python, SCRIPT]


def judge(name, text):
    said = [line.split() for line in text.splitlines()]
    maps = {w[1]: w[2:] for w in said if w[:1] == ["map"]}
    print(name, maps, [w for w in said if w[:1] in (["holes"], ["moved"])])
    ok = set(maps) == set(SOCKETS)
    for socket, ending in SOCKETS.items():
        file, space = maps.get(socket, ("", ""))
        ok = ok and file == f"a{ending}.1001.exr"
        ok = ok and (socket == "Base_Color" or space == "Non-Color")
    holes = next(w for w in said if w[:1] == ["holes"])
    moved = next(w for w in said if w[:1] == ["moved"])
    return (
        ok and int(holes[1]) == 0 and int(holes[3]) > 3000
        and int(moved[1]) > 20)


def main():
    need("blender")
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        run(
            Path(sys.argv[1]).resolve(), "bake", ROOT / "models/cages/creature.obj",
            "--material", ROOT / "models/materials/waves", "-o",
            folder / "a.obj", "--uvs", "atlas", "--resolution", "512",
            "--scale", "1", "-q", cwd=ROOT)
        failed = [
            name for name, blender in blenders()
            if not judge(name, run(
                *blender, "--", folder / "a_cage.obj", "3",
                env={**os.environ, "PATH": "/usr/bin:/bin"}))]
    sys.exit(f"not as written: {failed}" if failed else 0)


main()
