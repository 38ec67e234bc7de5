"""osdtex_shelf -- a Maya shelf script: textures the selected mesh.

Not verified in Maya: tests run it against stubs of the calls. Put this folder
and the one above it on PYTHONPATH, and give a shelf button

    import osdtex_shelf
    osdtex_shelf.texture_selection("/materials/bark.png", scale=4)

The cage goes out with creases, corners and UVs; faces whose colour set
`texture_pull` holds directions as normal maps do are constrained. What comes back
is imported beside it, subdivided by OpenSubdiv with the UV rule that the file
states, in a standardSurface with file nodes.
"""

import importlib
import os
import re
import sys
import tempfile

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))

osdtex_cage = importlib.import_module("osdtex_cage")
osdtex_job = importlib.import_module("osdtex_job")

FVAR = {"none": 0, "cornersOnly": 1, "cornersPlus1": 1, "cornersPlus2": 1,
        "boundaries": 2, "all": 3}
PULL = "texture_pull"


def commands():
    return importlib.import_module("maya.cmds")


def numbers(line):
    """Of "FACE 3: 0 4 5 1": [0, 4, 5, 1]."""
    return [int(w) for w in line.partition(":")[2].split() if w.isdigit()]


def read_cage(mesh):
    cmds = commands()
    flat = cmds.xform(f"{mesh}.vtx[*]", query=True, objectSpace=True,
                      translation=True)
    points = [tuple(flat[i:i + 3]) for i in range(0, len(flat), 3)]
    faces = [numbers(line) for line in cmds.polyInfo(mesh, faceToVertex=True)]
    return points, faces, read_uvs(mesh, faces), read_creases(mesh), (
        read_corners(mesh, len(points)))


def read_uvs(mesh, faces):
    cmds = commands()
    if not cmds.polyEvaluate(mesh, uvcoord=True):
        return None
    found = []
    for face, vertices in enumerate(faces):
        corners = []
        for vertex in vertices:
            at = cmds.polyListComponentConversion(
                f"{mesh}.vtxFace[{vertex}][{face}]", toUV=True)
            corners.append(tuple(cmds.polyEditUV(at[0], query=True)[:2]))
        found.append(corners)
    return found


def read_creases(mesh):
    cmds = commands()
    edges = [sorted(numbers(line)[:2])
             for line in cmds.polyInfo(mesh, edgeToVertex=True)]
    values = cmds.polyCrease(f"{mesh}.e[*]", query=True, value=True) or []
    return {tuple(e): v for e, v in zip(edges, values) if v > 0.0}


def read_corners(mesh, count):
    values = commands().polyCrease(
        f"{mesh}.vtx[0:{count - 1}]", query=True, vertexValue=True) or []
    return {i: v for i, v in enumerate(values) if v > 0.0}


def read_pull(mesh, faces):
    """Directions by face, of a colour set."""
    cmds = commands()
    if PULL not in (cmds.polyColorSet(mesh, query=True, allColorSets=True) or []):
        return {}
    cmds.polyColorSet(mesh, currentColorSet=True, colorSet=PULL)
    found = {}
    for face in range(len(faces)):
        colours = cmds.polyColorPerVertex(
            f"{mesh}.f[{face}]", query=True, rgb=True)
        mean = [sum(colours[k::3]) * 3 / len(colours) for k in range(3)]
        direction = osdtex_cage.direction_of_colour(mean)
        if direction:
            found[face] = direction
    return found


def import_cage(path, creases, corners):
    """The baked cage, with what OBJ cannot say."""
    cmds = commands()
    made = cmds.file(path, i=True, type="OBJ", returnNewNodes=True,
                     options="mo=0")
    mesh = cmds.ls(made, type="mesh")[0]
    lookup = {tuple(sorted(numbers(line)[:2])): i for i, line in enumerate(
        cmds.polyInfo(mesh, edgeToVertex=True))}
    for edge, value in sorted(creases.items()):
        cmds.polyCrease(f"{mesh}.e[{lookup[edge]}]", value=value)
    for vertex, value in sorted(corners.items()):
        cmds.polyCrease(f"{mesh}.vtx[{vertex}]", vertexValue=value)
    with open(path, encoding="utf-8", errors="replace") as file:
        said = re.search(r'face-varying interpolation[^"]*"(\w+)"', file.read())
    for name, value in (
            ("useGlobalSmoothDrawType", 0), ("smoothDrawType", 3),
            ("displaySmoothMesh", 2), ("osdVertBoundary", 2),
            ("osdFvarBoundary", FVAR[said.group(1) if said else "all"])):
        cmds.setAttr(f"{mesh}.{name}", value)
    return mesh


def file_node(path, space):
    cmds = commands()
    node = cmds.shadingNode("file", asTexture=True, isColorManaged=True)
    if "<UDIM>" in path:
        cmds.setAttr(f"{node}.uvTilingMode", 3)
    cmds.setAttr(f"{node}.fileTextureName", path.replace("<UDIM>", "1001"),
                 type="string")
    if space:
        cmds.setAttr(f"{node}.ignoreColorSpaceFileRules", 1)
        cmds.setAttr(f"{node}.colorSpace", space, type="string")
    return node


def look(mesh, material, space):
    """A standardSurface from NAME_cage.mtl, and the mesh in it."""
    cmds = commands()
    shader = cmds.shadingNode("standardSurface", asShader=True)
    group = cmds.sets(renderable=True, noSurfaceShader=True, empty=True)
    cmds.connectAttr(f"{shader}.outColor", f"{group}.surfaceShader")
    folder = os.path.dirname(material)
    with open(material, encoding="utf-8") as file:
        lines = [line.split() for line in file if line.strip()]
    for words in lines:
        key, path = words[0], os.path.join(folder, words[-1])
        if key == "map_Kd":
            cmds.connectAttr(
                f"{file_node(path, space)}.outColor", f"{shader}.baseColor")
        elif key in ("map_Pr", "map_Pm"):
            cmds.connectAttr(
                f"{file_node(path, 'Raw')}.outColorR", shader + (
                    ".specularRoughness" if key == "map_Pr" else ".metalness"))
        elif key == "norm":
            bump = cmds.shadingNode("bump2d", asUtility=True)
            cmds.setAttr(f"{bump}.bumpInterp", 1)
            cmds.connectAttr(
                f"{file_node(path, 'Raw')}.outColorR", f"{bump}.bumpValue")
            cmds.connectAttr(f"{bump}.outNormal", f"{shader}.normalCamera")
        elif key == "disp":
            lift = cmds.shadingNode("displacementShader", asShader=True)
            cmds.connectAttr(
                f"{file_node(path, 'Raw')}.outColorR", f"{lift}.displacement")
            cmds.connectAttr(
                f"{lift}.displacement", f"{group}.displacementShader")
    cmds.sets(mesh, edit=True, forceElement=group)
    return shader


def texture_selection(exemplar, folder="", program="", space="ACEScg",
                      **settings):
    """Textures the selected mesh; settings are flags of `osdtex bake`. The
    textures are in ACEScg, as `--for maya` writes them."""
    cmds = commands()
    meshes = cmds.ls(selection=True, dag=True, type="mesh", noIntermediate=True)
    if not meshes:
        raise osdtex_job.Failed("select a mesh: the cage")
    mesh = meshes[0]
    folder = folder or tempfile.mkdtemp(prefix="osdtex_")
    base = os.path.join(folder, re.sub(r"\W", "_", mesh))
    points, faces, uvs, creases, corners = read_cage(mesh)
    osdtex_cage.write_cage(
        f"{base}_source.obj", points, faces, uvs, creases, corners)
    pull = read_pull(mesh, faces)
    if pull:
        osdtex_cage.write_constraints(f"{base}_source.csv", pull)
        settings["constraints"] = f"{base}_source.csv"
    job = osdtex_job.start(osdtex_job.bake_words(
        f"{base}_source.obj", f"{base}.obj", exemplar, **{"for": "maya"},
        **settings), program)
    cmds.progressWindow(title="osdtex", isInterruptable=True, maxValue=100)
    try:
        while job.poll():
            if cmds.progressWindow(query=True, isCancelled=True):
                job.cancel()
            cmds.progressWindow(edit=True, progress=job.percent, status=job.stage)
            try:
                job.process.wait(0.1)
            except Exception:
                continue
    finally:
        cmds.progressWindow(endProgress=True)
    job.check()
    made = import_cage(f"{base}_cage.obj", creases, corners)
    look(made, f"{base}_cage.mtl", space)
    return made
