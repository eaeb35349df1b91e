#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the paper's figure 8 for the phantom cyst: a slice of the image, the mesh, its projection on the y-z plane.

    python3 docs/pictures/cyst.py build/test/topoadapt docs/pictures/cyst.png

Needs numpy, matplotlib and pillow (Debian: python3-matplotlib). The image is the one that the page of --html carries,
the mesh that of --out. In the projection every layer of the surface darkens a little, so that the needle shows.
"""
import base64
import io
import json
import os
import re
import subprocess
import sys
import tempfile
import zlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from PIL import Image

from render import camera, read_ply, shade, vertex_normals


def read_volume(path):
    """Grey values by z, y, x, as examples/tool/view/packing.h stores them."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    volume = json.loads(re.search(r'id="data">(.*?)</script>', text, re.S)[1])["volume"]
    packed = zlib.decompress(base64.b64decode(re.search(f'id="blob{volume["blob"]}">([^<]*)<', text)[1]))
    steps = np.frombuffer(packed, np.uint8).reshape(volume["size"][::-1])
    return np.cumsum(steps, axis=2, dtype=np.uint8)


def draw_mesh(axes, points, faces):
    view = camera(-55, 25)
    normals = vertex_normals(points, faces)[faces].mean(axis=1) @ view.T
    corners = (points @ view.T)[faces]
    order = np.argsort(corners[:, :, 2].mean(axis=1))
    colours = shade(normals, np.zeros(len(faces), bool))[order]
    axes.add_collection(PolyCollection(corners[order, :, :2], facecolors=colours, edgecolors=colours * 0.8, linewidths=0.2))


def draw_projection(axes, points, faces):
    axes.add_collection(PolyCollection(points[faces][:, :, 1:], facecolors=(0.1, 0.3, 0.55, 0.12), edgecolors=(0.1, 0.3, 0.55, 0.25),
                                       linewidths=0.2))


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: cyst.py TOOL PICTURE")
    with tempfile.TemporaryDirectory() as folder:
        html, ply = os.path.join(folder, "cyst.html"), os.path.join(folder, "cyst.ply")
        subprocess.run([sys.argv[1], "segment", "--phantom", "cyst", "--out", ply, "--html", html, "--quiet"], check=True)
        volume, (points, faces) = read_volume(html), read_ply(ply)
    figure, (image, mesh, projection) = plt.subplots(1, 3, figsize=(10, 3.7), gridspec_kw={"width_ratios": [1.15, 1.3, 0.75]})
    figure.subplots_adjust(left=0.01, right=0.99, bottom=0.1, top=0.99, wspace=0.04)
    middle = volume.shape[1] // 2
    image.imshow(volume[:, middle, :], cmap="gray", origin="lower", interpolation="nearest")
    draw_mesh(mesh, points, faces)
    draw_projection(projection, points, faces)
    for axes, caption in ((image, f"image, slice y = {middle}"), (mesh, "mesh"), (projection, "projection on the y-z plane")):
        axes.set_aspect("equal")
        axes.axis("off")
        if axes is not image:
            axes.autoscale_view()
        cell = axes.get_subplotspec().get_position(figure)
        figure.text((cell.x0 + cell.x1) / 2, 0.03, caption, ha="center", fontsize=11, color="#333333")
    picture = io.BytesIO()
    figure.savefig(picture, dpi=100, facecolor="white")
    colours = Image.open(picture).convert("RGB")
    colours.quantize(256, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE).save(sys.argv[2], optimize=True)


if __name__ == "__main__":
    main()
