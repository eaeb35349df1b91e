#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Segmentation beside its peers, in one run: ITK's ThresholdSegmentationLevelSet, VTK's flying edges and scikit-image's
marching cubes, on the phantoms of the paper and on real volumes.

    segment_table.py BUILD [--itk SECONDS] [--volumes FOLDER] [--noise-seeds N] [--only NAME]... [--json F]

BUILD is a folder with the tool `topoadapt` and `tests/bench/segment_peers` (targets topoadapt_tool, segment_peers).
FOLDER has engine.nii.gz, tooth.nhdr and avf_float_32.nii.gz. Needs python3-vtk9 and python3-skimage. Seconds are of processor time, on one
thread; ITK ends after the SECONDS given for each volume, and its row says so by a + behind its time, unless it came to
rest before. Marching cubes keep the largest component of the isosurface. Columns: seconds; triangles; Dice with the voxels of
the true object (of the phantom, or of the component beyond the threshold round the seed); mean and largest distance of
vertices to the true surface (exact for phantoms, else the trilinear isosurface by marching cubes) in voxels; components
and genus; edges without two triangles; pairs of triangles that meet (`topoadapt detect`).
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time

try:
    import numpy
    import skimage.measure
    import vtk
    from vtk.util import numpy_support
except ImportError as missing:
    sys.exit(f"segment_table.py: skipped, {missing} (python3-vtk9, python3-skimage)")

PHANTOMS = ("cyst", "cube-cavity", "genus-3", "torus-nested")
VOLUMES = {  # sigma and seed in voxels
    "tooth": ("tooth.nhdr", 0.7, 600, "50,50,80"),
    "fistula": ("avf_float_32.nii.gz", 0.0, 800, "18,40,10"),
    "engine": ("engine.nii.gz", 1.0, 80, "144,120,23"),
}


def run(command):
    """Output of a command and its processor seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def output_of(command):
    done, _ = run(command)
    if done.returncode != 0:
        sys.exit(f"segment_table.py: {' '.join(map(str, command))}: {done.stderr.strip()}")
    return done.stdout


def poly_data(vertices, triangles):
    data = vtk.vtkPolyData()
    points = vtk.vtkPoints()
    points.SetData(numpy_support.numpy_to_vtk(numpy.ascontiguousarray(vertices, dtype=numpy.float64), deep=True))
    cells = vtk.vtkCellArray()
    rows = numpy.hstack([numpy.full((len(triangles), 1), 3), triangles]).astype(numpy.int64)
    cells.ImportLegacyFormat(numpy_support.numpy_to_vtkIdTypeArray(numpy.ascontiguousarray(rows.ravel()), deep=True))
    data.SetPoints(points)
    data.SetPolys(cells)
    return data


def arrays_of(data):
    vertices = numpy_support.vtk_to_numpy(data.GetPoints().GetData()).astype(numpy.float64)
    triangles = numpy_support.vtk_to_numpy(data.GetPolys().GetData()).reshape(-1, 4)[:, 1:]
    return vertices, triangles


def image_of(values):
    image = vtk.vtkImageData()
    image.SetDimensions(values.shape[::-1])
    image.GetPointData().SetScalars(numpy_support.numpy_to_vtk(values.ravel(), deep=True))
    return image


def labels_of(count, triangles):
    """A label for each vertex: the least vertex of its component."""
    label = numpy.arange(count)
    while True:
        least = label[triangles].min(axis=1)
        following = label.copy()
        for corner in range(3):
            numpy.minimum.at(following, triangles[:, corner], least)
        following = following[following]
        if (following == label).all():
            return label
        label = following


def largest_component(vertices, triangles):
    label = labels_of(len(vertices), triangles)
    counts = numpy.bincount(label[triangles[:, 0]], minlength=len(vertices))
    kept = triangles[label[triangles[:, 0]] == counts.argmax()]
    used, inverse = numpy.unique(kept, return_inverse=True)
    return vertices[used], inverse.reshape(-1, 3)


def isosurface(values, threshold):
    vertices, triangles, _, _ = skimage.measure.marching_cubes(values, threshold)
    return vertices[:, ::-1].astype(numpy.float64), triangles


def by_skimage(values, threshold):
    return largest_component(*isosurface(values, threshold))


def by_vtk(values, threshold):
    image = image_of(values)
    start = time.process_time()
    edges = vtk.vtkFlyingEdges3D()
    edges.SetInputData(image)
    edges.SetValue(0, threshold)
    edges.ComputeNormalsOff()
    largest = vtk.vtkPolyDataConnectivityFilter()
    largest.SetInputConnection(edges.GetOutputPort())
    largest.SetExtractionModeToLargestRegion()
    clean = vtk.vtkCleanPolyData()
    clean.PointMergingOff()
    clean.SetInputConnection(largest.GetOutputPort())
    clean.Update()
    seconds = time.process_time() - start
    return arrays_of(clean.GetOutput()), seconds


def dice(vertices, triangles, object_mask, undecided):
    """Voxels on the true surface do not count."""
    stencil = vtk.vtkPolyDataToImageStencil()
    stencil.SetInputData(poly_data(vertices, triangles))
    depth, height, width = object_mask.shape
    stencil.SetOutputWholeExtent(0, width - 1, 0, height - 1, 0, depth - 1)
    stencil.SetTolerance(0)
    to_image = vtk.vtkImageStencilToImage()
    to_image.SetInputConnection(stencil.GetOutputPort())
    to_image.SetInsideValue(1)
    to_image.SetOutsideValue(0)
    to_image.SetOutputScalarTypeToUnsignedChar()
    to_image.Update()
    inside = numpy_support.vtk_to_numpy(to_image.GetOutput().GetPointData().GetScalars()).reshape(object_mask.shape) > 0
    inside &= ~undecided
    return 2 * (inside & object_mask).sum() / (inside.sum() + object_mask.sum())


def distances(vertices, surface):
    locator = vtk.vtkStaticCellLocator()
    locator.SetDataSet(poly_data(*surface))
    locator.BuildLocator()
    point, cell, part, squared = [0.0] * 3, vtk.reference(0), vtk.reference(0), vtk.reference(0.0)
    found = numpy.empty(len(vertices))
    for i, place in enumerate(vertices):
        locator.FindClosestPoint(place, point, cell, part, squared)
        found[i] = squared.get() ** 0.5
    return found.mean(), found.max()


def write_off(path, vertices, triangles):
    with open(path, "w", encoding="ascii") as out:
        out.write(f"OFF\n{len(vertices)} {len(triangles)} 0\n")
        numpy.savetxt(out, vertices, fmt="%.17g")
        numpy.savetxt(out, numpy.hstack([numpy.full((len(triangles), 1), 3), triangles]), fmt="%d")


def measure(case, who, seconds, vertices, triangles):
    """A row of the table."""
    row = {"case": case["name"], "who": who, "seconds": seconds, "triangles": len(triangles)}
    if len(triangles) == 0:
        return row
    row["dice"] = dice(vertices, triangles, case["object"], case["undecided"])
    mesh = os.path.join(case["folder"], "judged.off")
    write_off(mesh, vertices, triangles)
    if case["phantom"]:
        row["mean"], row["largest"] = json.loads(output_of([case["peers"], "distance", case["phantom"], mesh]))
    elif who != "scikit-image":
        row["mean"], row["largest"] = distances(vertices, case["surface"])
    edges = numpy.sort(numpy.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    _, uses = numpy.unique(edges, axis=0, return_counts=True)
    row["bad_edges"] = int((uses != 2).sum())
    row["components"] = len(numpy.unique(labels_of(len(vertices), triangles)))
    row["genus"] = (2 * row["components"] - (len(vertices) - len(uses) + len(triangles))) / 2
    report = os.path.join(case["folder"], "detect.json")
    run([case["tool"], "detect", mesh, "--quiet", "--json", report])
    if os.path.exists(report):
        with open(report, encoding="utf-8") as text:
            row["pairs"] = json.load(text).get("self_intersections")
        os.remove(report)
    return row


def rows_of(case):
    values, threshold = case["values"], case["threshold"]
    mesh, report = os.path.join(case["folder"], "ours.off"), os.path.join(case["folder"], "ours.json")
    command = [case["tool"], "segment", case["prefix"] + ".nrrd", "--seed", ",".join(map(repr, case["seed"]))]
    command += ["--threshold", threshold, "--radius", case["radius"], "--out", mesh, "--json", report, "--quiet"]
    done, seconds = run(command + (["--bright"] if case["bright"] else []))
    if not os.path.exists(mesh):
        sys.exit(f"segment_table.py: {done.stderr}")
    vertices, triangles = read_off(mesh)
    yield measure(case, "topoadapt", seconds, vertices, triangles)
    start = time.process_time()
    surface = by_skimage(values, threshold)
    seconds = time.process_time() - start
    yield measure(case, "scikit-image", seconds, *surface)
    (vertices, triangles), seconds = by_vtk(values, threshold)
    yield measure(case, "VTK", seconds, vertices, triangles)
    if os.path.exists(case["prefix"] + ".level"):
        level = numpy.fromfile(case["prefix"] + ".level", dtype="<f4").reshape(values.shape)
        row = measure(case, "ITK", case["itk_seconds"], *by_skimage(level, 0))
        row["at_rest"] = case["itk_at_rest"]
        yield row


def read_off(path):
    with open(path, encoding="ascii") as text:
        words = text.read().split()
    count, faces = int(words[1]), int(words[2])
    vertices = numpy.array(words[4 : 4 + 3 * count], dtype=float).reshape(-1, 3)
    triangles = numpy.array(words[4 + 3 * count :][: 4 * faces], dtype=numpy.int64).reshape(-1, 4)[:, 1:]
    return vertices, triangles


def prepare(options, folder, name, words, phantom):
    prefix = os.path.join(folder, name)
    peers = os.path.join(options.build, "tests", "bench", "segment_peers")
    case = json.loads(output_of([peers, "case", prefix] + (["--itk", options.itk] if options.itk else []) + words))
    width, height, depth = case["size"]
    case.update(name=name, folder=folder, prefix=prefix, peers=peers, phantom=phantom)
    case["tool"] = os.path.join(options.build, "topoadapt")
    voxels = numpy.fromfile(prefix + ".object", dtype=numpy.uint8).reshape(depth, height, width)
    case["object"], case["undecided"] = voxels == 1, voxels == 2
    with open(prefix + ".nrrd", "rb") as volume:
        grey = volume.read()[-4 * width * height * depth :]
    case["values"] = numpy.frombuffer(grey, dtype="<f4").reshape(depth, height, width).copy()
    if not phantom:  # marching cubes of the component alone, from which distances are measured
        near = numpy.pad(case["object"], 1)
        grown = near.copy()
        for axis in range(3):
            for way in (-1, 1):
                grown |= numpy.roll(grown, way, axis)
        case["surface"] = isosurface(numpy.where(grown[1:-1, 1:-1, 1:-1], case["values"], 0), case["threshold"])
    return case


def cases(options, folder):
    for name in PHANTOMS:
        for seed in range(1, options.noise_seeds + 1):
            if not options.only or name in options.only:
                yield prepare(options, folder, name, ["phantom", name, seed], name)
    for name, (file, sigma, threshold, seed) in VOLUMES.items():
        path = os.path.join(options.volumes or "", file)
        if options.volumes and os.path.exists(path) and (not options.only or name in options.only):
            yield prepare(options, folder, name, ["volume", path, sigma, threshold, seed], None)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("--itk", metavar="SECONDS", help="processor seconds at most for each volume")
    parser.add_argument("--volumes")
    parser.add_argument("--noise-seeds", type=int, default=1)
    parser.add_argument("--only", action="append")
    parser.add_argument("--json")
    options = parser.parse_args()
    print(f"{'volume':13} {'by':13} {'seconds':>8} {'triangles':>9} {'Dice':>6} {'mean':>6} {'max':>6} {'comp.':>6} "
          f"{'genus':>6} {'edges':>6} {'pairs':>6}")
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for case in cases(options, folder):
            for row in rows_of(case):
                rows.append(row)
                text = {key: format(row[key], form) if row.get(key) is not None else "-"
                        for key, form in (("dice", ".4f"), ("mean", ".3f"), ("largest", ".2f"), ("components", "d"),
                                          ("genus", "g"), ("bad_edges", "d"), ("pairs", "d"))}
                seconds = f"{row['seconds']:.2f}" + ("" if row.get("at_rest", True) else "+")
                print(f"{row['case']:13} {row['who']:13} {seconds:>8} {row['triangles']:9} {text['dice']:>6} "
                      f"{text['mean']:>6} {text['largest']:>6} {text['components']:>6} {text['genus']:>6} "
                      f"{text['bad_edges']:>6} {text['pairs']:>6}", flush=True)
    if options.json:
        with open(options.json, "w", encoding="utf-8") as out:
            json.dump(rows, out, indent=1, default=float)


if __name__ == "__main__":
    main()
