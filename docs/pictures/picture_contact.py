# SPDX-License-Identifier: MIT
"""The picture of docs/pictures/handle_pictures.py in which two balls meet: contacts and handle come from the tool."""
import itertools
import math
import os
import tempfile

from picture_parts import INNER, RED, TINT, Svg, handles_of, middle, run


def ball(centre, turn):
    """An octahedron with each edge in three, blown up; turned about the x axis."""
    parts, number, points, faces = 3, {}, [], []

    def vertex(p):
        if p not in number:
            number[p] = len(points)
            n = math.sqrt(sum(c * c for c in p))
            x, y, z = (c / n for c in p)
            y, z = y * math.cos(turn) - z * math.sin(turn), y * math.sin(turn) + z * math.cos(turn)
            points.append((x + centre[0], y + centre[1], z + centre[2]))
        return number[p]

    for s in itertools.product((1, -1), repeat=3):
        corner = lambda i, j: vertex((s[0] * (parts - i - j), s[1] * i, s[2] * j))
        for i in range(parts):
            for j in range(parts - i):
                cells = [(corner(i, j), corner(i + 1, j), corner(i, j + 1))]
                if i + j < parts - 1:
                    cells.append((corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)))
                faces += [c if s[0] * s[1] * s[2] > 0 else c[::-1] for c in cells]
    return points, faces


def two_balls():
    left, faces = ball((-0.92, 0.03, 0.02), 0.1)
    right, _ = ball((0.92, -0.02, -0.03), 0.6)
    n = len(left)
    return left + right, faces + [tuple(v + n for v in face) for face in faces], n


def pairs_in_contact(tool, points, faces):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "two.off")
        with open(path, "w", encoding="ascii") as file:
            file.write("OFF\n%d %d 0\n" % (len(points), len(faces)))
            file.writelines("%r %r %r\n" % p for p in points)
            file.writelines("3 %d %d %d\n" % f for f in faces)
        words = [line.split() for line in run(tool, "detect", path, "--pairs").splitlines()]
    return [(int(w[0]), int(w[1])) for w in words if len(w) == 2 and all(x.isdigit() for x in w)]


def cut_out(points, faces, cluster):
    """Section 5, local refinement: what is left of the faces once the cluster is gone, cut through the middle of its
    edges, and the loops, in the direction in which new faces run through them."""
    points, rest, middle_of, after = list(points), [], {}, {}

    def between(a, b):
        key = frozenset((a, b))
        if key not in middle_of:
            middle_of[key] = len(points)
            points.append(tuple(middle([points[a], points[b]])))
        return middle_of[key]

    for face in faces:
        gone = [v in cluster for v in face]
        if not any(gone):
            rest.append(face)
        elif not all(gone):
            lone = gone.index(sum(gone) == 1)
            a, b, c = face[lone], face[(lone + 1) % 3], face[(lone + 2) % 3]
            ab, ca = between(a, b), between(c, a)
            if sum(gone) == 1:
                rest += [(ab, b, c), (ab, c, ca)]
                after[ab] = ca
            else:
                rest.append((a, ab, ca))
                after[ca] = ab
    loops = []
    while after:
        loop = [next(iter(after))]
        while loop[-1] in after:
            loop.append(after.pop(loop[-1]))
        loops.append(loop[:-1])
    return points, rest, loops


def shortest_handle(tool, points, loops):
    """The shortest stored handle between the loops, as faces of their vertices."""
    corners = [v for loop in loops for v in loop]
    at = lambda v: points[corners[v - 1]]
    length = lambda face: sum(math.dist(at(face[c]), at(face[c - 1])) for c in range(3))
    best = min(handles_of(tool, *map(len, loops)), key=lambda handle: sum(map(length, handle)))
    return [tuple(corners[v - 1] for v in face) for face in best]


def shade(color, light):
    rgb = [int(color[i:i + 2], 16) for i in (1, 3, 5)]
    return "#%02x%02x%02x" % tuple(round(c * light) for c in rgb)


def draw_solid(svg, points, faces, color_of, centre, scale, loops=(), glass=lambda face: False):
    """Triangles from back to front, the eye at the front, a little to the right and above. One can look through what
    is of glass; its far side is left out."""
    azimuth, elevation = math.radians(-80), math.radians(13)
    towards = (math.cos(elevation) * math.cos(azimuth), math.cos(elevation) * math.sin(azimuth), math.sin(elevation))
    right = (-math.sin(azimuth), math.cos(azimuth), 0.0)
    cross = lambda a, b: (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    dot = lambda a, b: sum(x * y for x, y in zip(a, b))
    up = cross(towards, right)
    sun = (-0.3, -0.65, 0.7)
    solid = {face for face in faces if any(map(glass, faces)) and not glass(face)}
    seen = [(centre[0] + scale * dot(p, right), centre[1] - scale * dot(p, up)) for p in points]
    rims = {frozenset((loop[i], loop[i - 1])) for loop in loops for i in range(len(loop))}

    def depth(face):
        return dot(middle([points[v] for v in face]), towards)

    for face in sorted(faces, key=depth):
        a, b, c = (points[v] for v in face)
        normal = cross([x - y for x, y in zip(b, a)], [x - y for x, y in zip(c, a)])
        front = dot(normal, towards) > 0
        if glass(face) and not front:
            continue
        cosine = dot(normal, sun) / math.sqrt(dot(normal, normal)) * (1 if front else -1)
        fill = color_of(face) if front or face in solid else "#b9a489"
        svg.polygon([seen[v] for v in face], shade(fill, 0.8 + 0.2 * max(-1.0, min(1.0, cosine))), "#5d5d5a", 0.7,
                    'fill-opacity="0.35"' if glass(face) else "")
        for a, b in itertools.combinations(face, 2):
            if frozenset((a, b)) in rims:
                svg.line(seen[a], seen[b], RED, 2.6)


def draw_contact(tool, path):
    points, faces, split = two_balls()
    pairs = pairs_in_contact(tool, points, faces)
    touching = {f for pair in pairs for f in pair}
    assert touching, "the balls do not meet"
    cluster = {v for f in touching for v in faces[f]}
    svg = Svg(900, 270)
    body = lambda face: TINT["A"] if face[0] < split else TINT["B"]
    meets = {faces[f] for f in touching}
    draw_solid(svg, points, faces, lambda f: "#f0443a" if f in meets else body(f), (152, 128), 78,
               glass=lambda f: f not in meets)
    points, rest, loops = cut_out(points, faces, cluster)
    side = lambda v: points[v][0] < 0
    half = lambda face: TINT["A"] if side(face[0]) else TINT["B"]
    draw_solid(svg, points, rest, half, (450, 128), 78, loops)
    handle = shortest_handle(tool, points, loops)
    new = set(handle)
    draw_solid(svg, points, rest + handle, lambda f: INNER if f in new else half(f), (748, 128), 78, loops)
    svg.text((152, 246), "two balls meet: red triangles cross", 12.5)
    svg.text((450, 246), "cut out: two loops of %d and %d edges" % tuple(map(len, loops)), 12.5)
    svg.text((748, 246), "a handle closes the gap: %d triangles" % len(handle), 12.5)
    svg.write(path, "Two balls that meet, what is cut out, and the handle between the two loops")
