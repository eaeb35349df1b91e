// SPDX-License-Identifier: MIT
// dicom_file: DICOM images file by file, as GDCM reads them, in a process of its own: GDCM is not proof against damaged
// files.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tool/io/volume_source.h"

namespace tool {

// Plain bytes, which go from process to process.
struct DicomHeader {
  bool is_image = false;
  bool is_damaged = false;  // begins as DICOM, but cannot be read to the voxels, or has none
  bool has_place = false;   // ImagePositionPatient and ImageOrientationPatient
  bool has_spacing = false;
  int64_t columns = 0, rows = 0, frames = 1, samples = 1;
  int64_t instance = 0;
  Point position{}, row{}, column{};  // centre of the first voxel, directions along a row and down a column
  double spacing[3] = {1, 1, 1};      // of columns, rows, frames
  char series[72] = "", modality[24] = "", description[72] = "";
};

// One header for each path; files that are no DICOM images have is_image false.
Status read_dicom_headers(const std::vector<std::string>& paths, std::vector<DicomHeader>& headers);

// Appends the voxels of the files in turn, with `demand.count` for each, scaled by each file's own slope and intercept.
Status read_dicom_voxels(const std::vector<std::string>& paths, const VoxelDemand& demand, Volume& volume);

}  // namespace tool
