"""addon_session -- in Blender: install the add-on, texture a cage with it, and
say what came back.

    blender -b --factory-startup --python addon_session.py -- \
        ADDON.zip OSDTEX FOLDER PICTURE MATERIAL
"""

import importlib
import sys
from pathlib import Path

import bpy

ZIP, OSDTEX, FOLDER, PICTURE, MATERIAL = sys.argv[sys.argv.index("--") + 1 :]
FOLDER = Path(FOLDER)
QUICK = dict(program=OSDTEX, resolution=128, level="1", levels=1)


def install():
    bpy.ops.preferences.addon_install(filepath=ZIP, overwrite=True)
    bpy.ops.preferences.addon_enable(module="osdtex_blender")


def box(work):
    """A box of 3 x 2 x 1 with a crease, a corner, directions and sizes."""
    x, y, z = 1.5, 1.0, 0.5
    points = [(-x, -y, -z), (x, -y, -z), (x, y, -z), (-x, y, -z),
              (-x, -y, z), (x, -y, z), (x, y, z), (-x, y, z)]
    faces = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5),
             (2, 3, 7, 6), (3, 0, 4, 7)]
    mesh = bpy.data.meshes.new("box")
    mesh.from_pydata(points, [], faces)
    part = bpy.data.objects.new("box.001", mesh)
    part.location = (0, 0, 5)
    bpy.context.scene.collection.objects.link(part)
    bpy.context.view_layer.objects.active = part
    top = next(e for e in mesh.edges if set(e.vertices) == {4, 5})
    if bpy.app.version >= (4, 0, 0):
        mesh.attributes.new(
            "crease_edge", "FLOAT", "EDGE").data[top.index].value = 0.5
        mesh.attributes.new("crease_vert", "FLOAT", "POINT").data[6].value = 1.0
    else:
        top.crease = 0.5
        work.osdtex_import.set_corners(mesh, {6: 10.0})
    pull = mesh.attributes.new("pull", "FLOAT_VECTOR", "FACE")
    pull.data[1].vector = (0, 1, 0)
    size = mesh.attributes.new("size", "FLOAT", "FACE")
    size.data[1].value = 2.0
    paint = mesh.attributes.new("paint", "FLOAT_COLOR", "POINT")
    for i in range(8):
        paint.data[i].color = (1.0, 0.5, 0.5, 1.0) if i < 4 else (0.5,) * 4
    return part


def crease_at(mesh, pair):
    edge = next(e for e in mesh.edges if set(e.vertices) == pair)
    if bpy.app.version >= (4, 0, 0):
        return mesh.attributes["crease_edge"].data[edge.index].value
    return edge.crease


def corner_at(mesh, vertex):
    if bpy.app.version >= (4, 0, 0):
        return mesh.attributes["crease_vert"].data[vertex].value
    return mesh.vertex_creases[0].data[vertex].value


def near(a, b):
    return abs(a - b) < 1e-4


def node_behind(node, socket):
    links = node.inputs[socket].links
    return links[0].from_node if links else None


def check_shape(part, made):
    a, b = part.data, made.data
    assert [tuple(f.vertices) for f in a.polygons] == [
        tuple(f.vertices) for f in b.polygons]
    assert all((v.co - w.co).length < 1e-5
               for v, w in zip(a.vertices, b.vertices))
    assert made.location == part.location and part.hide_get()
    assert part.hide_render and not made.hide_render
    assert near(crease_at(b, {4, 5}), 0.5), crease_at(b, {4, 5})
    assert near(corner_at(b, 6), 1.0)
    modifier = made.modifiers[0]
    assert modifier.type == "SUBSURF" and modifier.use_creases
    assert modifier.uv_smooth == "NONE" and modifier.use_limit_surface


def check_look(made, has_maps):
    tree = made.data.materials[0].node_tree
    surface = next(n for n in tree.nodes if n.type == "BSDF_PRINCIPLED")
    picture = node_behind(surface, "Base Color").image
    # A tiled image is loaded when it is asked for, some of them lazily.
    assert picture.source == "TILED" or (
        picture.size[0] == 128 and picture.is_float), (
            picture.source, picture.filepath, picture.name, list(picture.size),
            [t.number for t in picture.tiles])
    if not has_maps:
        return picture
    for socket in ("Roughness", "Metallic"):
        image = node_behind(surface, socket).image
        assert image.colorspace_settings.name == "Non-Color", socket
    assert node_behind(surface, "Normal").type == "NORMAL_MAP"
    output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
    assert node_behind(output, "Displacement").type == "DISPLACEMENT"
    return picture


def check_refusals(work, part):
    Failed = work.osdtex_job.Failed
    for wish, words in (
            (work.Wish(**QUICK), "choose a picture"),
            (work.Wish(exemplar="/no/such.png", **QUICK), "such.png"),
            (work.Wish(exemplar=PICTURE, constraints="gone", **QUICK), "'gone'"),
            (work.Wish(exemplar=PICTURE, program="/no/osdtex"), "/no/osdtex")):
        try:
            work.texture(part, wish)
        except Failed as error:
            assert words in str(error), (words, str(error))
        else:
            raise AssertionError(words)


def check_stop(work, part):
    folder = FOLDER / "stopped"
    wish = work.Wish(
        exemplar=PICTURE, folder=str(folder), program=OSDTEX, level="6",
        resolution=2048)
    try:
        work.texture(part, wish, lambda stage, percent: False)
    except work.osdtex_job.Failed as error:
        assert str(error) == "stopped", error
    else:
        raise AssertionError("it was not stopped")
    assert not list(folder.glob("*_cage.obj")) + list(folder.glob("*.exr"))


def main():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    install()
    work = importlib.import_module("osdtex_blender.work")
    part = box(work)
    assert work.directions_of(part, "pull") == {1: (0.0, 1.0, 0.0)}
    painted = work.directions_of(part, "paint")
    assert set(painted) == {0, 2, 3, 4, 5} and painted[0][0] > 3.99, painted
    assert work.sizes_of(part, "size") == {1: 2.0}
    check_refusals(work, part)

    made = work.texture(part, work.Wish(
        exemplar=PICTURE, folder=str(FOLDER / "one"), constraints="pull",
        sizes="size", **QUICK))
    check_shape(part, made)
    check_look(made, False)
    part.hide_set(False)

    made = work.texture(part, work.Wish(
        exemplar=MATERIAL, folder=str(FOLDER / "set"),
        more=("--texels-per-unit", "40"), **QUICK))
    picture = check_look(made, True)
    assert picture.source == "TILED" and len(picture.tiles) > 1
    part.hide_set(False)
    check_stop(work, part)

    settings = bpy.context.scene.osdtex
    settings.exemplar, settings.folder = PICTURE, str(FOLDER / "panel")
    settings.resolution = 128
    bpy.context.preferences.addons["osdtex_blender"].preferences.program = OSDTEX
    bpy.context.view_layer.objects.active = part
    assert bpy.ops.osdtex.texture() == {"FINISHED"}
    assert bpy.ops.osdtex.export(filepath=str(FOLDER / "out.obj")) == {"FINISHED"}
    tags = [line for line in (FOLDER / "out.obj").read_text().splitlines()
            if line.startswith("t ")]
    assert tags == ["t crease 2/1/0 4 5 2.5", "t corner 1/1/0 6 10"], tags
    bpy.ops.preferences.addon_disable(module="osdtex_blender")
    print("addon fine", bpy.app.version_string)


main()
