// SPDX-License-Identifier: MIT
#include "tool/io/dicom_file.h"

#include <algorithm>
#include <cstring>
#include <istream>

#include "tool/io/apart.h"

#if TOOL_HAVE_GDCM
#include <gdcmImageReader.h>

#include "tool/io/watched_file.h"
#endif

namespace tool {

#if TOOL_HAVE_GDCM

namespace {

// Before the voxels of a file.
struct SliceHead {
  int64_t voxels = 0;
  VoxelLayout layout;
};

bool voxel_type_of(const gdcm::PixelFormat& format, VoxelType& type) {
  switch (format.GetScalarType()) {
    case gdcm::PixelFormat::INT8: type = VoxelType::i8; return true;
    case gdcm::PixelFormat::UINT8: type = VoxelType::u8; return true;
    case gdcm::PixelFormat::INT12:
    case gdcm::PixelFormat::INT16: type = VoxelType::i16; return true;
    case gdcm::PixelFormat::UINT12:
    case gdcm::PixelFormat::UINT16: type = VoxelType::u16; return true;
    case gdcm::PixelFormat::INT32: type = VoxelType::i32; return true;
    case gdcm::PixelFormat::UINT32: type = VoxelType::u32; return true;
    case gdcm::PixelFormat::FLOAT32: type = VoxelType::f32; return true;
    case gdcm::PixelFormat::FLOAT64: type = VoxelType::f64; return true;
    default: return false;
  }
}

Status send_slice(const std::string& path, const Sender& sender) {
  WatchedFile file;
  std::istream stream(&file);
  if (file.open(path, std::ios::in | std::ios::binary) == nullptr) return failure(path, ": cannot be opened");
  gdcm::ImageReader reader;
  reader.SetStream(stream);
  const bool is_read = reader.Read();
  if (file.cut_off()) return failure(path, ": is cut off");
  if (!is_read) return failure(path, ": GDCM does not read the image (damaged, or of an unknown transfer syntax)");
  const gdcm::Image& image = reader.GetImage();
  SliceHead head;
  head.voxels = 1;
  for (unsigned k = 0; k < image.GetNumberOfDimensions(); ++k) head.voxels *= image.GetDimension(k);
  if (image.GetPixelFormat().GetSamplesPerPixel() != 1 || !voxel_type_of(image.GetPixelFormat(), head.layout.type))
    return failure(path, ": voxels of type ", image.GetPixelFormat().GetScalarTypeAsString(), " are not read");
  head.layout.big_endian = std::endian::native == std::endian::big;
  head.layout.slope = image.GetSlope();
  head.layout.intercept = image.GetIntercept();
  std::vector<char> voxels(image.GetBufferLength());
  if (!image.GetBuffer(voxels.data())) return failure(path, ": GDCM does not unpack the voxels");
  const bool sent =
      sender.send({reinterpret_cast<const char*>(&head), sizeof head}) && sender.send({voxels.data(), voxels.size()});
  return sent ? success() : failure(path, ": nobody listens");
}

// The frames picked out of the voxels of a file.
Status append_frames(const DicomPick& pick, const SliceHead& head, const VoxelDemand& demand, std::string_view voxels,
                     Volume& volume) {
  const size_t size = static_cast<size_t>(demand.count) * bytes_of(head.layout);
  for (size_t i = 0; i < pick.frames.size(); ++i) {
    VoxelDemand one{demand.header, head.layout, demand.count, demand.allow_nan};
    if (pick.scales[i].has_scale) {
      one.layout.slope = pick.scales[i].slope;
      one.layout.intercept = pick.scales[i].intercept;
    }
    const std::string place = pick.frames_of_file > 1 ? text_of(pick.path, ": frame ", pick.frames[i] + 1) : pick.path;
    if (Status status = append_voxels(voxels.substr(pick.frames[i] * size, size), place, one, volume); !status)
      return status;
  }
  return success();
}

}  // namespace

Status read_dicom_voxels(const std::vector<DicomPick>& picks, const VoxelDemand& demand, Volume& volume) {
  size_t arrived = 0;
  SliceHead head;
  bool head_is_next = true;
  const auto work = [&](const Sender& sender) {
    silence_gdcm();
    for (const DicomPick& pick : picks)
      if (Status status = send_slice(pick.path, sender); !status) return status;
    return success();
  };
  const auto take = [&](std::string_view record) {
    const DicomPick& pick = picks[std::min(arrived, picks.size() - 1)];
    const uint64_t voxels = demand.count * pick.frames_of_file;
    const size_t expected = head_is_next ? sizeof head : static_cast<size_t>(voxels) * bytes_of(head.layout);
    if (record.size() != expected || arrived == picks.size())
      return failure(pick.path, ": ", record.size(), " bytes of voxels, the header asks for ", expected);
    head_is_next = !head_is_next;
    if (!head_is_next) {
      std::memcpy(&head, record.data(), sizeof head);
      return success();
    }
    ++arrived;
    return append_frames(pick, head, demand, record, volume);
  };
  uint64_t most_frames = 1;
  for (const DicomPick& pick : picks) most_frames = std::max(most_frames, pick.frames_of_file);
  const ApartLimits limits{(uint64_t{1} << 30) + 16 * demand.count * most_frames, 3600};
  // A failing file ends the whole series, and is the one after those that have come.
  return run_apart(limits, work, take, [&](const std::string& reason) {
    return failure(picks[std::min(arrived, picks.size() - 1)].path, ": damaged; GDCM ended by ", reason);
  });
}

#else

Status read_dicom_voxels(const std::vector<DicomPick>& picks, const VoxelDemand&, Volume&) {
  return failure(picks[0].path, ": is DICOM, and this build is without GDCM");
}

#endif

}  // namespace tool
