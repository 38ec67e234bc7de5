#!/usr/bin/env python3
"""-o NAME.png, NAME.tif and NAME.jpg: which files textures are."""

import json
import re
import shutil

from program import CAGES, EXEMPLARS, ROOT, ProgramTest, main

PLANE = CAGES / "plane.obj"
GRASS = EXEMPLARS / "grass_tile.png"
QUICK = ("--level", "1", "--scale", "2", "--set", "angles=4")
BAKE = (*QUICK, "--resolution", "64", "--uvs", "atlas")
HEADS = {"png": b"\x89PNG", "tif": b"II*\0", "jpg": b"\xff\xd8\xff"}


class TextureTypes(ProgramTest):
    def run_bake(self, suffix, *more, exemplar=(GRASS,)):
        return self.run_program(
            "bake", PLANE, *exemplar, "-o", self.folder / f"out.{suffix}",
            *BAKE, *more)

    def names(self):
        return {p.name for p in self.folder.iterdir()}

    def pixels(self, name):
        from PIL import Image
        import numpy
        return numpy.asarray(Image.open(self.folder / name)).astype(float)

    def test_the_suffix_says_which(self):
        for suffix, head in HEADS.items():
            self.assert_exit(self.run_bake(suffix), 0)
            texture = (self.folder / f"out.1001.{suffix}").read_bytes()
            self.assertTrue(texture.startswith(head), suffix)
            self.assertIn(
                f"map_Kd out.1001.{suffix}\n",
                (self.folder / "out_cage.mtl").read_text())
            self.assertIn('sourceColorSpace = "sRGB"',
                          (self.folder / "out.usda").read_text())
            self.assertFalse(list(self.folder.glob("*.exr")))
            self.assert_exit(self.run_map(
                PLANE, GRASS, *QUICK, name=f"out.{suffix}"), 0)
            self.assertIn(f"map_Kd out.{suffix}\n",
                          (self.folder / "out.mtl").read_text())
            for each in list(self.folder.iterdir()):
                each.unlink()

    def test_the_same_bytes_for_any_threads(self):
        kept = {}
        for threads in (1, 2):
            for suffix in HEADS:
                self.assert_exit(
                    self.run_bake(suffix, "--threads", threads, "--replace"), 0)
                texture = self.folder / f"out.1001.{suffix}"
                self.assertEqual(
                    kept.setdefault(suffix, texture.read_bytes()),
                    texture.read_bytes(), suffix)

    def test_colours_agree(self):
        """Within what each file can hold, and JPEG with what it loses."""
        self.need(modules=("PIL", "numpy"))
        for suffix in ("png", "jpg"):
            self.assert_exit(self.run_bake(suffix, "--replace"), 0)
        png, jpg = self.pixels("out.1001.png"), self.pixels("out.1001.jpg")
        self.assertLess(abs(png - jpg).mean(), 4.0)
        self.assertGreater(png.std(), 10.0)

    def test_up_to_date_knows_the_suffix(self):
        self.assert_exit(self.run_bake("png"), 0)
        self.assertIn("up to date", self.run_bake("png", "-u").stderr)
        self.assertNotIn("up to date", self.run_bake("tif", "-u").stderr)
        # The texts now speak of TIFF.
        self.assertNotIn("up to date", self.run_bake("png", "-u").stderr)

    def test_maps_have_what_they_need(self):
        material = ROOT / "models" / "materials"
        prefix = sorted(p for p in material.iterdir() if p.is_dir())[0]
        folder = shutil.copytree(prefix, self.folder / "set")
        wanted = {"png": ("png", "exr"), "tif": ("tif", "tif"),
                  "jpg": ("png", "exr")}
        for suffix, (maps, heights) in wanted.items():
            done = self.run_program(
                "bake", PLANE, "--material", folder, "-o",
                self.folder / f"m_{suffix}.{suffix}", *BAKE)
            self.assert_exit(done, 0)
            stem = f"m_{suffix}"
            names = {n for n in self.names() if n.startswith(stem)}
            found = {re.match(rf"{stem}_([a-z]+)\.1001", n).group(1): n
                     for n in names if re.match(rf"{stem}_[a-z]+\.1001", n)}
            self.assertIn("normal", found)
            for kind, name in found.items():
                end = heights if kind == "height" else maps
                self.assertTrue(name.endswith("." + end), name)
                self.assertIn(name, (self.folder / f"{stem}.usda").read_text())
            head = (self.folder / found["normal"]).read_bytes()
            if maps == "png":
                self.assertEqual(head[24], 16)
                self.assertNotIn(b"sRGB", head[:64])

    def test_a_saved_mapping_is_baked_as_any(self):
        saved = self.folder / "a.osdtex"
        self.assert_exit(
            self.run_map(PLANE, GRASS, *QUICK, "--save", saved), 0)
        done = self.run_program(
            "bake", "--from", saved, "-o", self.folder / "b.tif",
            "--resolution", "64", "--uvs", "atlas", "--json-report",
            self.folder / "b.json")
        self.assert_exit(done, 0)
        self.assertIn("b.1001.tif", self.names())
        outputs = json.loads((self.folder / "b.json").read_text())["outputs"]
        self.assertTrue(
            any(o["path"].endswith("b.1001.tif") for o in outputs))

    def test_what_cannot_be_is_refused(self):
        self.assert_error(
            self.run_bake("png", "--to", "ACEScg"), 1, "leave it out")
        self.assert_error(self.run_bake("tga"), 1, "NAME.obj")
        self.assert_nothing_written()


main()
