# SPDX-License-Identifier: MIT
"""Arrays over the memory of a context, without a copy."""

from ctypes import byref, c_uint32, c_void_p

import numpy as np

from . import _structures as s
from ._library import lib
from .errors import ViewError, check

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

    def __init__(self, mesh):
        self._mesh = mesh
        self._open = False

    def __enter__(self):
        with self._mesh._lock:
            if self._open:
                raise ViewError("the view is open already")
            self._mesh_view()  # raises StateError without a mesh
            self._mesh._open_views += 1
            self._open = True
        return self

    def __exit__(self, *error):
        with self._mesh._lock:
            self._open = False
            self._mesh._open_views -= 1

    @property
    def epoch(self):
        return self._read(lambda: self._mesh_view().epoch)

    @property
    def vertices(self):
        return self._read(lambda: self._of_mesh("positions", "vertex_count", _FLOAT64))

    @property
    def faces(self):
        return self._read(lambda: self._of_mesh("triangles", "triangle_count", _UINT32))

    @property
    def opposites(self):
        return self._read(lambda: self._of_mesh("opposites", "triangle_count", _UINT32))

    @property
    def old_to_new(self):
        return self._read(lambda: self._of_map(lib.tpa_vertex_map, s.tpa_vertex_map_view, "old", _UINT32))

    @property
    def origins(self):
        return self._read(lambda: self._of_map(lib.tpa_vertex_map, s.tpa_vertex_map_view, "new", ORIGIN))

    @property
    def face_origins(self):
        return self._read(lambda: self._of_map(lib.tpa_triangle_map, s.tpa_triangle_map_view, "new", _UINT32))

    @property
    def rolled_back(self):
        return self._read(self._rolled_back)

    def _read(self, read):
        with self._mesh._lock:
            if not self._open:
                raise ViewError("the view is closed: use it inside its `with` block")
            return read()

    def _mesh_view(self):
        view = s.sized(s.tpa_mesh_view)
        check(lib.tpa_view(self._mesh._context, byref(view)))
        return view

    def _of_mesh(self, field, count, dtype):
        view = self._mesh_view()
        return self._mesh._export(getattr(view, field), (getattr(view, count), 3), dtype)

    def _of_map(self, function, structure, side, dtype):
        view = s.sized(structure)
        check(function(self._mesh._context, byref(view)))
        field = "old_to_new" if side == "old" else "origins"
        return self._mesh._export(getattr(view, field), (getattr(view, side + "_count"),), dtype)

    def _rolled_back(self):
        vertices, count = c_void_p(), c_uint32()
        check(lib.tpa_rolled_back(self._mesh._context, byref(vertices), byref(count)))
        return self._mesh._export(vertices.value, (count.value,), _UINT32)
