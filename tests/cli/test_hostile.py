#!/usr/bin/env python3
"""Every file of the hostile collection as cage, exemplar and configuration:
a sentence and an exit code from 1 to 5, or a result where it is valid; within
10 s and 2 GiB; no output after an error.

Skipped where the collection is not beside the project."""

import os
import resource
import subprocess
import time

from program import (
    CAGES, ENVIRONMENT, EXEMPLARS, PROGRAM, SANITIZED, SHARED, ProgramTest,
    main)

HOSTILE = SHARED / "hostile"
SECONDS = 10
BYTES = 2 << 30

CAGE = CAGES / "plane.obj"
EXEMPLAR = EXEMPLARS / "gravel_tile.png"


def files():
    if not HOSTILE.is_dir():
        return []
    return sorted(p for p in HOSTILE.iterdir() if p.name != "SOURCES.md")


class Hostile(ProgramTest):
    def setUp(self):
        super().setUp()
        if not files():
            self.skipTest(f"{HOSTILE} is not there")

    def run_job(self, cage, exemplar, *more):
        """Exit code, seconds, peak bytes, stderr."""
        log = self.folder.with_suffix(".log")
        begun = time.monotonic()
        with open(log, "wb") as stderr:
            job = subprocess.Popen(
                [PROGRAM, "map", cage, exemplar, "-o",
                 self.folder / "out.obj", "--level", "1", "--memory-limit",
                 "2G", *more],
                stdout=subprocess.DEVNULL, stderr=stderr, env=ENVIRONMENT,
                preexec_fn=lambda: resource.setrlimit(
                    resource.RLIMIT_CPU, (4 * SECONDS, 4 * SECONDS)))
            _, status, usage = os.wait4(job.pid, 0)
            job.returncode = os.waitstatus_to_exitcode(status)
        text = log.read_text(errors="replace")
        log.unlink()
        return (job.returncode, time.monotonic() - begun,
                1024 * usage.ru_maxrss, text)

    def judge(self, path, code, seconds, peak, text):
        written = sorted(p.name for p in self.folder.iterdir())
        with self.subTest(file=path.name):
            self.assertIn(code, range(0, 6), text)
            if not SANITIZED:
                self.assertLess(seconds, SECONDS)
                self.assertLess(peak, BYTES)
            if code == 0:
                self.assertEqual(written, ["out.exr", "out.mtl", "out.obj"])
            else:
                self.assertIn("osdtex: error: ", text)
                self.assertEqual(written, [], text)
        for name in written:
            (self.folder / name).unlink()

    def test_as_cage(self):
        for path in files():
            self.judge(path, *self.run_job(path, EXEMPLAR))

    def test_as_exemplar(self):
        for path in files():
            self.judge(path, *self.run_job(CAGE, path))

    def test_as_configuration(self):
        for path in files():
            self.judge(
                path, *self.run_job(CAGE, EXEMPLAR, "--colorconfig", path))


if __name__ == "__main__":
    main()
