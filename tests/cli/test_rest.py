#!/usr/bin/env python3
"""Mappings that are made at rest and go with the faces of an animation.

    test_rest.py OSDTEX
"""

import json

from program import CAGES, EXEMPLARS, ProgramTest, main

CAGE = CAGES / "torus.obj"
EXEMPLAR = EXEMPLARS / "gravel_tile.png"
HOW = ("--level", "1", "--scale", "2")


def words(path, first):
    return [line for line in path.read_text().splitlines()
            if line.startswith(first + " ")]


class Rest(ProgramTest):
    def frame(self, number):
        """The cage, bent."""
        lines = []
        for line in CAGE.read_text().splitlines():
            if line.startswith("v "):
                x, y, z = map(float, line.split()[1:4])
                line = f"v {x} {y + 0.1 * number * x * x} {z * (1 + number)}"
            lines.append(line)
        path = self.folder / f"frame{number}.obj"
        path.write_text("\n".join(lines) + "\n")
        return path

    def map(self, cage, *more, name):
        self.assert_exit(self.run_map(
            cage, EXEMPLAR, *HOW, *more, name=f"{name}.obj"), 0)
        return self.folder / f"{name}.obj"

    def test_uvs_are_the_same_on_every_frame(self):
        rest = self.map(CAGE, name="rest")
        for number in (1, 2):
            made = self.map(
                self.frame(number), "--rest", CAGE, name=f"out{number}")
            self.assertEqual(words(made, "vt"), words(rest, "vt"))
            self.assertNotEqual(words(made, "v"), words(rest, "v"))

    def test_usd_has_the_rest_positions(self):
        self.assert_exit(self.run_program(
            "bake", self.frame(1), EXEMPLAR, *HOW, "--rest", CAGE,
            "--resolution", "64", "-o", self.folder / "b.obj"), 0)
        text = (self.folder / "b.usda").read_text()
        at = text.index("point3f[] primvars:Pref = ")
        self.assertIn('interpolation = "vertex"', text[at:].split("\n\n")[0])
        first = text[at:].split("[(", 1)[1].split(")", 1)[0]
        expected = [float(x) for x in words(CAGE, "v")[0].split()[1:4]]
        for a, b in zip(map(float, first.split(",")), expected):
            self.assertAlmostEqual(a, b, 5)

    def test_a_saved_mapping_remembers_its_rest(self):
        saved = self.folder / "m.osdtex"
        self.map(self.frame(1), "--rest", CAGE, "--save", saved, name="out")
        report = self.folder / "r.json"
        self.assert_exit(self.run_map(
            CAGE, EXEMPLAR, "--keep", saved, "--json-report", report,
            name="kept.obj"), 0)
        kept = json.loads(report.read_text())["mapping"]["kept"]
        self.assertEqual(kept["moved"] + kept["covered"], 0)

    def test_other_faces_are_refused(self):
        self.assert_error(
            self.run_map(CAGES / "sphere.obj", EXEMPLAR, *HOW, "--rest", CAGE),
            1, "other faces than the one at rest")
        self.assert_nothing_written()


if __name__ == "__main__":
    main()
