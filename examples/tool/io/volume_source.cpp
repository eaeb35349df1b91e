// SPDX-License-Identifier: MIT
// volume_source: plain and compressed bytes (zlib: RFC 1950, gzip: RFC 1952) and their conversion to voxels.
#include "tool/io/volume_source.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tool/io/files.h"

#if TOOL_HAVE_ZLIB
#include <zlib.h>
#endif

namespace tool {

#if TOOL_HAVE_ZLIB

class Inflater {
 public:
  ~Inflater() { inflateEnd(&stream_); }

  bool start() {
    constexpr int largest_window_either_header = 15 + 32;
    return inflateInit2(&stream_, largest_window_either_header) == Z_OK;
  }

  Status read(ByteSource& source, void* bytes, size_t wanted, size_t& got) {
    got = 0;
    while (got < wanted && !finished_) {
      if (stream_.avail_in == 0) {
        if (Status status = refill(source); !status) return status;
        if (finished_) break;
      }
      const size_t piece = std::min(wanted - got, size_t{1} << 20);
      stream_.next_out = static_cast<Bytef*>(bytes) + got;
      stream_.avail_out = static_cast<uInt>(piece);
      const int answer = inflate(&stream_, Z_NO_FLUSH);
      const size_t made = piece - stream_.avail_out;
      got += made;
      produced_ += made;
      at_member_start_ = false;
      if (answer == Z_STREAM_END) {
        if (Status status = next_member(source); !status) return status;
      } else if (answer != Z_OK && answer != Z_BUF_ERROR) {
        return failure(source.path_, ": compressed data damaged after ", produced_, " bytes (",
                       stream_.msg ? stream_.msg : "no zlib stream", ")");
      }
    }
    return success();
  }

 private:
  Status refill(ByteSource& source) {
    size_t filled = 0;
    if (Status status = source.read_plain(input_, sizeof input_, filled); !status) return status;
    stream_.next_in = input_;
    stream_.avail_in = static_cast<uInt>(filled);
    if (filled != 0) return success();
    if (!at_member_start_ || produced_ == 0) {
      return failure(source.path_, ": compressed data cut off after ", produced_, " bytes");
    }
    finished_ = true;
    return success();
  }

  // A gzip file may be several members in a row (RFC 1952, 2.2). Anything else after the end is not ours.
  Status next_member(ByteSource& source) {
    at_member_start_ = true;
    if (stream_.avail_in == 0) {
      if (Status status = refill(source); !status) return status;
    }
    constexpr Bytef first_byte_of_gzip = 0x1f;
    if (finished_ || stream_.next_in[0] != first_byte_of_gzip) {
      finished_ = true;
    } else {
      inflateReset(&stream_);
    }
    return success();
  }

  z_stream stream_{};
  Bytef input_[1 << 16];
  uint64_t produced_ = 0;
  bool at_member_start_ = true, finished_ = false;
};

#else

class Inflater {
 public:
  Status read(ByteSource& source, void*, size_t, size_t&) {
    return failure(source.path_, ": is compressed, and this build is without zlib");
  }
};

#endif

ByteSource::ByteSource() = default;
ByteSource::~ByteSource() = default;

Status ByteSource::open(const std::string& path) {
  path_ = path;
  position_ = 0;
  if (Status status = file_size_of(path, size_); !status) return status;
  file_.open(path, std::ios::binary);
  if (!file_) return failure(path, ": cannot be opened");
  return success();
}

bool ByteSource::begins_as_gzip() {
  char mark[2] = {0, 0};
  file_.read(mark, 2);
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(position_));
  return mark[0] == '\x1f' && mark[1] == '\x8b';
}

Status ByteSource::start_inflating() {
#if TOOL_HAVE_ZLIB
  inflater_ = std::make_unique<Inflater>();
  if (!inflater_->start()) return failure(path_, ": zlib does not start (out of memory?)");
  return success();
#else
  return failure(path_, ": is compressed, and this build is without zlib");
#endif
}

Status ByteSource::read_plain(void* bytes, size_t wanted, size_t& got) {
  const uint64_t available = std::min<uint64_t>(wanted, remaining());
  file_.read(static_cast<char*>(bytes), static_cast<std::streamsize>(available));
  got = static_cast<size_t>(file_.gcount());
  position_ += got;
  if (got < available) return failure(path_, ": reading stopped at byte ", position_, " of ", size_);
  return success();
}

Status ByteSource::read(void* bytes, size_t wanted, size_t& got) {
  got = 0;
  return inflater_ ? inflater_->read(*this, bytes, wanted, got) : read_plain(bytes, wanted, got);
}

Status ByteSource::skip(uint64_t count) {
  if (!compressed()) {
    if (count > remaining()) {
      return failure(path_, ": ", size_, " bytes, the voxels should start at byte ", position_ + count);
    }
    position_ += count;
    file_.seekg(static_cast<std::streamoff>(position_));
    return success();
  }
  char ignored[4096];
  for (uint64_t left = count; left > 0;) {
    size_t got = 0;
    const size_t piece = static_cast<size_t>(std::min<uint64_t>(left, sizeof ignored));
    if (Status status = read(ignored, piece, got); !status) return status;
    if (got == 0) return failure(path_, ": ", count - left, " bytes unpacked, ", count, " are to be skipped");
    left -= got;
  }
  return success();
}

Status ByteSource::skip_lines(uint64_t count) {
  for (uint64_t line = 0; line < count; ++line) {
    char c = 0;
    for (size_t got = 1; c != '\n';) {
      if (Status status = read(&c, 1, got); !status) return status;
      if (got == 0) return failure(path_, ": ", line, " lines, ", count, " are to be skipped");
    }
  }
  return success();
}

Status ByteSource::skip_to_last(uint64_t count) {
  if (count > remaining()) return failure(path_, ": ", size_, " bytes, the header asks for ", count);
  return skip(remaining() - count);
}

Status read_text_header(const std::string& path, std::string& text) {
  constexpr size_t longest_header = size_t{1} << 20;
  ByteSource source;
  if (Status status = source.open(path); !status) return status;
  text.resize(static_cast<size_t>(std::min<uint64_t>(source.remaining(), longest_header)));
  size_t got = 0;
  return source.read(text.data(), text.size(), got);
}

size_t bytes_of(VoxelType type) {
  switch (type) {
    case VoxelType::i8:
    case VoxelType::u8: return 1;
    case VoxelType::i16:
    case VoxelType::u16: return 2;
    case VoxelType::i32:
    case VoxelType::u32:
    case VoxelType::f32: return 4;
    case VoxelType::i64:
    case VoxelType::u64:
    case VoxelType::f64: return 8;
  }
  return 8;
}

Status set_sizes(const std::string& place, const int64_t (&sizes)[3], Volume& volume) {
  int64_t voxels = 1;
  for (const int64_t size : sizes) {
    if (size < 1) return failure(place, ": sizes gives ", size);
    if (size > most_voxels / voxels) {
      return failure(place, ": sizes ", sizes[0], " x ", sizes[1], " x ", sizes[2],
                     " give more than the limit of 2147483648 voxels");
    }
    voxels *= size;
  }
  if (std::max({sizes[0], sizes[1], sizes[2]}) == most_voxels) {
    return failure(place, ": sizes gives ", most_voxels, ", more than 2147483647 along one axis");
  }
  volume.nx = static_cast<int>(sizes[0]);
  volume.ny = static_cast<int>(sizes[1]);
  volume.nz = static_cast<int>(sizes[2]);
  return success();
}

namespace {

template <class T>
void convert_as(const char* bytes, size_t count, const VoxelLayout& layout, float* values) {
  const bool scaled = layout.slope != 1 || layout.intercept != 0;
  for (size_t i = 0; i < count; ++i) {
    const T stored = load<T>(bytes + i * sizeof(T), layout.big_endian);
    values[i] = scaled ? static_cast<float>(layout.slope * static_cast<double>(stored) + layout.intercept)
                       : static_cast<float>(stored);
  }
}

void convert(const char* bytes, size_t count, const VoxelLayout& layout, float* values) {
  switch (layout.type) {
    case VoxelType::i8: return convert_as<int8_t>(bytes, count, layout, values);
    case VoxelType::u8: return convert_as<uint8_t>(bytes, count, layout, values);
    case VoxelType::i16: return convert_as<int16_t>(bytes, count, layout, values);
    case VoxelType::u16: return convert_as<uint16_t>(bytes, count, layout, values);
    case VoxelType::i32: return convert_as<int32_t>(bytes, count, layout, values);
    case VoxelType::u32: return convert_as<uint32_t>(bytes, count, layout, values);
    case VoxelType::i64: return convert_as<int64_t>(bytes, count, layout, values);
    case VoxelType::u64: return convert_as<uint64_t>(bytes, count, layout, values);
    case VoxelType::f32: return convert_as<float>(bytes, count, layout, values);
    case VoxelType::f64: return convert_as<double>(bytes, count, layout, values);
  }
}

// A vector that cannot grow ends the program, so the memory is asked for beforehand, each time the vector is to grow.
bool grow_to(std::vector<float>& values, size_t count) {
  void* probe = std::malloc(count * sizeof(float));
  if (probe == nullptr) return false;
  std::free(probe);
  values.reserve(count);
  return true;
}

Status check_finite(const std::string& path, const Volume& volume, size_t first, size_t last) {
  for (size_t i = first; i < last; ++i) {
    if (std::isfinite(volume.values[i])) continue;
    const size_t nx = static_cast<size_t>(volume.nx), ny = static_cast<size_t>(volume.ny);
    return failure(path, ": voxel (", i % nx, ", ", i / nx % ny, ", ", i / nx / ny, ") is not finite");
  }
  return success();
}

// A compressed stream carries its checksum behind the last byte: reading on makes zlib compare it.
Status check_end_of(ByteSource& source) {
  char beyond = 0;
  size_t got = 0;
  return source.compressed() ? source.read(&beyond, 1, got) : success();
}

}  // namespace

Status read_voxels(ByteSource& source, const std::string& header, const VoxelLayout& layout, Volume& volume) {
  const size_t voxel_bytes = bytes_of(layout.type);
  const size_t voxels =
      static_cast<size_t>(volume.nx) * static_cast<size_t>(volume.ny) * static_cast<size_t>(volume.nz);
  const uint64_t needed = uint64_t{voxels} * voxel_bytes;
  const auto too_short = [&](uint64_t there) {
    return failure(source.path(), ": ", there, " bytes of voxels, ",
                   header == source.path() ? "the header" : header.c_str(), " asks for ", needed);
  };
  if (!source.compressed() && source.remaining() < needed) return too_short(source.remaining());

  constexpr size_t piece = size_t{1} << 16;
  std::vector<char> bytes(piece * voxel_bytes);
  volume.values.clear();
  for (size_t done = 0; done < voxels;) {
    const size_t count = std::min(piece, voxels - done);
    size_t got = 0;
    if (Status status = source.read(bytes.data(), count * voxel_bytes, got); !status) return status;
    if (got < count * voxel_bytes) return too_short(done * voxel_bytes + got);
    if (volume.values.capacity() < done + count) {
      const size_t room = source.compressed() ? std::min(voxels, 2 * (done + count)) : voxels;
      if (!grow_to(volume.values, room)) return failure(header, ": no memory for ", voxels, " voxels");
    }
    volume.values.resize(done + count);
    convert(bytes.data(), count, layout, volume.values.data() + done);
    if (Status status = check_finite(source.path(), volume, done, done + count); !status) return status;
    done += count;
  }
  return check_end_of(source);
}

}  // namespace tool
