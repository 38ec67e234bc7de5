#!/usr/bin/env python3
"""osdtex studio without a browser: who is let in, what is refused, what is
saved, and that `osdtex map` makes the same of it.

    test_studio.py OSDTEX
"""

import http.client
import json
import os
import re
import signal
import struct
import subprocess
import time
import unittest
from pathlib import Path

from program import CAGES, ENVIRONMENT, EXEMPLARS, PROGRAM, ProgramTest, main

SPHERE = CAGES / "sphere.obj"
BRICKS = EXEMPLARS / "bricks_tile.png"
GRAVEL = EXEMPLARS / "gravel_tile.png"
COMB = {"point": [1, 0, 0], "radius": .2, "direction": [0, 1, .25]}
REDO = {"point": [0, 0, 1], "radius": .2, "redo": 1}
SECONDS = 120


class Studio:
    """A running studio, as its page sees it."""

    def __init__(self, test, *arguments):
        self.process = subprocess.Popen(
            [PROGRAM, "studio", *map(str, arguments), "--no-browser"],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            errors="replace", env=ENVIRONMENT)
        test.addCleanup(self.kill)
        self.address = self.process.stdout.readline().strip()
        if "was compiled without" in (self.address or self.process.stderr.read()):
            test.skipTest("this build has no studio (libmicrohttpd-dev)")
        test.assertRegex(
            self.address, r"^http://127\.0\.0\.1:\d+/[0-9a-f]{32}/$")
        self.port = int(re.search(r":(\d+)/", self.address).group(1))
        self.token = self.address.split("/")[3]

    def kill(self):
        self.process.kill()
        self.process.communicate()

    def ask(self, path, method="GET", body=None, headers=None, token=None):
        c = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        prefix = "/" + (self.token if token is None else token) + "/"
        c.request(
            method, prefix + path if token != "" else "/" + path, body,
            headers or {})
        answer = c.getresponse()
        data = answer.read()
        c.close()
        return answer.status, data

    def state(self):
        status, data = self.ask("state?after=0")
        assert status == 200, data
        return json.loads(data)

    def shown(self, revision):
        """The state once the picture of a recipe is there."""
        end = time.monotonic() + SECONDS
        while time.monotonic() < end:
            state = self.state()
            if state["snapshot"] and state["snapshot"]["revision"] >= revision:
                return state
            time.sleep(.02)
        raise AssertionError(state)

    def put(self, recipe, revision=None):
        if revision is None:
            revision = self.state()["revision"]
        body = recipe if isinstance(recipe, (str, bytes)) else json.dumps(recipe)
        return self.ask(f"recipe?revision={revision}", "POST", body)

    def comb(self, *constraints, **more):
        recipe = {**self.state()["recipe"], **more}
        recipe["constraints"] = {"constraints": list(constraints)}
        return self.put(recipe)

    def uvs(self):
        _, data = self.ask("mapping")
        head = struct.unpack("16i", data[:64])
        return data[64:64 + 8 * head[4]]

    def end(self, number=signal.SIGINT):
        self.process.send_signal(number)
        _, errors = self.process.communicate(timeout=60)
        return self.process.returncode, errors


class StudioTest(ProgramTest):
    def studio(self, *more, name="out.obj", cage=SPHERE, exemplars=(BRICKS,)):
        return Studio(
            self, cage, *exemplars, "--level", "2", "-o", self.folder / name,
            "--scale", "1", *more)

    def test_who_is_let_in(self):
        studio = self.studio()
        here = f"127.0.0.1:{studio.port}"
        for token in ("", "0" * 32, studio.token[:-1], studio.token + "0",
                      studio.token.upper() + "x"):
            for path in ("", "state", "main.js", "mapping"):
                self.assertEqual(studio.ask(path, token=token)[0], 403, token)
        for headers in (
                {"Host": "evil.example"}, {"Host": "evil.example:80"},
                {"Host": here, "Origin": "http://evil.example"},
                {"Host": here, "Origin": "null"},
                {"Host": here, "Origin": f"https://{here}"},
                {"Host": here, "Origin": f"http://127.0.0.1:{studio.port + 1}"},
                {"Host": here, "Sec-Fetch-Site": "cross-site"},
                {"Host": here, "Sec-Fetch-Site": "same-site"}):
            for method, path in (("GET", "state"), ("POST", "undo")):
                self.assertEqual(
                    studio.ask(path, method, headers=headers)[0], 403, headers)
        for headers in ({"Origin": f"http://{here}"},
                        {"Host": f"localhost:{studio.port}"},
                        {"Sec-Fetch-Site": "none"}):
            self.assertEqual(studio.ask("", headers=headers)[0], 200, headers)
        for path in ("../state", "..%2f..%2fetc/passwd", "nothing"):
            self.assertEqual(studio.ask(path)[0], 404)
        self.assertEqual(studio.ask("state", "PUT")[0], 405)

    def test_hostile_recipes(self):
        """Each is one sentence, and the program lives."""
        studio = self.studio()
        begun = studio.state()
        good = begun["recipe"]

        def with_list(*items):
            return {**good, "constraints": {"constraints": list(items)}}

        for recipe in (
                b"", b"\0\xff\xfe", "[" * 100000, "{}", "[]", "1", "null",
                json.dumps(good)[:-2], '{"exemplar":0,"exemplar":1}',
                {**good, "more": 1}, {**good, "exemplar": 1},
                {**good, "exemplar": -1}, {**good, "exemplar": 1e300},
                {**good, "seed": -1}, {**good, "seed": "x"},
                {**good, "scale": -1}, {**good, "first-patch": [1]},
                {**good, "first-patch": [-1, 0, 0, 0]},
                {**good, "exemplar-class": "../x"}, {**good, "constraints": []},
                with_list(1), with_list({"face": 1 << 40, "scale": 1}),
                with_list({"face": 99999, "direction": [1, 0, 0]}),
                with_list({"point": [0, 0, 0], "radius": -1, "scale": 1}),
                with_list({"point": [0, 0, 0], "radius": .1, "scale": 1e9}),
                {**good, "constraints": {"follow": "../../etc/passwd"}}):
            status, said = studio.put(recipe, begun["revision"])
            self.assertEqual(status, 400, recipe)
            self.assertEqual(said.decode().strip().count("\n"), 0, said)
            self.assertGreater(len(said), 10, recipe)
        self.assertEqual(studio.put(b" " * (17 << 20))[0], 413)
        self.assertEqual(studio.state()["recipe"], good)
        self.assertEqual(studio.comb(COMB)[0], 200)
        self.assertEqual(studio.end()[0], 0)

    def test_map_makes_the_same(self):
        """By the command that the page shows, byte for byte."""
        studio = self.studio("--set", "relax=off", exemplars=(GRAVEL, BRICKS))
        self.assertEqual(
            studio.comb(
                COMB, {"point": [-1, 0, 0], "radius": .3, "scale": 1.5},
                {"point": [1, 0, 0], "scale": 1}, exemplar=1,
                seed=3, **{"first-patch": [2, .25, .5, 30]})[0], 200)
        studio.shown(2)
        asked = studio.state()["recipe"]["constraints"]["constraints"]
        for k, more in ((1, {**COMB, "direction": [0, 1, -1]}), (2, REDO)):
            asked.append({**more, "edit": k, "reach": .3})
            self.assertEqual(
                studio.comb(*asked, exemplar=1, seed=3)[0], 200)
            self.assertTrue(studio.shown(2 + k)["snapshot"]["is_edit"])
        uvs = studio.uvs()
        studio.ask("export", "POST")
        while not (shown := studio.state())["told"]:
            time.sleep(.02)
        self.assertIn("wrote", shown["told"])
        mine = {p.name: p.read_bytes() for p in self.folder.iterdir()}
        self.assertEqual(studio.end()[0], 0)
        line = shown["command"].replace(
            "osdtex map", f"'{PROGRAM}' map", 1).replace("out.obj", "again.obj")
        self.assertIn("--set=relax=off", line)
        done = subprocess.run(
            ["sh", "-c", f"{line} -q --save {self.folder}/again.osdtex"],
            capture_output=True, text=True, env=ENVIRONMENT)
        self.assert_exit(done, 0)

        def lines(data):
            return [l for l in data.splitlines() if l[:3] in (b"v  ", b"vt ")
                    or l[:2] in (b"v ", b"f ")]

        self.assertEqual(
            lines(mine["out.obj"]),
            lines((self.folder / "again.obj").read_bytes()))
        self.assertEqual(
            self.arrays(mine["out.osdtex"]),
            self.arrays((self.folder / "again.osdtex").read_bytes()))
        self.assertIn(uvs, self.arrays(mine["out.osdtex"]))

    @staticmethod
    def arrays(saved):
        """What is behind the header of a saved mapping."""
        size = struct.unpack("<Q", saved[:8])[0]
        return saved[8 + size:]

    def test_nothing_is_lost(self):
        studio = self.studio()
        studio.comb(COMB)
        studio.comb(COMB, {"face": 3, "scale": 2}, {"face": 9, "scale": 1})
        asked = studio.state()["recipe"]
        studio.kill()
        studio = self.studio()
        self.assertEqual(studio.state()["recipe"], asked)
        studio.comb()
        self.assertEqual(studio.ask("undo", "POST")[0], 200)
        self.assertEqual(studio.state()["recipe"], asked)
        self.assertEqual(studio.ask("redo", "POST")[0], 200)
        self.assertEqual(
            json.loads((self.folder / "out_constraints.json").read_text()),
            {"constraints": []})
        self.assertEqual(studio.end()[0], 0)

    def test_facts_come_with_the_picture(self):
        """What tools of the page depend on never waits for the report."""
        studio = self.studio("--set", "relax=off")
        for revision in (1, 2):
            shown = studio.shown(revision)["snapshot"]
            facts = shown["facts"]
            self.assertEqual(
                set(facts), {"method", "faces", "patches", "scale", "slices",
                             "places"})
            self.assertEqual(facts["method"], "hierarchical")
            self.assertEqual(facts["scale"], 1)
            self.assertEqual(facts["slices"], 0)
            self.assertGreater(facts["faces"], facts["patches"])
            self.assertGreater(len(facts["places"]), 3)
            self.assertFalse(set(facts) & set(shown["figures"] or {}))
            self.assertEqual(studio.comb(COMB)[0], 200)

    def test_two_pages(self):
        """What one did while the other looked elsewhere is not undone unseen."""
        studio = self.studio()
        old = studio.state()
        self.assertEqual(studio.comb(COMB)[0], 200)
        status, said = studio.put(old["recipe"], old["revision"])
        self.assertEqual(status, 400)
        self.assertIn(b"another page", said)

    def test_a_newer_gesture_cancels(self):
        studio = self.studio("--level", "5")
        studio.comb(COMB)
        studio.comb(COMB, {"face": 3, "scale": 2})
        studio.ask("cancel", "POST")
        while studio.state()["busy"]:
            time.sleep(.02)
        self.assertTrue(studio.state()["cancelled"])
        studio.comb(COMB)
        self.assertFalse(studio.state()["cancelled"])
        code, errors = studio.end(signal.SIGTERM)
        self.assertEqual(code, 0, errors)
        self.assertIn("ended", errors)

    def test_what_cannot_be_begun(self):
        mine = self.folder / "out_constraints.json"
        mine.write_text("{}")
        for arguments, code, words in (
                ((SPHERE, BRICKS, "-o", self.folder / "out.obj"), 3,
                 "is not the studio's"),
                ((SPHERE, BRICKS, "-o", self.folder / "out.png"), 1,
                 "NAME.obj"),
                ((BRICKS, SPHERE), 1, "is a picture"),
                ((SPHERE, self.folder / "no.png", "-o",
                  self.folder / "a.obj"), 3, "no.png"),
                ((SPHERE,), 1, "takes CAGE.obj EXEMPLAR")):
            result = self.run_program(
                "studio", *arguments, "--no-browser", timeout=60)
            if "compiled without" in result.stderr:
                self.skipTest("this build has no studio (libmicrohttpd-dev)")
            self.assert_error(result, code, words)
        self.assertEqual(mine.read_text(), "{}")

    def test_names_may_hold_any_bytes(self):
        """What is no UTF-8 is told with marks in its place, and is read."""
        cage = os.fsencode(self.folder / "caf") + b"\xe9.obj"
        picture = os.fsencode(self.folder / "br") + b"\xffck.png"
        Path(os.fsdecode(cage)).write_bytes(SPHERE.read_bytes())
        Path(os.fsdecode(picture)).write_bytes(BRICKS.read_bytes())
        studio = Studio(
            self, os.fsdecode(cage), os.fsdecode(picture), "--level", "1",
            "-o", self.folder / "out.obj", "--set", "relax=off")
        shown = studio.shown(1)
        self.assertEqual(shown["exemplars"], ["br?ck.png"])
        self.assertIn("caf?.obj", shown["command"])
        self.assertEqual(studio.end()[0], 0)
        self.assertEqual(
            sorted(p.suffix for p in self.folder.iterdir()),
            [".json", ".json", ".obj", ".png"])

    def test_constraints_to_begin_with(self):
        given = self.folder / "given.json"
        given.write_text(json.dumps({"symmetry": 4, "constraints": [COMB]}))
        studio = self.studio("--constraints", given)
        self.assertEqual(
            studio.state()["recipe"]["constraints"],
            json.loads(given.read_text()))
        self.assertIn(b"<main", studio.ask("")[1])
        for name in ("main.js", "three.js", "style.css"):
            self.assertEqual(studio.ask(name)[0], 200)


if __name__ == "__main__":
    main()
