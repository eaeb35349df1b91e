// SPDX-License-Identifier: MIT
// json: writes JSON (RFC 8259) piece by piece into a string. Numbers take the fewest digits that give the
// same bits back; what JSON cannot say (infinite, NaN) becomes null. Strings are taken to be UTF-8.
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

  void quote(std::string_view text) {
    text_ += '"';
    for (const char c : text) {
      if (c == '"' || c == '\\') {
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
