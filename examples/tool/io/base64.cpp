// SPDX-License-Identifier: MIT
#include "tool/io/base64.h"

#include <cstdint>

namespace tool {

std::string base64(std::string_view bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t there = bytes.size() - i < 3 ? bytes.size() - i : 3;
    uint32_t three = 0;
    for (size_t k = 0; k < 3; ++k) three = three << 8 | (k < there ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (size_t k = 0; k < 4; ++k) text += k <= there ? digits[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace tool
