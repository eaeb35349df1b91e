# SPDX-License-Identifier: MIT
"""Arrays over the memory of a context, without a copy."""

from __future__ import annotations

from ctypes import byref, c_uint32, c_void_p
from typing import TYPE_CHECKING, Any, Callable, TypeVar

import numpy as np
import numpy.typing as npt

from . import _structures as s
from ._library import lib
from .errors import ViewError, check

if TYPE_CHECKING:
    from ._context import Context

_T = TypeVar("_T")

ORIGIN = np.dtype([("parents", np.uint32, 2), ("weight", np.float32)])
_FLOAT64, _UINT32 = np.dtype(np.float64), np.dtype(np.uint32)


class View:
    """The mesh and the maps of the last commit, read-only and without a copy, within a `with` block.

    The pointers of the library hold until the next call that writes, so no such call is made while they are in use:
    Inside the block, calls that write raise ViewError; so they do after the block, for as long as an array of the view
    is left (as a bytearray refuses to be resized while a memoryview is open). After the block the view raises
    ViewError. An array left over never changes and never dangles, since it keeps its memory alive.

    Attributes: `vertices` (n, 3) float64, `faces` (m, 3) uint32, `opposites` (m, 3) uint32 half-edges, `epoch`;
    of the last commit: `old_to_new`, `origins` (n,) with fields `parents` and `weight`, `face_origins`, `rolled_back`.
    """

    def __init__(self, mesh: Context) -> None:
        self._mesh = mesh
        self._open = False

    def __enter__(self) -> View:
        with self._mesh._lock:
            if self._open:
                raise ViewError("the view is open already")
            self._mesh_view()  # raises StateError without a mesh
            self._mesh._open_views += 1
            self._open = True
        return self

    def __exit__(self, *error: Any) -> None:
        with self._mesh._lock:
            self._open = False
            self._mesh._open_views -= 1

    @property
    def epoch(self) -> int:
        return self._read(lambda: self._mesh_view().epoch)

    @property
    def vertices(self) -> npt.NDArray[np.float64]:
        return self._read(lambda: self._of_mesh("positions", "vertex_count", _FLOAT64))

    @property
    def faces(self) -> npt.NDArray[np.uint32]:
        return self._read(lambda: self._of_mesh("triangles", "triangle_count", _UINT32))

    @property
    def opposites(self) -> npt.NDArray[np.uint32]:
        return self._read(lambda: self._of_mesh("opposites", "triangle_count", _UINT32))

    @property
    def old_to_new(self) -> npt.NDArray[np.uint32]:
        return self._read(lambda: self._of_map(lib.tpa_vertex_map, s.tpa_vertex_map_view, "old", _UINT32))

    @property
    def origins(self) -> npt.NDArray[np.void]:
        return self._read(lambda: self._of_map(lib.tpa_vertex_map, s.tpa_vertex_map_view, "new", ORIGIN))

    @property
    def face_origins(self) -> npt.NDArray[np.uint32]:
        return self._read(lambda: self._of_map(lib.tpa_triangle_map, s.tpa_triangle_map_view, "new", _UINT32))

    @property
    def rolled_back(self) -> npt.NDArray[np.uint32]:
        return self._read(self._rolled_back)

    def _read(self, read: Callable[[], _T]) -> _T:
        with self._mesh._lock:
            if not self._open:
                raise ViewError("the view is closed: use it inside its `with` block")
            return read()

    def _mesh_view(self) -> s.tpa_mesh_view:
        view = s.sized(s.tpa_mesh_view)
        check(lib.tpa_view(self._mesh._context, byref(view)))
        return view

    def _of_mesh(self, field: str, count: str, dtype: np.dtype[Any]) -> npt.NDArray[Any]:
        view = self._mesh_view()
        return self._mesh._export(getattr(view, field), (getattr(view, count), 3), dtype)

    def _of_map(self, function: Any, structure: Any, side: str, dtype: np.dtype[Any]) -> npt.NDArray[Any]:
        view = s.sized(structure)
        check(function(self._mesh._context, byref(view)))
        field = "old_to_new" if side == "old" else "origins"
        return self._mesh._export(getattr(view, field), (getattr(view, side + "_count"),), dtype)

    def _rolled_back(self) -> npt.NDArray[np.uint32]:
        vertices, count = c_void_p(), c_uint32()
        check(lib.tpa_rolled_back(self._mesh._context, byref(vertices), byref(count)))
        return self._mesh._export(vertices.value or 0, (count.value,), _UINT32)
