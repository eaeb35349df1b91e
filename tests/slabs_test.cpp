// Slabs: what meets must be found, and little else. The judge compares the boxes themselves, one by one.
#include "slabs.h"

#include <algorithm>
#include <vector>

#include "share.h"
#include "support.h"

namespace {

using namespace support;

tpa::FlatBox RandomBox(Random& random, double size) {
  tpa::FlatBox b{};
  for (int k = 0; k < 3; ++k) {
    b.low[k] = static_cast<float>(Uniform(random, -1, 1));
    b.high[k] = b.low[k] + static_cast<float>(Uniform(random, 0, size));
  }
  return b;
}

tpa::FlatBox Widened(tpa::FlatBox b, float by) {
  for (int k = 0; k < 3; ++k) b.low[k] -= by, b.high[k] += by;
  return b;
}

struct Boxes {
  Boxes(uint32_t count, double size, Random& random) {
    for (uint32_t i = 0; i < count; ++i) all.push_back(RandomBox(random, size));
    bounds = all[0];
    for (const tpa::FlatBox& box : all) bounds = tpa::united(bounds, box);
  }
  uint32_t count() const { return static_cast<uint32_t>(all.size()); }
  std::vector<tpa::FlatBox> all;
  tpa::FlatBox bounds;
};

// Of every size up to the most, flat ones and points too.
TEST(Slabs, WhatMeetsIsFound) {
  for (uint64_t seed = 1; seed <= Share(600u); ++seed) {
    Random random(seed);
    const double sizes[] = {.2, 1e-3, 0};
    const Boxes boxes(1 + static_cast<uint32_t>(random() % tpa::SlabSets::most), sizes[seed % 3], random);
    const tpa::SlabSets sets({const_cast<tpa::FlatBox*>(boxes.all.data()), boxes.count()}, boxes.bounds);
    ASSERT_EQ(sets.words, (boxes.count() + 63) / 64);
    // Bounds are rounded to the slabs that they lie in, of both boxes.
    const float slab = static_cast<float>(1 << sets.steps_of_slab) / sets.frame.steps;
    for (int i = 0; i < 20; ++i) {
      const tpa::FlatBox query = i % 2 == 0 ? RandomBox(random, .3) : boxes.all[random() % boxes.count()];
      uint64_t met[tpa::SlabSets::most / 64] = {};
      sets.meeting(query, met);
      const bool within = tpa::boxes_meet(boxes.bounds, query);  // of others less is known
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

// About as many slabs as boxes: of a grid of boxes hardly more are told than meet.
TEST(Slabs, AreAsShortAsTheBoxes) {
  std::vector<tpa::FlatBox> boxes;
  for (int i = 0; i < 256; ++i) {
    const float x = static_cast<float>(i % 16), y = static_cast<float>(i / 16);
    boxes.push_back({{x + .2f, y + .2f, 0}, {x + .8f, y + .8f, .1f}});
  }
  tpa::FlatBox bounds = boxes[0];
  for (const tpa::FlatBox& box : boxes) bounds = tpa::united(bounds, box);
  const tpa::SlabSets sets({boxes.data(), 256}, bounds);
  for (const tpa::FlatBox& query : boxes) {
    uint64_t met[4];
    sets.meeting(query, met);
    int count = 0;
    for (const uint64_t word : met) count += __builtin_popcountll(word);
    EXPECT_EQ(count, 1);
  }
}

}  // namespace
