import os
from typing import (
    Any, Callable, Dict, List, Mapping as Dictionary, Optional, Sequence, Tuple,
    Union)

import numpy
from numpy.typing import ArrayLike, NDArray

from .errors import Finding

Path = Union[str, bytes, os.PathLike[str]]
Floats = NDArray[numpy.float32]
Indices = NDArray[numpy.int32]
Constraint = Dictionary[str, Any]
Constraints = Union[Path, Sequence[Constraint]]
Also = Union[Exemplar, Tuple[Exemplar, Optional[str]],
             Tuple[Exemplar, Optional[str], float]]

def version() -> str: ...
def build() -> str: ...
def methods() -> Dict[str, Dict[str, Any]]: ...

class Context:
    def __init__(
        self, *, threads: int = ..., memory_limit: Optional[int] = ...,
        colorconfig: Optional[Path] = ...,
        progress: Optional[Callable[[str, float], Optional[bool]]] = ...,
        log: Optional[Callable[[Finding], object]] = ...) -> None: ...
    @property
    def findings(self) -> List[Finding]: ...
    @property
    def held_bytes(self) -> int: ...
    def read_cage(
        self, path: Path, *, scheme: str = ..., boundary: Optional[str] = ...,
        fvar: Optional[str] = ..., weld: float = ...) -> Cage: ...
    def read_exemplar(
        self, path: Path, *, from_space: Optional[str] = ...,
        to_space: Optional[str] = ..., match_space: Optional[str] = ...,
        embedding: str = ..., wrap: str = ..., tileable: str = ...,
        receiver: str = ..., textures: str = ...,
        layer: Optional[str] = ...,
        maps: Optional[Dictionary[str, Path]] = ...,
        normals_y_down: bool = ..., height_range: float = ...,
        height_middle: float = ...) -> Exemplar: ...
    def exemplar(
        self, pixels: ArrayLike, *, from_space: Optional[str] = ...,
        to_space: Optional[str] = ..., match_space: Optional[str] = ...,
        embedding: str = ..., wrap: str = ..., tileable: str = ...,
        receiver: str = ..., textures: str = ...,
        maps: Optional[Dictionary[str, Path]] = ...,
        normals_y_down: bool = ..., height_range: float = ...,
        height_middle: float = ...) -> Exemplar: ...
    def map(
        self, cage: Cage, exemplar: Exemplar, *,
        level: Union[int, str] = ..., scale: float = ...,
        method: Optional[str] = ...,
        settings: Optional[Dictionary[str, object]] = ..., seed: int = ...,
        heal: Union[float, str] = ...,
        constraints: Optional[Constraints] = ...,
        follow: Optional[str] = ..., exemplar_class: Optional[str] = ...,
        generators: Optional[Sequence[float]] = ...,
        mask: Optional[Path] = ..., along: Optional[str] = ...,
        first_face: int = ..., first_u: float = ..., first_v: float = ...,
        first_angle: float = ..., place: Optional[Path] = ...,
        keep: Optional[Mapping] = ..., also: Optional[Sequence[Also]] = ...
    ) -> Mapping: ...
    def read_mapping(
        self, path: Path, *, cage: Optional[Path] = ...,
        exemplar: Optional[Path] = ..., from_space: Optional[str] = ...,
        to_space: Optional[str] = ..., receiver: str = ...,
        textures: str = ...,
        maps: Optional[Dictionary[str, Path]] = ...,
        heal: Union[float, str] = ...,
        place: Optional[Path] = ...) -> Mapping: ...
    def cancel(self) -> None: ...
    def clear(self) -> None: ...
    def close(self) -> None: ...
    def __enter__(self) -> Context: ...
    def __exit__(self, *error: object) -> None: ...

class Cage:
    path: Optional[str]
    hash: Optional[str]
    vert_count: int
    face_count: int
    edge_count: int
    uv_count: int
    crease_count: int
    component_count: int
    lower: Tuple[float, float, float]
    upper: Tuple[float, float, float]
    diagonal: float
    default_scale: float

class Exemplar:
    path: Optional[str]
    hash: Optional[str]
    source_space: str
    linear_space: str
    width: int
    height: int
    channels: int
    wrap_x: bool
    wrap_y: bool
    pixels: Floats

class Mapping:
    uvs: Floats
    face_patch: Indices
    method: str
    scale: float
    face_count: int
    corner_count: int
    patch_count: int
    exemplar_count: int
    level: int
    origin: Tuple[float, float, float]
    points: Floats
    normals: Floats
    face_first: Indices
    face_verts: Indices
    face_cage: Indices
    def write(
        self, path: Path, *, normals: bool = ..., without_image: bool = ...,
        resolution: int = ...) -> None: ...
    def save(self, path: Path) -> None: ...
    def edit(
        self, constraints: Optional[Constraints] = ..., *,
        redo: Union[None, int, Sequence[float]] = ..., seed: int = ...,
        reach: float = ...) -> Mapping: ...
    def seams(self, *, places: int = ...) -> Seams: ...
    def report(self, *, windows: int = ...) -> Dict[str, Any]: ...
    def bake(
        self, path: Path, *, resolution: int = ..., uvs: str = ...,
        margin: int = ..., texels_per_unit: float = ...,
        seam_blend: float = ..., extras: Sequence[str] = ..., udim: int = ...,
        preview_png: bool = ..., up_axis: str = ...,
        meters_per_unit: float = ..., normals: bool = ...) -> None: ...
    def textures(
        self, *, resolution: int = ..., uvs: str = ..., margin: int = ...,
        texels_per_unit: float = ..., seam_blend: float = ...,
        extras: Sequence[str] = ..., udim: int = ...) -> Textures: ...
    def render(
        self, *, width: int = ..., height: int = ..., samples: int = ...,
        show: Optional[str] = ..., view: Optional[str] = ..., turn: float = ...,
        eye: Sequence[float] = ..., target: Sequence[float] = ...,
        fov: float = ..., unlit: bool = ..., transparent: bool = ...,
        plain: bool = ..., displace: bool = ...) -> Floats: ...

class Seams:
    corners: Indices
    differences: Floats
    places: List[Dict[str, Any]]

class Textures:
    names: Tuple[str, ...]
    tiles: Tuple[int, ...]
    side: int
    level_count: int
    color_space: Optional[str]
    cage_uvs: Floats
    face_uvs: Indices
    def read(
        self, name: str = ..., tile: int = ..., level: int = ...) -> Floats: ...
