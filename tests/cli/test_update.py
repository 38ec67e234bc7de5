#!/usr/bin/env python3
"""Up to date, or not: whatever the result depends on is compared, outputs that
are not whole are made again, and those of another job are not replaced."""

import os
import re
import shutil
import struct
import subprocess
import unittest
import zlib

from program import CAGES, EXEMPLARS, ROOT, SHARED, ProgramTest, main

CAGE = CAGES / "plane.obj"
EXEMPLAR = EXEMPLARS / "gravel_tile.png"
QUICK = ("--level", "0", "--scale", "4")
SMALL = ("--size", "64x48", "--samples", "1")

# Another value for every flag that takes one; None: a switch.
CHANGED = {
    "method": "hierarchical", "scale": "3.5", "level": "1", "seed": "2",
    "set": "patch=9", "also": "x", "mask": "m.png", "first-patch": "0,.5,.5,0",
    "constraints": "k.json", "follow": "up", "exemplar-class": "isotropic",
    "generators": "8,0,0,8", "tile-level": "1", "bake": None, "for": "web", "uvs": "atlas",
    "resolution": "64", "texels-per-unit": "8", "margin": "8",
    "seam-blend": "2", "heal": "8", "along": "x", "place": "p.json", "extra": "uv", "preview-png": None,
    "scheme": "bilinear", "boundary": "edgeOnly", "fvar": "all",
    "from": "Linear Rec.709", "to": "ACEScg", "match-space": "sRGB",
    "match-in": "lab", "wrap": "no", "tileable": "make", "show": "uv",
    "weld": "0.1", "keep": "k.osdtex", "rest": "k.obj", "layer": "beauty",
    "normals": None, "pastes": None, "units": "mm",
    "up": "z", "material": "m", "map": "height=m.png", "height-range": "2",
    "normal-y": "down", "match-maps": "color,height",
    "plain": None, "displace": None, "camera": "front", "draw": "wire", "turn": "30",
    "size": "64x48", "samples": "1", "unlit": None, "no-shadows": None,
    "height-middle": "0",
}
APART = {"output", "preview", "json-report", "save", "threads", "memory-limit",
         "colorconfig", "dry-run", "update", "replace", "verbose", "quiet",
         "help", "version", "udim"}


# Whose space "graded" goes through a table that refers to another one.
CONFIGURATION = """ocio_profile_version: 2
search_path: luts
roles: {scene_linear: lin, default: raw, color_picking: tx, data: raw}
displays:
  sRGB:
    - !<View> {name: Film, colorspace: tx}
colorspaces:
  - !<ColorSpace> {name: lin}
  - !<ColorSpace>
    name: tx
    to_reference: !<ExponentTransform> {value: [2.2, 2.2, 2.2, 1]}
  - !<ColorSpace>
    name: graded
    to_reference: !<FileTransform> {src: outer.ctf}
  - !<ColorSpace> {name: raw, isdata: true}
"""

TABLE = """Version 1
From 0.0 1.0
Length 3
Components 1
{{
0.0
{0}
1.0
}}
"""


class Update(ProgramTest):
    def map_u(self, *more, command="map", cage=CAGE, exemplar=EXEMPLAR,
              name="a.obj", **keywords):
        result = self.run_program(
            command, cage, exemplar, "-o", self.folder / name, *QUICK, "-u",
            *more, **keywords)
        self.assert_exit(result, 0)
        return "is up to date" not in result.stderr

    def job(self, name="a.obj"):
        return re.search(
            "^# osdtex job ([0-9a-f]{32})",
            (self.folder / name).read_text(), re.M).group(1)

    def test_every_flag_counts(self):
        """The table of the flags is walked: a new one is part of the job, or
        is named here as one that is not."""
        for command in "map", "bake":
            usage = self.run_program(command, "--help").stdout
            flags = set(re.findall(r"^ +(?:-\w, )?--([a-z-]+)", usage, re.M))
            self.assertGreater(len(flags), 30)
            for flag in flags - APART:
                with self.subTest(flag):
                    self.assertIn(
                        flag, CHANGED,
                        "a new flag: say here what another value of it is, or "
                        "that the result does not depend on it")

    def test_flags_that_change_the_result(self):
        self.assertTrue(self.map_u())
        seen = {self.job()}
        for more in (("--seed", "2"), ("--tileable", "make"),
                     ("--scheme", "bilinear"), ("--follow", "up"),
                     ("--set", "relax=off"), ("--wrap", "no")):
            with self.subTest(more):
                self.assertTrue(self.map_u(*more))
                self.assertNotIn(self.job(), seen)
                seen.add(self.job())
                self.assertFalse(self.map_u(*more))
        for more in (("--threads", "2"), ("-v",), ("--memory-limit", "4G"),
                     ("--replace",)):
            with self.subTest(more):
                self.assertFalse(self.map_u("--wrap", "no", *more))

    def test_what_is_asked_for_besides(self):
        self.assertTrue(self.map_u())
        for flag, name, *more in (
                ("--json-report", "r.json"), ("--preview", "v.png", *SMALL)):
            words = (flag, self.folder / name, *more)
            self.assertTrue(self.map_u(*words))
            self.assertFalse(self.map_u(*words))
            (self.folder / name).write_bytes(
                (self.folder / name).read_bytes()[:-20])
            self.assertTrue(self.map_u(*words))

    def damage(self, path, again, ways):
        """Whatever is wrong with an output, it is made again as it was."""
        whole = path.read_bytes()
        middle = len(whole) // 2
        for how, data in [w for w in (
                ("empty", b""), ("other", b"corrupt\n"),
                ("short", whole[:-1]), ("half", whole[:middle]),
                ("long", whole + b"\n"),
                ("changed", whole[:middle] + bytes([whole[middle] ^ 1]) +
                 whole[middle + 1:])) if w[0] in ways]:
            with self.subTest(file=path.name, how=how):
                path.write_bytes(data)
                self.assertTrue(again())
                if path.suffix != ".json":
                    self.assertEqual(path.read_bytes(), whole)
                self.assertFalse(again())

    def test_outputs_are_whole(self):
        def again():
            return self.map_u()
        self.assertTrue(again())
        for name, ways in (("a.obj", ("other", "short")), ("a.mtl", ("empty",)),
                           ("a.exr", ("other", "long", "changed"))):
            self.damage(self.folder / name, again, ways)

    def test_outputs_of_a_bake_are_whole(self):
        def again():
            return self.map_u(
                "--resolution", "32", "--preview-png", command="bake")
        self.assertTrue(again())
        for name in ("a_cage.obj", "a.1001.exr", "a.1001.png", "a.usda",
                     "a.mtlx"):
            path = self.folder / name
            whole = path.read_bytes()
            path.write_bytes(whole[:-3])
            self.assertTrue(again(), name)
            self.assertEqual(path.read_bytes(), whole)
            self.assertFalse(again(), name)

    def test_a_tile_is_whole(self):
        def again():
            return self.map_u(
                "--resolution", "32", "--udim", "1001", command="bake")
        self.assertTrue(again())
        self.assertFalse(again())
        self.damage(self.folder / "a.1001.exr", again, ("half", "changed"))

    def test_marks_leave_files_valid(self):
        """A PNG's checksums are right after the seal is set."""
        self.map_u("--preview", self.folder / "a.png", *SMALL)
        data = (self.folder / "a.png").read_bytes()
        at, kinds = 8, []
        while at < len(data):
            length, kind = struct.unpack(">I4s", data[at:at + 8])
            body = data[at + 4:at + 8 + length]
            self.assertEqual(
                struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0],
                zlib.crc32(body))
            kinds.append(kind)
            at += 12 + length
        self.assertIn(b"tEXt", kinds)
        self.assertEqual(kinds[-1], b"IEND")

    def test_bytes_of_every_input(self):
        for name, source in (("c.obj", CAGE), ("e.png", EXEMPLAR),
                             ("b.png", EXEMPLARS / "pebbles_tile.png")):
            shutil.copy(source, self.folder / name)
        (self.folder / "k.json").write_text(
            '{"constraints": [{"face": 0, "scale": 1}]}')
        shutil.copy(EXEMPLARS / "gravel_tile.png", self.folder / "m.1001.png")

        def again():
            return self.map_u(
                "--also", "b.png", "--mask", "m.<UDIM>.png", "--constraints",
                "k.json", cage="c.obj", exemplar="e.png", cwd=self.folder)
        self.assertTrue(again())
        self.assertFalse(again())
        for name, change in (
                ("c.obj", lambda b: b + b"# more\n"),
                ("e.png", lambda b: (EXEMPLARS / "grass_tile.png").read_bytes()),
                ("b.png", lambda b: (EXEMPLARS / "grass_tile.png").read_bytes()),
                ("k.json", lambda b: b.replace(b": 1", b": 1.5")),
                ("m.1001.png",
                 lambda b: (EXEMPLARS / "pebbles_tile.png").read_bytes())):
            with self.subTest(name):
                path = self.folder / name
                path.write_bytes(change(path.read_bytes()))
                self.assertTrue(again())
                os.utime(path, (1, 1))
                self.assertFalse(again())

    def test_what_a_configuration_resolves_to(self):
        reports = SHARED / "reports"
        if not reports.is_dir():
            self.skipTest("../shared/data/reports is not there")
        for name in ("context.ocio", "context_job.json", "cube.obj",
                     "base.png"):
            shutil.copy(reports / name, self.folder / name)
        shutil.copytree(reports / "luts", self.folder / "luts")
        os.chmod(self.folder / "luts", 0o755)
        for path in (self.folder / "luts").iterdir():
            path.chmod(0o644)
        (self.folder / "out").mkdir()

        def again(shot=None):
            result = self.run_program(
                "run", self.folder / "context_job.json", "--task", "0",
                environment={"SHOT": shot} if shot else None)
            self.assert_exit(result, 0)
            return "is up to date" not in result.stderr
        self.assertTrue(again("sh010"))
        first = (self.folder / "out" / "context.exr").read_bytes()
        self.assertFalse(again("sh010"))
        self.assertTrue(again("sh020"))
        self.assertNotEqual(
            (self.folder / "out" / "context.exr").read_bytes(), first)
        self.assertTrue(again("sh010"))
        self.assertEqual(
            (self.folder / "out" / "context.exr").read_bytes(), first)
        # The shot that the configuration states is the same context.
        self.assertFalse(again())
        lut = self.folder / "luts" / "sh010.spi1d"
        os.utime(lut, (1, 1))
        self.assertFalse(again("sh010"))
        lut.write_bytes((self.folder / "luts" / "sh020.spi1d").read_bytes())
        self.assertTrue(again("sh010"))
        self.assertFalse(again("sh010"))

    def test_what_a_table_refers_to(self):
        """A CTF may be made of other tables."""
        luts = self.folder / "luts"
        luts.mkdir()
        (self.folder / "c.ocio").write_text(CONFIGURATION)
        (luts / "outer.ctf").write_text(
            '<?xml version="1.0" encoding="UTF-8"?>\n'
            '<ProcessList id="1" version="1.3">\n'
            '<Reference path="inner.spi1d" inBitDepth="32f"'
            ' outBitDepth="32f"/>\n</ProcessList>\n')
        (luts / "inner.spi1d").write_text(TABLE.format(0.5))
        more = ("--colorconfig", self.folder / "c.ocio", "--from", "graded")
        self.assertTrue(self.map_u(*more))
        self.assertFalse(self.map_u(*more))
        (luts / "inner.spi1d").write_text(TABLE.format(0.25))
        self.assertTrue(self.map_u(*more))
        self.assertFalse(self.map_u(*more))
        self.assert_error(self.run_program(
            "map", CAGE, EXEMPLAR, *QUICK, *more, "-o",
            self.folder / "b.obj", "--json-report", luts / "inner.spi1d"), 1,
            "is an input")

    def test_a_configuration_that_a_name_stands_for(self):
        more = ("--colorconfig", "ocio://default")
        self.assertTrue(self.map_u(*more))
        self.assertFalse(self.map_u(*more))
        self.assertTrue(self.map_u())

    # ---- other jobs -------------------------------------------------------

    def test_another_job_is_not_replaced(self):
        self.assertTrue(self.map_u())
        before = {p.name: p.read_bytes() for p in self.folder.iterdir()}
        cage = CAGES / "jack.obj"
        words = ("map", cage, EXEMPLAR, *QUICK, "-o", self.folder / "a.obj")
        self.assert_error(
            self.run_program(*words), 1,
            "belongs to another job: it was made from plane.obj")
        # By a texture alone, too.
        for name in "a.obj", "a.mtl":
            (self.folder / name).rename(self.folder / f"kept.{name}")
        self.assert_error(self.run_program(*words), 1, "a.exr")
        self.assert_error(
            self.run_program(
                "tiles", EXEMPLAR, "-o", self.folder / "a.exr"), 1,
            "belongs to another job")
        self.assert_error(
            self.run_program(
                "render", cage, "-o", self.folder / "a.exr", "--size", "8x8"),
            1, "belongs to another job")
        for name in "a.obj", "a.mtl":
            (self.folder / f"kept.{name}").rename(self.folder / name)
        self.assertEqual(
            {p.name: p.read_bytes() for p in self.folder.iterdir()}, before)
        # A changed job of the same cage goes on, and so does who means it.
        self.assertTrue(self.map_u("--seed", "3"))
        self.assertTrue(
            self.map_u(exemplar=EXEMPLARS / "pebbles_tile.png"))
        self.assert_exit(self.run_program(*words, "--replace"), 0)
        self.assert_error(self.run_program(
            "map", CAGE, EXEMPLAR, *QUICK, "-o", self.folder / "a.obj"), 1,
            "made from jack.obj")

    def test_files_of_others_are_not_replaced(self):
        for name in "a.mtl", "a.exr", "a.obj":
            path = self.folder / name
            path.write_text("by hand")
            result = self.run_program(
                "map", CAGE, EXEMPLAR, *QUICK, "-o", self.folder / "a.obj")
            self.assert_error(result, 1, "was not made by osdtex")
            self.assertEqual(path.read_text(), "by hand")
            path.unlink()
            path.write_text("")
            self.assertTrue(self.map_u())
            for p in self.folder.iterdir():
                p.unlink()
        # What is named in full is what is asked for.
        picture = self.folder / "v.png"
        picture.write_text("old")
        self.assert_exit(self.run_program(
            "render", CAGE, "-o", picture, "--size", "8x8", "-q"), 0)
        self.assertTrue(picture.read_bytes().startswith(b"\x89PNG"))

    def test_files_beside_a_bake_that_it_does_not_write(self):
        """Textures of others count where the bake has one of their name."""
        words = ("bake", CAGE, EXEMPLAR, *QUICK, "--resolution", "64", "-o",
                 self.folder / "a.obj", "-n")

        def code(name, *more):
            path = self.folder / name
            path.write_text("by hand")
            result = self.run_program(*words, *more)
            path.unlink()
            return result.returncode

        self.assertEqual(code("a_uv.1001.png"), 0)
        self.assertEqual(code("a_uv.1001.exr"), 0)
        self.assertEqual(code("a_uv.1001.exr", "--extra", "uv"), 1)
        self.assertEqual(code("a_uv.1001.exr", "--extra", "seam"), 0)
        self.assertEqual(code("a.1001.exr"), 1)
        self.assertEqual(code("a.1002.exr", "--udim", "1001"), 0)
        self.assertEqual(code("a.1001.png"), 0)
        self.assertEqual(code("a.1001.png", "--preview-png"), 1)
        self.assertEqual(code("a.1001.png", "--for", "web"), 1)
        self.assertEqual(code("a.1001.exr", "--for", "web"), 0)


if __name__ == "__main__":
    main()
