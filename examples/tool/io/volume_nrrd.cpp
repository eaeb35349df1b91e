// SPDX-License-Identifier: MIT
// volume_nrrd: NRRD, with the voxels behind the header, in a file of their own or in several, in every encoding.
// Format: https://teem.sourceforge.net/nrrd/format.html
#include <algorithm>
#include <cmath>

#include "tool/io/files.h"
#include "tool/io/volume_data.h"

namespace tool {

namespace {

// More axes than teem, NRRD's own library, has.
constexpr size_t most_axes = 16;

struct Axis {
  int64_t size = 1;
  double spacing = 1;
  double unit = 1;  // millimetres in one, for the spacing
  Point direction{};
  bool has_direction = false;
  bool is_list = false;  // of numbers that belong to one place
};

struct NrrdHeader {
  DataFiles files;       // none: the voxels follow the header
  bool is_list = false;  // of files, in the lines behind the header
  uint64_t end = 0;      // of the header, in bytes
  int64_t dimension = 0, line_skip = 0, byte_skip = 0;
  Axis axes[most_axes];
  std::string sizes_place;  // empty until the sizes are known
  bool has_type = false, has_endian = false, has_encoding = false;
  Packing packing = Packing::none;
  VoxelLayout layout;
  Point origin{};
  double space_units[3] = {1, 1, 1};  // millimetres in one, for each coordinate of the space
  std::string unknown_unit;
  Space space = Space::unnamed;
  bool x_to_left = false;  // of a RAS map
};

constexpr TypeName nrrd_types[] = {{"signed char", VoxelType::i8},
                                   {"int8", VoxelType::i8},
                                   {"int8_t", VoxelType::i8},
                                   {"uchar", VoxelType::u8},
                                   {"unsigned char", VoxelType::u8},
                                   {"uint8", VoxelType::u8},
                                   {"uint8_t", VoxelType::u8},
                                   {"short", VoxelType::i16},
                                   {"short int", VoxelType::i16},
                                   {"signed short", VoxelType::i16},
                                   {"signed short int", VoxelType::i16},
                                   {"int16", VoxelType::i16},
                                   {"int16_t", VoxelType::i16},
                                   {"ushort", VoxelType::u16},
                                   {"unsigned short", VoxelType::u16},
                                   {"unsigned short int", VoxelType::u16},
                                   {"uint16", VoxelType::u16},
                                   {"uint16_t", VoxelType::u16},
                                   {"int", VoxelType::i32},
                                   {"signed int", VoxelType::i32},
                                   {"int32", VoxelType::i32},
                                   {"int32_t", VoxelType::i32},
                                   {"uint", VoxelType::u32},
                                   {"unsigned int", VoxelType::u32},
                                   {"uint32", VoxelType::u32},
                                   {"uint32_t", VoxelType::u32},
                                   {"longlong", VoxelType::i64},
                                   {"long long", VoxelType::i64},
                                   {"long long int", VoxelType::i64},
                                   {"signed long long", VoxelType::i64},
                                   {"signed long long int", VoxelType::i64},
                                   {"int64", VoxelType::i64},
                                   {"int64_t", VoxelType::i64},
                                   {"ulonglong", VoxelType::u64},
                                   {"unsigned long long", VoxelType::u64},
                                   {"unsigned long long int", VoxelType::u64},
                                   {"uint64", VoxelType::u64},
                                   {"uint64_t", VoxelType::u64},
                                   {"float", VoxelType::f32},
                                   {"double", VoxelType::f64}};

Status read_type(const std::string& place, std::string_view text, NrrdHeader& header) {
  for (const TypeName& known : nrrd_types) {
    if (lower_case(text) != known.name) continue;
    header.layout.type = known.type;
    header.has_type = true;
    return success();
  }
  return failure(place, ": type \"", text, "\" is not a real or integer number");
}

Status read_sizes(const std::string& place, std::string_view text, NrrdHeader& header) {
  std::string_view word;
  size_t count = 0;
  for (; next_word(text, word); ++count) {
    if (count == most_axes) return failure(place, ": sizes gives more than ", most_axes, " numbers");
    if (!parse_integer(word, header.axes[count].size)) return failure(place, ": sizes gives \"", word, "\"");
  }
  if (count < 3) return failure(place, ": sizes gives ", count, " numbers, 3 are needed");
  if (header.dimension != 0 && static_cast<int64_t>(count) != header.dimension) {
    return failure(place, ": sizes gives ", count, " numbers, dimension gives ", header.dimension);
  }
  header.dimension = static_cast<int64_t>(count);
  header.sizes_place = place;
  return success();
}

// Kinds of axes whose numbers belong to one place.
void read_kinds(std::string_view text, NrrdHeader& header) {
  std::string_view word;
  for (size_t k = 0; k < most_axes && next_word(text, word); ++k) {
    const std::string kind = lower_case(word);
    bool spatial = false;
    for (const char* known : {"domain", "space", "time", "none", "???", "stub"}) spatial = spatial || kind == known;
    header.axes[k].is_list = !spatial;
  }
}

double size_of_step(double spacing) {
  const double size = std::fabs(spacing);
  return std::isfinite(size) && size > 0 ? size : 1;
}

Status read_spacings(const std::string& place, std::string_view text, NrrdHeader& header) {
  std::string_view word;
  for (size_t axis = 0; next_word(text, word); ++axis) {
    double spacing = 0;
    if (!parse_real(word, spacing)) return failure(place, ": spacings gives \"", word, "\"");
    if (axis < most_axes) header.axes[axis].spacing = size_of_step(spacing);
  }
  return success();
}

struct Unit {
  const char* name;
  double mm;
};
constexpr Unit length_units[] = {{"", 1},           {"none", 1},        {"???", 1},           {"mm", 1},
                                 {"millimeter", 1}, {"millimeters", 1}, {"millimetre", 1},    {"millimetres", 1},
                                 {"nm", 1e-6},      {"um", 1e-3},       {"\xc2\xb5m", 1e-3},  {"\xce\xbcm", 1e-3},
                                 {"micron", 1e-3},  {"microns", 1e-3},  {"micrometer", 1e-3}, {"micrometers", 1e-3},
                                 {"cm", 10},        {"centimeter", 10}, {"m", 1e3},           {"meter", 1e3}};

// "mm" "mm" "um": units in quotes. An unknown unit counts as millimetres. set(k, mm) receives the k-th.
template <class Set>
void read_units(std::string_view text, NrrdHeader& header, Set set) {
  for (size_t k = 0; k < most_axes; ++k) {
    const size_t open = text.find('"'), close = open == text.npos ? open : text.find('"', open + 1);
    if (close == std::string_view::npos) return;
    const std::string name = lower_case(trimmed(text.substr(open + 1, close - open - 1)));
    text.remove_prefix(close + 1);
    const auto known = std::find_if(std::begin(length_units), std::end(length_units),
                                    [&](const Unit& unit) { return name == unit.name; });
    if (known != std::end(length_units)) {
      set(k, known->mm);
    } else if (!header.axes[k].is_list) {
      header.unknown_unit = name;
    }
  }
}

// "(1,0,0)", of which `text` gives up the front. Beyond three numbers the space has further dimensions.
Status read_vector(const std::string& place, std::string_view name, std::string_view& text, Point& vector) {
  const size_t end = text.find(')');
  if (end == std::string_view::npos) return failure(place, ": ", name, " lacks a \")\"");
  std::string_view numbers = text.substr(1, end - 1);
  text.remove_prefix(end + 1);
  vector = {};
  for (size_t k = 0; !numbers.empty(); ++k) {
    const size_t comma = std::min(numbers.find(','), numbers.size());
    double part = 0;
    if (!parse_real(trimmed(numbers.substr(0, comma)), part)) {
      return failure(place, ": ", name, " gives \"", numbers.substr(0, comma), "\"");
    }
    if (k < 3) vector[k] = part;
    numbers.remove_prefix(std::min(comma + 1, numbers.size()));
  }
  return success();
}

// "(1,0,0) (0,1,0) (0,0,2) none": one voxel along each axis, in the space. An axis without a direction is left alone.
Status read_directions(const std::string& place, std::string_view text, NrrdHeader& header) {
  for (Axis& axis : header.axes) {
    text = trimmed(text);
    if (text.empty() || text.front() != '(') {
      std::string_view none;
      if (!next_word(text, none)) break;
      continue;
    }
    if (Status status = read_vector(place, "space directions", text, axis.direction); !status) return status;
    axis.has_direction = true;
  }
  return success();
}

Status read_space(std::string_view text, NrrdHeader& header) {
  const std::string name = lower_case(text);
  const auto begins = [&](const char* long_name, const char* short_name) {
    return name.rfind(long_name, 0) == 0 || name == short_name || name == text_of(short_name, "t");
  };
  header.x_to_left = begins("left-anterior-superior", "las");
  if (begins("left-posterior-superior", "lps")) header.space = Space::lps;
  if (begins("right-anterior-superior", "ras") || header.x_to_left) header.space = Space::ras;
  return success();
}

Status read_origin(const std::string& place, std::string_view text, NrrdHeader& header) {
  if (text.empty() || text.front() != '(') return failure(place, ": space origin gives \"", text, "\"");
  return read_vector(place, "space origin", text, header.origin);
}

// Where the three axes of space begin: behind the first if that is a list of numbers of one place.
size_t first_axis_of_space(const NrrdHeader& header) {
  const bool with_list = header.axes[0].is_list || (!header.axes[0].has_direction && header.axes[3].has_direction);
  return header.dimension > 3 && with_list ? 1 : 0;
}

// In millimetres. LAS becomes RAS.
Status set_map(const std::string& path, const NrrdHeader& header, Volume& volume) {
  const Axis* axes = header.axes + first_axis_of_space(header);
  Affine& map = volume.to_world;
  map.origin = header.origin;
  for (size_t k = 0; k < 3; ++k) {
    map.origin[k] *= header.space_units[k];
    for (size_t axis = 0; axis < 3; ++axis) map.axes[axis][k] = header.space_units[k] * axes[axis].direction[k];
  }
  for (size_t axis = 0; axis < 3; ++axis) {
    if (axes[axis].has_direction) continue;
    map.axes[axis] = {};
    map.axes[axis][axis] = axes[axis].unit * axes[axis].spacing;
  }
  volume.space = header.space;
  if (!header.unknown_unit.empty())
    volume.note = text_of(path, ": unit \"", header.unknown_unit, "\" is unknown and counts as mm");
  if (header.x_to_left)
    for (Point* p : {&map.axes[0], &map.axes[1], &map.axes[2], &map.origin}) (*p)[0] = 0 - (*p)[0];
  if (is_regular(map)) return success();
  return failure(path, ": space directions and space origin give voxels no place or no volume");
}

// Sizes in space, and the number of volumes: numbers of one place, or time points.
Status set_sizes_and_times(const NrrdHeader& header, Volume& volume, VoxelData& data, std::string& several) {
  const size_t first = first_axis_of_space(header);
  const Axis* axes = header.axes + first;
  const int64_t sizes[3] = {axes[0].size, axes[1].size, axes[2].size};
  if (Status status = set_sizes(header.sizes_place, sizes, volume); !status) return status;
  several = text_of(header.sizes_place, ": sizes along axis ", first == 1 ? 1 : 4);
  data.interleaved = first == 1;
  data.times = 1;
  for (size_t k = 0; k < static_cast<size_t>(header.dimension); ++k) {
    if (k >= first && k < first + 3) continue;
    const int64_t size = header.axes[k].size;
    if (size < 1 || size > most_voxels / static_cast<int64_t>(data.times))
      return failure(header.sizes_place, ": sizes gives ", size, " along axis ", k + 1);
    if (data.interleaved && k > 0 && size != 1)
      return failure(header.sizes_place, ": sizes gives ", size, " along axis ", k + 1, " beside those of axis 1");
    data.times *= static_cast<uint64_t>(size);
  }
  return success();
}

Status read_encoding(const std::string& place, std::string_view text, NrrdHeader& header) {
  const std::string encoding = lower_case(text);
  header.has_encoding = true;
  if (encoding == "gzip" || encoding == "gz") header.packing = Packing::deflate;
  if (encoding == "bzip2" || encoding == "bz2") header.packing = Packing::bzip2;
  if (encoding == "hex") header.packing = Packing::hex;
  header.layout.text = encoding == "ascii" || encoding == "text" || encoding == "txt";
  if (header.packing != Packing::none || header.layout.text || encoding == "raw") return success();
  return failure(place, ": encoding \"", text, "\" is not read (raw, gzip, bzip2, hex and ascii are)");
}

// "LIST" with the number of axes in each file, a pattern, or a name, which may have blanks.
Status read_data_file(const std::string& place, std::string_view text, NrrdHeader& header) {
  if (text.empty()) return failure(place, ": data file gives no name");
  header.is_list = text.substr(0, 4) == "LIST" && (text.size() == 4 || text[4] == ' ');
  header.files = DataFiles();
  std::string_view rest;
  if (text.find('%') != std::string_view::npos) return parse_pattern(place, text, header.files, rest);
  if (!header.is_list) header.files.names.emplace_back(text);
  return success();
}

Status read_whole_number(const std::string& place, std::string_view name, std::string_view text, int64_t least,
                         int64_t& value) {
  if (parse_integer(text, value) && value >= least) return success();
  return failure(place, ": ", name, " gives \"", text, "\"");
}

Status read_field(const std::string& place, std::string_view name, std::string_view text, NrrdHeader& header) {
  if (name == "type") return read_type(place, text, header);
  if (name == "sizes") return read_sizes(place, text, header);
  if (name == "spacings") return read_spacings(place, text, header);
  if (name == "kinds") read_kinds(text, header);
  if (name == "units") read_units(text, header, [&](size_t k, double mm) { header.axes[k].unit = mm; });
  if (name == "space units")
    read_units(text, header, [&](size_t k, double mm) {
      if (k < 3) header.space_units[k] = mm;
    });
  if (name == "space") return read_space(text, header);
  if (name == "space origin") return read_origin(place, text, header);
  if (name == "space directions") return read_directions(place, text, header);
  if (name == "encoding") return read_encoding(place, text, header);
  if (name == "dimension") {
    if (Status status = read_whole_number(place, name, text, 1, header.dimension); !status) return status;
    if (header.dimension > static_cast<int64_t>(most_axes))
      return failure(place, ": dimension gives ", text, ", more than ", most_axes);
  }
  if (name == "line skip" || name == "lineskip") return read_whole_number(place, name, text, 0, header.line_skip);
  if (name == "byte skip" || name == "byteskip") return read_whole_number(place, name, text, -1, header.byte_skip);
  if (name == "endian") {
    const std::string order = lower_case(text);
    if (order != "big" && order != "little") return failure(place, ": endian gives \"", text, "\"");
    header.layout.big_endian = order == "big";
    header.has_endian = true;
  }
  if (name == "data file" || name == "datafile") return read_data_file(place, text, header);
  return success();  // other fields are of no use here
}

Status check_complete(const std::string& path, const NrrdHeader& header) {
  if (!header.has_type) return failure(path, ": the header gives no type");
  if (header.dimension < 3) return failure(path, ": the header gives no dimension of at least 3");
  if (header.sizes_place.empty()) return failure(path, ": the header gives no sizes");
  if (!header.has_encoding) return failure(path, ": the header gives no encoding");
  const bool bytes_in_order = header.layout.text || bytes_of(header.layout.type) == 1;
  if (!header.has_endian && !bytes_in_order) return failure(path, ": the header gives no endian");
  return success();
}

// The header ends at an empty line, or with the file where the voxels have a file of their own.
Status read_header(const std::string& path, std::string_view text, NrrdHeader& header) {
  LineReader lines{text};
  std::string_view line;
  if (!lines.next(line) || line.substr(0, 4) != "NRRD") {
    return failure(path, ": line 1: is not NRRD (no \"NRRD\" at the start)");
  }
  // A list of files takes the header's remaining lines.
  while (!header.is_list && lines.next(line) && !line.empty()) {
    if (line.front() == '#') continue;
    const size_t colon = line.find(':');
    const std::string place = text_of(path, ": line ", lines.number);
    if (colon == std::string_view::npos) return failure(place, ": no \"field: value\"");
    if (colon + 1 < line.size() && line[colon + 1] == '=') continue;  // a key/value pair
    const std::string name = lower_case(trimmed(line.substr(0, colon)));
    const std::string_view value = trimmed(line.substr(colon + 1));
    if (Status status = read_field(place, name, value, header); !status) return status;
  }
  header.end = lines.position;
  if (header.is_list) read_names(text.substr(lines.position), header.files);
  if (header.is_list && header.files.empty()) return failure(path, ": data file LIST without names of files");
  return check_complete(path, header);
}

}  // namespace

Status read_nrrd(const std::string& path, const VolumeRequest& request, Volume& volume) {
  std::string text, several;
  if (Status status = read_text_header(path, text); !status) return status;
  NrrdHeader header;
  if (Status status = read_header(path, text, header); !status) return status;
  VoxelData data;
  if (Status status = set_sizes_and_times(header, volume, data, several); !status) return status;
  if (Status status = set_map(path, header, volume); !status) return status;
  data.header = path;
  data.header_end = header.end;
  data.files = header.files;
  data.packing = header.packing;
  data.line_skip = static_cast<uint64_t>(header.line_skip);
  data.byte_skip = header.byte_skip;
  data.layout = header.layout;
  return read_voxel_data(data, request, several, volume);
}

}  // namespace tool
