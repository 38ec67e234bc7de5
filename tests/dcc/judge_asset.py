#!/usr/bin/env python3
"""USD or MaterialX reads its file of a bake called "shape".

    judge_asset.py pxr|MaterialX FOLDER

Runs in the environment of tests/oracle_venv.py.
"""

import sys
from pathlib import Path


def judge_conformance(stage):
    """USD's own validators find nothing, and attributes are declared as the
    schema declares them."""
    from pxr import UsdValidation

    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    errors = UsdValidation.ValidationContext(validators).Validate(stage)
    # That of normal maps looks for a file called <UDIM>; judge_maps() for its
    # tiles.
    errors = [
        e for e in errors
        if not (e.GetName() == "InvalidFile" and "<UDIM>" in e.GetMessage())]
    assert not errors, [e.GetErrorAsString() for e in errors]
    for prim in stage.Traverse():
        schema = prim.GetPrimDefinition()
        for attribute in prim.GetAuthoredAttributes():
            if attribute.GetName() not in schema.GetPropertyNames():
                continue
            spec = schema.GetSchemaAttributeSpec(attribute.GetName())
            assert spec.variability == attribute.GetVariability(), attribute
            assert spec.typeName == attribute.GetTypeName(), attribute
    for key in ("metersPerUnit", "upAxis"):
        assert stage.HasAuthoredMetadata(key), key


def judge_maps(folder, shade, material):
    """Each map that was baked is connected, found, and taken as numbers."""
    surface = material.ComputeSurfaceSource()[0]
    inputs = {
        "normal": "normal", "roughness": "roughness", "metalness": "metallic",
        "height": "displacement", "occlusion": "occlusion"}
    for name, key in inputs.items():
        baked = sorted(folder.glob(f"shape_{name}.*.exr"))
        source = surface.GetInput(key)
        assert bool(baked) == bool(source and source.HasConnectedSource()), name
        if not baked:
            continue
        texture = shade.Shader(source.GetConnectedSource()[0])
        path = texture.GetInput("file").Get().path
        found = sorted(folder.glob(path.replace("<UDIM>", "*")))
        assert found == baked, path
        assert texture.GetInput("sourceColorSpace").Get() == "raw"
        if name == "normal":
            assert tuple(texture.GetInput("scale").Get()) == (2, 2, 2, 1)
            assert tuple(texture.GetInput("bias").Get()) == (-1, -1, -1, 0)
    assert bool(list(folder.glob("shape_height.*.exr"))) == bool(
        material.ComputeDisplacementSource()[0])


def judge_subsets(geom, shade, mesh):
    """Materials of the cage cover it, each face once, and show the look."""
    subsets = [
        geom.Subset(p) for p in mesh.GetPrim().GetChildren()
        if geom.Subset(p).GetFamilyNameAttr().Get() == "materialBind"]
    faces = [f for s in subsets for f in s.GetIndicesAttr().Get()]
    count = len(mesh.GetFaceVertexCountsAttr().Get())
    assert sorted(faces) == (list(range(count)) if subsets else [])
    for subset in subsets:
        bound, _ = shade.MaterialBindingAPI(subset.GetPrim()).ComputeBoundMaterial()
        assert bound.ComputeSurfaceSource()[0], subset


def judge_usd(folder):
    from pxr import Usd, UsdGeom, UsdShade

    stage = Usd.Stage.Open(str(folder / "shape.usda"))
    mesh = UsdGeom.Mesh(stage.GetPrimAtPath("/shape/Cage"))
    lines = (folder / "shape_cage.obj").read_text().splitlines()
    faces = [line for line in lines if line.startswith("f ")]
    assert list(mesh.GetFaceVertexCountsAttr().Get()) == [
        len(f.split()) - 1 for f in faces
    ]
    assert mesh.GetFaceVaryingLinearInterpolationAttr().Get() == "all"
    assert UsdGeom.Mesh.ValidateTopology(
        mesh.GetFaceVertexIndicesAttr().Get(),
        mesh.GetFaceVertexCountsAttr().Get(),
        len(mesh.GetPointsAttr().Get()),
    )[0]
    st = UsdGeom.PrimvarsAPI(mesh).GetPrimvar("st")
    assert len(st.ComputeFlattened()) == sum(len(f.split()) - 1 for f in faces)
    material, _ = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()
    assert material.ComputeSurfaceSource()[0]
    judge_maps(folder, UsdShade, material)
    judge_subsets(UsdGeom, UsdShade, mesh)
    judge_conformance(stage)
    print("USD reads shape.usda")


def judge_code(mx, document):
    """Renderers' code comes of it: OSL, GLSL and MDL."""
    import MaterialX.PyMaterialXGenGlsl as glsl
    import MaterialX.PyMaterialXGenMdl as mdl
    import MaterialX.PyMaterialXGenOsl as osl
    import MaterialX.PyMaterialXGenShader as shader

    elements = shader.findRenderableElements(document)
    assert elements
    for generator in (
            osl.OslShaderGenerator, glsl.GlslShaderGenerator,
            mdl.MdlShaderGenerator):
        made = generator.create()
        context = shader.GenContext(made)
        context.registerSourceCodeSearchPath(mx.getDefaultDataSearchPath())
        for element in elements:
            code = made.generate("shape", element, context)
            assert len(code.getSourceCode(shader.PIXEL_STAGE)) > 1000


def judge_materialx(folder):
    import MaterialX as mx

    document = mx.createDocument()
    mx.readFromXmlFile(document, str(folder / "shape.mtlx"))
    # Its nodes are of the standard library, which comes with the module.
    library = mx.createDocument()
    mx.loadLibraries(
        mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(),
        library)
    document.importLibrary(library)
    valid, message = document.validate()
    assert valid, message
    judge_code(mx, document)
    print("MaterialX reads shape.mtlx")


{"pxr": judge_usd, "MaterialX": judge_materialx}[sys.argv[1]](Path(sys.argv[2]))
