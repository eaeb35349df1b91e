// SPDX-License-Identifier: MIT
// Voids that a step carries through their middle, and neighbours of theirs that are no such voids.
#include "tool/scenes/closing_voids.h"

#include "support/field_shapes.h"
#include "support/sample_meshes.h"
#include "tool/scenes/shapes.h"

namespace closing_voids_test {
namespace {

using namespace support;

Mesh Void(double radius) {
  Mesh m = Sphere({1, 2, 3}, radius, 3);
  for (size_t t = 0; t < m.triangles.size(); t += 3) std::swap(m.triangles[t], m.triangles[t + 1]);
  return m;
}

// The mesh at its targets: each vertex goes `way` towards the middle.
Mesh Moved(const Mesh& m, double way) {
  std::vector<double> targets = m.positions;
  for (uint32_t v = 0; v < VertexCount(m); ++v) {
    const Point p = PositionOf(m, v), inwards = Scaled(1 / Distance(p, {1, 2, 3}), Difference({1, 2, 3}, p));
    for (size_t i = 0; i < 3; ++i) targets[3 * v + i] += way * inwards[i];
  }
  tool::turn_closing_voids({0, 1, m.positions, m.triangles, {}}, {}, targets);
  Mesh moved = m;
  moved.positions = targets;
  return moved;
}

TEST(ClosingVoids, ComeOutInsideOut) {
  const Mesh m = Void(.5), moved = Moved(m, .6);
  EXPECT_LT(SignedVolume(m), 0);
  EXPECT_NEAR(SignedVolume(moved), -SignedVolume(m) / 27, 1e-12);
  EXPECT_GT(SignedVolume(Moved(m, .51)), 0);
}

TEST(ClosingVoids, StayAsTheyMoveWhereAWayEndsBeforeTheMiddle) {
  EXPECT_NEAR(SignedVolume(Moved(Void(.5), .3)), SignedVolume(Void(.2)), 1e-12);
  // All but one vertex.
  const Mesh m = Void(.5);
  std::vector<double> targets = m.positions;
  for (uint32_t v = 1; v < VertexCount(m); ++v)
    for (size_t i = 0; i < 3; ++i) targets[3 * v + i] += 2 * (Point{1, 2, 3}[i] - targets[3 * v + i]);
  const std::vector<double> before = targets;
  tool::turn_closing_voids({0, 1, m.positions, m.triangles, {}}, {}, targets);
  EXPECT_EQ(targets, before);
}

TEST(ClosingVoids, MayBeOverdue) {
  const Mesh m = Void(.5);
  for (const bool all : {true, false}) {
    std::vector<bool> overdue(VertexCount(m), true);
    overdue[3] = all;
    std::vector<double> targets = m.positions;
    tool::turn_closing_voids({0, 1, m.positions, m.triangles, {}}, overdue, targets);
    EXPECT_EQ(targets != m.positions, all);
  }
}

TEST(ClosingVoids, AreNoBodies) {
  Mesh m = Void(.5);
  const size_t of_void = m.positions.size();
  tool::append(m, Sphere({4, 2, 3}, .5, 3));
  std::vector<double> targets;
  for (uint32_t v = 0; v < VertexCount(m); ++v)
    for (size_t i = 0; i < 3; ++i)
      targets.push_back((3 * v < of_void ? Point{1, 2, 3} : Point{4, 2, 3})[i] * 2 - PositionOf(m, v)[i]);
  const std::vector<double> before = targets;
  tool::turn_closing_voids({0, 1, m.positions, m.triangles, {}}, {}, targets);
  const auto end = static_cast<std::ptrdiff_t>(of_void);
  EXPECT_FALSE(std::equal(targets.begin(), targets.begin() + end, before.begin()));
  EXPECT_TRUE(std::equal(targets.begin() + end, targets.end(), before.begin() + end));
}

}  // namespace
}  // namespace closing_voids_test
