# SPDX-License-Identifier: MIT
"""topoadapt: topology changes of moving triangle meshes, in NumPy.

A solver, a tool or a game deforms a closed triangle mesh. Where the mesh runs into itself, topoadapt merges, splits,
opens handles and frees nested objects; the result is closed, consistently oriented, 2-manifold and free of
self-intersections, and has the same bits on every machine.

>>> import numpy as np
>>> import topoadapt
>>> (a, faces), (b, _) = topoadapt.ball((-1.1, 0, 0)), topoadapt.ball((1.1, 0, 0))
>>> mesh = topoadapt.Mesh(np.concatenate([a, b]), np.concatenate([faces, faces + len(a)]))
>>> mesh.move(np.concatenate([a + [0.2, 0, 0], b - [0.2, 0, 0]]))  # the wanted positions
>>> report = mesh.step()  # move, detect, adapt, check, commit
>>> mesh.events()[-1].type.name
'MERGE'
>>> mesh.validate().components
1

One call resolves a tangled mesh: resolve(). One call segments a volume: segment(). See README.md in this folder, and
topoadapt.h for the contract of every function.
"""

from __future__ import annotations

from . import errors, handles, voxels
from ._inputs import arrays_of, like
from ._library import lib as _lib
from ._structures import NONE, Defect, DetectMode, EventType, Limit, Region, Status
from ._view import View
from .balloon import Segmentation, segment
from .control import Control
from .errors import Error, LimitError, MeshError, TangledError, UnresolvedError, ViewError
from .mesh import Mesh
from .records import Changes, Component, Event, HandleInfo, MemoryTable, Report, Surface, Validation, VertexMap
from .resolving import resolve
from .shapes import ball

__version__ = "0.3.0"


def library_version() -> tuple[int, int, int]:
    """The version of the loaded library, as (major, minor, patch).

    >>> library_version() >= (0, 1, 0)
    True
    """
    number = _lib.tpa_version()
    return number >> 16, number >> 8 & 255, number & 255


def build_info() -> str:
    """Version and compiler of the loaded library, in a line."""
    line: bytes = _lib.tpa_build_info()
    return line.decode()


__all__ = [
    "Changes",
    "Component",
    "Control",
    "Defect",
    "DetectMode",
    "Error",
    "Event",
    "EventType",
    "HandleInfo",
    "Limit",
    "LimitError",
    "MemoryTable",
    "Mesh",
    "MeshError",
    "NONE",
    "Region",
    "Report",
    "Segmentation",
    "Status",
    "Surface",
    "TangledError",
    "UnresolvedError",
    "Validation",
    "VertexMap",
    "View",
    "ViewError",
    "arrays_of",
    "ball",
    "build_info",
    "errors",
    "handles",
    "library_version",
    "like",
    "resolve",
    "segment",
    "voxels",
]
