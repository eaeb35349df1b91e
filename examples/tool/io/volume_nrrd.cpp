// SPDX-License-Identifier: MIT
// volume_nrrd: NRRD, with the voxels behind the header or in a file of their own, raw or gzip.
// Format: https://teem.sourceforge.net/nrrd/format.html
#include <algorithm>
#include <cmath>

#include "tool/io/files.h"
#include "tool/io/volume_io.h"
#include "tool/io/volume_source.h"

namespace tool {

namespace {

struct NrrdHeader {
  std::string data_file;  // empty: the voxels follow the header
  uint64_t end = 0;       // of the header, in bytes
  int64_t dimension = 0, line_skip = 0, byte_skip = 0;
  int64_t sizes[3] = {0, 0, 0};
  std::string sizes_place;  // empty until the sizes are known
  bool has_type = false, has_endian = false, gzip = false, has_encoding = false;
  VoxelLayout layout;
  Affine map;  // space directions, space origin
  bool has_direction[3] = {false, false, false};
  double spacings[3] = {1, 1, 1};     // of axes without direction
  double units[3] = {1, 1, 1};        // millimetres in one, for each spacing
  double space_units[3] = {1, 1, 1};  // and for each coordinate of the space
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
  int64_t count = 0;
  for (; next_word(text, word); ++count) {
    int64_t size = 0;
    if (!parse_integer(word, size)) return failure(place, ": sizes gives \"", word, "\"");
    if (count < 3) header.sizes[count] = size;
    if (count >= 3 && size != 1) return failure(place, ": sizes gives ", size, " along axis 4, one volume has 1");
  }
  if (count < 3) return failure(place, ": sizes gives ", count, " numbers, 3 are needed");
  if (header.dimension != 0 && count != header.dimension) {
    return failure(place, ": sizes gives ", count, " numbers, dimension gives ", header.dimension);
  }
  header.sizes_place = place;
  return success();
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
    if (axis < 3) header.spacings[axis] = size_of_step(spacing);
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

// "mm" "mm" "um": three units in quotes; more are of further axes. An unknown unit counts as millimetres.
void read_units(std::string_view text, double (&units)[3], NrrdHeader& header) {
  for (double& mm : units) {
    const size_t open = text.find('"'), close = open == text.npos ? open : text.find('"', open + 1);
    if (close == std::string_view::npos) return;
    const std::string name = lower_case(trimmed(text.substr(open + 1, close - open - 1)));
    text.remove_prefix(close + 1);
    const auto known = std::find_if(std::begin(length_units), std::end(length_units),
                                    [&](const Unit& unit) { return name == unit.name; });
    if (known == std::end(length_units))
      header.unknown_unit = name;
    else
      mm = known->mm;
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
  for (size_t k = 0; k < 3; ++k) {
    text = trimmed(text);
    if (text.empty() || text.front() != '(') {
      std::string_view none;
      if (!next_word(text, none)) break;
      continue;
    }
    if (Status status = read_vector(place, "space directions", text, header.map.axes[k]); !status) return status;
    header.has_direction[k] = true;
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
  return read_vector(place, "space origin", text, header.map.origin);
}

// In millimetres. LAS becomes RAS.
Status set_map(const std::string& path, const NrrdHeader& header, Volume& volume) {
  volume.to_world = header.map;
  for (size_t k = 0; k < 3; ++k) {
    volume.to_world.origin[k] *= header.space_units[k];
    for (size_t axis = 0; axis < 3; ++axis) volume.to_world.axes[axis][k] *= header.space_units[k];
  }
  for (size_t axis = 0; axis < 3; ++axis) {
    if (header.has_direction[axis]) continue;
    volume.to_world.axes[axis] = {};
    volume.to_world.axes[axis][axis] = header.units[axis] * header.spacings[axis];
  }
  volume.space = header.space;
  if (!header.unknown_unit.empty())
    volume.note = text_of(path, ": unit \"", header.unknown_unit, "\" is unknown and counts as mm");
  if (header.x_to_left)
    for (Point* p :
         {&volume.to_world.axes[0], &volume.to_world.axes[1], &volume.to_world.axes[2], &volume.to_world.origin})
      (*p)[0] = 0 - (*p)[0];
  if (is_regular(volume.to_world)) return success();
  return failure(path, ": space directions and space origin give voxels no place or no volume");
}

Status read_encoding(const std::string& place, std::string_view text, NrrdHeader& header) {
  const std::string encoding = lower_case(text);
  header.gzip = encoding == "gzip" || encoding == "gz";
  header.has_encoding = true;
  if (header.gzip || encoding == "raw") return success();
  return failure(place, ": encoding \"", text, "\" is not read (only raw and gzip are)");
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
  if (name == "units") read_units(text, header.units, header);
  if (name == "space units") read_units(text, header.space_units, header);
  if (name == "space") return read_space(text, header);
  if (name == "space origin") return read_origin(place, text, header);
  if (name == "space directions") return read_directions(place, text, header);
  if (name == "encoding") return read_encoding(place, text, header);
  if (name == "dimension") return read_whole_number(place, name, text, 1, header.dimension);
  if (name == "line skip" || name == "lineskip") return read_whole_number(place, name, text, 0, header.line_skip);
  if (name == "byte skip" || name == "byteskip") return read_whole_number(place, name, text, -1, header.byte_skip);
  if (name == "endian") {
    const std::string order = lower_case(text);
    if (order != "big" && order != "little") return failure(place, ": endian gives \"", text, "\"");
    header.layout.big_endian = order == "big";
    header.has_endian = true;
  }
  if (name == "data file" || name == "datafile") {
    if (text.empty()) return failure(place, ": data file gives no name");
    if (text.substr(0, 4) == "LIST" || text.find('%') != std::string_view::npos) {
      return failure(place, ": voxels spread over several data files are not read");
    }
    header.data_file = text;
  }
  return success();  // other fields are of no use here
}

Status check_complete(const std::string& path, const NrrdHeader& header) {
  if (!header.has_type) return failure(path, ": the header gives no type");
  if (header.dimension == 0) return failure(path, ": the header gives no dimension");
  if (header.sizes_place.empty()) return failure(path, ": the header gives no sizes");
  if (!header.has_encoding) return failure(path, ": the header gives no encoding");
  if (!header.has_endian && bytes_of(header.layout.type) > 1) return failure(path, ": the header gives no endian");
  if (header.gzip && header.byte_skip < 0) return failure(path, ": byte skip -1 is for raw encoding only");
  return success();
}

// The header ends at an empty line, or with the file where the voxels have a file of their own.
Status read_header(const std::string& path, std::string_view text, NrrdHeader& header) {
  LineReader lines{text};
  std::string_view line;
  if (!lines.next(line) || line.substr(0, 4) != "NRRD") {
    return failure(path, ": line 1: is not NRRD (no \"NRRD\" at the start)");
  }
  while (lines.next(line) && !line.empty()) {
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
  return check_complete(path, header);
}

}  // namespace

Status read_nrrd(const std::string& path, Volume& volume) {
  std::string text;
  if (Status status = read_text_header(path, text); !status) return status;
  NrrdHeader header;
  if (Status status = read_header(path, text, header); !status) return status;
  if (Status status = set_sizes(header.sizes_place, header.sizes, volume); !status) return status;
  if (Status status = set_map(path, header, volume); !status) return status;

  ByteSource source;
  const bool attached = header.data_file.empty();
  if (Status status = source.open(attached ? path : beside(path, header.data_file)); !status) return status;
  if (attached) {
    if (Status status = source.skip(header.end); !status) return status;
  }
  // Lines are skipped in the stored file, bytes in the unpacked data.
  if (Status status = source.skip_lines(static_cast<uint64_t>(header.line_skip)); !status) return status;
  if (header.gzip) {
    if (Status status = source.start_inflating(); !status) return status;
  }
  if (header.byte_skip >= 0) {
    if (Status status = source.skip(static_cast<uint64_t>(header.byte_skip)); !status) return status;
  } else {
    const uint64_t voxels = static_cast<uint64_t>(header.sizes[0] * header.sizes[1] * header.sizes[2]);
    if (Status status = source.skip_to_last(voxels * bytes_of(header.layout.type)); !status) return status;
  }
  return read_voxels(source, path, header.layout, volume);
}

}  // namespace tool
