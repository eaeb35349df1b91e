#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""leak_volumes.py FOLDER: volumes for the section "Leaks" of docs/segmentation.md.

bones.nrrd       shells 1.2 to 2.2 mm thick in voxels of .8 x .8 x 3 mm, with struts; noise of 2 % of the contrast
folds-20.nrrd    a body with folds and a cavity, in voxels of 3.3 x 3.3 x 4 mm; noise of 3 % and 9 %
folds-60.nrrd
"""
import sys

import numpy


def places(size, spacing, offset=(0, 0, 0)):
    axes = [(numpy.arange(size[k]) + offset[k] - size[k] / 2) * spacing[k] for k in range(3)]
    return numpy.meshgrid(*axes, indexing="ij")


def gyroid(x, y, z, scale):
    x, y, z = x / scale, y / scale, z / scale
    return numpy.sin(x) * numpy.cos(y) + numpy.sin(y) * numpy.cos(z) + numpy.sin(z) * numpy.cos(x)


def bones_at(x, y, z):
    value = numpy.full(x.shape, 40.0)
    shells = [((0, 0, 0), (52, 45, 60), 2.2), ((-15, 5, -20), (14, 12, 18), 1.4), ((18, -5, 10), (12, 16, 22), 1.2)]
    for centre, axes, wall in shells:
        out = numpy.sqrt(sum(((p - c) / a) ** 2 for p, c, a in zip((x, y, z), centre, axes)))
        depth = (1 - out) * min(axes)
        value[depth > 0] = numpy.maximum(value[depth > 0], 90)
        value[(depth > 0) & (depth < wall)] = 900
    spongy = ((x + 15) / 13) ** 2 + ((y - 5) / 11) ** 2 + ((z + 20) / 17) ** 2 < 1
    value[spongy & (numpy.abs(gyroid(x, y, z, 4)) < 0.2)] = 500
    within = (x / 52) ** 2 + (y / 45) ** 2 + (z / 60) ** 2 < 1
    for angle in numpy.arange(8) * numpy.pi / 4:
        across = numpy.hypot(x * numpy.sin(angle) - y * numpy.cos(angle), z - 5)
        value[(across < 1.5) & (x * numpy.cos(angle) + y * numpy.sin(angle) > 10) & within] = 700
    return value


def bones(random, size=(160, 160, 48), spacing=(0.8, 0.8, 3.0)):
    """Each voxel is the mean of sixteen places."""
    shares = [(a, b, c) for a in (-0.25, 0.25) for b in (-0.25, 0.25) for c in (-0.375, -0.125, 0.125, 0.375)]
    return sum(bones_at(*places(size, spacing, s)) for s in shares) / len(shares) + random.normal(0, 20, size), spacing


def folds(random, noise, size=(64, 64, 36), spacing=(3.3, 3.3, 4.0)):
    x, y, z = places(size, spacing)
    out = numpy.sqrt((x / 80) ** 2 + (y / 90) ** 2 + (z / 62) ** 2)
    cavity = numpy.sqrt((x / 80) ** 2 + (y / 90) ** 2 + ((z - 5) / 62) ** 2)
    value = 700 * numpy.clip((1 - out) * 17.5 + 0.5, 0, 1) + 120 * gyroid(x, y, z, 7) * (out < 0.95)
    return value - 350 * numpy.clip((0.2 - cavity) * 20, 0, 1) + random.normal(0, noise, size), spacing


def write(path, volume, spacing):
    sizes, spacings = ("%d %d %d" % volume.shape), ("%g %g %g" % spacing)
    head = f"NRRD0004\ntype: short\ndimension: 3\nsizes: {sizes}\nspacings: {spacings}\nencoding: raw\nendian: little\n\n"
    with open(path, "wb") as file:
        file.write(head.encode())
        file.write(volume.astype("<i2").transpose(2, 1, 0).tobytes())


def main(folder):
    write(f"{folder}/bones.nrrd", *bones(numpy.random.default_rng(1)))
    for noise in (20, 60):
        write(f"{folder}/folds-{noise}.nrrd", *folds(numpy.random.default_rng(2), noise))


if __name__ == "__main__":
    main(sys.argv[1])
