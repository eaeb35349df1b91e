# SPDX-License-Identifier: MIT
"""Segmentation of a volume by a balloon: x' = f - g, as in section 6 of the paper, in NumPy on the public interface.

The force f pushes a vertex along its normal, at full speed within the object and back outside, through the border in
proportion to the depth of the grey value; g pulls it to the mean of its neighbours. A vertex at rest is anchored.
topoadapt's own tool (`topoadapt segment`) has the same forces, and more on top: filters, contacts that ripen, coarse
meshes refined at rest, checks of the first ball.
"""

from __future__ import annotations

import warnings
from typing import Any, Callable, NamedTuple, Optional

import numpy as np
import numpy.typing as npt

from ._structures import NONE
from .mesh import Mesh
from .shapes import ball
from .voxels import connected, inside

Array = npt.NDArray[Any]


class Segmentation(NamedTuple):
    """Result of segment(): `vertices` in the units of the affine map, `faces`; `mask` of the voxels inside; `filled`:
    share of the object inside the mesh; `beyond`: voxels inside that are not of the object, as a share of the object;
    `iterations`; `at_rest`: whether the balloon came to rest; `mesh`: the Mesh, to go on with."""

    vertices: npt.NDArray[np.float64]
    faces: npt.NDArray[np.uint32]
    mask: npt.NDArray[np.bool_]
    filled: float
    beyond: float
    iterations: int
    at_rest: bool
    mesh: Mesh


_LEAST_GAIN = 1.0 / 16  # the image turns a vertex back, its speed halves; below this part it is anchored
_REST_DISTANCE, _REST_ITERATIONS = 0.03, 4  # so many moves by less than this part of a voxel anchor a vertex
_QUIET = ((500, 15), (150, 40))  # at rest: of so many vertices less than one moves, for so many iterations
_REMESH_INTERVAL, _SWEEPS_AFTER_CONTACT = 4, 5
_PART_OF_VOXEL, _LARGEST_PART = 0.125, 0.5  # width of the border: from contrast, and up to here from noise


def segment(
    volume: npt.ArrayLike,
    seed: tuple[int, ...],
    threshold: float,
    *,
    affine: Optional[npt.ArrayLike] = None,
    radius: Optional[float] = None,
    edge_length: Optional[float] = None,
    width: Optional[float] = None,
    speed: float = 0.38,
    tension: float = 0.25,
    max_iterations: int = 2000,
    callback: Optional[Callable[[int, Mesh], Any]] = None,
    **options: Any,
) -> Segmentation:
    """Inflates a ball in a volume until it fills the object round the seed: the voxels on the seed's side of the
    threshold that are connected with the seed.

    volume: (ni, nj, nk) numbers. seed: voxel (i, j, k). affine: 4 x 4 map from voxel indices to the units of the
        result, as nibabel's image.affine; None: voxel indices.
    radius of the first ball (None: up to 4 voxels, as far as the ball lies in the object) and edge_length aimed at
        (None: 1.7 voxels), in units of the result.
    width: grey values round the threshold within which the speed falls to zero. None: from the border's contrast and
        the noise. speed: edge lengths for an iteration. tension: part of the way to the neighbours' mean.
    callback: called with (iteration, Mesh) after each iteration; True ends the work. options: as for Mesh.

    Returns a Segmentation. Warns where less than 90 % of the object are filled, more than 5 % lie beyond it, or the
    balloon is not at rest.

    >>> i, j, k = np.indices((24, 24, 24)) - 11.5
    >>> found = segment(8 - np.sqrt(i**2 + j**2 + k**2), seed=(11, 11, 11), threshold=0)
    >>> found.filled > 0.9, found.mesh.validate().genus
    (True, 0)
    """
    volume = np.asarray(volume, float)
    if volume.ndim != 3:
        raise ValueError("a volume has three axes; the shape is {}".format(volume.shape))
    if not np.isfinite(volume).all():
        raise ValueError("voxel {} is not finite".format(tuple(np.argwhere(~np.isfinite(volume))[0].tolist())))
    seed = tuple(int(x) for x in seed)
    if len(seed) != 3 or any(not 0 <= x < n for x, n in zip(seed, volume.shape)):
        raise ValueError("the seed {} is no voxel of a volume of shape {}".format(seed, volume.shape))
    depth = volume - threshold if volume[seed] > threshold else threshold - volume
    if depth[seed] <= 0:
        raise ValueError("the seed {} has the grey value of the threshold".format(seed))
    grid = _Grid(depth, np.eye(4) if affine is None else np.asarray(affine, float))
    found = connected(depth > 0, seed)
    centre = grid.to_world(np.array(seed, float))
    radius = _fitting_radius(grid, found, centre) if radius is None else radius
    edge_length = 1.7 * grid.side if edge_length is None else edge_length
    width = _width(depth, found) if width is None else width
    mesh = Mesh(*ball(centre, radius, edge_length), **options)
    balloon = _Balloon(mesh, grid, edge_length, width, speed, tension)
    iterations, at_rest = balloon.run(max_iterations, callback)
    return _result(balloon, found, iterations, at_rest)


def _result(balloon: _Balloon, found: Array, iterations: int, at_rest: bool) -> Segmentation:
    vertices, faces = balloon.mesh.vertices.copy(), balloon.mesh.faces.copy()
    mask = inside(balloon.grid.to_index(vertices), faces, found.shape)
    filled = float((mask & found).sum() / found.sum())
    beyond = float((mask & ~found).sum() / found.sum())
    if filled < 0.9 or beyond > 0.05 or not at_rest:
        warnings.warn(
            "the balloon fills {:.1%} of the object, reaches {:.1%} beyond, and is {}at rest".format(
                filled, beyond, "" if at_rest else "not "
            ),
            stacklevel=3,
        )
    return Segmentation(vertices, faces, mask, filled, beyond, iterations, at_rest, balloon.mesh)


class _Grid:
    """Depths below the border at voxel centres, and the map from indices to the world."""

    def __init__(self, depth: Array, affine: Array) -> None:
        self.depth, self.affine, self.inverse = depth, affine, np.linalg.inv(affine)
        self.side = abs(np.linalg.det(affine[:3, :3])) ** (1.0 / 3)

    def to_world(self, points: Array) -> Array:
        return points @ self.affine[:3, :3].T + self.affine[:3, 3]

    def to_index(self, points: Array) -> Array:
        return points @ self.inverse[:3, :3].T + self.inverse[:3, 3]

    def sample(self, points: Array) -> Array:
        """Trilinear depths at points of the world; -inf outside the volume."""
        at, size = self.to_index(points), np.array(self.depth.shape)
        outside = ((at < -0.5) | (at > size - 0.5)).any(axis=1)
        at = np.clip(at, 0, size - 1)
        low = np.minimum(at.astype(np.int64), np.maximum(size - 2, 0))
        part, high = at - low, np.minimum(low + 1, size - 1)
        value = np.zeros(len(at))
        for corner in np.ndindex(2, 2, 2):
            chosen = np.array(corner, bool)
            i, j, k = np.where(chosen, high, low).T
            value += np.where(chosen, part, 1 - part).prod(axis=1) * self.depth[i, j, k]
        return np.where(outside, -np.inf, value)


def _fitting_radius(grid: _Grid, found: Array, centre: Array) -> float:
    """The largest ball of up to four voxels round the centre within the object; not below one voxel."""
    at = grid.to_world(np.argwhere(~found).astype(float))
    nearest = np.sqrt(((at - centre) ** 2).sum(axis=1).min()) if len(at) else np.inf
    return float(np.clip(nearest - 0.5 * grid.side, grid.side, 4 * grid.side))


def _width(depth: Array, found: Array) -> float:
    """A part of the contrast across the border, up to the noise within the object."""
    steps: list[Array] = []
    total, within = np.zeros(depth.shape), np.zeros(depth.shape, int)
    for axis in range(3):
        for a, b in ((slice(1, None), slice(None, -1)), (slice(None, -1), slice(1, None))):
            here = tuple(a if x == axis else slice(None) for x in range(3))
            there = tuple(b if x == axis else slice(None) for x in range(3))
            border = found[here] & ~found[there]
            steps.append(np.abs(depth[here] - depth[there])[border])
            total[here] += np.where(found[there], depth[there], 0)
            within[here] += found[there]
    contrasts = np.concatenate(steps)
    contrast = float(np.median(contrasts)) if contrasts.size else 0.0
    deep = found & (within == 6)
    noise = np.median(np.abs(depth[deep] - total[deep] / 6)) / 0.6745 / np.sqrt(7 / 6) if deep.any() else 0.0
    return max(1e-6, float(np.clip(noise, _PART_OF_VOXEL * contrast, _LARGEST_PART * contrast)))


class _Balloon:
    """The mesh, and the state of each vertex: `gain` is its part of the full speed (0: anchored), `last` the last drive,
    `still` the number of small moves in a row."""

    def __init__(self, mesh: Mesh, grid: _Grid, edge_length: float, width: float, speed: float, tension: float) -> None:
        self.mesh, self.grid, self.edge_length, self.width = mesh, grid, edge_length, width
        self.speed, self.tension = speed, tension
        self.x, self.faces = mesh.vertices, mesh.faces
        self.state = self._fresh(len(self.x))

    @staticmethod
    def _fresh(count: int) -> Array:
        state = np.zeros(count, [("gain", float), ("last", float), ("still", int)])
        state["gain"] = 1
        return state

    def run(self, max_iterations: int, callback: Optional[Callable[[int, Mesh], Any]]) -> tuple[int, bool]:
        quiet, iteration = [0, 0], 0
        while iteration < max_iterations:
            ids, targets = self._moves()
            for n, (vertices, _) in enumerate(_QUIET):
                quiet[n] = quiet[n] + 1 if len(ids) * vertices < len(self.x) else 0
            if not len(ids) or any(q > most for q, (_, most) in zip(quiet, _QUIET)):
                return iteration, True
            contact = self._step(ids, targets)
            iteration += 1
            if contact or iteration % _REMESH_INTERVAL == 0:
                self._remesh(_SWEEPS_AFTER_CONTACT if contact else 1)
            if callback is not None and callback(iteration, self.mesh):
                break
        return iteration, False

    def _moves(self) -> tuple[Array, Array]:
        """Vertices that move, and their targets."""
        state = self.state
        normal, pull, shortest = self._stars()
        drive = np.clip(self.grid.sample(self.x) / self.width, -1, 1)
        state["gain"][drive * state["last"] < 0] *= 0.5
        state["gain"][state["gain"] < _LEAST_GAIN] = 0
        state["last"] = drive
        size = np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
        push = self.speed * self.edge_length * drive[:, None] * normal / size
        move = state["gain"][:, None] * (push + self.tension * pull)
        length = np.linalg.norm(move, axis=1)
        state["still"] = np.where(length < _REST_DISTANCE * self.grid.side, state["still"] + 1, 0)
        state["gain"][state["still"] >= _REST_ITERATIONS] = 0
        # A move stays under half the shortest edge at the vertex.
        move *= np.minimum(1, 0.5 * shortest / np.maximum(length, 1e-300))[:, None]
        ids = np.flatnonzero((state["gain"] > 0) & (length > 0))
        return ids, (self.x + move)[ids]

    def _stars(self) -> tuple[Array, Array, Array]:
        """For each vertex: its normal, the way to the mean of its neighbours, its shortest edge."""
        x, faces, n = self.x, self.faces.astype(np.int64), len(self.x)
        p = x[faces]
        face_normal = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
        here, there = faces.reshape(-1), faces[:, [1, 2, 0]].reshape(-1)
        degree = np.bincount(here, minlength=n)[:, None]
        normal = _sums(here, np.repeat(face_normal, 3, axis=0), n)
        mean = _sums(here, x[there], n) / degree  # each neighbour follows the vertex in exactly one triangle
        shortest = np.full(n, np.inf)
        edge = np.linalg.norm(x[there] - x[here], axis=1)
        np.minimum.at(shortest, here, edge)  # the opposite half-edges give the other ends
        return normal, mean - x, shortest

    def _step(self, ids: Array, targets: Array) -> bool:
        """Moves the vertices. True if the surface met itself."""
        before, wanted = self.x, self.x.copy()
        wanted[ids] = targets
        self.mesh.move(targets, ids)
        report = self.mesh.step()
        with self.mesh.view() as view:
            parent, at = view.origins["parents"].astype(np.int64), view.vertices.copy()
        known = np.flatnonzero(parent[:, 1] == NONE)
        old = parent[known, 0]
        # New vertices start afresh, and so do vertices placed elsewhere than at their targets.
        where_expected = (at[known] == wanted[old]).all(axis=1) | (at[known] == before[old]).all(axis=1)
        state = self._fresh(len(at))
        state[known[where_expected]] = self.state[old[where_expected]]
        self.x, self.faces, self.state = at, self.mesh.faces, state
        return report.groups > 0

    def _remesh(self, sweeps: int) -> None:
        """New vertices take after the livelier parent, so that a surface at rest stays at rest."""
        self.mesh.remesh(self.edge_length, sweeps)
        parents = self.mesh.vertex_map().parents.astype(np.int64)
        second = np.where(parents[:, 1] == NONE, parents[:, 0], parents[:, 1])
        livelier = self.state["gain"][second] > self.state["gain"][parents[:, 0]]
        self.state = self.state[np.where(livelier, second, parents[:, 0])]
        self.x, self.faces = self.mesh.vertices, self.mesh.faces


def _sums(places: Array, values: Array, count: int) -> Array:
    return np.stack([np.bincount(places, values[:, axis], count) for axis in range(3)], axis=1)
