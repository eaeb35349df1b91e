// SPDX-License-Identifier: MIT
// Parting axes against exact triangles: no pair that meets is parted, though points were rounded; few others are left.
#include "geometry/parting_axes.h"

#include "oracle/mesh_oracle.h"
#include "support/mesh_building.h"
#include "support/share.h"
#include "support/tangle_shapes.h"

namespace parting_axes_test {
namespace {

using namespace support;

// Two triangles: anywhere, needles, in one plane up to rounding, with touching corners, or far smaller than the mesh.
enum class Kind { anywhere, needles, in_a_plane, touching, tiny, kinds };

Mesh TwoTriangles(Kind kind, Random& random) {
  const double size = kind == Kind::tiny ? 1e-6 : .4, width = kind == Kind::needles ? 1e-4 : 1;
  const Point u = RandomDirection(random), v = Unit(Cross(u, RandomDirection(random))), w = Cross(u, v);
  const double height = kind == Kind::in_a_plane ? 0 : 1;
  const Point origin = RandomPoint(random, -.5, .5);
  Mesh m;
  for (int i = 0; i < 6; ++i) {
    const Point p = RandomPoint(random, -size, size);
    AddVertex(m, Sum(origin, Sum(Scaled(p[0], u), Sum(Scaled(width * p[1], v), Scaled(height * width * p[2], w)))));
  }
  // The fourth corner on an edge of the first triangle.
  for (size_t k = 0; k < 3 && kind == Kind::touching; ++k)
    m.positions[9 + k] = .5 * (m.positions[k] + m.positions[3 + k]);
  AddTriangle(m, 0, 1, 2);
  AddTriangle(m, 3, 4, 5);
  return m;
}

tpa::TriangleLanes LanesOf(const Mesh& m, size_t first, float(&reach)) {
  tpa::TriangleLanes t;
  for (size_t i = 0; i < 3; ++i)
    for (size_t k = 0; k < 3; ++k) {
      const float x = static_cast<float>(m.positions[3 * (first + i) + k]);
      reach = std::max(reach, std::abs(x - static_cast<float>(m.positions[k])));
      t.corner[i][k] = tpa::all4(x);
    }
  return t;
}

bool AreParted(const Mesh& m) {
  float reach = 0;
  const tpa::TriangleLanes a = LanesOf(m, 0, reach), b = LanesOf(m, 3, reach);
  tpa::PartingProbe probe;
  tpa::set_probe(probe, a, reach);
  const uint32_t left = tpa::lanes_not_parted(probe, b, 15);
  EXPECT_TRUE(left == 0 || left == 15);
  return left == 0;
}

TEST(PartingAxes, NoPairThatMeetsIsParted) {
  int apart[5] = {}, parted[5] = {};
  for (uint64_t seed = 1; seed <= Share(20000u); ++seed) {
    Random random(seed);
    const int kind = static_cast<int>(seed % static_cast<uint64_t>(Kind::kinds));
    const Mesh m = TwoTriangles(static_cast<Kind>(kind), random);
    const bool meet = TrianglesMeet(m, 0, 1), are_parted = AreParted(m);
    ASSERT_FALSE(meet && are_parted) << "seed " << seed;
    apart[kind] += meet ? 0 : 1;
    parted[kind] += are_parted ? 1 : 0;
  }
  // Other pairs are parted by a product of two edges only. In a plane, many overlap but for rounding.
  for (const int kind : {0, 1}) EXPECT_GT(parted[kind], apart[kind] * 3 / 4) << "kind " << kind;
  EXPECT_GT(parted[2], apart[2] * 2 / 5);
}

}  // namespace
}  // namespace parting_axes_test
