#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of docs/handles.md as docs/pictures/handle-*.svg.

    cmake --workflow --preset test
    python3 docs/pictures/handle_pictures.py build/test/topoadapt docs/pictures

Handles and contacts come from the tool. Needs nothing but Python 3.
"""
import math
import os
import sys

sys.dont_write_bytecode = True  # leave no folder behind in docs/pictures

from picture_contact import draw_contact
from picture_parts import (GREY, INK, INNER, LINE, PAPER, RED, TINT, Svg, as_set, draw_flat, flat, handles_of, middle,
                           polygons_of)

# ---------------------------------------------------------------- the handle of the paper, flat

PAPER_FIRST = "1,2,11 1,5,12 1,11,12 2,3,8 2,8,10 2,10,11 3,4,7 3,7,8 4,5,6 4,6,7 5,6,9 5,9,12 8,9,10 9,10,12"
PAPER_TURNED = "5,1,11 5,4,12 5,11,12 1,2,8 1,8,10 1,10,11 2,3,7 2,7,8 3,4,6 3,6,7 4,6,9 4,9,12 8,9,10 9,10,12"


def rotated(place, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return {v: (c * x - s * y, s * x + c * y) for v, (x, y) in place.items()}


def parsed(text):
    return [tuple(map(int, face.split(","))) for face in text.split()]


def draw_paper(tool, path):
    polygons = polygons_of(5, 4, 3)
    stored = {as_set(h): h for h in handles_of(tool, 5, 4, 3)}
    first, second = (stored[as_set(parsed(text))] for text in (PAPER_FIRST, PAPER_TURNED))
    svg = Svg(780, 470)
    place = flat(first, polygons, 0, (0, 0), 180)
    # The same drawing with the numbers of A moved on, turned so that 1 is on top again.
    after = {v: polygons[0][i - 1] for i, v in enumerate(polygons[0])}
    turned_place = {after.get(v, v): at for v, at in rotated(place, 72).items()}
    assert as_set([tuple(after.get(v, v) for v in face) for face in first]) == as_set(second)
    titles = ("a handle that the paper prints", "the same with the polygon A turned by one")
    for i, (faces, at) in enumerate(((first, place), (second, turned_place))):
        centre = (200 + 380 * i, 222)
        at = {v: (x + centre[0], y + centre[1]) for v, (x, y) in at.items()}
        draw_flat(svg, faces, polygons, at)
        for number, name in ((1, "B"), (2, "C")):
            svg.text(middle([at[v] for v in polygons[number]]), name, 17, LINE[name], bold=True)
        svg.text((centre[0] - 150, 60), "A", 17, LINE["A"], bold=True)
        svg.text((centre[0], 408), titles[i], 13)
    x = 105
    legend = ((TINT["A"], "takes an edge of A"), (TINT["B"], "of B"), (TINT["C"], "of C"), (INNER, "inner triangle"))
    for fill, what in legend:
        svg.polygon([(x, 434), (x + 26, 434), (x + 26, 452), (x, 452)], fill, "#6b6b68", 1)
        svg.text((x + 34, 443), what, 12.5, anchor="start")
        x += 60 + 8.0 * len(what)
    svg.write(path, "A handle for polygons of 5, 4 and 3 sides, and the same with one polygon turned")


# ---------------------------------------------------------------- generator and images

def turned(faces, polygon):
    """Each vertex of the polygon takes the number of the next one."""
    after = {v: polygon[(i + 1) % len(polygon)] for i, v in enumerate(polygon)}
    return [tuple(after.get(v, v) for v in face) for face in faces], after


def exchanged(faces, one, other):
    after = dict(zip(one + other, other + one))
    return [tuple(after.get(v, v) for v in face) for face in faces], after


def draw_images(tool, path):
    polygons = polygons_of(4, 3, 3)
    handles = handles_of(tool, 4, 3, 3)
    known = {as_set(h) for h in handles}
    generator = handles[0]
    svg = Svg(860, 330)
    cases = [("a generator", generator, {}, ()), ("its image: A turned by one", *turned(generator, polygons[0]), (0,)),
             ("its image: B and C exchanged", *exchanged(generator, polygons[1], polygons[2]), (1, 2))]
    for i, (title, image, after, mark) in enumerate(cases):
        assert as_set(image) in known, title
        place = flat(generator, polygons, 0, (148 + 282 * i, 145), 160, turn=135)
        place = {after.get(v, v): at for v, at in place.items()}
        draw_flat(svg, image, polygons, place, mark=mark)
        svg.text((148 + 282 * i, 300), title, 13)
    svg.write(path, "A generator for polygons of 4, 3 and 3 sides and two of its images")


# ---------------------------------------------------------------- even and uneven

def strip_faces(word, xs, ys):
    """Faces of a closed strip: an x-step takes an edge of xs forwards, a y-step one of ys backwards."""
    i = j = 0
    faces = []
    for step in word:
        x, y = xs[i % len(xs)], ys[-j % len(ys)]
        if step == "x":
            i += 1
            faces.append((x, xs[i % len(xs)], y))
        else:
            j += 1
            faces.append((ys[-j % len(ys)], y, x))
    return faces


def draw_even(tool, path):
    polygons = polygons_of(5, 4)
    even = handles_of(tool, 5, 4)[0]
    uneven = strip_faces("xxxyyxxyy", *polygons)
    svg = Svg(820, 400)
    for i, (faces, title) in enumerate(((even, "even"), (uneven, "uneven"))):
        degree = {v: sum(v in face for face in faces) for polygon in polygons for v in polygon}
        centre = (205 + 410 * i, 180)
        place = flat(faces, polygons, 0, centre, 155, hole_weight=0.25)
        draw_flat(svg, faces, polygons, place, lambda v: str(degree[v]))
        svg.text((centre[0], 350), title + ": sum of d = %d" % sum(degree.values()), 13.5)
        svg.text((centre[0], 374), "sum of d² = " + " + ".join("%d²" % d for d in degree.values())
                 + " = %d" % sum(d * d for d in degree.values()), 12)
    svg.write(path, "An even and an uneven handle for polygons of 5 and 4 sides")


# ---------------------------------------------------------------- a strip, its word, its path

def word_of(faces, polygons):
    """The word of a closed strip, read from the face that takes the first edge of x."""
    xs, ys = polygons
    edge_face = {}
    for face in faces:
        for c in range(3):
            edge_face[face[c], face[(c + 1) % 3]] = face
    x, y, word = xs[0], None, ""
    y = next(v for v in edge_face[xs[0], xs[1]] if v in ys)
    start = y
    while len(word) < len(faces):
        face = edge_face[y, x]  # the next face along the strip
        if len([v for v in face if v in xs]) == 2:
            x = next(v for v in face if v in xs and v != x)
            word += "x"
        else:
            y = next(v for v in face if v in ys and v != y)
            word += "y"
    return word, start


def draw_grid(svg, p, q, corner, step):
    at = lambda i, j: (corner[0] + step * i, corner[1] - step * j)
    for i in range(p + 1):
        svg.line(at(i, 0), at(i, q), "#d8d6cf", 1)
    for j in range(q + 1):
        svg.line(at(0, j), at(p, j), "#d8d6cf", 1)
    svg.text((at(p / 2, 0)[0], corner[1] + 34), "edges of x used", 12, LINE["A"])
    left = (corner[0] - 30, at(0, q / 2)[1])
    svg.add('<g transform="rotate(-90 %.1f %.1f)">' % left)
    svg.text(left, "edges of y used", 12, LINE["B"])
    svg.add("</g>")
    return at


def draw_path(svg, at, word, width):
    """The path of a word through a grid."""
    i = j = 0
    for step in word:
        ni, nj = (i + 1, j) if step == "x" else (i, j + 1)
        svg.line(at(i, j), at(ni, nj), LINE["A" if step == "x" else "B"], width)
        i, j = ni, nj


def draw_strip(tool, path):
    polygons = polygons_of(5, 4)
    faces = handles_of(tool, 5, 4)[0]
    word, start = word_of(faces, polygons)
    svg = Svg(760, 330)
    xs = [(60 + 64 * i, 190) for i in range(6)]
    ys = [(84 + 80 * j, 80) for j in range(5)]
    first = polygons[1].index(start)
    i = j = 0
    for step in word:
        color, old = TINT["A" if step == "x" else "B"], (xs[i], ys[j])
        i, j = (i + 1, j) if step == "x" else (i, j + 1)
        triangle = [*old, xs[i] if step == "x" else ys[j]]
        svg.polygon(triangle, color, "#6b6b68", 1)
        svg.text(middle(triangle), step, 13, LINE["A" if step == "x" else "B"], bold=True)
    for points, name in ((xs, "A"), (ys, "B")):
        for a, b in zip(points, points[1:]):
            svg.line(a, b, LINE[name], 3)
    for end in (0, -1):  # the edge at which the strip was cut open
        svg.line(xs[end], ys[end], RED, 2, 'stroke-dasharray="5 4"')
    for k, p in enumerate(xs):
        svg.circle(p, 10.5, "white", LINE["A"], 1.6)
        svg.text(p, str(polygons[0][k % 5]), 11.5, LINE["A"])
    for k, p in enumerate(ys):
        svg.circle(p, 10.5, "white", LINE["B"], 1.6)
        svg.text(p, str(polygons[1][(first - k) % 4]), 11.5, LINE["B"])
    svg.text((220, 222), "polygon x", 12.5, LINE["A"])
    svg.text((244, 48), "polygon y", 12.5, LINE["B"])
    svg.text((220, 270), "word: " + " ".join(word), 14, bold=True)
    svg.text((220, 296), "the red edges are one and the same", 12, RED)
    at = draw_grid(svg, 5, 4, (470, 260), 46)
    draw_path(svg, at, word, 4)
    i = j = 0
    for step in "." + word:
        i, j = i + (step == "x"), j + (step == "y")
        ends = (i, j) in ((0, 0), (5, 4))
        svg.circle(at(i, j), 4.5, RED if ends else INK)
    svg.write(path, "A strip between polygons of 5 and 4 sides, its word and its path")


# ---------------------------------------------------------------- shortest path

OUTER = [(0, 132), (-118, 52), (-92, -92), (52, -120), (122, 24)]
INNER_LOOP = [(26, 50), (-42, 36), (-46, -28), (40, -34)]


def best_path(table):
    """Least sums over the lattice, and the steps of the path; the last edge is the first and counts once."""
    p, q = len(table) - 1, len(table[0]) - 1
    best = [[0.0] * (q + 1) for _ in range(p + 1)]
    came = {}
    for i in range(p + 1):
        for j in range(q + 1):
            ways = [(best[i - 1][j], "x")] * (i > 0) + [(best[i][j - 1], "y")] * (j > 0)
            least, step = min(ways, default=(0.0, ""))
            best[i][j] = least + (table[i][j] if (i, j) != (p, q) else 0.0)
            came[i, j] = step
    word, i, j = "", p, q
    while came[i, j]:
        word = came[i, j] + word
        i, j = i - (came[i, j] == "x"), j - (came[i, j] == "y")
    return best, word


def draw_shortest(path):
    def table_from(start):
        return [[round(math.dist(OUTER[i % 5], INNER_LOOP[(start + j) % 4]) / 10) for j in range(5)] for i in range(6)]

    start = min(range(4), key=lambda s: best_path(table_from(s))[0][5][4])
    table = table_from(start)
    best, word = best_path(table)
    svg = Svg(800, 400)
    centre = (160, 195)
    xs = [(centre[0] + x, centre[1] - y) for x, y in OUTER]
    ys = [(centre[0] + x, centre[1] - y) for x, y in INNER_LOOP]
    ys = ys[start:] + ys[:start]
    i = j = 0
    for step in word:
        ni, nj = (i + 1, j) if step == "x" else (i, j + 1)
        third = xs[ni % 5] if step == "x" else ys[nj % 4]
        svg.polygon([xs[i % 5], ys[j % 4], third], TINT["A" if step == "x" else "B"], "#6b6b68", 1)
        i, j = ni, nj
    svg.polygon(xs, "none", LINE["A"], 3)
    svg.polygon(ys, "none", LINE["B"], 3)
    svg.line(xs[0], ys[0], RED, 2.4, 'stroke-dasharray="5 4"')
    for points, name in ((xs, "A"), (ys, "B")):
        for k, p in enumerate(points):
            svg.circle(p, 10.5, "white", LINE[name], 1.6)
            svg.text(p, ("x" if name == "A" else "y") + str(k), 10.5, LINE[name])
    svg.text((160, 372), "word: " + " ".join(word), 14, bold=True)
    at = draw_grid(svg, 5, 4, (400, 318), 66)
    draw_path(svg, at, word, 6)
    for i in range(6):
        for j in range(5):
            ends = (i, j) in ((0, 0), (5, 4))
            svg.circle(at(i, j), 17, "white", RED if ends else GREY, 2 if ends else 1)
            svg.text((at(i, j)[0], at(i, j)[1] - 6), "%g" % table[i][j], 11, INK)
            svg.text((at(i, j)[0], at(i, j)[1] + 7), "%g" % best[i][j], 9.5, RED, bold=True)
    svg.text((548, 384), "length of the edge from x to y", 11.5, anchor="end")
    svg.text((568, 384), "least total up to here", 11.5, RED, anchor="start", bold=True)
    svg.write(path, "The shortest strip as a shortest path through a lattice")


# ---------------------------------------------------------------- plans

def draw_band(svg, curve, ends):
    """A strip as a broad line, in the colours of its two polygons."""
    svg.path(curve, "#6b6b68", 13)
    svg.path(curve, "#ffffff", 11)
    svg.path(curve, LINE[ends[0]], 3, more='stroke-dasharray="2 9"')
    svg.path(curve, LINE[ends[1]], 3, more='stroke-dasharray="2 9" stroke-dashoffset="5.5"')


def draw_disc(svg, p, name, radius=18):
    svg.circle(p, radius, TINT[name], LINE[name], 3)
    svg.text(p, name, 16, LINE[name], bold=True)


def draw_plan_panel(svg, x, title, note, spots, straight, curved, triangles):
    """Discs at `spots`, strips, numbered inner triangles; the last one is all that lies outside."""
    svg.add('<rect x="%d" y="14" width="200" height="226" rx="14" fill="%s" stroke="#d8d6cf"/>'
            % (x, "#fbeeb6"))
    place = {name: (x + 100 + dx, 127 + dy) for name, (dx, dy) in spots.items()}
    for corners in triangles:
        svg.polygon([place[c] if isinstance(c, str) else (x + 100 + c[0], 127 + c[1]) for c in corners], INNER)
    for pair, curve in curved:
        draw_band(svg, curve(x + 100, 127), pair)
    for a, b in straight:
        draw_band(svg, "M%.1f %.1f L%.1f %.1f" % (*place[a], *place[b]), a + b)
    for name, p in place.items():
        draw_disc(svg, p, name)
    svg.text((x + 100, 262), title, 13.5, bold=True)
    for line, text in enumerate(note):
        svg.text((x + 100, 284 + 18 * line), text, 12)
    return place


def draw_plans(path):
    svg = Svg(870, 320)
    # Two: A outside, B inside, the strip goes round.
    svg.add('<rect x="14" y="14" width="200" height="226" rx="14" fill="#ffffff" stroke="#d8d6cf"/>')
    svg.circle((114, 127), 82, TINT["A"], LINE["A"], 3)
    svg.circle((114, 127), 64, PAPER, "#6b6b68", 1)
    svg.circle((114, 127), 48, "#ffffff", "#6b6b68", 1)
    ring = "M114 71 A56 56 0 1 1 113.9 71 Z"
    draw_band(svg, ring, "AB")
    draw_disc(svg, (114, 127), "B", 46)
    svg.text((114, 54), "A", 16, LINE["A"], bold=True)
    svg.text((114, 262), "k = 2", 13.5, bold=True)
    svg.text((114, 284), "1 closed strip, no inner triangle", 12)
    # Three.
    three = {"A": (0, -66), "B": (-66, 52), "C": (66, 52)}
    p = draw_plan_panel(svg, 228, "k = 3", ["3 strips, 2 inner triangles"], three, ["AB", "BC", "AC"], [], ["ABC"])
    svg.text(middle(list(p.values())), "1", 14, bold=True)
    svg.text((248, 34), "2", 14, bold=True)
    # Four, each next to each.
    four = {"A": (0, -86), "B": (-76, 70), "C": (76, 70), "D": (0, 14)}
    p = draw_plan_panel(svg, 442, "k = 4, tetrahedron", ["6 strips, 4 inner triangles", "each polygon has 3 strips"],
                        four, ["AB", "BC", "AC", "AD", "BD", "CD"], [], ["ABC"])
    for number, names in (("1", "ABD"), ("2", "ADC"), ("3", "BCD")):
        svg.text(middle([p[n] for n in names]), number, 13, bold=True)
    svg.text((462, 34), "4", 14, bold=True)
    # Four in a row: A and B meet twice, on both sides of C.
    row = {"A": (-70, 14), "B": (70, 14), "C": (0, -34), "D": (0, 66)}
    arc = lambda cx, cy: "M%.1f %.1f C%.1f %.1f %.1f %.1f %.1f %.1f" % (cx - 70, cy + 14, cx - 62, cy - 118, cx + 62,
                                                                       cy - 118, cx + 70, cy + 14)
    around = ["A", (-60, -34), (-36, -78), (0, -88), (36, -78), (60, -34), "B", "D"]
    p = draw_plan_panel(svg, 656, "k = 4, in a row", ["6 strips, 4 inner triangles", "A, B have 4 strips, C, D two"],
                        row, ["AB", "AC", "BC", "AD", "BD"], [("AB", arc)], [around])
    svg.text((756, 127 - 66), "1", 13, bold=True)
    svg.text(middle([p[n] for n in "ABC"]), "2", 13, bold=True)
    svg.text(middle([p[n] for n in "ABD"]), "3", 13, bold=True)
    svg.text((676, 34), "4", 14, bold=True)
    svg.write(path, "Plans for two, three and four polygons")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    tool, folder = sys.argv[1:]
    at = lambda name: os.path.join(folder, "handle-%s.svg" % name)
    draw_contact(tool, at("contact"))
    draw_paper(tool, at("paper"))
    draw_strip(tool, at("strip"))
    draw_plans(at("plans"))
    draw_images(tool, at("images"))
    draw_even(tool, at("even"))
    draw_shortest(at("shortest"))


if __name__ == "__main__":
    main()
