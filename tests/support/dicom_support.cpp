// SPDX-License-Identifier: MIT
#include "support/dicom_support.h"

#include "tool/io/files.h"

namespace tool {

namespace {

std::string element(int group, int number, const char* type, std::string value) {
  if (value.size() % 2 != 0) value += std::string_view(type) == "UI" ? '\0' : ' ';
  std::string bytes;
  append_little_endian(bytes, static_cast<uint16_t>(group));
  append_little_endian(bytes, static_cast<uint16_t>(number));
  bytes += type;
  if (type[0] == 'O') {
    append_little_endian(bytes, uint16_t{0});
    append_little_endian(bytes, static_cast<uint32_t>(value.size()));
  } else {
    append_little_endian(bytes, static_cast<uint16_t>(value.size()));
  }
  return bytes + value;
}

std::string number_of(int number) {
  std::string bytes;
  append_little_endian(bytes, static_cast<uint16_t>(number));
  return bytes;
}

}  // namespace

std::string dicom_slice(int k) {
  const std::string ct = "1.2.840.10008.5.1.4.1.1.2", own = "2.25.1234567." + std::to_string(k + 1);
  const std::string meta = element(2, 1, "OB", std::string("\0\1", 2)) + element(2, 2, "UI", ct) +
                           element(2, 3, "UI", own) + element(2, 0x10, "UI", "1.2.840.10008.1.2.1") +
                           element(2, 0x12, "UI", "2.25.9");
  std::string length;
  append_little_endian(length, static_cast<uint32_t>(meta.size()));
  std::string voxels;
  for (int i = 1; i <= 4; ++i) append_little_endian(voxels, static_cast<uint16_t>(4 * k + i));
  return std::string(128, '\0') + "DICM" + element(2, 0, "UL", length) + meta + element(8, 0x16, "UI", ct) +
         element(8, 0x18, "UI", own) + element(8, 0x60, "CS", "CT") + element(0x10, 0x10, "PN", "Nobody") +
         element(0x20, 0xd, "UI", "2.25.7") + element(0x20, 0xe, "UI", "2.25.8") +
         element(0x20, 0x13, "IS", std::to_string(9 - k)) +
         element(0x20, 0x32, "DS", "0\\0\\" + std::to_string(2 * k)) + element(0x20, 0x37, "DS", "1\\0\\0\\0\\1\\0") +
         element(0x28, 2, "US", number_of(1)) + element(0x28, 4, "CS", "MONOCHROME2") +
         element(0x28, 0x10, "US", number_of(2)) + element(0x28, 0x11, "US", number_of(2)) +
         element(0x28, 0x30, "DS", "1\\1") + element(0x28, 0x100, "US", number_of(16)) +
         element(0x28, 0x101, "US", number_of(16)) + element(0x28, 0x102, "US", number_of(15)) +
         element(0x28, 0x103, "US", number_of(0)) + element(0x28, 0x1052, "DS", "-10") +
         element(0x28, 0x1053, "DS", "2") + element(0x7fe0, 0x10, "OW", voxels);
}

}  // namespace tool
