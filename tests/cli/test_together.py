#!/usr/bin/env python3
"""All files of a call appear together or not at all: signals at any moment,
late outputs that fail, full disks, and what killed runs left behind."""

import os
import random
import resource
import signal
import subprocess
import time
import unittest
from pathlib import Path

from program import (
    CAGES, ENVIRONMENT, EXEMPLARS, PROGRAM, SANITIZED, ProgramTest, main)

CAGE = CAGES / "plane.obj"
EXEMPLAR = EXEMPLARS / "gravel_tile.png"
QUICK = ("--level", "1", "--scale", "4", "--threads", "1", "-q")
WHOLE = ["out.exr", "out.json", "out.mtl", "out.obj"]


class Together(ProgramTest):
    def names(self):
        return sorted(p.name for p in self.folder.iterdir())

    def words(self):
        return [PROGRAM, "map", str(CAGE), str(EXEMPLAR), *QUICK, "-o",
                "out.obj", "--json-report", "out.json"]

    def start(self, words=None):
        return subprocess.Popen(
            words or self.words(), stderr=subprocess.PIPE, env=ENVIRONMENT,
            cwd=self.folder, text=True, start_new_session=True)

    def finish(self, words=None):
        job = self.start(words)
        said = job.communicate(timeout=60)[1]
        self.assertEqual(job.returncode, 0, said)

    def clean(self):
        for path in self.folder.iterdir():
            path.unlink()

    def test_signals_at_random_moments(self):
        """Nothing with the signal's code, or everything with 0."""
        begun = time.monotonic()
        self.finish()
        whole = time.monotonic() - begun
        self.assertEqual(self.names(), WHOLE)
        self.clean()
        moments = random.Random(1)
        numbers = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP,
                   signal.SIGXCPU, signal.SIGUSR1, signal.SIGUSR2,
                   signal.SIGALRM, signal.SIGQUIT]
        for i in range(10):
            number = numbers[i % len(numbers)]
            job = self.start()
            # Before that no program could catch anything.
            time.sleep(0.05 + moments.uniform(0, whole))
            job.send_signal(number)
            said = job.communicate(timeout=60)[1]
            with self.subTest(number):
                if job.returncode == 0:
                    self.assertEqual(self.names(), WHOLE)
                elif job.returncode == 128 + number:
                    self.assertIn("stopped; nothing was written", said)
                    self.assertEqual(self.names(), [])
                else:
                    # So early that nothing was caught yet.
                    self.assertEqual(job.returncode, -number)
                    self.assertEqual(self.names(), [])
            self.clean()

    def test_signal_once_the_model_is_written(self):
        """Aimed at the moment between the model and the report."""
        for number in (signal.SIGINT, signal.SIGHUP):
            job = self.start()
            while job.poll() is None and not any(
                    n.startswith("out.obj") for n in self.names()):
                time.sleep(0.001)
            job.send_signal(number)
            said = job.communicate(timeout=60)[1]
            if job.returncode == 0:
                self.assertEqual(self.names(), WHOLE)
            else:
                self.assertEqual(job.returncode, 128 + number, said)
                self.assertEqual(self.names(), [])
            self.clean()

    def test_ignored_signals_stay_ignored(self):
        """As under nohup."""
        job = self.start(["nohup", *self.words()])
        time.sleep(0.1)
        job.send_signal(signal.SIGHUP)
        job.communicate(timeout=60)
        self.assertEqual(job.returncode, 0)

    def assert_as_it_was(self, code, *more, words=""):
        for name in ("out.obj", "out.mtl", "out.exr"):
            self.assertFalse((self.folder / name).exists())
        before = {n: (self.folder / n).stat().st_mtime_ns
                  for n in self.names()}
        result = self.run_program(
            "map", CAGE, EXEMPLAR, *QUICK, "-o", "out.obj", *more,
            cwd=self.folder)
        self.assert_error(result, code, words)
        self.assertEqual(
            {n: (self.folder / n).stat().st_mtime_ns for n in self.names()},
            before)

    def test_late_outputs_that_fail(self):
        (self.folder / "d").mkdir()
        self.assert_as_it_was(3, "--json-report", "/dev/full")
        self.assert_as_it_was(3, "--json-report", "d", words="'d' is a folder")
        self.assert_as_it_was(3, "--preview", "no/such.png", words="folder")

    def test_full_disk(self):
        """Of every size: the last files fail, or the first ones do."""
        for blocks in (64, 1000, 8000, 30000, 100000):
            result = self.run_program(
                *self.words()[1:], cwd=self.folder,
                preexec_fn=lambda: resource.setrlimit(
                    resource.RLIMIT_FSIZE, (blocks, resource.RLIM_INFINITY)))
            if result.returncode == 0:
                self.assertEqual(self.names(), WHOLE)
            else:
                self.assert_exit(result, 3)
                self.assertEqual(self.names(), [])
            self.clean()

    def test_what_killed_runs_left_is_swept(self):
        words = [PROGRAM, "bake", str(CAGE), str(EXEMPLAR), *QUICK,
                 "--resolution", "512", "-o", "out.obj"]
        left = False
        for _ in range(2):
            job = self.start(words)
            while job.poll() is None and not any(
                    ".tmp-" in n for n in self.names()):
                time.sleep(0.001)
            job.kill()
            job.communicate()
            left = left or any(".tmp-" in n for n in self.names())
            self.assertFalse(any(n.endswith((".obj", ".exr"))
                                 for n in self.names()))
        self.assertTrue(left)
        foreign = self.folder / "out.1001.exr.tmp-00000000-1-0"
        foreign.write_text("of another machine")
        self.finish(words)
        self.assertEqual(
            [n for n in self.names() if ".tmp-" in n], [foreign.name])

    def test_the_longest_names(self):
        name = "x" * 236
        result = self.run_program(
            "map", CAGE, EXEMPLAR, *QUICK, "-o", name + ".obj",
            cwd=self.folder)
        self.assert_exit(result, 0)
        self.assertEqual(
            self.names(), [name + e for e in (".exr", ".mtl", ".obj")])
        self.clean()
        result = self.run_program(
            "map", CAGE, EXEMPLAR, *QUICK, "-o", "x" * 252 + ".obj",
            cwd=self.folder)
        self.assert_error(result, 3, "too long")
        result = self.run_program(
            "bake", CAGE, EXEMPLAR, *QUICK, "--resolution", "64", "-o",
            "x" * 250 + ".obj", cwd=self.folder)
        self.assert_error(result, 3, "too long")
        self.assert_nothing_written()


if __name__ == "__main__":
    main()
