"""osdtex_sop -- the source of a Houdini Python SOP that textures its input.

Not verified in Houdini: tests run it against stubs of the calls. Put this
folder and the one above it on PYTHONPATH, make a Python SOP with the spare
parameters `exemplar`, `scale`, `resolution`, `level`, `uvs`, `folder` and `program`, and
let its code be

    import osdtex_sop
    osdtex_sop.cook(hou.pwd())

Input 1 is the cage: polygons with `creaseweight` on vertices, `cornerweight` on
points, `uv` on vertices and, to say which way the texture runs, `texture_pull`
(a vector) and `texture_size` (a number) on primitives. Input 2, which may be
missing, holds curves: the texture runs along them. What comes out is the baked
cage with the attributes of OpenSubdiv; osdtex_sop.look makes its material.
"""

import importlib
import json
import math
import os
import re
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))

osdtex_cage = importlib.import_module("osdtex_cage")
osdtex_job = importlib.import_module("osdtex_job")

FVAR = {"none": 0, "cornersOnly": 1, "cornersPlus1": 2, "cornersPlus2": 3,
        "boundaries": 4, "all": 5}


def value(geometry, kind, name, element):
    find = getattr(geometry, f"find{kind}Attrib")
    return element.attribValue(name) if find(name) else None


def read_cage(geometry):
    """Points, faces counter-clockwise, UVs, creases, corners. Houdini's polygons
    run clockwise."""
    points = [tuple(p.position()) for p in geometry.points()]
    has_uv = geometry.findVertexAttrib("uv") is not None
    faces, uvs, creases, corners = [], [], {}, {}
    for prim in geometry.prims():
        vertices = list(prim.vertices())[::-1]
        numbers = [v.point().number() for v in vertices]
        faces.append(numbers)
        if has_uv:
            uvs.append([tuple(v.attribValue("uv"))[:2] for v in vertices])
        # The weight of a vertex is of the edge from it to the next of Houdini's
        # order, which is the one before it in ours.
        for i, vertex in enumerate(vertices):
            weight = value(geometry, "Vertex", "creaseweight", vertex) or 0.0
            if weight > 0.0:
                edge = tuple(sorted((numbers[i], numbers[i - 1])))
                creases[edge] = max(weight, creases.get(edge, 0.0))
    for point in geometry.points():
        weight = value(geometry, "Point", "cornerweight", point) or 0.0
        if weight > 0.0:
            corners[point.number()] = weight
    return points, faces, uvs if has_uv else None, creases, corners


def write_constraints(geometry, curves, path):
    """Attributes of primitives, and the pieces of curves as points. Whether
    anything is asked for."""
    asked = []
    for prim in geometry.prims():
        one = {}
        pull = value(geometry, "Prim", "texture_pull", prim)
        size = value(geometry, "Prim", "texture_size", prim)
        if pull and any(pull):
            one["direction"] = list(pull)
        if size and size > 0.0:
            one["scale"] = size
        if one:
            asked.append({"face": prim.number(), **one})
    for curve in curves.prims() if curves else ():
        places = [tuple(v.point().position()) for v in curve.vertices()]
        for a, b in zip(places, places[1:]):
            step = [y - x for x, y in zip(a, b)]
            length = math.sqrt(sum(s * s for s in step))
            if length > 0.0:
                asked.append({
                    "point": [(x + y) / 2 for x, y in zip(a, b)],
                    "radius": length / 2, "direction": step})
    if asked:
        with open(path, "w", encoding="utf-8") as file:
            json.dump({"constraints": asked}, file, indent=1)
    return bool(asked)


def fvar_of(path):
    with open(path, encoding="utf-8", errors="replace") as file:
        said = re.search(r'face-varying interpolation[^"]*"(\w+)"', file.read())
    return FVAR[said.group(1) if said else "all"]


def set_tags(geometry, creases, corners, fvar):
    """What an OBJ cannot say, as Karma and Mantra read it."""
    hou = importlib.import_module("hou")
    Global = hou.attribType.Global
    for name, default in (
            ("osd_scheme", "catmull-clark"), ("osd_fvarlinearinterpolation", fvar),
            ("osd_vtxboundaryinterpolation", 2)):
        geometry.addAttrib(Global, name, default)
        geometry.setGlobalAttribValue(name, default)
    if creases:
        geometry.addAttrib(hou.attribType.Vertex, "creaseweight", 0.0)
        for prim in geometry.prims():
            vertices = list(prim.vertices())
            for i, vertex in enumerate(vertices):
                after = vertices[(i + 1) % len(vertices)]
                edge = tuple(sorted(
                    (vertex.point().number(), after.point().number())))
                if edge in creases:
                    vertex.setAttribValue("creaseweight", creases[edge])
    if corners:
        geometry.addAttrib(hou.attribType.Point, "cornerweight", 0.0)
        for point in geometry.points():
            if point.number() in corners:
                point.setAttribValue("cornerweight", corners[point.number()])


def cook(node):
    """Textures input 1 of the node and puts the baked cage into its geometry."""
    hou = importlib.import_module("hou")
    geometry = node.geometry()
    inputs = node.inputs()
    curves = inputs[1].geometry() if len(inputs) > 1 and inputs[1] else None
    points, faces, uvs, creases, corners = read_cage(geometry)
    folder = node.evalParm("folder")
    os.makedirs(folder, exist_ok=True)
    base = os.path.join(folder, re.sub(r"\W", "_", node.name()))
    osdtex_cage.write_cage(
        f"{base}_source.obj", points, faces, uvs, creases, corners)
    has_table = write_constraints(geometry, curves, f"{base}_source.json")
    words = osdtex_job.bake_words(
        f"{base}_source.obj", f"{base}.obj", node.evalParm("exemplar"),
        scale=node.evalParm("scale") or None,
        resolution=node.evalParm("resolution"), uvs=node.evalParm("uvs"),
        level=node.evalParm("level"),
        constraints=f"{base}_source.json" if has_table else None,
        **{"for": "houdini"})
    job = osdtex_job.start(words, node.evalParm("program"))
    with hou.InterruptableOperation(
            "osdtex", open_interrupt_dialog=True) as operation:
        while job.poll():
            try:
                operation.updateProgress(job.percent / 100.0)
            except hou.OperationInterrupted:
                job.cancel()
            try:
                job.process.wait(0.1)
            except Exception:
                continue
    try:
        job.check()
    except osdtex_job.Failed as error:
        raise hou.NodeError(str(error)) from None
    geometry.clear()
    geometry.loadFromFile(f"{base}_cage.obj")
    set_tags(geometry, creases, corners, fvar_of(f"{base}_cage.obj"))
    return base


def look(base, parent):
    """A principled shader in the network `parent`, from NAME_cage.mtl."""
    shader = parent.createNode("principledshader", os.path.basename(base))
    keys = {"map_Kd": "basecolor", "map_Pr": "rough", "map_Pm": "metallic",
            "norm": "baseNormal", "disp": "dispTex"}
    with open(f"{base}_cage.mtl", encoding="utf-8") as file:
        for line in file:
            key, _, name = line.strip().partition(" ")
            if key not in keys:
                continue
            path = os.path.join(os.path.dirname(base), name.split()[-1])
            stem = keys[key]
            if key in ("map_Kd", "map_Pr", "map_Pm"):
                shader.parm(f"{stem}_useTexture").set(1)
                shader.parm(f"{stem}_texture").set(path)
            elif key == "norm":
                shader.parm("baseBumpAndNormal_enable").set(1)
                shader.parm("baseNormal_texture").set(path)
            else:
                shader.parm("dispTex_enable").set(1)
                shader.parm("dispTex_texture").set(path)
    for channel in ("basecolorr", "basecolorg", "basecolorb"):
        shader.parm(channel).set(1.0)
    return shader
