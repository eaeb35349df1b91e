#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the picture of README: a robot's link as its STL file has it, and after `topoadapt resolve`.

    python3 docs/pictures/mended.py build/test/topoadapt docs/pictures/mended.png

The link has the faults of public files of this kind: bodies that overlap in place of one, facets that share no vertices,
one body inside out, facets the other way round, a facet left out. The tool makes the picture (--png).
"""
import math
import os
import subprocess
import sys
import tempfile


def prism(centre, radius, low, high, sides, turn=0.0):
    """Triangles of a prism along z."""
    def ring(z):
        angles = [2 * math.pi * (i + turn) / sides for i in range(sides)]
        return [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a), z) for a in angles]
    a, b = ring(low), ring(high)
    triangles = []
    for i in range(sides):
        j = (i + 1) % sides
        triangles += [(a[i], a[j], b[j]), (a[i], b[j], b[i])]
    for i in range(1, sides - 1):
        triangles += [(a[0], a[i + 1], a[i]), (b[0], b[i], b[i + 1])]
    return triangles


def box(low, high):
    corner = [tuple((high if k >> axis & 1 else low)[axis] for axis in range(3)) for k in range(8)]
    squares = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return [t for a, b, c, d in squares for t in ((corner[a], corner[b], corner[c]), (corner[a], corner[c], corner[d]))]


def turned(triangles):
    return [(a, c, b) for a, b, c in triangles]


def link():
    hub = prism((0, 0), 3, -1.5, 1.5, 48)
    for facet in (3, 20, 101):
        hub[facet] = turned([hub[facet]])[0]
    wrist = prism((11, 0.4), 1.9, -1.2, 1.2, 40)
    boss = prism((0, 0), 1.7, 1.1, 2.4, 32)
    del boss[85]  # of its top
    bar = turned(box((1, -1.1, -0.7), (10.5, 1.3, 0.7)))
    rib = box((1.5, -0.25, 0.3), (9.5, 0.35, 1.45))
    bolts = [t for i in range(6) for t in prism((2.3 * math.cos(i * math.pi / 3), 2.3 * math.sin(i * math.pi / 3)), 0.32,
                                               1.2, 1.8, 6, 0.13 * i)]
    return hub + wrist + boss + bar + rib + bolts + prism((11, 0.4), 0.9, 1.0, 1.7, 24)


def main():
    tool, picture = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "robot-link.stl")
        with open(path, "w", encoding="ascii") as file:
            file.write("solid link\n")
            for triangle in link():
                corners = "".join("vertex %.9g %.9g %.9g\n" % corner for corner in triangle)
                file.write("facet normal 0 0 0\nouter loop\n" + corners + "endloop\nendfacet\n")
            file.write("endsolid link\n")
        subprocess.run([tool, "resolve", path, "--fill", "3", "--turn-parts", "--out", os.path.join(folder, "link.ply"),
                        "--png", picture], check=True)


if __name__ == "__main__":
    main()
