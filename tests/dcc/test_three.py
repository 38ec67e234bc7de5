#!/usr/bin/env python3
"""three.js, in Chromium without a window, shows what osdtex writes in the same
colours: PNG of --for web by nothing but its own defaults, of the refined mesh
and of the bake, and EXR by what docs/pipeline.md says.

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

import numpy as np

import objs
from oracles import ROOT, need, run

THREE = "three@0.187.0"
SIDE = 256
SAMPLES = 4  # screenshot pixels a side of ours
DELTA_E = 1.0


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


def read_ppm(path):
    """An 8-bit picture by way of oiiotool, as numbers up to 1."""
    ppm = path.with_suffix(".ppm")
    run("oiiotool", path, "--ch", "R,G,B", "-d", "uint8", "-o", ppm)
    data = ppm.read_bytes().split(b"\n", 3)
    width, height = map(int, data[1].split())
    return np.frombuffer(data[3], np.uint8).reshape(height, width, 3) / 255.0


def linear(srgb):
    return np.where(
        srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def lab(rgb):
    """CIELAB of linear Rec.709, white D65."""
    to_xyz = np.array([
        [0.4123908, 0.3575843, 0.1804808], [0.2126390, 0.7151687, 0.0721923],
        [0.0193308, 0.1191948, 0.9505322]])
    t = rgb @ to_xyz.T / to_xyz.sum(axis=1)
    f = np.where(t > (6 / 29) ** 3, np.cbrt(t), t / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.stack([
        116 * f[..., 1] - 16, 500 * (f[..., 0] - f[..., 1]),
        200 * (f[..., 1] - f[..., 2])], axis=-1)


def screenshot(browser, port, name, camera, folder):
    """In linear light, the samples of a pixel of ours side by side."""
    picture = folder / f"{name}_three.png"
    side = SIDE * SAMPLES
    address = (
        f"http://127.0.0.1:{port}/three.html?model={name}&side={side}&camera="
        + ",".join(f"{c:.6g}" for c in camera))
    subprocess.run(
        [browser, "--headless", "--no-sandbox", "--use-angle=swiftshader",
         "--enable-unsafe-swiftshader", "--hide-scrollbars", "--no-first-run",
         "--disable-background-networking", "--force-device-scale-factor=1",
         "--window-size=1200,1200", "--virtual-time-budget=60000",
         "--timeout=120000", f"--user-data-dir={folder / 'browser'}",
         f"--screenshot={picture}", address],
        capture_output=True, timeout=300, check=True,
    )
    pixels = linear(read_ppm(picture)[:side, :side])
    return pixels.reshape(SIDE, SAMPLES, SIDE, SAMPLES, 3).swapaxes(1, 2)


def ours(osdtex, name, camera, folder):
    picture = folder / f"{name}.own.png"
    run(
        osdtex, "render", folder / f"{name}.obj", "-o", picture, "--size",
        f"{SIDE}x{SIDE}", "--samples", "16", "--unlit", "-q", "--camera",
        ",".join(f"{c:.6g}" for c in camera),
    )
    return linear(read_ppm(picture))


def delta_e(reference, samples):
    """Mean distance where the model covers a pixel: the page is black."""
    inside = (samples.max(axis=-1) > 0).all(axis=(2, 3))
    assert inside.sum() > SIDE * SIDE / 8, "the page shows no model"
    d = lab(reference) - lab(samples.mean(axis=(2, 3)))
    return np.linalg.norm(d, axis=-1)[inside].mean()


MODELS = {
    # --for web, the refined mesh; b is its bake.
    "a": ("--for", "web", "--bake", "--uvs", "atlas", "--resolution", 2048),
    # EXR.
    "e": (),
    # What must not pass for a: another mapping, and another space.
    "c": ("--for", "web", "--seed", 2),
    "d": ("--to", "ACEScg"),
}


def make_models(osdtex, folder):
    for name, more in MODELS.items():
        run(
            osdtex, "map", ROOT / "models/cages/sphere.obj",
            ROOT / "models/exemplars/grass_tile.png", "-o",
            folder / f"{name}.obj", "--level", "3", "-q", *more, cwd=ROOT,
        )
    leaf = objs.Obj(folder / "a.obj")
    leaves = objs.linear_leaves(objs.Obj(folder / "a_cage.obj"), len(leaf.faces))
    objs.write_with_uvs(leaf, leaves, folder / "b.obj", "a.1001.png")
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
        e = {
            name: delta_e(
                reference, screenshot(browser, port, name, camera, folder))
            for name in "abecd"}
    print("Delta E to osdtex's own picture:", e)
    good = all(e[name] <= DELTA_E for name in "abe")
    seen = all(e[name] > 3 * DELTA_E for name in "cd")
    sys.exit(0 if good and seen else "three.js shows something else")


main()
