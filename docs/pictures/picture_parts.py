# SPDX-License-Identifier: MIT
"""Parts of the pictures of handle_pictures.py: an SVG writer, handles from the tool, and drawings of
handles in the plane."""
import itertools
import math
import subprocess

PAPER = "#fbfaf6"
INK = "#2b2b2b"
GREY = "#8a8a86"
LINE = {"A": "#2f66a8", "B": "#c8701c", "C": "#2f8a55", "D": "#7d50a5"}
TINT = {"A": "#d3e1f2", "B": "#f8dfc3", "C": "#d2ecdb", "D": "#e5d8f0"}
INNER = "#f5d660"  # inner triangles
RED = "#c63d33"


class Svg:
    def __init__(self, width, height):
        self.size = (width, height)
        self.items = []

    def add(self, text):
        self.items.append(text)

    def line(self, p, q, color=INK, width=1.2, more=""):
        self.add('<line x1="%.1f" y1="%.1f" x2="%.1f" y2="%.1f" stroke="%s" stroke-width="%g" '
                 'stroke-linecap="round" %s/>' % (*p, *q, color, width, more))

    def polygon(self, points, fill="none", color="none", width=1.0, more=""):
        at = " ".join("%.1f,%.1f" % tuple(p[:2]) for p in points)
        self.add('<polygon points="%s" fill="%s" stroke="%s" stroke-width="%g" stroke-linejoin="round" %s/>'
                 % (at, fill, color, width, more))

    def path(self, d, color=INK, width=1.2, fill="none", more=""):
        self.add('<path d="%s" fill="%s" stroke="%s" stroke-width="%g" stroke-linejoin="round" '
                 'stroke-linecap="round" %s/>' % (d, fill, color, width, more))

    def circle(self, p, radius, fill, color="none", width=1.0):
        self.add('<circle cx="%.1f" cy="%.1f" r="%g" fill="%s" stroke="%s" stroke-width="%g"/>'
                 % (*p, radius, fill, color, width))

    def text(self, p, text, size=13, color=INK, anchor="middle", bold=False):
        text = text.replace("&", "&amp;").replace("<", "&lt;")
        self.add('<text x="%.1f" y="%.1f" font-size="%g" fill="%s" text-anchor="%s"%s>%s</text>'
                 % (p[0], p[1] + 0.36 * size, size, color, anchor, ' font-weight="bold"' if bold else "", text))

    def write(self, path, title):
        w, h = self.size
        with open(path, "w", encoding="utf-8") as file:
            file.write('<svg xmlns="http://www.w3.org/2000/svg" width="%d" height="%d" viewBox="0 0 %d %d" '
                       'font-family="DejaVu Sans, Verdana, Helvetica, Arial, sans-serif">\n<title>%s</title>\n'
                       '<rect width="%d" height="%d" fill="%s"/>\n' % (w, h, w, h, title, w, h, PAPER))
            file.write("\n".join(self.items) + "\n</svg>\n")


# ---------------------------------------------------------------- handles

def run(tool, *arguments):
    done = subprocess.run([tool, *arguments], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):  # 1: the answer is no
        raise RuntimeError(done.stderr)
    return done.stdout


def handles_of(tool, *sides):
    """All handles of the database, each a list of faces, vertices numbered from 1."""
    text = run(tool, "handles", *map(str, sides), "--list")
    return [[tuple(map(int, face[1:-1].split(","))) for face in line.split()]
            for line in text.splitlines() if line.startswith("(")]


def polygons_of(*sides):
    """Vertex numbers of each polygon."""
    ends = list(itertools.accumulate(sides))
    return [list(range(end - n + 1, end + 1)) for n, end in zip(sides, ends)]


def as_set(faces):
    return frozenset(frozenset(face) for face in faces)


def owner_of(face, polygons):
    """The polygon one of whose edges the face takes, or None for an inner triangle."""
    for number, polygon in enumerate(polygons):
        if sum(v in polygon for v in face) == 2:
            return "ABCD"[number]
    return None


def edges_of(faces):
    return {frozenset(pair) for face in faces for pair in itertools.combinations(face, 2)}


def flat(faces, polygons, outer, centre, radius, turn=90.0, hole_weight=0.3):
    """Places of the vertices in the plane: polygon `outer` outside, each other vertex at the weighted mean of its
    neighbours (Tutte), which makes a planar drawing. Light edges round the holes keep these wide."""
    rim = polygons[outer]
    place = {v: [centre[0], centre[1]] for polygon in polygons for v in polygon}
    for i, v in enumerate(rim):
        angle = math.radians(turn + 360 * i / len(rim))
        place[v] = [centre[0] + radius * math.cos(angle), centre[1] - radius * math.sin(angle)]
    hole_edges = {frozenset((p[i], p[i - 1])) for p in polygons for i in range(len(p))}
    springs = {v: [] for v in place}
    for edge in edges_of(faces):
        a, b = tuple(edge)
        weight = hole_weight if edge in hole_edges else 1.0
        springs[a].append((b, weight))
        springs[b].append((a, weight))
    for _ in range(2000):
        for v, near in springs.items():
            if v not in rim:
                total = sum(weight for _, weight in near)
                place[v] = [sum(weight * place[u][i] for u, weight in near) / total for i in (0, 1)]
    spread(place, faces, [p for n, p in enumerate(polygons) if n != outer], set(rim))
    return place


def area(place, a, b, c):
    (ax, ay), (bx, by), (cx, cy) = place[a], place[b], place[c]
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)


def spread(place, faces, holes, fixed):
    """Moves vertices so that no triangle, and no corner of a hole, is small: the sum of the logarithms of the areas
    grows with each move. None can turn over, so the drawing stays planar."""
    corners = [tuple(face) for face in faces]
    corners += [(h[i], h[i - 2], h[i - 1]) for h in holes for i in range(len(h))]
    sign = {t: math.copysign(1.0, area(place, *t)) for t in corners}
    around = {v: [t for t in corners if v in t] for v in place}

    def value(v):
        areas = [sign[t] * area(place, *t) for t in around[v]]
        return sum(map(math.log, areas)) if min(areas) > 0 else -math.inf

    step = 16.0
    while step > 0.25:
        moved = False
        for v in sorted(set(place) - fixed):
            for turn in range(8):
                was, before = place[v], value(v)
                place[v] = [was[0] + step * math.cos(turn * math.pi / 4), was[1] + step * math.sin(turn * math.pi / 4)]
                if value(v) > before + 1e-9:
                    moved = True
                else:
                    place[v] = was
        if not moved:
            step /= 2


def draw_flat(svg, faces, polygons, place, label=str, mark=()):
    """A handle in the plane; faces in the colour of the polygon whose edge they take. `mark`: polygons with bold
    numbers."""
    for face in faces:
        owner = owner_of(face, polygons)
        svg.polygon([place[v] for v in face], INNER if owner is None else TINT[owner])
    for edge in sorted(map(sorted, edges_of(faces))):
        svg.line(place[edge[0]], place[edge[1]], "#6b6b68", 1)
    for number, polygon in enumerate(polygons):
        name = "ABCD"[number]
        svg.polygon([place[v] for v in polygon], "none", LINE[name], 3)
        for v in polygon:
            svg.circle(place[v], 10.5, "white" if number not in mark else LINE[name], LINE[name], 1.6)
            svg.text(place[v], label(v), 11.5, LINE[name] if number not in mark else "white", bold=number in mark)


def middle(points):
    return [sum(p[i] for p in points) / len(points) for i in range(len(points[0]))]
