// SPDX-License-Identifier: MIT
// Remeshing to lengths at vertices: an edge aims at the mean of its ends.
#include <gtest/gtest.h>

#include "support/support.h"

namespace lengths_test {
namespace {

using namespace support;

bool HasEdge(const Mesh& m, uint32_t a, uint32_t b) {
  for (size_t h = 0; h < m.triangles.size(); ++h)
    if (m.triangles[h] == a && m.triangles[h % 3 == 2 ? h - 2 : h + 1] == b) return true;
  return false;
}

// Each edge in turn is too long for the mean of its ends, and not for one end alone; all others are short enough.
TEST(Lengths, AnEdgeTooLongForTheMeanOfItsEndsIsSplit) {
  const Mesh m = Sphere({0, 0, 0}, 1, 2);
  auto options = Sized<tpa_remesh_options>();
  options.iterations = 1;
  options.collapse_ratio = 1e-6;
  for (size_t h = 0; h < m.triangles.size(); ++h) {
    const uint32_t a = m.triangles[h], b = m.triangles[h % 3 == 2 ? h - 2 : h + 1];
    const auto length = static_cast<float>(Distance(PositionOf(m, a), PositionOf(m, b)));
    std::vector<float> lengths(VertexCount(m), 9);
    lengths[a] = .2f * length;
    lengths[b] = 1.2f * length;
    options.lengths = lengths.data();
    const Arena arena(ConfigFor(m), m);
    auto report = Sized<tpa_report>();
    ASSERT_EQ(tpa_remesh(*arena, &options, nullptr, &report, nullptr), TPA_OK);
    EXPECT_GE(report.splits, 1u) << "from " << a << " to " << b;
    EXPECT_FALSE(HasEdge(MeshOf(*arena), a, b)) << "from " << a << " to " << b;
  }
}

}  // namespace
}  // namespace lengths_test
