#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""inputs_by_others.py TOOL: surfaces that VTK and nibabel write, and volumes of FreeSurfer that nibabel writes.

`resolve` of a mesh without intersections keeps vertices and triangles, so its .ply must hold those of the file. Each
encoding of VTK's XML and of GIfTI is one file. A volume in .mgz must give the mesh of the same voxels in NIfTI. Exit 77,
skipped, without VTK; GIfTI and .mgz are tried where nibabel is. Equal voxels in NIfTI, NRRD and MetaImage give equal
meshes, each in the world of its file.
"""
import json
import os
import subprocess
import sys
import tempfile

try:
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkPolyData
    from vtkmodules.vtkFiltersSources import vtkSphereSource
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
except ImportError:
    print("skipped: no VTK for Python")
    sys.exit(77)
try:
    import nibabel
except ImportError:
    nibabel = None

wrong = 0


def expect(holds, *what):
    global wrong
    if not holds:
        wrong += 1
        print("WRONG:", *what)


def ply(path):
    with open(path, "rb") as file:
        head, body = file.read().split(b"end_header\n", 1)
    vertices, faces = [int(line.split()[2]) for line in head.decode().split("\n") if line.startswith("element")]
    points = numpy.frombuffer(body, "<f8", 3 * vertices).reshape(-1, 3)
    face = numpy.dtype([("n", "u1"), ("v", "<u4", 3)])
    return points, numpy.frombuffer(body[24 * vertices:], face, faces)["v"]


def sphere():
    source = vtkSphereSource()
    source.SetThetaResolution(13)
    source.SetPhiResolution(9)
    source.SetRadius(2.5)
    source.Update()
    data = vtkPolyData()
    data.ShallowCopy(source.GetOutput())
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    return data, points, vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def is_kept(tool, folder, path, points, triangles):
    out = os.path.join(folder, "out.ply")
    done = subprocess.run([tool, "resolve", path, "--out", out], capture_output=True, text=True)
    expect(done.returncode == 0, path, done.stderr)
    if done.returncode == 0:
        ours = ply(out)
        expect(numpy.array_equal(ours[0], points) and numpy.array_equal(ours[1], triangles), path, "differs")
        os.remove(out)


def by_vtk(tool, folder):
    data, points, triangles = sphere()
    for mode in ("Ascii", "Binary", "Appended"):
        for packed in (False, True):
            for order in ("BigEndian", "LittleEndian"):
                for width in ("32", "64"):
                    for encoded in (0, 1) if mode == "Appended" else (0,):
                        name = "%s-%d-%s-%s-%d.vtp" % (mode, packed, order, width, encoded)
                        writer = vtkXMLPolyDataWriter()
                        writer.SetFileName(os.path.join(folder, name))
                        writer.SetInputData(data)
                        getattr(writer, "SetDataModeTo" + mode)()
                        writer.SetEncodeAppendedData(encoded)
                        getattr(writer, "SetByteOrderTo" + order)()
                        getattr(writer, "SetHeaderTypeToUInt" + width)()
                        if packed:
                            writer.SetCompressorTypeToZLib()
                            writer.SetBlockSize(1024)
                        else:
                            writer.SetCompressorTypeToNone()
                        expect(writer.Write() == 1, name)
                        is_kept(tool, folder, os.path.join(folder, name), points, triangles)
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(os.path.join(folder, "lz4.vtp"))
    writer.SetInputData(data)
    writer.SetCompressorTypeToLZ4()
    writer.Write()
    call = [tool, "resolve", os.path.join(folder, "lz4.vtp"), "--out", os.path.join(folder, "out.ply")]
    done = subprocess.run(call, capture_output=True, text=True)
    expect(done.returncode == 2 and "vtkLZ4DataCompressor" in done.stderr, "LZ4", done.stderr)


def by_nibabel(tool, folder):
    _, points, triangles = sphere()
    for encoding in ("ASCII", "B64BIN", "B64GZ"):
        # nibabel's text has rows whatever the order says.
        for order in ("C",) if encoding == "ASCII" else ("C", "F"):
            path = os.path.join(folder, "%s-%s.gii" % (encoding, order))
            arrays = [
                nibabel.gifti.GiftiDataArray(array, intent=intent, datatype=kind, encoding=encoding, ordering=order)
                for array, intent, kind in ((points.astype("<f4"), "NIFTI_INTENT_POINTSET", "NIFTI_TYPE_FLOAT32"),
                                            (triangles.astype("<i4"), "NIFTI_INTENT_TRIANGLE", "NIFTI_TYPE_INT32"))]
            nibabel.save(nibabel.gifti.GiftiImage(darrays=arrays), path)
            # nibabel prints six decimals.
            text = points
            if encoding == "ASCII":
                text = numpy.array([float("%.6f" % x) for x in points.reshape(-1)]).reshape(-1, 3)
            is_kept(tool, folder, path, text, triangles)


def volumes(tool, folder):
    k, j, i = numpy.meshgrid(numpy.arange(16), numpy.arange(18), numpy.arange(20), indexing="ij")
    ball = numpy.clip(200 - 60 * (numpy.sqrt((i - 9)**2 + (j - 8)**2 + (k - 8)**2) - 5), 0, 400).T
    affine = numpy.array([[-0.75, 0.0, 0.25, 30], [0.0, 0.5, 1.0, -7], [0.25, -1.0, 0.5, 4], [0, 0, 0, 1]])
    affine[:3, :3] = numpy.linalg.qr(affine[:3, :3])[0] * [0.75, 1.25, 1.5]
    seed = affine @ [9, 8, 8, 1]
    for kind in ("u1", ">i2", ">i4", ">f4"):
        values = numpy.clip(ball, 0, 255).astype(kind) if kind == "u1" else ball.astype(kind)
        path = os.path.join(folder, "v.mgz")
        nibabel.save(nibabel.freesurfer.MGHImage(values, affine), path)
        out = os.path.join(folder, "v.ply")
        done = subprocess.run([tool, "segment", path, "--seed-mm=%r,%r,%r" % tuple(seed[:3]), "--lower", "100.5", "--out", out],
                              capture_output=True, text=True)
        expect(done.returncode == 0, "mgz", kind, done.stderr)
        points, _ = ply(out)
        # Distances from the centre, in voxels: the ball is one of grey values above 100.5.
        away = numpy.linalg.norm((points - seed[:3]) @ numpy.linalg.inv(affine[:3, :3]).T, axis=1)
        expect(abs(away - 6.6).max() < 0.4, "mgz", kind, away.min(), away.max())
        # The same place in LPS.
        lps = seed[:3] * [-1, -1, 1]
        done = subprocess.run([tool, "segment", path, "--space", "lps", "--seed-mm=%r,%r,%r" % tuple(lps), "--lower", "100.5",
                               "--out", out], capture_output=True, text=True)
        expect(done.returncode == 0, "mgz, LPS", kind, done.stderr)
        turned, _ = ply(out)
        expect(len(turned) == len(points) and abs(turned * [-1, -1, 1] - points).max() < 1e-9, "mgz, LPS", kind)
    times = numpy.stack([numpy.zeros_like(ball), ball], 3).astype(">f4")
    path = os.path.join(folder, "times.mgh")
    nibabel.save(nibabel.freesurfer.MGHImage(times, affine), path)
    call = [tool, "segment", path, "--seed", "9,8,8", "--lower", "100.5"]
    done = subprocess.run(call, capture_output=True, text=True)
    expect(done.returncode == 2 and "2 time points" in done.stderr, "times", done.stderr)
    done = subprocess.run(call + ["--time", "1"], capture_output=True, text=True)
    expect(done.returncode == 0, "time 1", done.stderr)
    with open(path, "rb") as file:
        cut = file.read()[:-5000]
    with open(path, "wb") as file:
        file.write(cut)
    done = subprocess.run(call + ["--time", "1"], capture_output=True, text=True)
    expect(done.returncode == 2 and path in done.stderr, "cut off", done.stderr)


def formats(tool, folder):
    """A ball in noise, and the same from a place in each world, so that chance decides about vertices and triangles."""
    k, j, i = numpy.meshgrid(numpy.arange(20), numpy.arange(22), numpy.arange(24), indexing="ij")
    noise = numpy.random.default_rng(1).normal(0, 25, i.shape)
    ball = numpy.clip(200 - 60 * (numpy.sqrt((i - 11)**2 + (j - 10)**2 + (k - 9)**2) - 6) + noise, 0, 400).astype("<f4")
    # Directions that 32 bits hold.
    ras = numpy.array([[0, -1.25, 0, 30], [0.75, 0, 0, -7], [0, 0, 1.5, 4], [0, 0, 0, 1]])
    lps = numpy.diag([-1, -1, 1, 1]) @ ras
    nibabel.save(nibabel.Nifti1Image(ball.T, ras), os.path.join(folder, "f.nii"))
    text = lambda numbers, between: between.join("%r" % float(x) for x in numbers)
    with open(os.path.join(folder, "f.nrrd"), "wb") as file:
        file.write(("NRRD0004\ntype: float\ndimension: 3\nsizes: 24 22 20\nencoding: raw\nendian: little\n"
                    "space: left-posterior-superior\nspace directions: %s\nspace origin: (%s)\n\n" %
                    (" ".join("(%s)" % text(lps[:3, axis], ",") for axis in range(3)), text(lps[:3, 3], ","))).encode())
        file.write(ball.tobytes())
    spacing = numpy.abs(lps[:3, :3]).max(axis=0)
    with open(os.path.join(folder, "f.mha"), "wb") as file:
        file.write(("ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
                    "TransformMatrix = %s\nOffset = %s\nElementSpacing = %s\nDimSize = 24 22 20\n"
                    "ElementType = MET_FLOAT\nElementDataFile = LOCAL\n" %
                    (text((lps[:3, :3] / spacing).T.reshape(-1), " "), text(lps[:3, 3], " "), text(spacing, " "))).encode())
        file.write(ball.tobytes())
    meshes = {}
    for name, turn, affine in (("f.nii", [-1, -1, 1], ras), ("f.nrrd", [1, 1, 1], lps), ("f.mha", [1, 1, 1], lps)):
        for options in (["--seed", "11,10,9"], ["--seed-mm=%s" % text((affine @ [11, 10, 9, 1])[:3], ",")]):
            path, out = os.path.join(folder, name), os.path.join(folder, "f.ply")
            report = os.path.join(folder, "f.json")
            done = subprocess.run([tool, "segment", path, *options, "--lower", "100.5", "--json", report, "--out", out],
                                  capture_output=True, text=True)
            expect(done.returncode == 0, name, done.stderr)
            points, triangles = ply(out)
            expect(len(points) > 300, name, len(points))
            meshes[name, options[0]] = points * turn, triangles
            with open(report) as file:
                told = json.load(file)
            expect(told["space"] == ("ras" if name == "f.nii" else "lps"), name, told["space"])
            expect(numpy.array_equal(told["options"]["seeds_mm"][0], (affine @ [11, 10, 9, 1])[:3]), name, "seed")
    first = meshes["f.nrrd", "--seed"]
    for name, (points, triangles) in meshes.items():
        expect(numpy.array_equal(points, first[0]) and numpy.array_equal(triangles, first[1]), name, "is not that of NRRD")


def main():
    tool = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        by_vtk(tool, folder)
        if nibabel:
            by_nibabel(tool, folder)
            volumes(tool, folder)
            formats(tool, folder)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
