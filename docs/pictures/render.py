#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of README.md from meshes as the tool writes them.

    cmake --workflow --preset demo
    python3 docs/pictures/render.py build/demo docs/pictures/segmentation.png

    for n in 3 9 20; do build/test/topoadapt evolve balls-cube --steps $n --out merging-$n.ply; done
    python3 docs/pictures/render.py . docs/pictures/merging.png

Needs numpy, matplotlib and pillow (Debian: python3-matplotlib). Triangles are shaded one by one and painted from back
to front. Some are cut open, so that the needle, the spheres or the void in them show; inner sides are brown.
"""
import io
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from PIL import Image

OUTSIDE = np.array([0.42, 0.62, 0.84])
INSIDE = np.array([0.93, 0.72, 0.44])
NESTED = np.array([0.80, 0.36, 0.34])

# Name of the file, caption, azimuth and elevation of the eye in degrees, plane (normal, offset from the centre)
# whose positive side is cut away from the largest component.
SEGMENTATION = [
    ("cyst", "cyst with a needle through it: genus 1, cut open", -50, 38, ((0, 0, 1), 0.0)),
    ("cube-cavity", "cube with a spherical cavity: genus 5", -58, 28, None),
    ("genus-3", "two crossing tori: genus 3", -52, 26, None),
    ("torus-nested", "torus with four nested spheres, cut open", -75, 40, ((0, 0, 1), 0.0)),
]
MERGING = [
    ("merging-3", "eight balls grow", -65, 22, None),
    ("merging-9", "one surface, genus 5", -65, 22, None),
    ("merging-20", "genus 0, and a void (cut open)", -65, 22, ((0.3, -1, 0.3), 0.0)),
]

# By the name of the picture: what it shows, rows, columns, size in inches.
PICTURES = {
    "segmentation.png": (SEGMENTATION, 2, 2, (9, 8)),
    "merging.png": (MERGING, 1, 3, (9, 3.4)),
}


def read_ply(path):
    """Vertices and triangles of a binary little-endian .ply with double coordinates and nothing else."""
    with open(path, "rb") as file:
        vertices = triangles = 0
        for line in iter(file.readline, b"end_header\n"):
            words = line.split()
            if not words:
                raise ValueError(path + ": no end_header")
            if words[:2] == [b"element", b"vertex"]:
                vertices = int(words[2])
            if words[:2] == [b"element", b"face"]:
                triangles = int(words[2])
        points = np.fromfile(file, "<f8", 3 * vertices).reshape(-1, 3)
        faces = np.fromfile(file, np.dtype([("n", "u1"), ("v", "<i4", 3)]), triangles)
    if len(points) != vertices or len(faces) != triangles or not np.all(faces["n"] == 3):
        raise ValueError(path + ": not a triangle mesh as the tool writes it")
    return points, faces["v"]


def vertex_normals(points, faces):
    corners = points[faces]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(points)
    for corner in range(3):
        np.add.at(normals, faces[:, corner], areas)
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


def camera(azimuth, elevation):
    """Rows: right, up, towards the eye."""
    a, e = np.radians([azimuth, elevation])
    towards = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    right = np.array([-np.sin(a), np.cos(a), 0.0])
    return np.array([right, np.cross(towards, right), towards])


def largest_component(points, faces):
    """For each triangle: does it belong to the component with most vertices?"""
    label = np.arange(len(points))
    while True:
        least = label[faces].min(axis=1)
        before = label.copy()
        for corner in range(3):
            np.minimum.at(label, faces[:, corner], least)
        label = label[label]
        if np.array_equal(label, before):
            break
    return label[faces[:, 0]] == np.bincount(label).argmax()


def clip(triangle, plane_normal, offset):
    """The part of a triangle with plane_normal . x <= offset: a polygon, or None."""
    heights = triangle @ plane_normal - offset
    polygon = []
    for i in range(3):
        j = (i + 1) % 3
        if heights[i] <= 0:
            polygon.append(triangle[i])
        if (heights[i] <= 0) != (heights[j] <= 0):
            t = heights[i] / (heights[i] - heights[j])
            polygon.append(triangle[i] + t * (triangle[j] - triangle[i]))
    return np.array(polygon) if len(polygon) >= 3 else None


def shade(normals, nested):
    """Colours for normals in camera coordinates."""
    front = normals[:, 2:3] >= 0
    n = np.where(front, normals, -normals)
    base = np.where(nested[:, None], NESTED, np.where(front, OUTSIDE, INSIDE))
    key, fill = np.array([-0.45, 0.65, 0.75]), np.array([0.7, -0.3, 0.5])
    key, fill = key / np.linalg.norm(key), fill / np.linalg.norm(fill)
    light = 0.34 + 0.62 * np.clip(n @ key, 0, 1) + 0.22 * np.clip(n @ fill, 0, 1)
    half = key + np.array([0, 0, 1])
    gloss = 0.15 * np.clip(n @ (half / np.linalg.norm(half)), 0, 1) ** 30
    return np.clip(base * light[:, None] + gloss[:, None], 0, 1)


def draw(axes, points, faces, caption, azimuth, elevation, cut):
    points = points - (points.min(axis=0) + points.max(axis=0)) / 2
    normals = vertex_normals(points, faces)[faces].mean(axis=1)
    corners = points[faces]
    nested = np.zeros(len(faces), bool)
    polygons = list(corners)
    if cut is not None:
        nested = ~largest_component(points, faces)
        plane = np.array(cut[0], float)
        polygons = [t if n else clip(t, plane, cut[1]) for t, n in zip(corners, nested)]
        kept = np.array([p is not None for p in polygons])
        polygons = [p for p in polygons if p is not None]
        normals, nested = normals[kept], nested[kept]
    view = camera(azimuth, elevation)
    polygons = [p @ view.T for p in polygons]
    colours = shade(normals @ view.T, nested)
    order = np.argsort([p[:, 2].mean() for p in polygons])
    axes.add_collection(
        PolyCollection(
            [polygons[i][:, :2] for i in order],
            facecolors=colours[order],
            edgecolors=colours[order] * 0.8,
            linewidths=0.25,
        )
    )
    flat = np.concatenate([p[:, :2] for p in polygons])
    low, high = flat.min(axis=0), flat.max(axis=0)
    margin = 0.02 * (high - low).max()
    axes.set_xlim(low[0] - margin, high[0] + margin)
    axes.set_ylim(low[1] - margin, high[1] + margin)
    axes.set_aspect("equal")
    axes.axis("off")
    # The caption hangs under the cell of the grid, not under the drawing, so that a row's captions are level.
    cell = axes.get_subplotspec().get_position(axes.figure)
    axes.figure.text((cell.x0 + cell.x1) / 2, cell.y0 - 0.24 / axes.figure.get_figheight(), caption, ha="center", fontsize=11, color="#333333")


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: render.py FOLDER PICTURE")
    pictures, rows, columns, size = PICTURES[os.path.basename(sys.argv[2])]
    figure, grid = plt.subplots(rows, columns, figsize=size)
    figure.subplots_adjust(left=0.01, right=0.99, bottom=0.4 / size[1], top=0.99, wspace=0.04, hspace=0.13)
    for axes, (name, caption, azimuth, elevation, cut) in zip(grid.flat, pictures):
        points, faces = read_ply(sys.argv[1] + "/" + name + ".ply")
        draw(axes, points, faces, caption, azimuth, elevation, cut)
    picture = io.BytesIO()
    figure.savefig(picture, dpi=100, facecolor="white")
    # A palette makes the file a third as large.
    colours = Image.open(picture).convert("RGB")
    colours.quantize(256, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE).save(sys.argv[2], optimize=True)


if __name__ == "__main__":
    main()
