"""test_stack.py -- osdtex stack: slices between two pictures."""

import json
import re
import struct
import sys
import unittest

from program import CAGES, EXEMPLARS, ProgramTest

SPOTS = EXEMPLARS / "spots_tile.png"
PEBBLES = EXEMPLARS / "pebbles_tile.png"
WAVES = EXEMPLARS.parent / "materials/waves"
SMALL = ("--size", 64, "--slices", 3)


class Stack(ProgramTest):
    def stack(self, *words, name="a.exr"):
        return self.run_program("stack", *words, "-o", self.folder / name)

    def test_a_stack_and_its_masks_are_written(self):
        result = self.stack(SPOTS, PEBBLES, *SMALL)
        self.assert_exit(result, 0)
        self.assertIn("3 slices of 64 x 64", result.stderr)
        self.assertEqual(
            sorted(p.name for p in self.folder.iterdir()),
            ["a.exr", "a_mask1.png", "a_mask2.png"])
        known = self.run_program("info", self.folder / "a.exr")
        self.assertIn("slices      3 along an axis", known.stdout)
        # Every part is a picture like any other.
        for part in "m000", "m001", "m002", "mask001":
            self.assert_exit(
                self.run_program(
                    "info", self.folder / "a.exr", "--layer", part), 0)

    def test_the_same_bytes_on_one_thread(self):
        for name, threads in ("a.exr", 1), ("b.exr", 3):
            self.assert_exit(self.stack(
                SPOTS, PEBBLES, *SMALL, "--threads", threads, name=name), 0)
        self.assertEqual(self.picture("a.exr"), self.picture("b.exr"))

    def test_masks_that_were_found_can_be_given(self):
        self.assert_exit(self.stack(SPOTS, PEBBLES, *SMALL), 0)
        masks = ",".join(
            str(self.folder / f"a_mask{k}.png") for k in (1, 2))
        self.assert_exit(self.stack(
            SPOTS, PEBBLES, *SMALL, "--masks", masks, name="b.exr"), 0)
        self.assertEqual(self.picture("a.exr"), self.picture("b.exr"))
        # They are inputs, and not written over.
        self.assert_error(
            self.stack(SPOTS, PEBBLES, *SMALL, "--masks", masks, "--replace"),
            1, "is an input")

    def test_three_pictures_in_a_row(self):
        result = self.stack(SPOTS, PEBBLES, SPOTS, *SMALL)
        self.assert_exit(result, 0)
        self.assertIn("5 slices", result.stderr)

    def test_figures_are_told(self):
        result = self.stack(SPOTS, PEBBLES, *SMALL)
        self.assertRegex(
            result.stderr, r"of the worst slice: features .* \d\.\d+; contrast")

    def test_a_set_goes_through(self):
        """What only one picture has is flat in the other."""
        result = self.stack(WAVES, PEBBLES, *SMALL)
        self.assert_exit(result, 0)
        self.assertIn("has a normal map and this one has none", result.stderr)
        for part in "normal000", "roughness001", "height002", "metalness001":
            self.assert_exit(
                self.run_program(
                    "info", self.folder / "a.exr", "--layer", part), 0)
        words = ("--scale", 1, "--level", 2, "--resolution", 64, "--along", "x")
        kinds = "normal", "roughness", "height", "metalness", "occlusion"
        saved = self.folder / "m.osdtex"
        self.assert_exit(self.run_program(
            "bake", CAGES / "plane.obj", self.folder / "a.exr", "-o",
            self.folder / "b.obj", "--save", saved, *words), 0)
        self.assert_exit(self.run_program(
            "bake", "--from", saved, "-o", self.folder / "c.obj",
            "--resolution", 64), 0)
        for kind in kinds:
            self.assertEqual(
                self.picture(f"b_{kind}.1001.exr"),
                self.picture(f"c_{kind}.1001.exr"), kind)
        # They are known beforehand, and not written over.
        for kind in kinds:
            (self.folder / f"d_{kind}.1001.exr").write_text("mine")
            self.assert_error(
                self.run_program(
                    "bake", CAGES / "plane.obj", self.folder / "a.exr", "-o",
                    self.folder / "d.obj", *words), 1, "d_" + kind)
            (self.folder / f"d_{kind}.1001.exr").unlink()
        # Along the axis they change: from waves to what is flat.
        self.assert_exit(self.run_program(
            "bake", CAGES / "plane.obj", self.folder / "a.exr", "-o",
            self.folder / "e.obj", *words[:-1], "-x"), 0)
        for kind in kinds:
            self.assertNotEqual(
                self.picture(f"b_{kind}.1001.exr"),
                self.picture(f"e_{kind}.1001.exr"), kind)

    def test_what_cannot_be_stacked(self):
        open_picture = EXEMPLARS / "stones_open.png"
        for words, code, sentence in (
                ((SPOTS,), 1, "EXEMPLAR"),
                ((SPOTS, PEBBLES, "--slices", 1), 1, "2 to 64"),
                ((SPOTS, PEBBLES, "--morph", "fade"), 1, "advect"),
                ((SPOTS, open_picture, "--tileable", "keep", *SMALL), 2,
                 "does not; make it"),
                ((SPOTS, self.folder / "none.png"), 3, "none.png"),
                ((SPOTS, PEBBLES, "--masks", "a,b,c"), 1, "3 files")):
            result = self.stack(*words)
            self.assertIn(
                sentence, result.stderr, f"{words}\n{result.stderr}")
            self.assert_exit(result, code)
            self.assert_nothing_written()

    def test_a_mask_without_a_feature(self):
        empty = self.folder / "empty.ppm"
        self.need(modules=("PIL",))
        from PIL import Image
        empty = self.folder / "empty.png"
        Image.new("RGB", (64, 64)).save(empty)
        result = self.stack(SPOTS, PEBBLES, *SMALL, "--masks", empty)
        self.assert_error(result, 2, "first picture is empty")
        self.assertEqual(
            [p.name for p in self.folder.iterdir()], ["empty.png"])
        for size, light, sentence in (
                ((64, 64), 255, "first picture is full"),
                ((64, 32), 255, "another shape")):
            Image.new("RGB", size, (light,) * 3).save(empty)
            other = self.folder / "other.png"
            Image.new("RGB", (64, 64)).save(other)
            result = self.stack(
                SPOTS, PEBBLES, *SMALL, "--masks", f"{empty},{other}")
            self.assert_error(result, 2, sentence)
            self.assertFalse((self.folder / "a.exr").exists())

    def test_ends_of_other_sizes(self):
        """They get the size of the first, which is said."""
        result = self.stack(WAVES / "waves_color.png", PEBBLES, "--slices", 3)
        self.assert_exit(result, 0)
        self.assertIn("scaled from 256 x 256 to 128 x 128", result.stderr)

    def test_a_stack_that_is_cut_off(self):
        self.assert_exit(self.stack(SPOTS, PEBBLES, *SMALL), 0)
        stack = self.folder / "a.exr"
        whole = stack.read_bytes()
        for length in 100, len(whole) // 4, len(whole) // 2:
            stack.write_bytes(whole[:length])
            result = self.run_map(
                CAGES / "torus.obj", stack, "--scale", 4, "--level", 0)
            self.assert_error(result, 2, "a.exr")
            self.assertFalse((self.folder / "out.obj").exists())

    def test_places_beyond_the_axis(self):
        self.assert_exit(self.stack(SPOTS, PEBBLES, *SMALL), 0)
        rules = self.folder / "rules.json"
        for material in -0.1, 1.5:
            rules.write_text(json.dumps(
                {"constraints": [{"face": 0, "material": material}]}))
            result = self.run_map(
                CAGES / "torus.obj", self.folder / "a.exr", "--scale", 4,
                "--level", 0, "--constraints", rules)
            self.assert_error(result, 2, "material")
            self.assertFalse((self.folder / "out.obj").exists())

    def test_slices_on_a_surface(self):
        self.assert_exit(self.stack(SPOTS, PEBBLES, *SMALL), 0)
        stack, saved = self.folder / "a.exr", self.folder / "m.osdtex"
        words = ("--scale", 1, "--level", 2, "--resolution", 128)
        cage = CAGES / "plane.obj"
        self.assert_exit(self.run_program(
            "bake", cage, stack, "-o", self.folder / "b.obj", *words,
            "--along", "x", "--save", saved), 0)
        again = self.run_program(
            "bake", "--from", saved, "-o", self.folder / "c.obj",
            "--resolution", 128)
        self.assert_exit(again, 0)
        self.assertEqual(self.picture("b.1001.exr"), self.picture("c.1001.exr"))
        # The other way along is another picture, and one slice is a third.
        for name, more in ("d", ("--along", "-x")), ("e", ("--layer", "m000")):
            self.assert_exit(self.run_program(
                "bake", cage, stack, "-o", self.folder / f"{name}.obj",
                *words, *more), 0)
            self.assertNotEqual(
                self.picture("b.1001.exr"),
                self.picture(f"{name}.1001.exr"))
        self.assert_error(
            self.run_program(
                "bake", cage, stack, "-o", self.folder / "f.obj", *words,
                "--along", "up"), 1, "--along is x, y, z, curvature")

    def along(self, *more, cage=CAGES / "torus.obj"):
        """The coordinate of the vertices of a cage, a torus, that is not
        refined, and its faces."""
        saved = self.folder / "t.osdtex"
        self.assert_exit(self.run_program(
            "bake", cage, self.folder / "a.exr", "-o", self.folder / "t.obj",
            "--scale", 4, "--level", 0, "--resolution", 64, "--save", saved,
            *more), 0)
        whole = saved.read_bytes()
        length = int.from_bytes(whole[:8], "little")
        begin, end = json.loads(whole[8:8 + length])["along"]["data_offsets"]
        values = whole[8 + length + begin:8 + length + end]
        faces = [
            [int(corner.split("/")[0]) - 1 for corner in line.split()[1:]]
            for line in cage.read_text().splitlines() if line.startswith("f ")]
        return struct.unpack(f"<{len(values) // 4}f", values), faces

    def test_the_surface_says_where_slices_go(self):
        self.assert_exit(self.stack(SPOTS, PEBBLES, *SMALL), 0)
        found = {}
        for axis in "curvature", "ridges", "occlusion", "-ridges":
            values, _ = self.along("--along", axis)
            found[axis] = values
            self.assertTrue(all(0 <= v <= 1 for v in values), axis)
            self.assertGreater(max(values) - min(values), 0.2, axis)
        for ridge, other in zip(found["ridges"], found["-ridges"]):
            self.assertAlmostEqual(ridge, 1 - other, delta=1e-6)
        # The ridge of a ring is its outside, where the sky is seen.
        outside = max(
            range(len(values)), key=lambda v: found["ridges"][v])
        self.assertLess(found["occlusion"][outside], 0.2)

    def test_colours_of_vertices_say_where_slices_go(self):
        self.assert_exit(self.stack(SPOTS, PEBBLES, *SMALL), 0)
        cage, greens = self.folder / "painted.obj", []
        lines = (CAGES / "torus.obj").read_text().splitlines()
        for i, line in enumerate(lines):
            if line.startswith("v "):
                greens.append(len(greens) % 5 / 4)
                lines[i] = f"{line} 0.5 {greens[-1]} 0"
        cage.write_text("\n".join(lines) + "\n")
        values, _ = self.along("--along", "green", cage=cage)
        for value, green in zip(values, greens):
            self.assertAlmostEqual(value, green, delta=1e-6)

    def test_a_picture_says_where_slices_go(self):
        """What lies on the two sides of a cut in the UVs is one place."""
        self.need(modules=("PIL",))
        from PIL import Image
        self.assert_exit(self.stack(SPOTS, PEBBLES, *SMALL), 0)
        ramp = self.folder / "ramp.png"
        picture = Image.new("L", (256, 8))
        picture.putdata([x for _ in range(8) for x in range(256)])
        picture.save(ramp)
        cage = CAGES / "uv_seams.obj"
        values, faces = self.along("--along", f"map:{ramp}", cage=cage)
        lines = cage.read_text().splitlines()
        us = [float(l.split()[1]) for l in lines if l.startswith("vt ")]
        corners = [
            [int(c.split("/")[1]) - 1 for c in l.split()[1:]]
            for l in lines if l.startswith("f ")]
        sums = {}
        for face, indices in zip(faces, corners):
            for vertex, uv in zip(face, indices):
                u = min(max(us[uv] * 256 - 0.5, 0), 255) / 255
                sums.setdefault(vertex, []).append(u)
        for vertex, known in sums.items():
            self.assertAlmostEqual(
                values[vertex], sum(known) / len(known), delta=0.01)
        turned, _ = self.along("--along", f"-map:{ramp}", cage=cage)
        for a, b in zip(values, turned):
            self.assertAlmostEqual(a, 1 - b, delta=1e-6)

    def test_pictures_that_say_nothing_of_slices(self):
        self.assert_exit(self.stack(SPOTS, PEBBLES, *SMALL), 0)
        for file, cage, code, sentence in (
                (self.folder / "none.png", "uv_seams.obj", 3, "none.png"),
                (SPOTS, "torus.obj", 1, "has no UVs"),
                ("", "uv_seams.obj", 1, "--along is x, y, z")):
            result = self.run_map(
                CAGES / cage, self.folder / "a.exr", "--scale", 4, "--level",
                0, "--along", f"map:{file}")
            self.assert_error(result, code, sentence)
            self.assertFalse((self.folder / "out.obj").exists())

    def test_slices_by_chance(self):
        """Whole slices, each of them somewhere; shorter ways, more of them."""
        self.assert_exit(self.stack(SPOTS, "--vary", *SMALL), 0)
        values, faces = self.along("--along", "scatter:0.5")
        self.assertEqual({round(2 * v, 5) for v in values}, {0.0, 1.0, 2.0})

        def borders(values):
            return sum(
                len({values[v] for v in face}) > 1 for face in faces)
        longer, _ = self.along("--along", "scatter:2")
        self.assertLess(borders(longer), borders(values))

    def test_a_picture_that_varies(self):
        result = self.stack(SPOTS, "--vary", "--size", 64)
        self.assert_exit(result, 0)
        self.assertIn("4 slices of 64 x 64 texels, masks shared", result.stderr)
        found = re.search(r"asked for ([\d.]+)", result.stderr)
        self.assertGreater(float(found.group(1)), 0.9)
        self.assert_error(self.stack(SPOTS), 1, "or one with --vary")
        self.assert_error(
            self.stack(SPOTS, PEBBLES, "--vary"), 1, "or one with --vary")

    def test_slices_are_told_beside_uvs(self):
        """In an OBJ as the third coordinate, in USD as a primvar; vertices of
        the cage are those of its level."""
        self.assert_exit(self.stack(SPOTS, PEBBLES, *SMALL), 0)
        values, faces = self.along("--along", "x")
        self.assert_exit(self.run_map(
            CAGES / "torus.obj", self.folder / "a.exr", "--scale", 4,
            "--level", 0, "--along", "x", "--resolution", 512), 0)
        lines = (self.folder / "out.obj").read_text().splitlines()
        depths = [float(l.split()[3]) for l in lines if l.startswith("vt ")]
        corners = [l.split()[1:] for l in lines if l.startswith("f ")]
        self.assertEqual(len(corners), len(faces))
        for corner in sum(corners, []):
            vertex, uv = corner.split("/")[:2]
            self.assertAlmostEqual(
                depths[int(uv) - 1], values[int(vertex) - 1], delta=1e-5)
        usda = (self.folder / "t.usda").read_text()
        told = re.search(r"float\[\] primvars:slice = \[([^]]*)\]", usda)
        for value, vertex in zip(
                map(float, told.group(1).split(",")), sum(faces, [])):
            self.assertAlmostEqual(value, values[vertex], delta=1e-5)
        # Other exemplars have no such axis.
        self.assert_exit(self.run_map(
            CAGES / "torus.obj", SPOTS, "--scale", 4, "--level", 0,
            name="plain.obj"), 0)
        self.assertRegex(
            (self.folder / "plain.obj").read_text(), r"\nvt \S+ \S+\n")

    def test_the_slice_of_a_texel_is_baked(self):
        """From left to right of a square it goes from 0 to 1."""
        self.assert_exit(self.stack(SPOTS, PEBBLES, *SMALL), 0)
        self.assert_exit(self.run_program(
            "bake", CAGES / "plane.obj", self.folder / "a.exr", "-o",
            self.folder / "b.obj", "--scale", 1, "--level", 2, "--resolution",
            64, "--along", "x", "--extra", "slice"), 0)
        known = self.run_program("info", self.folder / "b_slice.1001.exr")
        self.assertIn("64 x 64", known.stdout)
        self.assertIn("3 channels, float", known.stdout)

    def test_what_a_cage_has_none_of(self):
        self.assert_exit(self.stack(SPOTS, PEBBLES, *SMALL), 0)
        for axis, sentence in (
                ("boundary", "has none of"), ("creases", "has none of"),
                ("red", "colours of vertices"), ("x:1", "is x, y, z"),
                ("boundary:-1", "is x, y, z"), ("boundary:", "is x, y, z")):
            result = self.run_map(
                CAGES / "torus.obj", self.folder / "a.exr", "--scale", 4,
                "--level", 0, "--along", axis)
            self.assertIn(sentence, result.stderr, axis)
            self.assertNotEqual(result.returncode, 0, axis)
            self.assertFalse((self.folder / "out.obj").exists())

    def test_constraints_say_where_slices_go(self):
        self.assert_exit(self.stack(SPOTS, PEBBLES, *SMALL), 0)
        asked = {0: 0.2, 50: 0.9}
        rules = self.folder / "rules.json"
        rules.write_text(json.dumps({"constraints": [
            {"face": f, "material": m} for f, m in asked.items()]}))
        values, faces = self.along("--constraints", rules)
        for face, material in asked.items():
            for vertex in faces[face]:
                self.assertAlmostEqual(values[vertex], material, delta=0.02)
        self.assertTrue(all(0.2 - 1e-4 <= v <= 0.9 + 1e-4 for v in values))
        self.assertGreater(len(set(values)), 20)

    def test_a_material_without_slices_is_said(self):
        rules = self.folder / "rules.json"
        rules.write_text('{"constraints": [{"face": 0, "material": 0.5}]}')
        result = self.run_map(
            CAGES / "torus.obj", SPOTS, "--level", 1, "--scale", 4,
            "--constraints", rules)
        self.assert_exit(result, 0)
        self.assertIn("the exemplar has one only", result.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
