#!/usr/bin/env python3
"""Pictures and previews: the same flags give the same picture, and the model
fills it."""

import struct
import zlib

from program import CAGES, EXEMPLARS, ProgramTest, main

CAGE = CAGES / "plane.obj"
EXEMPLAR = EXEMPLARS / "gravel_tile.png"
QUICK = ("--level", "0", "--scale", "4", "-q")
SMALL = ("--size", "64x48", "--samples", "1")


def png(path):
    """Rows of pixels, top first, of an 8-bit PNG of R, G, B and perhaps A."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, bits, colour = struct.unpack(">IIBB", body[:10])
        elif kind == b"IDAT":
            packed += body
        at += 12 + size
    assert bits == 8 and colour in (2, 6)
    step, raw = 3 if colour == 2 else 4, zlib.decompress(packed)
    rows, before = [], bytes(width * step)
    for y in range(height):
        line = raw[y * (width * step + 1):(y + 1) * (width * step + 1)]
        before = unfilter(line[0], line[1:], before, step)
        rows.append([tuple(before[i:i + 3]) for i in range(0, len(before), step)])
    return rows


def unfilter(kind, line, above, step):
    out = bytearray(line)
    for i in range(len(out)):
        a = out[i - step] if i >= step else 0
        b, c = above[i], above[i - step] if i >= step else 0
        p = a + b - c
        paeth = min((abs(p - v), n, v) for n, v in enumerate((a, b, c)))[2]
        out[i] = (out[i] + (0, a, b, (a + b) // 2, paeth)[kind]) & 255
    return bytes(out)


def difference(a, b):
    """Mean over pixels and channels of two pictures."""
    pairs = [(p, q) for one, two in zip(png(a), png(b))
             for one, two in zip(one, two) for p, q in zip(one, two)]
    return sum(abs(p - q) for p, q in pairs) / len(pairs)


class Pictures(ProgramTest):
    def map_with(self, name, *more, exit_code=0):
        result = self.run_program(
            "map", CAGE, EXEMPLAR, "-o", self.folder / f"{name}.obj", *QUICK,
            *more)
        self.assert_exit(result, exit_code)
        return result.stderr

    def test_previews_take_what_pictures_take(self):
        """The preview of a mapping is the picture of the mapping."""
        for more in ((), ("--camera", "front", "--turn", "20"), ("--up", "z"),
                     ("--unlit", "--no-shadows"),
                     ("--camera", "0,0,9,0,0,0,20")):
            with self.subTest(more):
                self.map_with(
                    "a", "--preview", self.folder / "p.png", "--save",
                    self.folder / "a.osdtex", *SMALL, *more)
                result = self.run_program(
                    "render", "--from", self.folder / "a.osdtex", "-o",
                    self.folder / "r.png", "-q", *SMALL, *more)
                self.assert_exit(result, 0)
                self.assertEqual(
                    png(self.folder / "p.png"), png(self.folder / "r.png"))

    def test_written_materials_are_shaded_by_their_maps(self):
        """An OBJ, with what its MTL names, looks as its mapping did."""
        written, preview = self.folder / "a.obj", self.folder / "p.png"
        size = ("--size", "96x72", "--samples", "2", "-q")
        self.assert_exit(self.run_program(
            "map", CAGES / "torus.obj", "--material",
            CAGES.parent / "materials" / "waves", "--scale", "4", "--level",
            "2", "-o", written, "--preview", preview, *size), 0)
        self.assert_exit(self.run_program(
            "render", written, "-o", self.folder / "r.png", *size), 0)
        self.assert_exit(self.run_program(
            "render", written, "-o", self.folder / "m.png", "--plain", *size), 0)
        near = difference(preview, self.folder / "r.png")
        self.assertLess(near, 1.5)
        self.assertGreater(difference(preview, self.folder / "m.png"), 4 * near)
        # A map that does not lie on the colour is left out, with a word.
        (self.folder / "a_roughness.exr").unlink()
        (self.folder / "a_normal.exr").write_bytes(EXEMPLAR.read_bytes()[:99])
        result = self.run_program(
            "render", written, "-o", self.folder / "n.png", *size[:-1])
        self.assert_exit(result, 0)
        self.assertIn("a_roughness.exr: the map is not there", result.stderr)
        self.assertIn("the maps of its texture are left out", result.stderr)

    def test_bakes_do_too(self):
        result = self.run_program(
            "bake", CAGE, EXEMPLAR, "-o", self.folder / "b.obj", *QUICK,
            "--resolution", "32", "--preview", self.folder / "b.png", "--size",
            "40x30", "--samples", "1")
        self.assert_exit(result, 0)
        rows = png(self.folder / "b.png")
        self.assertEqual((len(rows), len(rows[0])), (30, 40))

    def test_the_model_fills_the_picture(self):
        """The plane from the front: 94 % of the height, which is the less."""
        self.map_with(
            "a", "--preview", self.folder / "p.png", "--camera", "front",
            "--show", "uv", "--size", "160x100", "--samples", "1")
        rows = png(self.folder / "p.png")
        seen = [y for y, row in enumerate(rows)
                if any(max(p) - min(p) > 8 for p in row)]
        self.assertGreaterEqual(len(seen), 90)
        self.assertGreater(seen[0], 0)
        self.assertLess(seen[-1], 99)

    def test_smooth_walls_have_no_bands(self):
        """Neighbours of a row differ by one step here and there, not by rows."""
        self.map_with(
            "a", "--preview", self.folder / "p.png", "--size", "160x120",
            "--samples", "1", "--camera", "0,0,400,0,0,0,30")
        rows = png(self.folder / "p.png")
        mixed = sum(len({p[0] for p in row[:40]}) > 1 for row in rows)
        self.assertGreater(mixed, 100)

    def render(self, name, *more, exit_code=0):
        result = self.run_program(
            "render", "--from", self.folder / "a.osdtex", "-o",
            self.folder / name, "-q", *more)
        self.assert_exit(result, exit_code)
        return result.stderr

    def test_a_turntable_goes_once_round(self):
        self.map_with("a", "--save", self.folder / "a.osdtex")
        self.render("t.%03d.png", "--frames", "4", *SMALL)
        frames = [png(self.folder / f"t.00{i}.png") for i in (1, 2, 3, 4)]
        self.assertEqual(len(list(self.folder.glob("t.*"))), 4)
        for i in range(3):
            self.assertNotEqual(frames[i], frames[i + 1])
        said = self.render("t.png", "--frames", "4", exit_code=1)
        self.assertIn("NAME.%04d.png", said)
        self.assertIn("named --camera", self.render(
            "u.%d.png", "--camera", "0,0,9,0,0,0,20", exit_code=1))
        self.assertFalse(list(self.folder.glob("u.*")))

    def test_a_contact_sheet_has_eight_panels(self):
        """Each with its name on a dark ground at the upper left; the flat plane
        has no field, which is shown as clay."""
        self.map_with("a", "--save", self.folder / "a.osdtex")
        self.render(
            "s.png", "--show", "sheet", "--size", "256x128", "--samples", "1")
        rows = png(self.folder / "s.png")
        for j in (0, 64):
            for i in (0, 64, 128, 192):
                corner = [p for row in rows[j + 2:j + 9]
                          for p in row[i + 2:i + 15]]
                self.assertTrue(any(max(p) < 60 for p in corner), (i, j))
                self.assertTrue(any(min(p) > 200 for p in corner), (i, j))
        self.assertIn("64", self.render(
            "s2.png", "--show", "sheet", "--size", "63x128", exit_code=1))

    def test_lines_are_drawn(self):
        """Wire darkens, lines of u are red and those of v green; each is gone
        where it is not asked for."""
        self.map_with("a", "--save", self.folder / "a.osdtex")
        seen = {}
        for draw in ("", "wire", "uv", "wire,uv"):
            self.render(
                f"d{draw}.png", "--show", "flat", "--unlit", "--size",
                "200x150", "--samples", "2", *(("--draw", draw) if draw else ()))
            pixels = [p for row in png(self.folder / f"d{draw}.png")
                      for p in row]
            bare = pixels if not draw else bare
            seen[draw] = [
                sum(p[0] > 2 * p[1] for p in pixels),
                sum(p[1] > 2 * p[0] for p in pixels),
                sum(max(p) < max(q) - 30 for p, q in zip(pixels, bare))]
        self.assertEqual(seen[""], [0, 0, 0])
        self.assertEqual(seen["wire"][:2], [0, 0])
        self.assertGreater(seen["wire"][2], 50)
        for draw in ("uv", "wire,uv"):
            self.assertGreater(min(seen[draw][:2]), 50)
        self.assertIn("--draw takes", self.render(
            "e.png", "--draw", "mesh", exit_code=1))

    def test_what_has_no_use_is_said(self):
        said = self.map_with("a", "--camera", "front")
        self.assertEqual(said, "")
        result = self.run_program(
            "map", CAGE, EXEMPLAR, "-o", self.folder / "c.obj", *QUICK[:-1],
            "--camera", "front")
        self.assert_exit(result, 0)
        self.assertIn("--camera is for a picture", result.stderr)

    def test_bad_words_are_refused(self):
        for more in (("--up", "x"), ("--size", "0x9"), ("--camera", "1,2")):
            with self.subTest(more):
                said = self.map_with(
                    "a", "--preview", self.folder / "p.png", *more, exit_code=1)
                self.assertIn(more[0], said)
                self.assertFalse((self.folder / "p.png").exists())


if __name__ == "__main__":
    main()
