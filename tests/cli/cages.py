"""cages -- random cages as OBJ text, good and bad, each from its seed.

A cage begins as one of a few shapes, is changed at random (faces cut, raised,
removed, turned over, doubled, vertices joined or pulled apart), put at some
scale and place, and gets tags and texture coordinates. Most are surfaces; many
are not, and then osdtex has to say so.
"""

import math
import random


class Cage:
    def __init__(self, points, faces):
        self.points = [list(p) for p in points]
        self.faces = [list(f) for f in faces]
        self.lines = []  # tags, after the faces
        self.uvs = None  # per face a list of (u, v), or None


def grid(rng):
    nx, ny = rng.randint(1, 4), rng.randint(1, 4)
    bend = rng.uniform(-0.5, 0.5)
    points = [(x, y, bend * math.sin(x + 2 * y))
              for y in range(ny + 1) for x in range(nx + 1)]
    row = nx + 1
    return Cage(points, [
        [y * row + x, y * row + x + 1, (y + 1) * row + x + 1,
         (y + 1) * row + x] for y in range(ny) for x in range(nx)])


def torus(rng):
    n, m = rng.randint(3, 6), rng.randint(3, 5)
    points = []
    for i in range(n):
        for j in range(m):
            a, b = 2 * math.pi * i / n, 2 * math.pi * j / m
            r = 2 + math.cos(b)
            points.append((r * math.cos(a), r * math.sin(a), math.sin(b)))
    return Cage(points, [
        [i * m + j, (i + 1) % n * m + j, (i + 1) % n * m + (j + 1) % m,
         i * m + (j + 1) % m] for i in range(n) for j in range(m)])


def box(rng):
    size = [rng.choice((1, 1, 0.1, 3)) for _ in range(3)]
    points = [[s * ((i >> k & 1) * 2 - 1) for k, s in enumerate(size)]
              for i in range(8)]
    return Cage(points, [
        [0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2],
        [1, 3, 7, 5]])


def octahedron(rng):
    points = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0),
              (0, 0, rng.uniform(0.2, 3)), (0, 0, -1)]
    return Cage(points, [
        [0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5],
        [3, 1, 5], [0, 3, 5]])


def cone(rng):
    n = rng.randint(3, 9)
    points = [(math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n), 0)
              for i in range(n)] + [(0, 0, 1.5)]
    return Cage(points, [list(range(n))[::-1]] + [
        [i, (i + 1) % n, n] for i in range(n)])


def soup(rng):
    """Faces of any corners: hardly ever a surface."""
    count = rng.randint(3, 9)
    points = [[rng.gauss(0, 1) for _ in range(3)] for _ in range(count)]
    return Cage(points, [
        rng.sample(range(count), min(count, rng.randint(3, 5)))
        for _ in range(rng.randint(1, 8))])


SHAPES = (grid, grid, torus, box, box, octahedron, cone, soup)


def triangulate(cage, rng):
    faces = []
    for f in cage.faces:
        if len(f) > 3 and rng.random() < 0.7:
            faces += [[f[0], f[i], f[i + 1]] for i in range(1, len(f) - 1)]
        else:
            faces.append(f)
    cage.faces = faces


def raise_face(cage, rng):
    i = rng.randrange(len(cage.faces))
    face = cage.faces[i]
    top = []
    height = [rng.uniform(-0.8, 0.8) for _ in range(3)]
    for v in face:
        top.append(len(cage.points))
        cage.points.append([a + b for a, b in zip(cage.points[v], height)])
    cage.faces[i] = top
    n = len(face)
    cage.faces += [[face[k], face[(k + 1) % n], top[(k + 1) % n], top[k]]
                   for k in range(n)]


def remove_face(cage, rng):
    if len(cage.faces) > 1:
        cage.faces.pop(rng.randrange(len(cage.faces)))


def turn_face(cage, rng):
    rng.choice(cage.faces).reverse()


def double_face(cage, rng):
    cage.faces.append(list(rng.choice(cage.faces)))


def join_vertices(cage, rng):
    a, b = rng.randrange(len(cage.points)), rng.randrange(len(cage.points))
    cage.faces = [[a if v == b else v for v in f] for f in cage.faces]


def put_together(cage, rng):
    """Two vertices at one place: edges without length."""
    face = rng.choice(cage.faces)
    cage.points[face[0]] = list(cage.points[face[1]])


def pull_apart(cage, rng):
    """Every face with vertices of its own, as games have them."""
    points = []
    for f in cage.faces:
        for k, v in enumerate(f):
            points.append(list(cage.points[v]))
            f[k] = len(points) - 1
    cage.points = points


def shake(cage, rng):
    amount = rng.choice((0.01, 0.1, 0.5))
    for p in cage.points:
        for k in range(3):
            p[k] += rng.gauss(0, amount)


def unused_vertex(cage, rng):
    cage.points.append([rng.uniform(-9, 9) for _ in range(3)])


CHANGES = (triangulate, triangulate, raise_face, raise_face, raise_face,
           remove_face, remove_face, shake, shake, turn_face, double_face,
           join_vertices, put_together, pull_apart, unused_vertex)


def place(cage, rng):
    scale = rng.choice((1,) * 12 + (1e-3, 1e3, 1e-6, 1e6, 1e-20, 1e20, 1e-40,
                                    1e37))
    away = rng.choice((0,) * 12 + (10, 1e4, 1e7, -1e12))
    for p in cage.points:
        for k in range(3):
            p[k] = p[k] * scale + (away * scale if k != 1 else 0)
    if rng.random() < 0.03:
        rng.choice(cage.points)[rng.randrange(3)] = rng.choice(
            ("nan", "inf", "-inf", "1e400", "1e308"))


def add_tags(cage, rng):
    sharp = lambda: rng.choice((0, 0.3, 1, 2.5, 9.99, 10, 11, 1e9, -1, "inf"))
    for _ in range(rng.randint(0, 6)):
        f = rng.choice(cage.faces)
        k = rng.randrange(len(f))
        cage.lines.append(
            f"t crease 2/1/0 {f[k]} {f[(k + 1) % len(f)]} {sharp()}")
    for _ in range(rng.randint(0, 2)):
        v = rng.randrange(len(cage.points) + (rng.random() < 0.1))
        cage.lines.append(f"t corner 1/1/0 {v} {sharp()}")
    if rng.random() < 0.2:
        cage.lines.append(f"t hole 1/0/0 {rng.randrange(len(cage.faces))}")
    for name, most in (("interpolateboundary", 2),
                       ("facevaryinginterpolateboundary", 5)):
        if rng.random() < 0.2:
            cage.lines.append(f"t {name} 1/0/0 {rng.randint(0, most)}")
    if rng.random() < 0.1:
        cage.lines.append("t creasemethod 0/0/1 chaikin")
    if rng.random() < 0.1:
        cage.lines.append("t smoothtriangles 1/0/0 1")


def add_uvs(cage, rng):
    kind = rng.choice(("none", "none", "plane", "plane", "square", "noise",
                       "mirrored", "far", "one"))
    if kind == "none":
        return

    def uv(k, v):
        x, y = (float(c) for c in cage.points[v][:2])
        return {
            "plane": (0.4 + 0.1 * x, 0.4 + 0.1 * y),
            "square": ((0, 0), (1, 0), (1, 1), (0, 1))[k % 4],
            "noise": (rng.random(), rng.random()),
            "mirrored": (0.4 - 0.1 * x, 0.4 + 0.1 * y),
            "far": (40 + x, -3 + y),
            "one": (0.5, 0.5),
        }[kind]
    cage.uvs = [[uv(k, v) for k, v in enumerate(f)] for f in cage.faces]


def text_of(cage):
    lines = ["v " + " ".join(map(str, p)) for p in cage.points]
    corner = iter(range(1, 1 << 30))
    for f in cage.uvs or ():
        lines += [f"vt {u} {v}" for u, v in f]
    for f in cage.faces:
        lines.append("f " + " ".join(
            f"{v + 1}/{next(corner)}" if cage.uvs else str(v + 1) for v in f))
    return "\n".join(lines + cage.lines) + "\n"


def make(seed):
    """The text of cage number `seed`."""
    rng = random.Random(seed)
    cage = rng.choice(SHAPES)(rng)
    for _ in range(rng.choice((0, 1, 2, 3, 5))):
        rng.choice(CHANGES)(cage, rng)
    if rng.random() < 0.5:
        add_tags(cage, rng)
    add_uvs(cage, rng)
    place(cage, rng)
    return text_of(cage)
