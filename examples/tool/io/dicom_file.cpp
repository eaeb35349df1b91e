// SPDX-License-Identifier: MIT
#include "tool/io/dicom_file.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <istream>

#include "tool/io/apart.h"
#include "tool/io/files.h"

#if TOOL_HAVE_GDCM
#include <gdcmImageHelper.h>
#include <gdcmImageReader.h>
#include <gdcmMediaStorage.h>
#include <gdcmReader.h>
#include <gdcmTrace.h>
#endif

namespace tool {

#if TOOL_HAVE_GDCM

namespace {

// Text of an element, without the blanks that make its length even.
std::string text_of_element(const gdcm::DataSet& set, const gdcm::Tag& tag) {
  if (!set.FindDataElement(tag)) return "";
  const gdcm::ByteValue* bytes = set.GetDataElement(tag).GetByteValue();
  if (bytes == nullptr || bytes->GetPointer() == nullptr) return "";
  const std::string_view text(bytes->GetPointer(), bytes->GetLength());
  return std::string(trimmed(text.substr(0, text.find('\0'))));
}

// Control characters in a message might be taken for the terminal's.
template <size_t Size>
void copy_text(const std::string& text, char (&to)[Size]) {
  size_t n = 0;
  for (; n + 1 < Size && n < text.size(); ++n) to[n] = text[n] >= ' ' && text[n] <= '~' ? text[n] : '?';
  to[n] = '\0';
}

void take_geometry(const gdcm::File& file, DicomHeader& header) {
  const gdcm::DataSet& set = file.GetDataSet();
  const std::vector<unsigned> sizes = gdcm::ImageHelper::GetDimensionsValue(file);
  if (sizes.size() < 2) return;
  header.columns = sizes[0];
  header.rows = sizes[1];
  header.frames = sizes.size() > 2 ? sizes[2] : 1;
  header.is_image = header.columns > 0 && header.rows > 0 && header.frames > 0;
  header.samples = gdcm::ImageHelper::GetPixelFormatValue(file).GetSamplesPerPixel();
  // Files of several frames have their places in sequences, which GDCM knows.
  const bool by_elements = header.frames == 1;
  header.has_place =
      !by_elements || (set.FindDataElement(gdcm::Tag(0x20, 0x32)) && set.FindDataElement(gdcm::Tag(0x20, 0x37)));
  header.has_spacing = !by_elements || set.FindDataElement(gdcm::Tag(0x28, 0x30));
  const std::vector<double> position = gdcm::ImageHelper::GetOriginValue(file);
  const std::vector<double> cosines = gdcm::ImageHelper::GetDirectionCosinesValue(file);
  const std::vector<double> spacing = gdcm::ImageHelper::GetSpacingValue(file);
  header.has_place = header.has_place && position.size() >= 3 && cosines.size() >= 6;
  header.has_spacing = header.has_spacing && spacing.size() >= 2;
  for (size_t k = 0; k < 3; ++k) {
    if (header.has_place) header.position[k] = position[k];
    if (header.has_place) header.row[k] = cosines[k];
    if (header.has_place) header.column[k] = cosines[3 + k];
    if (k < spacing.size()) header.spacing[k] = spacing[k];
  }
}

// A file that knows whether more bytes were asked for than there are. GDCM fills up voxels that are cut off.
class WatchedFile : public std::filebuf {
 public:
  bool cut_off() const { return cut_off_; }

 protected:
  std::streamsize xsgetn(char* bytes, std::streamsize wanted) override {
    const std::streamsize got = std::filebuf::xsgetn(bytes, wanted);
    // Behind the last element, the next one's number is looked for.
    constexpr std::streamsize tag = 4;
    cut_off_ = cut_off_ || (got < wanted && (got > 0 || wanted > tag));
    return got;
  }

 private:
  bool cut_off_ = false;
};

DicomHeader header_of(const std::string& path) {
  DicomHeader header;
  WatchedFile bytes;
  std::istream stream(&bytes);
  gdcm::Reader reader;
  reader.SetStream(stream);
  if (bytes.open(path, std::ios::in | std::ios::binary) == nullptr || !reader.CanRead()) return header;
  header.is_damaged = true;
  if (!reader.ReadUpToTag(gdcm::Tag(0x7fe0, 0x10), {gdcm::Tag(0x7fe0, 0x10)}) || bytes.cut_off()) return header;
  header.is_damaged = false;
  const gdcm::File& file = reader.GetFile();
  const gdcm::DataSet& set = file.GetDataSet();
  gdcm::MediaStorage storage;
  storage.SetFromFile(file);
  if (!gdcm::MediaStorage::IsImage(storage)) return header;
  copy_text(text_of_element(set, gdcm::Tag(0x20, 0xe)), header.series);
  copy_text(text_of_element(set, gdcm::Tag(0x8, 0x60)), header.modality);
  copy_text(text_of_element(set, gdcm::Tag(0x8, 0x103e)), header.description);
  parse_integer(text_of_element(set, gdcm::Tag(0x20, 0x13)), header.instance);
  take_geometry(file, header);
  header.is_damaged = !header.is_image;
  return header;
}

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

void silence() {
  gdcm::Trace::DebugOff();
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
}

// A failing file ends the whole series, and is the one after those that have come.
std::function<Status(const std::string&)> death_of(const std::vector<std::string>& paths, const size_t& arrived) {
  return [&](const std::string& reason) {
    return failure(paths[std::min(arrived, paths.size() - 1)], ": damaged; GDCM ended by ", reason);
  };
}

}  // namespace

Status read_dicom_headers(const std::vector<std::string>& paths, std::vector<DicomHeader>& headers) {
  headers.clear();
  size_t arrived = 0;
  const auto work = [&](const Sender& sender) {
    silence();
    for (const std::string& path : paths) {
      const DicomHeader header = header_of(path);
      if (!sender.send({reinterpret_cast<const char*>(&header), sizeof header})) break;
    }
    return success();
  };
  const auto take = [&](std::string_view record) {
    if (record.size() != sizeof(DicomHeader)) return failure(paths[0], ": GDCM's answer is damaged");
    headers.emplace_back();
    std::memcpy(&headers.back(), record.data(), record.size());
    ++arrived;
    return success();
  };
  return run_apart({}, work, take, death_of(paths, arrived));
}

Status read_dicom_voxels(const std::vector<std::string>& paths, const VoxelDemand& demand, Volume& volume) {
  size_t arrived = 0;
  SliceHead head;
  bool head_is_next = true;
  const auto work = [&](const Sender& sender) {
    silence();
    for (const std::string& path : paths)
      if (Status status = send_slice(path, sender); !status) return status;
    return success();
  };
  const auto take = [&](std::string_view record) {
    const std::string& path = paths[std::min(arrived, paths.size() - 1)];
    const size_t expected = head_is_next ? sizeof head : static_cast<size_t>(demand.count) * bytes_of(head.layout);
    if (record.size() != expected || arrived == paths.size())
      return failure(path, ": ", record.size(), " bytes of voxels, the header asks for ", expected);
    head_is_next = !head_is_next;
    if (!head_is_next) {
      std::memcpy(&head, record.data(), sizeof head);
      return success();
    }
    ++arrived;
    return append_voxels(record, path, {demand.header, head.layout, demand.count, demand.allow_nan}, volume);
  };
  const ApartLimits limits{(uint64_t{1} << 30) + 16 * demand.count, 3600};
  return run_apart(limits, work, take, death_of(paths, arrived));
}

#else

Status read_dicom_headers(const std::vector<std::string>& paths, std::vector<DicomHeader>&) {
  return failure(paths[0], ": is DICOM, and this build is without GDCM");
}

Status read_dicom_voxels(const std::vector<std::string>& paths, const VoxelDemand&, Volume&) {
  return failure(paths[0], ": is DICOM, and this build is without GDCM");
}

#endif

}  // namespace tool
