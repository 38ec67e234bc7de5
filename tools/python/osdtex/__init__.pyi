import contextlib
import os
import typing
from typing import Any, Mapping as Dictionary, Optional, Sequence, Tuple, Union

import numpy
from numpy.typing import ArrayLike

from . import _osdtex
from ._osdtex import (
    Cage as Cage, Exemplar as Exemplar, Mapping as Mapping,
    Seams as Seams, Textures as Textures, build as build, methods as methods,
    version as version)
from .errors import (
    ArgumentError as ArgumentError, Cancelled as Cancelled,
    ColourError as ColourError, Error as Error, FileError as FileError,
    Finding as Finding, FormatError as FormatError,
    InternalError as InternalError, LimitError as LimitError,
    NumericError as NumericError, OutOfMemory as OutOfMemory,
    SupportError as SupportError, TopologyError as TopologyError)

__version__: str

class Context(_osdtex.Context):
    def cage(
        self, points: ArrayLike,
        faces: Union[numpy.ndarray, Sequence[Sequence[int]]], *,
        uvs: Optional[ArrayLike] = ...,
        face_uvs: Union[None, numpy.ndarray, Sequence[Sequence[int]]] = ...,
        creases: Optional[Dictionary[Tuple[int, int], float]] = ...,
        corners: Optional[Dictionary[int, float]] = ...,
        holes: Optional[Sequence[int]] = ...,
        scheme: str = ..., boundary: Optional[str] = ...,
        fvar: Optional[str] = ..., weld: float = ...) -> Cage: ...
    def outputs(
        self, job: Optional[str] = ...,
        source: Union[None, str, os.PathLike[str]] = ...
    ) -> contextlib.AbstractContextManager[Context]: ...
    def __enter__(self) -> Context: ...
