// How pairs of numbers are scattered for hashes.
#include "base/base.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace {

// The half-edges of a fan whose rim is numbered with a stride, as in meshes that are made row by row: in twice as many
// bins as there are of them, as in the hash that handles are sewn by, they crowd no more than if they were thrown at
// random. With one product in place of two some strides have 13 and more in a bin.
TEST(Scattered, EdgesOfFansDoNotCrowd) {
  constexpr uint32_t rim = 200, hub = 1 << 20;
  for (uint32_t stride = 1; stride < 3000; ++stride) {
    std::vector<int> bins(6 * rim);
    const auto note = [&](uint32_t a, uint32_t b) { ++bins[uint64_t{tpa::scattered(a, b)} * bins.size() >> 32]; };
    for (uint32_t i = 0; i < rim; ++i) {
      const uint32_t v = 7 + i * stride, next = 7 + (i + 1) % rim * stride;
      note(hub, v), note(v, next), note(next, hub);
    }
    // Where 600 are thrown into 1200 bins, one has more than 8 in four of a million times.
    ASSERT_LE(*std::max_element(bins.begin(), bins.end()), 8) << "stride " << stride;
  }
}

}  // namespace
