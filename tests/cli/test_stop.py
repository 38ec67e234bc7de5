#!/usr/bin/env python3
"""SIGTERM and SIGINT end a job within a moment, whatever it is at.

    test_stop.py OSDTEX
"""

import signal
import subprocess
import time
import unittest

from program import CAGES, ENVIRONMENT, EXEMPLARS, PROGRAM, ProgramTest, main

GRAVEL = EXEMPLARS / "gravel_tile.png"

# Stopping takes about a second, whatever the work is at; what is left is for a
# busy machine.
SECONDS = 8


class Stop(ProgramTest):
    def stop(self, number, after, *command):
        """Sends the signal so many seconds after the start. False when the job
        was over before."""
        process = subprocess.Popen(
            [PROGRAM, *map(str, command)], stderr=subprocess.PIPE, text=True,
            env=ENVIRONMENT)
        try:
            process.wait(after)
            return False
        except subprocess.TimeoutExpired:
            pass
        process.send_signal(number)
        begun = time.monotonic()
        _, errors = process.communicate()
        self.assertLess(time.monotonic() - begun, SECONDS, errors)
        self.assertEqual(process.returncode, 128 + number, errors)
        self.assertIn("stopped; nothing was written", errors)
        return True

    def assert_stops(self, cage, *flags, command="map", times=4):
        after, number = .3, signal.SIGTERM
        for _ in range(times):
            if not self.stop(
                    number, after, command, cage, GRAVEL, "-o",
                    self.folder / "out.obj", *flags):
                break
            after, number = 2 * after, signal.SIGINT
        self.assertEqual(list(self.folder.glob("*out*")), [])

    def test_growth_of_clusters(self):
        """Edges that are still longer than the picture at a deep level."""
        cage = self.folder / "cube.obj"
        source = (CAGES / "sphere.obj").read_text().splitlines()
        cage.write_text("\n".join(
            " ".join(["v"] + [str(1000 * float(x)) for x in l.split()[1:4]])
            if l.startswith("v ") else l for l in source) + "\n")
        self.assert_stops(cage, "--scale", ".5", "--level", "8")

    def test_flattening_of_large_clusters(self):
        self.assert_stops(CAGES / "jack.obj", "--level", "7")

    def test_refinement(self):
        """Which OpenSubdiv does in one call that does not look."""
        self.assert_stops(CAGES / "jack.obj", "--level", "8", times=2)

    def test_baking(self):
        self.assert_stops(
            CAGES / "jack.obj", "--level", "2", "--resolution", "8192",
            command="bake", times=2)

    def test_who_asks_twice_does_not_wait(self):
        process = subprocess.Popen(
            [PROGRAM, "map", CAGES / "jack.obj", GRAVEL, "--level", "8", "-o",
             self.folder / "out.obj"], stderr=subprocess.PIPE, text=True,
            env=ENVIRONMENT)
        time.sleep(1)
        process.send_signal(signal.SIGTERM)
        process.send_signal(signal.SIGTERM)
        _, errors = process.communicate(timeout=SECONDS)
        self.assertEqual(process.returncode, 128 + signal.SIGTERM, errors)
        self.assertIn("stopped; nothing was written", errors)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    main()
