// SPDX-License-Identifier: MIT
// Caps against all triangulations of small loops, and against a table of the least lengths for longer ones.
#include <limits>
#include <string>
#include <vector>

#include "support/candidates_support.h"
#include "support/share.h"

namespace cap_candidates_test {
namespace {

using namespace candidates_support;
using support::Least;
using support::Share;

// The least total chord length over all triangulations of vertices i .. j of a loop.
double LeastChords(const std::vector<Vec3>& p, size_t i, size_t j) {
  if (j - i < 2) return 0;
  double best = std::numeric_limits<double>::infinity();
  for (size_t k = i + 1; k < j; ++k) {
    double sum = LeastChords(p, i, k) + LeastChords(p, k, j);
    if (k - i > 1) sum += tpa::length(p[i] - p[k]);
    if (j - k > 1) sum += tpa::length(p[k] - p[j]);
    best = std::min(best, sum);
  }
  return best;
}

TEST(Candidates, TheFirstCapIsTheShortest) {
  for (unsigned seed = 1; seed <= Share(40u); ++seed) {
    Maker maker(seed);
    const int n = 3 + static_cast<int>(seed % 8);
    Search search(maker.Make({n}, all_positions[seed % 3]));
    Faces faces;
    ASSERT_TRUE(search.Next(faces));
    double loop = 0;
    const auto& p = search.points[0];
    for (size_t v = 0; v < p.size(); ++v) loop += 0.5 * tpa::length(p[v] - p[(v + 1) % p.size()]);
    EXPECT_NEAR(Length(search.points, faces) - loop, LeastChords(p, 0, p.size() - 1), 1e-9) << "seed " << seed;
  }
}

// The least total chord length over all triangulations of a loop with free faces only; endless without any.
double LeastFreeChords(const std::vector<Vec3>& p, const Hindrance& h) {
  const size_t n = p.size();
  std::vector<std::vector<double>> least(n, std::vector<double>(n, 0));
  for (size_t span = 2; span < n; ++span)
    for (size_t i = 0; i + span < n; ++i) {
      const size_t j = i + span;
      least[i][j] = std::numeric_limits<double>::infinity();
      for (size_t k = i + 1; k < j; ++k)
        if (IsFreeOf(h, i, k, j)) least[i][j] = std::min(least[i][j], least[i][k] + least[k][j]);
      if (span + 1 < n) least[i][j] += tpa::length(p[i] - p[j]);
    }
  return least[0][n - 1];
}

// Is the first cap of a loop of n vertices the shortest cap of free faces? False if no such cap exists.
bool ExpectShortestOfFree(int n, unsigned percent, unsigned seed) {
  SCOPED_TRACE(std::to_string(n) + " vertices, " + std::to_string(percent) + " %, seed " + std::to_string(seed));
  Hindrance h{percent};
  tpa::CandidateOptions options;
  options.filter = {AskHindrance, &h};
  Search search(Maker(seed).Make({n}, all_positions[seed % 3]), options);
  const double want = LeastFreeChords(search.points[0], h);
  Faces faces;
  const bool found = search.Next(faces);
  if (want == std::numeric_limits<double>::infinity()) {
    EXPECT_FALSE(found);
    return false;
  }
  EXPECT_TRUE(found);
  EXPECT_EQ(WhyNotConsistent(search.points, faces), "");
  for (const auto& f : faces) EXPECT_TRUE(IsFreeOf(h, f.v[0], f.v[1], f.v[2]));
  double loop = 0;
  const auto& p = search.points[0];
  for (size_t v = 0; v < p.size(); ++v) loop += 0.5 * tpa::length(p[v] - p[(v + 1) % p.size()]);
  EXPECT_NEAR(Length(search.points, faces) - loop, want, 1e-9 * want + 1e-9);
  if (percent == 0) {
    EXPECT_EQ(h.asked, p.size() - 2);
  }
  return true;
}

// Hindrances show up by questions about the best caps so far.
TEST(Candidates, TheFirstCapIsTheShortestOfFreeFaces) {
  int some = 0, none = 0;
  for (int n : {5, 8, 12, 30, 60})
    for (unsigned percent : {0u, 10u, 40u, 70u, 90u})
      for (unsigned seed = 1; seed <= Share(6u); ++seed) ++(ExpectShortestOfFree(n, percent, seed) ? some : none);
  EXPECT_GT(some, Least(60));
  EXPECT_GT(none, Least(5));
}

// The same for loops too long to remember all faces, with moderately many hindrances.
TEST(Candidates, TheFirstCapOfALongLoopIsTheShortestOfFreeFaces) {
  for (int n : {97, 120, 150})
    for (unsigned percent : {0u, 5u, 20u})
      for (unsigned seed = 1; seed <= 3; ++seed) EXPECT_TRUE(ExpectShortestOfFree(n, percent, seed));
}

// If the table is full before a cap of free faces is found, there is none.
TEST(Candidates, ALongLoopIsAskedAboutSoOftenOnly) {
  Hindrance h{95};
  tpa::CandidateOptions options;
  options.filter = {AskHindrance, &h};
  Search search(Maker(1).Make({150}, Positions::random), options);
  Faces faces;
  EXPECT_FALSE(search.Next(faces));
  EXPECT_LE(h.asked, 3u * tpa::disc_table_slots / 4 + 1);
}

}  // namespace
}  // namespace cap_candidates_test
