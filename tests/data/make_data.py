#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""make_data.py FOLDER: the tests' own small meshes and volumes, with answers known by construction. They take the place
of real files where there are none beside the project (TOPOADAPT_SHARED_DATA). CMake makes them when it configures the
tests. Standard library only; coordinates have nine decimals, so that all machines agree."""
import gzip
import math
import os
import struct
import sys


# ---------------------------------------------------------------- writing

def text(x):
    """Nine decimals, or all digits of what nine decimals would lose."""
    rounded = round(x, 9)
    return repr(rounded if abs(x) > 1e-6 or x == 0 else x) if rounded != int(rounded) or 0 < abs(x) < 1e-6 else str(int(rounded))


def write(folder, name, data):
    path = os.path.join(folder, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb") as file:
        file.write(data if isinstance(data, bytes) else data.encode())


def off(mesh):
    points, faces = mesh
    lines = ["OFF", f"{len(points)} {len(faces)} 0"]
    lines += [" ".join(text(x) for x in p) for p in points]
    lines += [" ".join(map(str, [len(f), *f])) for f in faces]
    return "\n".join(lines) + "\n"


def obj(mesh):
    points, faces = mesh
    lines = ["v " + " ".join(text(x) for x in p) for p in points]
    lines += ["f " + " ".join(str(v + 1) for v in f) for f in faces]
    return "\n".join(lines) + "\n"


def ascii_stl(mesh):
    points, faces = mesh
    lines = ["solid made"]
    for face in faces:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex " + " ".join(text(x) for x in points[v]) for v in face]
        lines += ["endloop", "endfacet"]
    return "\n".join(lines + ["endsolid made"]) + "\n"


# ---------------------------------------------------------------- shapes: points and faces, outward

def together(*meshes):
    points, faces = [], []
    for part, of in meshes:
        faces += [[v + len(points) for v in face] for face in of]
        points += part
    return points, faces


def mapped(mesh, function):
    return [tuple(function(p)) for p in mesh[0]], mesh[1]


def moved(mesh, by):
    return mapped(mesh, lambda p: [a + b for a, b in zip(p, by)])


def turned_about_z(mesh, angle):
    c, s = math.cos(angle), math.sin(angle)
    return mapped(mesh, lambda p: (c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]))


def reversed_faces(mesh):
    return mesh[0], [face[::-1] for face in mesh[1]]


def box(low, high, parts=1):
    """Each side in parts x parts squares of two triangles."""
    points, index, faces = [], {}, []

    def at(*grid):
        if grid not in index:
            index[grid] = len(points)
            points.append(tuple(l + (h - l) * g / parts for l, h, g in zip(low, high, grid)))
        return index[grid]

    if parts == 1:  # corners in the order of their coordinates, x first
        for k in range(8):
            at(k & 1, k >> 1 & 1, k >> 2)
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, parts):
            for i in range(parts):
                for j in range(parts):
                    corners = []
                    for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        grid = [0, 0, 0]
                        grid[axis], grid[u], grid[v] = side, i + a, j + b
                        corners.append(at(*grid))
                    if side == 0:
                        corners.reverse()
                    faces += [[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]]
    return points, faces


def prism(polygon, height):
    """Over a polygon counter-clockwise; caps are polygons, too."""
    n = len(polygon)
    points = [(x, y, 0) for x, y in polygon] + [(x, y, height) for x, y in polygon]
    sides = [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    return points, sides + [list(range(n))[::-1], list(range(n, 2 * n))]


def globe(radius, rows, columns):
    points, faces = [(0, 0, -radius)], []
    for i in range(1, rows):
        a = math.pi * i / rows
        for j in range(columns):
            b = 2 * math.pi * j / columns
            points.append((radius * math.sin(a) * math.cos(b), radius * math.sin(a) * math.sin(b), -radius * math.cos(a)))
    points.append((0, 0, radius))
    top = len(points) - 1
    at = lambda i, j: 1 + (i - 1) * columns + j % columns
    for j in range(columns):
        faces += [[0, at(1, j + 1), at(1, j)], [top, at(rows - 1, j), at(rows - 1, j + 1)]]
        for i in range(1, rows - 1):
            faces += [[at(i, j), at(i, j + 1), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i + 1, j)]]
    return points, faces


def tube(curve, radius, around, steps):
    """Round curve(0 .. 1), closed at both ends; rings lie square to the curve."""
    def minus(a, b):
        return [x - y for x, y in zip(a, b)]

    def unit(a):
        length = math.sqrt(sum(x * x for x in a))
        return [x / length for x in a]

    def cross(a, b):
        return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]

    points, faces = [tuple(curve(0))], []
    for i in range(steps + 1):
        t = i / steps
        middle, along = curve(t), unit(minus(curve(t + 1e-4), curve(t - 1e-4)))
        side = unit(cross((0, 0, 1), along))
        up = cross(along, side)
        for j in range(around):
            c, s = math.cos(2 * math.pi * j / around), math.sin(2 * math.pi * j / around)
            points.append(tuple(m + radius * (c * a + s * b) for m, a, b in zip(middle, side, up)))
    points.append(tuple(curve(1)))
    last = len(points) - 1
    at = lambda i, j: 1 + i * around + j % around
    for j in range(around):
        faces += [[0, at(0, j + 1), at(0, j)], [last, at(steps, j), at(steps, j + 1)]]
        for i in range(steps):
            faces += [[at(i, j), at(i, j + 1), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i + 1, j)]]
    return points, faces


def helix(radius, pitch, turns):
    return lambda t: (radius * math.cos(2 * math.pi * turns * t), radius * math.sin(2 * math.pi * turns * t),
                      pitch * turns * t)


def numbers(seed):
    """In 0 .. 1, of Knuth's MMIX generator."""
    while True:
        seed = (6364136223846793005 * seed + 1442695040888963407) % 2**64
        yield (seed >> 33) / 2**31


# ---------------------------------------------------------------- files

unit_box = lambda x, y, z, parts=1: box((x, y, z), (x + 1, y + 1, z + 1), parts)


def field(folder):
    """Bodies that touch, share faces, cross themselves; the first four with volumes that tests know."""
    put = lambda name, mesh: write(folder, f"field/{name}.off", off(mesh))
    star = [(r * math.cos(math.pi * i / 7), r * math.sin(math.pi * i / 7)) for i in range(14) for r in [(2, 0.7)[i % 2]]]
    put("concave_L", prism([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)], 1))  # volume 5
    put("concave_star", prism(star, 1))  # 7 points: volume 14 / 2 * 2 * 0.7 * sin(pi / 7) = 4.25206
    put("insideout_box", reversed_faces(unit_box(0, 0, 0)))
    tiny = unit_box(0, 0, 0)
    write(folder, "field/tinycoord.off", off(tiny).replace("\n0 0 0\n", "\n1e-33 0 0\n", 1))
    put("boxes_face", together(unit_box(0, 0, 0), unit_box(1, 0, 0)))
    put("boxes_edge", together(unit_box(0, 0, 0), unit_box(1, 1, 0)))
    put("boxes3", together(unit_box(0, 0, 0), unit_box(1, 0, 0), unit_box(0, 1, 0)))
    put("boxes_cross", together(box((-1, -1, -1), (1, 1, 1)), box((-2, -0.5, -0.5), (2, 0.5, 0.5))))
    put("cubestair", together(*[unit_box(k, k, 0) for k in range(5)]))
    put("shift2", together(unit_box(0, 0, 0, 4), unit_box(0.25, 0.25, 0, 4)))
    put("overlap2", together(unit_box(0, 0, 0, 4), unit_box(0.5, 0.5, 0, 4)))
    put("swept8", together(*[unit_box(0.25 * k, 0, 0) for k in range(8)]))
    put("swept8_sub3", together(*[unit_box(0.25 * k, 0, 0, 3) for k in range(8)]))
    put("spring8", tube(helix(1, 0.3, 2.2), 0.2, 8, 30))  # turns are nearer than they are thick
    put("spring12", tube(helix(1, 0.35, 2.1), 0.22, 12, 36))
    put("spring20", tube(helix(1.2, 0.3, 1.4), 0.25, 16, 28))
    put("wire12", tube(helix(1, 0.15, 1.3), 0.12, 10, 40))
    put("thread32", tube(helix(0.5, 0.4, 3), 0.25, 10, 48))
    star5 = [(math.cos(4 * math.pi * i / 5), math.sin(4 * math.pi * i / 5)) for i in range(5)]
    fans = ([(*p, 0) for p in star5] + [(0, 0, 0)] + [(*p, 1) for p in star5] + [(0, 0, 1)],
            [f for i in range(5) for k in [(i + 1) % 5]
             for f in ([i, k, 6 + k], [i, 6 + k, 6 + i], [5, k, i], [11, 6 + i, 6 + k])])
    put("pentagram24", fans)
    ring = [(r * c, r * s, z) for c, s in ((1, 1), (-1, 1), (-1, -1), (1, -1)) for r, z in ((1, 0), (2, 0), (2, 1), (1, 1))]
    put("frame", (ring, [f[::-1] for i in range(4) for j in range(4)
                         for a, b, c, d in [(4 * i + j, 4 * i + (j + 1) % 4, (4 * i + 4) % 16 + (j + 1) % 4, (4 * i + 4) % 16 + j)]
                         for f in ([a, b, c], [a, c, d])]))
    random = numbers(3)
    put("knight_push003", mapped(globe(1, 12, 20), lambda p: [x + 0.06 * (next(random) - 0.5) for x in p]))
    write(folder, "field/offset1.obj", obj(together(unit_box(0, 0, 0, 3), moved(turned_about_z(unit_box(0, 0, 0, 3), 0.7), (0.6, 0.1, 0.3)))))


def inputs(folder):
    """Meshes as people have them, one fault each."""
    put = lambda name, mesh: write(folder, f"inputs/{name}.off", off(mesh))
    two = box((0, 0, 0), (2, 2, 2))
    points, faces = two
    put("inverted_part_apart", together(two, reversed_faces(unit_box(4, 0, 0))))  # volumes 8 and 1
    half_in = box((1, 1, 1), (2.5, 2.5, 2.5))
    put("inverted_part_overlap", together(two, reversed_faces(half_in)))  # 8 + 3.375 - 1
    soup = [points[v] for face in faces for v in face], [[3 * f, 3 * f + 1, 3 * f + 2] for f in range(len(faces))]
    put("soup_box", soup)
    write(folder, "inputs/soup_box.stl", ascii_stl(two))
    put("isolated_vertex", (points + [(9, 9, 9)], faces))
    put("repeated_corner", (points, faces + [[0, 1, 1]]))
    touching = together(unit_box(0, 0, 0), unit_box(1, 1, 0))
    write(folder, "inputs/touching_edge.stl", ascii_stl(touching))
    put("two_turned_facets", (points, [face[::-1] if f in (0, 6) else face for f, face in enumerate(faces)]))
    # The quads share the corners 0 and 2.
    quads = [(-1, 0, 0), (0, -1, 0.5), (1, 0, 0), (0, 1, 0.5), (0, -1, -0.5), (0, 1, -0.5)]
    put("quads_same_diagonal", (quads, [[0, 1, 2, 3], [0, 5, 2, 4], [0, 4, 1], [1, 4, 2], [2, 5, 3], [3, 5, 0]]))
    at = next(f for f, face in enumerate(faces) if 7 in face)
    put("near_vertex", (points + [(2, 2, 2.0000001)],
                        [[8 if v == 7 else v for v in face] if f == at else face for f, face in enumerate(faces)]))
    put("pinhole", (points, faces[1:]))


def meshes(folder):
    """Larger bodies that meet themselves."""
    bent = tube(helix(1, 0.2, 1.12), 0.35, 14, 36)
    write(folder, "meshes/cow.off", off(bent))
    spike = mapped(globe(1, 18, 24), lambda p: (p[0], p[1], p[2] - 2.6 * max(0, p[2] - 0.8) / 0.2))
    write(folder, "meshes/self_intersectA.obj", obj(spike))
    write(folder, "meshes/two_spheres.stl", ascii_stl(together(globe(1, 16, 24), moved(globe(1, 16, 24), (1.7, 0.2, 0.1)))))
    # Far from the origin, where coordinates are coarse: the second box moves into the first.
    far = (1e12, -1e12, 1e12)
    first, second = box((0, 0, 0), (1, 1, 1), 4), box((1.2, 0.1, 0.1), (2.2, 1.1, 1.1), 4)
    write(folder, "repro/far_before.off", off(moved(together(first, second), far)))
    write(folder, "repro/far_moved.off", off(moved(together(first, moved(second, (-0.5, 0.03125, 0))), far)))


def volumes(folder):
    """value(i, j, k) of a voxel."""
    def voxels(size, form, value):
        return b"".join(struct.pack(form, value(i, j, k))
                        for k in range(size[2]) for j in range(size[1]) for i in range(size[0]))

    def nifti(size, kind, bits, data):
        header = struct.pack("<i", 348) + bytes(36) + struct.pack("<8h", 3, *size, 1, 1, 1, 1) + bytes(14)
        header += struct.pack("<hhh", kind, bits, 0) + struct.pack("<8f", 1, 1, 1, 1, 1, 1, 1, 1)
        header += struct.pack("<f", 352) + bytes(348 - 112 - 4) + b"n+1\0" + bytes(4)
        return gzip.compress(header + data, mtime=0)

    write(folder, "volumes/tooth.nhdr", "NRRD0001\ntype: unsigned short\ndimension: 3\nsizes: 13 11 9\nspacings: 1 1 1\n"
          "data file: ./tooth.raw\nendian: big\nencoding: raw\n")
    write(folder, "volumes/tooth.raw", voxels((13, 11, 9), ">H", lambda i, j, k: 256 * k + 16 * j + i))
    write(folder, "volumes/engine.nii.gz",
          nifti((12, 10, 8), 2, 8, voxels((12, 10, 8), "<B", lambda i, j, k: (3 * i + 7 * j + 11 * k) % 256)))
    write(folder, "volumes/avf_float_32.nii.gz",
          nifti((6, 5, 4), 16, 32, voxels((6, 5, 4), "<f", lambda i, j, k: i + j / 4 + 100 * k)))


def main(folder):
    for part in (field, inputs, meshes, volumes):
        part(folder)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
