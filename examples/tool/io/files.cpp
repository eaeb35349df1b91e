// SPDX-License-Identifier: MIT
// files: whole files, lines, words and numbers for the readers and writers of the tool.
#include "tool/io/files.h"

#include <cctype>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace tool {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

Status file_size_of(const std::string& path, uint64_t& bytes) {
  std::error_code error;
  const std::filesystem::file_status kind = std::filesystem::status(path, error);
  if (!std::filesystem::exists(kind)) return failure(path, ": no such file");
  if (!std::filesystem::is_regular_file(kind)) return failure(path, ": is not a file");
  const uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return failure(path, ": ", error.message());
  bytes = size;
  return success();
}

Status read_file(const std::string& path, std::string& bytes) {
  uint64_t size = 0;
  if (Status status = file_size_of(path, size); !status) return status;
  std::ifstream file(path, std::ios::binary);
  if (!file) return failure(path, ": cannot be opened");
  bytes.resize(static_cast<size_t>(size));
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  if (static_cast<uint64_t>(file.gcount()) != size) {
    return failure(path, ": reading stopped after ", file.gcount(), " of ", size, " bytes");
  }
  return success();
}

bool ends_with_ignoring_case(std::string_view text, std::string_view lower_case_ending) {
  if (text.size() < lower_case_ending.size()) return false;
  return lower_case(text.substr(text.size() - lower_case_ending.size())) == lower_case_ending;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = lower(c);
  return result;
}

std::string beside(const std::string& header_path, std::string_view name) {
  return (std::filesystem::path(header_path).parent_path() / std::filesystem::path(name)).string();
}

bool LineReader::next(std::string_view& line) {
  if (position >= text.size()) return false;
  const size_t end = text.find('\n', position);
  const size_t stop = end == std::string_view::npos ? text.size() : end;
  line = text.substr(position, stop - position);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  position = end == std::string_view::npos ? text.size() : end + 1;
  ++number;
  return true;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

bool next_word(std::string_view& rest, std::string_view& word) {
  size_t begin = 0;
  while (begin < rest.size() && is_blank(rest[begin])) ++begin;
  size_t end = begin;
  while (end < rest.size() && !is_blank(rest[end])) ++end;
  word = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return !word.empty();
}

bool parse_real(std::string_view text, double& value) {
  char digits[128];
  if (text.empty() || text.size() >= sizeof digits || is_blank(text.front())) return false;
  std::memcpy(digits, text.data(), text.size());
  digits[text.size()] = '\0';
  char* end = nullptr;
  value = std::strtod(digits, &end);
  return end == digits + text.size();
}

bool parse_integer(std::string_view text, int64_t& value) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  if (text.empty()) return false;
  const std::from_chars_result read = std::from_chars(text.data(), text.data() + text.size(), value);
  return read.ec == std::errc() && read.ptr == text.data() + text.size();
}

}  // namespace tool
