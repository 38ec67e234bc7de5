#!/usr/bin/env python3
"""Every file of a bake is read by the programs of others.

    test_readers.py OSDTEX

OpenImageIO and OpenEXR read the textures, also of UDIM tiles and the extra
ones; an XML parser reads the MaterialX document; USD and MaterialX themselves
read their files where `tools/deps oracles` has installed them.
"""

import sys
import tempfile
import xml.etree.ElementTree as xml
from pathlib import Path

from oracles import ROOT, need, oracle_python, run


def bake(osdtex, folder):
    run(
        osdtex, "bake", ROOT / "models/cages/ngons_and_triangles.obj",
        ROOT / "models/exemplars/gravel_tile.png", "-o", folder / "shape.obj",
        "--level", "2", "--uvs", "atlas", "--resolution", "256",
        "--texels-per-unit", "60", "--extra", "patch,uv,stretch,seam",
        "--preview-png", "-q", cwd=ROOT,
    )


def check_textures(folder):
    textures = sorted(folder.glob("*.exr"))
    kinds = {p.name.split(".")[0] for p in textures}
    assert kinds == {
        "shape", "shape_patch", "shape_uv", "shape_stretch", "shape_seam",
    }, kinds
    for path in textures:
        tile = int(path.name.split(".")[1])
        assert 1001 <= tile <= 9999
        info = run("oiiotool", "--info", "-v", path)
        assert "256 x  256, 3 channel" in info, info
        assert "MIP-map levels: 256x256 128x128" in info, info
        assert "tile size: 64 x 64" in info
        header = run("exrheader", path)
        assert 'textureformat (type string): "Plain Texture"' in header
        if path.name.startswith("shape."):
            assert "half" in info and "chromaticities" in header
        else:
            assert "float openexr" in info, info
    return [p for p in textures if p.name.startswith("shape.")]


def check_texts(folder, colors):
    cage = (folder / "shape_cage.obj").read_text()
    assert 'face-varying interpolation "all"' in cage
    assert "mtllib shape_cage.mtl" in cage
    name = "shape.<UDIM>.exr" if len(colors) > 1 else colors[0].name
    for library, texture in (("cage", name), ("preview", name[:-3] + "png")):
        text = (folder / f"shape_{library}.mtl").read_text()
        assert f"map_Kd {texture}\n" in text, text
    usda = (folder / "shape.usda").read_text()
    assert f"@{name}@" in usda
    assert 'colorSpace = "lin_rec709_scene"' in usda
    assert 'sourceColorSpace = "raw"' in usda
    root = xml.parse(folder / "shape.mtlx").getroot()
    files = root.findall("./image/input[@name='file']")
    assert [f.get("value") for f in files] == [name]
    assert files[0].get("colorspace") == "lin_rec709"


def check_asset(folder):
    """USD and MaterialX read their files themselves."""
    for module in ("pxr", "MaterialX"):
        python, reason = oracle_python(module)
        if reason:
            print(f"skipped: {reason}")
            continue
        judge = ROOT / "tests/dcc/judge_asset.py"
        print(run(python, judge, module, folder).strip())


def bake_material(osdtex, folder):
    """All maps of a set, on a cage of several materials."""
    run(
        osdtex, "bake", ROOT / "models/cages/materials_and_groups.obj",
        "--material", ROOT / "models/materials/waves", "-o",
        folder / "shape.obj", "--level", "1", "--uvs", "atlas", "--resolution",
        "128", "-q", cwd=ROOT,
    )
    names = {p.name.split(".")[0] for p in folder.glob("*.exr")}
    assert names == {"shape"} | {
        f"shape_{m}" for m in (
            "normal", "roughness", "height", "metalness", "occlusion")}, names


def main():
    need("oiiotool", "exrheader")
    osdtex = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        bake(osdtex, folder)
        check_texts(folder, check_textures(folder))
        check_asset(folder)
    with tempfile.TemporaryDirectory() as folder:
        bake_material(osdtex, Path(folder))
        check_asset(Path(folder))


main()
