#include "open_cases.h"

#include <algorithm>
#include <iterator>

namespace support {

namespace {

constexpr const char* open_cases[] = {
    // The crease between the bodies folds over, and the step does not find a surface to close it.
    "topoadapt evolve ramming-pair --seed 3",
    "topoadapt evolve ramming-pair --seed 5",
    "topoadapt evolve merging-pair --seed 5 --renumber 5",
    // A slab is lost with the crease.
    "topoadapt evolve merging-pair --seed 3 --turn 16",
    // Severed at the crease.
    "topoadapt evolve merging-pair --seed 1 --stride 1",
    // A ring that closes along all of its hole in one step: its loops are joined, not capped.
    "topoadapt evolve ring --seed 1 --stride 16",
    // Parts as thin as an edge, all of them in contact: much of the volume goes.
    "five-copies 4",
    "five-cows 1",
    // A waist pressed flat is taken for a fold.
    "inverted-waists 2",
};

}  // namespace

bool IsOpen(const std::string& name) {
  return std::any_of(std::begin(open_cases), std::end(open_cases), [&](const char* known) { return name == known; });
}

}  // namespace support
