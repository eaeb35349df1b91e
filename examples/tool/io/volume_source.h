// SPDX-License-Identifier: MIT
// volume_source: the bytes behind a volume's header, plain or packed, turned into voxels piece by piece.
// Nothing is allocated on a header's word: a plain file's size is compared first, a packed one is
// believed as it unfolds.
#pragma once

#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "tool/io/decoder.h"
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
  bool text = false;                       // numbers in text, with blanks between them
  uint32_t components = 1, component = 0;  // numbers of a voxel, side by side, of which one is taken
  double slope = 1, intercept = 0;
};

inline constexpr uint32_t most_components = 4096;
// Of a voxel with all components.
inline size_t bytes_of(const VoxelLayout& layout) { return layout.components * bytes_of(layout.type); }

inline constexpr int64_t most_voxels = int64_t{1} << 31;

// Checks sizes from a header and sets them in `volume`. `place` starts the message ("a.nhdr: line 4").
Status set_sizes(const std::string& place, const int64_t (&sizes)[3], Volume& volume);

// A file read forwards, from some point on through decoders.
class ByteSource {
 public:
  Status open(const std::string& path);
  // The same; a file that begins as gzip or bzip2 does is unpacked, whatever the name.
  Status open_unpacked(const std::string& path);
  // The mark of the bytes from here on. Plain bytes only.
  Packing packing();
  // The bytes from here on are packed. Fails, naming the library, in a build without it.
  Status start_unpacking(Packing packing);
  // Up to `wanted` bytes; fewer only at the end. Fails on damaged or cut-off compressed data.
  Status read(void* bytes, size_t wanted, size_t& got) { return read_behind(decoders_.size(), bytes, wanted, got); }
  Status skip(uint64_t count);
  Status skip_lines(uint64_t count);
  // Moves on until `count` bytes are left. Plain bytes only.
  Status skip_to_last(uint64_t count);

  const std::string& path() const { return path_; }
  bool packed() const { return !decoders_.empty(); }
  uint64_t remaining() const { return size_ - position_; }  // of the file itself, packed or not

 private:
  // Through the first decoders.
  Status read_behind(size_t decoders, void* bytes, size_t wanted, size_t& got);
  Status read_plain(void* bytes, size_t wanted, size_t& got);

  std::string path_;
  std::ifstream file_;
  uint64_t size_ = 0, position_ = 0;
  std::vector<std::unique_ptr<Decoder>> decoders_;  // each reads through those before
};

// The start of a file with a text header, at most 1 MiB.
Status read_text_header(const std::string& path, std::string& text);

// Appends `count` voxels to volume.values. `header` is the path of the file that gave the sizes. Fails on voxels that
// are not finite, but for NaN where `allow_nan` is set.
struct VoxelDemand {
  std::string header;
  VoxelLayout layout;
  uint64_t count = 0;
  bool allow_nan = false;
};
Status read_voxels(ByteSource& source, const VoxelDemand& demand, Volume& volume);

// The same of bytes in memory: demand.count voxels, called `place` in messages.
Status append_voxels(std::string_view bytes, const std::string& place, const VoxelDemand& demand, Volume& volume);

// Passes over so many numbers of a text.
Status skip_numbers(ByteSource& source, uint64_t count);

// Makes a packed stream compare its checksum, which lies behind the last voxel.
Status check_end_of(ByteSource& source);

}  // namespace tool
