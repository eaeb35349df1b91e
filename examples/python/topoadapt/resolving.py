# SPDX-License-Identifier: MIT
"""A tangled mesh made clean by one call."""

from __future__ import annotations

from typing import Any, Optional

from .control import Control
from .errors import UnresolvedError
from .mesh import Mesh
from .records import Surface


def resolve(vertices: Any, faces: Any = None, *, control: Optional[Control] = None, **options: Any) -> Surface:
    """The surface of the region that a tangled mesh encloses: where its winding number is 1 or more.

    vertices, faces: arrays, or an object shaped like a trimesh or meshio mesh alone. Closed and consistently oriented;
    parts may cross, touch, coincide or lie within each other. options: as for Mesh.

    Returns a Surface (vertices, faces, report). Raises UnresolvedError where rounding leaves triangles that meet.

    >>> import numpy as np
    >>> from topoadapt import ball
    >>> (a, faces), (b, _) = ball(), ball((1, 0.1, 0))
    >>> vertices, faces, report = resolve(np.concatenate([a, b]), np.concatenate([faces, faces + len(a)]))
    >>> len(vertices) - len(faces) // 2
    2
    """
    mesh = Mesh(vertices, faces, **options)
    report = mesh.adapt(control)
    if report.unresolved:
        raise UnresolvedError(report, mesh)
    return Surface(mesh.vertices.copy(), mesh.faces.copy(), report)
