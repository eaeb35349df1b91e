// SPDX-License-Identifier: MIT
// Two loops round one cluster: a band or two caps, against the volumes of frusta. Several loops: caps or nothing,
// against the volumes of the closed bodies.
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

// Six times the volume between the origin and the triangles tip, p, q over the edges of a polygon.
double SixVolumesOfFan(const Point& tip, const std::vector<Point>& rim) {
  double sum = 0;
  for (size_t i = 0; i < rim.size(); ++i) sum += Dot(tip, Cross(rim[i], rim[(i + 1) % rim.size()]));
  return sum;
}

Point MiddleOf(const std::vector<Point>& points) {
  Point sum{};
  for (const Point& p : points) sum = Sum(sum, p);
  return Scaled(1 / static_cast<double>(points.size()), sum);
}

// A sphere whose vertices away from some of its six poles are the cluster, at `waist` times their distance from the
// middle.
struct Poles {
  Mesh mesh;
  std::set<uint32_t> cluster;

  Poles(size_t poles, double angle, double waist, Random& random)
      : mesh(RandomlyTurned(Renumbered(Sphere({0, 0, 0}, 1, 8), random), random)) {
    for (uint32_t v = 0; v < VertexCount(mesh); ++v) {
      const Point p = PositionOf(mesh, v);
      bool is_near = false;
      for (size_t i = 0; i < poles; ++i) is_near = is_near || (i < 3 ? p[i] : -p[i - 3]) > std::cos(angle);
      if (is_near) continue;
      cluster.insert(v);
      for (size_t k = 0; k < 3; ++k) mesh.positions[3 * v + k] *= waist;
    }
  }
};

// Caps must lose or add clearly less volume than cones with a common tip do.
TEST(Pieces, OfManyLoopsAreCapsOrNone) {
  Random random(3);
  int told = 0, left = 0;
  for (int trial = 0; trial < Share(300); ++trial) {
    const size_t poles = 3 + random() % 4;
    const double angle = Uniform(random, .3, .6), waist = Uniform(random, -1.2, 1);
    const Poles given(poles, angle, waist, random);
    Workbench b(given.mesh, given.cluster);
    ASSERT_EQ(b.r.loops.size, poles);
    double outside = 0;
    for (uint32_t f = 0; f < b.faces; ++f) {
      const uint32_t* v = &given.mesh.triangles[3 * f];
      if (given.cluster.count(v[0]) + given.cluster.count(v[1]) + given.cluster.count(v[2]) == 0)
        outside += Dot(PositionOf(given.mesh, v[0]), Cross(PositionOf(given.mesh, v[1]), PositionOf(given.mesh, v[2])));
    }
    std::vector<std::vector<Point>> rims;
    std::vector<Point> middles;
    for (tpa::CutLoop& loop : b.r.loops) {
      loop.cluster = tpa::find_cluster(b.r, loop.cluster);
      loop.group = 0;
      rims.emplace_back();
      for (uint32_t i = 0; i < loop.count; ++i)
        rims.back().push_back(PositionOf(given.mesh, b.r.cuts[loop.first + i].outside));
      middles.push_back(MiddleOf(rims.back()));
    }
    double capped = outside, joined = outside;
    for (size_t i = 0; i < poles; ++i) {
      capped += SixVolumesOfFan(middles[i], rims[i]);
      joined += SixVolumesOfFan(MiddleOf(middles), rims[i]);
    }
    const double whole = 6 * TopologyOf(given.mesh).Volume(), by_caps = std::fabs(capped - whole),
                 by_cones = std::fabs(joined - whole);
    if (std::fabs(by_caps - 0.75 * by_cones) < 1e-6) continue;
    const bool wants_caps = by_caps < 0.75 * by_cones;
    std::vector<double> cone(b.vertices);
    EXPECT_EQ(tpa::form_pieces(b.e.mesh, b.r, cone.data()), wants_caps) << "trial " << trial;
    if (wants_caps) {
      EXPECT_EQ(b.r.pieces.size, poles) << "trial " << trial;
    }
    ++(wants_caps ? told : left);
  }
  EXPECT_GT(told, Least(30));
  EXPECT_GT(left, Least(30));
}

}  // namespace
}  // namespace pieces_test
