// SPDX-License-Identifier: MIT
// Winding numbers, by rays, against sums of solid angles. Meshes are random balls upon, in and beside
// each other, needles, and boxes.
#include <algorithm>
#include <cmath>
#include <optional>

#include "islands/contacts.h"
#include "support/share.h"
#include "support/support.h"

namespace winding_number_test {
namespace {

using namespace support;

class Tangle {
 public:
  explicit Tangle(const Mesh& m, uint32_t max_contacts = 20000)
      : mesh_(m), arena_(Config(m, max_contacts), m), w(tpa::open(*reinterpret_cast<tpa::Context*>(*arena_))) {
    tpa::detect_all(w, {});
  }

  double SolidAngles(const Point& p) const {
    double sum = 0;
    for (size_t f = 0; f < TriangleCount(mesh_); ++f) sum += SolidAngle(mesh_, f, p);
    return sum;
  }
  // On the outer side of the surface at v. No value if another face is so close that the sum of solid angles is
  // unclear.
  std::optional<int> WindingAt(uint32_t v) const {
    Point normal{};
    for (size_t f = 0; f < TriangleCount(mesh_); ++f) {
      const uint32_t* c = &mesh_.triangles[3 * f];
      if (c[0] != v && c[1] != v && c[2] != v) continue;
      const Point a = PositionOf(mesh_, c[0]);
      normal = Sum(normal, Unit(Cross(Difference(PositionOf(mesh_, c[1]), a), Difference(PositionOf(mesh_, c[2]), a))));
    }
    const double sum = SolidAngles(Sum(PositionOf(mesh_, v), Scaled(1e-7, Unit(normal))));
    const double nearest = std::round(sum);
    if (std::abs(sum - nearest) > 1e-3) return {};
    return static_cast<int>(nearest);
  }

 private:
  static tpa_config Config(const Mesh& m, uint32_t max_contacts) {
    tpa_config config = ConfigFor(m);
    config.max_contacts = max_contacts;
    config.max_cut_edges = 20000;
    return config;
  }

  Mesh mesh_;
  Arena arena_;

 public:
  tpa::Workspace w;
};

Mesh Balls(Random& random) {
  std::vector<Mesh> balls;
  for (int i = 0; i < 5; ++i) {
    // In statements of their own: compilers differ in the order of evaluating arguments.
    const Point center = RandomPoint(random, -.8, .8);
    const double radius = Uniform(random, .2, .9);
    balls.push_back(Sphere(center, radius, static_cast<int>(3 + random() % 5)));
  }
  return Together(balls);
}

// So sharp a tip lies on the silhouette from most directions.
Mesh Needle(Random& random) {
  const Point tip = RandomPoint(random, -1.5, 1.5);
  const Point end = Sum(tip, RandomPoint(random, -.5, .5));
  Mesh needle;
  const auto add = [&](const Point& p) { needle.positions.insert(needle.positions.end(), p.begin(), p.end()); };
  add(tip);
  for (int i = 0; i < 3; ++i) add(Sum(end, RandomPoint(random, -.03, .03)));
  needle.triangles = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
  if (TopologyOf(needle).Volume() < 0) std::reverse(needle.triangles.begin(), needle.triangles.end());
  return needle;
}

struct Windings {
  std::set<int> seen;
  size_t compared = 0, unknown = 0;

  // Checks all vertices.
  void Check(const Mesh& mesh) {
    const Tangle t(mesh);
    const tpa::Mesh& m = t.w.edit.mesh;
    for (uint32_t v = 0; v < m.vertex_count; ++v) {
      int32_t winding = 0;
      const std::optional<int> wanted = t.WindingAt(v);
      const bool known = tpa::outer_winding(m, t.w.near_faces, v, 0, winding);
      unknown += known ? 0u : 1u;
      if (!known || !wanted) continue;
      ++compared;
      seen.insert(winding);
      ASSERT_EQ(winding, *wanted) << "vertex " << v;
    }
  }
};

void CheckMeshes(Mesh make(Random&), size_t least_windings, size_t least_compared) {
  Windings windings;
  for (uint64_t seed = 1; seed <= Share(20u); ++seed) {
    Random random(seed);
    windings.Check(make(random));
    ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed;
  }
  EXPECT_GE(windings.seen.size(), least_windings);
  EXPECT_EQ(windings.unknown, 0u);
  EXPECT_GT(windings.compared, Least(least_compared));
}

Mesh BallsAndNeedles(Random& random) {
  std::vector<Mesh> parts = {Balls(random)};
  for (int i = 0; i < 200; ++i) parts.push_back(Needle(random));
  return Together(parts);
}

// Rays run along sides and edges. Different boxes have no coordinate in common.
Mesh Boxes(Random& random) {
  std::vector<Mesh> boxes;
  for (int i = 0; i < 5; ++i) {
    const auto coordinate = [&](int least) { return (least + static_cast<double>(random() % 3) + i / 16.) / 2; };
    Point low{}, high{};
    for (double& x : low) x = coordinate(-3);
    for (double& x : high) x = coordinate(1);
    boxes.push_back(Box(low, high, 2));
  }
  return Together(boxes);
}

// Rays run in both directions, away from most of the mesh.
TEST(Winding, IsTheSumOfSolidAngles) { CheckMeshes(Balls, 3, 10000); }
TEST(Winding, IsKnownAtTips) { CheckMeshes(BallsAndNeedles, 4, 20000); }
TEST(Winding, IsKnownOnBoxesAlongTheAxes) { CheckMeshes(Boxes, 4, 2000); }

}  // namespace
}  // namespace winding_number_test
