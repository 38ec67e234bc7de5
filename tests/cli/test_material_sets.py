#!/usr/bin/env python3
"""Materials: layers of one EXR, what the match looks at, which way normals
point, and that every method carries all maps along.

    test_material_sets.py OSDTEX
"""

import re
import subprocess
import sys
import unittest

from program import CAGES, ROOT, ProgramTest, main

CAGE = CAGES / "torus.obj"
WAVES = ROOT / "models" / "materials" / "waves"
KINDS = "normal", "roughness", "height", "metalness", "occlusion"
BAKE = "--level", "1", "--uvs", "atlas", "--resolution", "128"


class Sets(ProgramTest):
    def bake(self, *more, name="a.obj", cage=CAGE):
        result = self.run_program(
            "bake", cage, *BAKE, *more, "-o", self.folder / name)
        self.assert_exit(result, 0)
        return result.stderr

    def same(self, a, b, kinds=("",) + tuple("_" + k for k in KINDS)):
        for kind in kinds:
            self.assertEqual(
                self.picture(f"{a}{kind}.1001.exr"),
                self.picture(f"{b}{kind}.1001.exr"), kind)

    def layered(self):
        """The set as one EXR: colours plain, parts and layers beside them."""
        self.need("oiiotool")
        path = self.folder / "waves.exr"
        arguments = ["oiiotool", WAVES / "waves_color.png", "--colorconvert",
                     "sRGB", "linear"]
        for kind in KINDS:
            arguments += [
                WAVES / f"waves_{'normal_gl' if kind == 'normal' else kind}.png",
                "--ch", "0,1,2" if kind == "normal" else "0", "--chnames",
                "normal.X,normal.Y,normal.Z" if kind == "normal" else kind,
                "--chappend"]
        subprocess.run([*map(str, arguments), "-d", "float", "-o", str(path)],
                       check=True, capture_output=True)
        return path

    def test_layers_of_an_exr(self):
        path = self.layered()
        said = self.bake("--material", path)
        for kind in KINDS:
            self.assertRegex(said, rf"{kind} map, [^;]*, layer {kind}")
        saved = self.folder / "m.osdtex"
        self.bake("--material", path, "--save", saved, name="b.obj")
        result = self.run_program(
            "bake", "--from", saved, "-o", self.folder / "c.obj", *BAKE[2:])
        self.assert_exit(result, 0)
        self.same("a", "b")
        self.same("a", "c")

    def test_the_match_sees_maps(self):
        self.bake("--material", WAVES, "--extra", "uv")
        said = self.bake("--material", WAVES, "--extra", "uv", "--match-maps",
                         "color,height=.5", name="b.obj")
        self.assertIn("the match looks at color (1), height (0.5)", said)
        self.assertNotEqual(self.picture("a_uv.1001.exr"),
                            self.picture("b_uv.1001.exr"))
        self.bake("--material", WAVES, "--extra", "uv", "--match-maps",
                  "color=3", name="c.obj")
        self.same("a", "c", ("_uv", "_height"))
        for text, words in (("height", "has none"), ("depth", "takes names"),
                            ("color=-1", "takes names")):
            result = self.run_program(
                "bake", CAGE, WAVES / "waves_color.png", "--match-maps", text,
                "-o", self.folder / "d.obj", *BAKE)
            self.assertNotEqual(result.returncode, 0)
            self.assertIn(words, result.stderr)
        result = self.run_program(
            "bake", CAGES / "materials_and_groups.obj", "--material", WAVES,
            "--match-maps", "color,height", "--also",
            f"{self.material()}={WAVES}", "-o", self.folder / "e.obj", *BAKE)
        self.assert_error(result, 1, "leave --match-maps away")

    @staticmethod
    def material():
        text = (CAGES / "materials_and_groups.obj").read_text()
        return re.findall(r"^usemtl (\S+)", text, re.M)[0]

    def test_normals_that_point_down(self):
        """Green is turned over, and USD and MaterialX turn it back."""
        self.need("oiiotool")
        self.bake("--material", WAVES)
        said = self.bake("--material", WAVES, "--normal-y", "down", name="b.obj")
        self.assertEqual(said.count("an MTL cannot say so"), 1)
        self.same("a", "b", ("", "_height"))
        result = subprocess.run(
            ["oiiotool", str(self.folder / "a_normal.1001.exr"), "--mulc",
             "1,-1,1", "--addc", "0,1,0",
             str(self.folder / "b_normal.1001.exr"), "--fail", ".001",
             "--diff"], capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stdout)
        usda = (self.folder / "b.usda").read_text()
        self.assertIn("inputs:scale = (2, -2, 2, 1)", usda)
        self.assertIn("inputs:bias = (-1, 1, -1, 0)", usda)
        self.assertIn('value="1, -1, 1"', (self.folder / "b.mtlx").read_text())
        result = self.run_program(
            "bake", CAGE, "--material", WAVES, "--normal-y", "left", "-o",
            self.folder / "c.obj", *BAKE)
        self.assert_error(result, 1, "--normal-y takes up")

    def test_every_method_carries_them(self):
        """The maps are those that a bake of the colour's places shows: the
        picture itself, given as a map, comes out where the colour does."""
        self.need("oiiotool")
        red = self.folder / "red.exr"
        subprocess.run(
            ["oiiotool", WAVES / "waves_color.png", "--colorconvert", "sRGB",
             "linear", "--ch", "0", "-d", "float", "-o", red], check=True)
        for name, more in (
                ("hierarchical", ()), ("none", ("--scheme", "none")),
                ("make", ("--tileable", "make", "--wrap", "no")),
                ("material", ("--method", "material"))):
            with self.subTest(name):
                level = "0" if name == "none" else "1"
                self.bake(WAVES / "waves_color.png", "--map",
                          f"roughness={red}", *more, "--level", level,
                          name=f"{name}.obj")
                self.colour = self.folder / f"{name}.1001.exr"
                mean, spread = self.statistics(
                    self.folder / f"{name}_roughness.1001.exr", "--selectmip",
                    "0", "--sub")
                _, own = self.statistics()
                # Colours are sharpened where they are made small; maps not.
                # Another place would be off by 1.4 of the spread.
                self.assertLess(abs(mean), 0.003)
                self.assertLess(spread, 0.35 * own)

    def test_tiles_of_a_set(self):
        """The colour's tiles are those without maps, and each map is mapped
        from its own."""
        small = "--tile-size", "32", "--corners", "1"
        for name, more in (("t", ("--material", WAVES)),
                           ("u", (WAVES / "waves_color.png",))):
            result = self.run_program(
                "tiles", *more, "-o", self.folder / f"{name}.exr", *small)
            self.assert_exit(result, 0)
        self.assertEqual(self.picture("t.exr"), self.picture("u.exr"))
        maps = ",".join(f"{k}={self.folder}/t_{k}.exr" for k in KINDS)
        said = self.bake(self.folder / "t.exr", "--map", maps, "--method",
                         "tile")
        self.assertIn("height map", said)
        for kind in KINDS:
            self.assertTrue(
                (self.folder / f"a_{kind}.1001.exr").exists(), kind)
        result = self.run_program(
            "tiles", "--material", WAVES, "-o", self.folder / "v.exr",
            "--blend", "ramp", *small)
        self.assert_error(result, 1, "cross-faded")
        (self.folder / "x_height.exr").write_bytes(
            (self.folder / "t_height.exr").read_bytes())
        result = self.run_program(
            "tiles", WAVES / "waves_color.png", "--map",
            f"height={self.folder}/x_height.exr", "-o", self.folder / "x.exr",
            *small)
        self.assert_error(result, 1, "is an input and would be replaced")

    def statistics(self, *more):
        """Mean and spread of the red of the last colour, or what is left."""
        said = subprocess.run(
            ["oiiotool", self.colour, "--selectmip", "0", "--ch", "R",
             "--chnames", "Y", *more, "--printstats"], capture_output=True,
            text=True, check=True).stdout
        return [float(re.search(rf"{word}: (\S+)", said).group(1))
                for word in ("Avg", "StdDev")]


if __name__ == "__main__":
    main()
