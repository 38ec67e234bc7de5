"""blenders -- Debian's Blender, and a current one as the module bpy, looking at
a model of osdtex beside osdtex's own picture of it."""

import os
import sys
from pathlib import Path

from oracles import ROOT, run

sys.path.append(str(ROOT / "tests"))

from oracle_venv import oracle_python  # noqa: E402

SCRIPT = Path(__file__).parent / "blender_picture.py"
# Of linear numbers, mean and 99 % of the pixels: the two renderers sample their
# pixels differently, so they are wider than those of test_refined.py. And of
# colours as the eye sees them, in Delta E (1976).
MEAN, P99, DELTA_E = 0.01, 0.08, 1.0


def debian():
    return ["blender", "-b", "--factory-startup", "--python-exit-code", "1",
            "--python", SCRIPT]


def all_blenders():
    """Names and how each is run; the current one where it is installed."""
    yield "Debian's Blender", debian()
    python, reason = oracle_python("bpy")
    if reason:
        print(f"left out, the current Blender: {reason}", flush=True)
    else:
        yield "the current Blender", [python, SCRIPT]


def bounds(obj):
    points = [
        [float(v) for v in line.split()[1:4]]
        for line in obj.read_text().splitlines()
        if line.startswith("v ")
    ]
    low = [min(p[i] for p in points) for i in range(3)]
    high = [max(p[i] for p in points) for i in range(3)]
    centre = [(a + b) / 2 for a, b in zip(low, high)]
    return centre, max(b - a for a, b in zip(low, high))


def camera_of(obj):
    centre, size = bounds(obj)
    eye = [c + size * d for c, d in zip(centre, (1.3, 1.0, 1.7))]
    return ",".join(f"{v:.6f}" for v in eye + centre) + ",28"


def own_picture(osdtex, folder):
    """Of FOLDER/a.obj; the camera it was taken with."""
    camera = camera_of(folder / "a.obj")
    run(
        osdtex, "render", folder / "a.obj", "-o", folder / "a_picture.exr",
        "--size", "320x240", "--samples", "16", "--unlit", "--camera", camera,
        "-q",
    )
    return camera


def look(blender, model, camera, level=0, uv_smooth="-"):
    """The words of blender_picture's lines, by their first."""
    text = run(
        *blender, "--", model, model.parent / "a_picture.exr", uv_smooth, level,
        camera,
        # Blender takes the modules of the first Python on the path.
        env={**os.environ, "PATH": "/usr/bin:/bin"},
    )
    said = {"maps": {}}
    for line in text.splitlines():
        if line.startswith("map "):
            said["maps"][line.split()[1]] = line.split()[2:]
        if line.startswith(("model ", "image ", "difference ")):
            said[line.split()[0]] = line.split()[1:]
    assert int(said["difference"][5]) > 4000, said
    return said


def is_alike(said):
    mean, p99, _, delta_e = (float(w) for w in said["difference"][:4])
    return mean <= MEAN and p99 <= P99 and delta_e <= DELTA_E
