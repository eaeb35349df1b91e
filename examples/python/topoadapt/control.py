# SPDX-License-Identifier: MIT
"""Bounds on the work of a call, its progress, and its end from another thread."""

import ctypes
from ctypes import byref, c_int32, c_uint64

from . import _structures as s


class Control:
    """Bounds a call and follows it, from any thread: `mesh.step(control)`.

    budget: units of work that a call may spend; more raises BudgetError. 0: no bound.

    >>> control = Control(budget=1)
    >>> from topoadapt import Mesh, ball
    >>> mesh = Mesh(*ball())
    >>> mesh.remesh(0.1, control=control)
    Traceback (most recent call last):
      ...
    topoadapt.errors.BudgetError: ...
    """

    def __init__(self, budget=0):
        self.budget = budget
        self._cancelled = c_int32(0)
        self._spent = c_uint64(0)

    def cancel(self):
        """Ends the calls that use this control with CancelledError."""
        self._cancelled.value = 1

    def clear(self):
        """Lets calls run again."""
        self._cancelled.value = 0

    @property
    def spent(self):
        """Units of work of the present call, or of the last one."""
        return self._spent.value


def exec_of(control):
    """The tpa_exec of a Control, by reference; NULL for None."""
    if control is None:
        return None
    made = s.sized(s.tpa_exec, budget=control.budget)
    made.cancel = ctypes.pointer(control._cancelled)
    made.progress = ctypes.pointer(control._spent)
    return byref(made)
