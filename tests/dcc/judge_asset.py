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
    judge_conformance(stage)
    print("USD reads shape.usda")


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
    print("MaterialX reads shape.mtlx")


{"pxr": judge_usd, "MaterialX": judge_materialx}[sys.argv[1]](Path(sys.argv[2]))
