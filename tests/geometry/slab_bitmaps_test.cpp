// SPDX-License-Identifier: MIT
// Slab bitmaps against comparisons of single boxes: boxes that meet are found, and few others.
#include "geometry/slab_bitmaps.h"

#include <memory>
#include <vector>

#include "support/random_box.h"
#include "support/share.h"

namespace slab_bitmaps_test {
namespace {

using namespace support;

tpa::Box Widened(tpa::Box b, float by) {
  for (int k = 0; k < 3; ++k) b.low[k] -= by, b.high[k] += by;
  return b;
}

// The arrangement of the boxes.
enum class Kind { anywhere, in_a_plane, on_a_line, equal, tiny, kinds };

struct Boxes {
  Boxes(uint32_t count, double size, Kind kind, Random& random) {
    const tpa::Box first = RandomBox(random, size);
    const int flat = kind == Kind::in_a_plane ? 1 : kind == Kind::on_a_line ? 2 : kind == Kind::equal ? 3 : 0;
    for (uint32_t i = 0; i < count; ++i) {
      tpa::Box& box = all.emplace_back(RandomBox(random, size));
      for (int k = 0; k < flat; ++k) box.low[k] = first.low[k], box.high[k] = first.high[k];
      for (int k = 0; k < 3 && kind == Kind::tiny; ++k) box.low[k] *= 0x1p-90f, box.high[k] *= 0x1p-90f;
    }
    bounds = all[0];
    for (const tpa::Box& box : all) bounds = tpa::united(bounds, box);
  }
  uint32_t count() const { return static_cast<uint32_t>(all.size()); }
  std::vector<tpa::Box> all;
  tpa::Box bounds;
};

uint32_t SlabsFor(uint32_t boxes) {
  uint32_t slabs = 16;
  while (slabs < boxes && slabs < 32) slabs *= 2;
  return slabs;
}

// Every number of boxes up to the limit, flat boxes and points too.
TEST(Slabs, WhatMeetsIsFound) {
  const auto room = std::make_unique<tpa::SlabBitmaps::Word[]>(tpa::SlabBitmaps::most / 64);
  for (uint64_t seed = 1; seed <= Share(1000u); ++seed) {
    Random random(seed);
    const double sizes[] = {.2, 1e-3, 0};
    const Kind kind = static_cast<Kind>(random() % static_cast<uint64_t>(Kind::kinds));
    const Boxes boxes(1 + static_cast<uint32_t>(random() % tpa::SlabBitmaps::most), sizes[seed % 3], kind, random);
    const tpa::SlabBitmaps sets({boxes.all.data(), boxes.count()}, boxes.bounds, room.get());
    ASSERT_EQ(sets.words, (boxes.count() + 63) / 64);
    ASSERT_EQ(256u >> sets.steps_of_slab, SlabsFor(boxes.count()));
    // The bounds of both boxes are rounded to slabs.
    const float slab = static_cast<float>(1 << sets.steps_of_slab) / sets.frame.steps;
    for (int i = 0; i < 20; ++i) {
      tpa::Box query = i % 2 == 0 ? RandomBox(random, .3) : boxes.all[random() % boxes.count()];
      if (i % 5 == 0) query = Widened(query, i % 10 == 0 ? 1e30f : 3);
      for (int k = 0; k < 3 && i % 4 == 2; ++k) query.low[k] += 1e6f, query.high[k] += 1e6f;
      uint64_t met[tpa::SlabBitmaps::most / 64] = {};
      sets.meeting(query, met);
      const bool within = tpa::boxes_meet(boxes.bounds, query);  // other queries have weaker answers
      for (uint32_t at = 0; at < 64 * sets.words; ++at) {
        const bool is_met = (met[at / 64] >> at % 64 & 1) != 0, is_there = at < boxes.count();
        EXPECT_TRUE(is_met || !is_there || !tpa::boxes_meet(boxes.all[at], query)) << at << ", seed " << seed;
        EXPECT_FALSE(is_met && (!is_there || (within && !tpa::boxes_meet(boxes.all[at], Widened(query, 1.01f * slab)))))
            << at << ", seed " << seed;
      }
    }
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

// Boxes less than a slab apart may be found, but no others: along a line as many to each side as a slab has.
TEST(Slabs, AreNoLongerThanTheirNumberSays) {
  const auto room = std::make_unique<tpa::SlabBitmaps::Word[]>(tpa::SlabBitmaps::most / 64);
  for (const uint32_t count : {16u, 32u, 60u, 100u, 128u}) {
    std::vector<tpa::Box> boxes;
    for (uint32_t i = 0; i < count; ++i) {
      const float x = static_cast<float>(i);
      boxes.push_back({{x + .4f, 0, 0}, {x + .6f, .1f, .1f}});
    }
    tpa::Box bounds = boxes[0];
    for (const tpa::Box& box : boxes) bounds = tpa::united(bounds, box);
    const tpa::SlabBitmaps sets({boxes.data(), count}, bounds, room.get());
    // .2 lies within each box.
    const uint32_t beside =
        static_cast<uint32_t>(1.01f * static_cast<float>(count) / static_cast<float>(SlabsFor(count)) + .2f);
    for (uint32_t i = 0; i < count; ++i) {
      uint64_t met[tpa::SlabBitmaps::most / 64] = {};
      sets.meeting(boxes[i], met);
      for (uint32_t at = 0; at < count; ++at)
        EXPECT_FALSE((met[at / 64] >> at % 64 & 1) != 0 && (at + beside < i || at > i + beside))
            << at << " and " << i << " of " << count;
    }
  }
}

}  // namespace
}  // namespace slab_bitmaps_test
