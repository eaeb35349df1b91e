#include "open_cases.h"

#include <algorithm>
#include <iterator>

namespace support {

namespace {

constexpr const char* open_cases[] = {
    // Loops that nothing joins are cut out more widely all round: much of the volume goes.
    "five-copies 4", "five-copies 6", "five-copies 15", "five-copies 16", "five-copies 17", "five-copies 18",
    "five-copies 19",
};

}  // namespace

bool IsOpen(const std::string& name) {
  return std::any_of(std::begin(open_cases), std::end(open_cases), [&](const char* known) { return name == known; });
}

}  // namespace support
