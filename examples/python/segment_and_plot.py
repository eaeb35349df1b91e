#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Segments the object round a voxel of a NIfTI volume, and draws the slices through this voxel with the contour.

    segment_and_plot.py scan.nii.gz --seed 60,110,60 --threshold 80 --out scan.png --mesh scan.obj

The object lies on the seed's side of the threshold. Needs nibabel and matplotlib.
"""

import argparse
import sys

import numpy as np

import topoadapt


def read_volume(path):
    """Grey values, and the affine map from voxel indices to millimetres."""
    try:
        import nibabel
    except ImportError:
        sys.exit("segment_and_plot.py reads volumes with nibabel, which is not installed: pip install nibabel")
    try:
        image = nibabel.load(path)
        volume = np.asarray(image.dataobj, float)
    except (OSError, nibabel.filebasedimages.ImageFileError) as error:
        sys.exit("{}: {}".format(path, error))
    if volume.ndim > 3 and volume.shape[3:] == (1,) * (volume.ndim - 3):
        volume = volume.reshape(volume.shape[:3])
    return volume, image.affine


def draw(path, volume, affine, found, seed):
    """Three slices through the seed, in true proportions, each with the curve in which the mesh crosses it."""
    try:
        import matplotlib
    except ImportError:
        sys.exit("segment_and_plot.py draws with matplotlib, which is not installed: pip install matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot
    from matplotlib.collections import LineCollection

    inverse = np.linalg.inv(affine)
    at = found.vertices @ inverse[:3, :3].T + inverse[:3, 3]  # in voxels
    side = np.linalg.norm(affine[:3, :3], axis=0)
    figure, panels = pyplot.subplots(1, 3, figsize=(15, 5.5))
    for axis, panel in enumerate(panels):
        across, up = [a for a in range(3) if a != axis]
        panel.imshow(
            np.take(volume, seed[axis], axis=axis).T,
            cmap="gray",
            origin="lower",
            extent=[-0.5, volume.shape[across] - 0.5, -0.5, volume.shape[up] - 0.5],
            aspect=side[up] / side[across],
        )
        # A plane beside the slice's centre meets no vertex of a mesh with whole coordinates.
        curve = topoadapt.voxels.slice_mesh(at, found.faces, axis, seed[axis] + 1e-6)
        panel.add_collection(LineCollection(curve[:, :, [across, up]], colors="tab:orange", linewidths=1.5))
        panel.plot(seed[across], seed[up], "+", color="tab:cyan")
        panel.set_title("{} = {}".format("ijk"[axis], seed[axis]))
        panel.set_xlabel("{}, voxels".format("ijk"[across]))
        panel.set_ylabel("{}, voxels".format("ijk"[up]))
    figure.suptitle(describe(found))
    figure.tight_layout()
    figure.savefig(path, dpi=100)
    pyplot.close(figure)


def describe(found):
    genus = sum(component.genus for component in found.mesh.components())
    return "{} vertices, {} component(s), genus {}, {:.1%} of the object filled, {:.1%} beyond, {} iterations{}".format(
        len(found.vertices),
        len(found.mesh.components()),
        genus,
        found.filled,
        found.beyond,
        found.iterations,
        "" if found.at_rest else ", not at rest",
    )


def write_obj(path, vertices, faces):
    with open(path, "w", encoding="ascii") as file:
        file.writelines("v {!r} {!r} {!r}\n".format(*vertex) for vertex in vertices.tolist())
        file.writelines("f {} {} {}\n".format(*face) for face in (faces.astype(np.int64) + 1).tolist())


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("volume", help=".nii or .nii.gz")
    parser.add_argument("--seed", required=True, metavar="i,j,k", help="voxel in the object")
    parser.add_argument("--threshold", required=True, type=float, help="grey value of the object's border")
    parser.add_argument("--radius", type=float, help="of the first ball, in mm")
    parser.add_argument("--edge", type=float, help="length of edges aimed at, in mm")
    parser.add_argument("--iterations", type=int, default=2000, help="at most")
    parser.add_argument("--out", default="segmentation.png", help="picture (%(default)s)")
    parser.add_argument("--mesh", metavar="OBJ", help="writes the mesh, in mm")
    options = parser.parse_args()
    try:
        seed = tuple(int(number) for number in options.seed.split(","))
    except ValueError:
        parser.error("--seed takes three whole numbers: i,j,k")
    volume, affine = read_volume(options.volume)
    try:
        found = topoadapt.segment(
            volume,
            seed,
            options.threshold,
            affine=affine,
            radius=options.radius,
            edge_length=options.edge,
            max_iterations=options.iterations,
        )
    except (ValueError, topoadapt.Error) as error:
        sys.exit("{}: {}".format(options.volume, error))
    print(describe(found))
    draw(options.out, volume, affine, found, seed)
    if options.mesh:
        write_obj(options.mesh, found.vertices, found.faces)


if __name__ == "__main__":
    main()
