#!/usr/bin/env python3
"""osdtex regress: what it says of a table, and one case through its life."""

import json
import os
import shlex
import subprocess
import time

from suites import (
    ENVIRONMENT, PROGRAM, TILE, TILE_CASE, SuiteTest, main)


class Tables(SuiteTest):
    def test_from_no_reference_to_damage(self):
        self.write_table(TILE, tolerances={"time.*": 100})
        self.assert_exit(self.regress(), 6)
        self.assertEqual(self.results()[TILE_CASE]["status"], "missing")
        self.assertIn("--update " + TILE_CASE, self.page())
        self.assert_exit(self.regress("--update", TILE_CASE), 0)
        self.assert_exit(self.regress(), 0)
        self.assert_exit(self.regress(damage="pixel"), 6)
        case = self.results()[TILE_CASE]
        self.assertEqual(case["tolerance"]["status"], "fail")
        self.assertEqual(case["exact"]["status"], "pass")

    def test_mistakes(self):
        for table, words in (
                ("{", "table.json:1: "), ("{}", 'has no "rows"'),
                ('{"rows": [{}]}', 'row 0 has no "cages"'),
                ('{"rows": [{"cages": [1]}]}', "number 0 is no text"),
                (json.dumps({"rows": [{**TILE, "also": [1]}]}),
                 'in "also", number 0 is no text'),
                (json.dumps({"rows": [TILE, TILE]}), "two cases are called")):
            suite = self.write_table(TILE)
            (suite / "table.json").write_text(table)
            self.assert_error(self.regress(), 2, words)
        for row, words in (
                ({"options": [1]}, '"options" is an object'),
                ({"options": {}}, '"options" is an object'),
                ({"options": "x"}, '"options" is an object'),
                ({"options": {"a": 1}}, "are no text"),
                ({"tiles": 3}, '"tiles" is no text'),
                ({"mask": ["m.png"]}, '"mask" is no text')):
            self.write_table({**TILE, **row})
            self.assert_error(self.regress(), 2, words)
        for more, words in (
                ({"timeout": "1"}, '"timeout" is no positive number'),
                ({"threads": 0}, '"threads" is no positive number'),
                ({"render": 5}, '"render" is no text'),
                ({"tolerances": []}, '"tolerances" is no object')):
            self.write_table(TILE, **more)
            self.assert_error(self.regress(), 2, words)
        many = [f"c{i}.obj" for i in range(300)]
        self.write_table({"cages": many, "exemplars": many, "methods": many})
        begun = time.monotonic()
        self.assert_error(self.regress(), 2, "more than 10000 cases")
        self.assertLess(time.monotonic() - begun, 10)
        self.write_table(TILE)
        self.assert_error(self.regress("none"), 2, "has no case 'none'")
        self.assert_error(
            self.regress("--update", "none"), 2, "has no case 'none'")
        self.assert_error(
            self.run_program("regress", self.folder / "suite"), 1, "-o FOLDER")
        self.assert_error(
            self.run_program(
                "regress", self.folder / "suite", "-o",
                self.folder / "suite" / "table.json"), 3, "cannot be made")

    def bytes_in(self, folder):
        return {p.relative_to(folder): p.read_bytes()
                for p in folder.rglob("*") if p.is_file()}

    def refused(self, words, *arguments, code=2, output=None, suite=None):
        """Says so, and touches nothing."""
        before = self.bytes_in(self.folder)
        result = self.run_program(
            "regress", suite or self.folder / "suite", "-o",
            output or self.folder / "out", *arguments)
        self.assert_error(result, code, words)
        self.assertEqual(self.bytes_in(self.folder), before)

    def test_the_suite_is_kept(self):
        suite = self.write_table(TILE)
        (suite / "reference").mkdir()
        (suite / "reference" / "results.csv").write_text("case,metric\n")
        (self.folder / "link").symlink_to("suite/reference")
        for output in ("suite/reference", "suite/./reference/", "link",
                       "suite/reference/new"):
            self.refused(
                "within the references", output=f"{self.folder}/{output}")
        for history in ("reference/results.csv", "table.json"):
            self.refused("no history", "--history", suite / history)

    def test_folders_of_others_are_kept(self):
        self.write_table(TILE)
        case = self.folder / "out" / TILE_CASE
        kept = self.folder / "kept"
        for folder in kept, self.folder / "out":
            folder.mkdir()
        (kept / "model.obj").write_text("mine")
        case.symlink_to("../kept")
        self.assert_exit(self.regress(), 6)
        self.assertIn("is a link", self.results()[TILE_CASE]["crash"])
        self.assertEqual(
            [(p.name, p.read_text()) for p in kept.iterdir()],
            [("model.obj", "mine")])
        case.unlink()
        case.mkdir()
        for name in "model.obj", "notes.txt":
            (case / name).write_text("mine")
        self.assert_exit(self.regress(), 6)
        self.assertIn("did not put there", self.results()[TILE_CASE]["crash"])
        self.assertEqual((case / "model.obj").read_text(), "mine")
        # In a folder of our own, only what a case makes goes.
        for path in case.iterdir():
            path.unlink()
        self.assert_exit(self.regress(), 6)
        self.assertEqual(self.results()[TILE_CASE]["status"], "missing")
        (case / "notes.txt").write_text("mine")
        (case / "report.json").write_text("stale")
        self.assert_exit(self.regress(), 6)
        self.assertEqual(self.results()[TILE_CASE]["status"], "missing")
        self.assertEqual((case / "notes.txt").read_text(), "mine")
        # The reports replace no links.
        (self.folder / "out" / "results.csv").unlink()
        (self.folder / "out" / "results.csv").symlink_to("../kept/model.obj")
        self.assert_error(self.regress(), 3, "cannot be written")
        self.assertEqual((kept / "model.obj").read_text(), "mine")

    def test_stopping(self):
        """The child cleans up, and the sentence is true."""
        self.write_table({**TILE, "options": {"": "--level 5 --tile-level 1"}})
        job = subprocess.Popen(
            [PROGRAM, "regress", self.folder / "suite", "-o",
             self.folder / "out"], stderr=subprocess.PIPE, env=ENVIRONMENT,
            text=True)
        case = self.folder / "out" / TILE_CASE
        while job.poll() is None and not (case / "log.txt").exists():
            time.sleep(0.01)
        time.sleep(0.2)
        job.terminate()
        said = job.communicate(timeout=30)[1]
        self.assertEqual(job.returncode, 143, said)
        self.assertIn("stopped; no report was written", said)
        self.assertFalse((self.folder / "out" / "report.html").exists())
        self.assertEqual(
            [p.name for p in case.iterdir() if ".tmp-" in p.name], [])

    def test_commands_are_quoted(self):
        suite = self.write_table(TILE).rename(self.folder / "a 'b' $(c)")
        out = self.folder / "o\"<&>"
        result = self.run_program("regress", suite, "-o", out)
        self.assert_exit(result, 6)
        case = json.loads((out / "results.json").read_text())["cases"][TILE_CASE]
        self.assertEqual(
            shlex.split(case["update"]),
            ["osdtex", "regress", str(suite), "-o", str(out), "--update",
             TILE_CASE])
        for line in case["command"].split("&&\n"):
            self.assertIn(str(out / TILE_CASE), " ".join(shlex.split(line)))
        self.assertNotIn('o"<&>', (out / "report.html").read_text())
        self.refused(
            "not UTF-8", suite=suite,
            output=os.fsdecode(bytes(self.folder) + b"/\xff"))


if __name__ == "__main__":
    main()
