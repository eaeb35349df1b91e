# SPDX-License-Identifier: MIT
"""Failures of the library as exceptions. Each carries the fields of tpa_issue and the library's line of English."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Optional, TypeVar, Union

from ._library import lib
from ._structures import Defect, Limit, Status, tpa_issue

if TYPE_CHECKING:
    import enum

    from .mesh import Mesh
    from .records import Report

    _E = TypeVar("_E", bound=enum.IntEnum)


class Error(Exception):
    """A call of the library failed, and left the mesh bit for bit as before.

    Attributes: `status` (Status), `defect` (Defect or a number), `limit` (Limit), `argument`, `element`, `other`,
    `needed`, `available`, as told by tpa_issue in topoadapt.h. str() is the line of tpa_issue_text.
    """

    status: Union[Status, int] = Status.OK
    defect: Union[Defect, int] = Defect.NONE
    limit: Union[Limit, int] = Limit.NONE
    argument: int = 0
    element: int = 0
    other: int = 0
    needed: int = 0
    available: int = 0


class ArgumentError(Error, ValueError):
    """An argument is out of range."""


class ConfigError(Error, ValueError):
    """A field of the config is out of range; `argument` is its position."""


class SizeError(Error, ValueError):
    """A size is beyond the address space."""


class ArenaError(Error):
    """The block is too small; `needed` is the number of bytes."""


class ContextError(Error):
    """The block holds no context of this build of the library."""


class StateError(Error):
    """No mesh is loaded."""


class LimitError(Error):
    """A limit of the config is reached: `limit` names it, `needed` is enough."""


class MeshError(Error, ValueError):
    """The mesh is no closed oriented 2-manifold, or has an unusable coordinate or id: `defect`, `element`, `other`."""


class TangledError(Error):
    """The call needs a mesh free of self-intersections: triangles `element` and `other` meet. Call adapt() once."""


class FloatEnvironmentError(Error):
    """The floating-point environment is not as needed."""


class BudgetError(Error):
    """The budget is spent; `needed` is enough, where known."""


class CancelledError(Error):
    """Control.cancel() was called."""


class DataError(Error, ValueError):
    """No saved state, or a damaged one; `element` is the offset of the first byte that cannot be trusted."""


class ViewError(BufferError):
    """A view is used after its `with` block, or a call that writes meets an array over the mesh that is still alive."""


class UnresolvedError(Exception):
    """adapt() left pairs of triangles that meet. Attributes: `report`, `mesh` (a Mesh)."""

    def __init__(self, report: Report, mesh: Mesh) -> None:
        super().__init__("{} pairs of triangles still meet".format(report.unresolved))
        self.report, self.mesh = report, mesh


_CLASSES: dict[int, type[Error]] = {
    Status.E_ARGUMENT: ArgumentError,
    Status.E_CONFIG: ConfigError,
    Status.E_OVERFLOW: SizeError,
    Status.E_ARENA: ArenaError,
    Status.E_CONTEXT: ContextError,
    Status.E_STATE: StateError,
    Status.E_LIMIT: LimitError,
    Status.E_MESH: MeshError,
    Status.E_TANGLED: TangledError,
    Status.E_ENVIRONMENT: FloatEnvironmentError,
    Status.E_BUDGET: BudgetError,
    Status.E_CANCELLED: CancelledError,
    Status.E_DATA: DataError,
}


def _member(enumeration: type[_E], number: int) -> Union[_E, int]:
    """The member of an enumeration, or the plain number of a newer library."""
    try:
        return enumeration(number)
    except ValueError:
        return number


def _text(issue: tpa_issue) -> str:
    line = ctypes.create_string_buffer(512)
    lib.tpa_issue_text(ctypes.byref(issue), line, len(line))
    return line.value.decode("utf-8", "replace")


def check(status: int, issue: Optional[tpa_issue] = None) -> None:
    """Raises the exception of a status other than OK."""
    if status == Status.OK:
        return
    if issue is None or issue.status == Status.OK:
        issue = tpa_issue(status=status)
        text = lib.tpa_status_string(status).decode()
    else:
        text = _text(issue)
    error = _CLASSES.get(status, Error)(text)
    error.status = _member(Status, status)
    error.defect = _member(Defect, issue.defect)
    error.limit = _member(Limit, issue.limit)
    for field in ("argument", "element", "other", "needed", "available"):
        setattr(error, field, getattr(issue, field))
    raise error
