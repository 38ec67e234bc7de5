#!/usr/bin/env python3
"""Many cages at one density: tools/plan-cages, on make and in one process.

    test_cages.py OSDTEX short [FOLDER_OF_THE_PYTHON_PACKAGE]
    test_cages.py OSDTEX many
"""

import json
import os
import subprocess
import sys
import unittest

from jobs import ENVIRONMENT, PROGRAM, JobTest
from program import EXEMPLARS, ROOT

PEBBLES = EXEMPLARS / "pebbles_tile.png"
TOOL = ROOT / "tools" / "plan-cages"
TIER = sys.argv[2] if len(sys.argv) > 2 else "short"


def strip(number):
    """A bent strip of three quads, each of its own size and height."""
    size = 0.5 + 0.07 * (number % 17)
    points = [(size * x, 0.2 * size * ((x * (number + 3)) % 3), size * z)
              for z in range(2) for x in range(4)]
    faces = [(x, x + 4, x + 5, x + 1) for x in range(3)]
    return "".join("v %.6g %.6g %.6g\n" % p for p in points) + "".join(
        "f " + " ".join(str(v + 1) for v in face) + "\n" for face in faces)


class Cages(JobTest):
    def setUp(self):
        super().setUp()
        self.cages = self.folder / "cages"
        self.cages.mkdir()
        self.job = self.folder / "props.json"

    def make_cages(self, count):
        for k in range(count):
            (self.cages / f"prop{k:03d}.obj").write_text(strip(k))

    def tool(self, *words, code=0, **environment):
        result = subprocess.run(
            [sys.executable, str(TOOL), *map(str, words)], capture_output=True,
            text=True, env={**ENVIRONMENT, **environment})
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        return result

    def plan(self, *more):
        self.tool(self.cages, PEBBLES, "-o", self.job, "--scale", "2", *more)
        tasks = json.loads(self.job.read_text())["tasks"]
        for task in tasks:  # leaves of a strip, not of a forest
            if "--level" not in task["arguments"]:
                task["arguments"] += ["--level", "0"]
        text = json.loads(self.job.read_text())
        text["tasks"] = tasks
        self.job.write_text(json.dumps(text))
        return tasks

    def on_make(self, count):
        self.make_cages(count)
        self.plan()
        result = self.run_program(
            "plan", self.job, "-o", self.folder / "farm")
        self.assert_exit(result, 0)
        self.assertIn(f"{count} tasks: ", result.stdout)
        made = subprocess.run(
            ["make", "-k", "-j", "2", "-f", self.folder / "farm" / "Makefile"],
            env={**ENVIRONMENT, "OSDTEX_THREADS": "1"}, capture_output=True,
            text=True)
        self.assertEqual(made.returncode, 0, made.stderr)
        said = self.tool("--summary", self.job).stdout
        self.assertIn(f"{count} of {count} assets", said)
        self.assertIn("spread 0.00 %", said)
        page = self.job.with_suffix(".html").read_text()
        self.assertEqual(page.count("<tr><td>"), count)
        self.assertIn("class=good", page)


class Many(Cages):
    def test_two_hundred_assets_on_make(self):
        self.need("make")
        self.on_make(200)


class Few(Cages):
    def test_on_make(self):
        self.need("make")
        self.on_make(4)

    def test_in_one_process(self):
        """The same texture coordinates as on a farm, exemplars read once, and
        smaller ones from one mapping."""
        if len(sys.argv) < 4:
            self.skipTest("the Python module is not built")
        self.need(modules=("numpy",))
        path = {"PYTHONPATH": sys.argv[3], "OSDTEX_THREADS": "1"}
        self.make_cages(3)
        tasks = self.plan()
        self.assertIn("1 exemplars read", self.tool(
            "--run", self.job, **path).stdout)
        here = (self.folder / "out" / "prop001.obj").read_text()
        self.assert_exit(self.run_program(
            "run", self.job, "--task", "1"), 0)
        there = (self.folder / "out" / "prop001.obj").read_text()
        def lines(text):
            return [l for l in text.splitlines() if l[:1] in "vf"]
        self.assertEqual(lines(here), lines(there))
        self.assertIn("2 done", self.tool(
            "--run", self.job, "1/2", **path).stdout)
        self.plan("--texels-per-unit", "20", "--resolution", "128", "--lods",
                  "2", "--out", "baked")
        self.tool("--run", self.job, **path)
        names = {p.name for p in (self.folder / "baked").iterdir()}
        for end in ("", "_lod1", "_lod2"):
            self.assertIn(f"prop002{end}.1001.exr", names)
        self.assertEqual(len(tasks), 3)

    def test_seeds_are_of_names(self):
        def seeds():
            return {t["name"]: t["arguments"][
                t["arguments"].index("--seed") + 1] for t in self.plan()}

        self.make_cages(3)
        before = seeds()
        self.assertEqual(len(set(before.values())), 3)
        (self.cages / "prop001.obj").unlink()
        (self.cages / "another.obj").write_text(strip(9))
        after = seeds()
        for name in ("prop000", "prop002"):
            self.assertEqual(before[name], after[name])

    def test_table(self):
        self.make_cages(2)
        table = self.folder / "props.csv"
        table.write_text("cage,name,exemplar,level,seed\n"
                         f"cages/prop000.obj,rock,,1,7\n"
                         f"cages/prop001.obj,,{PEBBLES},,\n")
        self.tool(table, PEBBLES, "-o", self.job)
        rock, other = json.loads(self.job.read_text())["tasks"]
        self.assertEqual((rock["name"], other["name"]), ("rock", "prop001"))
        words = rock["arguments"]
        self.assertEqual(words[words.index("--seed") + 1], "7")
        self.assertEqual(words[words.index("--level") + 1], "1")
        self.assertNotIn("--level", other["arguments"])
        # One scale for both, though they are of other sizes.
        scale = [w[w.index("--scale") + 1]
                 for w in (words, other["arguments"])]
        self.assertEqual(scale[0], scale[1])

    def test_what_is_wrong(self):
        for said, make in (
                ("holds no OBJ", lambda: None),
                ("there are no vertices",
                 lambda: (self.cages / "a.obj").write_text("# none\n"))):
            make()
            self.assertIn(said, self.tool(
                self.cages, PEBBLES, "-o", self.job, code=2).stderr)
        table = self.folder / "bad.csv"
        for text, said in (("name\nx\n", "one of them cage"),
                           ("cage,name\n,x\n", "bad.csv:2: no cage"),
                           ("cage\nnone.obj\n", "none.obj")):
            table.write_text(text)
            self.assertIn(said, self.tool(
                table, PEBBLES, "-o", self.job, code=2).stderr)

    def test_what_is_missing_shows(self):
        self.make_cages(1)
        self.plan()
        said = self.tool("--summary", self.job, code=6).stdout
        self.assertIn("0 of 1 assets", said)
        self.assertIn("missing", self.job.with_suffix(".html").read_text())


if __name__ == "__main__":
    wanted = "Many" if TIER == "many" else "Few"
    unittest.main(argv=[sys.argv[0], wanted], verbosity=2)
