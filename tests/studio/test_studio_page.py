#!/usr/bin/env python3
"""The page of osdtex studio in Chromium: each tool on a real cage, a reload,
two pages, a program that has ended.

    test_studio_page.py OSDTEX [FOLDER]

Screenshots are kept in FOLDER, to be looked at. Skipped where there is no
Chromium, or the build has no studio.
"""

import json
import signal
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import browser

ROOT = Path(__file__).resolve().parents[2]
SPOT = ROOT.parent / "shared/data/cages/spot_control_mesh.obj"
CREATURE = ROOT / "models/cages/creature.obj"
EXEMPLARS = ROOT / "models/exemplars"
SECONDS = 600


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)


class Studio:
    def __init__(self, program, *arguments):
        self.process = subprocess.Popen(
            [program, "studio", *map(str, arguments), "--no-browser"],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.address = self.process.stdout.readline().strip()
        if not self.address:
            said = self.process.stderr.read()
            if "compiled without" in said:
                skip("this build has no studio (libmicrohttpd-dev)")
            raise AssertionError(said)

    def end(self):
        self.process.send_signal(signal.SIGINT)
        _, errors = self.process.communicate(timeout=60)
        assert self.process.returncode == 0, errors
        assert "ended" in errors, errors


class Person:
    """Somebody in front of the page."""

    def __init__(self, page, shots, outputs):
        self.page, self.shots, self.outputs = page, shots, outputs

    def look(self, name):
        time.sleep(.3)
        if self.shots:
            self.page.screenshot(self.shots / f"{name}.png")

    def state(self):
        return self.page.run("fetch('state?after=0').then(a => a.json())")

    def list(self):
        return json.loads(self.outputs.read_text()).get("constraints", [])

    def settled(self, more_than=0):
        """Once what is asked for is what is shown."""
        self.page.wait(
            "fetch('state?after=0').then(a => a.json()).then(s =>"
            f" s.snapshot && s.revision > {more_than} && !s.error &&"
            " s.snapshot.revision === s.revision &&"
            " document.body.dataset.shown === String(s.revision))", SECONDS)

    def does(self, what):
        """Something that is a change, until its picture is there."""
        before = self.state()["revision"]
        what()
        self.settled(before)

    def middle(self):
        return self.page.run(
            "(b => [b.left + b.width / 2, b.top + b.height / 2])"
            "(document.querySelector('#stage').getBoundingClientRect())")

    def colours(self):
        """Of the middle of the picture, once it is drawn."""
        return self.page.run(
            "(async () => { const c = document.querySelector('#canvas');"
            " for (let i = 0; i < 3; ++i)"
            " await new Promise(requestAnimationFrame);"
            " const t = document.createElement('canvas').getContext('2d');"
            " t.drawImage(c, c.width / 2 - 60, c.height / 2 - 60, 120, 120,"
            " 0, 0, 30, 30);"
            " return String(t.getImageData(0, 0, 30, 30).data) })()")


def comb_and_undo(me):
    x, y = me.middle()
    me.page.key("c")
    me.does(lambda: me.page.drag(
        [(x - 60 + 10 * i, y + 40 - 8 * i) for i in range(12)]))
    made = me.list()
    assert len(made) > 2, made
    assert all("direction" in c and c["radius"] > 0 for c in made), made
    me.look("comb")
    me.does(lambda: me.page.key("z", modifiers=2))
    assert me.list() == []
    me.does(lambda: me.page.key("z", modifiers=10))
    assert me.list() == made
    # By keyboard, at the middle of the picture.
    me.does(lambda: me.page.key("Enter"))
    assert len(me.list()) > len(made)


def brush_size(me):
    x, y = me.middle()
    before = len(me.list())
    me.page.key("s")
    me.does(lambda: me.page.drag([(x - 20, y), (x + 20, y + 5)]))
    made = me.list()[before:]
    assert all(c["scale"] > 1 and c["edit"] and c["reach"] for c in made), made
    # Not only what is near: then places around it keep their size.
    me.page.press("#options input[type=checkbox]")
    before = len(me.list())
    me.does(lambda: me.page.click(x, y - 30))
    made = me.list()[before:]
    assert any(c["scale"] > 1 and "radius" in c for c in made), made
    assert sum(c["scale"] == 1 for c in made) > 3, made
    assert not any("edit" in c for c in made), made
    me.does(lambda: me.page.press("#undo"))
    me.page.press("#options input[type=checkbox]")
    me.page.move(x + 30, y + 20)
    me.look("size")
    me.page.key("6")
    me.look("size_view")
    me.page.key("1")


def another(me):
    """Not this spot: the next piece of the exemplar each time."""
    x, y = me.middle()
    me.page.key("o")
    me.look("other_before")
    for k in (1, 2):
        me.does(lambda: me.page.click(x, y))
        assert me.list()[-1]["redo"] == k, me.list()
        assert me.state()["snapshot"]["is_edit"]
    me.look("other")


def erase(me):
    x, y = me.middle()
    before = me.list()
    me.page.key("e")
    me.does(lambda: me.page.drag([(x - 40 + 10 * i, y) for i in range(9)]))
    assert len(me.list()) < len(before)


def first_patch(me):
    box = me.page.run(
        "(b => [b.left, b.top, b.width, b.height])"
        "(document.querySelector('#picture').getBoundingClientRect())")
    x, y = me.middle()
    me.page.click(box[0] + box[2] / 4, box[1] + box[3] / 4)
    me.does(lambda: me.page.click(x, y))
    patch = me.state()["recipe"]["first-patch"]
    assert abs(patch[1] - .25) < .02 and abs(patch[2] - .75) < .02, patch
    me.look("first")


def choose(me):
    me.does(lambda: me.page.run(
        "(c => { c.value = 1; c.onchange() })(document.querySelector('#choose'))"))
    assert me.state()["recipe"]["exemplar"] == 1
    me.look("exemplar")
    me.does(lambda: me.page.press("#undo"))
    me.does(lambda: me.page.press("#again"))
    assert me.state()["recipe"]["seed"] == 2
    me.does(lambda: me.page.press("#undo"))


def views(me):
    seen = set()
    for number, name in enumerate(
            ["texture", "patches", "stretch", "seams", "field", "scale"], 1):
        me.page.key(str(number))
        if name == "seams":
            me.page.wait("performance.getEntriesByType('resource')"
                         ".some(r => r.name.endsWith('/seams'))")
        seen.add(me.colours())
        me.look(f"view_{name}")
    assert len(seen) >= 5, len(seen)
    me.page.key("1")


def seams(me):
    me.page.wait("document.querySelectorAll('#places li').length > 3")
    eye = me.colours()
    me.page.key("n")
    me.look("seam_1")
    me.page.key("n")
    me.page.wait(
        "document.querySelector('#place').textContent.startsWith('2 of')")
    assert me.colours() != eye
    me.page.key("Home")


def look_around(me):
    x, y = me.middle()
    me.page.key("v")
    before = me.colours()
    me.page.drag([(x + 10 * i, y) for i in range(8)])
    time.sleep(.3)
    assert me.colours() != before
    me.page.key("ArrowLeft")
    me.page.key("Home")


def cancel(me):
    before = me.state()["snapshot"]["serial"]
    me.page.press("#again")
    me.page.key("Escape")
    me.page.wait("fetch('state?after=0').then(a => a.json()).then(s => !s.busy)")
    if me.state()["cancelled"]:
        assert me.state()["snapshot"]["serial"] == before
    me.does(lambda: me.page.press("#undo"))


def reload(me):
    asked = me.list()
    me.page.reload()
    me.settled()
    assert me.list() == asked
    me.page.wait("document.querySelectorAll('#gestures li').length > 0")
    me.look("reload")


def two_pages(me, other):
    """What one does the other shows."""
    me.does(lambda: me.page.press("#again"))
    other.settled()
    assert other.state()["recipe"]["seed"] == me.state()["recipe"]["seed"]
    me.does(lambda: other.page.press("#undo"))


def tablet(me):
    """One finger combs, on a narrow page too."""
    me.page.size(768, 1024, mobile=True)
    time.sleep(.6)
    me.look("tablet")
    me.page.press("#tools button:nth-child(2)")
    before = len(me.list())
    x, y = me.middle()
    path = [(x - 60 + 12 * i, y) for i in range(10)]

    def stroke():
        me.page.touch("touchStart", path[:1])
        for place in path[1:]:
            me.page.touch("touchMove", [place])
        me.page.touch("touchEnd", [])

    me.does(stroke)
    assert len(me.list()) > before
    me.look("tablet_combed")
    me.page.size(1280, 800)


def ended(me, studio):
    me.page.wait("document.querySelector('#away').hidden")
    studio.process.kill()
    studio.process.communicate()
    me.page.wait("!document.querySelector('#away').hidden", 30)
    me.look("ended")


def main():
    if not browser.find():
        skip("there is no Chromium (tools/deps medium)")
    program = Path(sys.argv[1]).resolve()
    shots = Path(sys.argv[2]) if len(sys.argv) > 2 else None
    if shots:
        shots.mkdir(parents=True, exist_ok=True)
    cage = SPOT if SPOT.exists() else CREATURE
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        arguments = (
            cage, EXEMPLARS / "bricks_tile.png", EXEMPLARS / "gravel_tile.png",
            "--level", "2", "--set", "relax=off", "-o", folder / "out.obj")
        studio = Studio(program, *arguments)
        outputs = folder / "out_constraints.json"
        with browser.Browser(folder / "browser") as chromium:
            me = Person(chromium.open(studio.address), shots, outputs)
            me.settled()
            me.look("begin")
            for step in (look_around, views, seams, comb_and_undo, brush_size, another,
                         first_patch, choose, erase, cancel, reload, tablet):
                begun = time.monotonic()
                step(me)
                print(f"{step.__name__}: {time.monotonic() - begun:.1f} s",
                      flush=True)
            other = Person(chromium.open(studio.address), None, outputs)
            two_pages(me, other)
            asked = me.state()["recipe"]
            studio.end()
            studio = Studio(program, *arguments)
            me = Person(chromium.open(studio.address), shots, outputs)
            me.settled()
            assert me.state()["recipe"] == asked
            ended(me, studio)
            faults = [c for c in chromium.console
                      if "net::ERR" not in json.dumps(c)]
            assert not faults, faults


main()
