#!/usr/bin/env python3
"""Cages and pictures as people have them: parts that only touch, places far
away from the origin.

    test_reading.py OSDTEX
"""

import json

from program import EXEMPLARS, ProgramTest, main

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


def lines(path, key):
    return [l.split()[1:] for l in path.read_text().splitlines()
            if l.split()[:1] == [key]]


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
        for suffix in (".csv", ".png", ".exr"):
            self.assertEqual(
                (self.folder / (near + suffix)).read_bytes(),
                (self.folder / (far + suffix)).read_bytes(), suffix)
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
