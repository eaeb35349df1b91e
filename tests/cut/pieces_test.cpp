// SPDX-License-Identifier: MIT
// Two loops round one cluster: a band or two caps, against the volumes of frusta.
#include "cut/pieces.h"

#include "support/cut_workbench.h"
#include "support/share.h"
#include "support/support.h"
#include "support/tangle_shapes.h"
#include "tool/scenes/elementary.h"

namespace pieces_test {
namespace {

using namespace support;

constexpr int sides = 12;

// A tube along z with rings at these heights and radii, closed by fans.
Mesh TubeOf(const std::vector<double>& heights, const std::vector<double>& radii) {
  std::vector<Point> points;
  for (double z : heights) points.push_back({0, 0, z});
  return Tube(points, radii, sides, {1, 0, 0});
}

struct Pieces {
  bool told;
  size_t count;
};

// The ring of vertices in the middle of five is the cluster. The loops begin anywhere, and the tube lies anyhow.
Pieces PiecesOfMiddle(const Mesh& upright, Random& random) {
  const Mesh m = Renumbered(upright, random);
  std::set<uint32_t> ring;
  for (uint32_t v = 0; v < VertexCount(m); ++v)
    if (std::fabs(PositionOf(m, v)[2] - 2) < .5) ring.insert(v);
  EXPECT_EQ(ring.size(), size_t{sides});
  Workbench b(RandomlyTurned(m, random), ring);
  EXPECT_EQ(b.r.loops.size, 2u);
  for (tpa::CutLoop& loop : b.r.loops) {
    loop.cluster = tpa::find_cluster(b.r, loop.cluster);
    loop.group = 0;
  }
  std::vector<double> cone(VertexCount(m));
  const bool told = tpa::form_pieces(b.e.mesh, b.r, cone.data());
  return {told, b.r.pieces.size};
}

// The middle ring has `waist` times the radius of its neighbours, less than nothing if turned inside out. Beside a
// cylinder of volume 1, the double frustum has (1 + waist + waist^2) / 3: caps take it away, a band fills it up. Rings
// of equal polygons have these volumes to rounding, so every second waist lies about where both cost the same.
TEST(Pieces, OfARingFollowTheVolume) {
  Random random(1);
  int joined = 0, capped = 0;
  for (int trial = 0; trial < Share(400); ++trial) {
    constexpr double as_dear = 0.4819805;  // by_caps = 4 / 7
    const double waist = trial % 2 == 0 ? Uniform(random, -1, 1.4) : as_dear + Uniform(random, -0.02, 0.02);
    const double by_caps = (1 + waist + waist * waist) / 3, by_band = std::fabs(1 - by_caps);
    if (std::fabs(by_band - 0.75 * by_caps) < 1e-6) continue;
    const Pieces pieces = PiecesOfMiddle(TubeOf({0, 1, 2, 3, 4}, {1, 1, waist, 1, 1}), random);
    const bool wants_band = by_band < 0.75 * by_caps;
    EXPECT_TRUE(pieces.told);
    EXPECT_EQ(pieces.count, wants_band ? 1u : 2u) << "waist " << waist;
    ++(wants_band ? joined : capped);
  }
  EXPECT_GT(joined, Least(50));
  EXPECT_GT(capped, Least(50));
}

// A tube squeezed until its rims are narrow: a rectangle eight times as long as wide is the limit, and an ellipse of
// axes a and b encloses pi a b within pi (3 (a + b) - sqrt((3 a + b) (a + 3 b))) (Ramanujan 1914).
TEST(Pieces, OfNarrowRimsAreLeftToTheExactCut) {
  Random random(2);
  int told = 0, left = 0;
  for (int trial = 0; trial < Share(200); ++trial) {
    const double a = Uniform(random, 1, 20), around = pi * (3 * (a + 1) - std::sqrt((3 * a + 1) * (a + 3)));
    const double share = around * around / (pi * a) / (18. * 18 / 8);
    if (std::fabs(share - 1) < .2) continue;
    const Mesh tube = Mapped(TubeOf({0, 1, 2, 3, 4}, {1, 1, Uniform(random, -1, 1), 1, 1}), [&](const Point& p) {
      return Point{a * p[0], p[1], p[2]};
    });
    EXPECT_EQ(PiecesOfMiddle(tube, random).told, share < 1) << "axes 1 and " << a;
    ++(share < 1 ? told : left);
  }
  EXPECT_GT(told, Least(30));
  EXPECT_GT(left, Least(30));
}

}  // namespace
}  // namespace pieces_test
