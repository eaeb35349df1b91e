// SPDX-License-Identifier: MIT
// volume_io: picks the reader by the file's name, or by the content of folders and files without a known name.
#include "tool/io/volume_io.h"

#include <filesystem>

#include "tool/io/files.h"
#include "tool/io/volume_source.h"

namespace tool {

namespace {

struct Format {
  const char* ending;
  Status (*read)(const std::string& path, const VolumeRequest& request, Volume& volume);
};

constexpr Format formats[] = {{".nii", read_nifti},      {".hdr", read_nifti}, {".img", read_nifti},
                              {".nrrd", read_nrrd},      {".nhdr", read_nrrd}, {".mha", read_meta_image},
                              {".mhd", read_meta_image}, {".mgh", read_mgh},   {".mgz", read_mgh},
                              {".dcm", read_dicom},      {".ima", read_dicom}};

// DICOM files have this mark behind a preamble of 128 bytes, and names of any kind.
bool is_dicom(const std::string& path) {
  ByteSource source;
  char start[132] = {};
  size_t got = 0;
  return source.open(path) && source.read(start, sizeof start, got) && std::string_view(start + 128, 4) == "DICM";
}

const Format* format_of(const std::string& path) {
  std::string name = path;
  for (const char* packed : {".gz", ".bz2"})
    if (ends_with_ignoring_case(name, packed)) name.resize(name.size() - std::string_view(packed).size());
  for (const Format& format : formats)
    if (ends_with_ignoring_case(name, format.ending)) return &format;
  static constexpr Format dicom{"", read_dicom};
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored) || is_dicom(path) ? &dicom : nullptr;
}

}  // namespace

Status read_volume(const std::string& path, const VolumeRequest& request, Volume& volume) {
  volume = Volume();
  const Format* format = format_of(path);
  if (!format)
    return failure(path,
                   ": unknown volume format (known: .nii .hdr .img .nrrd .nhdr .mha .mhd .mgh .mgz, also "
                   "with .gz or .bz2, and DICOM folders and files)");
  Status status = format->read(path, request, volume);
  if (!status) volume = Volume();
  return status;
}

}  // namespace tool
