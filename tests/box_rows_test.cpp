// Which boxes meet a query, by rows, by blocks of rows and out of a range, against one box after another.
#include "box_rows.h"

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

tpa::BroadBox Query(const tpa::Box& box) { return tpa::broad(tpa::flat(box)); }

TEST(BoxRows, BlocksTellWhatMeets) {
  Random random(1);
  uint64_t met = 0, not_met = 0;
  for (int round = 0; round < 300; ++round) {
    // What lies behind the last row that is used was never written.
    std::vector<tpa::BoxRow> rows(1 + random() % tpa::BoxRow::size);
    const auto count = static_cast<uint32_t>(tpa::BoxRow::size * rows.size() - random() % tpa::BoxRow::size);
    tpa::BoxRow bounds;
    tpa::clear(bounds);
    for (tpa::BoxRow& row : rows) tpa::clear(row);
    std::vector<tpa::Box> boxes(count, tpa::empty_box);
    for (uint32_t i = 0; i < count; ++i) {
      if (random() % 5 == 0) continue;
      boxes[i] = SomeBox(random, 4);
      const uint32_t row = i / tpa::BoxRow::size;
      tpa::set_box(rows[row], i % tpa::BoxRow::size, boxes[i]);
      tpa::widen_box(bounds, row, boxes[i]);
      EXPECT_EQ(tpa::box_at(rows[row], i % tpa::BoxRow::size).high[2], boxes[i].high[2]);
    }
    for (int i = 0; i < 20; ++i) {
      const tpa::Box query = SomeBox(random, 3);
      uint64_t expected = 0;
      for (uint32_t k = 0; k < count; ++k) expected |= uint64_t{tpa::boxes_meet(boxes[k], query)} << k;
      ASSERT_EQ(tpa::boxes_meeting(rows.data(), bounds, Query(query)), expected) << "round " << round;
      ASSERT_EQ(tpa::boxes_meeting(rows[0], Query(query)), expected & 0xFF);
      (expected != 0 ? met : not_met) += 1;
    }
  }
  EXPECT_GT(met, 1000u);
  EXPECT_GT(not_met, 100u);
}

// Ranges of every length, beyond what is noted at once; the visit may end it.
TEST(BoxRows, RangesAreVisitedInOrder) {
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
