#!/usr/bin/env python3
"""Pastes as a run-time list: what is written shows what a bake does."""

import re
import struct
import zlib

from program import CAGES, EXEMPLARS, ProgramTest, main

CAGE = CAGES / "torus.obj"
PICTURE = EXEMPLARS / "gravel_tile.png"
HOW = ("--method", "lapped", "--level", "3", "--scale", "2")


def pixels(path):
    """Bytes of a PNG, 8 bits a channel."""
    data = path.read_bytes()
    width, height, _, kind = struct.unpack(">IIBB", data[16:26])
    size = {2: 3, 6: 4}[kind]
    packed = b"".join(
        data[m.end():m.end() + struct.unpack(
            ">I", data[m.start() - 4:m.start()])[0]]
        for m in re.finditer(b"IDAT", data))
    raw = zlib.decompress(packed)
    rows, before = [], bytes(width * size)
    for y in range(height):
        at = y * (width * size + 1)
        row, how = bytearray(raw[at + 1:at + 1 + width * size]), raw[at]
        for i in range(len(row)):
            a = row[i - size] if i >= size else 0
            b, c = before[i], before[i - size] if i >= size else 0
            if how == 4:
                p = a + b - c
                near = min((abs(p - a), 0, a), (abs(p - b), 1, b),
                           (abs(p - c), 2, c))[2]
            else:
                near = (0, a, b, (a + b) // 2)[how]
            row[i] = (row[i] + near) & 255
        rows.append(bytes(row))
        before = row
    return b"".join(rows)


class Pastes(ProgramTest):
    def draw(self, name):
        picture = self.folder / f"{name}.png"
        self.assert_exit(self.run_program(
            "render", self.folder / f"{name}.obj", "-o", picture, "--size",
            "160x120", "--samples", "4", "--unlit"), 0)
        return pixels(picture)

    def test_it_shows_what_a_bake_does(self):
        self.assert_exit(self.run_map(
            CAGE, PICTURE, *HOW, "--pastes", name="list.obj"), 0)
        self.assert_exit(self.run_map(CAGE, PICTURE, *HOW, name="bake.obj"), 0)
        a, b = self.draw("list"), self.draw("bake")
        self.assertGreater(max(a) - min(a), 100)
        difference = sum(abs(x - y) for x, y in zip(a, b)) / len(a) / 255
        self.assertLess(difference, 0.004)

    def test_layers_and_materials(self):
        result = self.run_map(CAGE, PICTURE, *HOW, "--pastes", "-v")
        self.assert_exit(result, 0)
        self.assertIn("that of a bake", result.stderr)
        text = (self.folder / "out.obj").read_text()
        groups = re.findall("^g layer_([0-9]+)$", text, re.M)
        self.assertEqual(groups, [str(i) for i in range(len(groups))])
        self.assertGreater(len(groups), 2)
        library = (self.folder / "out.mtl").read_text()
        self.assertIn("map_d out_pastes.exr", library)
        self.assertEqual(library.count("newmtl"), 2)
        usd = (self.folder / "out.usda").read_text()
        self.assertEqual(usd.count("def GeomSubset"), len(groups))

    def test_another_picture_in_the_same_outlines(self):
        """The mesh stays, and what it looks up is cut out of the other."""
        saved = self.folder / "it.osdtex"
        how = (*HOW, "--level", "2", "--pastes")
        self.assert_exit(self.run_map(
            CAGE, PICTURE, *how, "--save", saved, name="a.obj"), 0)
        self.assert_exit(self.run_program(
            "map", "--from", saved, CAGE, EXEMPLARS / "spots_tile.png",
            "--pastes", "-o", self.folder / "b.obj"), 0)

        def mesh(name):
            return [line for line in (self.folder / name).read_text().splitlines()
                    if line[:2] in ("v ", "vt", "f ", "g ")]

        self.assertEqual(mesh("a.obj"), mesh("b.obj"))
        self.assertNotEqual(
            self.picture("a_pastes.exr"), self.picture("b_pastes.exr"))

    def test_maps_of_a_material_come_along(self):
        self.assert_exit(self.run_program(
            "map", CAGE, *HOW, "--level", "2", "--pastes", "--material",
            EXEMPLARS.parent / "materials" / "waves", "-o",
            self.folder / "out.obj"), 0)
        library = (self.folder / "out.mtl").read_text()
        for name in "out", "out_pastes":
            self.assertIn(f"norm {name}_normal.exr", library)
            self.assertTrue((self.folder / f"{name}_normal.exr").exists())

    def test_is_up_to_date_with_all_its_files(self):
        how = (*HOW, "--level", "2", "--pastes", "-u")
        self.assert_exit(self.run_map(CAGE, PICTURE, *how), 0)
        again = self.run_map(CAGE, PICTURE, *how)
        self.assertIn("is up to date", again.stderr)
        for name in "out_pastes.exr", "out.usda":
            (self.folder / name).unlink()
            self.assert_exit(self.run_map(CAGE, PICTURE, *how), 0)
            self.assertTrue((self.folder / name).exists())

    def test_what_has_no_pastes_is_refused(self):
        result = self.run_map(
            CAGE, PICTURE, "--level", "1", "--pastes")
        self.assert_error(result, 2, "method lapped")
        self.assert_nothing_written()
        result = self.run_map(CAGE, PICTURE, *HOW, "--pastes", "--bake")
        self.assertEqual(result.returncode, 1)


if __name__ == "__main__":
    main()
