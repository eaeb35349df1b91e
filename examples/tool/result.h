// SPDX-License-Identifier: MIT
// result: success or failure of a function of the tool. A failure carries one line of text with cause and place, such
// as "volume.nhdr: line 4: sizes gives 0"; the tool prints the line and exits 2.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <type_traits>

namespace tool {

struct [[nodiscard]] Status {
  bool ok = true;
  std::string message;
  explicit operator bool() const { return ok; }
};

inline Status success() { return {}; }

template <class Part>
void append_part(std::string& text, const Part& part) {
  if constexpr (std::is_floating_point_v<Part>) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.9g", static_cast<double>(part));
    text += digits;
  } else if constexpr (std::is_integral_v<Part> && !std::is_same_v<Part, char>) {
    text += std::to_string(part);
  } else {
    text += part;
  }
}

// One line of text from strings, characters and numbers, in the order given.
template <class... Parts>
std::string text_of(const Parts&... parts) {
  std::string text;
  (append_part(text, parts), ...);
  return text;
}

template <class... Parts>
Status failure(const Parts&... parts) {
  return {false, text_of(parts...)};
}

}  // namespace tool
