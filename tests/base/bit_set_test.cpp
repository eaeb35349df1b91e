// SPDX-License-Identifier: MIT
// The bit set against std::set.
#include "base/bit_set.h"

#include <set>
#include <vector>

#include "support/share.h"
#include "support/support.h"

namespace bit_set_test {
namespace {

using namespace support;

void ExpectSame(const tpa::BitSet& set, const std::set<uint32_t>& expected) {
  std::vector<uint32_t> found;
  for (uint32_t id : set) found.push_back(id);
  EXPECT_EQ(found, std::vector<uint32_t>(expected.begin(), expected.end()));
  std::vector<uint32_t> one_by_one;
  for (uint32_t id = set.next(0); id != tpa::none; id = set.next(id + 1)) one_by_one.push_back(id);
  EXPECT_EQ(one_by_one, found);
}

// Sizes round the limits of each level's words; members all over, in a row, or few.
TEST(BitSet, HoldsWhatWasAdded) {
  Random random(1);
  for (const uint32_t n : {1u, 31u, 32u, 33u, 1023u, 1024u, 1025u, 32767u, 32768u, 32769u, 600000u}) {
    std::vector<uint32_t> words(tpa::bit_set_words(n));
    tpa::BitSet set = tpa::open_bit_set(words.data(), n);
    std::set<uint32_t> expected;
    ExpectSame(set, expected);
    for (int round = 0; round < Share(12); ++round) {
      const uint32_t from = static_cast<uint32_t>(random() % n), row = std::min(n - from, 300u);
      for (int i = 0; i < 300; ++i) {
        const uint32_t id =
            round % 3 == 0 ? static_cast<uint32_t>(random() % n) : from + static_cast<uint32_t>(random() % row);
        if (round % 4 == 3) {
          set.remove(id);
          expected.erase(id);
        } else {
          EXPECT_EQ(set.add(id), expected.insert(id).second);
        }
        EXPECT_EQ(set.contains(id), expected.contains(id));
      }
      EXPECT_TRUE(set.add(n - 1) == expected.insert(n - 1).second);
      ExpectSame(set, expected);
      // Numbers may go while the loop has them in hand.
      if (round % 5 == 4)
        for (uint32_t id : set)
          if (id % 2 == 0) set.remove(id), expected.erase(id);
      ExpectSame(set, expected);
      if (round % 6 == 5) {
        const uint32_t least = static_cast<uint32_t>(random() % (n + 1));
        set.cut_off(least);
        expected.erase(expected.lower_bound(least), expected.end());
        ExpectSame(set, expected);
      }
      ASSERT_FALSE(HasFailure()) << n << ", round " << round;
    }
    set.clear();
    ExpectSame(set, {});
  }
}

}  // namespace
}  // namespace bit_set_test
