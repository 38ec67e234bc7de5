#!/usr/bin/env python3
"""SIGTERM and SIGINT end a job within a moment, whatever it is at.

    test_stop.py OSDTEX
"""

import os
import signal
import subprocess
import time
import unittest

from program import CAGES, ENVIRONMENT, EXEMPLARS, PROGRAM, ProgramTest, main

GRAVEL = EXEMPLARS / "gravel_tile.png"

# Stopping takes about a second on two threads, whatever the work is at. It is
# the program's own time that counts: a busy machine gives it as it likes.
CPU_SECONDS = 4
TICK = 1 / os.sysconf("SC_CLK_TCK")


def cpu_seconds(process):
    """What it has used until now."""
    with open(f"/proc/{process.pid}/stat", encoding="utf-8") as stat:
        user, system = stat.read().rpartition(")")[2].split()[11:13]
    return (int(user) + int(system)) * TICK


class Stop(ProgramTest):
    def stop(self, number, after, *command):
        """Sends the signal so many seconds after the first words. False when
        the job was over before."""
        process = subprocess.Popen(
            [PROGRAM, *map(str, command)], stderr=subprocess.PIPE, text=True,
            env=ENVIRONMENT)
        self.await_first_line(process)
        try:
            process.wait(after)
            return False
        except subprocess.TimeoutExpired:
            pass
        self.end(process, number)
        return True

    def end(self, process, number, times=1):
        begun = cpu_seconds(process)
        for _ in range(times):
            process.send_signal(number)
        with process.stderr as stream:
            errors = stream.read()
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.assertLess(
            used.ru_utime + used.ru_stime - begun, CPU_SECONDS, errors)
        self.assertEqual(process.returncode, 128 + number, errors)
        self.assertIn("stopped; nothing was written", errors)

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
        self.await_first_line(process)
        time.sleep(1)
        self.end(process, signal.SIGTERM, times=2)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    main()
