// SPDX-License-Identifier: MIT
// volume_source: the bytes behind a volume's header, plain or compressed, turned into voxels piece by piece.
// Nothing is allocated on a header's word: a plain file's size is compared first, a compressed one is
// believed as it unfolds.
#pragma once

#include <cstdint>
#include <fstream>
#include <memory>
#include <string>

#include "tool/io/volume.h"

namespace tool {

enum class VoxelType { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };
size_t bytes_of(VoxelType type);
// A file format's word for a type.
struct TypeName {
  const char* name;
  VoxelType type;
};

// How voxels are stored; a voxel's value is slope * stored + intercept.
struct VoxelLayout {
  VoxelType type = VoxelType::u8;
  bool big_endian = false;
  double slope = 1, intercept = 0;
};

inline constexpr int64_t most_voxels = int64_t{1} << 31;

// Checks sizes from a header and sets them in `volume`. `place` starts the message ("a.nhdr: line 4").
Status set_sizes(const std::string& place, const int64_t (&sizes)[3], Volume& volume);

class Inflater;

// A file read forwards, from some point on through zlib (a gzip or a zlib stream).
class ByteSource {
 public:
  ByteSource();
  ~ByteSource();
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  Status open(const std::string& path);
  // Do the bytes from here on begin as gzip does? Plain bytes only.
  bool begins_as_gzip();
  // The bytes from here on are compressed. Fails, naming the library, in a build without zlib.
  Status start_inflating();
  // Up to `wanted` bytes; fewer only at the end. Fails on damaged or cut-off compressed data.
  Status read(void* bytes, size_t wanted, size_t& got);
  Status skip(uint64_t count);
  Status skip_lines(uint64_t count);
  // Moves on until `count` bytes are left. Plain bytes only.
  Status skip_to_last(uint64_t count);

  const std::string& path() const { return path_; }
  bool compressed() const { return inflater_ != nullptr; }
  uint64_t remaining() const { return size_ - position_; }  // of the file itself, compressed or not

 private:
  friend class Inflater;
  Status read_plain(void* bytes, size_t wanted, size_t& got);

  std::string path_;
  std::ifstream file_;
  uint64_t size_ = 0, position_ = 0;
  std::unique_ptr<Inflater> inflater_;
};

// The start of a file with a text header, at most 1 MiB.
Status read_text_header(const std::string& path, std::string& text);

// Reads nx * ny * nz voxels into volume.values. `header` is the path of the file that gave the sizes.
Status read_voxels(ByteSource& source, const std::string& header, const VoxelLayout& layout, Volume& volume);

}  // namespace tool
