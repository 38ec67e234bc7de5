#!/usr/bin/env python3
"""Pictures with a top are laid upright unless somebody says otherwise."""

import math

from program import CAGES, EXEMPLARS, ProgramTest, main

BRICKS = EXEMPLARS / "bricks_tile.png"
GRAVEL = EXEMPLARS / "gravel_tile.png"
SPHERE = CAGES / "sphere.obj"
QUICK = ("--level", 3, "--set", "coarse=2", "--set", "relax-rounds=2")


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def top_of(corners, uvs):
    """The way along which v grows on a face, of unit length, by its first
    three corners."""
    a, b = minus(corners[1], corners[0]), minus(corners[2], corners[0])
    s, t = minus(uvs[1], uvs[0]), minus(uvs[2], uvs[0])
    area = s[0] * t[1] - s[1] * t[0]
    way = [(s[0] * y - t[0] * x) / area for x, y in zip(a, b)]
    length = math.sqrt(sum(x * x for x in way))
    return [x / length for x in way]


class UprightTest(ProgramTest):
    def sides(self, *more):
        """How far up the picture's top points on the faces that stand upright,
        1 straight up, and what was said."""
        result = self.run_map(SPHERE, BRICKS, *QUICK, *more)
        self.assert_exit(result, 0)
        points, uvs, ups = [], [], []
        for line in (self.folder / "out.obj").read_text().splitlines():
            words = line.split()
            if words[:1] == ["v"]:
                points.append([float(x) for x in words[1:4]])
            elif words[:1] == ["vt"]:
                uvs.append([float(x) for x in words[1:3]])
            elif words[:1] == ["f"]:
                pairs = [w.split("/") for w in words[1:4]]
                corners = [points[int(p[0]) - 1] for p in pairs]
                if abs(corners[0][1]) < 0.3 * max(
                        abs(x) for x in corners[0]):
                    ups.append(top_of(
                        corners, [uvs[int(p[1]) - 1] for p in pairs])[1])
        self.assertGreater(len(ups), 10)
        return ups, result.stderr

    def test_bricks_stand_upright(self):
        ups, said = self.sides()
        self.assertIn("is laid upright", said)
        self.assertGreater(sum(ups) / len(ups), 0.95)
        self.assertGreater(min(ups), 0.5)

    def test_what_is_said_counts(self):
        _, said = self.sides("--follow", "smooth")
        self.assertNotIn("upright", said)
        _, said = self.sides("--exemplar-class", "directional")
        self.assertNotIn("upright", said)

    def test_gravel_has_no_top(self):
        result = self.run_map(SPHERE, GRAVEL, *QUICK)
        self.assert_exit(result, 0)
        self.assertNotIn("upright", result.stderr)


if __name__ == "__main__":
    main()
