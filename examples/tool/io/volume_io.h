// SPDX-License-Identifier: MIT
// volume_io: volumes from files: NIfTI-1 and -2 in one file or as a pair, Analyze 7.5, NRRD, MetaImage, told by the
// file's name, without regard to .gz or .bz2 behind the name; DICOM series, told by their content. Values are scaled as
// the file says. TOOL_HAVE_NIFTI, TOOL_HAVE_ZLIB, TOOL_HAVE_BZIP2 and TOOL_HAVE_GDCM are 1 if the build found the
// libraries; messages name a missing library.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tool/io/volume.h"

namespace tool {

struct VolumeRequest {
  std::optional<uint64_t> time;  // which of several volumes of a file, counted from 0
  bool allow_nan = false;        // else only finite voxels are read
};

// On failure `volume` is left empty.
Status read_volume(const std::string& path, const VolumeRequest& request, Volume& volume);
inline Status read_volume(const std::string& path, Volume& volume) { return read_volume(path, {}, volume); }

// One reader per format; read_volume picks among them.
Status read_nifti(const std::string& path, const VolumeRequest& request, Volume& volume);
Status read_nrrd(const std::string& path, const VolumeRequest& request, Volume& volume);
Status read_meta_image(const std::string& path, const VolumeRequest& request, Volume& volume);
Status read_mgh(const std::string& path, const VolumeRequest& request, Volume& volume);
// `path` is a folder, or a file in one.
Status read_dicom(const std::string& path, const VolumeRequest& request, Volume& volume);

}  // namespace tool
