// SPDX-License-Identifier: MIT
// dicom_file: DICOM images file by file, as GDCM reads them, in a process of its own: GDCM is not proof against damaged
// files.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tool/io/volume_source.h"

namespace tool {

// A slice of a file. Plain bytes, which go from process to process.
struct DicomFrame {
  Point position{}, row{}, column{};  // centre of the first voxel, directions along a row and down a column
  double spacing[2] = {1, 1};         // of columns and rows
  double slope = 1, intercept = 0;    // of the grey values, with has_scale
  int64_t time = 0;                   // TemporalPositionIndex, from 1; 0 without
  bool has_place = false;             // ImagePositionPatient and ImageOrientationPatient
  bool has_spacing = false;
  bool has_scale = false;
};

// Plain bytes as well.
struct DicomHeader {
  bool is_image = false;
  bool is_damaged = false;     // begins as DICOM, but cannot be read to the voxels, or has none
  bool is_guess = false;       // frames without places of their own; distances are those of GDCM
  bool is_supplement = false;  // dose, segmentation, parametric map: beside the images that it belongs to
  int64_t columns = 0, rows = 0, samples = 1, instance = 0;
  char series[72] = "", modality[24] = "", description[72] = "";
};

struct DicomFile {
  DicomHeader header;
  std::vector<DicomFrame> frames;  // of images
  std::string fault;               // how GDCM ended on the file; the header is known in part then, or empty
};

// One for each path; files that are no DICOM images have is_image false.
Status read_dicom_headers(const std::vector<std::string>& paths, std::vector<DicomFile>& files);

// Slices of a file, by their numbers in the file, from 0.
struct DicomPick {
  std::string path;
  uint64_t frames_of_file = 1;
  std::vector<size_t> frames;
  std::vector<DicomFrame> scales;  // of these frames
};

// Appends the voxels of the picks in turn, with `demand.count` for each frame. Frames without a scale of their own take
// the file's.
Status read_dicom_voxels(const std::vector<DicomPick>& picks, const VoxelDemand& demand, Volume& volume);

}  // namespace tool
