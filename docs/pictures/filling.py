#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the animation of README.md: a balloon that fills the phantom cube-cavity, a cube with a spherical cavity.

    python3 docs/pictures/filling.py build/test/topoadapt docs/pictures/filling.webp

Needs numpy, matplotlib and pillow (Debian: python3-matplotlib). The genus in the caption
comes from vertices and triangles alone.
"""
import glob
import io
import os
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from PIL import Image

from render import camera, read_ply, shade, vertex_normals

EVERY, LONGEST = 8, 400  # iterations between two pictures, and in all
AZIMUTH, ELEVATION = -58, 28
CENTRE, EXTENT = np.array([50.0, 50.0, 50.0]), 62.0  # of the phantom's cube, which reaches from 15 to 85
SIDE = 4.0  # of the picture, in inches of 100 pixels


def genus(points, faces):
    """Of a connected mesh, by Euler's formula."""
    return 1 - (len(points) - len(faces) // 2) // 2


def draw(path, iteration):
    points, faces = read_ply(path)
    view = camera(AZIMUTH, ELEVATION)
    normals = vertex_normals(points, faces)[faces].mean(axis=1) @ view.T
    corners = ((points - CENTRE) @ view.T)[faces]
    towards = normals[:, 2] > 0
    corners, normals = corners[towards], normals[towards]
    colours = shade(normals, np.zeros(len(normals), bool))
    order = np.argsort(corners[:, :, 2].mean(axis=1))
    figure = plt.figure(figsize=(SIDE, SIDE))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.add_collection(PolyCollection(corners[order, :, :2], facecolors=colours[order], edgecolors=colours[order] * 0.8,
                                       linewidths=0.2))
    axes.set_xlim(-EXTENT, EXTENT)
    axes.set_ylim(-EXTENT - 4, EXTENT - 4)
    axes.axis("off")
    figure.text(0.5, 0.03, f"iteration {iteration}: genus {genus(points, faces)}, {len(points)} vertices", ha="center",
                fontsize=11, color="#333333")
    picture = io.BytesIO()
    figure.savefig(picture, dpi=100, facecolor="white")
    plt.close(figure)
    return Image.open(picture).convert("RGB")


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: filling.py TOOL PICTURE")
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.argv[1], "segment", "--phantom", "cube-cavity", "--iterations", str(LONGEST), "--quiet",
                        "--every", str(EVERY), "--frames", folder], check=True)
        paths = sorted(glob.glob(os.path.join(folder, "frame-*.ply")))
        pictures = [draw(path, int(os.path.basename(path)[6:12])) for path in paths]
    pictures[0].save(sys.argv[2], save_all=True, append_images=pictures[1:],
                     duration=[120] * (len(pictures) - 1) + [2500], loop=0, quality=60, method=6)


if __name__ == "__main__":
    main()
