// Which boxes of a range meet a query, four at a time, against one box after another.
#include "flat_box.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "grid.h"

namespace {

using Random = std::mt19937;

// On a coarse lattice, so that many touch.
tpa::Box SomeBox(Random& random, uint32_t extent) {
  tpa::Box box;
  for (int k = 0; k < 3; ++k) {
    box.low[k] = static_cast<float>(random() % 12);
    box.high[k] = box.low[k] + static_cast<float>(random() % extent);
  }
  return box;
}

tpa::BroadBox Query(const tpa::Box& box) { return tpa::broad(box); }

// Ranges of every length, beyond what is noted at once; the visit may end it.
TEST(FlatBoxes, RangesAreVisitedInOrder) {
  Random random(2);
  for (uint32_t count = 0; count < 200; ++count) {
    const uint32_t first = static_cast<uint32_t>(random() % 7), last = first + count;
    // Boxes are read four at a time.
    std::vector<float> low[3], high[3];
    for (int k = 0; k < 3; ++k) low[k].resize(last + 3), high[k].resize(last + 3);
    std::vector<tpa::Box> boxes(last + 3);
    for (uint32_t i = 0; i < last + 3; ++i) {
      boxes[i] = SomeBox(random, 4);
      for (int k = 0; k < 3; ++k) low[k][i] = boxes[i].low[k], high[k][i] = boxes[i].high[k];
    }
    const tpa::ConstBoxLanes lanes{{low[0].data(), low[1].data(), low[2].data()},
                                   {high[0].data(), high[1].data(), high[2].data()}};
    const tpa::Box query = SomeBox(random, 6);
    std::vector<uint32_t> expected, visited;
    for (uint32_t i = first; i < last; ++i)
      if (tpa::boxes_meet(boxes[i], query)) expected.push_back(i);
    const auto visit_until = [&](size_t end) {
      visited.clear();
      return tpa::for_each_meeting(lanes, first, last, Query(query), [&](uint32_t i) {
        visited.push_back(i);
        return visited.size() < end;
      });
    };
    EXPECT_TRUE(visit_until(count + 1));
    EXPECT_EQ(visited, expected) << count;
    if (expected.empty()) continue;
    const size_t end = 1 + random() % expected.size();
    EXPECT_FALSE(visit_until(end));
    EXPECT_EQ(visited, std::vector<uint32_t>(expected.begin(), expected.begin() + static_cast<ptrdiff_t>(end)));
  }
}

}  // namespace
