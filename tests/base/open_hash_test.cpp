// SPDX-License-Identifier: MIT
// The open hash against std::map, up to one free slot.
#include "base/open_hash.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <vector>

namespace open_hash_test {
namespace {

TEST(OpenHash, FindsWhatWasEntered) {
  for (uint32_t seed = 1; seed <= 200; ++seed) {
    std::mt19937 engine(seed);
    const auto random = [&] { return static_cast<uint32_t>(engine()); };
    const uint32_t size = 2 + random() % 60, range = 1 + random() % 200;
    std::vector<uint32_t> slots(size), keys;
    const tpa::OpenHash table{slots.data(), size};
    tpa::OpenHash(table).clear();
    std::map<uint32_t, uint32_t> expected;
    // A poor hash on half of the seeds: all probing goes round the end of the table.
    const auto hash = [&](uint32_t key) { return seed % 2 == 0 ? ~uint32_t{0} : tpa::scattered(key); };
    const auto find = [&](uint32_t key) -> uint32_t& {
      return table.find(hash(key), [&](uint32_t i) { return keys[i] == key; });
    };
    while (keys.size() + 1 < size) {
      const uint32_t key = random() % (range + size);
      uint32_t& slot = find(key);
      const auto known = expected.find(key);
      ASSERT_EQ(slot, known == expected.end() ? tpa::none : known->second) << "seed " << seed << ", key " << key;
      if (slot != tpa::none) continue;
      slot = static_cast<uint32_t>(keys.size());
      expected[key] = slot;
      keys.push_back(key);
    }
    for (const auto& [key, index] : expected) EXPECT_EQ(find(key), index) << "seed " << seed;
    EXPECT_EQ(find(range + size + 1), tpa::none) << "seed " << seed;
  }
}

}  // namespace
}  // namespace open_hash_test
