#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""outputs_by_others.py TOOL: meshes and masks of `segment` as VTK, nibabel and numpy read them.

Every mesh format must hold the vertices and triangles of the .ply of the same run (GIfTI in RAS, as floats), and name
the space where 3D Slicer looks for it. The mask must lie in the input's grid, and hold the voxels that VTK's stencil
finds inside the mesh. Exit 77, skipped, without VTK; GIfTI and masks in NIfTI are compared where nibabel is.
"""
import os
import subprocess
import sys
import tempfile

try:
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkImagingStencil import vtkImageStencil, vtkPolyDataToImageStencil
    from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
    from vtkmodules.vtkIOLegacy import vtkPolyDataReader
    from vtkmodules.vtkIOPLY import vtkPLYReader
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
except ImportError:
    print("skipped: no VTK for Python")
    sys.exit(77)
try:
    import nibabel
except ImportError:
    nibabel = None

SIZES = (24, 20, 16)
# One voxel along each axis, and the origin, LPS: oblique and mirrored.
AXES = numpy.array([[0.8, 0.3, 0.0], [-0.3, 0.8, 0.1], [0.0, 0.2, -1.5]])
ORIGIN = numpy.array([10.0, -30.0, 55.0])
wrong = 0


def expect(holds, *what):
    global wrong
    if not holds:
        wrong += 1
        print("WRONG:", *what)


def write_nrrd(path, values, space):
    """Voxels k, j, i."""
    sign = -1 if space == "RAS" else 1
    turn = numpy.array([sign, sign, 1])
    vectors = ["(%r,%r,%r)" % tuple(float(x) for x in axis * turn) for axis in AXES]
    head = "NRRD0004\ntype: short\ndimension: 3\nspace: %s\nsizes: %d %d %d\nspace directions: %s\nspace origin: (%r,%r,%r)\n" % (
        (space,) + SIZES + (" ".join(vectors),) + tuple(float(x) for x in ORIGIN * turn))
    with open(path, "wb") as file:
        file.write((head + "endian: little\nencoding: raw\n\n").encode() + values.astype("<i2").tobytes())


def volume():
    k, j, i = numpy.meshgrid(*(numpy.arange(n) for n in reversed(SIZES)), indexing="ij")
    ball = (((i - 9) / 6)**2 + ((j - 9) / 6)**2 + ((k - 8) / 5)**2 < 1)
    arm = (abs(j - 12) < 3) & (abs(k - 8) < 3) & (i > 8) & (i < 20)
    return numpy.where(ball | arm, 200, 0)


def by_vtk(reader, path):
    reader.SetFileName(path)
    reader.Update()
    data = reader.GetOutput()
    points = vtk_to_numpy(data.GetPoints().GetData())
    return data, points, vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def ply(path):
    with open(path, "rb") as file:
        head, body = file.read().split(b"end_header\n", 1)
    lines = head.decode().split("\n")
    vertices, faces = [int(line.split()[2]) for line in lines if line.startswith("element")]
    points = numpy.frombuffer(body, "<f8", 3 * vertices).reshape(-1, 3)
    triangles = numpy.frombuffer(body, numpy.dtype([("n", "u1"), ("v", "<i4", 3)]), faces, 24 * vertices)["v"]
    return points, triangles, [line for line in lines if line.startswith("comment")]


def check_meshes(folder, space):
    points, triangles, comments = ply(os.path.join(folder, "m.ply"))
    mark = "SPACE=" + space
    expect(any(mark in line for line in comments), "PLY comment", comments)
    data, p, t = by_vtk(vtkXMLPolyDataReader(), os.path.join(folder, "m.vtp"))
    expect(numpy.array_equal(p, points) and numpy.array_equal(t, triangles), "vtp", p.shape, t.shape)
    field = data.GetFieldData().GetAbstractArray("SPACE")
    expect(field is not None and field.GetValue(0) == space, "vtp SPACE", field)
    reader = vtkPolyDataReader()
    data, p, t = by_vtk(reader, os.path.join(folder, "m.vtk"))
    expect(numpy.array_equal(p, points) and numpy.array_equal(t, triangles), "vtk", p.shape, t.shape)
    expect(mark in reader.GetHeader(), "vtk title", reader.GetHeader())
    reader = vtkPLYReader()
    _, p, t = by_vtk(reader, os.path.join(folder, "m.ply"))
    expect(numpy.allclose(p, points, atol=1e-4) and numpy.array_equal(t, triangles), "ply by VTK")
    expect(mark in reader.GetComments().GetValue(0), "ply comment by VTK")
    _, p, t = by_vtk(vtkOBJReader(), os.path.join(folder, "m.obj"))
    expect(numpy.allclose(p, points, atol=1e-4) and numpy.array_equal(t, triangles), "obj by VTK")
    reader = vtkSTLReader()
    _, p, _ = by_vtk(reader, os.path.join(folder, "m.stl"))
    expect(len(p) == len(points) and mark in reader.GetHeader(), "stl", reader.GetHeader())
    if nibabel is None:
        print("no nibabel: GIfTI is not compared")
        return
    gifti = nibabel.load(os.path.join(folder, "m.gii"))
    p, t = gifti.agg_data("pointset"), gifti.agg_data("triangle")
    ras = points * ([-1, -1, 1] if space == "LPS" else [1, 1, 1])
    expect(numpy.array_equal(p, ras.astype("<f4")) and numpy.array_equal(t, triangles), "gii", p.shape, t.shape)


def stencilled(folder):
    """1 for voxels that VTK finds inside the mesh, in a grid turned to the axes."""
    data, points, _ = by_vtk(vtkXMLPolyDataReader(), os.path.join(folder, "m.vtp"))
    turn = numpy.array([-1, -1, 1]) if data.GetFieldData().GetAbstractArray("SPACE").GetValue(0) == "RAS" else numpy.ones(3)
    indices = (points * turn - ORIGIN) @ numpy.linalg.inv(AXES)
    data.GetPoints().SetData(numpy_to_vtk(numpy.ascontiguousarray(indices), deep=True))
    stencil = vtkPolyDataToImageStencil()
    stencil.SetInputData(data)
    stencil.SetOutputWholeExtent(0, SIZES[0] - 1, 0, SIZES[1] - 1, 0, SIZES[2] - 1)
    stencil.SetTolerance(0)
    stencil.Update()
    image = vtkImageData()
    image.SetDimensions(*SIZES)
    image.AllocateScalars(3, 1)
    vtk_to_numpy(image.GetPointData().GetScalars())[:] = 1
    cut = vtkImageStencil()
    cut.SetInputData(image)
    cut.SetStencilConnection(stencil.GetOutputPort())
    cut.SetBackgroundValue(0)
    cut.Update()
    return vtk_to_numpy(cut.GetOutput().GetPointData().GetScalars()).reshape(tuple(reversed(SIZES)))


def check_masks(folder, space, gzip):
    inside = stencilled(folder)
    with open(os.path.join(folder, "mask.nrrd"), "rb") as file:
        head, body = file.read().split(b"\n\n", 1)
    numbers = gzip.decompress(body) if b"encoding: gzip" in head else body
    mask = numpy.frombuffer(numbers, "u1").reshape(tuple(reversed(SIZES)))
    expect(numpy.array_equal(mask, inside) and inside.sum() > 800, "mask", (mask != inside).sum(), inside.sum())
    if nibabel is None:
        return
    for name in ("mask.nii", "mask.nii.gz"):
        image = nibabel.load(os.path.join(folder, name))
        values = numpy.asarray(image.dataobj).transpose(2, 1, 0)
        expect(numpy.array_equal(values, inside), name)
        affine = numpy.eye(4)
        affine[:3, :3], affine[:3, 3] = AXES.T, ORIGIN
        affine[:2] *= -1  # to RAS
        expect(numpy.allclose(image.affine, affine, atol=1e-5), name, image.affine)


def main():
    import gzip
    tool = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        source = os.path.join(folder, "v.nrrd")
        for space in ("LPS", "RAS"):
            write_nrrd(source, volume(), space)
            call = [tool, "segment", source, "--seed", "9,9,8", "--lower", "100", "--quiet"]
            for out, mask in (("m.ply", "mask.nrrd"), ("m.vtp", "mask.nii"), ("m.vtk", "mask.nii.gz"), ("m.gii", None),
                              ("m.obj", None), ("m.stl", None)):
                more = ["--mask", os.path.join(folder, mask)] if mask else []
                done = subprocess.run(call + ["--out", os.path.join(folder, out)] + more, stdout=subprocess.DEVNULL)
                expect(done.returncode == 0, out, done.returncode)
            check_meshes(folder, space)
            check_masks(folder, space, gzip)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
