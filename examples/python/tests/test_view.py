# SPDX-License-Identifier: MIT
"""Arrays over the memory of the library never dangle, and never change under their reader."""

import gc
import threading
import unittest
import weakref

import numpy as np

from topoadapt import Mesh, ViewError, ball
from bodies import two_balls

ARRAYS = ("vertices", "faces", "opposites", "old_to_new", "origins", "face_origins")


def writing_calls(mesh):
    vertices, faces = ball()
    data = mesh.save()
    return [
        lambda: mesh.load(vertices, faces),
        lambda: mesh.move(vertices),
        mesh.step,
        mesh.adapt,
        lambda: mesh.remesh(0.3),
        mesh.smooth,
        mesh.detect,
        mesh.validate,
        lambda: mesh.restore(data),
        mesh.drop_targets,
        mesh.reset,
    ]


class Views(unittest.TestCase):
    def setUp(self):
        self.mesh = Mesh(*ball())

    def test_arrays_are_no_copies(self):
        with self.mesh.view() as view:
            for name in ARRAYS:
                first, second = getattr(view, name), getattr(view, name)
                self.assertEqual(first.ctypes.data, second.ctypes.data, name)
                self.assertTrue(np.shares_memory(first, self.mesh._block._data), name)
            np.testing.assert_array_equal(view.vertices, ball()[0])
            np.testing.assert_array_equal(view.faces, ball()[1])
            half_edges = np.arange(view.opposites.size)
            np.testing.assert_array_equal(view.opposites.ravel()[view.opposites.ravel()], half_edges)

    def test_arrays_are_read_only_for_good(self):
        with self.mesh.view() as view:
            for name in ARRAYS:
                array = getattr(view, name)
                with self.assertRaises(ValueError):
                    array[0] = 0
                with self.assertRaises(ValueError):
                    array.flags.writeable = True

    def test_no_call_writes_while_a_view_is_open(self):
        calls = writing_calls(self.mesh)
        digest = self.mesh.digest()
        with self.mesh.view():
            for number, call in enumerate(calls):
                with self.subTest(number=number), self.assertRaises(ViewError):
                    call()
        self.assertEqual(self.mesh.digest(), digest)
        for call in calls:
            call()

    def test_no_call_writes_while_an_array_is_left(self):
        derived = {
            "array": lambda a: a,
            "part": lambda a: a[3:5, 1],
            "transposed": lambda a: a.T[::-1],
            "memoryview": memoryview,
            "in a list": lambda a: [a.reshape(-1)[:4]],
            "other class": lambda a: a.view(type("Other", (np.ndarray,), {})),
            "other type": lambda a: a.view(np.uint8),
        }
        for name, make in derived.items():
            with self.subTest(name):
                with self.mesh.view() as view:
                    left = make(view.vertices)
                with self.assertRaises(ViewError):
                    self.mesh.remesh(0.3)
                del left
                self.mesh.remesh(0.3)

    def test_copies_and_results_are_free(self):
        with self.mesh.view() as view:
            kept = [view.vertices.copy(), view.vertices * 2, view.faces[[0, 1]], view.vertices.sum()]
        kept += [self.mesh.vertices, self.mesh.faces, self.mesh.vertex_map(), self.mesh.face_map()]
        self.mesh.remesh(0.3)
        self.assertEqual(len(kept), 8)

    def test_arrays_in_cycles_are_none(self):
        with self.mesh.view() as view:
            cycle = [view.vertices]
            cycle.append(cycle)
        del cycle
        self.mesh.remesh(0.3)

    def test_a_closed_view_raises(self):
        with self.mesh.view() as view:
            pass
        for name in ARRAYS + ("epoch", "rolled_back"):
            with self.assertRaises(ViewError):
                getattr(view, name)
        with self.assertRaises(ViewError):
            self.mesh.view().vertices
        with view, self.assertRaises(ViewError):
            view.__enter__()

    def test_an_array_outlives_its_mesh(self):
        mesh = Mesh(*ball())
        with mesh.view() as view:
            left = view.vertices[10:]
        block = weakref.ref(mesh._block)
        del mesh, view
        gc.collect()
        self.assertIsNotNone(block())
        np.testing.assert_array_equal(left, ball()[0][10:])
        del left
        gc.collect()
        self.assertIsNone(block())

    def test_growing_leaves_arrays_alone(self):
        with self.mesh.view() as view:
            left = view.vertices
            self.mesh.grow(max_vertices=50000)
            np.testing.assert_array_equal(left, view.vertices)
            self.assertNotEqual(left.ctypes.data, view.vertices.ctypes.data)
        np.testing.assert_array_equal(left, ball()[0])

    def test_an_error_closes_the_view(self):
        with self.assertRaises(KeyError):
            with self.mesh.view():
                raise KeyError
        self.mesh.remesh(0.3)

    def test_readers_and_a_writer_on_threads(self):
        """A writer among readers either finds no view and works, or raises ViewError; readers never see it work."""
        mesh, torn, stop = Mesh(*two_balls(3)), [], threading.Event()

        def reader():
            while not stop.is_set():
                with mesh.view() as view:
                    first = view.vertices.copy()
                    if not np.array_equal(first, view.vertices) or view.faces.max() >= len(first):
                        torn.append(len(first))

        threads = [threading.Thread(target=reader) for _ in range(2)]
        for thread in threads:
            thread.start()
        worked = 0
        for n in range(2000):
            try:
                mesh.remesh(0.25 + 0.01 * (n % 5))
                worked += 1
            except ViewError:
                pass
            if worked == 20:
                break
        stop.set()
        for thread in threads:
            thread.join()
        self.assertEqual(torn, [])

    def test_copies_and_a_writer_on_threads(self):
        """Calls that return copies, and calls that write, wait for each other."""
        mesh, failed, stop = Mesh(*two_balls(3)), [], threading.Event()

        def reader():
            try:
                while not stop.is_set():
                    for read in (lambda: mesh.vertices, lambda: mesh.epoch, mesh.vertex_map, mesh.face_map, mesh.save):
                        read()
            except ViewError as error:
                failed.append(error)

        threads = [threading.Thread(target=reader) for _ in range(2)]
        for thread in threads:
            thread.start()
        try:
            for n in range(20):
                mesh.remesh(0.25 + 0.01 * (n % 5))
        finally:
            stop.set()
            for thread in threads:
                thread.join()
        self.assertEqual(failed, [])


if __name__ == "__main__":
    unittest.main()
