"""osdtex_cage -- cages and constraints as osdtex reads them, from plain lists.

    write_cage("cage.obj", points, faces, uvs=uvs, creases={(0, 1): 2.5})
    write_constraints("pull.csv", {12: (1, 0, 0)}, scales={40: 1.5})

Needs nothing but Python 3.7, so that Blender, Houdini and Maya share it. Faces
and vertices keep their order: constraints are tied to it, and so is what comes
back.
"""

import os


def number(value):
    """Short, and read back as the same float."""
    return "%.9g" % value


def write_atomically(path, lines):
    temporary = f"{path}.part"
    with open(temporary, "w", encoding="utf-8", newline="\n") as file:
        file.write("\n".join(lines) + "\n")
    os.replace(temporary, path)


def write_cage(path, points, faces, uvs=None, creases=None, corners=None,
               materials=None):
    """An OBJ with the tags of OpenSubdiv.

    points     (x, y, z)
    faces      lists of vertices, from 0, counter-clockwise outside
    uvs        for each face a list of (u, v), one for each corner; None
    creases    sharpness, 0 to 10, by (a, b), in any order
    corners    sharpness by vertex
    materials  a name for each face; None
    """
    lines = ["# a cage for osdtex"]
    lines += ["v " + " ".join(map(number, p)) for p in points]
    places = {}
    for face in uvs or ():
        for uv in face:
            if tuple(uv) not in places:
                places[tuple(uv)] = len(places) + 1
                lines.append("vt " + " ".join(map(number, uv)))
    last = None
    for i, face in enumerate(faces):
        if materials and materials[i] != last:
            last = materials[i]
            lines.append("usemtl " + "_".join(last.split()))
        words = [str(v + 1) for v in face]
        if uvs:
            words = [f"{v}/{places[tuple(uv)]}" for v, uv in zip(words, uvs[i])]
        lines.append("f " + " ".join(words))
    for (a, b), sharpness in sorted((creases or {}).items()):
        lines.append(f"t crease 2/1/0 {a} {b} {number(sharpness)}")
    for vertex, sharpness in sorted((corners or {}).items()):
        lines.append(f"t corner 1/1/0 {vertex} {number(sharpness)}")
    write_atomically(path, lines)


def write_constraints(path, directions, scales=None):
    """A CSV of directions, and perhaps of sizes, by face from 0. A face without
    a direction asks for none; where scales are given, a face without one has
    1."""
    scales = scales or {}
    lines = ["face,x,y,z" + (",scale" if scales else "")]
    for face in sorted(set(directions) | set(scales)):
        words = [str(face)]
        words += map(number, directions.get(face, (0, 0, 0)))
        if scales:
            words.append(number(scales.get(face, 1)))
        lines.append(",".join(words))
    write_atomically(path, lines)


def direction_of_colour(rgb):
    """Colours stand for directions as in normal maps: 2 c - 1. Grey and black
    stand for none."""
    x, y, z = (2.0 * c - 1.0 for c in rgb[:3])
    length = (x * x + y * y + z * z) ** 0.5
    if length < 0.25 or max(rgb[:3]) < 0.02:
        return None
    return x / length, y / length, z / length
