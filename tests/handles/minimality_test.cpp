// SPDX-License-Identifier: MIT
// The stored handles obey the rule: least sum of squares among all consistent handles without chords, all of them or
// the 32 most even. An independent count (handle_oracle), checked by brute force, agrees.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "oracle/handle_oracle.h"
#include "support/handle_support.h"

namespace minimality_test {
namespace {

using handle_oracle::Family;
using handle_oracle::Minimum;
using handle_oracle::Plan;
using handle_support::Handle;
using handle_support::Name;
using handle_support::Sides;

const std::vector<Plan>& PlansOf(const Sides& sides) {
  static const std::array<std::vector<Plan>, 5> plans = {
      {{}, {}, {}, handle_oracle::PlansOf(3), handle_oracle::PlansOf(4)}};
  return plans[sides.size()];
}

// ---------------------------------------------------------------- the oracle itself

// Labelled handles without chords by excess.
std::vector<uint64_t> CountsUpTo(const Sides& sides, int budget) {
  if (sides.size() == 2) return handle_oracle::PairsUpTo(sides, budget);
  std::vector<uint64_t> counts(static_cast<size_t>(budget) + 1);
  for (const Family& family : handle_oracle::FamiliesUpTo(PlansOf(sides), sides, budget))
    for (size_t e = 0; e < counts.size(); ++e) counts[e] += family.shapes[e] * handle_oracle::Rotations(sides);
  return counts;
}

std::vector<uint64_t> BruteForceUpTo(const Sides& sides, int budget) {
  handle_support::AdvancingFront front(sides, handle_oracle::SumOfSquares(sides, budget));
  front.Run();
  std::vector<uint64_t> counts(static_cast<size_t>(budget) + 1);
  for (const Handle& h : front.found) {
    if (handle_support::HasChord(h, sides)) continue;
    const int sum = handle_support::SumOfSquares(h, handle_support::Mu(sides));
    ++counts[static_cast<size_t>((sum - handle_oracle::SumOfSquares(sides, 0)) / 2)];
  }
  return counts;
}

TEST(OracleLong, AgreesWithBruteForceBeyondTheMinimum) {
  std::vector<std::pair<Sides, int>> keys = {{{3, 3, 3}, 5}, {{4, 3, 3}, 2}};
  for (const Sides& sides : handle_support::Keys(2, 9, 6)) keys.push_back({sides, 30});
  for (const auto& [sides, budget] : keys)
    EXPECT_EQ(CountsUpTo(sides, budget), BruteForceUpTo(sides, budget)) << Name(sides);
}

void CheckByBruteForce(const Sides& sides) {
  const int least = handle_oracle::MinimumOf(PlansOf(sides), sides).excess;
  EXPECT_EQ(CountsUpTo(sides, least), BruteForceUpTo(sides, least)) << Name(sides);
}

TEST(OracleLong, AgreesWithBruteForceOnTriples) {
  const std::vector<Sides> keys = {{4, 4, 3}, {5, 3, 3}, {5, 4, 3}, {4, 4, 4}};
  for (const Sides& sides : keys) CheckByBruteForce(sides);
}
TEST(OracleLong, AgreesWithBruteForceOnQuadruples) { CheckByBruteForce({3, 3, 3, 3}); }

TEST(Oracle, CountsAllHandlesWithoutChords) {
  const auto total = [](const Sides& sides) {
    uint64_t sum = 0;
    for (uint64_t count : CountsUpTo(sides, handle_oracle::max_excess)) sum += count;
    return sum;
  };
  EXPECT_EQ(total({5, 4, 3}), 465900u);
}

// A listing leaves consistency to the criterion; the count has its own reasons, all of which matter with much excess.
TEST(OracleLong, ListsAsManyShapesAsItCounts) {
  const std::vector<std::pair<Sides, int>> keys = {
      {{3, 3, 3, 3}, 16}, {{3, 3, 3}, 40}, {{6, 3, 3}, 8}, {{4, 3, 3, 3}, 4}, {{6, 5, 4, 3}, 2}};
  for (const auto& [sides, budget] : keys) {
    for (const Family& family : handle_oracle::FamiliesUpTo(PlansOf(sides), sides, budget)) {
      std::vector<uint64_t> listed(family.shapes.size());
      handle_oracle::ListShapes(family, sides, budget, [&, &at = sides](const Handle& h) {
        const int sum = handle_support::SumOfSquares(h, handle_support::Mu(at));
        ++listed[static_cast<size_t>((sum - handle_oracle::SumOfSquares(at, 0)) / 2)];
      });
      ASSERT_EQ(listed, family.shapes) << Name(sides);
    }
  }
}

TEST(Oracle, CountsAreThoseOfTheDocumentation) {
  const std::vector<std::pair<Sides, uint64_t>> known = {
      {{3, 3}, 3},      {{4, 3}, 12},     {{4, 4}, 4},      {{5, 4}, 20},     {{3, 3, 3}, 54},     {{4, 3, 3}, 72},
      {{4, 4, 4}, 128}, {{5, 3, 3}, 450}, {{5, 4, 3}, 120}, {{5, 5, 5}, 250}, {{3, 3, 3, 3}, 324},
  };
  for (const auto& [sides, count] : known)
    EXPECT_EQ(handle_oracle::MinimumOf(PlansOf(sides), sides).handles, count) << Name(sides);
}

// ---------------------------------------------------------------- the database

constexpr size_t most_stored = 32;

// Order: plans in a row after others, uneven after even.
using Evenness = std::pair<bool, int>;

// Orbits of least sum of squares, the most even first, until the database cannot store more.
std::map<std::vector<uint8_t>, Evenness> MostEvenOrbits(const Minimum& minimum, const Sides& sides) {
  std::map<Evenness, std::vector<const Family*>> by_evenness;
  for (const Family& family : minimum.families)
    by_evenness[{family.plan->row, handle_oracle::Unevenness(family.lengths)}].push_back(&family);
  std::map<std::vector<uint8_t>, Evenness> orbits;
  for (const auto& [evenness, families] : by_evenness) {
    for (const Family* family : families)
      handle_oracle::ListShapes(*family, sides, minimum.excess, [&, at = evenness](const Handle& h) {
        orbits.emplace(handle_support::SymmetryOf(h, sides).code, at);
      });
    if (orbits.size() > most_stored) break;
  }
  return orbits;
}

// The stored generators obey the rule, and are as even as the first 32 orbits.
void CheckMostEven(const std::vector<Handle>& stored, const Minimum& minimum, const Sides& sides) {
  const auto orbits = MostEvenOrbits(minimum, sides);
  ASSERT_GT(orbits.size(), most_stored) << Name(sides) << " has no more and is complete";
  ASSERT_EQ(stored.size(), most_stored) << Name(sides);
  std::vector<Evenness> wanted, found;
  for (const auto& [code, evenness] : orbits) wanted.push_back(evenness);
  std::sort(wanted.begin(), wanted.end());
  wanted.resize(most_stored);
  for (const Handle& h : stored) {
    const auto orbit = orbits.find(handle_support::SymmetryOf(h, sides).code);
    ASSERT_TRUE(orbit != orbits.end()) << Name(sides) << " stores one that is not among the most even";
    found.push_back(orbit->second);
  }
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, wanted) << Name(sides);
}

void CheckKey(const Sides& sides) {
  const tpa::HandleKey key = handle_support::Key(sides);
  const Minimum minimum = handle_oracle::MinimumOf(PlansOf(sides), sides);
  std::vector<Handle> stored;
  std::set<std::vector<uint8_t>> codes;
  for (tpa::u32 g = 0; g < tpa::generator_count(key); ++g) {
    stored.push_back(handle_support::GetGenerator(key, g));
    ASSERT_EQ(handle_support::SumOfSquares(stored.back(), handle_support::Mu(sides)),
              handle_oracle::SumOfSquares(sides, minimum.excess))
        << Name(sides) << " generator " << g;
    EXPECT_TRUE(codes.insert(handle_support::SymmetryOf(stored.back(), sides).code).second)
        << Name(sides) << " generator " << g << " is equivalent to one before";
  }
  // Distinct ones of the least sum, as many as there are: all of them.
  if (tpa::key_is_complete(key))
    EXPECT_EQ(tpa::handle_count(key), minimum.handles) << Name(sides);
  else
    CheckMostEven(stored, minimum, sides);
}

void CheckKeys(int k, size_t part, size_t parts) {
  for (const Sides& sides : handle_support::PortionOfKeys(k, part, parts)) CheckKey(sides);
}

TEST(Minimality, Pairs) { CheckKeys(2, 0, 1); }
TEST(Minimality, Triples) { CheckKeys(3, 0, 1); }
TEST(Minimality, Quadruples1) { CheckKeys(4, 0, 4); }
TEST(Minimality, Quadruples2) { CheckKeys(4, 1, 4); }
TEST(Minimality, Quadruples3) { CheckKeys(4, 2, 4); }
TEST(Minimality, Quadruples4) { CheckKeys(4, 3, 4); }

}  // namespace
}  // namespace minimality_test
