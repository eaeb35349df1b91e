// SPDX-License-Identifier: MIT
// arguments: a subcommand's words on the command line, sorted into options and positionals. Options are
// written
// "--name value" or "--name=value", flags "--name"; "--" ends the options; "-" alone is a positional or a
// value.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tool/result.h"

namespace tool {

struct Option {
  std::string_view name;  // with dashes
  bool takes_value = false;
  bool repeats = false;  // may be given several times
};

struct Arguments {
  std::vector<std::pair<std::string, std::string>> options;  // a flag's text is empty
  std::vector<std::string> positionals;

  // The text given with an option; null without the option.
  const std::string* find(std::string_view name) const;
  // The texts given with an option, in order.
  std::vector<std::string> find_all(std::string_view name) const;
  bool has(std::string_view name) const { return find(name) != nullptr; }
};

// `words` follow the subcommand. Fails on an unknown or repeated option, a missing or surplus value.
Status parse_arguments(int count, const char* const* words, std::span<const Option> known, Arguments& arguments);
inline Status parse_arguments(int count, const char* const* words, std::initializer_list<Option> known,
                              Arguments& arguments) {
  return parse_arguments(count, words, std::span(known.begin(), known.size()), arguments);
}

// Each sets `value` if the option was given, else leaves `value` alone, and fails on a text that does not fit.
Status read_real(const Arguments& arguments, std::string_view name, double& value);
Status read_unsigned(const Arguments& arguments, std::string_view name, uint64_t& value);
// Three numbers x,y,z each time the option is given.
Status read_points(const Arguments& arguments, std::string_view name, std::vector<std::array<double, 3>>& points);
Status read_text(const Arguments& arguments, std::string_view name, std::string& value);

// A positional: a whole number of at least `least`, called `what` in the message.
Status parse_whole(std::string_view text, std::string_view what, uint64_t least, uint64_t& value);

// Fails unless there are at least `least` and at most `most` positionals; `what` describes them ("one MESH").
Status expect_positionals(const Arguments& arguments, size_t least, size_t most, std::string_view what);

}  // namespace tool
