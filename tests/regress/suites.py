"""suites.py -- small regression suites in a folder of their own, and a program
that does damage to what osdtex makes."""

import json
import os
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))

from program import (
    CAGES, ENVIRONMENT, EXEMPLARS, PROGRAM, ProgramTest, main)  # noqa: E402

# Runs osdtex, then spoils what the case in $VICTIM got, as $DAMAGE says.
WRAPPER = '''
import json, os, signal, subprocess, sys, time
arguments = sys.argv[1:]
out = arguments[arguments.index("-o") + 1]
damage = os.environ["DAMAGE"] if os.environ["VICTIM"] in out else ""
if damage == "crash":
    os.kill(os.getpid(), signal.SIGSEGV)
if damage == "refuse":
    print("osdtex: error: <no> such cage")
    sys.exit(2)
if damage == "hang":
    time.sleep(60)
for _ in range(5 if damage == "slow" else 1):
    code = subprocess.run([os.environ["OSDTEX"], *arguments]).returncode
if damage == "pixel" and out.endswith(".png"):
    from PIL import Image
    image = Image.open(out)
    pixel = list(image.getpixel((40, 30)))
    pixel[1] ^= 16
    image.putpixel((40, 30), tuple(pixel))
    image.save(out)
if damage == "uv" and out.endswith(".obj"):
    lines = open(out).read().split("\\n")
    first = next(i for i, l in enumerate(lines) if l.startswith("vt "))
    u, v = map(float, lines[first].split()[1:3])
    lines[first] = f"vt {u + 1e-6:.9g} {v:.9g}"
    open(out, "w").write("\\n".join(lines))
if damage == "stage" and "--json-report" in arguments:
    path = arguments[arguments.index("--json-report") + 1]
    report = json.load(open(path))
    report["seconds"]["map_stages"]["place"] += 1.0
    json.dump(report, open(path, "w"))
sys.exit(code)
'''

TILE = {
    "cages": [str(CAGES / "ngons_and_triangles.obj")],
    "exemplars": [str(EXEMPLARS / "pebbles_tile.png")],
    "methods": ["tile"],
    "tiles": "--tile-size 32",
    "options": {"": "--tile-level 1"},
}
TILE_CASE = "ngons_and_triangles.pebbles_tile.tile"


class SuiteTest(ProgramTest):
    def write_table(self, *rows, **more):
        suite = self.folder / "suite"
        suite.mkdir(exist_ok=True)
        (suite / "table.json").write_text(json.dumps(
            {"render": "--size 64x64 --samples 1", "rows": rows, **more}))
        return suite

    def regress(self, *arguments, damage=None, victim="", **more):
        environment = {}
        if damage == "pixel":
            self.need(modules=["PIL"])
        if damage:
            wrapper = self.folder / "wrapper.py"
            wrapper.write_text(WRAPPER)
            arguments += ("--program", f"{sys.executable} {wrapper}")
            environment = {
                "DAMAGE": damage, "VICTIM": victim, "OSDTEX": PROGRAM}
        return self.run_program(
            "regress", self.folder / "suite", "-o", self.folder / "out",
            *arguments, environment=environment, **more)

    def results(self):
        text = (self.folder / "out" / "results.json").read_text()
        return json.loads(text)["cases"]

    def page(self):
        return (self.folder / "out" / "report.html").read_text()
