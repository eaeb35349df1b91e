// SPDX-License-Identifier: MIT
// arguments: the tool's command-line words.
#include "tool/arguments.h"

#include <charconv>
#include <cmath>

#include "tool/io/files.h"

namespace tool {

namespace {

const Option* option_named(std::span<const Option> known, std::string_view name) {
  for (const Option& option : known) {
    if (option.name == name) return &option;
  }
  return nullptr;
}

bool parse_unsigned(std::string_view text, uint64_t& value) {
  const std::from_chars_result read = std::from_chars(text.data(), text.data() + text.size(), value);
  return read.ec == std::errc() && read.ptr == text.data() + text.size();
}

bool parse_finite(std::string_view text, double& value) { return parse_real(text, value) && std::isfinite(value); }

}  // namespace

const std::string* Arguments::find(std::string_view name) const {
  for (const auto& [given, text] : options) {
    if (given == name) return &text;
  }
  return nullptr;
}

std::vector<std::string> Arguments::find_all(std::string_view name) const {
  std::vector<std::string> texts;
  for (const auto& [given, text] : options)
    if (given == name) texts.push_back(text);
  return texts;
}

Status parse_arguments(int count, const char* const* words, std::span<const Option> known, Arguments& arguments) {
  bool options_ended = false;
  for (int i = 0; i < count; ++i) {
    const std::string_view word = words[i];
    if (options_ended || word.size() < 2 || word[0] != '-') {
      arguments.positionals.emplace_back(word);
      continue;
    }
    if (word == "--") {
      options_ended = true;
      continue;
    }
    const size_t equals = word.find('=');
    const std::string_view name = word.substr(0, equals);
    const bool has_text = equals != std::string_view::npos;
    const Option* option = option_named(known, name);
    if (!option) return failure("unknown option ", name);
    if (!option->repeats && arguments.has(name)) return failure(name, " is given twice");
    if (!option->takes_value && has_text) return failure(name, " takes no value");
    std::string_view text = has_text ? word.substr(equals + 1) : std::string_view();
    if (option->takes_value && !has_text) {
      const bool follows = i + 1 < count && std::string_view(words[i + 1]).substr(0, 2) != "--";
      if (!follows) return failure(name, " needs a value");
      text = words[++i];
    }
    if (option->takes_value && text.empty()) return failure(name, " needs a value");
    arguments.options.emplace_back(name, text);
  }
  return success();
}

Status read_real(const Arguments& arguments, std::string_view name, double& value) {
  const std::string* text = arguments.find(name);
  double read = 0;
  if (!text) return success();
  if (!parse_finite(*text, read)) return failure(name, ": \"", *text, "\" is not a number");
  value = read;
  return success();
}

Status read_unsigned(const Arguments& arguments, std::string_view name, uint64_t& value) {
  const std::string* text = arguments.find(name);
  uint64_t read = 0;
  if (!text) return success();
  if (!parse_unsigned(*text, read)) return failure(name, ": \"", *text, "\" is not a whole number from 0 to 2^64 - 1");
  value = read;
  return success();
}

Status read_points(const Arguments& arguments, std::string_view name, std::vector<std::array<double, 3>>& points) {
  points.clear();
  for (const std::string& text : arguments.find_all(name)) {
    std::array<double, 3> read{};
    std::string_view rest = text;
    bool good = true;
    for (size_t axis = 0; axis < 3 && good; ++axis) {
      const size_t comma = rest.find(',');
      good = (comma == std::string_view::npos) == (axis == 2) && parse_finite(rest.substr(0, comma), read[axis]);
      if (axis < 2 && good) rest.remove_prefix(comma + 1);
    }
    if (!good) return failure(name, ": \"", text, "\" is not three numbers x,y,z");
    points.push_back(read);
  }
  return success();
}

Status read_text(const Arguments& arguments, std::string_view name, std::string& value) {
  if (const std::string* text = arguments.find(name)) value = *text;
  return success();
}

Status parse_whole(std::string_view text, std::string_view what, uint64_t least, uint64_t& value) {
  if (parse_unsigned(text, value) && value >= least) return success();
  return failure(what, ": \"", text, "\" is not a whole number of at least ", least);
}

Status expect_positionals(const Arguments& arguments, size_t least, size_t most, std::string_view what) {
  const size_t given = arguments.positionals.size();
  if (given < least) return failure("expected ", what, ", got ", given);
  if (given > most) return failure("unexpected \"", arguments.positionals[most], "\" (expected ", what, ")");
  return success();
}

}  // namespace tool
