// SPDX-License-Identifier: MIT
// volume_nifti: NIfTI-1 and NIfTI-2 in one file (.nii) or as a pair (.hdr, .img), https://nifti.nimh.nih.gov, and pairs
// of Analyze 7.5, whose headers NIfTI-1 has taken over. niftilib reads the header. The voxels come through ByteSource,
// so that memory is taken only for bytes actually in the file.
#include "tool/io/files.h"
#include "tool/io/volume_data.h"

#if TOOL_HAVE_NIFTI
#include <nifti2_io.h>

#include <cmath>
#include <cstring>
#include <memory>
#endif

namespace tool {

#if TOOL_HAVE_NIFTI

namespace {

struct FreeImage {
  void operator()(nifti_image* image) const { nifti_image_free(image); }
};

bool voxel_type_of(int datatype, VoxelType& type) {
  switch (datatype) {
    case DT_INT8: type = VoxelType::i8; return true;
    case DT_UINT8: type = VoxelType::u8; return true;
    case DT_INT16: type = VoxelType::i16; return true;
    case DT_UINT16: type = VoxelType::u16; return true;
    case DT_INT32: type = VoxelType::i32; return true;
    case DT_UINT32: type = VoxelType::u32; return true;
    case DT_INT64: type = VoxelType::i64; return true;
    case DT_UINT64: type = VoxelType::u64; return true;
    case DT_FLOAT32: type = VoxelType::f32; return true;
    case DT_FLOAT64: type = VoxelType::f64; return true;
    default: return false;
  }
}

// What both versions and Analyze say, in this machine's order of bytes.
struct NiftiHeader {
  int version = 0;  // 1 or 2; 0: Analyze
  bool is_pair = false;
  bool big_endian = false;
  int64_t dim[8] = {};
  int datatype = 0;
  double voxel_offset = 0;
  nifti_1_header one{};  // as in the file
  nifti_2_header two{};
};

Status read_exactly(ByteSource& source, void* bytes, size_t count, size_t all) {
  size_t got = 0;
  if (Status status = source.read(bytes, count, got); !status) return status;
  return got == count ? success() : failure(source.path(), ": too short for a NIfTI header of ", all, " bytes");
}

constexpr int size_of_one = sizeof(nifti_1_header), size_of_two = sizeof(nifti_2_header);

void take_one(NiftiHeader& header) {
  nifti_1_header native = header.one;
  // Some writers leave sizeof_hdr alone, but none dim[0].
  const bool swapped = native.dim[0] < 0 || native.dim[0] > 7;
  if (swapped) swap_nifti_header(&native, 1);
  header.big_endian = swapped != (std::endian::native == std::endian::big);
  const bool one_file = std::memcmp(native.magic, "n+1", 4) == 0, pair = std::memcmp(native.magic, "ni1", 4) == 0;
  header.version = one_file || pair ? 1 : 0;
  header.is_pair = !one_file;
  std::copy(native.dim, native.dim + 8, header.dim);
  header.datatype = native.datatype;
  header.voxel_offset = static_cast<double>(native.vox_offset);
}

Status take_two(const std::string& path, bool swapped, NiftiHeader& header) {
  nifti_2_header native = header.two;
  if (swapped) swap_nifti_header(&native, 2);
  header.big_endian = swapped != (std::endian::native == std::endian::big);
  constexpr char tail[] = "\r\n\032\n";
  const bool one_file = std::memcmp(native.magic, "n+2", 4) == 0, pair = std::memcmp(native.magic, "ni2", 4) == 0;
  if ((!one_file && !pair) || std::memcmp(native.magic + 4, tail, 4) != 0)
    return failure(path, ": magic is not that of NIfTI-2");
  header.version = 2;
  header.is_pair = pair;
  std::copy(native.dim, native.dim + 8, header.dim);
  header.datatype = native.datatype;
  header.voxel_offset = static_cast<double>(native.vox_offset);
  return success();
}

Status read_header(ByteSource& source, NiftiHeader& header) {
  char bytes[size_of_two];
  if (Status status = read_exactly(source, bytes, size_of_one, size_of_one); !status) return status;
  const int native = load<int>(bytes, std::endian::native == std::endian::big);
  const int swapped = load<int>(bytes, std::endian::native != std::endian::big);
  if (native == size_of_two || swapped == size_of_two) {
    const size_t rest = size_of_two - size_of_one;
    if (Status status = read_exactly(source, bytes + size_of_one, rest, size_of_two); !status) return status;
    std::memcpy(&header.two, bytes, size_of_two);
    return take_two(source.path(), swapped == size_of_two, header);
  }
  if (native != size_of_one && swapped != size_of_one) {
    return failure(source.path(), ": sizeof_hdr is ", native, ", NIfTI-1 has ", size_of_one, " and NIfTI-2 ",
                   size_of_two);
  }
  std::memcpy(&header.one, bytes, size_of_one);
  take_one(header);
  return success();
}

// niftilib silently mends sizes below 1 and prints messages of its own. Headers with such sizes are refused first.
Status check_header(const std::string& path, const NiftiHeader& header, Volume& volume, VoxelData& data) {
  if (header.dim[0] < 3 || header.dim[0] > 7) {
    return failure(path, ": dim[0] gives ", header.dim[0], " dimensions, 3 are needed");
  }
  data.times = 1;
  for (int i = 4; i <= header.dim[0]; ++i) {
    const int64_t size = header.dim[i];
    if (size < 1 || size > most_voxels || (i > 4 && size != 1))
      return failure(path, ": dim[", i, "] is ", size, i > 4 ? ", one volume has 1" : "");
    data.times *= static_cast<uint64_t>(size);
  }
  if (!(header.voxel_offset >= 0 && header.voxel_offset < 0x1p53)) {
    return failure(path, ": vox_offset gives ", header.voxel_offset);
  }
  if (!voxel_type_of(header.datatype, data.layout.type)) {
    return failure(path, ": datatype ", header.datatype, " is not a real or integer number");
  }
  data.layout.big_endian = header.big_endian;
  return set_sizes(text_of(path, ": dim"), {header.dim[1], header.dim[2], header.dim[3]}, volume);
}

// Signs belong to the sform and the qform.
double usable_spacing(double spacing) {
  const double size = std::fabs(spacing);
  return std::isfinite(size) && size > 0 ? size : 1;
}

Affine affine_of(const nifti_dmat44& rows, double unit) {
  Affine map;
  for (size_t k = 0; k < 3; ++k) {
    for (size_t axis = 0; axis < 3; ++axis) map.axes[axis][k] = unit * rows.m[k][axis];
    map.origin[k] = unit * rows.m[k][3];
  }
  return map;
}

// Millimetres in RAS: the sform if the header has one that can be inverted, else the qform, else spacings alone.
void set_map(const nifti_image& image, Volume& volume) {
  const double unit = image.xyz_units == NIFTI_UNITS_METER ? 1e3 : image.xyz_units == NIFTI_UNITS_MICRON ? 1e-3 : 1;
  volume.space = Space::ras;
  volume.to_world = affine_of(image.sto_xyz, unit);
  if (image.sform_code > NIFTI_XFORM_UNKNOWN && is_regular(volume.to_world)) return;
  const double spacing[3] = {usable_spacing(image.dx), usable_spacing(image.dy), usable_spacing(image.dz)};
  // The library takes a negative spacing for 1.
  volume.to_world = affine_of(
      nifti_quatern_to_dmat44(image.quatern_b, image.quatern_c, image.quatern_d, image.qoffset_x, image.qoffset_y,
                              image.qoffset_z, spacing[0], spacing[1], spacing[2], image.qfac),
      unit);
  if (image.qform_code > NIFTI_XFORM_UNKNOWN && is_regular(volume.to_world)) return;
  volume.to_world = Affine();
  for (size_t axis = 0; axis < 3; ++axis) volume.to_world.axes[axis][axis] = unit * spacing[axis];
}

// Map and scale, as niftilib reads them.
Status take_image(const std::string& path, const NiftiHeader& header, Volume& volume, VoxelLayout& layout) {
  nifti_set_debug_level(0);
  const std::unique_ptr<nifti_image, FreeImage> image(header.version == 2
                                                          ? nifti_convert_n2hdr2nim(header.two, path.c_str())
                                                          : nifti_convert_n1hdr2nim(header.one, path.c_str()));
  if (!image) return failure(path, ": niftilib refuses the header");
  set_map(*image, volume);
  if (std::isfinite(image->scl_slope) && image->scl_slope != 0) {
    layout.slope = image->scl_slope;
    layout.intercept = std::isfinite(image->scl_inter) ? image->scl_inter : 0;
  }
  return success();
}

// Analyze 7.5 has spacings, but says neither where the axes point nor whether the volume is mirrored.
void take_analyze(const std::string& path, const NiftiHeader& header, Volume& volume) {
  for (size_t axis = 0; axis < 3; ++axis) {
    const float spacing = load<float>(&header.one.pixdim[axis + 1], header.big_endian);
    volume.to_world.axes[axis] = {};
    volume.to_world.axes[axis][axis] = usable_spacing(static_cast<double>(spacing));
  }
  volume.space = Space::unnamed;
  volume.note = text_of(path, ": is Analyze 7.5, which gives no orientation: axes as stored, neither RAS nor LPS");
}

// "brain.hdr" to "brain.img" and back, with capitals like the name's; "" for another ending.
std::string partner_of(const std::string& path, const char* from, const char* to) {
  if (!ends_with_ignoring_case(path, from)) return "";
  std::string partner = path;
  for (size_t i = 0; i < 3; ++i) {
    char& c = partner[path.size() - 3 + i];
    const bool capital = c >= 'A' && c <= 'Z';
    c = to[i];
    if (capital) c = static_cast<char>(c - 'a' + 'A');
  }
  return partner;
}

std::string without_gz(const std::string& path) {
  return ends_with_ignoring_case(path, ".gz") ? path.substr(0, path.size() - 3) : path;
}

// The file, or the compressed one where only that exists.
std::string existing(const std::string& path) {
  uint64_t bytes = 0;
  return !file_size_of(path, bytes) && file_size_of(path + ".gz", bytes) ? path + ".gz" : path;
}

// The header of a pair that is called by its voxels; else the path itself.
std::string header_of(const std::string& path) {
  const std::string header = partner_of(without_gz(path), ".img", "hdr");
  return header.empty() ? path : existing(header);
}

Status find_voxels(const std::string& path, const NiftiHeader& header, Volume& volume, VoxelData& data) {
  data.header = path;
  const auto offset = static_cast<uint64_t>(header.voxel_offset);
  if (header.is_pair) {
    std::string voxels = partner_of(without_gz(path), ".hdr", "img");
    if (voxels.empty()) voxels = partner_of(without_gz(path), ".nii", "img");
    if (voxels.empty()) return failure(path, ": is the header of a pair, but its name does not end in .hdr");
    voxels = existing(voxels);
    data.files.names = {voxels.substr(voxels.find_last_of('/') + 1)};
    data.packing = Packing::none;
    data.head_skip = 0;
    data.byte_skip = static_cast<int64_t>(offset);
    data.unpacked_by_content = true;
    return success();
  }
  const uint64_t least = header.version == 2 ? size_of_two + 4 : size_of_one + 4;
  data.header_end = std::max(offset, least);
  if (offset < least)
    volume.note =
        text_of(path, ": vox_offset is ", offset, ", within the header: voxels are read from byte ", least, " on");
  return success();
}

}  // namespace

Status read_nifti(const std::string& called, const VolumeRequest& request, Volume& volume) {
  const std::string path = header_of(called);
  ByteSource source;
  if (Status status = source.open_unpacked(path); !status) return status;
  NiftiHeader header;
  if (Status status = read_header(source, header); !status) return status;
  const std::string name = without_gz(path);
  if (header.version == 0 && !ends_with_ignoring_case(name, ".hdr"))
    return failure(path, ": magic is neither \"n+1\" nor \"n+2\", the marks of NIfTI in one file");
  VoxelData data;
  if (Status status = check_header(path, header, volume, data); !status) return status;
  if (Status status = find_voxels(path, header, volume, data); !status) return status;
  if (header.version == 0) {
    take_analyze(path, header, volume);
  } else if (Status status = take_image(path, header, volume, data.layout); !status) {
    return status;
  }
  if (!is_regular(volume.to_world)) return failure(path, ": pixdim gives voxels no volume");
  return read_voxel_data(data, request, path + ": dim[4]", volume);
}

#else

Status read_nifti(const std::string& path, const VolumeRequest&, Volume&) {
  return failure(path, ": is NIfTI, and this build is without niftilib");
}

#endif

}  // namespace tool
