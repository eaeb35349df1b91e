# SPDX-License-Identifier: MIT
"""Meshes of other packages, and arrays of all forms."""

import importlib.util
import unittest

import numpy as np

import topoadapt
from topoadapt import Mesh, ball
from bodies import two_balls


class Shapes(unittest.TestCase):
    """Meshes of other packages, by their attributes."""

    class Trimesh:
        def __init__(self, vertices=None, faces=None, process=True):
            self.vertices, self.faces, self.process = np.asarray(vertices), np.asarray(faces, np.int64), process

    class Meshio:
        def __init__(self, points, cells):
            self.points, self.cells_dict = points, dict(cells)

    class PolyData:
        def __init__(self, var_inp=None, faces=None):
            self.points, self.faces = np.asarray(var_inp), np.asarray(faces)

    def test_round_trip(self):
        vertices, faces = two_balls(1.5)
        plain = topoadapt.resolve(vertices, faces)
        row = np.concatenate([np.full((len(faces), 1), 3), faces], axis=1).ravel()
        for example in (
            self.Trimesh(vertices, faces),
            self.Meshio(vertices, [("triangle", faces)]),
            self.PolyData(vertices, row),
        ):
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
            ("pyvista", lambda m: m.PolyData(vertices, np.insert(faces.astype(np.int64), 0, 3, axis=1).ravel())),
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
        for row in ([4, 0, 1, 2, 3], [3, 0, 1, 2, 4, 0, 1, 2, 3], [3, 0, 1]):
            with self.assertRaises(ValueError):
                Mesh(self.PolyData(vertices, row))
        with self.assertRaises(TypeError):
            Mesh(3)

    @unittest.skipUnless(importlib.util.find_spec("vtkmodules"), "no VTK")
    def test_rows_are_those_of_vtk(self):
        from vtkmodules.util import numpy_support
        from vtkmodules.vtkFiltersSources import vtkSphereSource

        source = vtkSphereSource()
        source.Update()
        data, to_numpy = source.GetOutput(), numpy_support.vtk_to_numpy
        shape = self.PolyData(to_numpy(data.GetPoints().GetData()), to_numpy(data.GetPolys().GetData()))
        mesh = Mesh(shape)
        self.assertEqual((mesh.validate().genus, len(mesh.faces)), (0, data.GetNumberOfPolys()))
        self.assertEqual(topoadapt.like(shape, mesh.vertices, mesh.faces).faces.tolist(), shape.faces.tolist())

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
