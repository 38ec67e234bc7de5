#!/usr/bin/env python3
"""osdtex map with several exemplars: what is written, what is refused, and
that it does not depend on threads or on being told twice.

    test_mask.py OSDTEX
"""

import json
import re
import struct
import unittest
import zlib

from program import CAGES, EXEMPLARS, ProgramTest, main

CAGE = CAGES / "materials_and_groups.obj"
PLANE = CAGES / "plane.obj"
FIRST = EXEMPLARS / "pebbles_tile.png"
GRASS = EXEMPLARS / "grass_tile.png"
GRAVEL = EXEMPLARS / "gravel_tile.png"
MATERIAL = re.findall(r"^usemtl (\S+)", CAGE.read_text(), re.M)[0]
QUICK = ("--level", "2", "-q")


def write_png(path, width, height, pixel, colour=2):
    """8 bits; `pixel` gives the bytes at x and y, from the top."""
    rows = b"".join(
        b"\0" + b"".join(bytes(pixel(x, y)) for x in range(width))
        for y in range(height))

    def chunk(name, data):
        return (struct.pack(">I", len(data)) + name + data +
                struct.pack(">I", zlib.crc32(name + data)))

    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" +
        chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, colour, 0, 0,
                                   0)) +
        chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
    return path


class Model:
    """An OBJ's faces with the textures of their materials."""

    def __init__(self, path):
        mtl = path.with_suffix(".mtl").read_text()
        textures = dict(re.findall(
            r"newmtl (\S+).*?map_Kd (\S+)", mtl, re.S))
        texture = None
        self.faces = []
        self.textures = []
        self.points = []
        for line in path.read_text().splitlines():
            words = line.split()
            if line.startswith("usemtl "):
                texture = textures[words[1]]
            elif line.startswith("v "):
                self.points.append(tuple(map(float, words[1:4])))
            elif line.startswith("f "):
                self.faces.append(
                    [int(w.split("/")[0]) - 1 for w in words[1:]])
                self.textures.append(texture)


class MaskTest(ProgramTest):
    def names(self):
        return sorted(p.name for p in self.folder.iterdir())

    def map(self, *more, cage=CAGE, name="out.obj"):
        result = self.run_map(cage, FIRST, *QUICK, *more, name=name)
        self.assert_exit(result, 0)
        return result

    def refused(self, code, words, *more, cage=CAGE):
        before = self.names()
        self.assert_error(
            self.run_map(cage, FIRST, *QUICK, *more), code, words)
        self.assertEqual(self.names(), before)

    def tiles(self, columns):
        """A plane whose UVs go over so many UDIM tiles."""
        path = self.folder / "tiles.obj"
        path.write_text(re.sub(
            r"^vt (\S+)", lambda m: f"vt {columns * float(m[1])}",
            PLANE.read_text(), flags=re.M))
        return path

    def mask(self, *colours):
        """A mask of equal stripes, left to right."""
        return write_png(
            self.folder / "mask.png", 16 * len(colours), 16,
            lambda x, y: colours[x // 16])


class Several(MaskTest):
    def test_a_material_gets_its_exemplar(self):
        self.map("--also", f"{MATERIAL}={GRASS}")
        self.assertEqual(
            self.names(), ["out.mtl", "out.obj", "out_1.exr", "out_2.exr"])
        self.map(name="one.obj")
        several = Model(self.folder / "out.obj")
        one = Model(self.folder / "one.obj")
        self.assertEqual(several.points, one.points)
        self.assertEqual(several.faces, one.faces)
        self.assertEqual(set(several.textures), {"out_1.exr", "out_2.exr"})

    def test_a_mask_divides_the_surface(self):
        mask = self.mask((0, 0, 0), (255, 0, 0), (0, 255, 0))
        self.map("--also", GRASS, "--also", GRAVEL, "--mask", mask,
                 "--set", "transition=0", "--level", "4",
                 "--json-report", self.folder / "r.json", cage=PLANE)
        model = Model(self.folder / "out.obj")
        low = min(p[0] for p in model.points)
        width = max(p[0] for p in model.points) - low
        for face, texture in zip(model.faces, model.textures):
            u = sum(model.points[v][0] for v in face) / len(face)
            u = 3.0 * (u - low) / width
            if abs(u - round(u)) > 0.2 or round(u) in (0, 3):
                self.assertEqual(texture, f"out_{int(u) + 1}.exr")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(
            [e["faces"] for e in report["exemplars"]],
            [model.textures.count(f"out_{k}.exr") for k in (1, 2, 3)])
        self.assertGreater(report["transitions"]["length_texels"], 0)

    def test_a_grey_mask_divides_two(self):
        mask = write_png(
            self.folder / "mask.png", 32, 16, lambda x, y: (255 * (x // 16),),
            colour=0)
        self.map("--also", GRASS, "--mask", mask, cage=PLANE)
        self.assertEqual(
            set(Model(self.folder / "out.obj").textures),
            {"out_1.exr", "out_2.exr"})

    def test_a_mask_may_be_a_picture_a_tile(self):
        cage = self.tiles(2)
        for names in ("<UDIM>", "1001", "1002"), ("<UVTILE>", "u1_v1", "u2_v1"):
            for name, red in zip(names[1:], (0, 255)):
                write_png(self.folder / f"mask.{name}.png", 4, 4,
                          lambda x, y: (red, 0, 0))
            more = ("--also", GRASS, "--set", "transition=0", "-u", "--mask",
                    self.folder / f"mask.{names[0]}.png")
            self.map(*more, cage=cage)
            model = Model(self.folder / "out.obj")
            low = min(p[0] for p in model.points)
            half = low + (max(p[0] for p in model.points) - low) / 2
            for face, texture in zip(model.faces, model.textures):
                x = sum(model.points[v][0] for v in face) / len(face)
                self.assertEqual(texture, f"out_{1 + (x > half)}.exr")
        first = (self.folder / "out.obj").stat().st_mtime_ns
        self.map(*more, cage=cage)
        self.assertEqual((self.folder / "out.obj").stat().st_mtime_ns, first)
        write_png(self.folder / "mask.u1_v1.png", 4, 4,
                  lambda x, y: (255, 0, 0))
        self.map(*more, cage=cage)
        self.assertEqual(
            set(Model(self.folder / "out.obj").textures), {"out_2.exr"})

    def test_constraints_divide_the_surface(self):
        table = self.folder / "who.csv"
        table.write_text("".join(
            f"{f},0,0,0,1,{f % 2}\n" for f in range(16)))
        self.map("--also", GRASS, "--constraints", table,
                 "--set", "transition=0", cage=PLANE)
        faces = Model(self.folder / "out.obj").textures
        of = len(faces) // 16
        for f, texture in enumerate(faces):
            self.assertEqual(texture, f"out_{f // of % 2 + 1}.exr")

    def test_constraints_name_exemplars(self):
        rules = self.folder / "who.json"
        rules.write_text(json.dumps({"constraints": [
            {"face": 0, "exemplar": 1},
            {"face": 3, "exemplar": "grass_tile"},
            {"face": 12, "exemplar": "gravel_tile.png"},
            {"face": 15, "exemplar": str(GRAVEL)}]}))
        table = self.folder / "who.csv"
        table.write_text("face,x,y,z,scale,exemplar\n" + "".join(
            f"{f},0,0,0,1,{k}\n"
            for f, k in zip(range(16), (1,) * 3 + (2,) + 11 * (0,) + (3,))))
        for path in rules, table:
            self.map("--also", GRASS, "--also", GRAVEL, "--constraints", path,
                     "--set", "transition=0", cage=PLANE)
            faces = Model(self.folder / "out.obj").textures
            self.assertEqual(
                [faces[f * len(faces) // 16] for f in (0, 3, 15)],
                ["out_1.exr", "out_2.exr", "out_3.exr"])
        result = self.run_program(
            "field", PLANE, "-o", self.folder / "f.csv", "--constraints",
            rules)
        self.assert_exit(result, 0)
        self.assertIn("a field does not hold", result.stderr)

    def test_threads_do_not_matter(self):
        for threads in (1, 4):
            self.map("--also", f"{MATERIAL}={GRASS}", "--threads", threads,
                     name=f"t{threads}.obj")
        one, four = (
            # The seal is of a whole file, whose name stands in it.
            re.sub(r"seal \w+", "seal", (self.folder / f"t{n}.obj").read_text()
                   .replace(f"t{n}", "")) for n in (1, 4))
        self.assertEqual(one, four)

    def test_plain_meshes(self):
        self.map("--scheme", "none", "--level", "0", "--scale", "8",
                 "--also", f"{MATERIAL}={GRASS}")
        points = [l for l in (self.folder / "out.obj").read_text().splitlines()
                  if l.startswith("v ")]
        self.assertEqual(
            points, [l for l in CAGE.read_text().splitlines()
                     if l.startswith("v ")])

    def test_scales(self):
        self.map("--also", f"{MATERIAL}={GRASS}", "--scale", "2,0.7",
                 "--json-report", self.folder / "r.json")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertAlmostEqual(report["exemplars"][1]["scale"], 0.7, 1)

    def test_update_sees_the_other_exemplars(self):
        mask = self.mask((0, 0, 0), (255, 0, 0))
        other = self.folder / "other.png"
        other.write_bytes(GRASS.read_bytes())
        more = ("--also", other, "--mask", mask, "-u")
        self.map(*more, cage=PLANE)
        first = (self.folder / "out.obj").stat().st_mtime_ns
        self.map(*more, cage=PLANE)
        self.assertEqual((self.folder / "out.obj").stat().st_mtime_ns, first)
        self.mask((255, 0, 0), (0, 0, 0))
        self.map(*more, cage=PLANE)
        second = (self.folder / "out.obj").stat().st_mtime_ns
        self.assertNotEqual(second, first)
        other.write_bytes(GRAVEL.read_bytes())
        self.map(*more, cage=PLANE)
        self.assertNotEqual(
            (self.folder / "out.obj").stat().st_mtime_ns, second)
        (self.folder / "out_2.exr").unlink()
        self.map(*more, cage=PLANE)
        self.assertTrue((self.folder / "out_2.exr").exists())

    def test_a_bake_is_one_texture(self):
        result = self.run_program(
            "bake", CAGE, FIRST, "-o", self.folder / "out.obj", *QUICK,
            "--uvs", "atlas", "--resolution", "256", "--also",
            f"{MATERIAL}={GRASS}")
        self.assert_exit(result, 0)
        self.assertEqual(
            [n for n in self.names() if n.endswith(".exr")], ["out.1001.exr"])

    def test_a_dry_run_writes_nothing(self):
        result = self.map("--also", f"{MATERIAL}={GRASS}", "-n")
        self.assertIn(f"on the material {MATERIAL}", result.stdout)
        self.assert_nothing_written()


class Refused(MaskTest):
    def test_materials(self):
        self.refused(1, f"there are '{MATERIAL}'", "--also", f"moss={GRASS}")
        self.refused(
            1, "the cage has none", "--also", f"moss={GRASS}", cage=PLANE)
        self.refused(1, "nothing says where", "--also", GRASS)

    def test_words(self):
        self.refused(1, "--also takes", "--also", "moss=")
        self.refused(
            1, "up to 4", *(4 * ["--also", f"{MATERIAL}={GRASS}"]))
        self.refused(
            1, "--scale takes", "--also", f"{MATERIAL}={GRASS}", "--scale",
            "1,2,3")
        self.refused(
            1, "--scale takes", "--also", f"{MATERIAL}={GRASS}", "--scale",
            "1,-2")
        self.refused(3, "moss.png", "--also", f"{MATERIAL}=moss.png")

    def test_exemplars_of_constraints(self):
        rules = self.folder / "who.json"
        for value in (3, "moss"):
            rules.write_text(json.dumps(
                {"constraints": [{"face": 0, "exemplar": value}]}))
            self.refused(
                1, f"constraint 1 asks for exemplar {value}, which is not one "
                "of 1 'pebbles_tile.png', 2 'grass_tile.png'",
                "--also", GRASS, "--constraints", rules)
        self.refused(1, "asks for exemplar moss", "--constraints", rules)
        rules.write_text(json.dumps(
            {"constraints": [{"face": 0, "exemplar": "grass_tile"}]}))
        self.refused(
            1, "a number tells apart", "--also", GRASS, "--also", GRASS,
            "--constraints", rules)

    def test_other_methods(self):
        for method in ("material", "tile"):
            self.refused(
                2, "takes one exemplar", "--also", f"{MATERIAL}={GRASS}",
                "--method", method)

    def test_masks(self):
        green = self.mask((0, 255, 0))
        self.refused(
            1, "asks for exemplar 3, but there are 2", "--also", GRASS,
            "--mask", green, cage=PLANE)
        self.refused(1, "one is given", "--mask", green, cage=PLANE)
        self.refused(
            1, "has no UVs", "--also", GRASS, "--mask", green,
            cage=CAGES / "sphere.obj")
        text = self.folder / "mask.txt"
        text.write_text("no picture")
        self.refused(
            2, "mask.txt", "--also", GRASS, "--mask", text, cage=PLANE)
        self.refused(
            3, "nowhere.png", "--also", GRASS, "--mask", "nowhere.png",
            cage=PLANE)

    def test_masks_of_tiles(self):
        cage = self.tiles(2)
        write_png(self.folder / "mask.1001.png", 4, 4, lambda x, y: (0, 0, 0))
        several = ("--also", GRASS, "--mask")
        tiles = self.folder / "mask.<UDIM>.png"
        self.refused(
            3, "mask.1002.png: the mask has no picture of UDIM tile 1002",
            *several, tiles, cage=cage)
        self.refused(
            1, "named as mask.<UDIM>.exr", *several,
            self.folder / "mask.1001.png", cage=cage)
        self.refused(
            1, "outside of the UDIM tiles", *several, tiles,
            cage=self.tiles(-1))
        self.refused(
            1, "has no UVs", *several, tiles, cage=CAGES / "sphere.obj")

    def test_an_output_does_not_replace_an_input(self):
        other = self.folder / "out_2.exr"
        other.write_bytes(GRASS.read_bytes())
        self.refused(
            1, "would be replaced", "--also", f"{MATERIAL}={other}")

    def test_a_bake_does_not_replace_its_masks(self):
        for name in "out.1001.png", "out.<UDIM>.png":
            mask = self.folder / name.replace("<UDIM>", "1001")
            write_png(mask, 4, 4, lambda x, y: (255, 0, 0))
            before = mask.read_bytes()
            result = self.run_program(
                "bake", PLANE, FIRST, "-o", self.folder / "out.obj", *QUICK,
                "--also", GRASS, "--mask", self.folder / name,
                "--preview-png")
            self.assert_error(result, 1, "is an input")
            self.assertEqual(mask.read_bytes(), before)
            mask.unlink()
        mask = self.folder / "out_mask.1001.png"
        write_png(mask, 4, 4, lambda x, y: (255, 0, 0))
        self.assert_exit(
            self.run_program(
                "bake", PLANE, FIRST, "-o", self.folder / "out.obj", *QUICK,
                "--resolution", "64", "--also", GRASS, "--mask",
                self.folder / "out_mask.<UDIM>.png"), 0)

    def test_what_nobody_shows_is_a_warning(self):
        result = self.run_map(
            PLANE, FIRST, "--level", "2", "--also", GRASS, "--mask",
            self.mask((0, 0, 0)))
        self.assert_exit(result, 0)
        self.assertIn("no face shows exemplar 2", result.stderr)


if __name__ == "__main__":
    main()
