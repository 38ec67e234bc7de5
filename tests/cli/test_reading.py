#!/usr/bin/env python3
"""Cages and pictures as people have them: parts that only touch.

    test_reading.py OSDTEX
"""

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


if __name__ == "__main__":
    main()
