// SPDX-License-Identifier: MIT
#include "tool/io/volume_source.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "tool/io/files.h"

namespace tool {

Status ByteSource::open(const std::string& path) {
  path_ = path;
  position_ = 0;
  decoders_.clear();
  if (Status status = file_size_of(path, size_); !status) return status;
  file_.open(path, std::ios::binary);
  if (!file_) return failure(path, ": cannot be opened");
  return success();
}

Status ByteSource::open_unpacked(const std::string& path) {
  if (Status status = open(path); !status) return status;
  const Packing mark = packing();
  return mark == Packing::none ? success() : start_unpacking(mark);
}

Packing ByteSource::packing() {
  char mark[longest_mark] = {};
  file_.read(mark, sizeof mark);
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(position_));
  return packing_of({mark, sizeof mark});
}

Status ByteSource::start_unpacking(Packing packing) {
  decoders_.emplace_back();
  return make_decoder(path_, packing, decoders_.back());
}

Status ByteSource::read_plain(void* bytes, size_t wanted, size_t& got) {
  const uint64_t available = std::min<uint64_t>(wanted, remaining());
  file_.read(static_cast<char*>(bytes), static_cast<std::streamsize>(available));
  got = static_cast<size_t>(file_.gcount());
  position_ += got;
  if (got < available) return failure(path_, ": reading stopped at byte ", position_, " of ", size_);
  return success();
}

Status ByteSource::read_behind(size_t decoders, void* bytes, size_t wanted, size_t& got) {
  got = 0;
  if (decoders == 0) return read_plain(bytes, wanted, got);
  const Decoder::Upstream upstream = [&](void* packed, size_t most, size_t& filled) {
    return read_behind(decoders - 1, packed, most, filled);
  };
  return decoders_[decoders - 1]->read(upstream, bytes, wanted, got);
}

Status ByteSource::skip(uint64_t count) {
  if (!packed()) {
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
  if (Status status = source.open_unpacked(path); !status) return status;
  const uint64_t most = source.packed() ? longest_header : std::min<uint64_t>(source.remaining(), longest_header);
  text.resize(static_cast<size_t>(most));
  size_t got = 0;
  Status status = source.read(text.data(), text.size(), got);
  text.resize(got);
  return status;
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
    const T stored = load<T>(bytes + (i * layout.components + layout.component) * sizeof(T), layout.big_endian);
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

Status check_finite(const std::string& path, const Volume& volume, size_t first, bool allow_nan) {
  for (size_t i = first; i < volume.values.size(); ++i) {
    const float value = volume.values[i];
    if (std::isfinite(value) || (allow_nan && std::isnan(value))) continue;
    const size_t nx = static_cast<size_t>(volume.nx), ny = static_cast<size_t>(volume.ny);
    return failure(path, ": voxel (", i % nx, ", ", i / nx % ny, ", ", i / nx / ny, ") is not finite",
                   std::isnan(value) ? " (NaN; --nan-as-background takes NaN for background)" : "");
  }
  return success();
}

// Numbers of a text, one by one.
class NumberReader {
 public:
  explicit NumberReader(ByteSource& source) : source_(source) {}

  // At the end, `word` is empty.
  Status next(std::string& word) {
    word.clear();
    for (char c = 0;;) {
      size_t got = 0;
      if (Status status = source_.read(&c, 1, got); !status) return status;
      const bool blank = std::strchr(" \t\r\n\v\f,", c) != nullptr;
      if (got == 0 || (blank && !word.empty())) return success();
      if (blank) continue;
      constexpr size_t longest_number = 100;
      if (word.size() == longest_number) return failure(source_.path(), ": \"", word, "...\" is not a number");
      word += c;
    }
  }

 private:
  ByteSource& source_;
};

Status read_text_piece(ByteSource& source, size_t count, const VoxelLayout& layout, std::vector<float>& values,
                       size_t& got) {
  NumberReader numbers(source);
  std::string word;
  got = 0;
  for (size_t i = 0; i < count * layout.components; ++i) {
    got = i / layout.components;
    if (Status status = numbers.next(word); !status) return status;
    if (word.empty()) return success();
    if (layout.components > 1 && i % layout.components != layout.component) continue;
    double number = 0;
    if (!parse_real(word, number)) return failure(source.path(), ": \"", word, "\" is not a number");
    values.push_back(static_cast<float>(layout.slope * number + layout.intercept));
  }
  got = count;
  return success();
}

Status read_binary_piece(ByteSource& source, size_t count, const VoxelLayout& layout, std::vector<float>& values,
                         size_t& got) {
  const size_t voxel_bytes = bytes_of(layout);
  std::vector<char> bytes(count * voxel_bytes);
  size_t filled = 0;
  if (Status status = source.read(bytes.data(), bytes.size(), filled); !status) return status;
  got = filled / voxel_bytes;
  const size_t before = values.size();
  values.resize(before + got);
  convert(bytes.data(), got, layout, values.data() + before);
  return success();
}

}  // namespace

Status skip_numbers(ByteSource& source, uint64_t count) {
  NumberReader numbers(source);
  std::string word;
  for (uint64_t i = 0; i < count; ++i) {
    if (Status status = numbers.next(word); !status) return status;
    if (word.empty()) return failure(source.path(), ": ", i, " voxels, ", count, " are to be skipped");
  }
  return success();
}

Status check_end_of(ByteSource& source) {
  char beyond = 0;
  size_t got = 0;
  return source.packed() ? source.read(&beyond, 1, got) : success();
}

Status append_voxels(std::string_view bytes, const std::string& place, const VoxelDemand& demand, Volume& volume) {
  const size_t first = volume.values.size(), count = static_cast<size_t>(demand.count);
  const bool grows = volume.values.capacity() < first + count;
  if (grows && !grow_to(volume.values, std::max(first + count, 2 * first)))
    return failure(demand.header, ": no memory for ", first + count, " voxels");
  volume.values.resize(first + count);
  convert(bytes.data(), count, demand.layout, volume.values.data() + first);
  return check_finite(place, volume, first, demand.allow_nan);
}

Status read_voxels(ByteSource& source, const VoxelDemand& demand, Volume& volume) {
  const VoxelLayout& layout = demand.layout;
  const size_t count = static_cast<size_t>(demand.count), first = volume.values.size();
  const size_t voxel_bytes = bytes_of(layout);
  const auto too_short = [&](uint64_t there) {
    const std::string header = demand.header == source.path() ? "the header" : demand.header;
    if (layout.text) return failure(source.path(), ": ", there, " voxels, ", header, " asks for ", count);
    return failure(source.path(), ": ", there * voxel_bytes, " bytes of voxels, ", header, " asks for ",
                   count * voxel_bytes);
  };
  const bool plain = !source.packed() && !layout.text;
  if (plain && source.remaining() < count * voxel_bytes) {
    return failure(source.path(), ": ", source.remaining(), " bytes of voxels, ",
                   demand.header == source.path() ? "the header" : demand.header, " asks for ", count * voxel_bytes);
  }
  const size_t piece = (size_t{1} << 16) / layout.components;
  for (size_t done = 0; done < count;) {
    const size_t wanted = std::min(piece, count - done), now = first + done + wanted;
    if (volume.values.capacity() < now) {
      const size_t room = plain ? first + count : std::min(first + count, 2 * now);
      if (!grow_to(volume.values, room)) return failure(demand.header, ": no memory for ", room, " voxels");
    }
    size_t got = 0;
    const auto read_piece = layout.text ? read_text_piece : read_binary_piece;
    if (Status status = read_piece(source, wanted, layout, volume.values, got); !status) return status;
    if (got < wanted) return too_short(done + got);
    if (Status status = check_finite(source.path(), volume, first + done, demand.allow_nan); !status) return status;
    done += wanted;
  }
  return success();
}

}  // namespace tool
