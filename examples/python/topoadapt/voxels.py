# SPDX-License-Identifier: MIT
"""Volumes and meshes: which voxels a mesh encloses, which voxels are the object, the cut of a mesh with a slice."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]

# Columns lie beside the voxel centres by this, so that no column runs along an edge of a mesh with whole coordinates.
_ASIDE = (1.3e-7, 2.9e-7)


def inside(vertices: npt.ArrayLike, faces: npt.ArrayLike, shape: tuple[int, ...]) -> npt.NDArray[np.bool_]:
    """The voxels whose centres a closed mesh encloses: a boolean array. Vertices in voxel indices: voxel (i, j, k) has
    its centre at (i, j, k). Winding numbers are counted along the third axis.

    >>> from topoadapt import ball
    >>> int(inside(*ball((5, 5, 5), radius=2.5), (11, 11, 11)).sum())
    81
    """
    vertices, faces = np.asarray(vertices, float), np.asarray(faces, np.int64)
    triangle, i, j = _columns(vertices, faces, shape)
    corner = faces[triangle]
    side = [_side(vertices, corner[:, c], corner[:, (c + 1) % 3], i + _ASIDE[0], j + _ASIDE[1]) for c in range(3)]
    up, down = np.all(np.array(side) > 0, axis=0), np.all(np.array(side) < 0, axis=0)
    hit = up | down
    height = _height(vertices[corner[hit], 2], [values[hit] for values in side])
    below = np.clip(np.ceil(height), 0, shape[2]).astype(np.int64)
    crossings = np.zeros((shape[0], shape[1], shape[2] + 1), np.int32)
    np.add.at(crossings, (i[hit], j[hit], below), np.where(up[hit], 1, -1))
    return np.cumsum(crossings[:, :, ::-1], axis=2)[:, :, -2::-1] != 0


def _columns(vertices: Array, faces: Array, shape: tuple[int, ...]) -> tuple[Array, Array, Array]:
    """Triangles, and the columns (i, j) under the box of each."""
    first, count = [], []
    for axis in range(2):
        at = vertices[faces, axis] - _ASIDE[axis]
        low = np.clip(np.ceil(at.min(axis=1)), 0, shape[axis]).astype(np.int64)
        high = np.clip(np.floor(at.max(axis=1)) + 1, 0, shape[axis]).astype(np.int64)
        first.append(low)
        count.append(np.maximum(high - low, 0))
    columns = count[0] * count[1]
    triangle = np.repeat(np.arange(len(faces)), columns)
    place = np.arange(len(triangle)) - np.repeat(np.cumsum(columns) - columns, columns)
    return triangle, first[0][triangle] + place // count[1][triangle], first[1][triangle] + place % count[1][triangle]


def _side(vertices: Array, a: Array, b: Array, x: Array, y: Array) -> Array:
    """On which side of edge a, b a column lies; exactly opposite for edge b, a, and never 0."""
    sign = np.where(a < b, 1.0, -1.0)
    p, q = vertices[np.minimum(a, b)], vertices[np.maximum(a, b)]
    value = (q[:, 0] - p[:, 0]) * (y - p[:, 1]) - (q[:, 1] - p[:, 1]) * (x - p[:, 0])
    return sign * np.where(value == 0, np.finfo(float).tiny, value)


def _height(z: Array, side: list[Array]) -> Array:
    """Where a column crosses the triangle: side c belongs to the corner after next."""
    return (side[1] * z[:, 0] + side[2] * z[:, 1] + side[0] * z[:, 2]) / (side[0] + side[1] + side[2])


def connected(mask: npt.NDArray[np.bool_], seed: tuple[int, ...]) -> npt.NDArray[np.bool_]:
    """The part of a mask connected with the seed across faces of voxels.

    >>> mask = np.array([1, 1, 0, 1], bool).reshape(4, 1, 1)
    >>> connected(mask, (0, 0, 0)).ravel()
    array([ True,  True, False, False])
    """
    # A layer of False all round keeps neighbours in the array.
    left: npt.NDArray[np.bool_] = np.zeros(tuple(n + 2 for n in mask.shape), np.bool_)
    left[1:-1, 1:-1, 1:-1] = mask
    found, flat = np.zeros_like(left), left.reshape(-1)
    steps = [sign * stride // left.itemsize for stride in left.strides for sign in (1, -1)]
    front = np.array([np.ravel_multi_index([int(s) + 1 for s in seed], left.shape)])
    front = front[flat[front]]
    flat[front] = False
    while front.size:
        found.reshape(-1)[front] = True
        front = np.unique(np.concatenate([front + step for step in steps]))
        front = front[flat[front]]
        flat[front] = False
    return found[1:-1, 1:-1, 1:-1]


def slice_mesh(vertices: npt.ArrayLike, faces: npt.ArrayLike, axis: int, at: float) -> npt.NDArray[np.float64]:
    """The curve in which a mesh crosses a plane across `axis`: (k, 2, 3) ends of segments.

    >>> from topoadapt import ball
    >>> ends = slice_mesh(*ball(), axis=2, at=0.1)
    >>> abs(np.linalg.norm(ends, axis=2) - 1).max() < 0.05
    True
    """
    vertices = np.asarray(vertices, float)
    corner = vertices[np.asarray(faces, np.int64)]
    above = corner[:, :, axis] > at
    crossing = above.any(axis=1) & ~above.all(axis=1)
    corner, above = corner[crossing], above[crossing]
    lone = np.argmax(above == (above.sum(axis=1) == 1)[:, None], axis=1)
    rows = np.arange(len(corner))
    p, ends = corner[rows, lone], []
    for turn in (1, 2):
        q = corner[rows, (lone + turn) % 3]
        part = (at - p[:, axis]) / (q[:, axis] - p[:, axis])
        ends.append(p + part[:, None] * (q - p))
    return np.stack(ends, axis=1)
