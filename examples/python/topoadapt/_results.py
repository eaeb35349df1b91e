# SPDX-License-Identifier: MIT
"""Results of the last commit of a context."""

from __future__ import annotations

from ctypes import byref, c_uint32, c_void_p
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _structures as s
from ._context import Context
from ._inputs import pointer, sealed
from ._library import lib
from .errors import check
from .records import Changes, Component, Event, VertexMap, read, read_events


class Results(Context):
    """Events, components, maps, and attributes carried by the maps."""

    def events(self) -> list[Event]:
        """The changes of topology in the last commit: a list of Event. A component that comes apart is one event."""
        with self._lock:
            events, count = c_void_p(), c_uint32()
            check(lib.tpa_events(self._context, byref(events), byref(count)))
            if not count.value:
                return []
            return read_events((s.tpa_event * count.value).from_address(events.value or 0))

    def components(self) -> list[Component]:
        """The connected components, ascending by id: a list of Component."""
        return self._components()[0]

    def component_labels(self) -> npt.NDArray[np.uint32]:
        """For each vertex the place of its component in components(): an (n,) array."""
        return self._components()[1]

    def _components(self) -> tuple[list[Component], npt.NDArray[np.uint32]]:
        with self._lock:
            count, issue, view = c_uint32(), s.tpa_issue(), s.sized(s.tpa_mesh_view)
            check(lib.tpa_view(self._context, byref(view)))
            lib.tpa_components(self._context, None, 0, None, byref(count), None)
            components = (s.tpa_component * count.value)()
            labels = np.zeros(view.vertex_count, np.uint32)
            check(
                lib.tpa_components(self._context, components, count, labels.ctypes.data, byref(count), byref(issue)),
                issue,
            )
            labels.flags.writeable = False
            return [read(Component, component) for component in components], labels

    def rolled_back(self) -> npt.NDArray[np.uint32]:
        """Ids of the vertices left at their old positions by the last step."""
        with self._lock, self.view() as view:
            return sealed(view.rolled_back)

    def vertex_map(self) -> VertexMap:
        """How the last commit renumbered vertices: a VertexMap."""
        with self._lock, self.view() as view:
            origins = view.origins
            return VertexMap(sealed(view.old_to_new), sealed(origins["parents"]), sealed(origins["weight"]))

    def face_map(self) -> npt.NDArray[np.uint32]:
        """The triangle before the last commit that each triangle is part of: (m,) ids, NONE for new surface."""
        with self._lock, self.view() as view:
            return sealed(view.face_origins)

    def carry_vertices(self, values: npt.ArrayLike) -> npt.NDArray[Any]:
        """Values for each vertex before the last commit, as (old count, ...) numbers, taken to the vertices after. New
        vertices take the weighted mean of their parents, in double precision. float32 stays float32; all other numbers
        become float64.

        >>> from topoadapt import Mesh
        >>> mesh = Mesh(*ball(edge_length=0.5))
        >>> heights = mesh.vertices[:, 2]
        >>> _ = mesh.remesh(0.25, relaxation=0)
        >>> carried = mesh.carry_vertices(heights)
        >>> bool(abs(carried - mesh.vertices[:, 2]).max() < 0.25)  # within an edge length
        True
        """
        before = _numbers(values)
        with self._lock:
            carry = lib.tpa_carry_vertices if before.dtype == np.float32 else lib.tpa_carry_vertices_f64
            return self._carry(carry, lib.tpa_vertex_map, s.tpa_vertex_map_view, before)

    def carry_triangles(self, values: npt.ArrayLike) -> npt.NDArray[Any]:
        """The same for triangles, which take the values of their origins, bit for bit, or of the nearest triangle with
        one."""
        before = _numbers(values)
        with self._lock:
            if before.dtype == np.float32:
                return self._carry(lib.tpa_carry_triangles, lib.tpa_triangle_map, s.tpa_triangle_map_view, before)
            # The library copies bits: a double goes as two words.
            words = np.ascontiguousarray(before)[..., np.newaxis].view(np.float32)
            after = self._carry(lib.tpa_carry_triangles, lib.tpa_triangle_map, s.tpa_triangle_map_view, words)
            return after.view(np.float64)[..., 0]

    def _carry(self, carry: Any, counts: Any, structure: Any, values: npt.NDArray[Any]) -> npt.NDArray[Any]:
        before = np.ascontiguousarray(values)
        view = s.sized(structure)
        check(counts(self._context, byref(view)))
        _check_count(before, view.old_count)
        after = np.zeros((view.new_count,) + before.shape[1:], before.dtype)
        width = int(np.prod(before.shape[1:], dtype=np.int64))
        if width:
            check(carry(self._context, pointer(before), width, pointer(after)))
        return after

    def changes(self, gap: int = 0) -> Changes:
        """The parts of vertices and faces to copy into arrays of before the last commit: Changes. Ranges with at most
        `gap` unchanged elements between them become one."""
        with self._lock:
            view = s.sized(s.tpa_mesh_view)
            check(lib.tpa_view(self._context, byref(view)))
            vertices = np.zeros((view.vertex_count // 2 + 1, 2), np.uint32)
            faces = np.zeros((view.triangle_count // 2 + 1, 2), np.uint32)
            changes, issue = s.sized(s.tpa_change_list, gap=gap), s.tpa_issue()
            changes.vertex_capacity, changes.triangle_capacity = len(vertices), len(faces)
            changes.vertices, changes.triangles = vertices.ctypes.data, faces.ctypes.data
            check(lib.tpa_changes(self._context, byref(changes), byref(issue)), issue)
            return Changes(
                sealed(vertices[: changes.vertex_ranges]),
                sealed(faces[: changes.triangle_ranges]),
                changes.changed_vertices,
                changes.changed_triangles,
            )


def _numbers(values: npt.ArrayLike) -> npt.NDArray[Any]:
    """Values as float32 or float64."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiub":
        raise TypeError("attributes are real numbers, not {}".format(array.dtype))
    return array if array.dtype == np.float32 else array.astype(np.float64, copy=False)


def _check_count(values: npt.NDArray[Any], old_count: int) -> None:
    if values.ndim < 1 or len(values) != old_count:
        raise ValueError("values have shape {}, for {} old ids".format(values.shape, old_count))
