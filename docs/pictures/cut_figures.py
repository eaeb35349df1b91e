#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the figures of docs/exact-cut.md.

    python3 docs/pictures/cut_figures.py docs/pictures

Points where lines cross are computed; the rest is drawn by hand.
"""
import math
import os
import sys

from picture_parts import GREY, INK, LINE, RED, TINT, Svg, middle

ONE, TWO = "#f8e3b4", "#f0b183"  # winding numbers 1 and 2


def crossing(p, q, r, s):
    """Where the line through p and q crosses the line through r and s."""
    d, e, f = (q[0] - p[0], q[1] - p[1]), (s[0] - r[0], s[1] - r[1]), (r[0] - p[0], r[1] - p[1])
    t = (f[0] * e[1] - f[1] * e[0]) / (d[0] * e[1] - d[1] * e[0])
    return (p[0] + t * d[0], p[1] + t * d[1])


def moved(points, by):
    return [(x + by[0], y + by[1]) for x, y in points]


def square(svg, p, color, size=5):
    svg.polygon(moved([(-size, -size), (size, -size), (size, size), (-size, size)], p), "white", color, 2)


def diamond(svg, p, color, size=7):
    svg.polygon(moved([(0, -size), (size, 0), (0, size), (-size, 0)], p), "white", color, 2)


def number(svg, p, text, color=INK):
    svg.text(p, text, 17, color, bold=True)


# ---------------------------------------------------------------- the region

LEFT = [(30, 70), (190, 30), (250, 190), (60, 220)]
RIGHT = [(140, 110), (350, 60), (380, 230), (175, 250)]


def draw_region(path):
    svg = Svg(860, 330)
    a = crossing(LEFT[1], LEFT[2], RIGHT[0], RIGHT[1])
    b = crossing(LEFT[2], LEFT[3], RIGHT[3], RIGHT[0])
    both = [RIGHT[0], a, LEFT[2], b]
    at = lambda points, x: moved(points, (x, 20))
    for polygon in (LEFT, RIGHT):
        svg.polygon(at(polygon, 10), ONE)
    svg.polygon(at(both, 10), TWO)
    svg.polygon(at(LEFT, 10), "none", LINE["A"], 3)
    svg.polygon(at(RIGHT, 10), "none", LINE["C"], 3)
    for p in at([a, b], 10):
        svg.circle(p, 5, "white", RED, 2)
    for p, text in (((95, 130), "1"), ((300, 150), "1"), (middle(both), "2"), ((290, 30), "0")):
        number(svg, at([p], 10)[0], text)
    outline = [LEFT[0], LEFT[1], a, RIGHT[1], RIGHT[2], RIGHT[3], b, LEFT[3]]
    svg.polygon(at(outline, 450), ONE, INK, 3)
    for p, q in ((a, LEFT[2]), (LEFT[2], b), (b, RIGHT[0]), (RIGHT[0], a)):
        (x, y), (u, v) = at([p, q], 450)
        svg.line((x, y), (u, v), GREY, 1.6, 'stroke-dasharray="5 5"')
    for p in at([a, b], 450):
        svg.circle(p, 5, "white", RED, 2)
    svg.text((215, 305), "winding numbers; the seam passes through the red points", 13)
    svg.text((655, 305), "pieces between 0 and 1 stay (black), others go (dashed)", 13)
    svg.write(path, "Two overlapping bodies in section, their winding numbers and the pieces that stay")


# ---------------------------------------------------------------- a face

FACE = [(30, 250), (330, 265), (150, 25)]


def traces():
    """One trace runs from side to side. Two others meet inside the face, where an edge between their faces passes."""
    green = (crossing((40, 120), (330, 210), FACE[0], FACE[2]), crossing((40, 120), (330, 210), FACE[1], FACE[2]))
    top = (163, 118)
    orange = (crossing((190, 265), (150, 60), FACE[0], FACE[1]), top, crossing(top, (260, 112), FACE[1], FACE[2]))
    return green, orange, crossing(*green, *orange[:2])


def draw_face(path):
    svg = Svg(1090, 350)
    (p, q), (r, s, t), x = traces()
    a, b, c = FACE
    divided = {0: [(c, p, s), (p, x, s), (c, s, t)], 1: [(s, x, q), (s, q, t), (p, a, x), (a, r, x)],
               2: [(x, r, b), (x, b, q)]}
    for panel in range(3):
        go = lambda point: (point[0] + 20 + 355 * panel, point[1] + 20)
        for winding, triangles in divided.items() if panel else ():
            for triangle in triangles:
                fill = "white" if panel == 1 else (TINT["A"], ONE, TWO)[winding]
                svg.polygon([go(v) for v in triangle], fill, "#9a9a96", 1)
        svg.polygon([go(v) for v in FACE], "white" if panel == 0 else "none", INK, 2)
        for at, winding in (((135, 100), "0"), ((195, 140), "1"), ((105, 215), "1"), ((245, 225), "2")):
            if panel == 2:
                number(svg, go(at), winding)
        for v, w, color in ((p, q, "C"), (r, s, "B"), (s, t, "B")):
            svg.line(go(v), go(w), LINE[color], 3)
        for v in FACE:
            svg.circle(go(v), 5, "white", INK, 2)
        for v in (p, q, r, s, t):
            square(svg, go(v), LINE["C"] if v in (p, q) else LINE["B"])
        if panel:
            diamond(svg, go(x), RED)
    svg.text((200, 312), "a face and its traces", 13)
    svg.text((555, 312), "triangulated; traces stay edges", 13)
    svg.text((910, 312), "winding numbers in front; blue stays", 13)
    y = 337
    svg.circle((120, y), 5, "white", INK, 2)
    svg.text((132, y), "vertex of the mesh", 12.5, anchor="start")
    square(svg, (330, y), LINE["C"])
    svg.text((344, y), "an edge crosses the plane of a face", 12.5, anchor="start")
    diamond(svg, (660, y), RED)
    svg.text((674, y), "three planes meet", 12.5, anchor="start")
    svg.write(path, "A face, the traces of two others, its triangulation and its pieces")


# ---------------------------------------------------------------- round an edge

def fan(svg, centre, angles, windings, kept):
    """Pieces seen along their common edge, and the winding numbers of the wedges between them."""
    at = lambda angle, r: (centre[0] + r * math.cos(math.radians(angle)), centre[1] - r * math.sin(math.radians(angle)))
    for i, winding in enumerate(windings):
        a, b = angles[i], angles[(i + 1) % len(angles)]
        b += 360 if b <= a else 0
        rim = [at(a + (b - a) * k / 24, 105) for k in range(25)]
        svg.polygon([centre] + rim, {0: "white", 1: ONE, 2: TWO}[winding], "#d8d6cf", 1)
        number(svg, at((a + b) / 2, 72), str(winding))
    for i, angle in enumerate(angles):
        more = "" if kept[i] else 'stroke-dasharray="5 5"'
        svg.line(centre, at(angle, 112), INK if kept[i] else GREY, 3.4 if kept[i] else 1.8, more)
    svg.circle(centre, 5, "white", RED, 2)
    return at


def arc(svg, centre, a, b, r):
    at = lambda angle: (centre[0] + r * math.cos(math.radians(angle)), centre[1] - r * math.sin(math.radians(angle)))
    (x, y), (u, v) = at(a), at(b)
    svg.path("M%.1f,%.1f A%g,%g 0 %d 0 %.1f,%.1f" % (x, y, r, r, b - a > 180, u, v), RED, 2)


def draw_edge(path):
    svg = Svg(860, 330)
    crossing_at, touching_at, parted_at = (140, 150), (425, 150), (710, 150)
    fan(svg, crossing_at, [20, 75, 200, 255], [1, 0, 1, 2], [False, True, True, False])
    arc(svg, crossing_at, 200, 435, 36)
    fan(svg, touching_at, [20, 110, 200, 290], [0, 1, 0, 1], [True, True, True, True])
    arc(svg, touching_at, 110, 200, 36)
    arc(svg, touching_at, 290, 380, 36)
    for turn, way in ((155, (-9, -4)), (335, (9, 4))):
        tip = (parted_at[0] + way[0], parted_at[1] + way[1])
        rays = [(tip[0] + 105 * math.cos(math.radians(turn + s)), tip[1] - 105 * math.sin(math.radians(turn + s)))
                for s in (-45, 0, 45)]
        svg.polygon([tip, rays[0], rays[1], rays[2]], ONE)
        svg.line(tip, rays[0], INK, 3.4)
        svg.line(tip, rays[2], INK, 3.4)
        svg.circle(tip, 5, "white", RED, 2)
        number(svg, middle([tip, rays[1]]), "1")
    titles = ("two faces cross: one pair", "bodies touch: two pairs", "the pairs part (magnified)")
    for x, text in zip((140, 425, 710), titles):
        svg.text((x, 290), text, 13)
    svg.text((430, 315), "An arc joins the two pieces that become neighbours across the region.", 12.5, GREY)
    svg.write(path, "Pieces round an edge, seen along the edge, and how those that stay are paired")


# ---------------------------------------------------------------- faces in one plane

def box(svg, x, y, width, height, color):
    svg.polygon([(x, y), (x + width, y), (x + width, y + height), (x, y + height)], ONE, color, 3)


def draw_flat(path):
    svg = Svg(860, 250)
    box(svg, 40, 50, 140, 120, LINE["A"])
    box(svg, 180, 50, 140, 120, LINE["C"])
    svg.line((180, 50), (180, 170), GREY, 4, 'stroke-dasharray="5 5"')
    svg.text((180, 30), "1 front, 1 behind: 0 layers", 13)
    svg.text((180, 205), "two boxes share a face: its pieces go", 13)
    box(svg, 470, 50, 200, 120, LINE["A"])
    box(svg, 600, 50, 200, 120, LINE["C"])
    svg.polygon([(600, 50), (670, 50), (670, 170), (600, 170)], TWO)
    for y in (50, 170):
        svg.line((600, y), (670, y), INK, 5)
    for x, color in ((600, LINE["C"]), (670, LINE["A"])):
        svg.line((x, 50), (x, 170), color, 3, 'stroke-dasharray="5 5"')
    for x, text in ((535, "1"), (635, "2"), (735, "1")):
        number(svg, (x, 110), text)
    svg.text((635, 30), "2 layers, from 0 to 2: one piece stays", 13)
    svg.text((635, 205), "two boxes overlap with sides in one plane", 13)
    svg.text((430, 232), "Boxes in section; numbers are winding numbers.", 12.5, GREY)
    svg.write(path, "Boxes with faces in one plane, and the layers of their common pieces")


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: cut_figures.py FOLDER")
    at = lambda name: os.path.join(sys.argv[1], "cut-%s.svg" % name)
    draw_region(at("region"))
    draw_face(at("face"))
    draw_edge(at("edge"))
    draw_flat(at("flat"))


if __name__ == "__main__":
    main()
