#!/usr/bin/env python3
"""Texture made on the surface, through the program: what is written and saved."""

import json

from program import CAGES, EXEMPLARS, ProgramTest, main

CAGE = CAGES / "torus.obj"
BRICKS = EXEMPLARS / "bricks_tile.png"
GRAVEL = EXEMPLARS / "gravel_tile.png"
HOW = ("--method", "vertex", "--level", "2", "--scale", "4", "--set",
       "levels=3", "--set", "starts=1", "--resolution", "256")


class Vertex(ProgramTest):
    def made(self, picture, *more):
        report = self.folder / "out.json"
        result = self.run_map(
            CAGE, picture, *HOW, "--json-report", report, *more)
        self.assert_exit(result, 0)
        return json.loads(report.read_text()), result.stderr

    def test_courses_follow_the_field(self):
        report, said = self.made(BRICKS)
        self.assertIn("at random along the field", said)
        made = report["mapping"]["made"]
        self.assertLess(made["departure"], 7)
        self.assertGreater(made["contrast"], 0.9)
        self.assertLess(made["histogram"], 0.1)
        self.assertGreater(made["texels"], 10000)
        self.assertEqual(report["distortion"]["flips"], 0)

    def test_patches_are_gone_on_from(self):
        report, said = self.made(GRAVEL)
        self.assertIn("starts from patches", said)
        self.assertNotIn("departure", report["mapping"]["made"])
        self.assertGreater(report["mapping"]["made"]["coherence"], 0.8)

    def test_mesh_gets_an_atlas_and_its_texture(self):
        self.made(BRICKS)
        seen = set()
        for line in (self.folder / "out.obj").read_text().splitlines():
            if line.startswith("vt "):
                u, v = (float(x) for x in line.split()[1:3])
                self.assertTrue(0 <= u <= 1 and 0 <= v <= 1)
                seen.add((u, v))
        self.assertGreater(len(seen), 100)
        self.assertGreater((self.folder / "out.exr").stat().st_size, 10000)

    def test_saved_and_written_again_is_the_same(self):
        saved = self.folder / "it.osdtex"
        self.made(BRICKS, "--save", saved)
        first = self.picture("out.exr")
        result = self.run_program(
            "map", "--from", saved, "--resolution", "256", "-o",
            self.folder / "out.obj")
        self.assert_exit(result, 0)
        self.assertEqual(first, self.picture("out.exr"))


if __name__ == "__main__":
    main()
