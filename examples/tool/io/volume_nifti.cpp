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
  constexpr int nifti_2_header_bytes = 540;
  if (header.sizeof_hdr == nifti_2_header_bytes) return failure(path, ": is NIfTI-2, only NIfTI-1 is read");
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

double usable_spacing(double spacing) { return std::isfinite(spacing) && spacing > 0 ? spacing : 1; }

}  // namespace

Status read_nifti(const std::string& path, Volume& volume) {
  ByteSource source;
  if (Status status = source.open(path); !status) return status;
  if (ends_with_ignoring_case(path, ".gz")) {
    if (Status status = source.start_inflating(); !status) return status;
  }
  nifti_1_header header;
  if (Status status = read_header(source, header); !status) return status;
  nifti_1_header native = header;
  if (header.dim[0] < 0 || header.dim[0] > 7) swap_nifti_header(&native, 1);
  if (Status status = check_header(path, native, volume); !status) return status;

  nifti_set_debug_level(0);
  const std::unique_ptr<nifti_image, FreeImage> image(nifti_convert_nhdr2nim(header, path.c_str()));
  if (!image) return failure(path, ": niftilib refuses the header");
  volume.spacing[0] = usable_spacing(image->dx);
  volume.spacing[1] = usable_spacing(image->dy);
  volume.spacing[2] = usable_spacing(image->dz);
  VoxelLayout layout;
  if (!voxel_type_of(image->datatype, layout.type)) return failure(path, ": datatype ", image->datatype);
  constexpr int most_significant_first = 2;  // niftilib's MSB_FIRST, private to the library
  layout.big_endian = image->byteorder == most_significant_first;
  if (std::isfinite(image->scl_slope) && image->scl_slope != 0) {
    layout.slope = image->scl_slope;
    layout.intercept = std::isfinite(image->scl_inter) ? image->scl_inter : 0;
  }
  const uint64_t offset = image->iname_offset > 0 ? static_cast<uint64_t>(image->iname_offset) : 0;
  if (offset < sizeof header) return failure(path, ": vox_offset ", offset, " lies within the header");
  if (Status status = source.skip(offset - sizeof header); !status) return status;
  return read_voxels(source, path, layout, volume);
}

#else

Status read_nifti(const std::string& path, Volume&) {
  return failure(path, ": is NIfTI, and this build is without niftilib");
}

#endif

}  // namespace tool
