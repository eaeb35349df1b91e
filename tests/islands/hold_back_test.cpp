// SPDX-License-Identifier: MIT
// Vertices held back: rings of neighbours, counted by a search of the test over the triangles.
#include "islands/hold_back.h"

#include <set>

#include "support/open_island.h"

namespace hold_back_test {
namespace {

using namespace support;
using Vertices = std::set<uint32_t>;

// The vertices with these, and `rings` rings of neighbours.
Vertices Grown(const Mesh& m, Vertices vertices, uint32_t rings) {
  for (uint32_t ring = 0; ring < rings; ++ring) {
    const Vertices before = vertices;
    for (size_t h = 0; h < m.triangles.size(); ++h)
      if (before.count(m.triangles[h]) != 0)
        for (size_t i = 0; i < 3; ++i) vertices.insert(m.triangles[h / 3 * 3 + i]);
    if (vertices == before) break;
  }
  return vertices;
}

Vertices CornersOf(const Mesh& m, const Pairs& pairs) {
  Vertices corners;
  for (const auto& [f, g] : pairs)
    for (uint32_t face : {f, g})
      for (size_t i = 0; i < 3; ++i) corners.insert(m.triangles[3 * face + i]);
  return corners;
}

// Two balls come close to an idle ball, and the left one meets the right one.
struct Scene {
  const Mesh from = Together({Sphere({0, 0, 0}, 1, 8), Sphere({2.4, 0, 0}, 1, 8), Sphere({0, 0, 4}, 1, 8)});
  const Mesh to = Together({Sphere({.2, 0, 0}, 1, 8), Sphere({2.15, 0, 0}, 1, 8), Sphere({0, 0, 4}, 1, 8)});
  const Pairs contacts = AllMeetingPairs(to);
  const Vertices corners = CornersOf(to, contacts);
};

// Exactly these are where they were before the step, and all others that have targets at their targets.
void ExpectHeld(const OpenIsland& island, const Scene& scene, const Vertices& held) {
  uint32_t refused = 0, moved = 0;
  for (uint32_t v = 0; v < VertexCount(scene.from); ++v) {
    const bool has_target = PositionOf(scene.from, v) != PositionOf(scene.to, v), is_held = held.count(v) != 0;
    const Point wanted = PositionOf(is_held ? scene.from : scene.to, v);
    const tpa::Vec3& at = island.w.edit.mesh.position[v];
    ASSERT_EQ((Point{at.x, at.y, at.z}), wanted) << v;
    EXPECT_EQ(island.t.held_back.contains(v), is_held && has_target) << v;
    refused += is_held && has_target ? 1 : 0;
    moved += !is_held && has_target ? 1 : 0;
  }
  EXPECT_EQ(island.t.refused, refused);
  EXPECT_EQ(island.t.moved, moved);
}

TEST(HoldBack, TakesRingsOfNeighboursOfTheFacesInContact) {
  const Scene scene;
  ASSERT_GT(scene.corners.size(), 8u);
  for (uint32_t rings : {0u, 1u, 2u, 4u}) {
    OpenIsland island(scene.from, scene.to);
    tpa::Attempt a = island.Attempt(cut_attempt, 1);
    tpa::choose_at_contacts(a);
    const Vertices held = Grown(scene.to, scene.corners, rings);
    ASSERT_LT(held.size(), VertexCount(scene.from) - VertexCount(Sphere({0, 0, 0}, 1, 8)));
    EXPECT_EQ(tpa::hold_back(island.t, rings), held.size());
    ExpectHeld(island, scene, held);
  }
}

TEST(HoldBack, TakesWholeComponentsAndNoOther) {
  const Scene scene;
  OpenIsland island(scene.from, scene.to);
  tpa::Attempt a = island.Attempt(cut_attempt, 1);
  tpa::choose_at_contacts(a);
  const Vertices held = Grown(scene.to, scene.corners, 1000);
  EXPECT_EQ(held.size(), 2 * VertexCount(Sphere({0, 0, 0}, 1, 8)));
  EXPECT_EQ(tpa::hold_back(island.t, tpa::whole_components), held.size());
  ExpectHeld(island, scene, held);
}

TEST(HoldBack, BeginsAtTheFacesThatMetAtFirstToo) {
  const Scene scene;
  OpenIsland island(scene.from, scene.to);
  island.w.work_vertices.clear();
  tpa::choose_at_faces(island.t, island.t.contacts.span());
  const Vertices held = Grown(scene.to, scene.corners, 1);
  EXPECT_EQ(tpa::hold_back(island.t, 1), held.size());
  ExpectHeld(island, scene, held);
}

// Rings are counted from the contacts again, through vertices held back before.
TEST(HoldBack, GrowsWithLaterAttempts) {
  const Scene scene;
  OpenIsland island(scene.from, scene.to);
  uint32_t before = 0;
  for (uint32_t rings : {1u, 2u, 4u}) {
    island.w.work_vertices.clear();
    tpa::choose_at_faces(island.t, island.t.contacts.span());
    const Vertices held = Grown(scene.to, scene.corners, rings);
    const auto now = static_cast<uint32_t>(held.size());
    EXPECT_EQ(tpa::hold_back(island.t, rings), now - before);
    ExpectHeld(island, scene, held);
    before = now;
  }
  island.w.work_vertices.clear();
  tpa::choose_at_faces(island.t, island.t.contacts.span());
  EXPECT_EQ(tpa::hold_back(island.t, 4), 0u);
}

// Each attempt of a step holds more back than the one before, and the last one everything.
TEST(HoldBack, OfAStepDoublesItsRings) {
  for (uint32_t i = cut_attempt; i + 1 <= tpa::last_attempt(tpa::Mode::step); ++i) {
    const uint32_t rings = tpa::rule_of(tpa::Mode::step, i).rings;
    EXPECT_EQ(rings, i <= 7 ? 1u << (i - 1) : tpa::whole_components);
  }
  EXPECT_EQ(tpa::rule_of(tpa::Mode::step, 0).strategy, tpa::Strategy::paper);
  EXPECT_EQ(tpa::rule_of(tpa::Mode::step, tpa::last_attempt(tpa::Mode::step)).strategy, tpa::Strategy::leave);
}

// A new vertex in contact comes from old ones.
TEST(HoldBack, TakesTheParentsOfNewVertices) {
  const Scene scene;
  OpenIsland island(scene.from, scene.to);
  island.w.edit.mesh.vertex_origin[*scene.corners.begin()] = {{7, 11}, .25f};
  tpa::Attempt a = island.Attempt(cut_attempt, 1);
  tpa::choose_at_contacts(a);
  Vertices chosen;
  for (uint32_t v : island.w.work_vertices) EXPECT_TRUE(chosen.insert(v).second);
  Vertices wanted = scene.corners;
  wanted.erase(*scene.corners.begin());
  wanted.insert({7, 11});
  EXPECT_EQ(chosen, wanted);
  island.w.edit.mesh.vertex_origin[*scene.corners.begin()] = {{*scene.corners.begin(), tpa::none}, 1};
}

}  // namespace
}  // namespace hold_back_test
