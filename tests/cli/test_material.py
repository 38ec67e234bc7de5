#!/usr/bin/env python3
"""Materials: which files are a set, what is written of it, and what is refused.

    test_material.py OSDTEX
"""

import json
import shutil
import struct
import sys
import unittest
import zlib

from program import CAGES, EXEMPLARS, ProgramTest, main

CAGE = CAGES / "torus.obj"
KINDS = "normal", "roughness", "height", "metalness", "occlusion"
QUICK = "--level", "1"
BAKE = "--uvs", "atlas", "--resolution", "128"


def write_png(path, texel, side=256, bits=8):
    """A picture of one colour: bytes of a texel."""
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(
            ">I", zlib.crc32(body))
    kind = {1: 0, 3: 2}[len(texel) * 8 // bits]
    rows = (b"\0" + bytes(texel) * side) * side
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" +
        chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, bits, kind, 0, 0, 0))
        + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class Material(ProgramTest):
    def setUp(self):
        super().setUp()
        self.set = self.folder / "set"
        self.set.mkdir()
        self.color = self.set / "Peb_1K_Color.png"
        shutil.copy(EXEMPLARS / "pebbles_tile.png", self.color)
        write_png(self.set / "Peb_1K_NormalGL.png", (128, 128, 255))
        write_png(self.set / "Peb_1K_arm.png", (255, 100, 0), side=128)
        write_png(self.set / "Peb_1K_disp.png", (1, 0), side=512, bits=16)

    def bake(self, *more, command="bake", name="a.obj"):
        return self.run_program(
            command, CAGE, *more, "-o", self.folder / name, *QUICK,
            *(BAKE if command == "bake" else ()))

    def test_a_bake_of_a_set(self):
        result = self.bake(
            "--material", self.set, "--json-report", self.folder / "a.json")
        self.assert_exit(result, 0)
        self.assertIn("height map, 512 x 512, 16-bit, data", result.stderr)
        self.assertIn("roughness map, 128 x 128, 8-bit, data, from green",
                      result.stderr)
        for kind in KINDS:
            self.assertTrue((self.folder / f"a_{kind}.1001.exr").exists(), kind)
        maps = json.loads((self.folder / "a.json").read_text())[
            "inputs"]["exemplar"]["maps"]
        self.assertEqual(set(maps), set(KINDS))
        self.assertEqual(maps["normal"]["y"], "up")
        self.assertEqual(maps["metalness"]["channel"], 2)
        # The colour is what it is without the set.
        self.assert_exit(self.bake(self.color, name="b.obj"), 0)
        self.assertEqual(
            self.picture("a.1001.exr")[-20000:],
            self.picture("b.1001.exr")[-20000:])

    def test_where_heights_may_open_is_said(self):
        for cage, words in (("torus", None),
                            ("ngons_and_triangles", "have more than four corners")):
            result = self.run_program(
                "bake", CAGES / f"{cage}.obj", "--material", self.set, "-o",
                self.folder / f"{cage}.obj", "--level", "0", "--uvs", "atlas",
                "--resolution", "64")
            self.assert_exit(result, 0)
            if words:
                self.assertIn(words, result.stderr)
            else:
                self.assertNotIn("may open there", result.stderr)

    def test_map_writes_them_beside(self):
        result = self.bake(
            self.color, "--map", f"normal={self.set}/Peb_1K_NormalGL.png",
            command="map")
        self.assert_exit(result, 0)
        self.assertTrue((self.folder / "a_normal.exr").exists())
        self.assertFalse((self.folder / "a_height.exr").exists())

    def test_a_saved_mapping_has_its_maps(self):
        """It bakes all of them again, or without them another picture."""
        saved = self.folder / "m.osdtex"
        self.assert_exit(
            self.bake("--material", self.set, "--save", saved), 0)
        result = self.run_program(
            "bake", "--from", saved, "-o", self.folder / "b.obj", *BAKE)
        self.assert_exit(result, 0)
        for kind in KINDS:
            self.assertEqual(
                self.picture(f"a_{kind}.1001.exr"),
                self.picture(f"b_{kind}.1001.exr"), kind)
        result = self.run_program(
            "bake", "--from", saved, CAGE, EXEMPLARS / "gravel_tile.png", "-o",
            self.folder / "c.obj", *BAKE)
        self.assert_exit(result, 0)
        self.assertFalse((self.folder / "c_normal.1001.exr").exists())

    def test_update_and_guard(self):
        def again(*more):
            result = self.bake("--material", self.set, "-u", *more)
            self.assert_exit(result, 0)
            return "is up to date" not in result.stderr
        self.assertTrue(again())
        self.assertFalse(again())
        write_png(self.set / "Peb_1K_arm.png", (255, 101, 0), side=128)
        self.assertTrue(again())
        self.assertFalse(again())
        (self.folder / "a_height.1001.exr").unlink()
        self.assertTrue(again())
        self.assertTrue(again("--height-range", "2"))
        # A map is an input like any other.
        shutil.copy(self.set / "Peb_1K_NormalGL.png",
                    self.folder / "n_normal.exr")
        result = self.bake(
            self.color, "--map", f"normal={self.folder}/n_normal.exr",
            command="map", name="n.obj")
        self.assert_exit(result, 1)
        self.assertIn("is an input and would be replaced", result.stderr)

    def test_its_own_folder(self):
        """What was written beside the maps is none of them."""
        for more in (), ("-u",):
            result = self.run_program(
                "map", CAGE, "--material", self.set, "-o",
                self.set / "Peb.obj", *QUICK, *more)
            self.assert_exit(result, 0)
        self.assertIn("is up to date", result.stderr)
        self.assertTrue((self.set / "Peb_normal.exr").exists())
        # Where there is nothing else, it is.
        alone = self.folder / "alone"
        alone.mkdir()
        (self.set / "Peb.exr").rename(alone / "Peb_color.exr")
        (self.set / "Peb_normal.exr").rename(alone / "Peb_normal.exr")
        result = self.bake("--material", alone)
        self.assert_exit(result, 0)
        self.assertTrue((self.folder / "a_normal.1001.exr").exists())

    def test_heights_stay_finite(self):
        """They are refused before work, or told."""
        for flag in "range", "middle":
            self.refuse(1, "up to 1e+15, not 1e+300", "--material", self.set,
                        f"--height-{flag}", "1e300")
        result = self.bake("--material", self.set, "--height-range", "1e9",
                           "-n")
        self.assert_exit(result, 0)
        self.assertIn("wrong units? The heights reach", result.stderr)

    def refuse(self, code, words, *more):
        result = self.bake(*more)
        self.assert_exit(result, code)
        self.assertEqual(
            len([l for l in result.stderr.splitlines() if "error" in l]), 1)
        self.assertIn(words, result.stderr)
        self.assertFalse((self.folder / "a_cage.obj").exists())

    def test_refusals(self):
        self.refuse(2, "no picture of that name", "--material",
                    self.folder / "none")
        self.refuse(2, "could both be the same map", "--material",
                    self.twice())
        (self.set / "Peb_1K_disp.exr").unlink()
        self.refuse(2, "no whole number", self.color, "--map",
                    f"height={self.odd()}")
        self.refuse(2, "is it a height", self.color, "--map",
                    f"normal={self.set}/Peb_1K_disp.png")
        self.refuse(1, "--map takes KIND=FILE", self.color, "--map", "x=y")
        self.refuse(1, "--map names two files for the normal map", self.color,
                    "--map", "normal=a.png,normal-dx=b.png")
        self.refuse(1, "--height-range", self.color, "--height-range", "-1")
        self.color.unlink()
        self.refuse(2, "as the colour of a material is", "--material",
                    self.set)

    def test_cuts_are_those_of_the_colour(self):
        """Made to tile: the same patches."""
        for name, more in (
                ("a", ("--material", self.set)),
                ("b", (self.color,))):
            result = self.bake(
                *more, "--tileable", "make", "--wrap", "no", "--extra",
                "patch,uv", name=f"{name}.obj")
            self.assert_exit(result, 0)
        for kind in "patch", "uv":
            self.assertEqual(
                self.picture(f"a_{kind}.1001.exr"),
                self.picture(f"b_{kind}.1001.exr"))

    def test_several(self):
        """A material for each exemplar; what one lacks is neutral there."""
        cage = self.folder / "two.obj"
        cage.write_text(
            "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n"
            "usemtl A\nf 1 2 5 4\nusemtl B\nf 2 3 6 5\n")
        other = self.folder / "other"
        other.mkdir()
        shutil.copy(EXEMPLARS / "gravel_tile.png", other / "G_Color.png")
        write_png(other / "G_Roughness.png", (10,))
        result = self.run_program(
            "map", cage, "--material", self.set, "--also", f"B={other}",
            "--level", "3", "-o", self.folder / "t.obj", "--bake", *BAKE)
        self.assert_exit(result, 0)
        for name in ("t_1_normal", "t_2_roughness", "t_normal.1001",
                     "t_roughness.1001", "t_height.1001"):
            self.assertTrue((self.folder / f"{name}.exr").exists(), name)
        self.assertFalse((self.folder / "t_2_normal.exr").exists())
        # The maps that only the other one has are outputs, too.
        (self.folder / "u_roughness.1001.exr").write_bytes(b"precious")
        (self.set / "Peb_1K_arm.png").unlink()
        result = self.run_program(
            "bake", cage, "--material", self.set, "--also", f"B={other}",
            "--level", "1", "-o", self.folder / "u.obj", *BAKE)
        self.assert_error(result, 1, "was not made by osdtex")

    def twice(self):
        write_png(self.set / "Peb_1K_disp.exr", (1,))
        return self.set

    def odd(self):
        path = self.folder / "odd.png"
        write_png(path, (1,), side=100)
        return path


if __name__ == "__main__":
    main()
