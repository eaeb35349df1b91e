#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""dicom_by_others.py TOOL: DICOM series that pydicom writes, as `segment` reads them.

The object is a ball beside a block, given in the patient's millimetres, so that a wrong order of slices, a wrong spacing
or a wrong direction moves or bends the mesh. Box and volume must be those of the object itself; VTK's reader of the same
folder must find as many voxels beyond the threshold. Exit 77, skipped, without pydicom.
"""
import json
import math
import os
import struct
import subprocess
import sys
import tempfile

try:
    import pydicom
    from pydicom.dataset import Dataset, FileDataset, FileMetaDataset
    from pydicom.sequence import Sequence
    from pydicom.uid import ExplicitVRLittleEndian, ImplicitVRLittleEndian, RLELossless, generate_uid
except ImportError:
    print("skipped: no pydicom")
    sys.exit(77)
try:
    import numpy
except ImportError:
    print("skipped: no numpy")
    sys.exit(77)

CT, ENHANCED_CT, DOSE = "1.2.840.10008.5.1.4.1.1.2", "1.2.840.10008.5.1.4.1.1.2.1", "1.2.840.10008.5.1.4.1.1.481.2"
COLUMNS, ROWS, SLICES = 30, 26, 14
SPACING = (0.8, 1.1, 2.0)  # along a row, down a column, between slices
BALL, RADIUS = (12.0, -20.0, 40.0), 6.0  # LPS, mm


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def plus(a, s, b):
    return [x + s * y for x, y in zip(a, b)]


def turned(angle):
    """Directions of rows and columns, oblique."""
    c, s = math.cos(angle), math.sin(angle)
    return [c, s, 0.0], [-s * 0.8, c * 0.8, 0.6]


class Grid:
    def __init__(self, angle=0.3, tilt=0.0):
        self.row, self.column = turned(angle)
        normal = cross(self.row, self.column)
        # A tilted gantry moves each slice down the columns.
        self.step = plus([SPACING[2] * x for x in normal], SPACING[2] * math.tan(tilt), self.column)
        corner = plus(BALL, -SPACING[0] * (COLUMNS - 1) / 2, self.row)
        corner = plus(corner, -SPACING[1] * (ROWS - 1) / 2, self.column)
        self.origin = plus(corner, -(SLICES - 1) / 2, self.step)

    def slice_origin(self, k):
        return plus(self.origin, k, self.step)

    def values(self, k):
        i, j = numpy.meshgrid(numpy.arange(COLUMNS), numpy.arange(ROWS))
        at = [o + SPACING[0] * i * r + SPACING[1] * j * c for o, r, c in zip(self.slice_origin(k), self.row, self.column)]
        away = numpy.sqrt(sum((x - m)**2 for x, m in zip(at, BALL)))
        # A linear ramp, whose interpolant crosses the threshold near the ball's surface.
        return numpy.clip(200 - 100 * (away - RADIUS), 0, 1000)


class Series:
    def __init__(self, folder):
        self.folder = folder
        self.uid, self.study = generate_uid(entropy_srcs=[folder, "series"]), generate_uid(entropy_srcs=[folder])

    def write(self, grid, k, name, slope=2.0, intercept=-1000.0, syntax=ExplicitVRLittleEndian, signed=False, **other):
        meta = FileMetaDataset()
        meta.MediaStorageSOPClassUID = CT
        meta.MediaStorageSOPInstanceUID = generate_uid(entropy_srcs=[self.folder, name])
        meta.TransferSyntaxUID = syntax
        path = os.path.join(self.folder, name)
        ds = FileDataset(path, {}, file_meta=meta, preamble=b"\0" * 128)
        ds.is_little_endian, ds.is_implicit_VR = True, syntax == ImplicitVRLittleEndian
        ds.SOPClassUID, ds.SOPInstanceUID = CT, meta.MediaStorageSOPInstanceUID
        ds.Modality, ds.SeriesDescription, ds.PatientName, ds.PatientID = "CT", "ball", "Nobody", "0"
        ds.StudyInstanceUID, ds.SeriesInstanceUID, ds.InstanceNumber = self.study, self.uid, 1000 - k
        ds.ImagePositionPatient = ["%.6f" % x for x in grid.slice_origin(k)]
        ds.ImageOrientationPatient = ["%.8f" % x for x in grid.row + grid.column]
        ds.PixelSpacing = [SPACING[1], SPACING[0]]  # rows first
        ds.SliceThickness = 5
        ds.Rows, ds.Columns, ds.SamplesPerPixel, ds.PhotometricInterpretation = ROWS, COLUMNS, 1, "MONOCHROME2"
        ds.BitsAllocated, ds.BitsStored, ds.HighBit, ds.PixelRepresentation = 16, 12, 11, 1 if signed else 0
        ds.RescaleSlope, ds.RescaleIntercept = slope, intercept
        stored = numpy.round((grid.values(k) - intercept) / slope).astype("<i2" if signed else "<u2")
        ds.PixelData = stored.tobytes()
        for key, value in other.items():
            setattr(ds, key, value)
        for key in [key for key, value in other.items() if value is None]:
            delattr(ds, key)
        if syntax == RLELossless:
            ds.file_meta.TransferSyntaxUID = ExplicitVRLittleEndian
            ds.compress(RLELossless)
        ds.save_as(path, write_like_original=False)
        return path

    def write_all(self, grid, **how):
        # Names in no order.
        for k in range(SLICES):
            self.write(grid, k, "im%03d" % ((k * 5 + 3) % SLICES), **how)


def item(**members):
    """A sequence of one item."""
    made = Dataset()
    for key, value in members.items():
        setattr(made, key, value)
    return Sequence([made])


class Frame:
    """A frame of one file: slice k of the grid, at a time, scaled; `place`: elsewhere."""

    def __init__(self, k, time=1, slope=2.0, intercept=-1000.0, place=None):
        self.k, self.time, self.slope, self.intercept, self.place = k, time, slope, intercept, place

    def stored(self, grid):
        return numpy.round((grid.values(self.k) / self.time - self.intercept) / self.slope).astype("<u2")

    def groups(self, grid, with_time):
        made = Dataset()
        content = {"StackID": "1", "InStackPositionNumber": self.k + 1}
        if with_time:
            content["TemporalPositionIndex"] = self.time
        made.FrameContentSequence = item(**content)
        made.PlanePositionSequence = item(ImagePositionPatient=["%.6f" % x for x in self.place or grid.slice_origin(self.k)])
        made.PixelValueTransformationSequence = item(RescaleIntercept=self.intercept, RescaleSlope=self.slope, RescaleType="US")
        return made


def multi_frame(series, name, frames, grid=None, with_time=True, **other):
    """A file of several frames, each with its own place."""
    grid = grid or Grid()
    path = series.write(grid, 0, name, ImagePositionPatient=None, ImageOrientationPatient=None, PixelSpacing=None,
                        RescaleSlope=None, RescaleIntercept=None)
    ds = pydicom.dcmread(path)
    ds.file_meta.MediaStorageSOPClassUID = ds.SOPClassUID = ENHANCED_CT
    ds.NumberOfFrames = len(frames)
    shared = Dataset()
    shared.PlaneOrientationSequence = item(ImageOrientationPatient=["%.8f" % x for x in grid.row + grid.column])
    # What lies between frames is not for these numbers to say.
    shared.PixelMeasuresSequence = item(PixelSpacing=[SPACING[1], SPACING[0]], SliceThickness=5, SpacingBetweenSlices=7)
    ds.SharedFunctionalGroupsSequence = Sequence([shared])
    ds.PerFrameFunctionalGroupsSequence = Sequence([frame.groups(grid, with_time) for frame in frames])
    ds.BitsStored, ds.HighBit = 16, 15
    ds.PixelData = b"".join(frame.stored(grid).tobytes() for frame in frames)
    for key, value in other.items():
        setattr(ds, key, value)
    ds.save_as(path, write_like_original=False)
    return path


def dose(folder, name, grid=None, series=None, **other):
    """A dose grid of one frame, or of all slices of a grid."""
    series = series or Series(folder)
    series.uid = generate_uid(entropy_srcs=[folder, name])
    path = series.write(grid or Grid(), 0, name, RescaleSlope=None, RescaleIntercept=None, SliceThickness=None)
    ds = pydicom.dcmread(path)
    ds.file_meta.MediaStorageSOPClassUID = ds.SOPClassUID = DOSE
    ds.Modality, ds.DoseGridScaling, ds.GridFrameOffsetVector, ds.SliceThickness = "RTDOSE", "0.5", "0.0", None
    ds.BitsStored, ds.HighBit = 16, 15
    if grid:
        ds.NumberOfFrames = SLICES
        ds.GridFrameOffsetVector = ["%.6f" % (SPACING[2] * k) for k in range(SLICES)]
        ds.FrameIncrementPointer = 0x3004000C
        ds.PixelData = b"".join(numpy.round(grid.values(k) / 0.5).astype("<u2").tobytes() for k in range(SLICES))
    for key, value in other.items():
        setattr(ds, key, value)
    ds.save_as(path, write_like_original=False)
    return path


class Judge:
    def __init__(self, tool, folder):
        self.tool, self.folder, self.wrong = tool, folder, 0

    def run(self, path, *options):
        report = os.path.join(self.folder, "r.json")
        seed = ",".join(str(x) for x in BALL)
        call = [self.tool, "segment", path, "--seed-mm=" + seed, "--lower", "200", "--radius", "2.5", "--json", report]
        done = subprocess.run(call + ["--out", os.path.join(self.folder, "m.ply")] + list(options), capture_output=True, text=True)
        return done, report

    def expect(self, holds, what, done):
        if not holds:
            self.wrong += 1
            print("WRONG:", what, done.returncode, done.stdout, done.stderr)

    def is_ball(self, what, path, *options, note=""):
        done, report = self.run(path, *options)
        self.expect(done.returncode == 0 and note in done.stderr, what, done)
        if done.returncode == 0:
            with open(report) as file:
                told = json.load(file)
            volume = sum(part["volume"] for part in told["components"])
            true = 4 / 3 * math.pi * RADIUS**3
            box = box_of(os.path.join(self.folder, "m.ply"))
            off = max(abs(x - m - s * RADIUS) for s, b in zip((-1, 1), box) for x, m in zip(b, BALL))
            self.expect(abs(volume / true - 1) < 0.06 and off < 0.5 and told["space"] == "lps", (what, volume / true, off), done)
        return done

    def is_refused(self, what, path, words, *options):
        done, _ = self.run(path, *options)
        good = done.returncode == 2 and all(w in done.stderr for w in words) and done.stderr.count("\n") == 1
        self.expect(good, what, done)


def box_of(path):
    with open(path, "rb") as file:
        head, body = file.read().split(b"end_header\n", 1)
    count = next(int(line.split()[2]) for line in head.decode().split("\n") if line.startswith("element vertex"))
    places = numpy.frombuffer(body, "<f8", 3 * count).reshape(-1, 3)
    return places.min(0), places.max(0)


def new_series(folder, name):
    path = os.path.join(folder, name)
    os.mkdir(path)
    return Series(path)


def good_series(judge, folder):
    for name, how in (("explicit", {}), ("implicit", {"syntax": ImplicitVRLittleEndian}), ("rle", {"syntax": RLELossless}),
                      ("signed", {"signed": True, "intercept": 0.0, "slope": 1.0})):
        series = new_series(folder, name)
        series.write_all(Grid(), **how)
        judge.is_ball(name, series.folder)
    # Slices with slopes of their own, as of PET.
    series = new_series(folder, "slopes")
    for k in range(SLICES):
        series.write(Grid(), k, "s%d" % k, slope=0.5 + 0.1 * (k % 5), intercept=-7.0 * k)
    judge.is_ball("slopes", series.folder)
    tilted = new_series(folder, "tilted")
    tilted.write_all(Grid(tilt=0.35))
    judge.is_ball("tilt", tilted.folder, note="tilted by 20.1 degrees (gantry tilt)")


def several(judge, folder):
    series = new_series(folder, "two")
    series.write_all(Grid())
    scout = Series(series.folder)
    scout.uid = generate_uid(entropy_srcs=["scout"])
    scout.write(Grid(angle=1.2), 0, "zz-scout")
    with open(os.path.join(series.folder, "README"), "w") as file:
        file.write("not DICOM")
    judge.is_refused("two series", series.folder, ["holds 2 series", "im000 (14 files, CT 30 x 26", "zz-scout (1 files"])
    judge.is_ball("one of two series", os.path.join(series.folder, "im004"))
    judge.is_refused("scout", os.path.join(series.folder, "zz-scout"), ["one slice"])
    judge.is_refused("no DICOM", os.path.join(series.folder, "README"), ["unknown volume format"])
    times = new_series(folder, "times")
    for k in range(SLICES):
        for t in range(2):
            times.write(Grid(), k, "t%d-%d" % (t, k), InstanceNumber=t * SLICES + k, RescaleIntercept=-1000.0 - 5000 * t)
    judge.is_refused("times", times.folder, ["2 slices at each place", "--time K"])
    judge.is_ball("time 0", times.folder, "--time", "0")
    judge.is_refused("time 1", times.folder, ["outside the object"], "--time", "1")


def frames_of_one_file(judge, folder):
    order = [(5 * k + 3) % SLICES for k in range(SLICES)]
    series = new_series(folder, "frames")
    judge.is_ball("frames", multi_frame(series, "a", [Frame(k) for k in range(SLICES)]))
    other = new_series(folder, "frames-in-no-order")
    judge.is_ball("frames in no order", multi_frame(other, "a", [Frame(k) for k in order]))
    slopes = new_series(folder, "frames-slopes")
    judge.is_ball("slopes", multi_frame(slopes, "a", [Frame(k, slope=1 + k / 8, intercept=-7.0 * k) for k in order]))
    tilted = new_series(folder, "frames-tilted")
    path = multi_frame(tilted, "a", [Frame(k) for k in order], grid=Grid(tilt=0.35))
    judge.is_ball("frames tilted", path, note="tilted by 20.1 degrees (gantry tilt)")
    # At time 2 all grey values are halved, so that the seed lies in no object.
    for name, frames in (("blocks", [Frame(k, time) for time in (2, 1) for k in order]),
                         ("alternating", [Frame(k, time) for k in range(SLICES) for time in (1, 2)])):
        times = new_series(folder, "frames-times-" + name)
        path = multi_frame(times, "a", frames)
        judge.is_refused("times " + name, path, ["2 slices at each place", "--time K"])
        judge.is_ball("time 0 " + name, path, "--time", "0")
        done, _ = judge.run(path, "--time", "1", "--partial", "--iterations", "3")
        judge.expect(done.returncode == 0, "time 1 " + name, done)
        judge.is_refused("time 2 " + name, path, ["no --time 2"], "--time", "2")
    plain = new_series(folder, "frames-times-unnamed")
    path = multi_frame(plain, "a", [Frame(k, time) for k in range(SLICES) for time in (1, 2)], with_time=False)
    judge.is_ball("times by number", path, "--time", "0")
    # Two files with every other slice.
    halves = new_series(folder, "frames-halves")
    for part in (1, 0):
        multi_frame(halves, "half%d" % part, [Frame(k) for k in order if k % 2 == part])
    judge.is_ball("two files of frames", halves.folder)


def faults_of_frames(judge, folder):
    grid = Grid()
    gap = new_series(folder, "frames-gap")
    path = multi_frame(gap, "a", [Frame(k) for k in range(SLICES) if k not in (5, 6)])
    judge.is_refused("frames with a gap", path, ["missing slices: 2 in 1 gaps", "between a frame 5 and a frame 6"])
    uneven = new_series(folder, "frames-uneven")
    place = [plus(grid.slice_origin(k), 0.4 * (k > 6) / SPACING[2], grid.step) for k in range(SLICES)]
    path = multi_frame(uneven, "a", [Frame(k, place=place[k]) for k in range(SLICES)])
    judge.is_refused("frames uneven", path, ["2 to 2.4 mm apart", "a frame 7 and a frame 8"])
    sideways = new_series(folder, "frames-sideways")
    place = [plus(grid.slice_origin(k), 3.0 if k == 5 else 0.0, grid.row) for k in range(SLICES)]
    path = multi_frame(sideways, "a", [Frame(k, place=place[k]) for k in range(SLICES)])
    judge.is_refused("frame sideways", path, ["a: frame 6", "3 mm beside the line"])
    bare = new_series(folder, "frames-bare")
    path = multi_frame(bare, "a", [Frame(k) for k in range(SLICES)])
    ds = pydicom.dcmread(path)
    del ds.PerFrameFunctionalGroupsSequence[4].PlanePositionSequence
    ds.save_as(path, write_like_original=False)
    judge.is_refused("frame without a place", path, ["a: frame 5", "ImagePositionPatient"])
    bent = new_series(folder, "frames-bent")
    path = multi_frame(bent, "a", [Frame(k) for k in range(SLICES)])
    ds = pydicom.dcmread(path)
    row, column = turned(0.5)
    ds.PerFrameFunctionalGroupsSequence[4].PlaneOrientationSequence = item(
        ImageOrientationPatient=["%.8f" % x for x in row + column])
    ds.save_as(path, write_like_original=False)
    judge.is_refused("frame of another direction", path, ["a: frame 5", "ImageOrientationPatient is not that of a frame 1"])


def doses(judge, folder):
    series = new_series(folder, "with-dose")
    series.write_all(Grid())
    dose(series.folder, "dose")
    judge.is_ball("beside a dose", series.folder, note="dose (RTDOSE) is left out")
    judge.is_ball("a slice beside a dose", os.path.join(series.folder, "im004"))
    judge.is_refused("a dose of one slice", os.path.join(series.folder, "dose"), ["one slice"])
    # Damage in another series is no damage to this one.
    cut = dose(series.folder, "cut")
    with open(cut, "rb") as file:
        data = file.read()
    with open(cut, "wb") as file:
        file.write(data[:-1700])
    judge.is_ball("beside a damaged dose", os.path.join(series.folder, "im004"), 
                  note="cut (of another series) is damaged")
    judge.is_refused("a damaged dose", cut, ["cut"])
    grid = Grid()
    whole = new_series(folder, "dose-grid")
    path = dose(whole.folder, "grid", grid=grid)
    judge.is_ball("a dose grid", path)
    ds = pydicom.dcmread(path)
    ds.GridFrameOffsetVector = ["%.6f" % (SPACING[2] * k + 0.4 * (k > 6)) for k in range(SLICES)]
    ds.save_as(path, write_like_original=False)
    judge.is_refused("an uneven dose grid", path, ["2 to 2.4 mm apart"])


def faults(judge, folder):
    gap = new_series(folder, "gap")
    gap.write_all(Grid())
    os.remove(os.path.join(gap.folder, "im%03d" % ((6 * 5 + 3) % SLICES)))
    os.remove(os.path.join(gap.folder, "im%03d" % ((7 * 5 + 3) % SLICES)))
    judge.is_refused("gap", gap.folder, ["missing slices: 2 in 1 gaps", "of 6 mm", "between im000 and im001"])
    uneven = new_series(folder, "uneven")
    grid = Grid()
    for k in range(SLICES):
        place = plus(grid.slice_origin(k), 0.4 * (k > 6) / SPACING[2], grid.step)
        uneven.write(grid, k, "u%02d" % k, ImagePositionPatient=["%.6f" % x for x in place])
    judge.is_refused("uneven", uneven.folder, ["2 to 2.4 mm apart", "u06 and u07"])
    sideways = new_series(folder, "sideways")
    for k in range(SLICES):
        place = plus(grid.slice_origin(k), 3.0 if k == 5 else 0.0, grid.row)
        sideways.write(grid, k, "s%02d" % k, ImagePositionPatient=["%.6f" % x for x in place])
    judge.is_refused("sideways", sideways.folder, ["s05", "3 mm beside the line"])
    twice = new_series(folder, "twice")
    twice.write_all(grid)
    twice.write(grid, 3, "copy")
    judge.is_refused("twice", twice.folder, ["slices at", "copy"])
    bare = new_series(folder, "bare")
    bare.write_all(grid, ImagePositionPatient=None)
    judge.is_refused("no position", bare.folder, ["ImagePositionPatient"])
    empty = new_series(folder, "empty")
    judge.is_refused("empty", empty.folder, ["the folder is empty"])
    with open(os.path.join(empty.folder, "text"), "w") as file:
        file.write("nothing")
    judge.is_refused("no image", empty.folder, ["holds no DICOM image"])
    cut = new_series(folder, "cut")
    cut.write_all(grid)
    path = os.path.join(cut.folder, "im005")
    with open(path, "rb") as file:
        data = file.read()
    with open(path, "wb") as file:
        file.write(data[:-200])
    judge.is_refused("cut", cut.folder, ["im005"])


def by_vtk(judge, folder):
    """VTK's own reader of DICOM finds as many voxels of the object, where VTK is."""
    try:
        from vtkmodules.vtkIOImage import vtkDICOMImageReader
        from vtkmodules.util.numpy_support import vtk_to_numpy
    except ImportError:
        print("no VTK for Python: not compared")
        return
    path = os.path.join(folder, "explicit")
    reader = vtkDICOMImageReader()
    reader.SetDirectoryName(path)
    reader.Update()
    theirs = int((vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()) > 200).sum())
    done, report = judge.run(path)
    with open(report) as file:
        ours = json.load(file)["fill"]["object_voxels"]
    judge.expect(ours == theirs and theirs > 400, ("VTK", ours, theirs), done)


def main():
    tool = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        judge = Judge(tool, folder)
        good = new_series(folder, "first")
        good.write_all(Grid())
        done, _ = judge.run(good.folder)
        if "without GDCM" in done.stderr:
            print("skipped: the tool is built without GDCM")
            return 77
        good_series(judge, folder)
        several(judge, folder)
        faults(judge, folder)
        frames_of_one_file(judge, folder)
        faults_of_frames(judge, folder)
        doses(judge, folder)
        by_vtk(judge, folder)
    return 1 if judge.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
