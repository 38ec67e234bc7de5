#!/usr/bin/env python3
"""What is known before work begins: said by -n as by the run, and cheaply.

    test_preflight.py OSDTEX
"""

import contextlib
import math
import resource
import subprocess
import unittest

from program import CAGES, EXEMPLARS, SANITIZED, SHARED, ProgramTest, main

GRAVEL = EXEMPLARS / "gravel_tile.png"
PLANE = CAGES / "plane.obj"
JACK = CAGES / "jack.obj"


def grid(path, n, uv=lambda u, v: (u, v)):
    """A bumpy sheet of n x n quads, 10 units wide."""
    side = [i / n for i in range(n + 1)]
    with path.open("w") as f:
        for v in side:
            for u in side:
                f.write(f"v {10 * u} {math.sin(9 * u) * v} {-10 * v}\n")
        for v in side:
            for u in side:
                f.write("vt {} {}\n".format(*uv(u, v)))
        for j in range(n):
            for i in range(n):
                a = j * (n + 1) + i + 1
                f.write("f " + " ".join(
                    f"{k}/{k}" for k in (a, a + 1, a + n + 2, a + n + 1)) + "\n")
    return path


class Preflight(ProgramTest):
    def look(self, command, cage, *more):
        return self.run_program(
            command, cage, GRAVEL, "-n", "-o", self.folder / "out.obj", *more)

    @contextlib.contextmanager
    def cheaply(self):
        """Processor time of what is run inside, not the clock's: a quarter of
        a second is usual, and refinement would take far more than the limit."""
        def spent():
            usage = resource.getrusage(resource.RUSAGE_CHILDREN)
            return usage.ru_utime + usage.ru_stime

        before = spent()
        yield
        if not SANITIZED:
            self.assertLess(spent() - before, 3)

    def findings(self, result):
        return [l for l in result.stderr.splitlines()
                if "warning: " in l or "error: " in l]

    def assert_warned(self, result, words):
        self.assert_exit(result, 0)
        self.assertIn(words, "\n".join(self.findings(result)))

    def test_a_large_cage_is_looked_over_at_once(self):
        cage = grid(self.folder / "large.obj", 320)
        with self.cheaply():
            result = self.look("bake", cage)
        self.assert_exit(result, 0)
        self.assertIn("102400 faces at level 0", result.stdout)
        self.assertIn("the cage's own UVs", result.stdout)

    def test_units(self):
        for scale, words in (
                (".1", "59 pictures side by side on 7864320 faces"),
                ("200", "shows 0.029 of the picture's width")):
            result = self.look("map", JACK, "--scale", scale)
            self.assert_warned(result, "wrong units?")
            self.assertIn(words, result.stderr)
        self.assertNotIn("units?", self.look("map", JACK).stderr)
        self.assertNotIn(
            "units?", self.look("map", JACK, "--scale", "3").stderr)

    def test_edges_longer_than_the_picture(self):
        cage = SHARED / "reports" / "scale_1000.obj"
        if not cage.exists():
            self.skipTest("../shared/data is not there")
        with self.cheaply():
            result = self.look("map", cage, "--scale", ".5")
        self.assert_warned(result, "an edge is still 3.9 pictures long")

    def test_scales_that_nothing_can_be_done_at(self):
        for scale in "1e10", "1e38", "1e300", "1e4", "1e-10", "1e-300":
            for dry in ("-n",), ():
                result = self.run_map(PLANE, GRAVEL, "--scale", scale, *dry)
                self.assert_error(result, 5, "")
                self.assert_nothing_written()

    def test_memory(self):
        result = self.look(
            "map", JACK, "--level", "8", "--memory-limit", "1500M")
        self.assert_error(result, 5, "use level 7")
        self.assertIn(
            "GiB of memory", self.look("map", JACK, "--level", "7").stdout)

    def test_uvs(self):
        square = grid(
            self.folder / "square.obj", 12,
            lambda u, v: (round(12 * u) % 2, round(12 * v) % 2))
        outside = grid(
            self.folder / "outside.obj", 12, lambda u, v: (u - .05, v))
        line = grid(self.folder / "line.obj", 12, lambda u, v: (u, .5))
        for cage, words in (
                (square, "as if they were never unwrapped"),
                (outside, "outside of the UDIM tiles"),
                (line, "lie in a point or on a line")):
            result = self.look("bake", cage)
            self.assert_warned(result, words)
            self.assertIn("so an atlas is baked", result.stderr)
            self.assertIn("onto          an atlas", result.stdout)
            for dry in ("-n",), ():
                self.assert_error(
                    self.run_program(
                        "bake", cage, GRAVEL, "-o", self.folder / "out.obj",
                        "--uvs", "own", *dry),
                    2, words)
        self.assertEqual(
            sorted(p.name for p in self.folder.iterdir()),
            ["line.obj", "outside.obj", "square.obj"])
        self.assert_error(
            self.look("bake", JACK, "--uvs", "own"), 1, "has no UVs")

    @unittest.skipIf(SANITIZED, "a sanitizer needs more than is left here")
    def test_no_memory_at_all_is_one_sentence(self):
        """Of whatever has failed first; below, the loader fails."""
        for mebibytes in 150, 200, 300:
            limit = mebibytes << 20
            try:
                result = self.run_map(
                    PLANE, GRAVEL, "--level", "3", "--threads", "4", "-q",
                    "--preview", self.folder / "out.png", timeout=60,
                    preexec_fn=lambda: resource.setrlimit(
                        resource.RLIMIT_AS, (limit, limit)))
            except subprocess.TimeoutExpired:
                self.fail(f"it hangs with {mebibytes} MiB")
            if result.returncode in (0, 127, 130):
                continue  # there was room, or the loader failed
            self.assert_exit(result, 5)
            self.assertEqual(
                result.stderr.count("osdtex: error: "), 1, result.stderr)
            self.assert_nothing_written()

    def test_tiles_that_are_not_there(self):
        """Own UVs on 1001 and 1002."""
        cage = grid(self.folder / "two.obj", 8, lambda u, v: (2 * u, v))
        for tile, code in (1001, 0), (1002, 0), (1003, 1), (1011, 1):
            self.assert_exit(self.look("bake", cage, "--udim", tile), code)
        self.assert_error(
            self.look("bake", JACK, "--udim", 1009), 1, "has no tile 1009")

    def test_other_files(self):
        scene = self.folder / "scene.usda"
        scene.write_text("#usda 1.0\n")
        self.assert_error(self.look("map", scene), 2, "this is a USD file")
        self.assert_error(
            self.look("map", PLANE, "--json-report", "-"), 1,
            "not to the standard output")

    def test_density(self):
        cage = grid(self.folder / "sheet.obj", 12)
        for side, words in (
                ("64", "x coarser than the exemplar"),
                ("4096", "x finer than the exemplar")):
            result = self.look("bake", cage, "--resolution", side)
            self.assert_exit(result, 0)
            self.assertIn(words, result.stderr)

    def test_a_dry_run_finds_what_the_run_finds(self):
        mirrored = grid(
            self.folder / "mirrored.obj", 8,
            lambda u, v: (min(u, 1 - u), v))
        for cage, more in (
                (mirrored, ()), (mirrored, ("--uvs", "own")),
                (JACK, ("--scale", "60"))):
            # What one cage left behind is another's to replace.
            flags = ("--level", "1", "--resolution", "64", "--replace", *more)
            dry = self.findings(self.look("bake", cage, *flags))
            self.assertTrue(dry)
            result = self.run_program(
                "bake", cage, GRAVEL, "-o", self.folder / "out.obj", *flags)
            self.assert_exit(result, 0)
            self.assertEqual(self.findings(result), dry)

    def test_settings_and_constraints_are_read_before_work(self):
        self.assert_error(
            self.look("map", JACK, "--method", "hierachical"), 1,
            "there is no method")
        self.assert_error(
            self.look("map", JACK, "--set", "overlp=1"), 1, "overlp")
        self.assert_error(
            self.look("map", JACK, "--constraints", "nowhere.json"), 3,
            "nowhere.json")

    def test_masks_and_other_exemplars_are_looked_at(self):
        """As the run would: with its sentence, and its exit code."""
        also = ("--also", EXEMPLARS / "pebbles_tile.png")
        text = self.folder / "mask.png"
        text.write_text("no picture")
        cage = grid(self.folder / "two.obj", 8, lambda u, v: (2 * u, v))
        for words, code, more in (
                ("nothing says where exemplar 2 goes", 1, also),
                ("--also", 1, ("--mask", GRAVEL)),
                ("nowhere.png", 3, (*also, "--mask", "nowhere.png")),
                ("mask.png", 2, (*also, "--mask", text)),
                ("UDIM tile 1001", 3,
                 (*also, "--mask", self.folder / "m.<UDIM>.png")),
                ("chrome", 1, ("--also", f"chrome={GRAVEL}"))):
            with self.subTest(words):
                for dry in ("-n",), ():
                    result = self.run_program(
                        "map", cage, GRAVEL, "--level", "0", *dry, "-o",
                        self.folder / "out.obj", *more)
                    self.assert_error(result, code, words)
                    self.assertEqual(
                        result.stderr.count("error: "), 1, result.stderr)

    def test_the_method_that_a_job_comes_to(self):
        for exemplar, method in (
                (GRAVEL, "hierarchical"),
                (EXEMPLARS / "bricks_tile.png", "material")):
            result = self.run_program(
                "map", JACK, exemplar, "-n", "-o", self.folder / "out.obj",
                "--method", "auto", "--scale", "1")
            self.assert_exit(result, 0)
            self.assertIn(f"by            {method}", result.stdout)
        self.assert_error(
            self.look("map", JACK, "--method", "auto", "--set", "overlp=1"),
            1, "overlp")


if __name__ == "__main__":
    main()
