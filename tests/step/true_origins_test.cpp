// SPDX-License-Identifier: MIT
// Origins made false by hand: found again near by, or called untrue where nothing near by tells.
#include "results/true_origins.h"

#include "support/support.h"
#include "support/transaction.h"

namespace true_origins_test {
namespace {

using namespace support;

struct Scene {
  Mesh m = Together({Sphere({0, 0, 0}, 1, 3), Sphere({50, 0, 0}, 1, 3)});
  uint32_t half = VertexCount(m) / 2;
  Arena arena{ConfigFor(m), m};
  Transaction t{*arena};
  tpa::VertexOrigin* origins = t.w.edit.mesh.vertex_origin;

  void Claim(uint32_t v, uint32_t a, uint32_t b) {
    tpa::touch_vertex(t.w.edit, v);
    origins[v] = {{a, b}, 0.5f};
  }
};

TEST(TrueOrigins, TakeThoseOfANeighbour) {
  Scene s;
  s.Claim(0, s.half, s.half + 1);  // of the other body
  tpa::find_true_origins(s.t.w);
  EXPECT_FALSE(tpa::is_untrue(s.origins[0]));
  // The neighbours are old, and the nearest of them is the nearest origin.
  uint32_t nearest = 1;
  const Point p = PositionOf(s.m, 0);
  for (uint32_t v = 1; v < s.half; ++v)
    if (Distance(PositionOf(s.m, v), p) < Distance(PositionOf(s.m, nearest), p)) nearest = v;
  EXPECT_EQ(Distance(PositionOf(s.m, s.origins[0].parents[0]), p), Distance(PositionOf(s.m, nearest), p));
  EXPECT_EQ(s.origins[0].parents[0], s.origins[0].parents[1]);
  EXPECT_EQ(s.origins[0].weight, 1.0f);
}

TEST(TrueOrigins, SayWhereNothingNearIsKnown) {
  Scene s;
  for (uint32_t v = 0; v < s.half; ++v) s.Claim(v, s.half + v, s.half + (v + 1) % s.half);
  tpa::find_true_origins(s.t.w);
  for (uint32_t v = 0; v < s.half; ++v) {
    EXPECT_TRUE(tpa::is_untrue(s.origins[v])) << v;
    EXPECT_GE(s.origins[v].parents[0], s.half);
    EXPECT_LT(s.origins[v].parents[0], 2 * s.half);
  }
}

TEST(TrueOrigins, HaveTheWeightOfTheNearestPoint) {
  Scene s;
  const tpa::Mesh& m = s.t.w.edit.mesh;
  const uint32_t a = tpa::head(m, m.vertex_edge[0]), b = tpa::apex(m, m.vertex_edge[0]);
  tpa::set_position(s.t.w.edit, 0, 0.25 * m.position[a] + 0.75 * m.position[b]);
  s.Claim(0, a, b);
  tpa::find_true_origins(s.t.w);
  EXPECT_EQ(s.origins[0].parents[0], a);
  EXPECT_EQ(s.origins[0].parents[1], b);
  EXPECT_NEAR(s.origins[0].weight, 0.25f, 1e-6f);
}

// In a step parents count at the targets that they have taken.
TEST(TrueOrigins, CountFromTargetsTaken) {
  Scene s;
  const tpa::Mesh& m = s.t.w.edit.mesh;
  const uint32_t a = tpa::head(m, m.vertex_edge[0]);
  s.t.w.target[a] = m.position[0];
  tpa::set_state(s.t.w, a, tpa::target_state, tpa::target_taken);
  s.Claim(0, s.half, s.half);
  tpa::find_true_origins(s.t.w);
  EXPECT_EQ(s.origins[0].parents[0], a);
  s.t.w.marks[a] = 0;
}

}  // namespace
}  // namespace true_origins_test
