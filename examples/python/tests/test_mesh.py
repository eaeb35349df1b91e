# SPDX-License-Identifier: MIT
"""Results of the library through Python: topology, volumes, maps, state, failures."""

import copy
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
        x = mesh.vertices[:, 0]
        mesh.reorder()
        self.assertFalse((mesh.vertices == smooth).all())
        np.testing.assert_array_equal(mesh.carry_vertices(x), mesh.vertices[:, 0])

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

    def test_balls_that_would_pass_each_other_meet_in_substeps(self):
        vertices, faces = two_balls(3)
        across = vertices - 3 * np.sign(vertices[:, :1]) * [1, 0, 0]
        unseen = Mesh(vertices, faces)
        unseen.move(across)
        report = unseen.step()
        self.assertEqual((report.contacts, report.substeps, len(unseen.components())), (0, 0, 2))
        with self.assertRaises(errors.LimitError) as caught:
            bounded = Mesh(vertices, faces, grow=False)
            bounded.move(across)
            bounded.advance(0.5)
        self.assertEqual(caught.exception.limit, topoadapt.Limit.SUBSTEPS)
        mesh = Mesh(vertices, faces)
        mesh.move(across)
        report = mesh.advance(0.5)
        self.assertGreaterEqual(report.substeps, caught.exception.needed)
        self.assertGreater(report.contacts, 0)
        self.assertEqual(mesh.validate().self_intersections, 0)

    def test_threads_change_no_bit(self):
        vertices, faces = two_balls(1.5)
        vertices, faces = topoadapt.resolve(vertices, faces)[:2]
        serial = Mesh(vertices, faces)
        serial.remesh(0.02, 6)
        shared, started = serial.copy(), threading.active_count()
        control = topoadapt.Control(threads=3)
        for mesh, chosen in ((serial, None), (shared, control)):
            mesh.move(mesh.vertices * [1, 1, 0.9])
            mesh.step(chosen)
            mesh.smooth(2, control=chosen)
        self.assertEqual(shared.digest(), serial.digest())
        self.assertGreater(threading.active_count(), started)
        self.assertEqual((control.threads, topoadapt.Control().threads), (3, 1))
        with self.assertRaises(ValueError):
            topoadapt.Control(threads=0)


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
        np.testing.assert_array_equal(carried[far, 0], mesh.vertices[far, 0] > 0)
        faces = mesh.carry_triangles(np.arange(len(before[1])))
        known = mesh.face_map() != topoadapt.NONE
        np.testing.assert_array_equal(faces[known], mesh.face_map()[known])
        with self.assertRaises(ValueError):
            mesh.carry_vertices(side[:-1])

    def test_doubles_follow_as_doubles(self):
        mesh, _ = merge()
        count = len(mesh.vertices)
        mesh.remesh(0.2)
        for values in (np.random.default_rng(5).normal(size=(count, 2)), np.arange(count) + 2**30):
            carried = mesh.carry_vertices(values)
            self.assertEqual(carried.dtype, np.float64)
            parents, weights = mesh.vertex_map()[1:]
            new = 0
            for vertex, ((first, second), weight) in enumerate(zip(parents.tolist(), weights.tolist())):
                if second == topoadapt.NONE or weight == 1:
                    wanted = values[first]
                else:
                    wanted = weight * values[first] + (1 - weight) * values[second]
                    new += 1
                np.testing.assert_array_equal(carried[vertex], wanted)
            self.assertGreater(new, 10)
        singles = np.random.default_rng(6).normal(size=count).astype(np.float32)
        self.assertEqual(mesh.carry_vertices(singles).dtype, np.float32)
        np.testing.assert_allclose(
            mesh.carry_vertices(singles), mesh.carry_vertices(singles.astype(float)), rtol=0, atol=1e-6
        )
        for values in (np.arange(count) * 1j, ["a"] * count):
            with self.assertRaises(TypeError):
                mesh.carry_vertices(values)

    def test_doubles_of_faces_keep_their_bits(self):
        mesh, _ = merge()
        count, origins = len(two_balls(2.05)[1]), mesh.face_map()
        values = np.random.default_rng(7).normal(size=(count, 3))
        values[0, 0] = np.nan
        carried, known = mesh.carry_triangles(values), origins != topoadapt.NONE
        np.testing.assert_array_equal(carried[known].view(np.uint64), values[origins[known]].view(np.uint64))
        self.assertLess((~known).sum(), 100)
        rows = {row.tobytes() for row in values}
        self.assertTrue(all(row.tobytes() in rows for row in carried[~known]))
        self.assertEqual(mesh.carry_triangles(np.zeros((count, 0))).shape, (len(origins), 0))

    def test_a_split_is_one_event(self):
        """A waist pulled through the axis leaves two halves, and what comes out of the middle."""
        vertices, faces = ball(edge_length=0.2)
        vertices = vertices * [1, 1, 2]
        mesh = Mesh(vertices, faces)
        mesh.move(vertices * np.where(np.abs(vertices[:, 2:]) < 0.35, [[-0.2, -0.2, 1]], 1))
        mesh.step()
        components = mesh.components()
        self.assertGreater(len(components), 1)
        splits = [event for event in mesh.events() if event.type == topoadapt.EventType.SPLIT]
        self.assertEqual(len(splits), 1)
        self.assertEqual(splits[0].amount, len(components))
        self.assertEqual(list(splits[0].pieces), [component.id for component in components])
        self.assertEqual((splits[0].before, splits[0].after), (0, components[0].id))

    def test_copies_are_read_only(self):
        mesh, _ = merge()
        copies = [mesh.vertices, mesh.faces, mesh.face_map(), mesh.rolled_back(), mesh.component_labels()]
        copies += [*mesh.vertex_map(), *mesh.changes()[:2], *mesh.targets()]
        for number, copied in enumerate(copies):
            with self.subTest(number=number), self.assertRaises(ValueError):
                copied[...] = 0
        vertices, faces, _ = topoadapt.resolve(*two_balls(1.5))
        vertices *= 0.5  # without a mesh the arrays are the caller's
        faces += 0
        mesh.carry_vertices(np.zeros(len(two_balls(2.05)[0])))[0] = 1

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
            targets = mesh.vertices[: 2 * len(a)].copy()
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
            lambda: mesh.move(vertices[:-1]),
            lambda: mesh.move(np.concatenate([vertices, vertices])),
            lambda: mesh.move(np.zeros((0, 3))),
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
        for call in (
            lambda: Mesh(vertices, faces.astype(float)),
            lambda: Mesh(vertex_limit=1),
            lambda: mesh.move(vertices * 1j),
            lambda: mesh.move([["0", "0", "0"]], [0]),
        ):
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


if __name__ == "__main__":
    unittest.main()
