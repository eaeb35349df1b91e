#include "open_cases.h"

#include <algorithm>
#include <iterator>

namespace support {

namespace {

constexpr const char* open_cases[] = {
    // A tunnel too many, and one too few.
    "tubes-through-tubes 5", "tubes-through-tubes 13",
};

}  // namespace

bool IsOpen(const std::string& name) {
  return std::any_of(std::begin(open_cases), std::end(open_cases), [&](const char* known) { return name == known; });
}

}  // namespace support
