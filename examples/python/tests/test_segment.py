# SPDX-License-Identifier: MIT
"""Segmentation against bodies that are known: topology, volume, place; masks and slices against formulas."""

import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest
import warnings

import numpy as np

import topoadapt
from topoadapt import voxels
from bodies import is_closed, middle, volume

HERE = os.path.dirname(os.path.abspath(__file__))
SCRIPT = os.path.join(HERE, "..", "segment_and_plot.py")


def ring(shape=(40, 40, 18), radii=(12, 4), noise=0.0):
    """A ring in the plane of i and j, bright, border at 0."""
    i, j, k = (x - (n - 1) / 2 for x, n in zip(np.indices(shape), shape))
    depth = radii[1] - np.sqrt((np.sqrt(i**2 + j**2) - radii[0]) ** 2 + k**2)
    return np.clip(depth, -2, 2) + noise * np.random.default_rng(1).normal(size=shape)


def has(*modules):
    return all(importlib.util.find_spec(module) for module in modules)


class Segment(unittest.TestCase):
    def test_a_ring_closes(self):
        for dark, noise in ((1, 0.0), (-1, 0.2)):
            with self.subTest(dark=dark, noise=noise):
                found = topoadapt.segment(10 + dark * ring(noise=noise), (31, 19, 8), 10)
                self.assertEqual([c.genus for c in found.mesh.components()], [1])
                self.assertEqual(found.mesh.validate().self_intersections, 0)
                self.assertTrue(is_closed(found.faces) and found.at_rest)
                self.assertAlmostEqual(volume(found.vertices, found.faces) / (2 * np.pi**2 * 12 * 16), 1, delta=0.1)
                self.assertGreater(found.filled, 0.9)
                self.assertLess(found.beyond, 0.05)

    def test_a_void_stays(self):
        i, j, k = np.indices((30, 30, 30)) - 14.5
        radius = np.sqrt(i**2 + j**2 + k**2)
        found = topoadapt.segment(4 - np.abs(radius - 8), (14, 14, 22), 0, edge_length=1.5)
        components = found.mesh.components()
        self.assertEqual([c.genus for c in components], [0, 0])
        self.assertEqual(sorted(np.sign([c.volume for c in components]).tolist()), [-1, 1])

    def test_results_lie_in_the_world(self):
        affine = np.diag([-0.5, 1.0, 2.0, 1.0])
        affine[:3, 3] = [40, -20, 100]
        at = np.indices((60, 30, 16)).reshape(3, -1).T @ affine[:3, :3] + affine[:3, 3]
        centre = np.array([25.3, -5.2, 114.6])
        depth = (9 - np.linalg.norm(at - centre, axis=1)).reshape(60, 30, 16)
        found = topoadapt.segment(depth, (29, 15, 7), 0, affine=affine)
        np.testing.assert_allclose(middle(found.vertices, found.faces), centre, atol=0.05)
        self.assertAlmostEqual(volume(found.vertices, found.faces) / (4 / 3 * np.pi * 9**3), 1, delta=0.06)
        np.testing.assert_allclose(np.linalg.norm(found.vertices - centre, axis=1), 9, atol=0.5)

    def test_an_unfilled_object_is_told(self):
        with self.assertWarnsRegex(UserWarning, "not at rest"):
            found = topoadapt.segment(ring(), (31, 19, 8), 0, max_iterations=5)
        self.assertEqual((found.iterations, found.at_rest), (5, False))
        self.assertLess(found.filled, 0.5)

    def test_a_callback_follows_and_ends(self):
        seen = []
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            topoadapt.segment(ring(), (31, 19, 8), 0, callback=lambda n, mesh: seen.append(n) or n == 3)
        self.assertEqual(seen, [1, 2, 3])

    def test_equal_calls_give_equal_bits(self):
        first, second = (topoadapt.segment(ring(), (31, 19, 8), 0) for _ in range(2))
        self.assertEqual(first.mesh.digest(), second.mesh.digest())

    def test_what_is_no_volume(self):
        faulty = [
            (ring()[0], (1, 1, 1), 0),
            (np.full((9, 9, 9), np.nan), (1, 1, 1), 0),
            (ring(), (40, 0, 0), 0),
            (ring(), (31, 19), 0),
            (np.zeros((9, 9, 9)), (1, 1, 1), 0),
        ]
        for number, arguments in enumerate(faulty):
            with self.subTest(number=number), self.assertRaises(ValueError):
                topoadapt.segment(*arguments)


class Voxels(unittest.TestCase):
    def test_inside_a_ball(self):
        rng = np.random.default_rng(4)
        for _ in range(5):
            centre, radius = rng.uniform(8, 12, 3), rng.uniform(3, 6)
            mask = voxels.inside(*topoadapt.ball(centre, radius, 0.3), (20, 20, 20))
            distance = np.linalg.norm(np.indices((20, 20, 20)).reshape(3, -1).T - centre, axis=1).reshape(mask.shape)
            self.assertTrue(mask[distance < radius - 0.02].all())
            self.assertFalse(mask[distance > radius].any())

    def test_inside_a_cube_on_voxels(self):
        """Edges and corners on voxel centres; faces of both kinds of diagonal."""
        corner = np.array([[x, y, z] for x in (1, 5) for y in (1, 5) for z in (1, 5)])
        quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        faces = [f for a, b, c, d in quads for f in ((a, b, c), (a, c, d))]
        mask = voxels.inside(corner, np.array(faces), (7, 7, 7))
        self.assertTrue(mask[2:5, 2:5, 2:5].all())
        self.assertFalse(mask[:1].any() or mask[6:].any() or mask[:, 6:].any() or mask[:, :, 6:].any())
        self.assertEqual(int(mask.sum()), 4 * 4 * 4)

    def test_a_hollow_is_outside_whatever_the_winding(self):
        (a, faces), (b, _) = topoadapt.ball((10, 10, 10), 8, 1), topoadapt.ball((10, 10, 10), 4, 0.5)
        hollow = np.concatenate([faces, faces[:, ::-1] + np.uint32(len(a))])
        mask = voxels.inside(np.concatenate([a, b]), hollow, (20, 20, 20))
        self.assertFalse(mask[10, 10, 10])
        self.assertTrue(mask[10, 10, 4])
        np.testing.assert_array_equal(voxels.inside(np.concatenate([a, b]), hollow[:, ::-1], (20, 20, 20)), mask)

    def test_connected(self):
        """Against labels by repeated growth."""
        mask = np.random.default_rng(5).random((9, 8, 7)) < 0.35
        mask[4, 4, 4] = True
        grown = np.zeros_like(mask)
        grown[4, 4, 4] = True
        while True:
            wide = np.pad(grown, 1)
            more = grown | (
                mask & np.any([np.roll(wide, s, a)[1:-1, 1:-1, 1:-1] for a in range(3) for s in (1, -1)], 0)
            )
            if (more == grown).all():
                break
            grown = more
        np.testing.assert_array_equal(voxels.connected(mask, (4, 4, 4)), grown)


@unittest.skipUnless(has("nibabel", "matplotlib"), "no nibabel, or no matplotlib")
class Script(unittest.TestCase):
    def run_script(self, *arguments):
        environment = dict(os.environ, PYTHONPATH=os.path.dirname(os.path.dirname(topoadapt.__file__)))
        command = [sys.executable, "-B", SCRIPT] + list(arguments)
        return subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def test_a_picture_and_a_mesh(self):
        import nibabel

        with tempfile.TemporaryDirectory() as folder:
            volume_path, picture, mesh = (os.path.join(folder, name) for name in ("v.nii.gz", "p.png", "m.obj"))
            image = nibabel.Nifti1Image(ring().astype(np.float32), np.diag([1.0, 1.0, 1.5, 1.0]))
            nibabel.save(image, volume_path)
            options = ["--seed", "31,19,8", "--threshold", "0", "--out", picture, "--mesh", mesh]
            done = self.run_script(volume_path, *options)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(b"1 component(s), genus 1", done.stdout)
            with open(picture, "rb") as file:
                self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")
            with open(mesh, encoding="ascii") as file:
                lines = file.read().splitlines()
            self.assertGreater(sum(line.startswith("f ") for line in lines), 500)
            self.assertNotEqual(self.run_script(volume_path, "--seed", "1,2", "--threshold", "0").returncode, 0)
            done = self.run_script(os.path.join(folder, "none.nii"), *options)
            self.assertNotEqual(done.returncode, 0)
            self.assertNotIn(b"Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
