#!/usr/bin/env python3
"""Whole jobs: what is written, the same bytes each time, stopping, -n, -u."""

import json
import os
import re
import signal
import subprocess
import time

from program import (
    CAGES, ENVIRONMENT, EXEMPLARS, PROGRAM, SANITIZED, ProgramTest, main)

CAGE = CAGES / "plane.obj"
EXEMPLAR = EXEMPLARS / "gravel_tile.png"
QUICK = ("--level", "2", "--scale", "2")


class Jobs(ProgramTest):
    def names(self):
        return sorted(p.name for p in self.folder.iterdir())

    def test_outputs_and_report(self):
        picture, report = self.folder / "out.png", self.folder / "out.json"
        result = self.run_map(
            CAGE, EXEMPLAR, *QUICK, "--preview", picture, "--size", "64x48",
            "--samples", "1", "--json-report", report, "--seed", "7")
        self.assert_exit(result, 0)
        self.assertEqual(
            self.names(),
            ["out.exr", "out.json", "out.mtl", "out.obj", "out.png"])
        data = json.loads(report.read_text())
        self.assertEqual(data["options"]["level"], 2)
        self.assertEqual(data["options"]["scale"], 2.0)
        self.assertEqual(data["options"]["seed"], 7)
        settings = data["options"]["settings"]
        self.assertEqual(settings["relax"], "global")
        self.assertGreater(float(settings["patch"]), 0)
        self.assertEqual(data["mapping"]["leaf_faces"], 256)
        self.assertEqual(data["distortion"]["flips"], 0)
        self.assertEqual(data["distortion"]["uncovered"], 0)
        self.assertEqual(len(data["inputs"]["cage"]["hash"]), 32)
        self.assertEqual(len(data["inputs"]["exemplar"]["hash"]), 32)
        self.assertGreater(len(data["colour"]["decisions"]), 2)
        self.assertIn("energy", data["seams"])
        self.assertIn("map", data["seconds"])
        self.assertGreater(data["memory"]["peak_bytes"], 0)

    def test_colour_decisions_are_printed(self):
        result = self.run_map(CAGE, EXEMPLAR, *QUICK)
        self.assertIn("osdtex: colour: ", result.stderr)
        result = self.run_map(CAGE, EXEMPLAR, *QUICK, "-q")
        self.assertEqual(result.stderr, "")

    def test_exemplar_that_is_made_to_tile(self):
        report = self.folder / "out.json"
        exemplar = EXEMPLARS / "stones_open.png"
        textures = {}
        for how in ("keep", "auto", "make"):
            result = self.run_map(
                CAGE, exemplar, *QUICK, "--tileable", how, "--json-report",
                report)
            self.assert_exit(result, 0)
            colour = json.loads(report.read_text())["colour"]
            self.assertEqual(colour["made_tileable"], how == "make")
            self.assertEqual(colour["wrap_x"], how == "make")
            # But for the mark, which says of which job the file is.
            textures[how] = re.sub(
                rb"osdtex job \w+ of \S+ seal \w+", b"",
                (self.folder / "out.exr").read_bytes())
            self.assertEqual("made to tile" in result.stderr, how != "keep")
        self.assertEqual(textures["keep"], textures["auto"])
        self.assertNotEqual(textures["keep"], textures["make"])

    def test_local_scale(self):
        """The texture doubles from one corner of a plane to the other."""
        wishes = self.folder / "wishes.json"
        wishes.write_text(
            '{"constraints": [{"face": 0, "scale": 1}, '
            '{"face": 15, "scale": 2}]}')
        report = self.folder / "out.json"
        result = self.run_map(
            CAGE, EXEMPLAR, *QUICK, "--constraints", wishes, "--json-report",
            report)
        self.assert_exit(result, 0)
        self.assertEqual(
            json.loads(report.read_text())["distortion"]["flips"], 0)
        points, uvs, faces = [], [], []
        for line in (self.folder / "out.obj").read_text().splitlines():
            word, *rest = line.split() or [""]
            if word == "v":
                points.append([float(x) for x in rest])
            elif word == "vt":
                uvs.append([float(x) for x in rest])
            elif word == "f":
                faces.append([[int(i) - 1 for i in c.split("/")]
                              for c in rest])

        def area(corners):
            total = [0.0, 0.0, 0.0]
            for a, b in zip(corners, corners[1:] + corners[:1]):
                a, b = (a + [0])[:3], (b + [0])[:3]
                for k in range(3):
                    i, j = (k + 1) % 3, (k + 2) % 3
                    total[k] += a[i] * b[j] - a[j] * b[i]
            return sum(t * t for t in total) ** 0.5

        def size(face):
            return (area([points[c[0]] for c in face]) /
                    area([uvs[c[1]] for c in face])) ** 0.5

        self.assertAlmostEqual(
            size(faces[-1]) / size(faces[0]), 2.0, delta=0.35)

    def test_default_scale_is_said(self):
        result = self.run_map(CAGE, EXEMPLAR, "-n")
        self.assertIn("a fifth of the diagonal", result.stderr)

    def test_same_bytes_for_any_number_of_threads(self):
        written = []
        for threads in ("1", "2", "8"):
            self.assert_exit(
                self.run_map(CAGE, EXEMPLAR, *QUICK, "--threads", threads), 0)
            written.append(
                [(self.folder / f"out.{e}").read_bytes()
                 for e in ("obj", "mtl", "exr")])
        self.assertEqual(written[0], written[1])
        self.assertEqual(written[0], written[2])

    def test_threads_from_the_environment(self):
        report = self.folder / "r.json"
        result = self.run_map(
            CAGE, EXEMPLAR, *QUICK, "--json-report", report,
            environment={"OSDTEX_THREADS": "3", "CUE_THREADS": "2"})
        self.assert_exit(result, 0)
        self.assertEqual(json.loads(report.read_text())["options"]["threads"], 3)
        for name in ("OSDTEX_THREADS", "CUE_THREADS", "SLURM_CPUS_PER_TASK"):
            result = self.run_map(
                CAGE, EXEMPLAR, "-n", environment={name: "many"})
            self.assert_exit(result, 0)
            self.assertIn(f"warning: {name} is 'many'", result.stderr)

    def test_dry_run_writes_nothing(self):
        result = self.run_map(CAGE, EXEMPLAR, *QUICK, "-n")
        self.assert_exit(result, 0)
        self.assertIn("256 faces at level 2", result.stdout)
        self.assert_nothing_written()

    def test_update(self):
        out = self.folder / "out.obj"
        self.assert_exit(self.run_map(CAGE, EXEMPLAR, *QUICK, "-u"), 0)
        # An old time must not matter, a changed flag or a lost file must.
        os.utime(out, (1, 1))
        result = self.run_map(CAGE, EXEMPLAR, *QUICK, "-u")
        self.assert_exit(result, 0)
        self.assertIn("is up to date", result.stderr)
        self.assertEqual(out.stat().st_mtime, 1)
        self.assert_exit(
            self.run_map(CAGE, EXEMPLAR, *QUICK, "-u", "--seed", "2"), 0)
        self.assertNotEqual(out.stat().st_mtime, 1)
        (self.folder / "out.exr").unlink()
        self.assert_exit(
            self.run_map(CAGE, EXEMPLAR, *QUICK, "-u", "--seed", "2"), 0)
        self.assertTrue((self.folder / "out.exr").exists())

    def test_render_of_what_was_written(self):
        self.assert_exit(self.run_map(CAGE, EXEMPLAR, *QUICK), 0)
        for show in ("texture", "patches", "stretch", "seams"):
            for extension in ("png", "exr"):
                picture = self.folder / f"{show}.{extension}"
                result = self.run_program(
                    "render", self.folder / "out.obj", "-o", picture, "--size",
                    "64x48", "--samples", "1", "--show", show)
                self.assert_exit(result, 0)
                self.assertGreater(picture.stat().st_size, 100)

    def test_render_of_a_field_on_what_was_written(self):
        self.assert_exit(self.run_map(CAGE, EXEMPLAR, *QUICK), 0)

        def table(level):
            path = self.folder / f"field{level}.csv"
            self.assert_exit(
                self.run_program(
                    "field", CAGE, "-o", path, "--follow", "curvature",
                    "--level", level), 0)
            return path

        def render(*arguments):
            return self.run_program(
                "render", self.folder / "out.obj", "-o",
                self.folder / "x.png", "--size", "64x48", "--samples", "1",
                *arguments)

        for show in ("field", "singularities"):
            for more in ((), ("--follow", "1,0,0", "--symmetry", "4"),
                         ("--constraints", table("2"))):
                self.assert_exit(render("--show", show, *more), 0)
        result = render("--show", "field", "--constraints", table("1"))
        self.assert_error(
            result, 1, "the table has 64 lines, but the mesh has 256 faces")

    def test_render_without_material_is_grey(self):
        picture = self.folder / "x.png"
        (self.folder / "m.obj").write_text(
            "mtllib gone.mtl\n" + CAGE.read_text())
        result = self.run_program(
            "render", self.folder / "m.obj", "-o", picture, "--size", "32x32")
        self.assert_exit(result, 0)
        self.assertIn("warning: ", result.stderr)
        self.assertIn("gone.mtl", result.stderr)

    def test_output_that_cannot_be_written_leaves_nothing(self):
        (self.folder / "out.mtl").mkdir()
        result = self.run_map(CAGE, EXEMPLAR, *QUICK)
        self.assert_error(result, 3, "out.mtl")
        self.assertEqual(self.names(), ["out.mtl"])


class Signals(ProgramTest):
    """A job long enough to be stopped, stopped at several moments."""

    def stop(self, number, seconds):
        job = subprocess.Popen(
            [PROGRAM, "map", CAGES / "creature.obj", EXEMPLAR, "-o",
             self.folder / "out.obj", "--level", "4"],
            stderr=subprocess.PIPE, env=ENVIRONMENT)
        self.await_first_line(job)
        time.sleep(seconds)
        job.send_signal(number)
        sent = time.monotonic()
        job.communicate(timeout=60)
        return job.returncode, time.monotonic() - sent

    def test_stopping_leaves_nothing(self):
        for seconds in (0.3, 1.0):
            for number in (signal.SIGINT, signal.SIGTERM):
                code, waited = self.stop(number, seconds)
                self.assertEqual(code, 128 + number)
                self.assert_nothing_written()
                if not SANITIZED:
                    self.assertLess(waited, 10)


if __name__ == "__main__":
    main()
