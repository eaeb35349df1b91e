// SPDX-License-Identifier: MIT
#include "tool/io/volume_data.h"

#include <algorithm>
#include <cctype>
#include <cstdio>

#include "tool/io/files.h"

namespace tool {

namespace {

// Voxels of all volumes of a file together, so that counts of bytes stay far from overflow.
constexpr uint64_t most_voxels_of_all = uint64_t{1} << 48;

Status open_part(const VoxelData& data, const std::string& path, uint64_t voxels, ByteSource& source) {
  const bool attached = data.files.empty();
  const bool by_content = attached || data.unpacked_by_content;
  if (Status status = by_content ? source.open_unpacked(path) : source.open(path); !status) return status;
  if (attached) {
    if (Status status = source.skip(data.header_end); !status) return status;
  }
  // Lines are skipped in the stored file, bytes in the unpacked data.
  if (Status status = source.skip_lines(data.line_skip); !status) return status;
  if (Status status = source.skip(data.head_skip); !status) return status;
  const uint64_t bytes = voxels * bytes_of(data.layout);
  Packing packing = data.packing;
  // Raw data that somebody has compressed since.
  const bool too_short = !source.packed() && !data.layout.text && source.remaining() < bytes;
  if (packing == Packing::none && too_short) packing = source.packing();
  if (packing != Packing::none) {
    if (Status status = source.start_unpacking(packing); !status) return status;
  }
  if (data.byte_skip >= 0) return source.skip(static_cast<uint64_t>(data.byte_skip));
  if (!source.packed() && !data.layout.text) return source.skip_to_last(bytes);
  return failure(path, ": a skip of -1 is for raw voxels only");
}

// Voxels `first` to `last` of a part that holds `voxels`.
Status read_part(const VoxelData& data, const std::string& path, uint64_t voxels, uint64_t first, VoxelDemand& demand,
                 Volume& volume) {
  ByteSource source;
  if (Status status = open_part(data, path, voxels, source); !status) return status;
  Status skipped = data.layout.text ? skip_numbers(source, first) : source.skip(first * bytes_of(data.layout));
  if (!skipped) return skipped;
  if (Status status = read_voxels(source, demand, volume); !status) return status;
  return first + demand.count == voxels ? check_end_of(source) : success();
}

// The only conversion of a pattern: "%d" with a width, zeros or blanks before. npos: none, or several.
size_t end_of_conversion(std::string_view pattern, size_t percent) {
  size_t at = percent + 1;
  while (at < pattern.size() && std::isdigit(static_cast<unsigned char>(pattern[at])) != 0) ++at;
  const bool is_number = at < pattern.size() && std::string_view("diu").find(pattern[at]) != std::string_view::npos;
  const bool only = pattern.find('%', percent + 1) == std::string_view::npos;
  return is_number && only && at - percent <= 3 ? at : std::string_view::npos;
}

}  // namespace

uint64_t DataFiles::count() const {
  return pattern.empty() ? names.size() : static_cast<uint64_t>((last - first) / step) + 1;
}

std::string DataFiles::name(uint64_t index) const {
  if (pattern.empty()) return names[index];
  const size_t percent = pattern.find('%'), end = end_of_conversion(pattern, percent);
  const std::string_view width = std::string_view(pattern).substr(percent + 1, end - percent - 1);
  std::string number = std::to_string(first + static_cast<int64_t>(index) * step);
  int64_t least = 0;
  if (!width.empty()) parse_integer(width, least);
  const char fill = !width.empty() && width[0] == '0' ? '0' : ' ';
  while (number.size() < static_cast<size_t>(least)) number.insert(number.begin(), fill);
  return pattern.substr(0, percent) + number + pattern.substr(end + 1);
}

Status parse_pattern(const std::string& place, std::string_view text, DataFiles& files, std::string_view& rest) {
  std::string_view word;
  rest = text;
  next_word(rest, word);
  files.pattern = word;
  const size_t percent = word.find('%');
  if (percent == std::string_view::npos || end_of_conversion(word, percent) == std::string_view::npos)
    return failure(place, ": \"", word, "\" is no name with one number such as %03d");
  constexpr int64_t most = 1 << 30;
  for (int64_t* number : {&files.first, &files.last, &files.step}) {
    if (!next_word(rest, word) && number == &files.step) break;
    if (!parse_integer(word, *number) || *number > most || *number < -most)
      return failure(place, ": \"", text, "\" lacks the first and last number of the files");
  }
  const bool forward = files.step > 0 && files.last >= files.first,
             backward = files.step < 0 && files.last <= files.first;
  if (forward || backward) return success();
  return failure(place, ": ", files.first, " to ", files.last, " in steps of ", files.step, " are no files");
}

void read_names(std::string_view text, DataFiles& files) {
  LineReader lines{text};
  for (std::string_view line; lines.next(line);) {
    if (!trimmed(line).empty()) files.names.emplace_back(trimmed(line));
  }
}

namespace {

// The volume number `time` of data.times.
Status read_volume_of(const VoxelData& data, const VolumeRequest& request, uint64_t time, Volume& volume) {
  const uint64_t voxels =
      static_cast<uint64_t>(volume.nx) * static_cast<uint64_t>(volume.ny) * static_cast<uint64_t>(volume.nz);
  if (data.times > most_voxels_of_all / voxels) return failure(data.header, ": too many voxels");
  const uint64_t all = voxels * data.times, parts = data.files.empty() ? 1 : data.files.count();
  if (all % parts != 0)
    return failure(data.header, ": ", all, " voxels are not shared evenly by ", parts, " data files");
  const uint64_t each = all / parts, begin = time * voxels, end = begin + voxels;
  volume.values.clear();
  for (uint64_t part = begin / each; part * each < end; ++part) {
    const uint64_t first = std::max(begin, part * each), last = std::min(end, (part + 1) * each);
    VoxelDemand demand{data.header, data.layout, last - first, request.allow_nan};
    const std::string path = data.files.empty() ? data.header : beside(data.header, data.files.name(part));
    if (Status status = read_part(data, path, each, first - part * each, demand, volume); !status) return status;
  }
  return success();
}

}  // namespace

Status read_voxel_data(const VoxelData& data, const VolumeRequest& request, const std::string& several,
                       Volume& volume) {
  if (!request.time && data.times != 1)
    return failure(several, " is ", data.times, ": --time K, from 0 to ", data.times - 1, ", picks one time point");
  const uint64_t time = request.time.value_or(0);
  if (time >= data.times) return failure(several, " is ", data.times, ", so that there is no --time ", time);
  if (!data.interleaved) return read_volume_of(data, request, time, volume);
  if (data.times > most_components) return failure(several, " is ", data.times, ", more than ", most_components);
  VoxelData one = data;
  one.times = 1;
  one.layout.components = static_cast<uint32_t>(data.times);
  one.layout.component = static_cast<uint32_t>(time);
  return read_volume_of(one, request, 0, volume);
}

}  // namespace tool
