#!/usr/bin/env python3
"""osdtex bake and map --bake: what they write, what they do again, and that
nothing is left when they cannot end.

    test_bake.py OSDTEX
"""

import resource
import shutil
import signal
import subprocess
import time
import unittest

from program import CAGES, ENVIRONMENT, EXEMPLARS, PROGRAM, ProgramTest, main

CAGE = CAGES / "torus.obj"
EXEMPLAR = EXEMPLARS / "pebbles_tile.png"
QUICK = ("--level", "1", "--uvs", "atlas", "--resolution")
LOOK = ["out.mtlx", "out.usda", "out_cage.mtl", "out_cage.obj"]


class Bakes(ProgramTest):
    def names(self):
        return sorted(p.name for p in self.folder.iterdir())

    def bake(self, *more, command="bake", resolution=256):
        return self.run_program(
            command, CAGE, EXEMPLAR, "-o", self.folder / "out.obj", *QUICK,
            resolution, *more)

    def assert_bakes(self, *more, **keywords):
        result = self.bake(*more, **keywords)
        self.assert_exit(result, 0)
        return result

    def texture(self, name):
        self.assertEqual(
            (self.folder / name).read_bytes()[:4], b"\x76\x2f\x31\x01", name)

    def test_files(self):
        self.assert_bakes(
            "--extra", "seam,source,patch,slice,stretch,uv", "--preview-png",
            "--seam-blend", "4")
        textures = [
            f"out{k}.1001.exr" for k in
            ("", "_patch", "_seam", "_slice", "_source", "_stretch",
             "_uv")]
        self.assertEqual(
            self.names(),
            sorted(LOOK + textures + ["out.1001.png", "out_preview.mtl"]))
        for name in textures:
            self.texture(name)
        self.assertIn(
            "# UDIM tiles 1001\n", (self.folder / "out_cage.obj").read_text())

    def test_uvs_that_show_nothing(self):
        """All in a point, as of a cage that was never unwrapped; one face; and
        beyond the tiles. Asked for they are refused where nothing comes of
        them, else an atlas is made."""
        faces = ("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n"
                 "{}f 1/1 2/2 3/3 4/4\nf 2/2 5/5 6/6 3/3\n")
        for us, code, words in (
                (None, 2, "in a point or on a line"),
                ((.1, .5, .5, .1, .5, .5), 0, "face 1 has no area in UV"),
                ((.1, 12, 12, .1, .5, .5), 2, "has UVs near (12, 0)")):
            uvs = "vt .5 .5\n" * 6 if us is None else "".join(
                f"vt {u} {.5 * (i in (2, 3, 5))}\n" for i, u in enumerate(us))
            cage = self.folder / "cage.obj"
            cage.write_text(faces.format(uvs))
            for how in "own", "auto":
                result = self.run_program(
                    "bake", cage, EXEMPLAR, "-o", self.folder / "out.obj",
                    "--level", "1", "--scheme", "bilinear", "--resolution",
                    "64", "--uvs", how)
                self.assert_exit(result, code if how == "own" else 0)
                self.assertIn(words, result.stderr)
                self.assertEqual(
                    "so an atlas is baked" in result.stderr, how == "auto")

    def test_map_bakes_too(self):
        self.assert_bakes("--bake", command="map")
        self.assertEqual(
            self.names(),
            sorted(LOOK + ["out.1001.exr", "out.exr", "out.mtl", "out.obj"]))

    def is_up_to_date(self, *more):
        """Of a bake that takes two tiles."""
        return "is up to date" in self.assert_bakes(
            "-u", *more, resolution=128).stderr

    def test_update_looks_at_every_output(self):
        flags = ("--extra", "patch", "--preview-png")
        self.assertFalse(self.is_up_to_date(*flags))
        self.assertTrue(self.is_up_to_date(*flags))
        names = self.names()
        self.assertIn("out_patch.1002.exr", names)
        for name in names:
            (self.folder / name).unlink()
            self.assertFalse(self.is_up_to_date(*flags), name)
            self.assertEqual(self.names(), names)
        self.assertTrue(self.is_up_to_date(*flags))
        # A texture of another job under the same name.
        shutil.copy(
            self.folder / "out_patch.1001.exr", self.folder / "other.exr")
        self.assert_bakes("--seed", "7", *flags, resolution=128)
        shutil.copy(
            self.folder / "other.exr", self.folder / "out_patch.1001.exr")
        self.assertFalse(self.is_up_to_date("--seed", "7", *flags))

    def test_update_of_one_tile(self):
        flags = ("--udim", "1002")
        self.assertFalse(self.is_up_to_date(*flags))
        self.assertTrue(self.is_up_to_date(*flags))
        # The whole is not done by one of its tiles.
        self.assertFalse(self.is_up_to_date())
        self.assertTrue(self.is_up_to_date())
        self.assertTrue(self.is_up_to_date(*flags))
        for name in ("out.1002.exr", "out.usda", "out_cage.obj"):
            (self.folder / name).unlink()
            self.assertFalse(self.is_up_to_date(*flags), name)
        self.assertFalse(self.is_up_to_date("--udim", "1001", "--seed", "3"))


class Failures(ProgramTest):
    """A bake that takes seconds and megabytes, ended from outside."""

    LARGE = (CAGE, EXEMPLAR, "--level", "1", "--uvs", "atlas", "-q",
             "--resolution", "4096", "--preview-png")

    def test_stopping_leaves_nothing(self):
        for command, more in (("bake", ()), ("map", ("--bake",))):
            for number in (signal.SIGINT, signal.SIGTERM):
                job = subprocess.Popen(
                    [PROGRAM, command, *map(str, self.LARGE), *more, "-o",
                     self.folder / "out.obj"],
                    stderr=subprocess.PIPE, env=ENVIRONMENT)
                self.wait_for_a_texture(job)
                job.send_signal(number)
                job.communicate(timeout=60)
                self.assertEqual(job.returncode, 128 + number)
                self.assert_nothing_written()

    def wait_for_a_texture(self, job):
        """Until some of it is on the disk."""
        end = time.monotonic() + 60
        while job.poll() is None and time.monotonic() < end:
            if any(f.stat().st_size > 100000 for f in self.folder.iterdir()):
                return
            time.sleep(0.01)
        self.fail("nothing was ever written")

    def test_files_that_may_not_grow(self):
        """As `ulimit -f` has it."""
        limit = 1 << 20
        result = self.run_program(
            "bake", *self.LARGE, "-o", self.folder / "out.obj",
            preexec_fn=lambda: resource.setrlimit(
                resource.RLIMIT_FSIZE, (limit, limit)))
        self.assert_error(result, 3, "the disk is full (File too large)")
        self.assert_nothing_written()

    def test_a_full_disk(self):
        """A disk of 3 MB, in a name space of its own."""
        disk = self.folder / "disk"
        disk.mkdir()
        script = (
            f"mount -t tmpfs -o size=3m none '{disk}' || exit 99\n"
            f"'{PROGRAM}' bake {' '.join(map(str, self.LARGE))} "
            f"-o '{disk}/out.obj'\n"
            f"code=$?; ls -A '{disk}'; exit $code")
        try:
            result = subprocess.run(
                ["unshare", "-r", "-m", "sh", "-c", script],
                capture_output=True, text=True, env=ENVIRONMENT)
        except FileNotFoundError:
            self.skipTest("there is no unshare")
        if result.returncode in (1, 99) and "osdtex" not in result.stderr:
            self.skipTest(f"no disk can be mounted here: {result.stderr}")
        self.assert_error(
            result, 3, "the disk is full (No space left on device)")
        self.assertEqual(result.stdout, "")


if __name__ == "__main__":
    main()
