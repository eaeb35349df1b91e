# SPDX-License-Identifier: MIT
"""Inputs for the tests of --html and --png, made here, and readers of the outputs. Standard library only."""
import base64
import json
import math
import re
import struct
import subprocess
import zlib

SIZES, STEPS = (40, 36, 20), (1.0, 1.0, 2.0)
# In millimetres from the corner of the volume: left, back and up. To the patient's left, in front, and above the middle.
CENTRE, RADIUS, VOID, VOID_RADIUS = (25.0, 13.0, 25.0), 10.0, (25.0, 14.0, 24.0), 4.0


def depth(at):
    """How far inside the object: a ball with a hollow. Millimetres."""
    return min(RADIUS - math.dist(at, CENTRE), math.dist(at, VOID) - VOID_RADIUS)


def write_volume(path, space):
    """Grey value 100 at the surface, 30 more for each millimetre inside. The same body in either space."""
    lps = space == "lps"
    name, sign = ("left-posterior-superior", 1) if lps else ("right-anterior-superior", -1)
    values = bytearray()
    for k in range(SIZES[2]):
        for j in range(SIZES[1]):
            for i in range(SIZES[0]):
                at = (i * STEPS[0], j * STEPS[1], k * STEPS[2])
                values += struct.pack("<f", max(0, min(200, 100 + 30 * depth(at))))
    with open(path, "wb") as file:
        file.write((f"NRRD0004\ntype: float\ndimension: 3\nsizes: {SIZES[0]} {SIZES[1]} {SIZES[2]}\nspace: {name}\n"
                    f"space directions: ({sign},0,0) (0,{sign},0) (0,0,2)\nspace origin: (0,0,0)\n"
                    "endian: little\nencoding: raw\n\n").encode())
        file.write(values)


def write_two_balls(path):
    """Two balls of 512 triangles each, that cross."""
    points, faces = [], []
    for shift in (0, 1.1):
        first, start = len(points), [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
        ball = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
        for _ in range(3):
            middle, finer = {}, []
            for face in ball:
                cut = []
                for i in range(3):
                    edge = tuple(sorted((face[i], face[(i + 1) % 3])))
                    if edge not in middle:
                        middle[edge] = len(start)
                        sums = [a + b for a, b in zip(start[edge[0]], start[edge[1]])]
                        start.append(tuple(x / math.hypot(*sums) for x in sums))
                    cut.append(middle[edge])
                finer += [(face[0], cut[0], cut[2]), (face[1], cut[1], cut[0]), (face[2], cut[2], cut[1]), tuple(cut)]
            ball = finer
        points += [(x + shift, y + shift / 8, z) for x, y, z in start]
        faces += [tuple(first + v for v in face) for face in ball]
    with open(path, "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(points)} {len(faces)} 0\n")
        file.writelines("%.17g %.17g %.17g\n" % p for p in points)
        file.writelines("3 %d %d %d\n" % f for f in faces)


def call(tool, *words, code=0):
    done = subprocess.run([tool, *words], capture_output=True, text=True, check=False)
    if done.returncode != code:
        raise AssertionError(f"{words}: exit {done.returncode}\n{done.stdout}{done.stderr}")
    return done


def segment(tool, volume, *words, code=0):
    return call(tool, "segment", volume, "--seed", "25,7,12", "--threshold", "100", "--bright", "--radius", "2", *words,
                code=code)


def read_png(path):
    """Width, height, rows of r g b bytes. For 8 bits a channel, not interlaced, rows without a filter."""
    with open(path, "rb") as file:
        data = file.read()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError("not a png")
    at, packed, header, kinds = 8, b"", None, []
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if zlib.crc32(kind + body) != struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0]:
            raise ValueError("a chunk's checksum is wrong")
        kinds.append(kind)
        header = struct.unpack(">IIBBBBB", body) if kind == b"IHDR" else header
        packed += body if kind == b"IDAT" else b""
        at += 12 + size
    width, height = header[:2]
    if header[2:] != (8, 2, 0, 0, 0) or kinds[-1] != b"IEND":
        raise ValueError("not a plain png")
    raw, stride = zlib.decompress(packed), 3 * width + 1
    if len(raw) != height * stride or any(raw[y * stride] for y in range(height)):
        raise ValueError("rows of another length, or filtered")
    return width, height, [raw[y * stride + 1:(y + 1) * stride] for y in range(height)]


class PageFile:
    """What a page of --html carries, unpacked as packing.h says."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            self.text = file.read()
        self.data = json.loads(re.search(r'id="data">(.*?)</script>', self.text, re.S).group(1))

    def blob(self, number):
        packed = re.search(f'id="blob{number}">([^<]*)</script>', self.text).group(1)
        return zlib.decompress(base64.b64decode(packed))

    def mesh(self, frame):
        """Points, triangles, marks."""
        raw, n = self.blob(frame["blob"]), frame["vertices"]
        axes = []
        for axis in range(3):
            low, high = frame["box"][axis], frame["box"][axis + 3]
            step, places = 0, []
            for v in range(n):
                zigzag = raw[2 * axis * n + v] | raw[(2 * axis + 1) * n + v] << 8
                step = (step + (zigzag >> 1 ^ -(zigzag & 1))) & 65535
                places.append(low + step * (high - low) / 65535)
            axes.append(places)
        at, least, triangles = 6 * n, 0, []
        for _ in range(frame["triangles"]):
            numbers = []
            for _ in range(3):
                value = shift = 0
                while True:
                    byte = raw[at]
                    at += 1
                    value |= (byte & 127) << shift
                    shift += 7
                    if byte < 128:
                        break
                numbers.append(value)
            least += numbers[0]
            triangles.append((least, least + numbers[1], least + numbers[2]))
        return list(zip(*axes)), triangles, raw[at:]


def volume_of(points, triangles):
    total = 0
    for a, b, c in ((points[i], points[j], points[k]) for i, j, k in triangles):
        total += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    return total / 6


def read_ply(path):
    """Points and triangles of a .ply as the tool writes it."""
    with open(path, "rb") as file:
        data = file.read()
    head, body = data.split(b"end_header\n", 1)
    n, m = (int(re.search(rb"element %s (\d+)" % kind, head).group(1)) for kind in (b"vertex", b"face"))
    points = list(struct.iter_unpack("<3d", body[:24 * n]))
    return points, [t[1:] for t in struct.iter_unpack("<B3i", body[24 * n:24 * n + 13 * m])]
