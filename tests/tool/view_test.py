#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""view_test.py TOOL: the pictures of --png and the contents of --html, read by code of their own.

The slices show a body known by a formula: contours have to lie where the grey values cross the threshold, and the body
where the patient's left, front and head are on a radiologist's screen.
"""
import json
import math
import os
import sys
import tempfile
import unittest

import view_case as case

TOOL = os.path.abspath(sys.argv.pop(1))
# Halves of the picture of a segmentation: the panels to the right and below start there.
COLUMN, ROW = 500, 436


def is_orange(r, g, b):
    return r > 190 and 90 < g < 200 and b < 120 and r - b > 100


def is_grey(r, g, b):
    return max(r, g, b) - min(r, g, b) <= 2


class Picture:
    def __init__(self, path):
        self.width, self.height, self.rows = case.read_png(path)

    def at(self, x, y):
        return tuple(self.rows[y][3 * x:3 * x + 3])

    def window(self, x, y, reach):
        for v in range(max(0, y - reach), min(self.height, y + reach + 1)):
            for u in range(max(0, x - reach), min(self.width, x + reach + 1)):
                yield self.at(u, v)


class View(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def check_panel(self, picture, left, top, right_half, upper_half):
        width, height, across = COLUMN - 20, ROW - 60, []
        orange = [(x, y) for y in range(top, top + height) for x in range(left, left + width)
                  if is_orange(*picture.at(x, y))]
        self.assertGreater(len(orange), 400)
        # Grey value 100 of 0 to 200 shows as 127.
        for x, y in orange[::7]:
            greys = [p[0] for p in picture.window(x, y, 4) if is_grey(*p)]
            self.assertTrue(greys and min(greys) <= 128 and max(greys) >= 126, (x, y, greys))
        for y in range(top + 4, top + height - 4, 3):
            for x in range(left + 4, left + width - 4):
                here, there = picture.at(x, y), picture.at(x + 1, y)
                if is_grey(*here) and is_grey(*there) and (here[0] < 127) != (there[0] < 127):
                    self.assertTrue(any(is_orange(*p) for p in picture.window(x, y, 4)), ("no contour", x, y))
                if is_grey(*here) and here[0] > 140:
                    across.append((x, y))
        middle = [sum(p[i] for p in across) / len(across) for i in range(2)]
        self.assertEqual((middle[0] > left + width / 2, middle[1] < top + height / 2), (right_half, upper_half), middle)

    def test_contours_lie_on_the_threshold(self):
        for space in ("lps", "ras"):
            with self.subTest(space):
                case.write_volume(self.path("v.nrrd"), space)
                case.segment(TOOL, self.path("v.nrrd"), "--png", self.path("v.png"))
                picture = Picture(self.path("v.png"))
                self.assertEqual(picture.width, 1000)
                # Axial, coronal, sagittal: the body is to the left, in front and above the middle of the patient.
                self.check_panel(picture, COLUMN + 10, 48, True, True)
                self.check_panel(picture, 16, ROW + 10, True, True)
                self.check_panel(picture, COLUMN + 10, ROW + 10, False, True)
                blue = sum(p[2] > p[0] + 40 for y in range(50, ROW, 4) for p in (picture.at(x, y) for x in range(16, COLUMN - 10, 4)))
                self.assertGreater(blue, 2000)

    def test_tangled_places_are_red_before(self):
        case.write_two_balls(self.path("m.off"))
        case.call(TOOL, "resolve", self.path("m.off"), "--out", self.path("o.ply"), "--png", self.path("m.png"))
        picture = Picture(self.path("m.png"))
        red = [x for y in range(48, picture.height, 2) for x in range(0, picture.width, 2)
               if picture.at(x, y)[0] > picture.at(x, y)[2] + 40]
        self.assertGreater(len(red), 100)
        self.assertLess(max(red), COLUMN)

    def test_pages_carry_report_and_meshes(self):
        case.write_volume(self.path("a<script>&.nrrd"), "lps")
        case.segment(TOOL, self.path("a<script>&.nrrd"), "--html", self.path("v.html"), "--json", self.path("r.json"),
                     "--out", self.path("m.ply"))
        page = case.PageFile(self.path("v.html"))
        with open(self.path("r.json"), encoding="utf-8") as file:
            self.assertEqual(page.data["report"], json.load(file))
        self.assertEqual(page.data["title"], "a<script>&.nrrd")
        self.assertEqual(page.text.count("http"), page.text.count("http://www.w3.org/2000/svg"))
        self.assertLess(len(page.text), 4 << 20)
        self.check_meshes(page)
        self.check_volume(page)
        times = [f["time"] for f in page.data["frames"]]
        self.assertEqual(times, sorted(set(times)))
        genus, parts = page.data["moments"][-1][1:3]
        self.assertEqual((genus, parts), (0, 2))
        self.assertEqual(sum(e["split"] for e in page.data["events"]), page.data["report"]["events"]["split"])

    def check_meshes(self, page):
        frame = page.data["frames"][-1]
        points, triangles, _ = page.mesh(frame)
        written, faces = case.read_ply(self.path("m.ply"))
        self.assertEqual((len(points), len(triangles)), (len(written), len(faces)))
        step = max(frame["box"][i + 3] - frame["box"][i] for i in range(3)) / 65535
        for p, q in zip(sorted(written)[::50], sorted(points)[::50]):
            self.assertLess(min(math.dist(p, x) for x in points), step)
            self.assertLess(min(math.dist(q, x) for x in written), step)
        self.assertAlmostEqual(case.volume_of(points, triangles), case.volume_of(written, faces), delta=1)
        edges = {(t[i], t[(i + 1) % 3]) for t in triangles for i in range(3)}
        self.assertEqual(len(edges), 3 * len(triangles))
        self.assertTrue(all((b, a) in edges for a, b in edges))

    def check_volume(self, page):
        volume, grey = page.data["volume"], []
        self.assertEqual(volume["size"], list(case.SIZES))
        for i, byte in enumerate(page.blob(volume["blob"])):
            grey.append(byte if i % case.SIZES[0] == 0 else (grey[-1] + byte) & 255)
        for i, j, k in ((0, 0, 0), (25, 7, 12), (20, 10, 10), (25, 14, 12), (39, 35, 19)):
            at = (i * case.STEPS[0], j * case.STEPS[1], k * case.STEPS[2])
            value = max(0, min(200, 100 + 30 * case.depth(at)))
            shown = grey[i + case.SIZES[0] * (j + case.SIZES[1] * k)]
            self.assertAlmostEqual(volume["low"] + shown * (volume["high"] - volume["low"]) / 255, value, delta=0.6)

    def test_pages_of_other_commands(self):
        case.write_two_balls(self.path("m.off"))
        done = case.call(TOOL, "resolve", self.path("m.off"), "--out", self.path("o.ply"), "--html", self.path("m.html"))
        page = case.PageFile(self.path("m.html"))
        before, after = page.data["frames"]
        self.assertIn(done.stdout.split()[0] + " pairs", before["name"])
        _, triangles, marks = page.mesh(before)
        self.assertEqual(len(marks), len(triangles))
        self.assertGreater(sum(marks), 10)
        self.assertEqual(page.mesh(after)[2], b"")
        case.call(TOOL, "evolve", "merging-pair", "--html", self.path("e.html"), "--json", self.path("e.json"),
                  "--png", self.path("e.png"))
        page = case.PageFile(self.path("e.html"))
        self.assertEqual([m[2] for m in page.data["moments"]][::len(page.data["moments"]) - 1], [2, 1])
        self.assertEqual(sum(e["merge"] for e in page.data["events"]), 1)
        self.assertIsNone(page.data["volume"])
        self.assertEqual(Picture(self.path("e.png")).width, 1000)

    def test_refuses_bad_paths_before_the_work(self):
        for words, reason in ((("--html", self.path("none/v.html")), "none"), (("--png", self.path("none/v.png")), "none"),
                              (("--html", self.path("v"), "--png", self.path("v")), "both write"),
                              (("--json", self.path("v"), "--html", self.path("v")), "both write")):
            done = case.segment(TOOL, self.path("absent.nrrd"), *words, code=2)
            self.assertEqual(done.stderr.count("\n"), 1)
            self.assertIn(reason, done.stderr)


if __name__ == "__main__":
    unittest.main()
