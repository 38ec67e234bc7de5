"""kit_stubs -- as much of Houdini's and Maya's calls as the kits use, over an
OBJ held in lists. What they return has the form that the manuals give; that the
programs do so is not tested here.
"""

import types


def read_obj(path):
    """Points and faces of a file, from 0."""
    points, faces = [], []
    for line in open(path, encoding="utf-8"):
        words = line.split()
        if words[:1] == ["v"]:
            points.append(tuple(map(float, words[1:4])))
        elif words[:1] == ["f"]:
            faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return points, faces


# ---- Houdini ---------------------------------------------------------------


class Element:
    def __init__(self, number, **attributes):
        self.n, self.attributes = number, attributes

    def number(self):
        return self.n

    def attribValue(self, name):
        return self.attributes[name]

    def setAttribValue(self, name, value):
        self.attributes[name] = value


class Point(Element):
    def position(self):
        return self.attributes["P"]


class Vertex(Element):
    def point(self):
        return self.on


class Prim(Element):
    def vertices(self):
        return self.corners


class Geometry:
    """Polygons run clockwise."""

    def __init__(self, points=(), faces=()):
        self.known, self.globals = set(), {}
        self.fill(points, faces)

    def fill(self, points, faces):
        self.all_points = [Point(i, P=p) for i, p in enumerate(points)]
        self.all_prims = []
        for i, face in enumerate(faces):
            prim = Prim(i)
            prim.corners = []
            for v in face[::-1]:
                vertex = Vertex(v)
                vertex.on = self.all_points[v]
                prim.corners.append(vertex)
            self.all_prims.append(prim)

    def points(self):
        return self.all_points

    def prims(self):
        return self.all_prims

    def clear(self):
        self.fill((), ())
        self.known = set()

    def loadFromFile(self, path):
        self.fill(*read_obj(path))

    def addAttrib(self, kind, name, default):
        self.known.add((kind, name))
        for prim in self.all_prims if kind == "Vertex" else ():
            for vertex in prim.corners:
                vertex.attributes.setdefault(name, default)
        for point in self.all_points if kind == "Point" else ():
            point.attributes.setdefault(name, default)

    def setGlobalAttribValue(self, name, value):
        self.globals[name] = value


for _kind in ("Vertex", "Point", "Prim"):
    setattr(Geometry, f"find{_kind}Attrib", lambda self, name, kind=_kind: (
        name if (kind, name) in self.known else None))


class Node:
    def __init__(self, geometry, parms, curves=None):
        self.shape, self.parms, self.curves = geometry, parms, curves

    def geometry(self):
        return self.shape

    def inputs(self):
        return (Node(self.shape, {}), self.curves)

    def evalParm(self, name):
        return self.parms[name]

    def name(self):
        return "osdtex1"


class Operation:
    def __init__(self, *_words, **_more):
        self.seen = []

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        return False

    def updateProgress(self, share):
        self.seen.append(share)


def houdini():
    hou = types.ModuleType("hou")
    hou.attribType = types.SimpleNamespace(
        Global="Global", Vertex="Vertex", Point="Point")
    hou.InterruptableOperation = Operation
    hou.OperationInterrupted = type("OperationInterrupted", (Exception,), {})
    hou.NodeError = type("NodeError", (Exception,), {})
    return hou


class Network:
    """Where shaders are made: parameters by name."""

    def __init__(self):
        self.values = {}

    def createNode(self, kind, _name):
        self.kind = kind
        return self

    def parm(self, name):
        return types.SimpleNamespace(
            set=lambda value: self.values.__setitem__(name, value))


# ---- Maya ------------------------------------------------------------------


class Maya:
    """Meshes "box" and "made"; calls that make something are kept."""

    def __init__(self, points, faces, creases, corners, colours):
        self.meshes = {"box": (points, faces)}
        self.creases, self.corners, self.colours = creases, corners, colours
        self.set, self.links, self.made = {}, {}, []

    def edges(self, mesh):
        seen = []
        for face in self.meshes[mesh][1]:
            for a, b in zip(face, face[1:] + face[:1]):
                if tuple(sorted((a, b))) not in seen:
                    seen.append(tuple(sorted((a, b))))
        return seen

    def ls(self, *_words, **how):
        return ["made"] if "selection" not in how else ["box"]

    def xform(self, name, **_how):
        return [x for p in self.meshes[name.split(".")[0]][0] for x in p]

    def polyInfo(self, mesh, **how):
        rows = (self.meshes[mesh][1] if "faceToVertex" in how
                else self.edges(mesh))
        kind = "FACE" if "faceToVertex" in how else "EDGE"
        end = "" if "faceToVertex" in how else " Hard"
        return [f"{kind} {i:5d}: " + "".join(f"{v:6d}" for v in row) + f"{end} \n"
                for i, row in enumerate(rows)]

    def polyEvaluate(self, _mesh, **_how):
        return 0

    def polyCrease(self, name, query=False, value=None, vertexValue=None):
        if not query:
            self.set[name] = value if value is not None else vertexValue
            return None
        if value:
            return [self.creases.get(e, -1.0) for e in self.edges("box")]
        return [self.corners.get(v, -1.0)
                for v in range(len(self.meshes["box"][0]))]

    def polyColorSet(self, _mesh, **how):
        return ["texture_pull"] if "query" in how else None

    def polyColorPerVertex(self, name, **_how):
        face = int(name.split("[")[1][:-1])
        return list(self.colours.get(face, (0.5, 0.5, 0.5))) * 4

    def progressWindow(self, **_how):
        return False

    def file(self, path, **_how):
        self.meshes["made"] = read_obj(path)
        return ["made"]

    def setAttr(self, name, *values, **_how):
        self.set[name] = values[0]

    def connectAttr(self, a, b):
        self.links[b] = a

    def shadingNode(self, kind, **_how):
        self.made.append(kind)
        return f"{kind}{len(self.made)}"

    def sets(self, *_words, **_how):
        return "group1"
