# SPDX-License-Identifier: MIT
"""What belongs to vertices, triangles and corners, carried through the commits of a topoadapt.Mesh. NumPy alone."""

import numpy as np
import topoadapt


class Attributes:
    """Arrays by name. means: numbers of vertices that may be mixed, (n, k); picks: numbers of vertices that may not;
    faces: numbers of triangles, (m, k); corners: numbers of the corners of triangles, (m, 3, k)."""

    def __init__(self, means=None, picks=None, faces=None, corners=None):
        self.means, self.picks = dict(means or {}), dict(picks or {})
        self.faces, self.corners = dict(faces or {}), dict(corners or {})

    def carry(self, mesh, vertices, faces):
        """Takes all through the last commit of a mesh. vertices: of before, where they were when the commit met them;
        faces: of before."""
        parents, weights = mesh.vertex_map()[1:]
        nearest = np.where((weights >= 0.5) | (parents[:, 1] == topoadapt.NONE), parents[:, 0], parents[:, 1])
        # Triangles without an origin take after the nearest with one.
        origins = mesh.carry_triangles(np.arange(len(faces))).astype(np.int64)
        for name, values in self.means.items():
            self.means[name] = mesh.carry_vertices(values.astype(float))
        for name, values in self.picks.items():
            self.picks[name] = values[nearest]
        for name, values in self.faces.items():
            self.faces[name] = values[origins]
        if self.corners:
            shares = _shares(mesh, vertices, faces.astype(np.int64)[origins])
            for name, values in self.corners.items():
                self.corners[name] = np.einsum("mij,mjk->mik", shares, values[origins])


def _shares(mesh, vertices, old_faces):
    """For each corner of each triangle, the shares of the three corners of the triangle's origin: (m, 3, 3)."""
    parents = mesh.vertex_map().parents
    corners = mesh.faces.astype(np.int64)
    shares = _barycentric(vertices[old_faces], mesh.vertices[corners])
    # An old vertex that is a corner of the origin has all of that corner, wherever the vertex has moved. New vertices
    # lie near the line of their parents, not on the line: their place tells more.
    same = (parents[corners][..., :1] == old_faces[:, None]) & (parents[corners][..., 1:] == topoadapt.NONE)
    return np.where(same.any(axis=2, keepdims=True), same, shares)


def _barycentric(triangles, points):
    """Shares of the corners of triangles (m, 3, 3) in points (m, 3, 3), three for each, not outside the triangle."""
    a, u, v = triangles[:, :1], triangles[:, 1:2] - triangles[:, :1], triangles[:, 2:] - triangles[:, :1]
    p = points - a
    uu, uv, vv = (u * u).sum(axis=2), (u * v).sum(axis=2), (v * v).sum(axis=2)
    pu, pv = (p * u).sum(axis=2), (p * v).sum(axis=2)
    area = np.maximum(uu * vv - uv * uv, np.finfo(float).tiny)
    second, third = (vv * pu - uv * pv) / area, (uu * pv - uv * pu) / area
    shares = np.clip(np.stack([1 - second - third, second, third], axis=2), 0, 1)
    return shares / np.maximum(shares.sum(axis=2, keepdims=True), 1e-12)
