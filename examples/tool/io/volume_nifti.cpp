// SPDX-License-Identifier: MIT
// volume_nifti: NIfTI-1 in one file (.nii, .nii.gz), https://nifti.nimh.nih.gov/nifti-1. niftilib reads the header. The
// voxels come through ByteSource, so that memory is taken only for bytes actually in the file.
#include "tool/io/files.h"
#include "tool/io/volume_io.h"
#include "tool/io/volume_source.h"

#if TOOL_HAVE_NIFTI
#include <nifti1_io.h>

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

// niftilib silently mends sizes below 1 and prints messages of its own. Headers with such sizes are refused first.
Status check_header(const std::string& path, const nifti_1_header& header, Volume& volume) {
  if (header.sizeof_hdr != static_cast<int>(sizeof header)) {
    return failure(path, ": sizeof_hdr is ", header.sizeof_hdr, ", a NIfTI-1 header has ", sizeof header);
  }
  if (std::memcmp(header.magic, "n+1", 4) != 0) {
    return failure(path, ": magic is not \"n+1\", the mark of NIfTI-1 in one file");
  }
  if (header.dim[0] < 3 || header.dim[0] > 7) {
    return failure(path, ": dim[0] gives ", header.dim[0], " dimensions, 3 are needed");
  }
  for (int i = 4; i <= header.dim[0]; ++i) {
    if (header.dim[i] != 1) return failure(path, ": dim[", i, "] is ", header.dim[i], ", one volume has 1");
  }
  const float largest_offset = 0x1p31f;
  if (!(header.vox_offset >= 0 && header.vox_offset < largest_offset)) {
    return failure(path, ": vox_offset gives ", header.vox_offset);
  }
  VoxelType type;
  if (!voxel_type_of(header.datatype, type)) {
    return failure(path, ": datatype ", header.datatype, " is not a real or integer number");
  }
  return set_sizes(text_of(path, ": dim"), {header.dim[1], header.dim[2], header.dim[3]}, volume);
}

Status read_header(ByteSource& source, nifti_1_header& header) {
  size_t got = 0;
  if (Status status = source.read(&header, sizeof header, got); !status) return status;
  if (got == sizeof header) return success();
  return failure(source.path(), ": ", got, " bytes, a NIfTI-1 header has ", sizeof header);
}

// Signs belong to the sform and the qform.
double usable_spacing(double spacing) {
  const double size = std::fabs(spacing);
  return std::isfinite(size) && size > 0 ? size : 1;
}

Affine affine_of(const mat44& rows, double unit) {
  Affine map;
  for (size_t k = 0; k < 3; ++k) {
    for (size_t axis = 0; axis < 3; ++axis) map.axes[axis][k] = unit * static_cast<double>(rows.m[k][axis]);
    map.origin[k] = unit * static_cast<double>(rows.m[k][3]);
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
  volume.to_world =
      affine_of(nifti_quatern_to_mat44(image.quatern_b, image.quatern_c, image.quatern_d, image.qoffset_x,
                                       image.qoffset_y, image.qoffset_z, static_cast<float>(spacing[0]),
                                       static_cast<float>(spacing[1]), static_cast<float>(spacing[2]), image.qfac),
                unit);
  if (image.qform_code > NIFTI_XFORM_UNKNOWN && is_regular(volume.to_world)) return;
  volume.to_world = Affine();
  for (size_t axis = 0; axis < 3; ++axis) volume.to_world.axes[axis][axis] = unit * spacing[axis];
}

}  // namespace

Status read_nifti(const std::string& path, Volume& volume) {
  ByteSource source;
  if (Status status = source.open(path); !status) return status;
  if (ends_with_ignoring_case(path, ".gz") || source.begins_as_gzip()) {
    if (Status status = source.start_inflating(); !status) return status;
  }
  nifti_1_header header;
  if (Status status = read_header(source, header); !status) return status;
  constexpr int nifti_2_header_bytes = 540;
  for (const bool big_endian : {false, true}) {
    if (load<int32_t>(&header, big_endian) == nifti_2_header_bytes) {
      return failure(path, ": is NIfTI-2, only NIfTI-1 is read");
    }
  }
  nifti_1_header native = header;
  if (header.dim[0] < 0 || header.dim[0] > 7) swap_nifti_header(&native, 1);
  if (Status status = check_header(path, native, volume); !status) return status;

  nifti_set_debug_level(0);
  const std::unique_ptr<nifti_image, FreeImage> image(nifti_convert_nhdr2nim(header, path.c_str()));
  if (!image) return failure(path, ": niftilib refuses the header");
  set_map(*image, volume);
  if (!is_regular(volume.to_world)) return failure(path, ": pixdim gives voxels no volume");
  VoxelLayout layout;
  if (!voxel_type_of(image->datatype, layout.type)) return failure(path, ": datatype ", image->datatype);
  constexpr int most_significant_first = 2;  // niftilib's MSB_FIRST, private to the library
  layout.big_endian = image->byteorder == most_significant_first;
  if (std::isfinite(image->scl_slope) && image->scl_slope != 0) {
    layout.slope = image->scl_slope;
    layout.intercept = std::isfinite(image->scl_inter) ? image->scl_inter : 0;
  }
  constexpr uint64_t least_offset = 352;
  uint64_t offset = static_cast<uint64_t>(native.vox_offset);
  if (offset < least_offset) {
    volume.note = text_of(path, ": vox_offset is ", offset, ", within the header: voxels are read from byte 352 on");
    offset = least_offset;
  }
  if (Status status = source.skip(offset - sizeof header); !status) return status;
  return read_voxels(source, path, layout, volume);
}

#else

Status read_nifti(const std::string& path, Volume&) {
  return failure(path, ": is NIfTI, and this build is without niftilib");
}

#endif

}  // namespace tool
