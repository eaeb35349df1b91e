// SPDX-License-Identifier: MIT
// volume_mgh: FreeSurfer's volumes, .mgh and, packed by gzip, .mgz. Numbers have their most significant byte first.
// Format: https://surfer.nmr.mgh.harvard.edu/fswiki/FsTutorial/MghFormat
#include <cmath>

#include "tool/io/files.h"
#include "tool/io/volume_io.h"
#include "tool/io/volume_source.h"

namespace tool {

namespace {

constexpr size_t header_size = 284;

bool voxel_type_of_mgh(int32_t number, VoxelType& type) {
  switch (number) {
    case 0: type = VoxelType::u8; return true;
    case 1: type = VoxelType::i32; return true;
    case 3: type = VoxelType::f32; return true;
    case 4: type = VoxelType::i16; return true;
    case 10: type = VoxelType::u16; return true;
    default: return false;
  }
}

int32_t integer_at(const char* header, size_t place) { return load<int32_t>(header + 4 * place, true); }

// Without a valid map FreeSurfer takes voxels of one millimetre in coronal slices.
constexpr float usual_map[15] = {1, 1, 1, -1, 0, 0, 0, 0, -1, 0, 1, 0, 0, 0, 0};

// Spacings, the directions of the three axes, and the place of voxel (nx / 2, ny / 2, nz / 2), in RAS.
Affine map_of(const char* header, const Volume& volume, bool& is_known) {
  is_known = load<int16_t>(header + 28, true) > 0;
  double numbers[15];
  for (size_t i = 0; i < 15; ++i)
    numbers[i] = static_cast<double>(is_known ? load<float>(header + 30 + 4 * i, true) : usual_map[i]);
  Affine map;
  const double middle[3] = {volume.nx / 2.0, volume.ny / 2.0, volume.nz / 2.0};
  for (size_t axis = 0; axis < 3; ++axis)
    for (size_t k = 0; k < 3; ++k) map.axes[axis][k] = numbers[axis] * numbers[3 + 3 * axis + k];
  map.origin = {numbers[12], numbers[13], numbers[14]};
  for (size_t axis = 0; axis < 3; ++axis) map.origin = map.origin - middle[axis] * map.axes[axis];
  return map;
}

Status choose_frame(const std::string& path, int32_t frames, const VolumeRequest& request, uint64_t& frame) {
  frame = request.time.value_or(0);
  if (frames < 1) return failure(path, ": ", frames, " time points");
  if (frames > 1 && !request.time)
    return failure(path, ": ", frames, " time points: --time K, from 0 to ", frames - 1, ", picks one");
  return frame < static_cast<uint64_t>(frames) ? success()
                                               : failure(path, ": there is no --time ", frame, " of ", frames);
}

}  // namespace

Status read_mgh(const std::string& path, const VolumeRequest& request, Volume& volume) {
  ByteSource source;
  if (Status status = source.open_unpacked(path); !status) return status;
  char header[header_size];
  size_t got = 0;
  if (Status status = source.read(header, header_size, got); !status) return status;
  if (got < header_size || integer_at(header, 0) != 1) return failure(path, ": is no MGH volume of version 1");
  VoxelDemand demand{path, {}, 0, request.allow_nan};
  demand.layout.big_endian = true;
  if (!voxel_type_of_mgh(integer_at(header, 5), demand.layout.type))
    return failure(path, ": voxels of MGH type ", integer_at(header, 5), " are not read");
  const int64_t sizes[3] = {integer_at(header, 1), integer_at(header, 2), integer_at(header, 3)};
  if (Status status = set_sizes(path, sizes, volume); !status) return status;
  uint64_t frame = 0;
  if (Status status = choose_frame(path, integer_at(header, 4), request, frame); !status) return status;
  bool is_known = false;
  volume.to_world = map_of(header, volume, is_known);
  volume.space = Space::ras;
  if (!is_regular(volume.to_world)) return failure(path, ": directions and spacings give voxels no volume");
  if (!is_known) volume.note = text_of(path, ": tells no orientation; FreeSurfer's usual one is taken");
  demand.count = static_cast<uint64_t>(sizes[0] * sizes[1] * sizes[2]);
  volume.values.clear();
  if (Status status = source.skip(frame * demand.count * bytes_of(demand.layout)); !status) return status;
  return read_voxels(source, demand, volume);
}

}  // namespace tool
