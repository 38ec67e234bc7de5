#!/usr/bin/env python3
"""Plain meshes, --scheme none: what comes in goes out, with UVs."""

import json
import random

from program import CAGES, EXEMPLARS, SHARED, ProgramTest, main

EXEMPLAR = EXEMPLARS / "gravel_tile.png"
TORUS = CAGES / "torus.obj"
QUICK = ("--set", "angles=4", "--set", "coarse=2")
BUNNY = SHARED / "meshes" / "stanford_bunny_7k.obj"

# Numbers in other forms than osdtex would print, colours, a comment, a
# continued line, a vertex without faces; four faces at an edge, a face that is
# wound against its neighbour, and one that is there twice.
MESSY = """\
v 0 0 0\r
v 1.50e0 0 0.000 0.5 0.25 1\r
v 0\t1 -0 # the top\r
v 0 0 +1\r
v -1 \\\r
 0 0\r
v 0 -1 0\r
v 9 9 9\r
f 1 2 3
f 1 2 4
f 2 1 6
f 1 3 4
f -7 3 5
f 1 2 3
"""
MESSY_POINTS = [
    "v 0 0 0", "v 1.50e0 0 0.000 0.5 0.25 1", "v 0\t1 -0 # the top",
    "v 0 0 +1", "v -1     0 0", "v 0 -1 0", "v 9 9 9"]
MESSY_FACES = [[1, 2, 3], [1, 2, 4], [2, 1, 6], [1, 3, 4], [1, 3, 5],
               [1, 2, 3]]




def junctions(side):
    """A curved sheet; T-junctions between rows closed by flat triangles."""
    points, rows, faces = [], [], []

    def point(x, y):
        points.append(f"v {x} {y} {(x - side) * (x - side) / 16 + y * y / 64}")
        return len(points)

    for y in range(side + 1):
        corners = [point(2 * x, y) for x in range(side + 1)]
        ends = [points[i - 1].split() for i in corners]
        middles = []
        for a, b in zip(ends, ends[1:]):
            points.append("v " + " ".join(
                str((float(p) + float(q)) / 2) for p, q in zip(a[1:], b[1:])))
            middles.append(len(points))
        rows.append((corners, middles))
    for (low, middles), (high, _) in zip(rows, rows[1:]):
        for x in range(side):
            a, b, c, d, m = (
                low[x], low[x + 1], high[x + 1], high[x], middles[x])
            faces += [(a, m, d), (m, c, d), (m, b, c)]
    for (corners, middles), _ in zip(rows[1:-1], rows):
        for x in range(side):
            faces.append((corners[x], corners[x + 1], middles[x]))
    return "".join(p + "\n" for p in points) + "".join(
        "f %d %d %d\n" % f for f in faces)


def crumpled(side):
    """A sheet whose points are off by more than its edges are long."""
    noise = random.Random(1)
    points = [
        (x + noise.uniform(-0.6, 0.6), y + noise.uniform(-0.6, 0.6),
         noise.uniform(-3, 3))
        for y in range(side + 1) for x in range(side + 1)]
    faces = []
    for y in range(side):
        for x in range(side):
            a = y * (side + 1) + x + 1
            b = a + side + 1
            faces += [(a, a + 1, b + 1), (a, b + 1, b)]
    return "".join("v %r %r %r\n" % p for p in points) + "".join(
        "f %d %d %d\n" % f for f in faces)


def uv_areas(path):
    uvs = [[float(x) for x in line.split()[1:3]] for line in lines(path, "vt")]
    for line in lines(path, "f"):
        a, b, c = (uvs[int(p.split("/")[1]) - 1] for p in line.split()[1:])
        yield ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def lines(path, word):
    return [line for line in path.read_text().splitlines()
            if line.startswith(word + " ")]


def faces(path):
    return [[int(c.split("/")[0]) for c in line.split()[1:]]
            for line in lines(path, "f")]


class Plain(ProgramTest):
    def plain(self, mesh, *more, **keywords):
        return self.run_map(
            mesh, EXEMPLAR, "--scheme", "none", *QUICK, *more, **keywords)

    def messy(self):
        path = self.folder / "messy.obj"
        path.write_bytes(MESSY.encode())
        return path

    def test_points_and_faces_stay(self):
        self.assert_exit(self.plain(TORUS), 0)
        out = self.folder / "out.obj"
        self.assertEqual(lines(out, "v"), lines(TORUS, "v"))
        self.assertEqual(faces(out), faces(TORUS))
        for line in lines(out, "f"):
            self.assertEqual(line.count("/"), len(line.split()) - 1)

    def test_what_is_no_manifold_is_cut(self):
        result = self.plain(self.messy(), "--scale", "2")
        self.assert_exit(result, 0)
        self.assertIn("messy.obj:9: 4 faces share the edge", result.stderr)
        self.assertIn("are wound against each other", result.stderr)
        out = self.folder / "out.obj"
        self.assertEqual(lines(out, "v"), MESSY_POINTS)
        self.assertEqual(faces(out), MESSY_FACES)

    def test_faces_without_area_are_not_reversed(self):
        mesh = self.folder / "junctions.obj"
        mesh.write_text(junctions(8))
        report = self.folder / "out.json"
        self.assert_exit(
            self.plain(mesh, "--scale", "6", "--json-report", report), 0)
        distortion = json.loads(report.read_text())["distortion"]
        self.assertEqual(distortion["flips"], 0)
        self.assertGreater(min(uv_areas(self.folder / "out.obj")), 0)

    def test_crumpled_faces_are_not_reversed(self):
        mesh = self.folder / "crumpled.obj"
        mesh.write_text(crumpled(20))
        report = self.folder / "out.json"
        self.assert_exit(
            self.plain(mesh, "--json-report", report, *QUICK, "--set",
                       "cut=off", "--set", "relax=off"), 0)
        distortion = json.loads(report.read_text())["distortion"]
        self.assertEqual(distortion["flips"], 0)

    def test_a_cage_must_be_a_manifold(self):
        result = self.run_map(self.messy(), EXEMPLAR, "--scheme", "bilinear")
        self.assert_error(result, 2, "face 5 has the same corners as face 0")

    def test_the_level_is_0(self):
        self.assert_exit(self.plain(TORUS, "--level", "0"), 0)
        result = self.plain(TORUS, "--level", "2", name="two.obj")
        self.assert_error(result, 1, "a plain mesh is not subdivided")

    def test_coarse_faces_are_warned_of(self):
        result = self.plain(TORUS, "--scale", "0.5", "-n")
        self.assertIn("seams can only run along them", result.stderr)

    def test_other_commands(self):
        result = self.run_program("info", TORUS, "--scheme", "none")
        self.assertIn("a plain mesh, textured as it is", result.stdout)
        baked = self.folder / "baked.obj"
        result = self.run_program(
            "bake", TORUS, EXEMPLAR, "--scheme", "none", *QUICK, "-o", baked,
            "--resolution", "256")
        self.assert_exit(result, 0)
        self.assertEqual(
            lines(self.folder / "baked_cage.obj", "v"), lines(TORUS, "v"))
        self.assertIn(
            'subdivisionScheme = "none"',
            (self.folder / "baked.usda").read_text())

    def test_bunny(self):
        if not BUNNY.exists():
            self.skipTest("shared data is not here")
        report = self.folder / "out.json"
        result = self.plain(BUNNY, "--scale", "2", "--json-report", report)
        self.assert_exit(result, 0)
        data = json.loads(report.read_text())
        self.assertEqual(data["options"]["scheme"], "none")
        self.assertEqual(data["distortion"]["flips"], 0)
        self.assertEqual(data["distortion"]["uncovered"], 0)
        self.assertLess(data["distortion"]["stretch_l2_mean"], 1.08)
        out = self.folder / "out.obj"
        self.assertEqual(lines(out, "v"), lines(BUNNY, "v"))
        self.assertEqual(faces(out), faces(BUNNY))


if __name__ == "__main__":
    main()
