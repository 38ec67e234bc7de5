#!/usr/bin/env python3
"""The Blender add-on, installed from its zip: a cage with creases, a corner and
constraints goes out, comes back textured in its place, and stopping leaves
nothing.

    test_addon.py OSDTEX
"""

import os
import sys
import tempfile
from pathlib import Path

from blenders import all_blenders
from oracles import ROOT, need, run

SESSION = Path(__file__).parent / "addon_session.py"
PICTURE = ROOT / "models/exemplars/grass_tile.png"
MATERIAL = ROOT / "models/materials/waves"


def main():
    need("blender")
    osdtex = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        archives = [folder / "a.zip", folder / "osdtex_blender.zip"]
        for archive in archives:
            run(ROOT / "tools/dcc/blender/make-addon", archive)
        assert archives[0].read_bytes() == archives[1].read_bytes()
        for i, (name, blender) in enumerate(all_blenders()):
            work = folder / str(i)
            work.mkdir()
            said = run(
                *blender[:-1], SESSION, "--", archives[1], osdtex, work, PICTURE,
                MATERIAL,
                env={**os.environ, "PATH": "/usr/bin:/bin", "HOME": str(work),
                     "BLENDER_USER_RESOURCES": str(work),
                     "BLENDER_USER_SCRIPTS": str(work / "scripts"),
                     "BLENDER_USER_CONFIG": str(work / "config")})
            print(name, [l for l in said.splitlines() if "addon" in l], flush=True)
            assert "addon fine" in said, said


main()
