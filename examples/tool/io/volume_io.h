// SPDX-License-Identifier: MIT
// volume_io: volumes from files, the format told by the file's name: NIfTI-1 (.nii, .nii.gz), NRRD (.nrrd, .nhdr),
// MetaImage (.mha, .mhd). Read-only. Values are scaled as the file says; sizes are 3 (further sizes must be 1).
// TOOL_HAVE_NIFTI and TOOL_HAVE_ZLIB are 1 if the build found the libraries; messages name a missing library.
#pragma once

#include <string>

#include "tool/io/volume.h"

namespace tool {

// On failure `volume` is left empty.
Status read_volume(const std::string& path, Volume& volume);

// One reader per format; read_volume picks among them.
Status read_nifti(const std::string& path, Volume& volume);
Status read_nrrd(const std::string& path, Volume& volume);
Status read_meta_image(const std::string& path, Volume& volume);

}  // namespace tool
