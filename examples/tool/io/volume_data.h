// SPDX-License-Identifier: MIT
// volume_data: where a header says that voxels lie: behind the header, in a file of their own, or spread over several;
// packed or not; several volumes in a row, of which one is read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tool/io/volume_io.h"
#include "tool/io/volume_source.h"

namespace tool {

// Names relative to the header's folder. Either a list, or a pattern with one "%03d" for first, first + step, ...,
// last.
struct DataFiles {
  std::vector<std::string> names;
  std::string pattern;
  int64_t first = 0, last = 0, step = 1;

  bool empty() const { return names.empty() && pattern.empty(); }
  uint64_t count() const;
  std::string name(uint64_t index) const;
};

// "slice%03d.raw 1 24 1": pattern, first, last, and step if there is one. `rest` receives further words. `place` starts
// messages.
Status parse_pattern(const std::string& place, std::string_view text, DataFiles& files, std::string_view& rest);

// The remaining lines of a header name a file each. `subdimension` axes lie in each file.
void read_names(std::string_view lines, DataFiles& files);

struct VoxelData {
  std::string header;       // path
  uint64_t header_end = 0;  // bytes before the voxels, where no other file holds them
  DataFiles files;
  Packing packing = Packing::none;
  bool unpacked_by_content = false;  // other files begin as compressed ones do where they are
  uint64_t line_skip = 0;            // lines of each file, before unpacking
  uint64_t head_skip = 0;            // bytes of each, before unpacking
  int64_t byte_skip = 0;             // bytes of each, after unpacking; -1: the voxels are the last bytes
  VoxelLayout layout;
  uint64_t times = 1;        // volumes in all
  bool interleaved = false;  // a voxel of each in turn; else volume after volume
};

// Reads one volume of volume.nx * ny * nz voxels, number request.time, counted from 0; without a request, there must be
// one only. `several` names the place of the number of volumes ("dim[4]").
Status read_voxel_data(const VoxelData& data, const VolumeRequest& request, const std::string& several, Volume& volume);

}  // namespace tool
