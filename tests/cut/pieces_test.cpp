// SPDX-License-Identifier: MIT
// Two loops round one cluster: a band or two caps, against the volumes of frusta.
#include "cut/pieces.h"

#include "support/cut_workbench.h"
#include "support/share.h"
#include "support/support.h"
#include "support/tangle_shapes.h"
#include "tool/scenes/elementary.h"

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

// The ring of vertices in the middle of five is the cluster.
Pieces PiecesOfMiddle(const Mesh& m) {
  std::set<uint32_t> ring;
  for (uint32_t i = 0; i < sides; ++i) ring.insert(2 * sides + i);
  Workbench b(m, ring);
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
// cylinder of volume 1, the double frustum has (1 + waist + waist^2) / 3: caps take it away, a band fills it up. Where
// neither changes the volume clearly less, nothing is told.
TEST(Pieces, OfARingFollowTheVolume) {
  Random random(1);
  int joined = 0, capped = 0, unclear = 0;
  for (int trial = 0; trial < Share(400); ++trial) {
    const double waist = Uniform(random, -1, 1.4), by_caps = (1 + waist + waist * waist) / 3;
    const double by_band = std::fabs(1 - by_caps);
    if (std::fabs(by_band - 0.75 * by_caps) < 0.04 || std::fabs(by_caps - 0.75 * by_band) < 0.04) continue;
    const Pieces pieces = PiecesOfMiddle(RandomlyTurned(TubeOf({0, 1, 2, 3, 4}, {1, 1, waist, 1, 1}), random));
    const bool wants_band = by_band < 0.75 * by_caps, wants_caps = by_caps < 0.75 * by_band;
    EXPECT_EQ(pieces.told, wants_band || wants_caps) << "waist " << waist;
    EXPECT_EQ(pieces.count, wants_band ? 1u : wants_caps ? 2u : 0u) << "waist " << waist;
    ++(wants_band ? joined : wants_caps ? capped : unclear);
  }
  EXPECT_GT(joined, Least(50));
  EXPECT_GT(capped, Least(50));
  EXPECT_GT(unclear, Least(20));
}

// A strip follows rims of about the same length only.
TEST(Pieces, OfRimsThatDifferAreLeftToTheExactCut) {
  Random random(2);
  for (const double waist : {0.0, 0.1, 0.9, 1.0})
    for (const double radius : {0.6, 0.7, 1.4, 1.6}) {
      const bool is_alike = radius > 0.65 && radius < 1.5;
      const Mesh tube = RandomlyTurned(TubeOf({0, 1, 2, 3, 4}, {1, 1, waist, radius, radius}), random);
      EXPECT_EQ(PiecesOfMiddle(tube).told, is_alike) << "waist " << waist << ", radius " << radius;
    }
}

}  // namespace
