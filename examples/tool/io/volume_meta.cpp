// SPDX-License-Identifier: MIT
// volume_meta: MetaImage, voxels behind the header (.mha), in a file of their own or in several (.mhd), raw,
// zlib-compressed or as text. Format: https://itk.org/Wiki/ITK/MetaIO/Documentation
#include <algorithm>
#include <cmath>
#include <vector>

#include "tool/io/files.h"
#include "tool/io/volume_data.h"

namespace tool {

namespace {

struct MetaHeader {
  bool has_data_file = false;
  DataFiles files;       // none: the voxels follow the header
  bool is_list = false;  // of files, in the lines behind the header
  uint64_t end = 0;      // of the header, in bytes
  int64_t dimensions = 0, header_size = 0, times = 1;
  int64_t sizes[3] = {0, 0, 0};
  std::string sizes_place;  // empty until the sizes are known
  bool has_type = false, compressed = false;
  VoxelLayout layout;
  double spacing[3] = {1, 1, 1};
  bool has_spacing = false;
  std::vector<double> transform;  // the direction of each axis in turn; empty: the unit matrix
  std::vector<double> offset{0, 0, 0};
};

// MET_LONG has four bytes in a file, whatever the writer's compiler made of long.
constexpr TypeName meta_types[] = {
    {"MET_CHAR", VoxelType::i8},        {"MET_UCHAR", VoxelType::u8},  {"MET_SHORT", VoxelType::i16},
    {"MET_USHORT", VoxelType::u16},     {"MET_INT", VoxelType::i32},   {"MET_UINT", VoxelType::u32},
    {"MET_LONG", VoxelType::i32},       {"MET_ULONG", VoxelType::u32}, {"MET_LONG_LONG", VoxelType::i64},
    {"MET_ULONG_LONG", VoxelType::u64}, {"MET_FLOAT", VoxelType::f32}, {"MET_DOUBLE", VoxelType::f64}};

Status read_type(const std::string& place, std::string_view text, MetaHeader& header) {
  for (const TypeName& known : meta_types) {
    if (text != known.name) continue;
    header.layout.type = known.type;
    header.has_type = true;
    return success();
  }
  return failure(place, ": ElementType \"", text, "\" is not a real or integer number");
}

Status read_sizes(const std::string& place, std::string_view text, MetaHeader& header) {
  std::string_view word;
  int64_t count = 0;
  header.times = 1;
  for (; next_word(text, word); ++count) {
    int64_t size = 0;
    if (!parse_integer(word, size)) return failure(place, ": DimSize gives \"", word, "\"");
    if (count < 3) header.sizes[count] = size;
    if (count >= 3 && (size < 1 || size > most_voxels / header.times))
      return failure(place, ": DimSize gives ", size, " along axis ", count + 1);
    if (count >= 3) header.times *= size;
  }
  if (count < 3) return failure(place, ": DimSize gives ", count, " numbers, 3 are needed");
  if (header.dimensions != 0 && count != header.dimensions) {
    return failure(place, ": DimSize gives ", count, " numbers, NDims gives ", header.dimensions);
  }
  header.dimensions = count;
  header.sizes_place = place;
  return success();
}

// `least` numbers or more: headers of more than three dimensions have more.
Status read_reals(const std::string& place, std::string_view name, std::string_view text, size_t least,
                  std::vector<double>& values) {
  std::string_view word;
  for (values.clear(); next_word(text, word);) {
    values.push_back(0);
    if (!parse_real(word, values.back())) return failure(place, ": ", name, " gives \"", word, "\"");
  }
  if (values.size() >= least) return success();
  return failure(place, ": ", name, " gives ", values.size(), " numbers, ", least, " are needed");
}

// ElementSize is the spacing of headers without ElementSpacing.
Status read_spacing(const std::string& place, std::string_view name, std::string_view text, MetaHeader& header) {
  if (name == "ElementSize" && header.has_spacing) return success();
  header.has_spacing = header.has_spacing || name == "ElementSpacing";
  std::vector<double> given;
  if (Status status = read_reals(place, name, text, 1, given); !status) return status;
  for (size_t axis = 0; axis < std::min<size_t>(3, given.size()); ++axis) {
    const double size = std::fabs(given[axis]);
    header.spacing[axis] = std::isfinite(size) && size > 0 ? size : 1;
  }
  return success();
}

Status read_boolean(const std::string& place, std::string_view name, std::string_view text, bool& value) {
  const std::string word = lower_case(text);
  value = word == "true" || word == "t" || word == "1";
  if (value || word == "false" || word == "f" || word == "0") return success();
  return failure(place, ": ", name, " gives \"", text, "\"");
}

Status read_number(const std::string& place, std::string_view name, std::string_view text, int64_t least, int64_t most,
                   int64_t& value) {
  if (parse_integer(text, value) && value >= least && value <= most) return success();
  return failure(place, ": ", name, " gives \"", text, "\"");
}

// "LOCAL", "LIST" with the number of axes in each file, a pattern, or a name, which may have blanks.
Status read_data_file(const std::string& place, std::string_view text, MetaHeader& header) {
  if (text.empty()) return failure(place, ": ElementDataFile gives no name");
  header.has_data_file = true;
  header.is_list = text.substr(0, 4) == "LIST" && (text.size() == 4 || text[4] == ' ');
  if (header.is_list || lower_case(text) == "local") return success();
  std::string_view rest;
  if (text.find('%') != std::string_view::npos) return parse_pattern(place, text, header.files, rest);
  header.files.names.emplace_back(text);
  return success();
}

Status read_field(const std::string& place, std::string_view name, std::string_view text, MetaHeader& header) {
  if (name == "ElementType") return read_type(place, text, header);
  if (name == "DimSize") return read_sizes(place, text, header);
  if (name == "ElementSpacing" || name == "ElementSize") return read_spacing(place, name, text, header);
  if (name == "TransformMatrix" || name == "Rotation" || name == "Orientation") {
    return read_reals(place, name, text, 9, header.transform);
  }
  if (name == "Offset" || name == "Origin" || name == "Position") {
    return read_reals(place, name, text, 3, header.offset);
  }
  if (name == "ElementDataFile") return read_data_file(place, text, header);
  if (name == "CompressedData") return read_boolean(place, name, text, header.compressed);
  if (name == "ElementByteOrderMSB" || name == "BinaryDataByteOrderMSB") {
    return read_boolean(place, name, text, header.layout.big_endian);
  }
  if (name == "NDims") {
    if (Status status = read_number(place, name, text, 1, 10, header.dimensions); !status) return status;
    if (header.dimensions < 3) return failure(place, ": NDims gives ", header.dimensions, ", 3 are needed");
  }
  if (name == "HeaderSize") return read_number(place, name, text, -1, INT64_MAX, header.header_size);
  if (name == "BinaryData") {
    bool binary = false;
    if (Status status = read_boolean(place, name, text, binary); !status) return status;
    header.layout.text = !binary;
  }
  if (name == "ElementNumberOfChannels" && text != "1") {
    return failure(place, ": ElementNumberOfChannels gives ", text, ", one volume has 1");
  }
  return success();  // other fields are of no use here
}

// ElementDataFile is the header's last line.
Status read_header(const std::string& path, std::string_view text, MetaHeader& header) {
  LineReader lines{text};
  std::string_view line;
  while (!header.has_data_file && lines.next(line)) {
    if (trimmed(line).empty()) continue;
    const size_t equals = line.find('=');
    const std::string place = text_of(path, ": line ", lines.number);
    if (equals == std::string_view::npos) return failure(place, ": no \"Field = value\"");
    const std::string name(trimmed(line.substr(0, equals)));
    const std::string_view value = trimmed(line.substr(equals + 1));
    if (Status status = read_field(place, name, value, header); !status) return status;
  }
  header.end = lines.position;
  if (!header.has_type) return failure(path, ": the header gives no ElementType");
  if (header.sizes_place.empty()) return failure(path, ": the header gives no DimSize");
  if (!header.has_data_file) return failure(path, ": the header gives no ElementDataFile");
  if (!header.is_list) return success();
  read_names(text.substr(lines.position), header.files);
  return header.files.empty() ? failure(path, ": ElementDataFile = LIST without names of files") : success();
}

// MetaImage and ITK, whose format MetaImage is, count millimetres in LPS. The matrix has a row for each axis.
Status set_map(const std::string& path, const MetaHeader& header, Volume& volume) {
  const size_t row = static_cast<size_t>(header.dimensions);
  const bool is_given = !header.transform.empty();
  if (is_given && header.transform.size() != row * row)
    return failure(path, ": TransformMatrix gives ", header.transform.size(), " numbers, ", row * row, " are needed");
  for (size_t axis = 0; axis < 3; ++axis) {
    for (size_t k = 0; k < 3; ++k) {
      const double direction = is_given ? header.transform[axis * row + k] : k == axis ? 1 : 0;
      volume.to_world.axes[axis][k] = header.spacing[axis] * direction;
    }
    volume.to_world.origin[axis] = header.offset[axis];
  }
  volume.space = Space::lps;
  if (is_regular(volume.to_world)) return success();
  return failure(path, ": ElementSpacing, TransformMatrix and Offset give voxels no place or no volume");
}

}  // namespace

Status read_meta_image(const std::string& path, const VolumeRequest& request, Volume& volume) {
  std::string text;
  if (Status status = read_text_header(path, text); !status) return status;
  MetaHeader header;
  if (Status status = read_header(path, text, header); !status) return status;
  if (Status status = set_sizes(header.sizes_place, header.sizes, volume); !status) return status;
  if (Status status = set_map(path, header, volume); !status) return status;
  VoxelData data;
  data.header = path;
  data.header_end = header.end;
  data.files = header.files;
  data.packing = header.compressed ? Packing::deflate : Packing::none;
  data.layout = header.layout;
  data.times = static_cast<uint64_t>(header.times);
  data.byte_skip = std::min<int64_t>(0, header.header_size);
  if (header.header_size > 0 && !header.files.empty()) data.head_skip = static_cast<uint64_t>(header.header_size);
  return read_voxel_data(data, request, text_of(header.sizes_place, ": DimSize along axis 4"), volume);
}

}  // namespace tool
