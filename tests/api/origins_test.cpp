// SPDX-License-Identifier: MIT
// The origins of new vertices against positions of before, kept by the test.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "oracle/commit_oracle.h"
#include "support/random_commits.h"
#include "support/share.h"

namespace origins_test {
namespace {

using namespace support;

// Where an old vertex was when the work began: a step moves vertices to their targets first. Removed
// vertices may have been rolled back or not, so both places count.
struct Places {
  const RandomCommit& commit;
  std::vector<uint32_t> old_to_new;
  std::set<uint32_t> rolled_back;

  std::vector<Point> Of(uint32_t id) const {
    const Point from = PositionOf(commit.before, id), to = PositionOf(commit.targets, id);
    const uint32_t now = old_to_new[id];
    if (now == TPA_NONE) return {from, to};
    return {rolled_back.count(now) != 0 ? from : to};
  }
};

struct Figures {
  std::map<std::string, size_t> made, near, old;  // by kind of commit; near: within a quarter of the bound
  size_t untrue = 0;
};

// In lengths of the bound.
double OffOf(const Places& places, const tpa_vertex_origin& o, const Point& p, double longest_edge) {
  double least = HUGE_VAL;
  for (const Point& a : places.Of(o.parents[0]))
    for (const Point& b : places.Of(o.parents[1]))
      least = std::min(least, OffOrigin(a, b, static_cast<double>(o.weight), p, longest_edge));
  return least;
}

void Judge(tpa_context* context, const RandomCommit& commit, Figures& figures) {
  const Mesh after = MeshOf(context);
  const std::vector<tpa_vertex_origin> origins = VertexOriginsOf(context);
  const uint32_t* list = nullptr;
  uint32_t count = 0;
  ASSERT_EQ(tpa_rolled_back(context, &list, &count), TPA_OK);
  const Places places{commit, OldToNewOf(context), {list, list + count}};
  const std::vector<double> longest = LongestEdges(after);
  for (uint32_t v = 0; v < origins.size(); ++v) {
    const tpa_vertex_origin& o = origins[v];
    ASSERT_LT(o.parents[0], VertexCount(commit.before));
    if (o.parents[1] == TPA_NONE) {
      // Cuts and smoothing move it by less than an edge: so it has arrived, or is named among those held back.
      if (commit.kind == "step" || commit.kind == "adapt") {
        ASSERT_LE(Distance(places.Of(o.parents[0])[0], PositionOf(after, v)), longest[v])
            << commit.kind << ", vertex " << v;
        ++figures.old[commit.kind];
      }
      continue;
    }
    ASSERT_LT(o.parents[1], VertexCount(commit.before));
    ++figures.made[commit.kind];
    if (o.parents[0] == o.parents[1] && o.weight == 0.0f) {
      ++figures.untrue;
      continue;
    }
    const double off = OffOf(places, o, PositionOf(after, v), longest[v]);
    ASSERT_LE(off, 1 + 1e-9) << commit.kind << ", vertex " << v;
    figures.near[commit.kind] += off <= .25 ? 1u : 0u;
  }
}

TEST(Origins, AreAsNearAsTheHeaderSays) {
  Figures figures;
  for (uint64_t seed = 1; seed <= Share(25u); ++seed)
    PlayRandomCommits(seed, 8, [&](tpa_context* context, const RandomCommit& c) { Judge(context, c, figures); });
  for (const auto& [kind, made] : figures.made) {
    RecordProperty(kind, std::to_string(made) + " made, " + std::to_string(figures.near[kind]) + " near");
    EXPECT_GT(figures.near[kind], made * 3 / 4) << kind;
  }
  EXPECT_GT(figures.old["step"], Least(1000u));
  EXPECT_GT(figures.made["step"], Least(1000u));
  EXPECT_GT(figures.made["adapt"], Least(1000u));
  EXPECT_GT(figures.made["remesh"], Least(1000u));
  EXPECT_LT(1000 * figures.untrue, figures.made["step"]);
}

// Positions as attributes come back as positions, of new vertices to the bound and the rounding to floats.
TEST(Origins, PositionsAreCarriedToPositions) {
  size_t made = 0;
  for (uint64_t seed = 101; seed <= 100 + Share(10u); ++seed)
    PlayRandomCommits(seed, 6, [&](tpa_context* context, const RandomCommit& commit) {
      const Mesh after = MeshOf(context);
      const Mesh& start = commit.targets;
      const std::vector<float> before(start.positions.begin(), start.positions.end());
      std::vector<float> now(after.positions.size());
      ASSERT_EQ(tpa_carry_vertices(context, before.data(), 3, now.data()), TPA_OK);
      const uint32_t* list = nullptr;
      uint32_t rolled_back = 0;
      ASSERT_EQ(tpa_rolled_back(context, &list, &rolled_back), TPA_OK);
      if (rolled_back > 0) return;  // parents are at their targets otherwise
      const std::vector<double> longest = LongestEdges(after);
      const std::vector<tpa_vertex_origin> origins = VertexOriginsOf(context);
      for (uint32_t v = 0; v < origins.size(); ++v) {
        const tpa_vertex_origin& o = origins[v];
        if (o.parents[1] == TPA_NONE || (o.parents[0] == o.parents[1] && o.weight == 0.0f)) continue;
        ++made;
        const Point carried{now[3 * v], now[3 * v + 1], now[3 * v + 2]};
        const double apart = Distance(PositionOf(start, o.parents[0]), PositionOf(start, o.parents[1]));
        ASSERT_LE(Distance(carried, PositionOf(after, v)), std::max(longest[v], apart) + 1e-5) << commit.kind;
      }
    });
  EXPECT_GT(made, Least(1000u));
}

}  // namespace
}  // namespace origins_test
