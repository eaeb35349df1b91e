// SPDX-License-Identifier: MIT
// files: what every file format here needs: whole files, lines with their numbers, words, numbers, bytes in a
// given order. Numbers are read in the C locale's spelling; text may end its lines with LF or CR LF.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "tool/result.h"

namespace tool {

// Size in bytes of a regular file; the failure says whether it is missing or something else.
Status file_size_of(const std::string& path, uint64_t& bytes);
Status read_file(const std::string& path, std::string& bytes);

bool ends_with_ignoring_case(std::string_view text, std::string_view lower_case_ending);
std::string lower_case(std::string_view text);
// The path of a file that the header at `header_path` names: relative names count from the header's folder.
std::string beside(const std::string& header_path, std::string_view name);

// Lines in turn, without their line ends. `number` is that of the line last read, from 1.
struct LineReader {
  std::string_view text;
  size_t position = 0;
  uint64_t number = 0;
  bool next(std::string_view& line);
};

std::string_view trimmed(std::string_view text);
// Takes the next word, as divided by blanks, off the front of `rest`.
bool next_word(std::string_view& rest, std::string_view& word);
// The whole of `text` must be a number. Reals may be infinite or NaN: the reader of the number judges that.
bool parse_real(std::string_view text, double& value);
bool parse_integer(std::string_view text, int64_t& value);

// The number of type T at `bytes`, stored with its most significant byte first or last.
template <class T>
T load(const void* bytes, bool big_endian) {
  unsigned char raw[sizeof(T)];
  std::memcpy(raw, bytes, sizeof(T));
  if (big_endian != (std::endian::native == std::endian::big)) {
    for (size_t i = 0; i < sizeof(T) / 2; ++i) {
      const unsigned char swapped = raw[i];
      raw[i] = raw[sizeof(T) - 1 - i];
      raw[sizeof(T) - 1 - i] = swapped;
    }
  }
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return value;
}

template <class T>
void append_little_endian(std::string& bytes, T value) {
  const T ordered = load<T>(&value, false);
  char raw[sizeof(T)];
  std::memcpy(raw, &ordered, sizeof(T));
  bytes.append(raw, sizeof(T));
}

}  // namespace tool
