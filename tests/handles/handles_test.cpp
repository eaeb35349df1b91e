// SPDX-License-Identifier: MIT
// The handle database: the counts of docs/handles.md, the handles printed in the paper, sides in any order, and
// refused input. homology_test and minimality_test prove the stored handles of all keys.
#include "handles/handles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/handle_support.h"

namespace handles_test {
namespace {

using handle_support::Expand;
using handle_support::Face;
using handle_support::GetGenerator;
using handle_support::Handle;
using handle_support::Key;
using handle_support::Name;
using handle_support::Print;
using handle_support::Sides;
using handle_support::WhyNotSphere;

TEST(Handles, CountsAreThoseOfTheDocumentation) {
  const std::vector<std::pair<Sides, tpa::u64>> known = {
      {{3, 3}, 3},      {{4, 3}, 12},     {{4, 4}, 4},      {{5, 4}, 20},     {{3, 3, 3}, 54},     {{4, 3, 3}, 72},
      {{4, 4, 4}, 128}, {{5, 3, 3}, 450}, {{5, 4, 3}, 120}, {{5, 5, 5}, 250}, {{3, 3, 3, 3}, 324},
  };
  for (const auto& [sides, count] : known) {
    EXPECT_EQ(tpa::handle_count(Key(sides)), count) << Name(sides);
    EXPECT_TRUE(tpa::key_is_complete(Key(sides))) << Name(sides);
    EXPECT_EQ(Expand(Key(sides)).size(), count) << Name(sides);
  }
}

TEST(Handles, ThePaperPrintsTwoOfThem) {
  // Section 4.2; faces with their corners sorted, so orientation is compared after sorting as well.
  const Handle printed = {{1, 2, 11}, {1, 5, 12}, {1, 11, 12}, {2, 3, 8}, {2, 8, 10}, {2, 10, 11}, {3, 4, 7},
                          {3, 7, 8},  {4, 5, 6},  {4, 6, 7},   {5, 6, 9}, {5, 9, 12}, {8, 9, 10},  {9, 10, 12}};
  const Handle twin = {{5, 1, 11}, {5, 4, 12}, {5, 11, 12}, {1, 2, 8}, {1, 8, 10}, {1, 10, 11}, {2, 3, 7},
                       {2, 7, 8},  {3, 4, 6},  {3, 6, 7},   {4, 6, 9}, {4, 9, 12}, {8, 9, 10},  {9, 10, 12}};
  const auto unoriented = [](Handle h, int base) {
    for (Face& f : h) {
      for (int& v : f) v -= base;
      std::sort(f.begin(), f.end());
    }
    std::sort(h.begin(), h.end());
    return h;
  };
  std::set<Handle> stored;
  for (const Handle& h : Expand(Key({5, 4, 3}))) stored.insert(unoriented(h, 0));
  EXPECT_EQ(stored.size(), 120u);
  EXPECT_TRUE(stored.count(unoriented(printed, 1)));
  EXPECT_TRUE(stored.count(unoriented(twin, 1)));
}

// Equivalent handles have equal codes, whatever the numbers of their polygons.
std::set<std::vector<uint8_t>> Codes(const Sides& sides) {
  std::set<std::vector<uint8_t>> codes;
  for (tpa::u32 g = 0; g < tpa::generator_count(Key(sides)); ++g)
    codes.insert(handle_support::SymmetryOf(GetGenerator(Key(sides), g), sides).code);
  return codes;
}

TEST(Handles, SidesComeInAnyOrder) {
  for (const Sides& sides : std::vector<Sides>{{3, 5}, {3, 4, 5}, {3, 5, 4}, {4, 3, 3, 5}, {4, 5, 3, 6}}) {
    const tpa::HandleKey key = Key(sides);
    Sides sorted = sides;
    std::sort(sorted.rbegin(), sorted.rend());
    EXPECT_EQ(tpa::handle_count(key), tpa::handle_count(Key(sorted)));
    EXPECT_TRUE(Codes(sides) == Codes(sorted)) << Name(sides);
    for (const Handle& h : Expand(key)) ASSERT_EQ(WhyNotSphere(h, sides), "") << Name(sides) << Print(h);
  }
}

TEST(Handles, RefusesWhatItDoesNotHave) {
  const tpa::HandleKey key = Key({5, 4, 3});
  std::vector<tpa::FaceCorners> faces(14);
  EXPECT_FALSE(tpa::handle_get(key, 120, {faces.data(), 14}));
  EXPECT_FALSE(tpa::handle_get(key, 0, {faces.data(), 13}));
  EXPECT_FALSE(tpa::generator_get(key, 2, {faces.data(), 14}));
}

}  // namespace
}  // namespace handles_test
