# SPDX-License-Identifier: MIT
"""A ball to begin with."""

from __future__ import annotations

import itertools
from typing import Optional

import numpy as np
import numpy.typing as npt


def ball(
    centre: npt.ArrayLike = (0.0, 0.0, 0.0), radius: float = 1.0, edge_length: Optional[float] = None
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.uint32]]:
    """A ball as vertices and faces, from an octahedron; edges are about `edge_length` (default: radius / 4) long.

    >>> vertices, faces = ball((5, 0, 0), radius=2, edge_length=1)
    >>> len(vertices) - len(faces) // 2  # Euler number of a closed surface: V - E + F
    2
    """
    edge_length = radius / 4 if edge_length is None else edge_length
    parts = max(1, int(round(np.pi / 2 * radius / edge_length)))
    corners: list[npt.NDArray[np.int64]] = []
    faces: list[list[int]] = []
    # In each octant, the points with whole coordinates |x| + |y| + |z| = parts.
    grid = [(i, j, parts - i - j) for i in range(parts + 1) for j in range(parts + 1 - i)]
    place = {point: number for number, point in enumerate(grid)}
    for signs in itertools.product((1, -1), repeat=3):
        base = len(corners) * len(grid)
        corners.append(np.array(grid) * signs)
        order = 1 if np.prod(signs) > 0 else -1
        for i, j, k in grid:
            if k > 0:
                faces.append([base + place[p] for p in ((i, j, k), (i + 1, j, k - 1), (i, j + 1, k - 1))][::order])
            if k > 1:
                up = ((i + 1, j, k - 1), (i + 1, j + 1, k - 2), (i, j + 1, k - 1))
                faces.append([base + place[p] for p in up][::order])
    points, number = np.unique(np.concatenate(corners), axis=0, return_inverse=True)
    points = points / np.sqrt((points**2).sum(axis=1, keepdims=True))
    return np.asarray(centre, float) + radius * points, number.reshape(-1)[np.array(faces)].astype(np.uint32)
