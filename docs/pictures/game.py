#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws docs/pictures/game.png: three blobs within 200,000 units a frame on the left, without a bound on the right.

    python3 docs/pictures/game.py build/game/game docs/pictures/game.png

Needs a game with SDL 2. Upper row: frame 1500. Lower row: frame 3847, the last of the 36 in a row in which both differ.
"""
import os
import struct
import subprocess
import sys
import tempfile
import zlib

FRAMES = (1500, 3847)
WIDTH, LEFT, RIGHT, TOP, BOTTOM = 960, 250, 782, 100, 480  # of a game's picture, and the part that is shown


def rows_of(bmp):
    """Rows of (red, green, blue), from the top."""
    offset, = struct.unpack_from("<I", bmp, 10)
    width, height, _, bits = struct.unpack_from("<iiHH", bmp, 18)
    size = bits // 8
    stride = (width * size + 3) // 4 * 4
    rows = []
    for y in range(height):
        row = bmp[offset + y * stride:offset + y * stride + width * size]
        rows.append(list(zip(row[2::size], row[1::size], row[0::size])))
    return rows[::-1]


def shrunk(rows):
    """Half as wide and high: means of four points."""
    return [[tuple(sum(p) // 4 for p in zip(a[x], a[x + 1], b[x], b[x + 1])) for x in range(0, len(a) - 1, 2)]
            for a, b in zip(rows[::2], rows[1::2])]


def picture(game, frame, folder):
    path = os.path.join(folder, "frame.bmp")
    subprocess.run([game, "--frames", str(frame), "--blobs", "3", "--edge", "0.08", "--twin", "--picture", path],
                   env={**os.environ, "SDL_VIDEODRIVER": "dummy"}, stdout=subprocess.DEVNULL, check=False)
    with open(path, "rb") as file:
        rows = rows_of(file.read())[TOP:BOTTOM]
    return shrunk([row[LEFT:RIGHT] + row[WIDTH + LEFT:WIDTH + RIGHT] for row in rows])


def write_png(path, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    raw = b"".join(b"\0" + bytes(value for point in row for value in point) for row in rows)
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw, 9)) +
                   chunk(b"IEND", b""))


def main():
    game, path = sys.argv[1:]
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for frame in FRAMES:
            rows += picture(game, frame, folder)
    write_png(path, rows)


if __name__ == "__main__":
    main()
