#!/usr/bin/env python3
"""--for: what is written for the program that will read it."""

import unittest

from program import CAGES, EXEMPLARS, SHARED, ProgramTest, main

PLANE = CAGES / "plane.obj"
GRASS = EXEMPLARS / "grass_tile.png"
QUICK = ("--level", "1", "--scale", "2", "--set", "angles=4")
STUDIO = SHARED / "ocio" / "cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio"
REC709 = "Linear Rec.709 (sRGB)"


class Receivers(ProgramTest):
    def texture(self, name):
        return (self.folder / name).read_bytes()

    def geometry(self, name):
        lines = (self.folder / name).read_text().splitlines()
        return [l for l in lines if l.split(" ")[0] in ("v", "vt", "f")]

    def test_the_header_names_the_space(self):
        for receiver, space in (
                (None, b"lin_rec709_scene"), ("blender", b"lin_rec709_scene"),
                ("maya", b"lin_ap1_scene"), ("houdini", b"lin_rec709_scene"),
                ("usd", b"lin_rec709_scene")):
            more = ("--for", receiver) if receiver else ()
            done = self.run_map(PLANE, GRASS, *QUICK, *more)
            self.assert_exit(done, 0)
            self.assertIn(space, self.texture("out.exr"), receiver)
            says = [l for l in done.stderr.splitlines() if "output space" in l]
            self.assertEqual(len(says), 1, done.stderr)
            if receiver:
                self.assertIn(f"--for {receiver}", says[0])

    def test_the_mapping_is_the_same_for_all(self):
        self.assert_exit(self.run_map(PLANE, GRASS, *QUICK), 0)
        usual = self.geometry("out.obj")
        for more in (("--for", "web"), ("--for", "maya"), ("--to", "Raw"),
                     ("--to", "ACES2065-1")):
            self.assert_exit(self.run_map(PLANE, GRASS, *QUICK, *more), 0)
            self.assertEqual(self.geometry("out.obj"), usual, more)

    def test_the_web_gets_png(self):
        done = self.run_map(
            PLANE, GRASS, *QUICK, "--for", "web", "--bake", "--resolution",
            "64", "--uvs", "atlas", "--preview-png")
        self.assert_exit(done, 0)
        for name in ("out.png", "out.1001.png"):
            self.assertTrue(self.texture(name).startswith(b"\x89PNG"))
            self.assertIn(b"sRGB", self.texture(name)[:64])
        self.assertFalse(list(self.folder.glob("*.exr")))
        self.assertIn("map_Kd out.png\n", (self.folder / "out.mtl").read_text())
        self.assertIn("map_Kd out.1001.png\n",
                      (self.folder / "out_cage.mtl").read_text())
        self.assertIn('colorspace="srgb_texture"',
                      (self.folder / "out.mtlx").read_text())
        self.assertIn('sourceColorSpace = "sRGB"',
                      (self.folder / "out.usda").read_text())
        self.assertIn("colour: ", self.run_program(
            "info", self.folder / "out.png").stderr)

    def test_what_is_up_to_date_is_seen(self):
        words = (*QUICK, "--for", "web", "--bake", "--resolution", "64",
                 "--uvs", "atlas", "-u")
        self.assert_exit(self.run_map(PLANE, GRASS, *words), 0)
        self.assertIn("up to date", self.run_map(PLANE, GRASS, *words).stderr)
        (self.folder / "out.1001.png").unlink()
        self.assertNotIn(
            "up to date", self.run_map(PLANE, GRASS, *words).stderr)

    def test_to_wins(self):
        done = self.run_map(
            PLANE, GRASS, *QUICK, "--for", "web", "--to", "ACEScg")
        self.assert_exit(done, 0)
        self.assertIn(b"lin_ap1_scene", self.texture("out.exr"))

    def test_others_are_refused(self):
        for word in ("unreal", "", "any"):
            self.assert_error(
                self.run_map(PLANE, GRASS, "--for", word), 1,
                "--for takes blender|maya|houdini|usd|web")
        self.assert_nothing_written()

    @unittest.skipUnless(STUDIO.exists(), "../shared is not here")
    def test_a_studio_has_its_scene_linear(self):
        done = self.run_map(
            PLANE, GRASS, *QUICK, environment={"OCIO": str(STUDIO)})
        self.assert_exit(done, 0)
        self.assertIn("'ACEScg' (role scene_linear); tell it to readers",
                      done.stderr)
        done = self.run_map(
            PLANE, GRASS, *QUICK, "--colorconfig", STUDIO, "--for", "usd")
        self.assertIn(f"'{REC709}' (--for usd)", done.stderr)


main()
