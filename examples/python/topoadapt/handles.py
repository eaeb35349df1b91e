# SPDX-License-Identifier: MIT
"""The database of handles (section 4 of the paper): triangles that join two to four closed polygons."""

from __future__ import annotations

from collections.abc import Sequence
from ctypes import byref, c_uint32, c_uint64
from typing import Any, Callable

import numpy as np
import numpy.typing as npt

from . import _structures as s
from ._library import lib
from .errors import check
from .records import HandleInfo, read


def describe(sides: Sequence[int]) -> HandleInfo:
    """How many handles are stored for polygons of so many sides: a HandleInfo.

    >>> describe([3, 3]).faces
    6
    """
    info = s.sized(s.tpa_handle_info)
    check(lib.tpa_handle_describe(len(sides), _numbers(sides), byref(info)))
    return read(HandleInfo, info)


def get(sides: Sequence[int], index: int) -> npt.NDArray[np.uint32]:
    """The handle of number `index`: (faces, 3) numbers of vertices, counted through all polygons in the order given.

    >>> get([3, 3], 0).shape
    (6, 3)
    """
    return _faces(sides, lambda faces, room: lib.tpa_handle_get(len(sides), _numbers(sides), index, faces, room))


def generator(sides: Sequence[int], number: int) -> tuple[npt.NDArray[np.uint32], int]:
    """A generator in the same form, and the number of handles that come from it."""
    orbit = c_uint64()
    faces = _faces(
        sides,
        lambda faces, room: lib.tpa_handle_generator(len(sides), _numbers(sides), number, faces, room, byref(orbit)),
    )
    return faces, orbit.value


def _numbers(sides: Sequence[int]) -> Any:
    return (c_uint32 * len(sides))(*sides)


def _faces(sides: Sequence[int], call: Callable[[Any, int], int]) -> npt.NDArray[np.uint32]:
    room = 3 * s.HANDLE_MAX_FACES
    faces = (c_uint32 * room)()
    check(call(faces, room))
    return np.array(faces[: 3 * describe(sides).faces], np.uint32).reshape(-1, 3)
