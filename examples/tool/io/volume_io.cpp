// SPDX-License-Identifier: MIT
// volume_io: picks the reader by the file's name.
#include "tool/io/volume_io.h"

#include "tool/io/files.h"

namespace tool {

namespace {

struct Format {
  const char* ending;
  Status (*read)(const std::string& path, Volume& volume);
};

constexpr Format formats[] = {{".nii", read_nifti}, {".nii.gz", read_nifti},   {".nrrd", read_nrrd},
                              {".nhdr", read_nrrd}, {".mha", read_meta_image}, {".mhd", read_meta_image}};

}  // namespace

Status read_volume(const std::string& path, Volume& volume) {
  volume = Volume();
  for (const Format& format : formats) {
    if (!ends_with_ignoring_case(path, format.ending)) continue;
    Status status = format.read(path, volume);
    if (!status) volume = Volume();
    return status;
  }
  return failure(path, ": unknown volume format (known: .nii .nii.gz .nrrd .nhdr .mha .mhd)");
}

}  // namespace tool
