# SPDX-License-Identifier: MIT
"""A moving mesh: a context of the library with its memory."""

import ctypes
import gc
import threading
import weakref
from ctypes import POINTER, byref, c_float, c_size_t, c_uint32, c_uint64, c_void_p

import numpy as np

from . import _structures as s
from ._config import copy_of_config, query, raised, set_fields
from ._inputs import arrays_of, copy_of_memory, ids_of, pointer, positions_of, type_of
from ._library import lib
from ._memory import Block, Export
from ._view import View
from .control import exec_of
from .errors import ViewError, check
from .records import Changes, Component, MemoryTable, Report, Validation, VertexMap, read, read_event


class Mesh:
    """A closed triangle mesh that moves, and changes its topology where it runs into itself.

    vertices, faces: (n, 3) and (m, 3) arrays, or an object with .vertices and .faces (trimesh) or .points and
        .cells_dict (meshio) alone, or nothing: then load() or restore() comes first.
    grow: whether a call that reaches a limit of the config continues in a larger block. Otherwise, and above max_bytes,
        LimitError. By default, unless `memory` is given. Results do not depend on limits.
    memory: a writable buffer for the context, such as a bytearray or an array, in place of a block of its own.
    max_bytes: bound on the block. None: no bound.
    config: fields of tpa_config, as max_vertices=1000 or region=Region.OUTSIDE.

    Each method raises a subclass of Error on failure, and leaves everything as it was. Calls from several threads wait
    for each other. Methods return copies, which belong to the caller; view() gives arrays without a copy.

    >>> vertices, faces = ball(edge_length=0.3)
    >>> mesh = Mesh(vertices, faces)
    >>> mesh.move(mesh.vertices * [1, 1, 0.5])
    >>> report = mesh.step()
    >>> report.contacts, mesh.validate().genus
    (0, 0)
    """

    def __init__(self, vertices=None, faces=None, *, grow=None, memory=None, max_bytes=None, **config):
        given = None if vertices is None else arrays_of(vertices, faces)
        self.auto_grow = memory is None if grow is None else bool(grow)
        self.max_bytes = max_bytes
        self._lock = threading.RLock()
        self._exports = weakref.WeakSet()
        self._open_views = 0
        self._config = s.tpa_config()
        check(lib.tpa_config_init(byref(self._config), ctypes.sizeof(s.tpa_config)))
        self._config.max_vertices = max(4096, 2 * len(given[0])) if given else 4096
        set_fields(self._config, config)
        self._block, self._context = self._start(memory)
        if given:
            self.load(*given)

    # ------------------------------------------------------------------ memory

    def _start(self, memory):
        size = query(self._config)
        block, context, issue = Block(size.bytes, size.alignment, memory), c_void_p(), s.tpa_issue()
        check(lib.tpa_init(block.address, block.size, byref(self._config), byref(context), byref(issue)), issue)
        return block, context

    def _export(self, address, shape, dtype):
        if 0 in shape:
            return np.empty(shape, dtype)
        export = Export(self._block, address, shape, dtype)
        self._exports.add(export)
        return np.asarray(export)

    def _refuse_while_viewed(self):
        """Raises ViewError while any array over the memory may be in use."""
        if self._open_views:
            raise ViewError("a view is open: end its `with` block before a call that writes")
        if self._exports:
            gc.collect()  # arrays in cycles are no arrays in use
        if self._exports:
            raise ViewError("{} array(s) of a view are alive: delete or copy them first".format(len(self._exports)))

    def _grow_to(self, config):
        size, bigger, issue = query(config), c_void_p(), s.tpa_issue()
        block = Block(size.bytes, size.alignment)
        check(
            lib.tpa_grow(self._context, block.address, block.size, byref(config), byref(bigger), byref(issue)),
            issue,
        )
        self._block, self._context, self._config = block, bigger, config

    def _grow_for(self, issue):
        """Raises the limit of an issue. Raises the issue instead, where the limit cannot be raised."""
        config = raised(self._config, issue)
        if self.max_bytes is not None and query(config).bytes > self.max_bytes:
            check(issue.status, issue)
        self._grow_to(config)

    def _write(self, call):
        """Makes call(context, issue), which may write, and again after each growth."""
        with self._lock:
            self._refuse_while_viewed()
            while True:
                issue = s.tpa_issue()
                status = call(self._context, byref(issue))
                if status != s.Status.E_LIMIT or not self.auto_grow:
                    return check(status, issue)
                self._grow_for(issue)

    def _work(self, function, control, *options):
        """A call with tpa_exec and tpa_report."""
        report = s.sized(s.tpa_report)
        run = exec_of(control)
        given = [byref(option) for option in options]
        self._write(lambda context, issue: function(context, *given, run, byref(report), issue))
        return read(Report, report)

    def grow(self, **limits):
        """Moves the context into a block for other limits, larger or smaller: `mesh.grow(max_vertices=10**6)`."""
        with self._lock:
            config = copy_of_config(self._config)
            set_fields(config, limits)
            self._grow_to(config)

    def copy(self):
        """The same mesh, targets, maps and events in a context of its own; the way to rewind. A byte copy of the block.

        >>> mesh = Mesh(*ball())
        >>> mesh.copy().digest() == mesh.digest()
        True
        """
        twin = Mesh.__new__(Mesh)
        with self._lock:
            size = query(self._config)
            block = Block(size.bytes, size.alignment)
            ctypes.memmove(block.address, self._context.value, size.bytes)
            twin._block, twin._context, twin._config = block, c_void_p(block.address), copy_of_config(self._config)
        twin.auto_grow, twin.max_bytes = self.auto_grow, self.max_bytes
        twin._lock, twin._exports, twin._open_views = threading.RLock(), weakref.WeakSet(), 0
        return twin

    __copy__ = copy

    def __deepcopy__(self, memo):
        return self.copy()

    def __reduce__(self):
        raise TypeError("a Mesh holds memory of the library: use save() and Mesh.from_state()")

    def memory(self):
        """The tables of the block, with elements in use, most ever used, and limit: a list of MemoryTable."""
        with self._lock:
            count = c_uint32()
            check(lib.tpa_memory_stats(self._context, None, 0, byref(count)))
            tables = (s.tpa_memory_table * count.value)()
            check(lib.tpa_memory_stats(self._context, tables, count, byref(count)))
            return [read(MemoryTable, table)._replace(name=table.name.decode()) for table in tables]

    @property
    def config(self):
        """Fields of tpa_config, as a dictionary."""
        with self._lock:
            fields = [field for field, _ in s.tpa_config._fields_[2:]]
            return {field: getattr(self._config, field) for field in fields}

    # ------------------------------------------------------------------ mesh in and out

    def load(self, vertices, faces=None):
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

    def view(self):
        """The mesh and the maps of the last commit without a copy, read-only, for a `with` block; see View.

        >>> mesh = Mesh(*ball())
        >>> with mesh.view() as view:
        ...     centre = view.vertices.mean(axis=0)
        >>> abs(centre).max() < 1e-9
        True
        """
        return View(self)

    @property
    def vertices(self):
        """A copy of the positions, (n, 3) float64."""
        with self._lock, self.view() as view:
            return view.vertices.copy()

    @property
    def faces(self):
        """A copy of the triangles, (m, 3) uint32, counter-clockwise seen from outside."""
        with self._lock, self.view() as view:
            return view.faces.copy()

    @property
    def epoch(self):
        """A number that grows with every commit; equal epochs mean equal ids."""
        with self._lock, self.view() as view:
            return view.epoch

    def move(self, targets, vertices=None):
        """Sets the positions wanted after the next step: of all vertices, or of the ids in `vertices`."""
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
        self._write(lambda context, issue: lib.tpa_move(context, byref(move), issue))

    def targets(self):
        """Ids and positions of the targets set since the last commit: arrays of shapes (k,) and (k, 3)."""
        with self._lock:
            count = c_uint32()
            check(lib.tpa_targets(self._context, None, None, 0, byref(count)))
            ids, positions = np.zeros(count.value, np.uint32), np.zeros((count.value, 3))
            check(lib.tpa_targets(self._context, pointer(ids), pointer(positions), count, byref(count)))
            return ids, positions

    def drop_targets(self):
        """Drops all targets."""
        self._write(lambda context, issue: lib.tpa_drop_targets(context))

    def reset(self):
        """Forgets the mesh, targets, maps and events."""
        self._write(lambda context, issue: lib.tpa_reset(context))

    # ------------------------------------------------------------------ work

    def step(self, control=None):
        """Moves vertices to their targets and adapts the topology where the surface meets itself. Returns a Report."""
        return self._work(lib.tpa_step, control)

    def adapt(self, control=None):
        """Resolves a tangled mesh: the result bounds the region of winding number 1 or more. Returns a Report;
        `unresolved` counts pairs of triangles left that meet."""
        return self._work(lib.tpa_adapt, control)

    def remesh(
        self,
        target_length,
        iterations=1,
        *,
        split_ratio=0.0,
        collapse_ratio=0.0,
        relaxation=0.5,
        vertices=None,
        control=None,
    ):
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
        one = np.ndim(target_length) == 0
        lengths = None if one else np.ascontiguousarray(target_length, np.float32)
        if not one and lengths.shape != (len(self.vertices),):
            raise ValueError("target_length: the shape is {}, not (n,)".format(lengths.shape))
        ids = None if vertices is None else ids_of(vertices, "vertices").ravel()
        if ids is not None and not ids.size:
            iterations = 0
        options = s.sized(
            s.tpa_remesh_options,
            iterations=iterations,
            target_length=target_length if one else 0.0,
            split_ratio=split_ratio,
            collapse_ratio=collapse_ratio,
            relaxation=relaxation,
            count=0 if ids is None else ids.size,
            vertices=None if ids is None else ids.ctypes.data,
            lengths=None if one else lengths.ctypes.data,
        )
        return self._work(lib.tpa_remesh, control, options)

    def smooth(self, iterations=1, vertices=None, control=None):
        """Taubin smoothing of all vertices or of the ids in `vertices`. Returns a Report."""
        ids = None if vertices is None else ids_of(vertices, "vertices").ravel()
        options = s.sized(s.tpa_smooth_options, iterations=iterations)
        if ids is not None:
            if not ids.size:
                options.iterations = 0
            options.count, options.vertices = ids.size, ids.ctypes.data
        return self._work(lib.tpa_smooth, control, options)

    def detect(self, control=None):
        """All pairs of triangles that meet beyond a common vertex or edge: a (k, 2) array of ids."""
        contacts, found = s.sized(s.tpa_contacts), []
        run = exec_of(control)

        def call(context, issue):
            status = lib.tpa_detect(context, run, byref(contacts), issue)
            if status == s.Status.OK:  # still under the lock
                found.append(copy_of_memory(contacts.pairs, (contacts.count, 2), np.uint32))
            return status

        self._write(call)
        return found[0]

    def validate(self, control=None):
        """Checks the whole mesh from its triangles alone, and counts components, genus and self-intersections. Returns
        a Validation."""
        validation = s.sized(s.tpa_validation)
        run = exec_of(control)

        def call(context, issue):
            status = lib.tpa_validate(context, run, byref(validation), issue)
            return s.Status.OK if status == s.Status.E_LIMIT else status  # the pairs are counted all the same

        self._write(call)
        return read(Validation, validation)

    # ------------------------------------------------------------------ results of the last commit

    def events(self):
        """The changes of topology in the last commit: a list of Event."""
        with self._lock:
            events, count = c_void_p(), c_uint32()
            check(lib.tpa_events(self._context, byref(events), byref(count)))
            if not count.value:
                return []
            return [read_event(e) for e in (s.tpa_event * count.value).from_address(events.value)]

    def components(self):
        """The connected components, ascending by id: a list of Component."""
        return self._components()[0]

    def component_labels(self):
        """For each vertex the place of its component in components(): an (n,) array."""
        return self._components()[1]

    def _components(self):
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
            return [read(Component, component) for component in components], labels

    def rolled_back(self):
        """Ids of the vertices left at their old positions by the last step."""
        with self._lock, self.view() as view:
            return view.rolled_back.copy()

    def vertex_map(self):
        """How the last commit renumbered vertices: a VertexMap."""
        with self._lock, self.view() as view:
            origins = view.origins
            return VertexMap(view.old_to_new.copy(), origins["parents"].copy(), origins["weight"].copy())

    def face_map(self):
        """The triangle before the last commit that each triangle is part of: (m,) ids, NONE for new surface."""
        with self._lock, self.view() as view:
            return view.face_origins.copy()

    def carry_vertices(self, values):
        """Values for each vertex before the last commit, as (old count, ...) numbers, taken to the vertices after: an
        array of float32. New vertices take the weighted mean of their parents.

        >>> mesh = Mesh(*ball(edge_length=0.5))
        >>> heights = mesh.vertices[:, 2]
        >>> _ = mesh.remesh(0.25, relaxation=0)
        >>> carried = mesh.carry_vertices(heights)
        >>> abs(carried - mesh.vertices[:, 2]).max() < 0.25  # within an edge length
        True
        """
        return self._carry(lib.tpa_carry_vertices, lib.tpa_vertex_map, s.tpa_vertex_map_view, values)

    def carry_faces(self, values):
        """The same for triangles, which take the values of their origins, or of the nearest triangle with one."""
        return self._carry(lib.tpa_carry_faces, lib.tpa_triangle_map, s.tpa_triangle_map_view, values)

    def _carry(self, carry, counts, structure, values):
        before = np.ascontiguousarray(values, np.float32)
        with self._lock:
            view = s.sized(structure)
            check(counts(self._context, byref(view)))
            if before.ndim < 1 or len(before) != view.old_count:
                raise ValueError("values have shape {}, for {} old ids".format(before.shape, view.old_count))
            after = np.zeros((view.new_count,) + before.shape[1:], np.float32)
            floats = int(np.prod(before.shape[1:], dtype=np.int64))
            if floats:
                check(carry(self._context, before.ctypes.data_as(POINTER(c_float)), floats, pointer(after)))
            return after

    def changes(self, gap=0):
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
                vertices[: changes.vertex_ranges].copy(),
                faces[: changes.triangle_ranges].copy(),
                changes.changed_vertices,
                changes.changed_triangles,
            )

    # ------------------------------------------------------------------ state

    def save(self):
        """The state as bytes, the same on every platform: mesh, targets, maps, events, and the fields of the config
        that decide results."""
        with self._lock:
            size, issue = c_size_t(), s.tpa_issue()
            lib.tpa_save(self._context, None, 0, byref(size), None)
            data = ctypes.create_string_buffer(max(1, size.value))
            check(lib.tpa_save(self._context, data, size, byref(size), byref(issue)), issue)
            return data.raw[: size.value]

    def restore(self, data):
        """Replaces the state by a saved one. All is checked before anything is replaced: DataError."""
        data = bytes(data)
        self._write(lambda context, issue: lib.tpa_restore(context, data, len(data), issue))

    @classmethod
    def from_state(cls, data, **options):
        """A mesh from the bytes of save(); `options` as for Mesh.

        >>> mesh = Mesh(*ball())
        >>> Mesh.from_state(mesh.save()).digest() == mesh.digest()
        True
        """
        mesh = cls(**options)
        mesh.restore(data)
        return mesh

    def digest(self):
        """A 64-bit hash of the state: equal states have equal digests, on every platform."""
        with self._lock:
            digest = c_uint64()
            check(lib.tpa_digest(self._context, byref(digest)))
            return digest.value

    def __repr__(self):
        with self._lock:
            view = s.sized(s.tpa_mesh_view)
            if lib.tpa_view(self._context, byref(view)) != s.Status.OK:
                return "<topoadapt.Mesh, empty>"
            return "<topoadapt.Mesh, {} vertices, {} faces>".format(view.vertex_count, view.triangle_count)
