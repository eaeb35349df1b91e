// SPDX-License-Identifier: MIT
// json: writes JSON (RFC 8259) piece by piece into a string. Numbers take the fewest digits that give the
// same bits back; what JSON cannot say (infinite, NaN) becomes null. Strings are UTF-8; a byte that is not, as file
// names may have, is written as a backslash, "x" and two hexadecimal digits.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <type_traits>

namespace tool {

class JsonWriter {
 public:
  JsonWriter& begin_object() { return open('{'); }
  JsonWriter& end_object() { return close('}'); }
  JsonWriter& begin_array() { return open('['); }
  JsonWriter& end_array() { return close(']'); }

  // Precondition: within an object, and a value, object or array follows.
  JsonWriter& key(std::string_view name) {
    separate();
    quote(name);
    text_ += ':';
    separated_ = true;
    return *this;
  }

  JsonWriter& value(std::string_view text) {
    separate();
    quote(text);
    return *this;
  }
  JsonWriter& value(const char* text) { return value(std::string_view(text)); }
  JsonWriter& value(bool truth) { return bare(truth ? "true" : "false"); }
  JsonWriter& value(double number) { return bare(digits_of(number)); }
  template <class Integer, std::enable_if_t<std::is_integral_v<Integer>, int> = 0>
  JsonWriter& value(Integer number) {
    return bare(std::to_string(number));
  }
  JsonWriter& null() { return bare("null"); }

  template <class Value>
  JsonWriter& member(std::string_view name, const Value& content) {
    return key(name).value(content);
  }

  const std::string& text() const { return text_; }

 private:
  // A comma before every value, except the first of an object or array and a value after a key.
  void separate() {
    if (!separated_) text_ += ',';
    separated_ = false;
  }
  JsonWriter& bare(std::string_view text) {
    separate();
    text_ += text;
    return *this;
  }
  JsonWriter& open(char bracket) {
    separate();
    text_ += bracket;
    separated_ = true;
    return *this;
  }
  JsonWriter& close(char bracket) {
    text_ += bracket;
    separated_ = false;
    return *this;
  }

  static std::string digits_of(double number) {
    if (!std::isfinite(number)) return "null";
    char digits[32];
    for (int precision = 9; precision <= 17; ++precision) {
      std::snprintf(digits, sizeof digits, "%.*g", precision, number);
      if (std::strtod(digits, nullptr) == number) break;
    }
    return digits;
  }

  // Bytes of the UTF-8 character that the text begins with (RFC 3629); 0 for bytes that are none.
  static size_t bytes_of_character(std::string_view text) {
    const auto at = [&](size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const unsigned lead = at(0);
    if (lead < 0x80) return 1;
    const size_t count = lead >= 0xC2 && lead < 0xE0   ? 2
                         : lead >= 0xE0 && lead < 0xF0 ? 3
                         : lead >= 0xF0 && lead < 0xF5 ? 4
                                                       : 0;
    for (size_t i = 1; i < count; ++i)
      if (at(i) < 0x80 || at(i) > 0xBF) return 0;
    const bool is_overlong = (lead == 0xE0 && at(1) < 0xA0) || (lead == 0xF0 && at(1) < 0x90);
    const bool is_beyond = (lead == 0xED && at(1) > 0x9F) || (lead == 0xF4 && at(1) > 0x8F);
    return is_overlong || is_beyond ? 0 : count;
  }

  void quote(std::string_view text) {
    text_ += '"';
    for (; !text.empty(); text.remove_prefix(1)) {
      const char c = text.front();
      const size_t bytes = bytes_of_character(text);
      if (bytes > 1) {
        text_ += text.substr(0, bytes);
        text.remove_prefix(bytes - 1);
      } else if (bytes == 0) {
        char escape[8];
        std::snprintf(escape, sizeof escape, "\\\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
        text_ += escape;
      } else if (c == '"' || c == '\\') {
        text_ += '\\';
        text_ += c;
      } else if (static_cast<unsigned char>(c) < 0x20) {
        char escape[8];
        std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(c));
        text_ += escape;
      } else {
        text_ += c;
      }
    }
    text_ += '"';
  }

  std::string text_;
  bool separated_ = true;
};

}  // namespace tool
