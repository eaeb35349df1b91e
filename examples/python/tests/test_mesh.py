# SPDX-License-Identifier: MIT
"""Results of the library through Python: topology, volumes, maps, state, failures."""

import copy
import importlib
import os
import re
import subprocess
import threading
import unittest

import numpy as np

import topoadapt
from topoadapt import Mesh, ball, errors
from bodies import euler, is_closed, lens, rings_ball, two_balls, volume

# examples/minimal.c
OCTAHEDRA = np.array(
    [[3, 0, 0], [0, 3, 0], [-3, 0, 0], [0, -3, 0], [0, 0, 3], [0, 0, -3]]
    + [[3, 0, 7], [0, 3, 7], [-3, 0, 7], [0, -3, 7], [0, 0, 10], [0, 0, 4]],
    np.float32,
)
SIDES = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]], np.uint16)
OCTAHEDRA_FACES = np.concatenate([SIDES, SIDES + np.uint16(6)])


def merge(distance=1.95, step=0.05, **options):
    """Two balls that move towards each other in one step. Their last places are `distance` apart."""
    vertices, faces = two_balls(distance + 2 * step)
    mesh = Mesh(vertices, faces, **options)
    mesh.move(vertices - step * np.sign(vertices[:, :1]) * [1, 0, 0])
    return mesh, mesh.step()


class Work(unittest.TestCase):
    def test_minimal_c(self):
        mesh = Mesh(OCTAHEDRA, OCTAHEDRA_FACES)
        mesh.move(OCTAHEDRA[6:] - np.float32([0, 0, 2]), np.arange(6, 12))
        report = mesh.step()
        self.assertEqual(
            (report.contacts, round(report.region_after, 4), report.rolled_back_vertices), (12, 71.4167, 0)
        )
        self.assertEqual((report.vertices, report.triangles), (13, 22))

    def test_two_balls_become_one(self):
        rng = np.random.default_rng(1)
        for distance in rng.uniform(1.2, 1.95, 5):
            with self.subTest(distance=distance):
                mesh, report = merge(distance, (2.05 - distance) / 2)
                vertices, faces = mesh.vertices, mesh.faces
                self.assertTrue(is_closed(faces))
                self.assertEqual(euler(vertices, faces), 2)
                one = volume(*ball(edge_length=0.3))
                self.assertAlmostEqual(volume(vertices, faces) / (2 * one - lens(distance)), 1, delta=0.03)
                self.assertEqual([c.genus for c in mesh.components()], [0])
                self.assertEqual(mesh.events()[-1].type, topoadapt.EventType.MERGE)
                self.assertEqual(mesh.validate().self_intersections, 0)
                self.assertGreater(report.contacts, 0)

    def test_resolve_is_the_union(self):
        rng = np.random.default_rng(2)
        for distance in rng.uniform(0.3, 1.9, 5):
            with self.subTest(distance=distance):
                vertices, faces, report = topoadapt.resolve(*two_balls(distance))
                self.assertTrue(is_closed(faces))
                self.assertEqual(euler(vertices, faces), 2)
                self.assertAlmostEqual(volume(vertices, faces), report.region_before, delta=1e-3)
                self.assertEqual(report.unresolved, 0)

    def test_detect_counts_what_validate_counts(self):
        mesh = Mesh(*two_balls(1.5))
        pairs = mesh.detect()
        self.assertEqual(len(pairs), mesh.validate().self_intersections)
        self.assertTrue((pairs[:, 0] < pairs[:, 1]).all() and len(pairs) > 0)
        self.assertEqual(len(Mesh(*two_balls(2.5)).detect()), 0)

    def test_remesh_and_smooth(self):
        mesh = Mesh(*ball(edge_length=0.5))
        report = mesh.remesh(0.2, 3)
        self.assertGreater(report.splits, 0)
        vertices, faces = mesh.vertices, mesh.faces
        edges = np.linalg.norm(vertices[faces] - vertices[faces[:, [1, 2, 0]]], axis=2)
        self.assertAlmostEqual(np.median(edges), 0.2, delta=0.05)
        rough = vertices * np.random.default_rng(3).uniform(0.97, 1.03, (len(vertices), 1))
        mesh.load(rough, faces)
        mesh.smooth(10)
        self.assertLess(np.linalg.norm(mesh.vertices, axis=1).std(), 0.6 * np.linalg.norm(rough, axis=1).std())
        smooth = mesh.vertices
        mesh.smooth(5, [])
        np.testing.assert_array_equal(mesh.vertices, smooth)

    def test_control(self):
        mesh, _ = merge()
        with self.assertRaises(errors.BudgetError) as caught:
            mesh.remesh(0.1, control=topoadapt.Control(budget=1))
        self.assertEqual(caught.exception.available, 1)
        control, digest = topoadapt.Control(), mesh.digest()
        threading.Thread(target=control.cancel).run()
        with self.assertRaises(errors.CancelledError):
            mesh.remesh(0.1, control=control)
        self.assertEqual(mesh.digest(), digest)
        control.clear()
        mesh.remesh(0.1, control=control)
        self.assertGreater(control.spent, 0)


class Results(unittest.TestCase):
    def test_old_vertices_keep_their_bits(self):
        mesh, _ = merge()
        targets = two_balls(2.05)[0]
        targets = targets - 0.05 * np.sign(targets[:, :1]) * [1, 0, 0]
        parents, weights = mesh.vertex_map().parents, mesh.vertex_map().weights
        old = parents[:, 1] == topoadapt.NONE
        np.testing.assert_array_equal(weights[old], 1)
        unmoved = (mesh.vertices[old] == targets[parents[old, 0]]).all(axis=1)
        self.assertGreater(unmoved.mean(), 0.6)
        old_to_new = mesh.vertex_map().old_to_new
        np.testing.assert_array_equal(old_to_new[parents[old, 0]], np.flatnonzero(old))

    def test_attributes_follow(self):
        mesh, _ = merge()
        before = two_balls(2.05)
        side = np.repeat([0.0, 1.0], len(before[0]) // 2)
        carried = mesh.carry_vertices(np.stack([side, 1 - side], axis=1))
        self.assertEqual(carried.shape, (len(mesh.vertices), 2))
        np.testing.assert_allclose(carried.sum(axis=1), 1, atol=1e-6)
        far = np.abs(mesh.vertices[:, 0]) > 0.5
        np.testing.assert_array_equal(carried[far, 0], (mesh.vertices[far, 0] > 0).astype(np.float32))
        faces = mesh.carry_faces(np.arange(len(before[1])))
        known = mesh.face_map() != topoadapt.NONE
        np.testing.assert_array_equal(faces[known], mesh.face_map()[known])
        with self.assertRaises(ValueError):
            mesh.carry_vertices(side[:-1])

    def test_changes_bring_a_copy_up_to_date(self):
        vertices, faces = two_balls(2.05)
        mesh = Mesh(vertices, faces)
        mesh.move(vertices - 0.05 * np.sign(vertices[:, :1]) * [1, 0, 0])
        mesh.step()
        for gap in (0, 8):
            changes, now = mesh.changes(gap), (mesh.vertices, mesh.faces)
            for mine, ranges, wanted in zip((vertices, faces), changes[:2], now):
                mine = np.concatenate([mine, np.zeros_like(wanted)])[: len(wanted)]
                for first, count in ranges:
                    mine[first : first + count] = wanted[first : first + count]
                np.testing.assert_array_equal(mine, wanted)

    def test_components(self):
        mesh = Mesh(*two_balls(3))
        components, labels = mesh.components(), mesh.component_labels()
        self.assertEqual([c.id for c in components], [0, len(labels) // 2])
        np.testing.assert_array_equal(labels, np.repeat([0, 1], len(labels) // 2))
        self.assertAlmostEqual(components[0].volume, volume(*ball(edge_length=0.3)), places=9)
        self.assertEqual(components[0].box[0], -2.5)

    def test_targets(self):
        mesh = Mesh(*ball())
        mesh.move([[0, 0, 2]], [5])
        ids, positions = mesh.targets()
        self.assertEqual((ids.tolist(), positions.tolist()), ([5], [[0, 0, 2]]))
        mesh.drop_targets()
        self.assertEqual(len(mesh.targets()[0]), 0)
        self.assertEqual(mesh.rolled_back().tolist(), [])

    def test_handles(self):
        info = topoadapt.handles.describe([5, 4, 3])
        self.assertEqual(info.faces, 5 + 4 + 3 + 2 * 3 - 4)
        for index in (0, info.handles - 1):
            faces = topoadapt.handles.get([5, 4, 3], index)
            edges = {tuple(e) for e in np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])}
            for polygon in ([0, 1, 2, 3, 4], [5, 6, 7, 8], [9, 10, 11]):
                self.assertLessEqual(set(zip(polygon, polygon[1:] + polygon[:1])), edges)
        self.assertGreater(topoadapt.handles.generator([3, 3], 0)[1], 0)
        with self.assertRaises(errors.ArgumentError):
            topoadapt.handles.describe([2, 3])


class State(unittest.TestCase):
    def test_save_and_restore(self):
        mesh, _ = merge()
        data = mesh.save()
        again = Mesh.from_state(data)
        self.assertEqual((again.save(), again.digest()), (data, mesh.digest()))
        self.assertEqual(again.events(), mesh.events())
        with self.assertRaises(errors.DataError) as caught:
            again.restore(data[:100] + b"x" + data[101:])
        self.assertEqual(caught.exception.status, topoadapt.Status.E_DATA)
        self.assertEqual(again.digest(), mesh.digest())

    def test_a_copy_goes_its_own_way(self):
        mesh, _ = merge()
        digest, twin = mesh.digest(), copy.deepcopy(mesh)
        twin.remesh(0.2)
        self.assertEqual(mesh.digest(), digest)
        mesh.remesh(0.2)
        self.assertEqual(mesh.digest(), twin.digest())

    def test_limits_do_not_change_results(self):
        plenty, _ = merge(max_vertices=65536)
        little = Mesh(*two_balls(2.05), max_vertices=100, max_contacts=1, max_events=1, max_cut_edges=3)
        little.move(little.vertices - 0.05 * np.sign(little.vertices[:, :1]) * [1, 0, 0])
        little.step()
        self.assertEqual(little.digest(), plenty.digest())
        self.assertGreater(little.config["max_contacts"], 1)
        plenty.grow(max_vertices=100000)
        self.assertEqual(little.digest(), plenty.digest())

    def test_without_growth(self):
        vertices, faces = two_balls(2.05)
        mesh = Mesh(vertices, faces, grow=False, max_contacts=1)
        mesh.move(vertices - 0.05 * np.sign(vertices[:, :1]) * [1, 0, 0])
        digest = mesh.digest()
        with self.assertRaises(errors.LimitError) as caught:
            mesh.step()
        self.assertEqual(caught.exception.limit, topoadapt.Limit.CONTACTS)
        self.assertGreater(caught.exception.needed, 1)
        self.assertEqual(mesh.digest(), digest)
        with self.assertRaises(errors.LimitError):
            Mesh(vertices, faces, max_vertices=100, max_bytes=1000000).load(*ball(edge_length=0.02))

    def test_memory_of_the_caller(self):
        memory = bytearray(8 << 20)
        mesh = Mesh(*two_balls(2.05), memory=memory, max_vertices=2000)
        self.assertNotEqual(bytes(memory), bytes(len(memory)))
        with self.assertRaises(BufferError):
            memory.append(0)
        self.assertEqual(mesh.digest(), Mesh(*two_balls(2.05)).digest())
        self.assertFalse(mesh.auto_grow)
        with self.assertRaises(errors.ArenaError) as caught:
            Mesh(memory=bytearray(1000))
        self.assertGreater(caught.exception.needed, 1000)
        with self.assertRaises(ValueError):
            Mesh(memory=bytes(8 << 20))
        self.assertGreater(sum(table.bytes for table in mesh.memory()), 1000)

    def test_growing_c(self):
        """The digest of examples/growing.c, given the same calls."""
        program = os.environ.get("TOPOADAPT_GROWING")
        if not program:
            self.skipTest("TOPOADAPT_GROWING does not name the program growing")
        output = subprocess.run(
            [program], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True
        ).stdout.decode()
        a, faces = rings_ball(-1.3, 0)
        b, _ = rings_ball(1.3, 0.1)
        mesh = Mesh(np.concatenate([a, b]), np.concatenate([faces, faces + np.uint32(len(a))]), max_vertices=8 * len(a))
        for _ in range(2):
            targets = mesh.vertices[: 2 * len(a)]
            targets[: len(a), 0] += 0.25
            targets[len(a) :, 0] -= 0.25
            mesh.move(targets, np.arange(2 * len(a)))
            mesh.step()
        self.assertEqual("{:016x}".format(mesh.digest()), re.search(r"digest (\w+)", output).group(1))


class Failures(unittest.TestCase):
    def test_a_mesh_with_a_hole(self):
        vertices, faces = ball()
        with self.assertRaises(errors.MeshError) as caught:
            Mesh(vertices, faces[1:])
        error = caught.exception
        self.assertEqual(error.defect, topoadapt.Defect.BOUNDARY_EDGE)
        self.assertIn(error.element, faces[0])
        self.assertIn(error.other, faces[0])
        self.assertIn(str(error.element), str(error))
        self.assertIsInstance(error, ValueError)

    def test_tangled(self):
        mesh = Mesh(*two_balls(1.5))
        with self.assertRaises(errors.TangledError) as caught:
            mesh.step()
        pair = [caught.exception.element, caught.exception.other]
        self.assertIn(pair, mesh.detect().tolist())

    def test_nan(self):
        vertices, faces = ball()
        vertices[7, 1] = np.nan
        with self.assertRaises(errors.MeshError) as caught:
            Mesh(vertices, faces)
        self.assertEqual((caught.exception.defect, caught.exception.element), (topoadapt.Defect.NOT_FINITE, 7))

    def test_nothing_loaded(self):
        mesh = Mesh()
        for call in (mesh.step, mesh.detect, mesh.validate, mesh.components, mesh.changes, mesh.vertex_map):
            with self.assertRaises(errors.StateError):
                call()
        self.assertEqual(repr(mesh), "<topoadapt.Mesh, empty>")

    def test_numbers_that_do_not_fit(self):
        mesh, (vertices, faces) = Mesh(*ball()), ball()
        faulty = [
            lambda: mesh.move(vertices[:, :2]),
            lambda: mesh.move(vertices, [1, 2]),
            lambda: mesh.move(vertices[:1], [-1]),
            lambda: mesh.smooth(-1),
            lambda: mesh.smooth(1 << 32),
            lambda: mesh.remesh(0.1, -1),
            lambda: mesh.load(vertices, faces.astype(np.int64) - 1),
            lambda: mesh.changes(-1),
            lambda: Mesh(max_vertices=1 << 32),
            lambda: Mesh(max_vertices=3),
            lambda: mesh.remesh(-1.0),
        ]
        digest = mesh.digest()
        for number, call in enumerate(faulty):
            with self.subTest(number=number), self.assertRaises(ValueError):
                call()
        for call in (lambda: Mesh(vertices, faces.astype(float)), lambda: Mesh(vertex_limit=1)):
            with self.assertRaises(TypeError):
                call()
        with self.assertRaises(errors.MeshError):
            mesh.move(vertices[:1], [len(vertices)])
        self.assertEqual(mesh.digest(), digest)

    def test_every_status_has_an_exception(self):
        statuses = [s for s in topoadapt.Status if s != 0]
        self.assertEqual(sorted(errors._CLASSES), sorted(statuses))
        for status in statuses + [-99]:
            with self.assertRaises(errors.Error) as caught:
                errors.check(status)
            self.assertTrue(str(caught.exception))


class Shapes(unittest.TestCase):
    """Meshes of other packages, by their attributes."""

    class Trimesh:
        def __init__(self, vertices=None, faces=None, process=True):
            self.vertices, self.faces, self.process = np.asarray(vertices), np.asarray(faces, np.int64), process

    class Meshio:
        def __init__(self, points, cells):
            self.points, self.cells_dict = points, dict(cells)

    def test_round_trip(self):
        vertices, faces = two_balls(1.5)
        plain = topoadapt.resolve(vertices, faces)
        for example in (self.Trimesh(vertices, faces), self.Meshio(vertices, [("triangle", faces)])):
            result = topoadapt.resolve(example)
            self.assertEqual(Mesh(*result[:2]).digest(), Mesh(*plain[:2]).digest())
            made = topoadapt.like(example, *result[:2])
            self.assertIs(type(made), type(example))
            self.assertEqual(Mesh(made).digest(), Mesh(*plain[:2]).digest())
        self.assertFalse(topoadapt.like(self.Trimesh([], []), *plain[:2]).process)

    def test_packages(self):
        """Those of the packages that are installed."""
        vertices, faces = two_balls(1.5)
        wanted = Mesh(*topoadapt.resolve(vertices, faces)[:2]).digest()
        for name, make in (
            ("trimesh", lambda m: m.Trimesh(vertices, faces, process=False)),
            ("meshio", lambda m: m.Mesh(vertices, [("triangle", faces)])),
        ):
            with self.subTest(name):
                try:
                    package = importlib.import_module(name)
                except ImportError:
                    self.skipTest("no " + name)
                example = make(package)
                made = topoadapt.like(example, *topoadapt.resolve(example)[:2])
                self.assertIs(type(made), type(example))
                self.assertEqual(Mesh(made).digest(), wanted)

    def test_other_cells(self):
        vertices, faces = ball()
        with self.assertRaises(ValueError):
            Mesh(self.Meshio(vertices, [("triangle", faces), ("quad", faces)]))
        with self.assertRaises(TypeError):
            Mesh(3)

    def test_forms_of_arrays(self):
        vertices, faces = ball()
        digest = Mesh(vertices, faces).digest()
        forms = [
            (np.asfortranarray(vertices), faces.astype(np.int64)),
            (vertices.astype(">f8"), faces.astype(">i4")),
            (vertices.tolist(), faces.tolist()),
            (vertices[::-1][::-1], np.repeat(faces, 2, axis=0)[::2]),
        ]
        for form in forms:
            self.assertEqual(Mesh(*form).digest(), digest)


if __name__ == "__main__":
    unittest.main()
