# SPDX-License-Identifier: MIT
"""Threads and bounds for the work of a call, its progress, and its end from another thread."""

from __future__ import annotations

import ctypes
from ctypes import byref, c_int32, c_uint64
from typing import Any, Optional

from . import _structures as s
from ._threads import Pool


class Control:
    """Bounds a call, shares its work among threads, and follows it from any thread: `mesh.step(control)`.

    budget: units of work that a call may spend; more raises BudgetError. 0: no bound.
    threads: threads that share the work, the calling thread among them. They wait between calls for as long as the
        control lives. Threads change no bit of a result, and are worth their while from some 100 000 vertices on.

    >>> control = Control(budget=1)
    >>> from topoadapt import Mesh, ball
    >>> mesh = Mesh(*ball())
    >>> mesh.remesh(0.1, control=control)
    Traceback (most recent call last):
      ...
    topoadapt.errors.BudgetError: ...
    """

    def __init__(self, budget: int = 0, threads: int = 1) -> None:
        if threads < 1:
            raise ValueError("threads cannot be {}".format(threads))
        self.budget = budget
        self._pool = Pool(threads) if threads > 1 else None
        self._cancelled = c_int32(0)
        self._spent = c_uint64(0)

    def cancel(self) -> None:
        """Ends the calls that use this control with CancelledError."""
        self._cancelled.value = 1

    def clear(self) -> None:
        """Lets calls run again."""
        self._cancelled.value = 0

    @property
    def threads(self) -> int:
        """Threads that share the work."""
        return 1 if self._pool is None else self._pool.threads

    @property
    def spent(self) -> int:
        """Units of work of the present call, or of the last one."""
        return self._spent.value


def exec_of(control: Optional[Control]) -> Any:
    """The tpa_exec of a Control, by reference; NULL for None."""
    if control is None:
        return None
    made = s.sized(s.tpa_exec, budget=control.budget)
    made.cancel = ctypes.pointer(control._cancelled)
    made.progress = ctypes.pointer(control._spent)
    if control._pool is not None:
        made.parallel_for = control._pool.parallel_for
    return byref(made)
