// SPDX-License-Identifier: MIT
// The parents of vertices along the seams of an exact cut.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/resolve_trial.h"
#include "support/share.h"
#include "support/support.h"
#include "support/tangle_shapes.h"

namespace point_origins_test {
namespace {

using namespace support;

Point BlendOf(const tpa_vertex_origin& origin, const Mesh& m) {
  const double w = origin.parents[1] == TPA_NONE ? 1 : static_cast<double>(origin.weight);
  Point p = PositionOf(m, origin.parents[0]);
  for (size_t i = 0; i < 3; ++i)
    if (w < 1) p[i] = w * p[i] + (1 - w) * PositionOf(m, origin.parents[1])[i];
  return p;
}

double LongestEdge(const Mesh& m) {
  double longest = 0;
  for (size_t h = 0; h < m.triangles.size(); ++h)
    longest = std::max(longest,
                       Distance(PositionOf(m, m.triangles[h]), PositionOf(m, m.triangles[h % 3 == 2 ? h - 2 : h + 1])));
  return longest;
}

// Two convex bodies cross in one seam: each point of it is an edge of one through a face of the other. All parents are
// of the body with the lower faces, and the place that they tell is no farther than an edge.
TEST(PointOrigins, AreOnOneSideOfASeam) {
  int on_edges = 0, in_faces = 0;
  for (uint64_t seed = 1; seed <= Share<uint64_t>(100); ++seed) {
    Random random(seed);
    const Mesh first = RandomlyTurned(Sphere({0, 0, 0}, 1, 3), random);
    const Mesh second = RandomlyTurned(Sphere({0, 0, 0}, 1, 2 + static_cast<int>(seed % 4)), random);
    const Mesh m = Together({first, Translated(second, {Uniform(random, 0.5, 1.5), 0, 0})});
    const Arena arena(GenerousConfig(m), m);
    tpa_issue issue;
    ASSERT_EQ(tpa_adapt(*arena, nullptr, nullptr, &issue), TPA_OK) << Text(issue);
    const Mesh result = MeshOf(*arena);
    const double longest = LongestEdge(first);
    uint32_t v = 0;
    for (const tpa_vertex_origin& origin : VertexOriginsOf(*arena)) {
      const uint32_t number = v++;
      if (origin.parents[1] == TPA_NONE) continue;
      EXPECT_LT(origin.parents[0], VertexCount(first)) << "seed " << seed << ", vertex " << number;
      EXPECT_LT(origin.parents[1], VertexCount(first)) << "seed " << seed << ", vertex " << number;
      const double off = Distance(BlendOf(origin, m), PositionOf(result, number));
      EXPECT_LE(off, longest) << "seed " << seed << ", vertex " << number;
      ++(off < 1e-6 ? on_edges : in_faces);
    }
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(on_edges, Least(1000));
  EXPECT_GT(in_faces, Least(1000));
}

}  // namespace
}  // namespace point_origins_test
