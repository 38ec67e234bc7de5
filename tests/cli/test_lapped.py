#!/usr/bin/env python3
"""Lapped textures through the program: what is written, and saved."""

import json
import struct

from program import CAGES, EXEMPLARS, ProgramTest, main

CAGE = CAGES / "torus.obj"
PICTURE = EXEMPLARS / "gravel_tile.png"
HOW = ("--method", "lapped", "--level", "3", "--scale", "2")


class Lapped(ProgramTest):
    def test_mesh_gets_an_atlas_and_its_texture(self):
        report = self.folder / "out.json"
        result = self.run_map(CAGE, PICTURE, *HOW, "--json-report", report)
        self.assert_exit(result, 0)
        numbers = json.loads(report.read_text())
        lapped = numbers["mapping"]["lapped"]
        self.assertGreater(lapped["pastes"], 1)
        self.assertTrue(1 <= lapped["visible"] <= 3.2)
        self.assertEqual(numbers["distortion"]["flips"], 0)
        lines = (self.folder / "out.obj").read_text().splitlines()
        seen = set()
        for line in lines:
            if line.startswith("vt "):
                u, v = (float(x) for x in line.split()[1:3])
                self.assertTrue(0 <= u <= 1 and 0 <= v <= 1)
                seen.add((u, v))
        self.assertGreater(len(seen), 100)
        self.assertGreater((self.folder / "out.exr").stat().st_size, 10000)

    def test_saved_and_written_again_is_the_same(self):
        saved = self.folder / "it.osdtex"
        self.assert_exit(self.run_map(CAGE, PICTURE, *HOW, "--save", saved), 0)
        first = self.picture("out.exr")
        result = self.run_program(
            "map", "--from", saved, "-o", self.folder / "out.obj")
        self.assert_exit(result, 0)
        self.assertEqual(first, self.picture("out.exr"))

    def test_texture_as_large_as_asked(self):
        result = self.run_map(CAGE, PICTURE, *HOW, "--resolution", "256")
        self.assert_exit(result, 0)
        header = (self.folder / "out.exr").read_bytes()
        at = header.index(b"dataWindow\0box2i\0") + 17 + 4
        self.assertEqual(struct.unpack("<4i", header[at:at + 16]),
                         (0, 0, 255, 255))

    def test_maps_of_a_material_are_baked_beside_the_mesh(self):
        """Onto the atlas of the colour, and the MTL names them."""
        result = self.run_program(
            "map", CAGE, *HOW, "--level", "1", "--resolution", "256", "--material",
            EXEMPLARS.parent / "materials" / "waves", "-o",
            self.folder / "out.obj")
        self.assert_exit(result, 0)
        library = (self.folder / "out.mtl").read_text()
        for line in ("map_Pr out_roughness.exr", "map_Pm out_metalness.exr",
                     "norm out_normal.exr", "disp out_height.exr"):
            self.assertIn(line, library)
        self.assertTrue((self.folder / "out_occlusion.exr").exists())
        # The normals' size is the colour's: they lie on the same atlas.
        for name in ("out.exr", "out_normal.exr"):
            header = (self.folder / name).read_bytes()
            at = header.index(b"dataWindow\0box2i\0") + 17 + 4
            self.assertEqual(struct.unpack("<4i", header[at:at + 16]),
                             (0, 0, 255, 255))

    def test_auto_takes_it_for_what_alpha_cuts_out(self):
        for picture, taken in (("leaves_cut.png", True), ("gravel_tile.png", False)):
            result = self.run_map(
                CAGE, EXEMPLARS / picture, "--method", "auto", "--level", "1",
                "-n")
            self.assert_exit(result, 0)
            self.assertEqual(
                "by            lapped\n" in result.stdout, taken, result.stdout)

    def test_what_takes_for_ever_is_refused(self):
        result = self.run_map(CAGE, PICTURE, *HOW, "--scale", "1e-4")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("--scale", result.stderr)


if __name__ == "__main__":
    main()
