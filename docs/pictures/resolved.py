#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the picture of docs/evaluation.md: tangled meshes before and after `topoadapt resolve`, cut open.

    python3 docs/pictures/resolved.py build/test/topoadapt DATA/field docs/pictures/resolved.png

DATA is the folder of CMake's variable TOPOADAPT_SHARED_DATA. Needs numpy, matplotlib and pillow (Debian:
python3-matplotlib). Each mesh is seen from a side at which a plane cuts a part away. Where the plane passes through
the mesh, the colour tells the winding number; surfaces behind the plane are shaded.
"""
import os
import subprocess
import sys
import tempfile

import numpy as np
from matplotlib import get_data_path
from PIL import Image, ImageDraw, ImageFont

from render import INSIDE, camera, read_ply

# Name, caption, azimuth and elevation of the eye in degrees, plane (normal, offset from the centre) whose positive side
# is cut away, part of the extent that is shown (1: all).
MESHES = [
    ("boxes_cross", "a bar through a box", -62, 30, ((0, -1, 0), 0.0), 1.0),
    ("swept8", "eight cubes, each shifted by a quarter", -62, 30, ((0, -1, 0), 0.0), 1.0),
    ("thread32", "a thread whose turns overlap", -75, 14, ((0, -1, 0), -0.4), 0.9),
    ("frame", "a profile that folds over at the corners", -80, 55, ((0, 0, 1), 0.0), 0.9),
    ("spring8", "a spring whose turns overlap", -70, 12, ((0, -1, 0), 0.0), 1.0),
]
WIDTH, HEIGHT, CAPTION, FINER = 430, 265, 22, 3
OUTER = np.array([0.42, 0.62, 0.84])
# Where the plane cuts: winding number 1, 2, and more.
SECTION = np.array([[0.97, 0.86, 0.62], [0.93, 0.55, 0.30], [0.75, 0.22, 0.20]])
LINE = np.array([0.25, 0.22, 0.20])


def read_off(path):
    with open(path, encoding="ascii") as file:
        words = file.read().split()
    count, faces = int(words[1]), int(words[2])
    points = np.array(words[4:4 + 3 * count], float).reshape(-1, 3)
    rows = np.array(words[4 + 3 * count:4 + 3 * count + 4 * faces], int).reshape(-1, 4)
    if not np.all(rows[:, 0] == 3):
        raise ValueError(path + ": not a triangle mesh")
    return points, rows[:, 1:]


def resolve(tool, path):
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out.ply")
        subprocess.run([tool, "resolve", path, "--out", out, "--quiet"], check=True)
        return read_ply(out)


def covered_pixels(a, b, width, height, corners):
    """Pixels within a triangle: rows, columns, and weights of the corners. An edge decides alike for both its
    triangles, since its ends are taken in the order of their numbers."""
    low = np.maximum(np.floor(np.min(a, axis=0)).astype(int), 0)
    high = np.minimum(np.ceil(np.max(a, axis=0)).astype(int) + 1, (width, height))
    if np.any(low >= high):
        return None
    x, y = np.meshgrid(np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1]) + 0.5)
    weights = []
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        sign = 1 if corners[j] < corners[k] else -1
        p, q = (a[j], a[k]) if sign > 0 else (a[k], a[j])
        weights.append(sign * ((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])))
    total = sum(weights)
    front = total.flat[0] > 0
    inside = np.logical_and.reduce([(w > 0) == front for w in weights])
    rows, columns = np.nonzero(inside)
    return rows + low[1], columns + low[0], [w[inside] / total[inside] for w in weights], front


def lit(normal, base):
    key, fill = np.array([-0.45, 0.65, 0.75]), np.array([0.7, -0.3, 0.5])
    key, fill = key / np.linalg.norm(key), fill / np.linalg.norm(fill)
    return np.clip(base * (0.45 + 0.62 * max(normal @ key, 0) + 0.2 * max(normal @ fill, 0)), 0, 1)


class Canvas:
    """Pixels with the depth of the nearest surface behind the plane, and the winding number on the plane."""

    def __init__(self, plane, level, size):
        self.width, self.height = size
        shape = (self.height, self.width)
        self.colour = np.ones(shape + (3,))
        self.depth = np.full(shape, -np.inf)
        self.winding = np.zeros(shape, int)
        y, x = np.mgrid[0:self.height, 0:self.width] + 0.5
        self.section = (level - plane[0] * x - plane[1] * y) / plane[2]  # depth of the plane

    def add(self, corners, at):
        if np.linalg.norm(np.cross(at[1] - at[0], at[2] - at[0])) == 0:
            return
        found = covered_pixels(at[:, :2], at[:, 2], self.width, self.height, corners)
        if found is None:
            return
        rows, columns, weights, front = found
        depth = sum(w * z for w, z in zip(weights, at[:, 2]))
        behind = depth < self.section[rows, columns]
        np.add.at(self.winding, (rows[behind], columns[behind]), -1 if front else 1)
        nearer = behind & (depth > self.depth[rows, columns])
        rows, columns = rows[nearer], columns[nearer]
        self.depth[rows, columns] = depth[nearer]
        normal = np.cross(at[1] - at[0], at[2] - at[0])
        normal /= np.linalg.norm(normal)
        normal[1] = -normal[1]  # rows run downward
        colour = lit(normal if front else -normal, OUTER if front else INSIDE)
        # How far from the nearest edge, in pixels.
        heights = [np.linalg.norm(np.cross(at[1, :2] - at[0, :2], at[2, :2] - at[0, :2])) /
                   max(np.linalg.norm(at[(i + 1) % 3, :2] - at[(i + 2) % 3, :2]), 1e-9) for i in range(3)]
        edge = np.min([w[nearer] * h for w, h in zip(weights, heights)], axis=0)
        share = np.clip(edge / 1.2, 0, 1)[:, None]
        self.colour[rows, columns] = colour * (0.62 + 0.38 * share)

    def finish(self):
        on_plane = self.winding >= 1
        self.colour[on_plane] = SECTION[np.minimum(self.winding[on_plane], 3) - 1]
        # Lines where the winding number changes.
        change = np.zeros(on_plane.shape, bool)
        for axis in (0, 1):
            differ = np.diff(self.winding, axis=axis) != 0
            for shift in (0, 1):
                part = [slice(None)] * 2
                part[axis] = slice(shift, shift + differ.shape[axis])
                change[tuple(part)] |= differ
        wide = change.copy()
        for axis in (0, 1):
            wide |= np.roll(change, 1, axis)
        self.colour[wide] = LINE
        return self.colour


def draw(points, faces, centre, scale, view, cut, size):
    corners = ((points - centre) @ view.T) * scale + np.array([size[0] / 2, size[1] / 2, 0])
    corners[:, 1] = size[1] - corners[:, 1]
    normal = np.array(cut[0], float) @ view.T
    normal[1] = -normal[1]  # rows run downward
    level = cut[1] * scale + normal[:2] @ np.array([size[0] / 2, size[1] / 2])
    canvas = Canvas(normal, level, size)
    for face in faces:
        # Mirrored by the direction of rows: turned back.
        canvas.add(face[[0, 2, 1]], corners[face[[0, 2, 1]]])
    return canvas.finish()


def picture_of(points, faces, azimuth, elevation, cut, shown, reference):
    """Scale and centre follow the mesh before."""
    low, high = reference.min(axis=0), reference.max(axis=0)
    centre, view = (low + high) / 2, camera(azimuth, elevation)
    normal = np.array(cut[0], float)
    flat = (reference - centre) @ view[:2].T
    size = (WIDTH * FINER, HEIGHT * FINER)
    extent = flat.max(axis=0) - flat.min(axis=0)
    middle = (flat.max(axis=0) + flat.min(axis=0)) / 2
    centre_shown = centre + view[:2].T @ middle
    scale = 0.94 * min(size[0] / extent[0], size[1] / extent[1]) / shown
    offset = cut[1] + normal @ (centre - centre_shown)
    colour = draw(points, faces, centre_shown, scale, view, (cut[0], offset), size)
    blocks = colour.reshape(HEIGHT, FINER, WIDTH, FINER, 3).mean(axis=(1, 3))
    return Image.fromarray((255 * blocks + 0.5).astype(np.uint8))


def main():
    if len(sys.argv) != 4:
        sys.exit("usage: resolved.py TOOL FOLDER PICTURE")
    tool, folder, out = sys.argv[1:]
    font = ImageFont.truetype(os.path.join(get_data_path(), "fonts/ttf/DejaVuSans.ttf"), 13)
    sheet = Image.new("RGB", (2 * WIDTH + 10, len(MESHES) * (HEIGHT + CAPTION)), "white")
    pen = ImageDraw.Draw(sheet)
    for row, (name, caption, azimuth, elevation, cut, shown) in enumerate(MESHES):
        path = os.path.join(folder, name + ".off")
        before, after = read_off(path), resolve(tool, path)
        top = row * (HEIGHT + CAPTION)
        for column, (mesh, text) in enumerate(((before, "before"), (after, "after"))):
            part = picture_of(*mesh, azimuth, elevation, cut, shown, before[0])
            sheet.paste(part, (column * (WIDTH + 10), top))
            pen.text((column * (WIDTH + 10) + WIDTH / 2, top + HEIGHT + CAPTION / 2), name + ": " + caption if column == 0
                     else "after", font=font, fill="#333333", anchor="mm")
    sheet.quantize(128, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE).save(out, optimize=True)


if __name__ == "__main__":
    main()
