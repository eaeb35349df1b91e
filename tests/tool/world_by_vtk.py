#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""world_by_vtk.py TOOL: does a mesh of `segment` lie where VTK places the voxels of the same NIfTI file?

VTK's reader knows the header's sform and qform by code of its own. An object without symmetry lies in the volume; box
and centre of the mesh must be those of the object's voxels, as VTK transforms them. Exit 77, skipped, without VTK.
"""
import math
import os
import struct
import subprocess
import sys
import tempfile

try:
    from vtkmodules.vtkIOImage import vtkNIFTIImageReader
except ImportError:
    print("skipped: no VTK for Python")
    sys.exit(77)

SIZES = (26, 22, 12)
STEPS = (0.7, 0.9, 2.0)


def grey(i, j, k):
    ball = math.dist((i * STEPS[0], j * STEPS[1], k * STEPS[2]), (7, 8, 11)) < 5
    block = 14 < i < 22 and 6 < j < 11 and 4 < k < 7
    return 200 if ball or block else 0


def quaternion_rows(b, c, d, mirrored):
    """Rows of the qform's rotation, times the steps."""
    a = math.sqrt(1 - b * b - c * c - d * d)
    rows = [
        [a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
        [2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b)],
        [2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - b * b - c * c],
    ]
    steps = (STEPS[0], STEPS[1], -STEPS[2] if mirrored else STEPS[2])
    return [[x * s for x, s in zip(row, steps)] for row in rows]


def nifti(use_sform, mirrored):
    header = bytearray(352)
    b, c, d = 0.1, -0.3, 0.2
    offset = (-12.5, 30.0, 7.25)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, *SIZES, 1, 1, 1, 1)
    struct.pack_into("<2h", header, 70, 2, 8)
    struct.pack_into("<8f", header, 76, -1 if mirrored else 1, *STEPS, 0, 0, 0, 0)
    struct.pack_into("<f", header, 108, 352)
    struct.pack_into("<B", header, 123, 2)
    struct.pack_into("<2h", header, 252, 0 if use_sform else 1, 1 if use_sform else 0)
    struct.pack_into("<6f", header, 256, b, c, d, *offset)
    if use_sform:
        for place, row, x in zip((280, 296, 312), quaternion_rows(b, c, d, mirrored), offset):
            struct.pack_into("<4f", header, place, *row, x)
    header[344:348] = b"n+1\0"
    voxels = bytes(grey(i, j, k) for k in range(SIZES[2]) for j in range(SIZES[1]) for i in range(SIZES[0]))
    return bytes(header) + voxels


def by_vtk(path, use_sform):
    """Places of the object's voxels, in VTK's order and by VTK's matrix, which takes millimetres along the axes."""
    reader = vtkNIFTIImageReader()
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()
    matrix = reader.GetSFormMatrix() if use_sform else reader.GetQFormMatrix()
    places = []
    for k in range(SIZES[2]):
        for j in range(SIZES[1]):
            for i in range(SIZES[0]):
                if image.GetScalarComponentAsDouble(i, j, k, 0) > 100:
                    at = [x * s for x, s in zip((i, j, k), image.GetSpacing())]
                    places.append(matrix.MultiplyPoint(at + [1.0])[:3])
    return places


def vertices_of(path):
    with open(path, "rb") as file:
        data = file.read()
    header, body = data.split(b"end_header\n", 1)
    count = next(int(line.split()[2]) for line in header.decode().split("\n") if line.startswith("element vertex"))
    numbers = struct.unpack_from("<%dd" % (3 * count), body)
    return [numbers[3 * v:3 * v + 3] for v in range(count)]


def box(places):
    return [min(p[k] for p in places) for k in range(3)] + [max(p[k] for p in places) for k in range(3)]


def main():
    tool = sys.argv[1]
    worst = 0
    with tempfile.TemporaryDirectory() as folder:
        for use_sform in (True, False):
            for mirrored in (False, True):
                path, mesh = os.path.join(folder, "v.nii"), os.path.join(folder, "m.ply")
                with open(path, "wb") as file:
                    file.write(nifti(use_sform, mirrored))
                call = [tool, "segment", path, "--seed", "10,9,5", "--threshold", "100", "--bright", "--out", mesh, "--quiet"]
                subprocess.run(call, check=True, stdout=subprocess.DEVNULL)
                theirs, ours = box(by_vtk(path, use_sform)), box(vertices_of(mesh))
                # The surface lies half a voxel beyond the outermost centres.
                beyond = [a - b for a, b in zip(theirs[:3], ours[:3])] + [b - a for a, b in zip(theirs[3:], ours[3:])]
                worst = max(worst, max(beyond) - 1.4, 0 - min(beyond))
                print("sform" if use_sform else "qform", "mirrored" if mirrored else "", [round(x, 2) for x in beyond])
    return 0 if worst <= 0 else 1


if __name__ == "__main__":
    sys.exit(main())
