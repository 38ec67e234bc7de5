#!/usr/bin/env python3
"""osdtex regress: damage is caught in the tier that is meant to catch it."""

import json
import signal
import subprocess
import time

from suites import PROGRAM, TILE, TILE_CASE, SuiteTest, main


class OneCase(SuiteTest):
    """A suite of one case, with its references."""

    def setUp(self):
        super().setUp()
        # Other tests run beside this one: times are let be unless a test is
        # about them.
        self.write_table(TILE, tolerances={"time.*": 100})
        self.assert_exit(self.regress("--update", "all"), 0)

    def tiers(self):
        case = self.results()[TILE_CASE]
        return [case[t]["status"] for t in ("exact", "tolerance", "metric")]

    def test_the_same_again_passes(self):
        self.assert_exit(self.regress(), 0)
        self.assertEqual(self.tiers(), ["pass", "pass", "pass"])
        files = self.results()[TILE_CASE]["files"]
        self.assertEqual(
            sorted(files), ["model.exr", "model.mtl", "model.obj", "tiles.exr"])

    def test_one_pixel(self):
        self.assert_exit(self.regress(damage="pixel"), 6)
        self.assertEqual(self.tiers(), ["pass", "fail", "pass"])
        found = self.results()[TILE_CASE]["tolerance"]
        self.assertEqual(found["at"], [40, 30])
        self.assertEqual(found["differing"], 1)
        self.assertAlmostEqual(found["worst"], 16 / 255, places=6)

    def test_one_uv(self):
        self.assert_exit(self.regress(damage="uv"), 6)
        exact = self.results()[TILE_CASE]["exact"]
        self.assertEqual(
            [f["name"] for f in exact["files"] if f["status"] == "fail"],
            ["model.obj"])

    def test_a_uv_on_another_machine_is_judged_by_the_picture(self):
        path = self.folder / "suite" / "reference" / "exact.json"
        exact = json.loads(path.read_text())
        exact[TILE_CASE]["machine"] = "abacus"
        path.write_text(json.dumps(exact))
        self.assert_exit(self.regress(damage="uv"), 0)
        self.assertEqual(self.tiers(), ["skipped", "pass", "pass"])
        self.assertIn("from another machine (abacus)", self.page())

    def test_a_slower_program(self):
        self.write_table(TILE)
        self.assert_exit(self.regress(damage="slow"), 6)
        self.assertEqual(self.tiers(), ["pass", "pass", "fail"])
        rows = self.results()[TILE_CASE]["metric"]["rows"]
        self.assertIn(
            "time.cpu", [r["name"] for r in rows if r["status"] == "fail"])

    def test_a_slower_stage(self):
        self.write_table(TILE, tolerances={"time.cpu": 100, "time.*": 2})
        self.assert_exit(self.regress(damage="stage"), 6)
        rows = self.results()[TILE_CASE]["metric"]["rows"]
        self.assertEqual(
            [r["name"] for r in rows if r["status"] == "fail"], ["time.place"])

    def test_a_changed_figure(self):
        path = self.folder / "suite" / "reference" / "results.csv"
        text = path.read_text()
        path.write_text(text.replace(
            f"{TILE_CASE},flips,0", f"{TILE_CASE},flips,1"))
        self.assertNotEqual(text, path.read_text())
        self.assert_exit(self.regress(), 6)
        self.assertEqual(self.tiers(), ["pass", "pass", "fail"])

    def test_crashes_are_told(self):
        for damage, words in (
                ("crash", "killed by signal 11"), ("refuse", "exit code 2")):
            result = self.regress(damage=damage)
            self.assert_exit(result, 6)
            self.assertIn(words, result.stderr)
            self.assertEqual(self.results()[TILE_CASE]["status"], "crashed")
            self.assertIn(words, self.page())
        self.assertIn("&lt;no&gt; such cage", self.page())

    def test_what_hangs_is_killed(self):
        self.write_table(TILE, timeout=0.5)
        begun = time.monotonic()
        result = self.regress(damage="hang")
        self.assert_exit(result, 6)
        self.assertIn("not done after 0.5 s", result.stderr)
        self.assertLess(time.monotonic() - begun, 30)

    def test_stopping(self):
        hanging = self.folder / "hanging"
        hanging.write_text("#!/bin/sh\nexec sleep 60\n")
        hanging.chmod(0o755)
        job = subprocess.Popen(
            [PROGRAM, "regress", self.folder / "suite", "-o",
             self.folder / "out", "--program", hanging])
        time.sleep(2.0)
        self.assertIsNone(job.poll())
        job.send_signal(signal.SIGTERM)
        self.assertEqual(job.wait(timeout=30), 128 + signal.SIGTERM)

    def test_history_makes_trends(self):
        history = self.folder / "nights.jsonl"
        for _ in range(2):
            self.regress("--history", history)
        with history.open("a") as out:
            out.write("{ damaged\n")
        self.regress("--history", history)
        self.assertEqual(len(history.read_text().splitlines()), 4)
        self.assertIn('aria-label="3 runs, from', self.page())

    def test_an_update_is_one_case_and_is_repeatable(self):
        other = dict(TILE, options={"": "--tile-level 1", "b": "--seed 2"})
        self.write_table(other, tolerances={"time.*": 100})
        self.assert_exit(self.regress(), 6)
        reference = self.folder / "suite" / "reference"
        before = (reference / f"{TILE_CASE}.png").stat().st_mtime_ns
        self.assert_exit(self.regress("--update", f"{TILE_CASE}.b"), 0)
        self.assertEqual(
            (reference / f"{TILE_CASE}.png").stat().st_mtime_ns, before)
        self.assert_exit(self.regress(), 0)
        self.assert_exit(self.regress(f"{TILE_CASE}.b"), 0)
        self.assertEqual(list(self.results()), [f"{TILE_CASE}.b"])
        exact = (reference / "exact.json").read_bytes()
        self.assert_exit(self.regress("--update", "all"), 0)
        self.assertEqual((reference / "exact.json").read_bytes(), exact)


if __name__ == "__main__":
    main()
