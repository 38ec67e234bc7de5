#!/usr/bin/env python3
"""three.js, in Chromium without a window, shows what osdtex writes: OBJ, MTL and
EXR, of the refined mesh and of the bake.

    test_three.py OSDTEX

three.js comes from npm, in the version below; the test is skipped where that,
or Chromium, cannot be had.
"""

import functools
import http.server
import shutil
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

import objs
from oracles import ROOT, difference, need, run

THREE = "three@0.187.0"
SIDE = 256


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)


def install_three(folder):
    done = subprocess.run(
        ["npm", "install", "--prefix", str(folder), "--no-audit", "--no-fund",
         "--ignore-scripts", THREE],
        capture_output=True, text=True, timeout=300,
    )
    if done.returncode != 0:
        skip(f"npm cannot install {THREE}: {done.stderr[-300:]}")


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


def serve(folder):
    """Modules are not loaded from files; a server on the loopback it is."""
    server = http.server.ThreadingHTTPServer(
        ("127.0.0.1", 0), functools.partial(Quiet, directory=str(folder)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return server.server_address[1]


def camera_within(model):
    """A view that the model, a ball, fills."""
    points = [[float(x) for x in line.split()[1:4]] for line in model.points]
    low = [min(p[i] for p in points) for i in range(3)]
    high = [max(p[i] for p in points) for i in range(3)]
    middle = [(a + b) / 2 for a, b in zip(low, high)]
    away = 1.5 * (high[2] - low[2])
    return [middle[0], middle[1], middle[2] + away, *middle, 20]


def screenshot(browser, port, name, camera, folder):
    picture = folder / f"{name}_three.png"
    address = (
        f"http://127.0.0.1:{port}/three.html?model={name}&side={SIDE}&camera="
        + ",".join(f"{c:.6g}" for c in camera))
    subprocess.run(
        [browser, "--headless", "--no-sandbox", "--use-angle=swiftshader",
         "--enable-unsafe-swiftshader", "--hide-scrollbars", "--no-first-run",
         "--disable-background-networking", "--force-device-scale-factor=1",
         "--window-size=800,600", "--virtual-time-budget=60000",
         "--timeout=120000", f"--user-data-dir={folder / 'browser'}",
         f"--screenshot={picture}", address],
        capture_output=True, timeout=300, check=True,
    )
    run(
        "oiiotool", picture, "--ch", "R,G,B", "--cut", f"{SIDE}x{SIDE}+0+0",
        "-d", "uint8", "-o", picture)
    return picture


def ours(osdtex, name, camera, folder):
    linear, picture = folder / f"{name}.own.exr", folder / f"{name}.own.png"
    run(
        osdtex, "render", folder / f"{name}.obj", "-o", linear, "--size",
        f"{SIDE}x{SIDE}", "--samples", "4", "--unlit", "-q", "--camera",
        ",".join(f"{c:.6g}" for c in camera),
    )
    run("oiiotool", linear, "--ch", "R,G,B", "-d", "uint8", "-o", picture)
    return picture


def make_models(osdtex, folder):
    """a: refined, with the exemplar; b: refined, with the bake; c: a with the
    picture of another seed, which must not pass for it."""
    for name, more in (("a", ("--bake", "--uvs", "atlas", "--resolution", 1024)),
                       ("c", ("--seed", 2))):
        run(
            osdtex, "map", ROOT / "models/cages/sphere.obj",
            ROOT / "models/exemplars/pebbles_tile.png", "-o",
            folder / f"{name}.obj", "--level", "2", "-q", *more, cwd=ROOT,
        )
    leaf = objs.Obj(folder / "a.obj")
    leaves = objs.linear_leaves(objs.Obj(folder / "a_cage.obj"), len(leaf.faces))
    objs.write_with_uvs(leaf, leaves, folder / "b.obj", "a.1001.exr")
    return leaf


def main():
    need("npm", "oiiotool", "idiff")
    browser = shutil.which("chromium") or shutil.which("google-chrome")
    if not browser:
        skip("there is no Chromium (tools/deps medium)")
    osdtex = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        install_three(folder)
        shutil.copy(ROOT / "tests/dcc/three.html", folder)
        camera = camera_within(make_models(osdtex, folder))
        port = serve(folder)
        reference = ours(osdtex, "a", camera, folder)
        mean = {
            name: difference(
                reference, screenshot(browser, port, name, camera, folder))[0]
            for name in "abc"}
    print("mean difference to osdtex's own picture:", mean)
    # One lookup a pixel against a mean of many; another picture is far off.
    good = mean["a"] < 0.02 and mean["b"] < 0.02 and mean["c"] > 0.1
    sys.exit(0 if good else "three.js shows something else")


main()
