"""Textures subdivision surfaces from a picture of a material.

    import osdtex

    with osdtex.Context() as context:
        cage = context.read_cage("creature.obj")
        exemplar = context.read_exemplar("grass.png")
        mapping = context.map(cage, exemplar, scale=2.0)
        mapping.write("out/creature.obj")

docs/python.md goes through all of it.
"""

import contextlib

import numpy

from . import _osdtex
from ._osdtex import (
    Cage, Exemplar, Mapping, Seams, Textures, build, methods, version)
from .errors import (
    ArgumentError, Cancelled, ColourError, Error, FileError, Finding,
    FormatError, InternalError, LimitError, NumericError, OutOfMemory,
    SupportError, TopologyError)

__version__ = version()
__all__ = [
    "ArgumentError", "Cage", "Cancelled", "ColourError", "Context", "Error",
    "Exemplar", "FileError", "Finding", "FormatError", "InternalError",
    "LimitError", "Mapping", "NumericError", "OutOfMemory", "Seams",
    "SupportError", "Textures", "TopologyError", "build", "methods", "version"]


def _indices(values):
    """As the library has them: what does not fit would become another one."""
    array = numpy.asarray(values)
    whole = array.astype("i4")
    if not (whole == array).all():
        raise ValueError(
            "vertices and faces are named by whole numbers below 2^31")
    return whole


def _flatten(faces):
    """Sizes of faces and their vertices, of an array or of lists."""
    if isinstance(faces, numpy.ndarray) and faces.ndim == 2:
        return (numpy.full(len(faces), faces.shape[1], "i4"),
                _indices(faces.ravel()))
    sizes = numpy.array([len(face) for face in faces], "i4")
    return sizes, _indices([vertex for face in faces for vertex in face])


def _sharp(pairs):
    """What is sharp and how sharp, of a dictionary; two Nones of none."""
    if not pairs:
        return None, None
    return (_indices(list(pairs.keys())),
            numpy.array(list(pairs.values()), "f4"))


class Context(_osdtex.Context):
    """Memory, threads, colour, and where findings go."""

    def cage(self, points, faces, *, uvs=None, face_uvs=None, creases=None,
             corners=None, holes=None, **options):
        """A cage of arrays: points (n x 3), faces (m x 4, or lists)."""
        sizes, verts = _flatten(faces)
        return self._make_cage(
            points, sizes, verts, uvs,
            None if face_uvs is None else _flatten(face_uvs)[1],
            *_sharp(creases), *_sharp(corners),
            None if holes is None else _indices(holes), **options)

    @contextlib.contextmanager
    def outputs(self, job=None, source=None):
        """What is written within appears together at its end, or not at all."""
        self._begin(job, None if source is None else str(source))
        try:
            yield self
        except BaseException:
            self._drop()
            raise
        self._commit()
