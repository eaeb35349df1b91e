// SPDX-License-Identifier: MIT
// Candidates against independent oracles: a check of every promise of a handle, and all stored handles of small keys.
#include <algorithm>
#include <string>
#include <vector>

#include "handles/handle_table.h"
#include "support/candidates_support.h"
#include "support/share.h"
#include "triangulate/minimum_triangulation.h"
#include "triangulate/strips_in_order.h"

namespace candidates_test {
namespace {

using namespace candidates_support;
using support::Least;
using support::Share;

// Three or more loops beside each other in a plane may leave no handle through a tree.
bool MayHaveNone(const std::vector<int>& sides) {
  return sides.size() > 4 || (sides.size() > 2 && *std::max_element(sides.begin(), sides.end()) > 15);
}

TEST(Candidates, AreAllConsistentAndDifferent) {
  int none = 0, all = 0;
  for (unsigned seed = 1; seed <= Share(150u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Maker maker(seed);
    std::vector<int> sides(1 + maker.engine() % 6);
    for (int& side : sides) side = 3 + static_cast<int>(maker.engine() % (seed % 10 == 0 ? 40 : 13));
    Search search(maker.Make(sides, all_positions[seed % 3]));
    Faces faces;
    std::vector<std::vector<std::vector<tpa::u32>>> seen;
    while (search.Next(faces)) {
      ASSERT_EQ(WhyNotConsistent(search.points, faces), "") << "candidate " << seen.size();
      std::vector<std::vector<tpa::u32>> set;
      for (const auto& f : faces) {
        std::vector<tpa::u32> v(f.v, f.v + 3);
        std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
        set.push_back(v);
      }
      std::sort(set.begin(), set.end());
      EXPECT_EQ(std::count(seen.begin(), seen.end(), set), 0);
      seen.push_back(set);
    }
    none += seen.empty() ? 1 : 0, ++all;
    EXPECT_TRUE(!seen.empty() || MayHaveNone(sides));
    EXPECT_LE(seen.size(), 64u);
  }
  EXPECT_LE(none, all / 3);
}

int CountConsistent(const std::vector<int>& sides, Positions positions) {
  SCOPED_TRACE(std::to_string(sides.size()) + " loops, the first of " + std::to_string(sides[0]));
  Maker maker(7);
  tpa::CandidateOptions options;
  options.max_candidates = 12;
  Search search(maker.Make(sides, positions), options);
  Faces faces;
  int count = 0;
  for (; search.Next(faces); ++count) EXPECT_EQ(WhyNotConsistent(search.points, faces), "") << count;
  return count;
}

TEST(Candidates, ManyAndLongLoops) {
  const std::vector<std::vector<int>> cases = {{384},
                                               {65},
                                               {191, 191},
                                               {379, 3},
                                               {3, 200},
                                               {90, 80},
                                               {200, 100, 3},
                                               {16, 16, 16, 16},
                                               {3, 3, 3, 3, 3},
                                               std::vector<int>(12, 5),
                                               std::vector<int>(16, 22)};
  int of_several = 0;
  for (const auto& sides : cases)
    for (Positions positions : all_positions) {
      const int count = CountConsistent(sides, positions);
      EXPECT_TRUE(count > 0 || MayHaveNone(sides)) << sides.size() << ' ' << sides[0];
      of_several += MayHaveNone(sides) ? count : 0;
    }
  EXPECT_GT(of_several, 0);
}

// The exact cut closes what is longer.
TEST(Candidates, LoopsTooLongOrTooManyHaveNone) {
  const std::vector<std::vector<int>> cases = {{385},
                                               {192, 191},
                                               {1000, 3},
                                               {200, 178, 3},
                                               {4000, 3000, 20},
                                               std::vector<int>(12, 200),
                                               std::vector<int>(17, 5)};
  std::vector<tpa::u64> scratch(1 << 20);
  for (const auto& sides : cases) {
    std::vector<tpa::Loop> loops;
    for (int n : sides) loops.push_back({nullptr, static_cast<tpa::u32>(n)});
    tpa::CandidateSearch search;
    EXPECT_FALSE(tpa::begin(search, {loops.data(), static_cast<tpa::u32>(loops.size())},
                            {reinterpret_cast<tpa::u8*>(scratch.data()), 8u << 20}, {}));
  }
}

TEST(Candidates, LongHandlesAndCapsHaveFreeFacesWhereTheyCan) {
  int found = 0;
  for (const auto& sides : std::vector<std::vector<int>>{{20}, {17, 16, 20}, {5, 4, 5, 6, 5}})
    for (unsigned seed = 1; seed <= Share(10u); ++seed) {
      tpa::CandidateOptions options;
      options.filter.ask = IsFree;
      Search search(Maker(seed).Make(sides, Positions::random), options);
      Faces faces;
      if (!search.Next(faces)) continue;  // a tree may leave none that is free, or none without an edge twice
      EXPECT_EQ(WhyNotConsistent(search.points, faces), "");
      EXPECT_TRUE(AreFree(faces));
      ++found;
    }
  EXPECT_GE(found, Least(15));
}

TEST(Candidates, LongHandlesOfTwoLoopsHaveFreeFacesOnly) {
  int given = 0;
  for (const auto& sides : std::vector<std::vector<int>>{{20, 17}, {16, 3}, {48, 48}})
    for (unsigned seed = 1; seed <= Share(6u); ++seed) {
      SCOPED_TRACE("loops of " + std::to_string(sides[0]) + " and " + std::to_string(sides[1]) + ", seed " +
                   std::to_string(seed));
      tpa::CandidateOptions options;
      options.filter.ask = IsFree;
      Search search(Maker(seed).Make(sides, all_positions[seed % 3]), options);
      for (Faces faces; search.Next(faces); ++given) EXPECT_TRUE(AreFree(faces)) << "number " << search.search.given;
    }
  EXPECT_GT(given, Least(100));
}

TEST(Candidates, StoredHandlesComeInOrderOfLength) {
  const std::vector<std::vector<int>> keys = {{3, 3},       {4, 3},       {5, 4},       {3, 7},
                                              {3, 3, 3},    {3, 5, 4},    {5, 3, 3},    {6, 4, 4},
                                              {3, 3, 3, 3}, {4, 3, 3, 4}, {4, 3, 3, 3}, {5, 4, 4, 3}};
  unsigned seed = 0;
  for (const auto& sides : keys)
    for (Positions positions : all_positions) {
      SCOPED_TRACE("seed " + std::to_string(++seed) + ", " + std::to_string(sides.size()) + " loops");
      Maker maker(seed);
      Search search(maker.Make(sides, positions));
      tpa::HandleKey key;
      key.k = static_cast<tpa::u32>(sides.size());
      for (size_t i = 0; i < sides.size(); ++i) key.sides[i] = static_cast<tpa::u32>(sides[i]);
      std::vector<double> lengths;
      Faces faces(tpa::handle_face_count(key));
      for (tpa::u64 i = 0; i < tpa::handle_count(key); ++i) {
        ASSERT_TRUE(tpa::handle_get(key, i, {faces.data(), static_cast<tpa::u32>(faces.size())}));
        lengths.push_back(Length(search.points, faces));
      }
      std::sort(lengths.begin(), lengths.end());
      const size_t stored = std::min<size_t>(lengths.size(), 48);
      for (size_t i = 0; i < stored; ++i) {
        ASSERT_TRUE(search.Next(faces));
        EXPECT_NEAR(Length(search.points, faces), lengths[i], 1e-9) << "candidate " << i;
      }
    }
}

// A search with less room than all strips want would give other candidates.
TEST(Candidates, RoomOfADiscHoldsAllStripsBetweenTwoLoops) {
  using namespace tpa;
  std::vector<double> room(filtered_disc_scratch_bytes(longest_disc) / sizeof(double));
  for (u32 p = shortest_polygon; has_candidates(p + shortest_polygon, 2); ++p)
    for (u32 q = shortest_polygon; has_candidates(p + q, 2); ++q) {
      const u64 bytes = filtered_disc_scratch_bytes(std::min(p + q + 4, longest_disc));
      StripOrder strips;
      ASSERT_TRUE(lay_out_strip_order(p, q, most_candidates, reinterpret_cast<u8*>(room.data()), bytes, strips));
      ASSERT_EQ(strips.best.at.size, most_candidates) << p << " and " << q << " vertices";
    }
}

TEST(Candidates, RefusesWhatCannotBe) {
  Maker maker(1);
  const Loops points = maker.Make({3, 4}, Positions::random);
  std::vector<tpa::Loop> loops = {{points[0].data(), 3}, {points[1].data(), 4}};
  std::vector<tpa::u64> scratch(tpa::candidate_scratch_bytes(7, 2) / 8);
  const tpa::Span<tpa::u8> room{reinterpret_cast<tpa::u8*>(scratch.data()), static_cast<tpa::u32>(8 * scratch.size())};
  tpa::CandidateSearch search;
  EXPECT_TRUE(tpa::begin(search, {loops.data(), 2}, room, {}));
  EXPECT_FALSE(tpa::begin(search, {loops.data(), 0}, room, {}));
  EXPECT_FALSE(tpa::begin(search, {loops.data(), 2}, room.part(0, room.size - 8), {}));
  loops[0].count = 2;
  EXPECT_FALSE(tpa::begin(search, {loops.data(), 2}, room, {}));
}

}  // namespace
}  // namespace candidates_test
