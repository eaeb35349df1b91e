# SPDX-License-Identifier: MIT
"""A moving mesh: in and out, and the work on it."""

from __future__ import annotations

import ctypes
from ctypes import byref, c_size_t, c_uint32, c_uint64
from typing import Any, Optional, TypeVar

import numpy as np
import numpy.typing as npt

from . import _structures as s
from ._inputs import arrays_of, copy_of_memory, ids_of, pointer, positions_of, sealed, type_of
from ._library import lib
from ._results import Results
from .control import Control, exec_of
from .errors import check
from .records import Report, Validation, read

_M = TypeVar("_M", bound="Mesh")


class Mesh(Results):
    """A closed triangle mesh that moves, and changes its topology where it runs into itself.

    vertices, faces: (n, 3) and (m, 3) arrays, or an object with .vertices and .faces (trimesh), .points and .faces
        (PyVista), or .points and .cells_dict (meshio) alone, or nothing: then load() or restore() comes first.
    grow: whether a call that reaches a limit of the config continues in a larger block. Otherwise, and above max_bytes,
        LimitError. By default, unless `memory` is given. Results do not depend on limits.
    memory: a writable buffer for the context, such as a bytearray or an array, in place of a block of its own.
    max_bytes: bound on the block. None: no bound.
    config: fields of tpa_config, as max_vertices=1000 or region=Region.OUTSIDE.

    Each method raises a subclass of Error on failure, and leaves everything as it was. Calls from several threads wait
    for each other. Methods return copies, read-only where they tell of the mesh: move() and load() change the mesh, and
    a change of a copy would not. view() gives arrays without a copy.

    >>> vertices, faces = ball(edge_length=0.3)
    >>> mesh = Mesh(vertices, faces)
    >>> mesh.move(mesh.vertices * [1, 1, 0.5])
    >>> report = mesh.step()
    >>> report.contacts, mesh.validate().genus
    (0, 0)
    """

    def __init__(
        self,
        vertices: Any = None,
        faces: Any = None,
        *,
        grow: Optional[bool] = None,
        memory: Optional[Any] = None,
        max_bytes: Optional[int] = None,
        **config: Any,
    ) -> None:
        given = None if vertices is None else arrays_of(vertices, faces)
        super().__init__(max(4096, 2 * len(given[0])) if given else 4096, grow, memory, max_bytes, config)
        if given:
            self.load(*given)

    # ------------------------------------------------------------------ mesh in and out

    def load(self, vertices: Any, faces: Any = None) -> None:
        """Replaces the mesh: any closed, consistently oriented 2-manifold, tangled or not, as arrays or as an object
        (see Mesh). MeshError names the first defect.

        >>> Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 1]])
        Traceback (most recent call last):
          ...
        topoadapt.errors.MeshError: ...
        """
        vertices, faces = arrays_of(vertices, faces)
        mesh = s.sized(
            s.tpa_mesh_input,
            vertex_count=len(vertices),
            triangle_count=len(faces),
            position_type=type_of(vertices),
            index_type=s.UINT32,
            positions=vertices.ctypes.data,
            triangles=faces.ctypes.data,
        )
        self._write(lambda context, issue: lib.tpa_load(context, byref(mesh), issue))

    @property
    def vertices(self) -> npt.NDArray[np.float64]:
        """A read-only copy of the positions, (n, 3) float64."""
        with self._lock, self.view() as view:
            return sealed(view.vertices)

    @property
    def faces(self) -> npt.NDArray[np.uint32]:
        """A read-only copy of the triangles, (m, 3) uint32, counter-clockwise seen from outside."""
        with self._lock, self.view() as view:
            return sealed(view.faces)

    @property
    def epoch(self) -> int:
        """A number that grows with every commit; equal epochs mean equal ids."""
        with self._lock, self.view() as view:
            return view.epoch

    def move(self, targets: npt.ArrayLike, vertices: Optional[npt.ArrayLike] = None) -> None:
        """Sets the positions wanted after the next step: of all vertices, or of the ids in `vertices`. ValueError for
        another number of targets, as of a mesh before the last commit.

        >>> mesh = Mesh(*ball())
        >>> mesh.move(mesh.vertices[:-1])
        Traceback (most recent call last):
          ...
        ValueError: 145 targets for a mesh of 146 vertices
        """
        targets = positions_of(targets, "targets")
        ids = None if vertices is None else ids_of(vertices, "vertices")
        if ids is not None and ids.shape != (len(targets),):
            raise ValueError("{} targets for ids of shape {}".format(len(targets), ids.shape))
        move = s.sized(
            s.tpa_move_input,
            count=len(targets),
            position_type=type_of(targets),
            positions=targets.ctypes.data,
            vertices=None if ids is None else ids.ctypes.data,
        )
        with self._lock, self.view() as view:
            count = len(view.vertices)
        if ids is None and len(targets) != count:
            raise ValueError("{} targets for a mesh of {} vertices".format(len(targets), count))
        self._write(lambda context, issue: lib.tpa_move(context, byref(move), issue))

    def targets(self) -> tuple[npt.NDArray[np.uint32], npt.NDArray[np.float64]]:
        """Ids and positions of the targets set since the last commit: arrays of shapes (k,) and (k, 3)."""
        with self._lock:
            count = c_uint32()
            check(lib.tpa_targets(self._context, None, None, 0, byref(count)))
            ids, positions = np.zeros(count.value, np.uint32), np.zeros((count.value, 3))
            check(lib.tpa_targets(self._context, pointer(ids), pointer(positions), count, byref(count)))
            return sealed(ids), sealed(positions)

    def drop_targets(self) -> None:
        """Drops all targets."""
        self._write(lambda context, issue: lib.tpa_drop_targets(context))

    def reset(self) -> None:
        """Forgets the mesh, targets, maps and events."""
        self._write(lambda context, issue: lib.tpa_reset(context))

    # ------------------------------------------------------------------ work

    def step(self, control: Optional[Control] = None) -> Report:
        """Moves vertices to their targets and adapts the topology where the surface meets itself. Returns a Report."""
        return self._work(lib.tpa_step, control)

    def advance(self, thickness: float, control: Optional[Control] = None) -> Report:
        """A step in sub-steps, within each of which no two points of the surface approach each other by `thickness` or
        more: only thinner parts can pass each other unseen. All sub-steps are one commit. Returns a Report.

        >>> mesh = Mesh(*ball(edge_length=0.5))
        >>> mesh.move(mesh.vertices + [0, 0, 3])
        >>> mesh.advance(1).substeps
        1
        >>> mesh.move(mesh.vertices * [1, 1, 3])
        >>> report = mesh.advance(0.5)
        >>> report.substeps > 4, report.approach < 0.5
        (True, True)
        """
        return self._work(lib.tpa_advance, control, float(thickness))

    def adapt(self, control: Optional[Control] = None) -> Report:
        """Resolves a tangled mesh: the result bounds the region of winding number 1 or more. Returns a Report;
        `unresolved` counts pairs of triangles left that meet."""
        return self._work(lib.tpa_adapt, control)

    def remesh(
        self,
        target_length: npt.ArrayLike,
        iterations: int = 1,
        *,
        split_ratio: float = 0.0,
        collapse_ratio: float = 0.0,
        relaxation: float = 0.5,
        vertices: Optional[npt.ArrayLike] = None,
        control: Optional[Control] = None,
    ) -> Report:
        """Splits long edges, collapses short ones, flips, and relaxes. Ratios of 0: 4/3 and 4/5. Returns a Report.

        target_length: one length, or a length for each vertex: an array of shape (n,).
        vertices: ids of a part that alone may change, or None for the whole mesh.

        >>> mesh = Mesh(*ball(edge_length=0.3))
        >>> before = mesh.vertices
        >>> _ = mesh.remesh(0.15, 2, vertices=np.flatnonzero(before[:, 2] > 0))
        >>> old, new = before.tolist(), mesh.vertices.tolist()
        >>> all(point in new for point in old if point[2] <= 0), len(new) > len(old)
        (True, True)
        >>> _ = mesh.remesh(np.where(mesh.vertices[:, 2] > 0, 0.1, 0.4), 4)
        >>> above = mesh.vertices[:, 2] > 0
        >>> bool(above.sum() > 5 * (~above).sum())
        True
        """
        lengths = None if np.ndim(target_length) == 0 else np.ascontiguousarray(target_length, np.float32)
        if lengths is not None and lengths.shape != (len(self.vertices),):
            raise ValueError("target_length: the shape is {}, not (n,)".format(lengths.shape))
        ids = None if vertices is None else ids_of(vertices, "vertices").ravel()
        if ids is not None and not ids.size:
            iterations = 0
        options = s.sized(
            s.tpa_remesh_options,
            iterations=iterations,
            target_length=target_length if lengths is None else 0.0,
            split_ratio=split_ratio,
            collapse_ratio=collapse_ratio,
            relaxation=relaxation,
            count=0 if ids is None else ids.size,
            vertices=None if ids is None else ids.ctypes.data,
            lengths=None if lengths is None else lengths.ctypes.data,
        )
        return self._work(lib.tpa_remesh, control, options)

    def smooth(
        self, iterations: int = 1, vertices: Optional[npt.ArrayLike] = None, control: Optional[Control] = None
    ) -> Report:
        """Taubin smoothing of all vertices or of the ids in `vertices`. Returns a Report."""
        ids = None if vertices is None else ids_of(vertices, "vertices").ravel()
        options = s.sized(s.tpa_smooth_options, iterations=iterations)
        if ids is not None:
            if not ids.size:
                options.iterations = 0
            options.count, options.vertices = ids.size, ids.ctypes.data
        return self._work(lib.tpa_smooth, control, options)

    def reorder(self) -> None:
        """Renumbers vertices and triangles along a curve through space, so that near ones lie near in memory: a commit
        of new numbers alone. Drops targets."""
        self._write(lambda context, issue: lib.tpa_reorder(context, issue))

    def detect(self, control: Optional[Control] = None) -> npt.NDArray[np.uint32]:
        """All pairs of triangles that meet beyond a common vertex or edge: a (k, 2) array of ids."""
        contacts, found = s.sized(s.tpa_contacts), [np.zeros((0, 2), np.uint32)]
        run = exec_of(control)

        def call(context: Any, issue: Any) -> int:
            status: int = lib.tpa_detect(context, run, byref(contacts), issue)
            if status == s.Status.OK:  # still under the lock
                found[0] = copy_of_memory(contacts.pairs, (contacts.count, 2), np.uint32)
            return status

        self._write(call)
        return found[0]

    def validate(self, control: Optional[Control] = None) -> Validation:
        """Checks the whole mesh from its triangles alone, and counts components, genus and self-intersections. Returns
        a Validation."""
        validation = s.sized(s.tpa_validation)
        run = exec_of(control)

        def call(context: Any, issue: Any) -> int:
            status: int = lib.tpa_validate(context, run, byref(validation), issue)
            return s.Status.OK if status == s.Status.E_LIMIT else status  # the pairs are counted all the same

        self._write(call)
        return read(Validation, validation)

    # ------------------------------------------------------------------ state

    def save(self) -> bytes:
        """The state as bytes, the same on every platform: mesh, targets, maps, events, and the fields of the config
        that decide results."""
        with self._lock:
            size, issue = c_size_t(), s.tpa_issue()
            lib.tpa_save(self._context, None, 0, byref(size), None)
            data = ctypes.create_string_buffer(max(1, size.value))
            check(lib.tpa_save(self._context, data, size, byref(size), byref(issue)), issue)
            return data.raw[: size.value]

    def restore(self, data: Any) -> None:
        """Replaces the state by a saved one. All is checked before anything is replaced: DataError."""
        data = bytes(data)
        self._write(lambda context, issue: lib.tpa_restore(context, data, len(data), issue))

    @classmethod
    def from_state(cls: type[_M], data: Any, **options: Any) -> _M:
        """A mesh from the bytes of save(); `options` as for Mesh.

        >>> mesh = Mesh(*ball())
        >>> Mesh.from_state(mesh.save()).digest() == mesh.digest()
        True
        """
        mesh = cls(**options)
        mesh.restore(data)
        return mesh

    def digest(self) -> int:
        """A 64-bit hash of the state: equal states have equal digests, on every platform."""
        with self._lock:
            digest = c_uint64()
            check(lib.tpa_digest(self._context, byref(digest)))
            return digest.value

    def __repr__(self) -> str:
        with self._lock:
            view = s.sized(s.tpa_mesh_view)
            if lib.tpa_view(self._context, byref(view)) != s.Status.OK:
                return "<topoadapt.Mesh, empty>"
            return "<topoadapt.Mesh, {} vertices, {} faces>".format(view.vertex_count, view.triangle_count)
