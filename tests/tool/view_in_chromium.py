#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""view_in_chromium.py TOOL: pages of --html in a browser without network. Exit 77, skipped, without Chromium."""
import json
import os
import sys
import tempfile
import unittest

import view_case as case
from chromium import PROGRAM, Page

if PROGRAM is None:
    print("skipped: no Chromium")
    sys.exit(77)

TOOL = os.path.abspath(sys.argv.pop(1))
# Distinct colours of a canvas, some of its pixels taken.
COLOURS = """(() => { const from = document.querySelector('%s'), to = document.createElement('canvas');
  to.width = from.width; to.height = from.height; const pen = to.getContext('2d'); pen.drawImage(from, 0, 0);
  const p = pen.getImageData(0, 0, to.width, to.height).data, seen = new Set();
  for (let i = 0; i < p.length; i += 28) seen.add(p[i] << 16 | p[i + 1] << 8 | p[i + 2]);
  return seen.size; })()"""
# Orange pixels of a slice: their number, and the share with both sides of the threshold (127 of 255) within 4 pixels.
CONTOUR = """(() => { const c = document.querySelectorAll('.slice canvas')[%d], w = c.width, h = c.height;
  const p = c.getContext('2d').getImageData(0, 0, w, h).data; let orange = 0, good = 0;
  for (let y = 4; y < h - 4; ++y) for (let x = 4; x < w - 4; ++x) {
    const i = 4 * (y * w + x);
    if (!(p[i] > 200 && p[i + 2] < 120 && p[i] - p[i + 2] > 100)) continue;
    let low = 255, high = 0;
    for (let v = -4; v <= 4; ++v) for (let u = -4; u <= 4; ++u) {
      const k = i + 4 * (v * w + u);
      if (p[k] === p[k + 1] && p[k] === p[k + 2]) { low = Math.min(low, p[k]); high = Math.max(high, p[k]); }
    }
    ++orange;
    good += low <= 129 && high >= 125;
  }
  return [orange, good / orange]; })()"""


class InBrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name
        cls.page = Page(820, 620)
        cls.addClassCleanup(cls.page.close)

    def path(self, name):
        return os.path.join(self.folder, name)

    def open(self, name):
        self.page.complaints.clear()
        self.page.requests.clear()
        self.page.open(self.path(name))

    def check_quiet(self, name):
        self.assertEqual(self.page.complaints, [])
        self.assertEqual([r for r in self.page.requests if not r.startswith("data:")], ["file://" + self.path(name)])
        self.assertGreater(len(self.page.screenshot()), 20000)

    def picture(self, selector="#mesh"):
        self.page.settle()
        return self.page.run(f"document.querySelector('{selector}').toDataURL()")

    def changes(self, act, selector="#mesh"):
        before = self.picture(selector)
        act()
        self.assertNotEqual(before, self.picture(selector))

    def text(self, selector):
        return self.page.run(f"document.querySelector('{selector}').textContent")

    def facts(self, report):
        with open(self.path(report), encoding="utf-8") as file:
            parts = json.load(file)["components"]
        self.assertEqual(self.text("#fact_genus"), str(sum(p["genus"] for p in parts)))
        shown = float(self.text("#fact_volume").split()[0].replace(",", ""))
        volume = sum(p["volume"] for p in parts)
        self.assertAlmostEqual(shown, volume, delta=1e-5 * abs(volume))

    def test_segmentation(self):
        case.write_volume(self.path("v.nrrd"), "lps")
        case.segment(TOOL, self.path("v.nrrd"), "--html", self.path("v.html"), "--json", self.path("v.json"))
        page = self.page
        self.open("v.html")
        self.facts("v.json")
        self.assertGreater(page.run(COLOURS % "#mesh"), 200)
        for control in ("#wire", "#flat", "#parts", "#planes"):
            with self.subTest(control):
                self.changes(lambda: page.run(f"document.querySelector('{control}').click()"))
        self.changes(lambda: page.drag("#mesh", 60, 20))
        self.changes(lambda: page.run("document.querySelector('#mesh').dispatchEvent(new WheelEvent('wheel', {deltaY: 200, cancelable: true}))"))
        self.changes(lambda: page.run("(() => { const c = document.querySelector('#cut'); c.value = '0'; c.dispatchEvent(new Event('change')); })()"))
        for number in range(3):
            orange, share = page.run(CONTOUR % number)
            self.assertGreater(orange, 200)
            self.assertGreater(share, 0.99)
        self.changes(lambda: page.slide(".slice input", 9), ".slice canvas")
        self.assertIn("= 9", page.run("document.querySelector('.slice output').value"))
        self.changes(lambda: page.slide("#window", 50), ".slice canvas")
        self.check_timeline()
        self.check_quiet("v.html")
        page.size(400, 800)
        self.assertLessEqual(page.run("document.documentElement.scrollWidth"), 400)
        # Nothing of the panel of grey levels is cut off.
        page.size(1000, 640)
        self.assertLessEqual(*page.run("(() => { const g = document.querySelector('#grey'); return [g.scrollHeight, g.clientHeight]; })()"))
        page.size(820, 620)

    def check_timeline(self):
        page, last = self.page, self.page.run("document.querySelector('#moment').value")
        self.changes(lambda: page.slide("#frame", 0))
        self.assertNotEqual(page.run("document.querySelector('#moment').value"), last)
        page.slide("#frame", page.run("document.querySelector('#frame').max - 3"))
        page.run("document.querySelector('#play').click()")
        # The signs are drawn, since a font may lack them.
        self.assertEqual(page.run("[document.querySelector('#play').textContent, document.querySelector('#play').className]"), ["", "playing"])
        page.until(f"document.querySelector('#moment').value === {json.dumps(last)}")
        page.until("document.querySelector('#play').className === ''")
        self.assertGreater(page.run("document.querySelectorAll('#chart path').length"), 1)

    def test_evolution(self):
        case.call(TOOL, "evolve", "merging-pair", "--html", self.path("e.html"), "--json", self.path("e.json"))
        self.open("e.html")
        self.facts("e.json")
        self.assertGreater(self.page.run(COLOURS % "#mesh"), 100)
        self.check_timeline()
        self.assertGreater(self.page.run("document.querySelectorAll('#chart circle').length"), 0)
        self.check_quiet("e.html")

    def test_resolution(self):
        case.write_two_balls(self.path("m.off"))
        case.call(TOOL, "resolve", self.path("m.off"), "--out", self.path("o.ply"), "--html", self.path("m.html"), "--json",
                  self.path("m.json"))
        self.open("m.html")
        self.facts("m.json")
        self.assertEqual(self.text("#legend"), "")
        self.changes(lambda: self.page.slide("#frame", 0))
        self.assertIn("triangles that meet", self.text("#legend"))
        # Without slices, all of the page is in sight.
        self.page.size(1000, 640)
        self.assertLessEqual(self.page.run("document.documentElement.scrollHeight"), 640)
        self.page.size(820, 620)
        self.check_quiet("m.html")


if __name__ == "__main__":
    unittest.main()
