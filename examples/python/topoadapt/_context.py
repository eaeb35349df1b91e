# SPDX-License-Identifier: MIT
"""A context of the library with its memory: the ground that Mesh stands on."""

from __future__ import annotations

import ctypes
import gc
import threading
import weakref
from ctypes import byref, c_uint32, c_void_p
from typing import Any, Callable, Optional, TypeVar

import numpy as np
import numpy.typing as npt

from . import _structures as s
from ._config import config_fields, copy_of_config, query, raised, set_fields
from ._library import lib
from ._memory import Block, Export
from ._view import View
from .control import Control, exec_of
from .errors import ViewError, check
from .records import MemoryTable, Report, read

_Self = TypeVar("_Self", bound="Context")


class Context:
    """A block of memory, the lock over it, and its growth."""

    def __init__(
        self,
        vertices: int,
        grow: Optional[bool],
        memory: Optional[Any],
        max_bytes: Optional[int],
        config: dict[str, Any],
    ) -> None:
        self.auto_grow = memory is None if grow is None else bool(grow)
        self.max_bytes = max_bytes
        self._lock = threading.RLock()
        self._exports: weakref.WeakSet[Export] = weakref.WeakSet()
        self._open_views = 0
        self._config = s.tpa_config()
        check(lib.tpa_config_init(byref(self._config), ctypes.sizeof(s.tpa_config)))
        self._config.max_vertices = vertices
        set_fields(self._config, config)
        self._block, self._context = self._start(memory)

    def _start(self, memory: Optional[Any]) -> tuple[Block, c_void_p]:
        size = query(self._config)
        block, context, issue = Block(size.bytes, memory), c_void_p(), s.tpa_issue()
        check(lib.tpa_init(block.address, block.size, byref(self._config), byref(context), byref(issue)), issue)
        return block, context

    def _export(self, address: int, shape: tuple[int, ...], dtype: np.dtype[Any]) -> npt.NDArray[Any]:
        if 0 in shape:
            return np.empty(shape, dtype)
        export = Export(self._block, address, shape, dtype)
        self._exports.add(export)
        return np.asarray(export)

    def _refuse_while_viewed(self) -> None:
        """Raises ViewError while any array over the memory may be in use."""
        if self._open_views:
            raise ViewError("a view is open: end its `with` block before a call that writes")
        if self._exports:
            gc.collect()  # arrays in cycles are no arrays in use
        if self._exports:
            raise ViewError("{} array(s) of a view are alive: delete or copy them first".format(len(self._exports)))

    def _grow_to(self, config: s.tpa_config) -> None:
        size, bigger, issue = query(config), c_void_p(), s.tpa_issue()
        block = Block(size.bytes)
        check(
            lib.tpa_grow(self._context, block.address, block.size, byref(config), byref(bigger), byref(issue)),
            issue,
        )
        self._block, self._context, self._config = block, bigger, config

    def _grow_for(self, issue: s.tpa_issue) -> None:
        """Raises the limit of an issue. Raises the issue instead, where the limit cannot be raised."""
        config = raised(self._config, issue)
        if self.max_bytes is not None and query(config).bytes > self.max_bytes:
            check(issue.status, issue)
        self._grow_to(config)

    def _write(self, call: Callable[[c_void_p, Any], int]) -> None:
        """Makes call(context, issue), which may write, and again after each growth."""
        with self._lock:
            self._refuse_while_viewed()
            while True:
                issue = s.tpa_issue()
                status = call(self._context, byref(issue))
                if status != s.Status.E_LIMIT or not self.auto_grow:
                    return check(status, issue)
                self._grow_for(issue)

    def _work(self, function: Any, control: Optional[Control], *options: Any) -> Report:
        """A call with tpa_exec and tpa_report."""
        report = s.sized(s.tpa_report)
        run = exec_of(control)
        given = [byref(option) if isinstance(option, ctypes.Structure) else option for option in options]
        self._write(lambda context, issue: function(context, *given, run, byref(report), issue))
        return read(Report, report)

    def grow(self, **limits: int) -> None:
        """Moves the context into a block for other limits, larger or smaller: `mesh.grow(max_vertices=10**6)`."""
        with self._lock:
            config = copy_of_config(self._config)
            set_fields(config, limits)
            self._grow_to(config)

    def copy(self: _Self) -> _Self:
        """The same mesh, targets, maps and events in a context of its own; the way to rewind. A byte copy of the block.

        >>> from topoadapt import Mesh
        >>> mesh = Mesh(*ball())
        >>> mesh.copy().digest() == mesh.digest()
        True
        """
        twin = type(self).__new__(type(self))
        with self._lock:
            size = query(self._config)
            room = np.empty(size.bytes + size.alignment, np.uint8)
            start = (self._block.address - room.ctypes.data) % size.alignment  # copies need equal alignment
            block = Block(size.bytes, room[start : start + size.bytes])
            ctypes.memmove(block.address, self._block.address, size.bytes)
            twin._block, twin._context, twin._config = block, c_void_p(block.address), copy_of_config(self._config)
        twin.auto_grow, twin.max_bytes = self.auto_grow, self.max_bytes
        twin._lock, twin._exports, twin._open_views = threading.RLock(), weakref.WeakSet(), 0
        return twin

    __copy__ = copy

    def __deepcopy__(self: _Self, memo: Any) -> _Self:
        return self.copy()

    def __reduce__(self) -> Any:
        raise TypeError("a Mesh holds memory of the library: use save() and Mesh.from_state()")

    def memory(self) -> list[MemoryTable]:
        """The tables of the block, with elements in use, most ever used, and limit: a list of MemoryTable."""
        with self._lock:
            count = c_uint32()
            check(lib.tpa_memory_stats(self._context, None, 0, byref(count)))
            tables = (s.tpa_memory_table * count.value)()
            check(lib.tpa_memory_stats(self._context, tables, count, byref(count)))
            return [read(MemoryTable, table)._replace(name=table.name.decode()) for table in tables]

    @property
    def config(self) -> dict[str, Any]:
        """Fields of tpa_config, as a dictionary."""
        with self._lock:
            return {field: getattr(self._config, field) for field in config_fields()}

    def view(self) -> View:
        """The mesh and the maps of the last commit without a copy, read-only, for a `with` block; see View.

        >>> from topoadapt import Mesh
        >>> mesh = Mesh(*ball())
        >>> with mesh.view() as view:
        ...     centre = view.vertices.mean(axis=0)
        >>> bool(abs(centre).max() < 1e-9)
        True
        """
        return View(self)
