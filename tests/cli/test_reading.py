#!/usr/bin/env python3
"""Cages and pictures as people have them: parts that only touch, vertices
in one place, mirrored UVs, places far away from the origin.

    test_reading.py OSDTEX
"""

import json
import os
import struct
import subprocess
import zlib

from program import ENVIRONMENT, EXEMPLARS, PROGRAM, SHARED, ProgramTest, main

EXEMPLAR = EXEMPLARS / "gravel_tile.png"

# Two quads and a tetrahedron that hang together at vertices only.
PINCHED = """\
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 2 2 0
v 1 2 0
v 2 1 0
v 3 2 0
v 2 3 0
v 2 2 1
f 1 2 3 4
f 3 7 5 6
f 5 9 8
f 5 8 10
f 5 10 9
f 8 9 10
"""


FAR = 1 << 20


def sheet(away):
    """A curved sheet around the origin, or that far away from it in x and z,
    with coordinates that a float has exactly when it is near."""
    points = [(x / 2 + away, (x * x - y * y) / 16, y / 2 + away)
              for y in range(-3, 4) for x in range(-3, 4)]
    text = "".join(f"v {x:.6f} {y:.6f} {z:.6f} # as it came\n"
                   for x, y, z in points)
    return text + "".join(
        f"f {7 * y + x + 1} {7 * y + x + 8} {7 * y + x + 9} {7 * y + x + 2}\n"
        for y in range(6) for x in range(6))


def png(path, pixels):
    """Rows of (r, g, b, a) bytes from the top, as a file."""
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))

    rows = b"".join(b"\0" + bytes(v for p in row for v in p)
                    for row in pixels)
    head = struct.pack(">IIBBBBB", len(pixels[0]), len(pixels), 8, 6, 0, 0, 0)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) +
        chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
    return path


def read_png(path):
    """Rows of pixels from the top of an 8-bit RGB picture."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        at += 12 + size
        if kind == b"IHDR":
            width, height, _, colours = struct.unpack(">IIBB", body[:10])
        packed += body if kind == b"IDAT" else b""
    step = 4 if colours == 6 else 3
    raw, row, rows = zlib.decompress(packed), bytes(width * step), []
    for y in range(height):
        way = raw[y * (width * step + 1)]
        above, row = row, bytearray(
            raw[y * (width * step + 1) + 1:(y + 1) * (width * step + 1)])
        for i in range(len(row)):
            a = row[i - step] if i >= step else 0
            b, c = above[i], above[i - step] if i >= step else 0
            p = a + b - c
            paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b),
                        (abs(p - c), 2, c))[2]
            row[i] = (row[i] + (0, a, b, (a + b) // 2, paeth)[way]) & 255
        rows.append([tuple(row[i:i + 3]) for i in range(0, len(row), step)])
    return rows


def lines(path, key):
    return [l.split()[1:] for l in path.read_text().splitlines()
            if l.split()[:1] == [key]]


def said(path):
    """The lines of a text but for remarks, which know names."""
    return [l for l in path.read_text().splitlines() if l[:1] != "#"]


def vertices_of(faces):
    return [[int(c.split("/")[0]) for c in f] for f in faces]


class Reading(ProgramTest):
    def cage(self, text, name="cage.obj"):
        path = self.folder / name
        path.write_text(text)
        return path

    def test_parts_that_only_touch(self):
        """One warning; the refined vertices begin with the cage's, and those
        of the parts lie behind them; a written cage is the one that came."""
        cage = self.cage(PINCHED)
        result = self.run_map(cage, EXEMPLAR, "--level", "1")
        self.assert_exit(result, 0)
        self.assertEqual(result.stderr.count("warning"), 1, result.stderr)
        self.assertIn("touch only at 2 vertices", result.stderr)
        points = lines(self.folder / "out.obj", "v")
        for pinch, copies in ((2, 2), (4, 2)):
            place = lines(cage, "v")[pinch]
            self.assertEqual(points[pinch], place)
            self.assertEqual(points.count(place), copies)

        result = self.run_program(
            "bake", cage, EXEMPLAR, "-o", self.folder / "baked.obj",
            "--level", "1", "--resolution", "64")
        self.assert_exit(result, 0)
        written = self.folder / "baked_cage.obj"
        self.assertEqual(lines(written, "v"), lines(cage, "v"))
        self.assertEqual(
            vertices_of(lines(written, "f")), vertices_of(lines(cage, "f")))

    def test_loose_faces(self):
        """One warning with the number of coincident vertices; --weld, with a
        distance or without, closes the surface; vertices and faces stay in
        their order."""
        corners = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
        quads = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3),
                 (0, 4, 6, 2), (1, 3, 7, 5))
        cage = self.cage(
            "".join("v %g %g %g\n" % corners[c] for q in quads for c in q) +
            "".join(f"f {4 * i + 1} {4 * i + 2} {4 * i + 3} {4 * i + 4}\n"
                    for i in range(6)))
        result = self.run_program("info", cage)
        self.assertEqual(result.stderr.count("warning"), 1, result.stderr)
        self.assertIn("24 vertices lie at only 8 places", result.stderr)
        self.assertIn("components  6", result.stdout)
        for words in (["--weld"], ["--weld", "0.1"], ["--weld=.1"]):
            result = self.run_program("info", *words, cage)
            self.assert_exit(result, 0)
            self.assertNotIn("warning", result.stderr)
            self.assertIn("components  1, 0 boundary edges", result.stdout)
        for words in ("0", "-1", "far"):
            self.assert_error(
                self.run_program("info", f"--weld={words}", cage), 1, "--weld")
        self.assert_error(
            self.run_program("info", cage, "--weld=2"), 2, "repeats vertex")
        self.assert_exit(self.run_program(
            "bake", cage, EXEMPLAR, "--weld", "-o", self.folder / "b.obj",
            "--level", "0", "--scale", "2", "--resolution", "64"), 0)
        written = self.folder / "b_cage.obj"
        self.assertEqual(lines(written, "v"), lines(cage, "v"))
        self.assertEqual(
            [[lines(cage, "v")[c - 1] for c in f]
             for f in vertices_of(lines(written, "f"))],
            [[lines(cage, "v")[c - 1] for c in f]
             for f in vertices_of(lines(cage, "f"))])

    def test_mirrored_halves(self):
        """Where UVs fold back the cage is written with a seam."""
        cage = self.cage(
            "v -1 0 0\nv 0 0 0\nv 1 0 0\nv -1 1 .2\nv 0 1 .2\nv 1 1 .2\n"
            "vt .9 .1\nvt .1 .1\nvt .1 .9\nvt .9 .9\n"
            "f 1/1 2/2 5/3 4/4\nf 2/2 3/1 6/4 5/3\n")
        result = self.run_program(
            "bake", cage, EXEMPLAR, "-o", self.folder / "b.obj", "--level",
            "1", "--scale", "2", "--resolution", "64", "--uvs", "own")
        self.assert_exit(result, 0)
        self.assertIn("fold back at 1 edges", result.stderr)
        written = self.folder / "b_cage.obj"
        left, right = [
            [tuple(int(n) for n in c.split("/")) for c in f]
            for f in lines(written, "f")]
        uvs = lines(written, "vt")
        left, right = dict(left), dict(right)
        for vertex in (2, 5):
            self.assertNotEqual(left[vertex], right[vertex])
            self.assertEqual(uvs[left[vertex] - 1], uvs[right[vertex] - 1])

    def test_tags_of_a_plain_mesh(self):
        """Creases, corners and holes come out of every method that leaves the
        mesh as it is; a hole is still a face, without UVs."""
        cage = self.cage(
            sheet(0) + "t crease 2/1/0 8 9 2.5\nt corner 1/1/0 0 10\n"
            "t hole 1/0/0 7\nec 3 9 10\n"
            "t facevaryinginterpolateboundary 1/0/0 5\n")
        tiles = self.folder / "tiles.exr"
        self.assert_exit(self.run_program(
            "tiles", EXEMPLAR, "-o", tiles, "--tile-size", "32"), 0)
        for method, exemplar in (
                ("hierarchical", EXEMPLAR), ("tile", tiles)):
            result = self.run_map(
                cage, exemplar, "--scheme", "none", "--method", method,
                "--scale", "2")
            self.assert_exit(result, 0)
            written = self.folder / "out.obj"
            self.assertEqual(vertices_of(lines(written, "f")),
                             vertices_of(lines(cage, "f")))
            self.assertEqual(
                [i for i, f in enumerate(lines(written, "f"))
                 if not any("/" in c for c in f)], [7])
            tags = [" ".join(t) for t in lines(written, "t")]
            for tag in ("crease 2/1/0 8 9 2.5", "crease 2/1/0 8 9 3",
                        "corner 1/1/0 0 10", "hole 1/0/0 7",
                        "facevaryinginterpolateboundary 1/0/0 5"):
                self.assertIn(tag, tags)

    def test_pipes(self):
        """Standard input, process substitutions and named pipes are read
        once, cages and pictures alike, and give the same files."""
        cage = self.cage(sheet(0))
        quick = "--level 0 --scale 2 --threads 1"
        self.assert_exit(
            self.run_map(cage, EXEMPLAR, *quick.split(), name="a.obj"), 0)
        fifo = self.folder / "fifo"
        os.mkfifo(fifo)
        job = f"'{PROGRAM}' map {{}} {{}} -o {self.folder}/a.obj {quick}"
        os.mkdir(self.folder / "kept")
        kept = {}
        for suffix in ("obj", "mtl", "exr"):
            path = self.folder / f"a.{suffix}"
            kept[suffix] = suffix == "exr" or said(path)
            path.unlink()
        for line in (
                f"cat {cage} | " + job.format("/dev/stdin", EXEMPLAR),
                job.format("/dev/stdin", EXEMPLAR) + f" < {cage}",
                job.format(f"<(cat {cage})", f"<(cat {EXEMPLAR})"),
                f"cat {EXEMPLAR} > {fifo} & " + job.format(cage, fifo)):
            result = subprocess.run(
                ["bash", "-c", line], capture_output=True, text=True,
                env=ENVIRONMENT, timeout=100)
            self.assert_exit(result, 0)
            self.assertNotIn("/proc/", result.stderr)
            for suffix, data in kept.items():
                path = self.folder / f"a.{suffix}"
                if suffix != "exr":
                    self.assertEqual(said(path), data, line)
                path.unlink()
        for words, path in (("cage, hash", cage), ("picture, hash", EXEMPLAR)):
            plain = self.run_program("info", path).stdout
            with open(path, "rb") as data:
                piped = subprocess.run(
                    [PROGRAM, "info", "/dev/stdin"], input=data.read(),
                    capture_output=True, env=ENVIRONMENT).stdout.decode()
            self.assertIn(words, piped)
            self.assertEqual(piped, plain.replace(str(path), "/dev/stdin"))
        result = subprocess.run(
            [PROGRAM, "info", "/dev/stdin"], input=b"v 0 0\n",
            capture_output=True, env=ENVIRONMENT)
        self.assertEqual(result.returncode, 2)
        self.assertIn(b"/dev/stdin:1: a vertex has 3", result.stderr)

    def test_transparent_texels(self):
        """A hole in the picture is no source; a picture that is all holes is
        told of with their share."""
        def picture(name, is_hole):
            return png(self.folder / name, [
                [(0, 0, 0, 0) if is_hole(x, y) else
                 (90 + x * 7 % 60, 120 + y * 5 % 70, 60, 255)
                 for x in range(64)] for y in range(64)])

        hole = picture("hole.png", lambda x, y: 20 <= x < 30 and 8 <= y < 30)
        result = self.run_program("info", hole)
        self.assertEqual(result.stderr.count("warning"), 1, result.stderr)
        self.assertIn("5.4 % of the picture are transparent", result.stderr)
        self.assertIn("size        64 x 34,", result.stdout)
        lace = picture("lace.png", lambda x, y: x % 4 == 0 or y % 4 == 0)
        result = self.run_program("info", lace)
        self.assertIn("43.8 % of the picture are transparent", result.stderr)
        self.assertIn("size        64 x 64,", result.stdout)
        self.assertIn("will have holes", result.stderr)

    def test_layers(self):
        """The beauty, not the cryptomatte in front of it, unless it is asked
        for."""
        exr = SHARED / "reports" / "mp_crypto.exr"
        if not exr.is_file():
            self.skipTest(f"{exr} is not there")
        plain = self.run_program("info", exr)
        self.assert_exit(plain, 0)
        self.assertIn("'beauty' (part 1) is used", plain.stderr)
        crypto = self.run_program("info", exr, "--layer", "crypto00")
        self.assert_exit(crypto, 0)
        self.assertIn("'rgba.crypto00' (part 0) is used", crypto.stderr)
        self.assert_error(
            self.run_program("info", exr, "--layer", "N"), 1,
            "it has rgba.crypto00, beauty")

    def look(self, model, *more):
        """The unlit picture of a model from the front."""
        picture = self.folder / "look.png"
        result = self.run_program(
            "render", model, "-o", picture, "--unlit", "--camera", "front",
            "--size", "40x40", "--samples", "1", *more)
        self.assert_exit(result, 0)
        return read_png(picture), result.stderr

    def test_colours_without_maps(self):
        """Kd is drawn, with UVs or without; options of a map are no part of
        its name."""
        square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
        (self.folder / "m.mtl").write_text(
            "newmtl red\nKd 0.5 0 0\nNs 10\nnewmtl map\nKd 0 0 1\n"
            "map_Kd -s 1 1 1 -o 0.5 0 -clamp on -bm 1.0 my map.png\n")
        png(self.folder / "my map.png", [[(0, 128, 0, 255)] * 8] * 8)
        for text, expected in (
                ("vt 0 0\nusemtl red\nf 1/1 2/1 3/1 4/1\n", (188, 0, 0)),
                ("usemtl red\nf 1 2 3 4\n", (188, 0, 0)),
                ("vt 0 0\nusemtl map\nf 1/1 2/1 3/1 4/1\n", (0, 128, 0))):
            model = self.cage("mtllib m.mtl\n" + square + text)
            rows, said = self.look(model)
            self.assertNotIn("warning", said)
            for a, b in zip(rows[20][20], expected):
                self.assertLessEqual(abs(a - b), 1, rows[20][20])

    def test_own_udim_bakes(self):
        """What a bake onto several tiles writes can be looked at: no face of
        it is grey, and a tile that is missing is one warning."""
        cage = self.cage(sheet(0))
        self.assert_exit(self.run_program(
            "bake", cage, EXEMPLAR, "-o", self.folder / "b.obj", "--level",
            "1", "--scale", "2", "--uvs", "atlas", "--resolution", "64",
            "--texels-per-unit", "24"), 0)
        model = self.folder / "b_cage.obj"
        tiles = sorted(self.folder.glob("b.1*.exr"))
        self.assertGreater(len(tiles), 2)
        top = ("--camera", "top")
        rows, said = self.look(model, *top)
        self.assertNotIn("warning", said)
        tiles[-1].unlink()
        fewer, said = self.look(model, *top)
        self.assertEqual(said.count("the texture is not there"), 1, said)
        self.assertNotEqual(rows, fewer)

    def test_units_and_axes(self):
        """NAME.usda says what a scene unit is and which axis points up."""
        cage = self.cage(sheet(0))
        for words, code, meters, axis in (
                ((), 0, "0.01", "Y"), (("--for", "blender"), 0, "1", "Y"),
                (("--units", "mm", "--up", "z"), 0, "0.001", "Z"),
                (("--units", "0.3048"), 0, "0.3048", "Y"),
                (("--units", "0"), 1, None, None),
                (("--units", "yards"), 1, None, None),
                (("--up", "x"), 1, None, None)):
            result = self.run_program(
                "bake", cage, EXEMPLAR, "-o", self.folder / "b.obj", "--level",
                "0", "--scale", "4", "--resolution", "64", *words)
            self.assert_exit(result, code)
            if code == 0:
                self.assertIn(
                    f'metersPerUnit = {meters}\n    upAxis = "{axis}"\n',
                    (self.folder / "b.usda").read_text())

    def test_normals(self):
        """--normals: those of the limit; on both sides of an infinitely sharp
        crease they differ, elsewhere a vertex has one."""
        roof = self.cage(
            "v -1 0 0\nv 0 1 0\nv 1 0 0\nv -1 0 1\nv 0 1 1\nv 1 0 1\n"
            "f 1 4 5 2\nf 2 5 6 3\nt crease 2/1/0 1 4 10\n")
        for crease in (True, False):
            if not crease:
                roof.write_text(roof.read_text().replace(" 1 4 10", " 1 4 2"))
            self.assert_exit(self.run_program(
                "bake", roof, EXEMPLAR, "-o", self.folder / "b.obj", "--level",
                "2", "--scale", "2", "--resolution", "64", "--normals"), 0)
            self.assert_exit(self.run_map(
                roof, EXEMPLAR, "--level", "2", "--scale", "2", "--normals"), 0)
            for name in ("b_cage.obj", "out.obj"):
                path = self.folder / name
                normals = [[float(x) for x in n] for n in lines(path, "vn")]
                for n in normals:
                    self.assertAlmostEqual(sum(x * x for x in n), 1, 5)
                    self.assertGreater(n[1], 0)
                seen = {}
                for face in lines(path, "f"):
                    for corner in face:
                        v, uv, n = corner.split("/")
                        self.assertTrue(uv)
                        seen.setdefault(int(v), set()).add(int(n))
                for ridge in (2, 5):
                    ways = sorted(normals[n - 1][0] for n in seen[ridge])
                    self.assertEqual(len(ways), 1 + crease, name)
                    if crease:
                        self.assertLess(ways[0], -.4)
                        self.assertGreater(ways[1], .4)
                self.assertEqual(len(seen[1]), 1)
        self.assert_exit(self.run_map(
            roof, EXEMPLAR, "--scheme", "none", "--scale", "2", "--normals"), 0)
        self.assertEqual(len(lines(self.folder / "out.obj", "vn")), 6)
        self.assert_exit(self.run_map(
            roof, EXEMPLAR, "--level", "1", "--scale", "2", "--scheme",
            "bilinear", "--normals"), 0)
        self.assertEqual(
            {tuple(round(float(x), 3) for x in n)
             for n in lines(self.folder / "out.obj", "vn")},
            {(-.707, .707, 0), (.707, .707, 0)})

    def everything(self, away):
        """Maps, bakes and looks at the sheet; what came out."""
        name = f"{away}"
        cage = self.cage(sheet(away), name + "_in.obj")
        pull = self.folder / (name + ".json")
        pull.write_text(json.dumps({"constraints": [
            {"point": [away + .8, 0, away + 1], "radius": .6,
             "direction": [1, 0, 0]},
            {"point": [away - 1, 0, away - .7], "radius": .6,
             "direction": [1, 0, 1]}]}))
        quick = ("--level", "1", "--scale", "2", "--constraints", pull)
        report = self.folder / (name + "_report.json")
        for words in (
                ("map", cage, EXEMPLAR, "-o", self.folder / (name + ".obj"),
                 *quick),
                ("bake", cage, EXEMPLAR, "-o", self.folder / (name + "_b.obj"),
                 *quick, "--resolution", "64", "--json-report", report),
                ("field", cage, "-o", self.folder / (name + ".csv"),
                 "--level", "1", "--constraints", pull),
                ("render", self.folder / (name + ".obj"), "-o",
                 self.folder / (name + ".png"), "--size", "64x64", "--samples",
                 "1", f"--camera={away + 3},4,{away + 5},{away},0,{away},40")):
            result = self.run_program(*words)
            self.assert_exit(result, 0)
            self.assertEqual(
                result.stderr.count("32 bits"), away > 0, result.stderr)
        return cage, name

    def test_far_away(self):
        """The same sheet near and far gives the same texture, field and
        picture; its points are where they belong."""
        near_cage, near = self.everything(0)
        far_cage, far = self.everything(FAR)
        self.assertEqual(
            *(said(self.folder / (name + ".csv")) for name in (near, far)))
        self.assertEqual(
            *(read_png(self.folder / (name + ".png")) for name in (near, far)))
        for key in ("vt", "f"):
            self.assertEqual(
                lines(self.folder / (near + ".obj"), key),
                lines(self.folder / (far + ".obj"), key))
        for a, b in zip(lines(self.folder / (near + ".obj"), "v"),
                        lines(self.folder / (far + ".obj"), "v")):
            for x, y, away in zip(a, b, (FAR, 0, FAR)):
                self.assertLess(abs(float(y) - away - float(x)), 2e-7)
        written = self.folder / (far + "_b_cage.obj")
        self.assertEqual(
            [l for l in written.read_text().splitlines() if l[:2] == "v "],
            [l for l in far_cage.read_text().splitlines() if l[:2] == "v "])
        self.assertIn(
            f"double3 xformOp:translate = ({FAR}, 0, {FAR})",
            (self.folder / (far + "_b.usda")).read_text())
        self.assertIn(
            f"box         {FAR - 1.5:.9g} ",
            self.run_program("info", far_cage).stdout)


if __name__ == "__main__":
    main()
