// SPDX-License-Identifier: MIT
// dicom_header: identity and places of DICOM images. Places come from the elements themselves, of the file or of the
// functional groups of its frames; GDCM guesses where a file has neither.
#include <cstring>
#include <istream>

#include "tool/io/apart.h"
#include "tool/io/dicom_file.h"
#include "tool/io/files.h"

#if TOOL_HAVE_GDCM
#include <gdcmAttribute.h>
#include <gdcmImageHelper.h>
#include <gdcmMediaStorage.h>
#include <gdcmReader.h>
#include <gdcmSequenceOfItems.h>

#include "tool/io/watched_file.h"
#endif

namespace tool {

#if TOOL_HAVE_GDCM

namespace {

using gdcm::DataSet;
using gdcm::Tag;

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

// The numbers of an element of type DS or IS; empty unless all are numbers.
std::vector<double> numbers_of(const DataSet& set, const Tag& tag) {
  const std::string text = text_of_element(set, tag);
  std::vector<double> numbers;
  for (size_t begin = 0; begin <= text.size() && !text.empty();) {
    const size_t end = std::min(text.size(), text.find('\\', begin));
    double number = 0;
    if (!parse_real(trimmed(std::string_view(text).substr(begin, end - begin)), number)) return {};
    numbers.push_back(number);
    begin = end + 1;
  }
  return numbers;
}

// The items of a sequence.
gdcm::SmartPointer<gdcm::SequenceOfItems> items_of(const DataSet& set, const Tag& tag) {
  return set.FindDataElement(tag) ? set.GetDataElement(tag).GetValueAsSQ() : nullptr;
}

// Calls visit(set) for the first item of a sequence, if there is one.
template <class Visit>
void within(const DataSet& set, const Tag& tag, Visit visit) {
  const auto items = items_of(set, tag);
  if (items && items->GetNumberOfItems() > 0) visit(items->GetItem(1).GetNestedDataSet());
}

void take_position(const DataSet& set, DicomFrame& frame, bool& has_position) {
  const std::vector<double> position = numbers_of(set, Tag(0x20, 0x32));
  has_position = has_position || position.size() == 3;
  for (size_t k = 0; k < 3 && position.size() == 3; ++k) frame.position[k] = position[k];
}

void take_orientation(const DataSet& set, DicomFrame& frame, bool& has_orientation) {
  const std::vector<double> cosines = numbers_of(set, Tag(0x20, 0x37));
  has_orientation = has_orientation || cosines.size() == 6;
  for (size_t k = 0; k < 6 && cosines.size() == 6; ++k) (k < 3 ? frame.row : frame.column)[k % 3] = cosines[k];
}

// PixelSpacing has the distance of rows first.
void take_spacing(const DataSet& set, DicomFrame& frame) {
  const std::vector<double> spacing = numbers_of(set, Tag(0x28, 0x30));
  if (spacing.size() != 2) return;
  frame.has_spacing = true;
  frame.spacing[0] = spacing[1];
  frame.spacing[1] = spacing[0];
}

void take_scale(const DataSet& set, DicomFrame& frame) {
  const std::vector<double> slope = numbers_of(set, Tag(0x28, 0x1053)), shift = numbers_of(set, Tag(0x28, 0x1052));
  if (slope.size() != 1 || shift.size() != 1) return;
  frame.has_scale = true;
  frame.slope = slope[0];
  frame.intercept = shift[0];
}

// What is known of a frame so far.
struct KnownFrame {
  DicomFrame frame;
  bool has_position = false, has_orientation = false;
};

// The functional groups of all frames, or of one (PS3.3, C.7.6.16).
void take_groups(const DataSet& groups, KnownFrame& known) {
  within(groups, Tag(0x20, 0x9113), [&](const DataSet& s) { take_position(s, known.frame, known.has_position); });
  within(groups, Tag(0x20, 0x9116), [&](const DataSet& s) { take_orientation(s, known.frame, known.has_orientation); });
  within(groups, Tag(0x28, 0x9110), [&](const DataSet& s) { take_spacing(s, known.frame); });
  within(groups, Tag(0x28, 0x9145), [&](const DataSet& s) { take_scale(s, known.frame); });
  within(groups, Tag(0x20, 0x9111), [&](const DataSet& s) {
    if (!s.FindDataElement(Tag(0x20, 0x9128))) return;
    gdcm::Attribute<0x20, 0x9128> index;
    index.SetFromDataElement(s.GetDataElement(Tag(0x20, 0x9128)));
    known.frame.time = static_cast<int64_t>(index.GetValue());
  });
}

// False where the file has no groups for each frame.
bool take_frames_by_groups(const DataSet& set, size_t count, std::vector<DicomFrame>& frames) {
  const auto own = items_of(set, Tag(0x5200, 0x9230));
  if (!own || own->GetNumberOfItems() == 0) return false;
  KnownFrame shared;
  within(set, Tag(0x5200, 0x9229), [&](const DataSet& groups) { take_groups(groups, shared); });
  for (size_t k = 0; k < count; ++k) {
    KnownFrame known = shared;
    if (k < own->GetNumberOfItems()) take_groups(own->GetItem(k + 1).GetNestedDataSet(), known);
    known.frame.has_place = known.has_position && known.has_orientation && k < own->GetNumberOfItems();
    frames.push_back(known.frame);
  }
  return true;
}

// The planes of a dose lie at offsets from the first, or at the z that the first has (PS3.3, C.8.8.3.2).
bool take_frames_by_offsets(const DataSet& set, size_t count, const DicomFrame& first,
                            std::vector<DicomFrame>& frames) {
  const std::vector<double> offsets = numbers_of(set, Tag(0x3004, 0xc));
  if (offsets.size() != count || !first.has_place) return false;
  if (offsets[0] != 0 && offsets[0] != first.position[2]) return false;
  const Point normal = cross(first.row, first.column);
  for (const double offset : offsets) {
    frames.push_back(first);
    frames.back().position = first.position + (offset - offsets[0]) * normal;
  }
  return true;
}

// Frames of other kinds lie along the normal, in distances that GDCM finds.
void guess_frames(const gdcm::File& file, size_t count, std::vector<DicomFrame>& frames) {
  DicomFrame frame;
  const std::vector<double> position = gdcm::ImageHelper::GetOriginValue(file);
  const std::vector<double> cosines = gdcm::ImageHelper::GetDirectionCosinesValue(file);
  const std::vector<double> spacing = gdcm::ImageHelper::GetSpacingValue(file);
  if (position.size() < 3 || cosines.size() < 6 || spacing.size() < 3) return frames.resize(count);
  frame.has_place = frame.has_spacing = true;
  for (size_t k = 0; k < 3; ++k) {
    frame.position[k] = position[k];
    frame.row[k] = cosines[k];
    frame.column[k] = cosines[3 + k];
  }
  frame.spacing[0] = spacing[0];
  frame.spacing[1] = spacing[1];
  const Point step = spacing[2] * cross(frame.row, frame.column);
  for (size_t k = 0; k < count; ++k) {
    frames.push_back(frame);
    frame.position = frame.position + step;
  }
}

void take_frames(const gdcm::File& file, size_t count, DicomFile& found) {
  const DataSet& set = file.GetDataSet();
  if (take_frames_by_groups(set, count, found.frames)) return;
  KnownFrame known;
  take_position(set, known.frame, known.has_position);
  take_orientation(set, known.frame, known.has_orientation);
  take_spacing(set, known.frame);
  known.frame.has_place = known.has_position && known.has_orientation;
  const std::vector<double> dose = numbers_of(set, Tag(0x3004, 0xe));
  if (dose.size() == 1) {
    known.frame.has_scale = true;
    known.frame.slope = dose[0];
  }
  if (count == 1) return found.frames.push_back(known.frame);
  if (take_frames_by_offsets(set, count, known.frame, found.frames)) return;
  found.header.is_guess = true;
  guess_frames(file, count, found.frames);
}

bool is_supplement(const gdcm::MediaStorage& storage) {
  switch (storage) {
    case gdcm::MediaStorage::RTDoseStorage:
    case gdcm::MediaStorage::SegmentationStorage:
    case gdcm::MediaStorage::SurfaceSegmentationStorage: return true;
    default: return false;
  }
}

void take_identity(const gdcm::File& file, DicomHeader& header) {
  const DataSet& set = file.GetDataSet();
  copy_text(text_of_element(set, Tag(0x20, 0xe)), header.series);
  copy_text(text_of_element(set, Tag(0x8, 0x60)), header.modality);
  copy_text(text_of_element(set, Tag(0x8, 0x103e)), header.description);
  parse_integer(text_of_element(set, Tag(0x20, 0x13)), header.instance);
}

bool send_file(const DicomFile& file, const Sender& sender) {
  std::string record(reinterpret_cast<const char*>(&file.header), sizeof file.header);
  record.append(reinterpret_cast<const char*>(file.frames.data()), file.frames.size() * sizeof(DicomFrame));
  return sender.send(record);
}

// Sends the identity of a file before GDCM looks at it closely, and all of it afterwards.
bool send_header(const std::string& path, const Sender& sender) {
  DicomFile found;
  DicomHeader& header = found.header;
  WatchedFile bytes;
  std::istream stream(&bytes);
  gdcm::Reader reader;
  reader.SetStream(stream);
  if (bytes.open(path, std::ios::in | std::ios::binary) == nullptr || !reader.CanRead())
    return send_file(found, sender) && send_file(found, sender);
  header.is_damaged = true;
  const bool is_read = reader.ReadUpToTag(Tag(0x7fe0, 0x10), {Tag(0x7fe0, 0x10)});
  const gdcm::File& file = reader.GetFile();
  take_identity(file, header);
  if (!send_file(found, sender)) return false;
  if (!is_read || bytes.cut_off()) return send_file(found, sender);
  gdcm::MediaStorage storage;
  storage.SetFromFile(file);
  header.is_damaged = false;
  if (!gdcm::MediaStorage::IsImage(storage)) return send_file(found, sender);
  header.is_supplement = is_supplement(storage);
  const std::vector<unsigned> sizes = gdcm::ImageHelper::GetDimensionsValue(file);
  header.is_image = sizes.size() >= 2 && sizes[0] > 0 && sizes[1] > 0 && (sizes.size() < 3 || sizes[2] > 0);
  header.is_damaged = !header.is_image;
  if (!header.is_image) return send_file(found, sender);
  header.columns = sizes[0];
  header.rows = sizes[1];
  header.samples = gdcm::ImageHelper::GetPixelFormatValue(file).GetSamplesPerPixel();
  take_frames(file, sizes.size() > 2 ? sizes[2] : 1, found);
  return send_file(found, sender);
}

// Headers from paths[files.size()] on, as far as GDCM comes. `fault`: how it ended, or empty.
Status read_headers_from(const std::vector<std::string>& paths, std::vector<DicomFile>& files, std::string& fault) {
  const size_t first = files.size();
  bool identity_is_next = true;
  const auto work = [&](const Sender& sender) {
    silence_gdcm();
    for (size_t i = first; i < paths.size() && send_header(paths[i], sender);) ++i;
    return success();
  };
  const auto take = [&](std::string_view record) {
    if (record.size() < sizeof(DicomHeader) || (record.size() - sizeof(DicomHeader)) % sizeof(DicomFrame) != 0 ||
        (identity_is_next && files.size() == paths.size()))
      return failure(paths[0], ": GDCM's answer is damaged");
    if (identity_is_next) files.emplace_back();
    DicomFile& file = files.back();
    std::memcpy(&file.header, record.data(), sizeof(DicomHeader));
    file.frames.resize((record.size() - sizeof(DicomHeader)) / sizeof(DicomFrame));
    if (!file.frames.empty())
      std::memcpy(file.frames.data(), record.data() + sizeof(DicomHeader), record.size() - sizeof(DicomHeader));
    identity_is_next = !identity_is_next;
    return success();
  };
  const Status status = run_apart({}, work, take, [&](const std::string& reason) {
    fault = reason;
    return success();
  });
  if (status && !fault.empty()) {
    if (identity_is_next) files.emplace_back();
    files.back().header.is_damaged = true;
    files.back().fault = fault;
  }
  return status;
}

}  // namespace

Status read_dicom_headers(const std::vector<std::string>& paths, std::vector<DicomFile>& files) {
  files.clear();
  while (files.size() < paths.size()) {
    std::string fault;
    const size_t before = files.size();
    if (Status status = read_headers_from(paths, files, fault); !status) return status;
    if (files.size() == before || (fault.empty() && files.size() < paths.size()))
      return failure(paths[0], ": GDCM's answer is damaged");
  }
  return success();
}

#else

Status read_dicom_headers(const std::vector<std::string>& paths, std::vector<DicomFile>&) {
  return failure(paths[0], ": is DICOM, and this build is without GDCM");
}

#endif

}  // namespace tool
