// SPDX-License-Identifier: MIT
// How many faces splits make, foretold: against the splits themselves, done on a list of triangles.
#include "edit/bisect.h"

#include <algorithm>
#include <cmath>

#include "support/library_mesh.h"
#include "support/share.h"
#include "support/support.h"

namespace bisect_test {
namespace {

using namespace support;

tpa::u64 Foretold(const Mesh& m, double split, const std::vector<uint8_t>* chosen = nullptr) {
  const LibraryMesh library(m);
  tpa::EdgeAims aims{split, split / 3};
  if (chosen != nullptr) aims.chosen = chosen->data();
  return tpa::most_faces_bisected(library.m, aims);
}

// All right-angled triangles of a cube, each with two equal sides, are halves of the same kind again and again.
TEST(Bisect, FacesOfACubeAreHalvedAlike) {
  const Mesh cube = Box({0, 0, 0}, {1, 1, 1}, 1);
  for (int halvings : {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 20}) {
    const double longest = std::sqrt(std::ldexp(2, -halvings));  // of each face after the halvings
    EXPECT_EQ(Foretold(cube, 1.01 * longest), 12ull << halvings);
  }
}

// Splits the longest edge of all until none is too long.
Mesh Split(Mesh m, double split) {
  for (;;) {
    uint32_t a = 0, b = 0;
    double longest = split;
    for (size_t h = 0; h < m.triangles.size(); ++h) {
      const uint32_t p = m.triangles[h], q = m.triangles[h % 3 == 2 ? h - 2 : h + 1];
      const double length = Distance(PositionOf(m, p), PositionOf(m, q));
      if (length > longest) a = p, b = q, longest = length;
    }
    if (a == b) return m;
    const uint32_t middle = VertexCount(m);
    for (size_t k = 0; k < 3; ++k) m.positions.push_back((m.positions[3 * a + k] + m.positions[3 * b + k]) / 2);
    for (size_t f = 0, end = TriangleCount(m); f < end; ++f) {
      uint32_t corners[3];
      std::copy_n(m.triangles.data() + 3 * f, 3, corners);
      if (std::count(corners, corners + 3, a) + std::count(corners, corners + 3, b) < 2) continue;
      for (size_t i = 0; i < 3; ++i) {
        m.triangles[3 * f + i] = corners[i] == b ? middle : corners[i];
        m.triangles.push_back(corners[i] == a ? middle : corners[i]);
      }
    }
  }
}

TEST(Bisect, FacesAreAsManyAsSplitsMake) {
  tpa::u64 most = 0;
  for (uint64_t seed = 1; seed <= Share(20u); ++seed) {
    Random random(seed);
    const Mesh m =
        Mapped(Sphere({0, 0, 0}, 1, 2), [&](const Point& p) { return Sum(p, RandomPoint(random, -.2, .2)); });
    const double split = Uniform(random, .3, 1.2);
    const Mesh after = Split(m, split);
    EXPECT_EQ(TopologyOf(after).defect, "");
    EXPECT_EQ(Foretold(m, split), TriangleCount(after)) << "seed " << seed;
    most = std::max<tpa::u64>(most, TriangleCount(after) / TriangleCount(m));
  }
  EXPECT_GE(most, 8u);
}

// No edge of a part without two neighbours is split.
TEST(Bisect, FacesOfAPartAloneCount) {
  const Mesh cube = Box({0, 0, 0}, {1, 1, 1}, 1);
  std::vector<uint8_t> chosen(8, 0);
  EXPECT_EQ(Foretold(cube, .1, &chosen), 12u);
  chosen[3] = 1;
  EXPECT_EQ(Foretold(cube, .1, &chosen), 12u);
}

}  // namespace
}  // namespace bisect_test
