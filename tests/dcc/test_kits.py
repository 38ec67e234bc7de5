#!/usr/bin/env python3
"""The kits for Houdini and Maya, over stubs of the calls that they make: what
goes to the program, and what is set of what it brings. That the calls are right
is not tested: neither program is here.

    test_kits.py OSDTEX
"""

import sys
import tempfile
from pathlib import Path

import kit_stubs
from oracles import ROOT

for folder in ("houdini", "maya"):
    sys.path.append(str(ROOT / "tools/dcc" / folder))

OSDTEX = str(Path(sys.argv[1]).resolve())
MATERIAL = str(ROOT / "models/materials/waves")
PICTURE = str(ROOT / "models/exemplars/grass_tile.png")
POINTS = [(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
FACES = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7],
         [2, 0, 4, 6]]


def lines_of(path, begin):
    return [line for line in path.read_text().splitlines()
            if line.startswith(begin)]


def check_houdini(folder):
    sys.modules["hou"] = kit_stubs.houdini()
    import osdtex_sop as sop
    geometry = kit_stubs.Geometry(POINTS, FACES)
    geometry.addAttrib("Vertex", "creaseweight", 0.0)
    geometry.addAttrib("Point", "cornerweight", 0.0)
    geometry.known.add(("Prim", "texture_pull"))
    for prim in geometry.prims():
        prim.setAttribValue("texture_pull", (0, 0, 1) if prim.number() == 2 else (
            0, 0, 0))
        corners = prim.vertices()
        for i, vertex in enumerate(corners):
            pair = {vertex.point().number(),
                    corners[(i + 1) % 4].point().number()}
            if pair == {4, 5}:
                vertex.setAttribValue("creaseweight", 2.5)
    geometry.points()[7].setAttribValue("cornerweight", 10.0)
    curve = kit_stubs.Geometry([(0, 1, -1), (0, 1, 1)], [[0, 1]])
    node = kit_stubs.Node(
        geometry, {"exemplar": MATERIAL, "scale": 0.0, "resolution": 64,
                   "uvs": "auto", "level": "1", "folder": str(folder), "program": OSDTEX},
        kit_stubs.Node(curve, {}))
    base = sop.cook(node)
    source = folder / "osdtex1_source.obj"
    assert kit_stubs.read_obj(source) == (
        [tuple(map(float, p)) for p in POINTS], [
            f[::-1] for f in (p[::-1] for p in FACES)]), source.read_text()
    assert lines_of(source, "t ") == [
        "t crease 2/1/0 4 5 2.5", "t corner 1/1/0 7 10"]
    table = (folder / "osdtex1_source.json").read_text()
    assert '"face": 2' in table and '"radius": 1.0' in table, table
    assert geometry.globals == {
        "osd_scheme": "catmull-clark", "osd_fvarlinearinterpolation": 5,
        "osd_vtxboundaryinterpolation": 2}, geometry.globals
    weights = [v.attribValue("creaseweight")
               for p in geometry.prims() for v in p.vertices()]
    assert sorted(weights)[-3:] == [0.0, 2.5, 2.5]
    network = kit_stubs.Network()
    sop.look(base, network)
    for name in ("basecolor_texture", "rough_texture", "metallic_texture",
                 "baseNormal_texture", "dispTex_texture"):
        assert Path(network.values[name]).exists(), (name, network.values)
    node.parms["exemplar"] = "/no/such.png"
    try:
        sop.cook(node)
    except sys.modules["hou"].NodeError as error:
        assert "such.png" in str(error)
    else:
        raise AssertionError("a picture that is not there is taken")


def check_maya(folder):
    cmds = kit_stubs.Maya(
        POINTS, FACES, {(4, 5): 2.5}, {7: 10.0}, {3: (0.5, 1.0, 0.5)})
    package = type(sys)("maya")
    package.cmds = cmds
    sys.modules["maya"], sys.modules["maya.cmds"] = package, cmds
    import osdtex_shelf as shelf
    assert shelf.texture_selection(
        MATERIAL, str(folder), OSDTEX, resolution=64, level=1) == "made"
    assert lines_of(folder / "box_source.obj", "t ") == [
        "t crease 2/1/0 4 5 2.5", "t corner 1/1/0 7 10"]
    assert lines_of(folder / "box_source.csv", "3,") == ["3,0,1,0"]
    edge = cmds.edges("made").index((4, 5))
    assert cmds.set[f"made.e[{edge}]"] == 2.5
    assert cmds.set["made.vtx[7]"] == 10.0
    assert cmds.set["made.osdFvarBoundary"] == 3
    assert {l.split(".")[1] for l in cmds.links} >= {
        "surfaceShader", "baseColor", "specularRoughness", "metalness",
        "normalCamera", "displacementShader"}, cmds.links
    shown = [v for k, v in cmds.set.items() if k.endswith("fileTextureName")]
    assert len(shown) == 5 and all(Path(p).exists() for p in shown), shown
    spaces = [v for k, v in cmds.set.items() if k.endswith("colorSpace")]
    assert spaces.count("ACEScg") == 1 and spaces.count("Raw") == 4, spaces


def main():
    with tempfile.TemporaryDirectory() as folder:
        for check in (check_houdini, check_maya):
            own = Path(folder) / check.__name__
            own.mkdir()
            check(own)
            print(check.__name__, "fine", flush=True)


main()
