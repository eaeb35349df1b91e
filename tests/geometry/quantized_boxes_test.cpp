// SPDX-License-Identifier: MIT
// Boxes in bytes against boxes in single precision: boxes that meet are found, and few others.
#include "geometry/quantized_boxes.h"

#include <cfloat>
#include <iterator>
#include <vector>

#include "support/random_box.h"
#include "support/share.h"

namespace quantized_boxes_test {
namespace {

using namespace support;

struct Rows {
  explicit Rows(size_t n) : bytes(6 * (n + tpa::bytes_in_lanes)) {
    for (size_t k = 0; k < 6; ++k)
      (k < 3 ? lanes.low[k] : lanes.high[k - 3]) = bytes.data() + k * (n + tpa::bytes_in_lanes);
  }
  std::vector<uint8_t> bytes;
  tpa::QuantizedLanes lanes;
};

// Boxes of a leaf, in a frame for the first `framed` boxes; the later ones may lie beyond.
class Leaf {
 public:
  Leaf(uint32_t count, uint32_t framed, double size, Random& random) : rows(count) {
    for (uint32_t i = 0; i < count; ++i) boxes.push_back(RandomBox(random, size));
    frame = tpa::frame_round(Bounds(framed));
    for (uint32_t i = 0; i < count; ++i) tpa::set_box(rows.lanes, i, tpa::byte_box(frame, boxes[i]));
  }
  uint32_t count() const { return static_cast<uint32_t>(boxes.size()); }
  std::vector<bool> Meeting(const tpa::Box& query, uint32_t first) const {
    std::vector<bool> met(boxes.size());
    uint32_t before = first;
    tpa::for_each_meeting(rows.lanes, first, count(), tpa::byte_box(frame, query), [&](uint32_t i) {
      EXPECT_GE(i, before);
      before = i + 1;
      met[i] = true;
      return true;
    });
    return met;
  }
  // A frame beyond all boxes.
  void Widen() {
    const tpa::Box all = Bounds(count());
    const tpa::QuantizedFrame wider = tpa::frame_round(tpa::united(all, {{-1, -1, -1}, {1.5f, 1.5f, 1.5f}}));
    tpa::change_frame(rows.lanes, 0, count(), frame, wider);
    frame = wider;
  }
  // Boxes that meet are found; in a frame for all boxes, others only within four steps.
  void ExpectMeeting(const tpa::Box& query, uint32_t first, bool framed) const {
    const std::vector<bool> met = Meeting(query, first);
    tpa::Box wider = query;
    for (int k = 0; k < 3; ++k) wider.low[k] -= 4 / frame.steps, wider.high[k] += 4 / frame.steps;
    for (uint32_t i = 0; i < count(); ++i) {
      EXPECT_TRUE(met[i] || i < first || !tpa::boxes_meet(boxes[i], query));
      EXPECT_FALSE(met[i] && (i < first || (framed && !tpa::boxes_meet(boxes[i], wider))));
    }
  }

  std::vector<tpa::Box> boxes;
  tpa::QuantizedFrame frame;
  Rows rows;

 private:
  tpa::Box Bounds(uint32_t n) const {
    tpa::Box all = boxes[0];
    for (uint32_t i = 0; i < n; ++i) all = tpa::united(all, boxes[i]);
    return all;
  }
};

TEST(QuantizedBoxes, WhatMeetsIsFound) {
  for (uint64_t seed = 1; seed <= Share(400u); ++seed) {
    Random random(seed);
    // Flat and tiny boxes too.
    const double sizes[] = {.2, 1e-3, 1e-30, 0};
    const uint32_t count = 1 + static_cast<uint32_t>(random() % 200);
    const bool framed = seed % 8 < 4;
    Leaf leaf(count, framed ? count : 1, sizes[seed % 4], random);
    for (const bool widened : {false, true}) {
      if (widened) leaf.Widen();
      for (int i = 0; i < 20; ++i) {
        const uint32_t first = static_cast<uint32_t>(random() % leaf.count());
        leaf.ExpectMeeting(RandomBox(random, i % 2 == 0 ? .3 : 0), first, framed);
        leaf.ExpectMeeting(leaf.boxes[random() % leaf.count()], first, framed);
      }
    }
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

// Bounds beyond the frame, however far, count as the first or the last step.
TEST(QuantizedBoxes, StepsEndWithTheFrame) {
  Random random(6);
  const tpa::QuantizedFrame frame = tpa::frame_round({{-1, -1, -1}, {1, 1, 1}});
  const float far[] = {FLT_MAX, 1e30f, 3e9f, 4e7f, 70000, 300, 1.1f, 1e-30f, 0};
  for (int i = 0; i < 5000; ++i) {
    tpa::Box box{};
    float* const bounds[] = {box.low, box.high};
    for (float* bound : bounds)
      for (int k = 0; k < 3; ++k) {
        bound[k] = i % 2 == 0 ? far[random() % std::size(far)] : static_cast<float>(Uniform(random, 0, 1.2));
        if (random() % 2 == 0) bound[k] = -bound[k];
      }
    const tpa::QuantizedBox bytes = tpa::byte_box(frame, box);
    for (int k = 0; k < 3; ++k) {
      const auto step = [&](float at) {
        const float steps = (at - frame.low[k]) * frame.steps;
        return steps < 0 ? 0 : steps > 254 ? 254 : static_cast<int>(steps);
      };
      ASSERT_EQ(bytes.low[k], step(box.low[k])) << box.low[k];
      ASSERT_EQ(bytes.high[k], step(box.high[k])) << box.high[k];
    }
  }
}

// Bounds set sixteen at a time equal bounds set one by one; nothing behind the room is written.
TEST(QuantizedBoxes, BoundsAreSetAsOneByOne) {
  for (uint64_t seed = 1; seed <= Share(200u); ++seed) {
    Random random(seed);
    const uint32_t groups = 1 + static_cast<uint32_t>(random() % 18),
                   room = 4 * groups - static_cast<uint32_t>(random() % 4);
    const tpa::Box box = RandomBox(random, 1);
    const tpa::QuantizedFrame frame = tpa::frame_round(box);
    std::vector<tpa::F4> bounds(groups + 3);
    for (tpa::F4& four : bounds)
      for (int i = 0; i < 4; ++i) four[i] = static_cast<float>(Uniform(random, box.low[1], box.high[1]));
    std::vector<uint8_t> bytes(4 * groups + 16, 77);
    tpa::set_bounds(frame, 1, {bounds.data(), groups}, bytes.data(), room);
    for (uint32_t i = 0; i < bytes.size(); ++i) {
      tpa::Box one = box;
      if (i < room) one.low[1] = bounds[i / 4][i % 4];
      EXPECT_EQ(bytes[i], i < room ? tpa::byte_box(frame, one).low[1] : 77) << i << " of " << room << ", seed " << seed;
    }
  }
}

// Removed boxes meet nothing, in any frame.
TEST(QuantizedBoxes, NoBoxMeetsAnything) {
  Random random(5);
  Leaf leaf(40, 40, .2, random);
  for (uint32_t i = 0; i < leaf.count(); i += 3) tpa::set_box(leaf.rows.lanes, i, tpa::no_byte_box);
  for (const bool widened : {false, true}) {
    if (widened) leaf.Widen();
    const std::vector<bool> met = leaf.Meeting({{-2, -2, -2}, {2, 2, 2}}, 0);
    for (uint32_t i = 0; i < leaf.count(); ++i) EXPECT_EQ(met[i], i % 3 != 0) << i;
  }
}

}  // namespace
}  // namespace quantized_boxes_test
