# SPDX-License-Identifier: MIT
"""Arrays of callers in the forms that the library reads; meshes of other packages by their attributes."""

from __future__ import annotations

import ctypes
import inspect
from ctypes import POINTER, c_double, c_float, c_uint32
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from ._structures import FLOAT32, FLOAT64

Positions = Union[npt.NDArray[np.float32], npt.NDArray[np.float64]]
MeshArrays = tuple[Positions, npt.NDArray[np.uint32]]

_POINTERS: dict[np.dtype[Any], Any] = {
    np.dtype(np.uint32): c_uint32,
    np.dtype(np.float32): c_float,
    np.dtype(np.float64): c_double,
}


def positions_of(values: npt.ArrayLike, name: str = "vertices") -> Positions:
    """Contiguous (n, 3) array of float32 or float64."""
    array = np.asarray(values)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError("{}: the shape is {}, not (n, 3)".format(name, array.shape))
    if array.dtype.kind not in "fiu":
        raise TypeError("{}: coordinates are real numbers, not {}".format(name, array.dtype))
    if array.dtype != np.float32:
        array = array.astype(np.float64, copy=False)
    return _native(array)


def faces_of(values: npt.ArrayLike) -> npt.NDArray[np.uint32]:
    """Contiguous (m, 3) array of uint32."""
    array = np.asarray(values)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError("faces: the shape is {}, not (m, 3)".format(array.shape))
    return ids_of(array, "faces")


def ids_of(values: npt.ArrayLike, name: str) -> npt.NDArray[np.uint32]:
    """Contiguous array of uint32, of any shape; no id is changed by the conversion."""
    array = np.asarray(values)
    if array.size == 0:
        return np.zeros(array.shape, np.uint32)
    if array.dtype.kind not in "iu":
        raise TypeError("{}: ids are integers, not {}".format(name, array.dtype))
    if array.min() < 0 or array.max() > 0xFFFFFFFF:
        raise ValueError("{}: ids lie from 0 to 2^32 - 1".format(name))
    return _native(array.astype(np.uint32, copy=False))


def _native(array: Any) -> Any:
    return np.ascontiguousarray(array, array.dtype.newbyteorder("="))


def type_of(positions: Positions) -> int:
    """The number type of positions, for the library."""
    return FLOAT32 if positions.dtype == np.float32 else FLOAT64


def pointer(array: npt.NDArray[Any]) -> Any:
    """The address of an array, which the caller keeps alive."""
    return array.ctypes.data_as(POINTER(_POINTERS[array.dtype]))


def copy_of_memory(address: int, shape: tuple[int, ...], dtype: npt.DTypeLike) -> npt.NDArray[Any]:
    """An array with a copy of memory of the library."""
    if 0 in shape:
        return np.zeros(shape, dtype)
    size = int(np.prod(shape)) * np.dtype(dtype).itemsize
    return np.frombuffer(ctypes.string_at(address, size), dtype).reshape(shape).copy()


def sealed(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """A copy of memory of the library, read-only: a change of the copy would not reach the mesh."""
    copy = array.copy()
    copy.flags.writeable = False
    return copy


def arrays_of(mesh: Any, faces: Any = None) -> MeshArrays:
    """Vertices and faces of a mesh: two arrays, a pair of arrays, or an object with attributes as those of trimesh
    (vertices, faces), PyVista (points, faces in one row, each after its number of corners) or meshio (points,
    cells_dict).

    >>> class Shape:
    ...     points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    ...     cells_dict = {"triangle": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]}
    >>> vertices, faces = arrays_of(Shape())
    >>> vertices.shape, faces.dtype
    ((4, 3), dtype('uint32'))
    """
    if faces is not None:
        return positions_of(mesh), faces_of(faces)
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        return positions_of(mesh.vertices), faces_of(mesh.faces)
    if hasattr(mesh, "points") and hasattr(mesh, "cells_dict"):
        return positions_of(mesh.points), faces_of(_triangles_of(mesh.cells_dict))
    if hasattr(mesh, "points") and hasattr(mesh, "faces"):
        return positions_of(mesh.points), faces_of(_triangles_of_row(mesh.faces))
    try:
        vertices, faces = mesh
    except (TypeError, ValueError):
        raise TypeError(
            "a mesh is given by vertices and faces, or has vertices and faces, points and faces, or points and cells_dict"
        ) from None
    return positions_of(vertices), faces_of(faces)


def _triangles_of(cells: Any) -> Any:
    others = sorted(kind for kind in cells if kind not in ("triangle", "vertex", "line"))
    if "triangle" not in cells or others:
        raise ValueError("the cells are not triangles alone, but {}".format(sorted(cells)))
    return cells["triangle"]


def _triangles_of_row(row: Any) -> npt.NDArray[Any]:
    """Triangles of 3, a, b, c, 3, d, e, f ... as VTK has them; a table (m, 3) stays."""
    cells = np.asarray(row)
    if cells.ndim == 2:
        return cells
    if cells.size % 4 or (cells[::4] != 3).any():
        raise ValueError("the faces are not triangles alone: call triangulate()")
    return cells.reshape(-1, 4)[:, 1:]


def like(example: Any, vertices: npt.ArrayLike, faces: npt.ArrayLike) -> Any:
    """The mesh as an object of the class of `example`, shaped like a trimesh.Trimesh, a pyvista.PolyData or a
    meshio.Mesh. Trimesh is told to keep vertices as they are (process=False): a merge of near vertices would undo the
    topology.

    >>> class Shape:
    ...     def __init__(self, vertices, faces):
    ...         self.vertices, self.faces = vertices, faces
    >>> like(Shape(None, None), [[0.0, 0.0, 0.0]], []).vertices
    [[0.0, 0.0, 0.0]]
    """
    kind = type(example)
    if hasattr(example, "cells_dict"):
        return kind(vertices, [("triangle", faces)])
    if hasattr(example, "points"):
        triangles = np.asarray(faces, np.int64)
        return kind(vertices, np.insert(triangles, 0, 3, axis=1).ravel())
    accepts = inspect.signature(kind).parameters
    options = {"process": False} if "process" in accepts else {}
    return kind(vertices=vertices, faces=faces, **options)
