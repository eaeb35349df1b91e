# SPDX-License-Identifier: MIT
"""Meshes for tests, and judgements on meshes in NumPy that ask nothing of the library."""

import math

import numpy as np

import topoadapt


def two_balls(distance, edge_length=0.3):
    """Two unit balls with so much between their centres, along x."""
    a, faces = topoadapt.ball((-distance / 2, 0, 0), edge_length=edge_length)
    b, _ = topoadapt.ball((distance / 2, 0, 0), edge_length=edge_length)
    return np.concatenate([a, b]), np.concatenate([faces, faces + np.uint32(len(a))])


def is_closed(faces):
    """Each directed edge occurs once, and so does its opposite."""
    faces = np.asarray(faces, np.int64)
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    once = {tuple(edge) for edge in edges}
    return len(once) == len(edges) and all((b, a) in once for a, b in once)


def euler(vertices, faces):
    """V - E + F of a closed mesh."""
    return len(vertices) - 3 * len(faces) // 2 + len(faces)


def volume(vertices, faces):
    a, b, c = np.asarray(vertices)[np.asarray(faces)].transpose(1, 0, 2)
    return float((np.cross(a, b) * c).sum() / 6)


def middle(vertices, faces):
    """Centre of the volume, which no spread of the vertices moves."""
    a, b, c = np.asarray(vertices)[np.asarray(faces)].transpose(1, 0, 2)
    parts = (np.cross(a, b) * c).sum(axis=1) / 6
    return parts @ (a + b + c) / (4 * parts.sum())


def lens(distance):
    """Volume that two unit balls share."""
    return math.pi * (2 - distance) ** 2 * (distance**2 + 4 * distance) / (12 * distance)


def rings_ball(x, y):
    """make_ball of examples/balls.h: the same positions to the bit, since math and C share sin and cos."""
    rings, sectors, vertices = 12, 24, []
    for r in range(rings):
        for s in range(sectors):
            polar, around = math.pi * (r + 1) / (rings + 1), 2 * math.pi * s / sectors
            vertices.append((x + math.sin(polar) * math.cos(around), y + math.sin(polar) * math.sin(around)))
            vertices[-1] += (math.cos(polar),)
    vertices += [(x, y, 1.0), (x, y, -1.0)]
    north, south, faces = rings * sectors, rings * sectors + 1, []
    for s in range(sectors):
        t = (s + 1) % sectors
        faces += [(north, s, t), (south, (rings - 1) * sectors + t, (rings - 1) * sectors + s)]
        for r in range(rings - 1):
            upper, lower = r * sectors, (r + 1) * sectors
            faces += [(upper + s, lower + s, lower + t), (upper + s, lower + t, upper + t)]
    return np.array(vertices), np.array(faces, np.uint32)
