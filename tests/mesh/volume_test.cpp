// SPDX-License-Identifier: MIT
// Volumes of faces, with integers as coordinates, so that no sum is rounded.
#include "mesh/volume.h"

#include <algorithm>
#include <cmath>

#include "support/library_mesh.h"
#include "support/sample_meshes.h"

namespace volume_test {
namespace {

using namespace support;

TEST(FacesAboveAVertex, AreThoseWithNoSmallerOne) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    const Mesh smooth = Together({Torus({0, 0, 0}, 3, 1, 12, 8), Sphere({0, 0, 9}, 2, 3)});
    const Mesh m = Renumbered(Mapped(smooth,
                                     [](const Point& p) {
                                       return Point{std::rint(64 * p[0]), std::rint(64 * p[1]), std::rint(64 * p[2])};
                                     }),
                              random);
    const LibraryMesh library(m);
    const Point from{7, -5, 300};
    std::vector<double> wanted(VertexCount(m));
    for (size_t f = 0; f < TriangleCount(m); ++f) {
      const uint32_t* v = m.triangles.data() + 3 * f;
      Point to[3];
      for (size_t i = 0; i < 3; ++i) to[i] = Difference(PositionOf(m, v[i]), from);
      wanted[std::min({v[0], v[1], v[2]})] += Dot(to[0], Cross(to[1], to[2]));
    }
    for (uint32_t v = 0; v < VertexCount(m); ++v) {
      tpa::SignedVolume s;
      tpa::add_faces_above(s, library.m, {from[0], from[1], from[2]}, v);
      EXPECT_EQ(s.sum, wanted[v]) << "seed " << seed << " vertex " << v;
    }
  }
}

}  // namespace
}  // namespace volume_test
