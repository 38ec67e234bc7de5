"""work -- from an object to files, through the program, and back to an object.

Nothing here needs a window: the panel and scripts share it.
"""

import dataclasses
import re
import tempfile
from pathlib import Path

import bpy

from . import osdtex_cage, osdtex_import, osdtex_job


@dataclasses.dataclass
class Wish:
    """What is asked for; the flags of `osdtex bake` say what each means."""

    exemplar: str = ""       # a picture, or a folder that holds a material
    scale: float = 0.0       # scene units, 0: chosen
    method: str = ""         # "": the first
    resolution: int = 2048
    level: str = "auto"
    scheme: str = "catmark"
    uvs: str = "auto"
    constraints: str = ""    # an attribute of directions or colours; "": none
    sizes: str = ""          # an attribute of sizes; "": none
    follow: str = ""
    seed: int = 1
    folder: str = ""         # "": beside the .blend, or a temporary one
    program: str = ""
    levels: int = 3          # of the modifier
    more: tuple = ()         # other words of the command line


# ---- the cage --------------------------------------------------------------


def sharpness_of(crease):
    """The inverse of osdtex_import.crease_of."""
    return 10.0 * crease * crease


def creases_of(mesh):
    if bpy.app.version >= (4, 0, 0):
        layer = mesh.attributes.get("crease_edge")
        values = [v.value for v in layer.data] if layer else []
    else:
        values = [e.crease for e in mesh.edges]
    return {tuple(mesh.edges[i].vertices): sharpness_of(v)
            for i, v in enumerate(values) if v > 0.0}


def corners_of(mesh):
    if bpy.app.version >= (4, 0, 0):
        layer = mesh.attributes.get("crease_vert")
        data = layer.data if layer else ()
    else:
        data = mesh.vertex_creases[0].data if mesh.vertex_creases else ()
    return {i: sharpness_of(v.value) for i, v in enumerate(data)
            if v.value > 0.0}


def uvs_of(mesh):
    layer = mesh.uv_layers.active
    if not layer:
        return None
    return [[tuple(layer.data[i].uv) for i in face.loop_indices]
            for face in mesh.polygons]


def materials_of(mesh):
    names = [m.name if m else f"slot_{i}" for i, m in enumerate(mesh.materials)]
    if len(names) < 2:
        return None
    return [names[face.material_index] for face in mesh.polygons]


def export_cage(part, path):
    """The mesh as it is modelled, before modifiers, in its own coordinates."""
    mesh = part.data
    if not mesh.polygons:
        raise osdtex_job.Failed(f"'{part.name}' has no faces")
    osdtex_cage.write_cage(
        path, [tuple(v.co) for v in mesh.vertices],
        [list(f.vertices) for f in mesh.polygons], uvs_of(mesh),
        creases_of(mesh), corners_of(mesh), materials_of(mesh))


# ---- constraints -----------------------------------------------------------


def elements_of(face, domain):
    if domain == "FACE":
        return [face.index]
    return face.vertices if domain == "POINT" else face.loop_indices


def value_of(item):
    for key in ("vector", "color", "value"):
        if hasattr(item, key):
            return getattr(item, key)
    raise osdtex_job.Failed("the attribute holds neither vectors nor colours")


def attribute_of(part, name):
    layer = part.data.attributes.get(name)
    if layer is None or layer.domain not in ("FACE", "POINT", "CORNER"):
        raise osdtex_job.Failed(
            f"'{part.name}' has no attribute '{name}' on faces, points or corners")
    return layer


def directions_of(part, name):
    """By face: the mean of what its points or corners say. Colours are taken as
    in normal maps, and grey for nothing."""
    layer = attribute_of(part, name)
    is_colour = "COLOR" in layer.data_type
    found = {}
    for face in part.data.polygons:
        total = [0.0, 0.0, 0.0]
        for i in elements_of(face, layer.domain):
            value = value_of(layer.data[i])
            if is_colour:
                value = osdtex_cage.direction_of_colour(value) or (0, 0, 0)
            total = [a + b for a, b in zip(total, value)]
        if max(map(abs, total)) > 1e-6:
            found[face.index] = tuple(total)
    return found


def sizes_of(part, name):
    layer = attribute_of(part, name)
    found = {}
    for face in part.data.polygons:
        own = [value_of(layer.data[i])
               for i in elements_of(face, layer.domain)]
        mean = sum(own) / len(own)
        if mean > 0.0:
            found[face.index] = mean
    return found


def export_constraints(part, wish, path):
    """Whether anything is asked for."""
    directions = directions_of(part, wish.constraints) if wish.constraints else {}
    sizes = sizes_of(part, wish.sizes) if wish.sizes else {}
    if not directions and not sizes:
        return False
    osdtex_cage.write_constraints(path, directions, sizes)
    return True


# ---- the job ---------------------------------------------------------------


def folder_of(wish):
    if wish.folder:
        folder = Path(bpy.path.abspath(wish.folder))
    elif bpy.data.filepath:
        folder = Path(bpy.path.abspath("//")) / "osdtex"
    else:
        folder = Path(tempfile.mkdtemp(prefix="osdtex_"))
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def begin(part, wish):
    """Writes the cage and starts the program: the job, and the file that it
    will have written."""
    if part is None or part.type != "MESH":
        raise osdtex_job.Failed("choose a mesh: the cage")
    if not wish.exemplar:
        raise osdtex_job.Failed("choose a picture, or a folder of a material")
    folder = folder_of(wish)
    name = re.sub(r"[^A-Za-z0-9_-]", "_", part.name) or "part"
    cage, table = folder / f"{name}_source.obj", folder / f"{name}_source.csv"
    export_cage(part, cage)
    has_table = export_constraints(part, wish, table)
    words = osdtex_job.bake_words(
        cage, folder / f"{name}.obj",
        bpy.path.abspath(wish.exemplar).rstrip("/\\"),
        scale=wish.scale or None, method=wish.method,
        resolution=wish.resolution, level=wish.level, scheme=wish.scheme,
        uvs=wish.uvs, follow=wish.follow, seed=wish.seed,
        constraints=table if has_table else None, up="z", **{"for": "blender"})
    job = osdtex_job.start(words + list(wish.more), wish.program)
    return job, folder / f"{name}_cage.obj"


def finish(part, result, levels):
    """The textured cage in the place of `part`, which is hidden."""
    made = osdtex_import.load(result, levels, "Y", "Z")
    made.name = f"{part.name} osdtex"
    made.matrix_world = part.matrix_world.copy()
    for material in made.data.materials:
        for node in material.node_tree.nodes if material else ():
            if node.type == "TEX_IMAGE" and node.image:
                node.image.reload()  # of an earlier job, with the same name
    part.hide_render = True
    if part.name in bpy.context.view_layer.objects:
        part.hide_set(True)
    return made


def texture(part, wish, progress=None):
    """All of it, waiting. `progress(stage, percent)` stops it by returning
    False."""
    job, result = begin(part, wish)
    while job.poll():
        if progress and progress(job.stage, job.percent) is False:
            job.cancel()
        try:
            job.process.wait(0.1)
        except Exception:
            continue
    job.check()
    return finish(part, result, wish.levels)
