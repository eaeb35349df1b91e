// SPDX-License-Identifier: MIT
// Components found and removed: which vertices belong together is known from the parts that make the mesh.
#include "islands/small_components.h"

#include <set>

#include "support/library_mesh.h"
#include "support/open_island.h"

namespace small_components_test {
namespace {

using namespace support;

// Parts side by side, in a random numbering.
struct Parts {
  explicit Parts(Random& random) {
    std::vector<Mesh> parts;
    for (int i = 0; i < 5; ++i) parts.push_back(Sphere({4. * i, 0, 0}, 1, 1 + i));
    mesh = Renumbered(Together(parts), random);
    for (uint32_t v = 0; v < VertexCount(mesh); ++v) of[static_cast<int>(PositionOf(mesh, v)[0] + 2) / 4].insert(v);
  }
  Mesh mesh;
  std::map<int, std::set<uint32_t>> of;
};

std::set<uint32_t> Found(OpenIsland& island, uint32_t begin) {
  const tpa::Span<const uint32_t> all = island.w.work_vertices.span();
  return {all.begin() + begin, all.end()};
}

void Forget(OpenIsland& island) {
  for (uint32_t v : island.w.work_vertices) island.w.relocation.vertex_mark[v] = 0;
  island.w.work_vertices.clear();
}

TEST(SmallComponent, IsFoundWholeUpToItsSizeAndNoLarger) {
  Random random(1);
  const Parts parts(random);
  OpenIsland island(parts.mesh);
  for (const auto& [i, vertices] : parts.of)
    for (uint32_t start : {*vertices.begin(), *vertices.rbegin()})
      for (int more : {-1, 0, 1}) {
        Forget(island);
        const uint32_t most = static_cast<uint32_t>(static_cast<int>(vertices.size()) + more);
        EXPECT_EQ(tpa::collect_small_component(island.w, start, most), more >= 0) << "part " << i;
        if (more >= 0) {
          EXPECT_EQ(Found(island, 0), vertices);
        }
        for (uint32_t v : island.w.work_vertices) EXPECT_EQ(vertices.count(v), 1u);
      }
  Forget(island);
}

TEST(SmallComponent, IsNotFoundTwice) {
  Random random(2);
  const Parts parts(random);
  OpenIsland island(parts.mesh);
  const std::set<uint32_t>& first = parts.of.at(1);
  const std::set<uint32_t>& second = parts.of.at(2);
  EXPECT_TRUE(tpa::collect_small_component(island.w, *first.begin(), 1000));
  const uint32_t begin = island.w.work_vertices.size;
  EXPECT_TRUE(tpa::collect_small_component(island.w, *second.begin(), 1000));
  EXPECT_EQ(Found(island, begin), second);
  // Part of it is found before, so the search ends.
  EXPECT_FALSE(tpa::collect_small_component(island.w, *first.rbegin(), 1000));
  Forget(island);
  // Begun and given up as too large, it is not found from another vertex either.
  EXPECT_FALSE(tpa::collect_small_component(island.w, *second.begin(), 3));
  EXPECT_FALSE(tpa::collect_small_component(island.w, *second.rbegin(), 1000));
  Forget(island);
}

TEST(SmallComponent, GoesAlone) {
  Random random(3);
  const Parts parts(random);
  for (const auto& [i, vertices] : parts.of) {
    OpenIsland island(parts.mesh);
    island.Remove({vertices.begin(), vertices.end()});
    const Mesh now = island.Now();
    const Topology topology = TopologyOf(now);
    EXPECT_EQ(topology.defect, "");
    EXPECT_EQ(topology.components.size(), 4u);
    EXPECT_EQ(VertexCount(now), VertexCount(parts.mesh) - vertices.size());
    ExpectArranged(island.w.near_faces, island.w.edit.mesh);
  }
}

}  // namespace
}  // namespace small_components_test
