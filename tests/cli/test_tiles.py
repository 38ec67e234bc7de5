#!/usr/bin/env python3
"""Tiled textures through the program: made, mapped, swapped, refused."""

import json
import re

from program import CAGES, EXEMPLARS, ProgramTest, main

CAGE = CAGES / "creature.obj"
PICTURES = [EXEMPLARS / n for n in (
    "gravel_tile.png", "pebbles_tile.png")]
SMALL = ("--tile-size", "32", "--gutter", "2")


class Tiles(ProgramTest):
    def make(self, picture, *more, name="tiles.exr"):
        path = self.folder / name
        result = self.run_program("tiles", picture, "-o", path, *more)
        self.assert_exit(result, 0)
        return path

    def lay(self, tiles, *more, **keywords):
        result = self.run_map(
            CAGE, tiles, "--method", "tile", "--tile-level", "1", *more,
            **keywords)
        self.assert_exit(result, 0)

    def test_tiles_meet(self):
        report = self.folder / "out.json"
        self.lay(self.make(PICTURES[0], *SMALL), "--json-report", report)
        tiles = json.loads(report.read_text())["tiles"]
        self.assertEqual(tiles["count"], 16)
        self.assertEqual(tiles["edges_between_equals"], 0)
        self.assertTrue(0 < tiles["inner_cut"] < 1)
        self.assertTrue(0 < tiles["vertex_window"] < 1)
        self.assertTrue(0 <= tiles["inner_window"] < 1)
        self.assertEqual(len(tiles["mismatch_by_mip_level"]), 8)
        for level in tiles["mismatch_by_mip_level"]:
            self.assertLessEqual(level["edge_max"], 1 / 1024)
            self.assertLessEqual(level["corner_max"], 1 / 1024)

    def test_the_written_texture_maps_again(self):
        self.lay(self.make(PICTURES[0], *SMALL))
        first = (self.folder / "out.obj").read_bytes()
        self.lay(self.folder / "out.exr", name="again.obj")
        again = (self.folder / "again.obj").read_bytes()
        self.assertEqual(
            first.split(b"\nvt ", 1)[1].split(b"\nusemtl")[0],
            again.split(b"\nvt ", 1)[1].split(b"\nusemtl")[0])
        # Each says which job it is of, and has a seal on it.
        one, two = (
            re.sub(rb"(job|seal) [0-9a-f]{32}", b"",
                   (self.folder / name).read_bytes())
            for name in ("out.exr", "again.exr"))
        self.assertEqual(one, two)

    def test_distances_are_taken_where_they_are_asked_for(self):
        """Lab is the default; every other choice finds other cuts."""
        made = {}
        for space in (None, "lab", "hsv", "hsv-cylinder", "rgb"):
            more = () if space is None else ("--match-in", space)
            made[space] = self.make(
                PICTURES[1], *SMALL, *more, name=f"{space}.exr").read_bytes()
        self.assertEqual(made[None], made["lab"])
        self.assertEqual(len(set(made.values())), 4)

    def test_pictures_can_be_swapped(self):
        uvs = []
        for picture in PICTURES:
            self.lay(self.make(picture, *SMALL))
            text = (self.folder / "out.obj").read_text()
            uvs.append([l for l in text.splitlines() if l[:2] in ("vt", "f ")])
        self.assertEqual(uvs[0], uvs[1])

    def test_same_bytes_for_any_number_of_threads(self):
        written = [
            self.make(PICTURES[0], *SMALL, "--threads", n).read_bytes()
            for n in ("1", "2", "7")]
        self.assertEqual(written[0], written[1])
        self.assertEqual(written[0], written[2])

    def test_only_what_a_mesh_needs(self):
        cage, level = CAGES / "plane.obj", ("--tile-level", "1")
        tiles = self.make(
            PICTURES[0], *SMALL, "--boundaries", "2", "--for", cage, *level)
        lay = (cage, tiles, "--method", "tile", *level)
        self.assert_exit(self.run_map(*lay), 0)
        self.assert_error(self.run_map(*lay, "--seed", "99"), 1, "--for")

    def test_templates(self):
        self.make(
            PICTURES[0], *SMALL, "--edge-template", "60,60,30",
            "--corner-template", "50,40", "--background", "10,10,90,90")

    def test_the_published_blend_fits_the_same_mesh(self):
        report, uvs, worst = self.folder / "out.json", [], []
        for blend in ("cut", "ramp"):
            self.lay(
                self.make(PICTURES[0], *SMALL, "--blend", blend),
                "--json-report", report)
            level = json.loads(report.read_text())["tiles"][
                "mismatch_by_mip_level"][0]
            worst.append((level["edge_max"], level["corner_max"]))
            text = (self.folder / "out.obj").read_text()
            uvs.append([l for l in text.splitlines() if l[:2] in ("vt", "f ")])
        self.assertEqual(uvs[0], uvs[1])
        self.assertLessEqual(max(worst[0]), 1 / 1024)
        self.assertGreater(min(worst[1]), 0.05)

    def test_oriented_says_where_it_cannot_be(self):
        tiles = self.make(
            PICTURES[0], *SMALL, "--oriented", "--for", CAGE, "--tile-level",
            "1")
        result = self.run_map(
            CAGE, tiles, "--method", "tile", "--tile-level", "1")
        self.assert_exit(result, 0)
        self.assertIn("rows of tiles meet columns", result.stderr)

    def test_bad_options(self):
        out = self.folder / "bad.exr"
        for words, options in (
                ("power of two", ("--tile-size", "100")),
                ("1 to 3", ("--boundaries", "4")),
                ("cut or ramp", ("--blend", "soft")),
                ("X,Y,ANGLE", ("--edge-template", "1,2")),
                ("leaves the picture", ("--edge-template", "-900,5,0")),
                ("leaves the picture", ("--edge-template", "1,1,1,1e9")),
                ("leaves the picture", ("--edge-template", "1e300,1,1")),
                ("8 gutters", ("--tile-size", "32", "--gutter", "16")),
                ("larger picture", ("--tile-size", "2048"))):
            result = self.run_program(
                "tiles", PICTURES[0], "-o", out, "--wrap", "no", *options)
            self.assert_error(result, 1, words)
            self.assertFalse(out.exists())

    def test_needs_tiles(self):
        result = self.run_map(CAGE, PICTURES[0], "--method", "tile")
        self.assert_error(result, 1, "osdtex tiles")
        self.assert_nothing_written()


if __name__ == "__main__":
    main()
