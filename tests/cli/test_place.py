#!/usr/bin/env python3
"""Pictures placed over a mapping, through the program: bakes, saved mappings
and what is refused."""

import json
import struct
import zlib

from program import CAGES, EXEMPLARS, ProgramTest, main

CAGE = CAGES / "plane.obj"
PICTURE = EXEMPLARS / "gravel_tile.png"
HOW = ("--level", "1", "--scale", "4")


def write_png(path, width, height, texel):
    """RGBA; texel(x, y) from the upper left."""
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(
            ">I", zlib.crc32(body))

    rows = b"".join(
        b"\0" + b"".join(bytes(texel(x, y)) for x in range(width))
        for y in range(height))
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0))
        + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class Place(ProgramTest):
    def setUp(self):
        super().setUp()
        write_png(self.folder / "red.png", 16, 16, lambda x, y: (
            255, 0, 0, 255 if 2 <= x < 14 else 0))

    def ask(self, *items, name="p.json"):
        (self.folder / name).write_text(json.dumps({"placed": list(items)}))
        return self.folder / name

    def place(self, *items, more=(), name="out.obj"):
        return self.run_map(
            CAGE, PICTURE, *HOW, "--resolution", "256", "--place",
            self.ask(*items), *more, name=name)

    def test_is_on_the_texture_and_in_the_report(self):
        result = self.place(
            {"picture": "red.png", "face": 0, "width": 0.2},
            more=("--json-report", self.folder / "r.json"))
        self.assert_exit(result, 0)
        placed = json.loads((self.folder / "r.json").read_text())[
            "mapping"]["placed"]
        self.assertEqual(placed["decals"], 1)
        self.assertLess(placed["stretch_p95"], 1.05)
        self.assertLess(placed["offset"], 0.5)

    def reddish(self, name):
        """Share of a picture that is as red as what is placed."""
        import numpy
        from PIL import Image
        pixels = numpy.asarray(
            Image.open(self.folder / name).convert("RGB")).astype(int)
        return ((pixels[..., 0] > 100) &
                (pixels[..., 0] > 4 * pixels[..., 1:].max(-1))).mean()

    def test_over_every_method(self):
        """Whatever lies below, the picture is seen, and without it is not."""
        self.need(modules=("PIL", "numpy"))
        tiles = self.folder / "tiles.exr"
        self.assert_exit(self.run_program(
            "tiles", PICTURE, "-o", tiles, "--tile-size", "32"), 0)
        below = {"tile": (tiles, "--tile-level", "1"),
                 "material": (EXEMPLARS / "bricks_tile.png",),
                 "vertex": (PICTURE, "--set", "levels=2", "--set", "starts=1")}
        asked = self.ask({"picture": "red.png", "point": [0, 0, 0],
                          "width": 1.5})
        listed = self.run_program("methods").stdout.splitlines()
        for method in [line.split()[0] for line in listed]:
            picture, *more = below.get(method, (PICTURE,))
            level = () if method == "tile" else ("--level", "1")
            seen = []
            for place in (("--place", asked), ()):
                self.assert_exit(self.run_map(
                    CAGE, picture, "--method", method, "--scale", "4", *level,
                    *more, *place, "--preview", self.folder / "p.png",
                    "--unlit", "--camera", "front", "--size", "96x96",
                    "--resolution", "128", "--replace"), 0)
                seen.append(self.reddish("p.png"))
            with self.subTest(method, seen=seen):
                self.assertEqual(seen[1], 0)
                self.assertGreater(seen[0], 0.02)

    def test_saved_and_put_elsewhere(self):
        item = {"picture": "red.png", "face": 0, "width": 0.2}
        saved = self.folder / "it.osdtex"
        self.assert_exit(self.place(item, more=("--save", saved)), 0)
        first = self.picture("out.exr")
        again = ("map", "--from", saved, "-o", self.folder / "out.obj",
                 "--resolution", "256")
        self.assert_exit(self.run_program(*again), 0)
        self.assertEqual(first, self.picture("out.exr"))
        other = self.ask({**item, "mirror": True, "turn": 45}, name="q.json")
        self.assert_exit(self.run_program(*again, "--place", other), 0)
        self.assertNotEqual(first, self.picture("out.exr"))
        (self.folder / "red.png").unlink()
        self.assert_error(
            self.run_program(*again), 3, "red.png")

    def test_bad_input_is_one_sentence(self):
        item = {"picture": "red.png", "face": 0, "width": 0.2}
        for change, words in (
                ({"face": 999}, "there is no face 999"),
                ({"face": None, "point": [1e300, 0, 0]}, "too far from any"),
                ({"width": 0}, "width"),
                ({"picture": "blue.png"}, "blue.png"),
                ({"up": [0, 0, 0]}, "up"),
                ({"size": 3}, "is not known")):
            result = self.place({k: v for k, v in {**item, **change}.items()
                                 if v is not None})
            self.assertNotEqual(result.returncode, 0)
            self.assertIn(words, result.stderr)
            self.assertFalse((self.folder / "out.obj").exists())

    def test_scattered_where_up_lies_along_the_surface(self):
        """Where it stands on the surface is passed over."""
        cube = self.folder / "cube.obj"
        cube.write_text(
            "".join(f"v {x} {y} {z}\n" for z in (-1, 1) for y in (-1, 1)
                    for x in (-1, 1)) +
            "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\n"
            "f 2 4 8 6\n")
        result = self.run_map(
            cube, PICTURE, "--scheme", "none", "--level", "0", "--scale", "1",
            "--resolution", "64", "--json-report", self.folder / "r.json",
            "--place", self.ask({"picture": "red.png", "scatter": 20,
                                 "width": 0.2, "up": [0, 1, 0]}))
        self.assert_exit(result, 0)
        self.assertEqual(json.loads((self.folder / "r.json").read_text())[
            "mapping"]["placed"]["decals"], 20)

    def test_without_alpha_is_said(self):
        result = self.place(
            {"picture": str(EXEMPLARS / "spots_tile.png"), "face": 0,
             "width": 0.2}, more=("-v",))
        self.assert_exit(result, 0)
        self.assertIn("all of its rectangle is placed", result.stderr)

    def test_up_to_date_looks_at_the_pictures(self):
        item = {"picture": "red.png", "face": 0, "width": 0.2}
        self.assert_exit(self.place(item, more=("-u",)), 0)
        self.assertIn(
            "is up to date", self.place(item, more=("-u",)).stderr)
        write_png(self.folder / "red.png", 16, 16, lambda x, y: (0, 0, 9, 255))
        self.assertNotIn(
            "is up to date", self.place(item, more=("-u",)).stderr)


if __name__ == "__main__":
    main()
