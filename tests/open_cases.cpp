#include "open_cases.h"

#include <algorithm>
#include <iterator>

namespace support {

namespace {

constexpr const char* open_cases[] = {
    // Of three tunnels that the growing balls make and fill, one stays.
    "topoadapt evolve balls-8 --seed 5",
    // A ring that closes along all of its hole in one step: its loops are joined, not capped.
    "topoadapt evolve ring --seed 1 --stride 16",
    // Parts as thin as an edge, all of them in contact: much of the volume goes.
    "five-copies 4",
    // A waist pressed flat is taken for a fold.
    "inverted-waists 2",
};

}  // namespace

bool IsOpen(const std::string& name) {
  return std::any_of(std::begin(open_cases), std::end(open_cases), [&](const char* known) { return name == known; });
}

}  // namespace support
