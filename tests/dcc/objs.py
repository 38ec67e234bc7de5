"""objs -- just enough of OBJ to carry a cage's UVs to its refined mesh."""

from pathlib import Path


class Obj:
    def __init__(self, path):
        self.points, self.uvs, self.faces, self.corners = [], [], [], []
        for line in Path(path).read_text().splitlines():
            words = line.split()
            if not words:
                continue
            if words[0] == "v":
                self.points.append(line)
            elif words[0] == "vt":
                self.uvs.append((float(words[1]), float(words[2])))
            elif words[0] == "f":
                ids = [[int(i) for i in w.split("/")[:2]] for w in words[1:]]
                self.faces.append([i[0] for i in ids])
                self.corners.append([self.uvs[i[1] - 1] for i in ids])


def middle(*points):
    n = len(points)
    return (sum(p[0] for p in points) / n, sum(p[1] for p in points) / n)


def children(corners):
    """UVs of the children of a face by the rule "linear all", in the order and
    with the first corners that Catmull-Clark gives them."""
    n = len(corners)
    edges = [middle(corners[i], corners[(i + 1) % n]) for i in range(n)]
    centre = middle(*corners)
    if n == 4:
        v, e, f = corners, edges, centre
        return [
            [v[0], e[0], f, e[3]],
            [e[0], v[1], e[1], f],
            [f, e[1], v[2], e[2]],
            [e[3], f, e[2], v[3]],
        ]
    return [[corners[i], edges[i], centre, edges[i - 1]] for i in range(n)]


def linear_leaves(cage, leaf_count):
    """The cage's UVs on its leaves; the level follows from their number."""
    faces = cage.corners
    while len(faces) < leaf_count:
        faces = [child for face in faces for child in children(face)]
    assert len(faces) == leaf_count
    return faces


def write_with_uvs(leaf, uvs, path, texture):
    """The refined mesh with other UVs, and a material that shows `texture`."""
    path = Path(path)
    path.with_suffix(".mtl").write_text(
        f"newmtl baked\nKd 1 1 1\nillum 1\nmap_Kd {texture}\n"
    )
    with open(path, "w") as out:
        out.write(f"mtllib {path.with_suffix('.mtl').name}\n")
        out.write("\n".join(leaf.points) + "\n")
        for face in uvs:
            for u, v in face:
                out.write(f"vt {u:.9g} {v:.9g}\n")
        out.write("usemtl baked\n")
        k = 1
        for face in leaf.faces:
            out.write("f " + " ".join(f"{v}/{k + i}" for i, v in enumerate(face)) + "\n")
            k += len(face)
