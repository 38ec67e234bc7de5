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
                ({"width": 0}, "width"),
                ({"picture": "blue.png"}, "blue.png"),
                ({"up": [0, 0, 0]}, "up"),
                ({"size": 3}, "is not known")):
            result = self.place({**item, **change})
            self.assertNotEqual(result.returncode, 0)
            self.assertIn(words, result.stderr)
            self.assertFalse((self.folder / "out.obj").exists())

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
