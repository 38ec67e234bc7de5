#!/usr/bin/env python3
"""remodel -- what modellers do to cages, as changes of OBJ text.

    remodel.py loop|cut|triangles IN.obj OUT.obj

loop adds an edge loop in the middle of the longest strip of quads, cut deletes
the fifth of the faces that reaches highest, triangles cuts all faces into such.
Tags and texture coordinates are left out.
"""

import pathlib
import sys


def read(path):
    points, faces = [], []
    for line in pathlib.Path(path).read_text().splitlines():
        words = line.split()
        if words and words[0] == "v":
            points.append([float(x) for x in words[1:4]])
        elif words and words[0] == "f":
            faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return points, faces


def write(path, points, faces):
    used = sorted({v for face in faces for v in face})
    number = {v: i + 1 for i, v in enumerate(used)}
    pathlib.Path(path).write_text("".join(
        ["v " + " ".join(f"{x:.9g}" for x in points[v]) + "\n" for v in used] +
        ["f " + " ".join(str(number[v]) for v in face) + "\n"
         for face in faces]))


def edges_of(face):
    return [frozenset((v, face[(k + 1) % len(face)]))
            for k, v in enumerate(face)]


def strips(faces):
    """Lists of (face, corner where the crossed edge begins), quad by quad over
    opposite edges."""
    around = {}
    for f, face in enumerate(faces):
        for k, edge in enumerate(edges_of(face)):
            around.setdefault(edge, []).append((f, k))
    for first in (f for f, face in enumerate(faces) if len(face) == 4):
        for start in (0, 1):
            strip, seen, at = [], set(), (first, start)
            while at and len(faces[at[0]]) == 4 and at[0] not in seen:
                seen.add(at[0])
                strip.append(at)
                f, k = at
                edge = edges_of(faces[f])[(k + 2) % 4]
                at = next((a for a in around[edge] if a[0] != f), None)
            yield strip, at is not None and at[0] == first


def add_loop(points, faces):
    """The longest strip that comes back to its start, cut along its middle."""
    strip = max((s for s, closes in strips(faces) if closes), key=len)
    points, made = list(points), {}

    def middle(a, b):
        edge = frozenset((a, b))
        if edge not in made:
            made[edge] = len(points)
            points.append([(x + y) / 2 for x, y in zip(points[a], points[b])])
        return made[edge]

    crossed = dict(strip)
    out = []
    for f, face in enumerate(faces):
        if f not in crossed:
            out.append(face)
            continue
        a, b, c, d = face[crossed[f]:] + face[:crossed[f]]
        ab, cd = middle(a, b), middle(c, d)
        out += [[a, ab, cd, d], [ab, b, c, cd]]
    return points, out


def cut_off(points, faces):
    heights = sorted(
        (max(points[v][1] for v in face), f) for f, face in enumerate(faces))
    gone = {f for _, f in heights[-len(faces) // 5:]}
    return points, [face for f, face in enumerate(faces) if f not in gone]


def triangles(points, faces):
    return points, [[face[0], face[k], face[k + 1]]
                    for face in faces for k in range(1, len(face) - 1)]


CHANGES = {"loop": add_loop, "cut": cut_off, "triangles": triangles}


def remodel(change, source, target):
    write(target, *CHANGES[change](*read(source)))


if __name__ == "__main__":
    if len(sys.argv) != 4 or sys.argv[1] not in CHANGES:
        sys.exit(__doc__)
    remodel(*sys.argv[1:])
