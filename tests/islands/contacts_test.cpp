// SPDX-License-Identifier: MIT
// Contacts that a transaction looks for, against all pairs of the mesh: none is missed that a moved or edited face has.
#include "islands/contacts.h"

#include <set>

#include "support/library_mesh.h"
#include "support/open_island.h"
#include "support/share.h"

namespace contacts_test {
namespace {

using namespace support;

Pairs Found(const OpenIsland& island) {
  Pairs pairs;
  for (const tpa::Contact& c : island.w.detection.pairs) pairs.emplace_back(c.a, c.b);
  EXPECT_EQ(island.w.detection.found, pairs.size());
  return pairs;
}

Pairs With(const Pairs& all, const std::set<uint32_t>& faces) {
  Pairs pairs;
  for (const auto& [f, g] : all)
    if (faces.count(f) + faces.count(g) != 0) pairs.emplace_back(f, g);
  return pairs;
}

std::set<uint32_t> FacesRound(const Mesh& m, const std::set<uint32_t>& vertices) {
  std::set<uint32_t> faces;
  for (uint32_t h = 0; h < m.triangles.size(); ++h)
    if (vertices.count(m.triangles[h]) != 0) faces.insert(h / 3);
  return faces;
}

const Mesh bodies = Together({Sphere({0, 0, 0}, 1, 6), Sphere({2.2, 0, 0}, 1, 6), Torus({0, 0, 3}, 1, .3, 12, 6)});

// Some vertices, or all, jump about.
Mesh Shaken(const Mesh& m, double share, double by, Random& random) {
  return Mapped(
      m, [&](const Point& p) { return Uniform(random, 0, 1) < share ? Sum(p, RandomPoint(random, -by, by)) : p; });
}

TEST(ContactsOfAMove, AreAllThatMeet) {
  size_t met = 0;
  for (uint64_t seed = 1; seed <= Share(30u); ++seed) {
    Random random(seed);
    const double share = seed % 3 == 0 ? 1 : seed % 3 == 1 ? .3 : .01;
    const Mesh moved = Shaken(bodies, share, .3, random);
    const OpenIsland island(bodies, moved);
    EXPECT_EQ(Found(island), AllMeetingPairs(moved)) << seed;
    met += island.w.detection.pairs.size;
  }
  EXPECT_GT(met, Least(100u));
}

// A box whose faces an event has listed is gone: its faces are not entered again.
TEST(ContactsOfAMove, AreNoneOfFacesThatAreGone) {
  size_t met = 0;
  for (uint64_t seed = 1; seed <= Share(10u); ++seed) {
    Random random(seed);
    const Mesh box = Box({5, 0, 0}, {6, 1, 1}, 1), moved = Shaken(bodies, .02, .6, random);
    OpenIsland island(Together({bodies, box}), Together({moved, box}));
    EXPECT_TRUE(island.t.moves_few());
    std::vector<uint32_t> of_box;
    for (uint32_t v = VertexCount(bodies); v < VertexCount(bodies) + 8; ++v) of_box.push_back(v);
    island.w.work_vertices.clear();
    for (uint32_t v : of_box) island.w.work_vertices.push(v);
    tpa::detect_again(island.w, {});
    EXPECT_TRUE(Found(island).empty());
    island.Remove(of_box);
    tpa::detect_moved_faces(island.t);
    EXPECT_EQ(Found(island), AllMeetingPairs(moved)) << seed;
    ExpectArranged(island.w.near_faces, island.w.edit.mesh);
    met += island.w.detection.pairs.size;
  }
  EXPECT_GT(met, Least(20u));
}

// Faces round vertices of an event, whether they met something before or not.
TEST(ContactsOfAnEvent, AreThoseOfTheFacesRoundIt) {
  for (uint64_t seed = 1; seed <= Share(20u); ++seed) {
    Random random(seed);
    const Mesh moved = Shaken(bodies, .3, .3, random);
    OpenIsland island(bodies, moved);
    std::set<uint32_t> round;
    island.w.work_vertices.clear();
    for (uint64_t n = seed % 2 == 0 ? 3 : 100; n > 0; --n) {
      const uint32_t v = static_cast<uint32_t>(random() % VertexCount(moved));
      if (round.insert(v).second) island.w.work_vertices.push(v);
    }
    tpa::detect_again(island.w, {});
    EXPECT_EQ(Found(island), With(AllMeetingPairs(moved), FacesRound(moved, round))) << seed;
    for (uint32_t f = 0; f < TriangleCount(moved); ++f) EXPECT_EQ(island.w.relocation.face_mark[f], 0);
  }
}

// The gate of a commit: whatever was edited or bent.
TEST(ContactsOfEdits, AreThoseOfEditedAndBentFaces) {
  size_t met = 0;
  for (uint64_t seed = 1; seed <= Share(20u); ++seed) {
    Random random(seed);
    const Mesh tangled = Together({Shaken(bodies, .2, .3, random), Box({5, 0, 0}, {6, 1, 1}, 1)});
    const uint32_t box = VertexCount(bodies), box_face = TriangleCount(bodies);
    OpenIsland island(tangled);
    std::set<uint32_t> bent;
    for (int n = 0; n < 3; ++n) {
      const uint32_t v = static_cast<uint32_t>(random() % VertexCount(bodies));
      const Point by = RandomPoint(random, -.4, .4);
      tpa::set_position(island.w.edit, v, island.w.edit.mesh.position[v] + tpa::Vec3{by[0], by[1], by[2]});
      bent.insert(v);
    }
    std::vector<uint32_t> of_box;
    for (uint32_t v = box; v < box + 8; ++v) of_box.push_back(v);
    island.Remove(of_box);
    island.Make(Box({.5, -.5, -.5}, {1.5, .5, .5}, 1));  // in the slots of the other box
    const tpa::Mesh& m = island.w.edit.mesh;
    for (uint32_t v : bent)
      tpa::for_each_outgoing(m, v, [&](uint32_t h) { tpa::insert(island.w.near_faces, m, h / 3); });
    Mesh now;
    for (uint32_t v = 0; v < m.vertex_count; ++v)
      now.positions.insert(now.positions.end(), {m.position[v].x, m.position[v].y, m.position[v].z});
    now.triangles.assign(m.corner, m.corner + 3 * static_cast<size_t>(m.face_count));
    ASSERT_EQ(VertexCount(now), VertexCount(tangled));
    std::set<uint32_t> edited = FacesRound(now, bent);
    for (uint32_t f = box_face; f < TriangleCount(now); ++f) edited.insert(f);
    tpa::detect_edited(island.w, {});
    EXPECT_EQ(Found(island), With(AllMeetingPairs(now), edited)) << seed;
    met += island.w.detection.pairs.size;
  }
  EXPECT_GT(met, Least(100u));
}

// A call that gives up has no budget for its way back.
TEST(TheWayBack, IsNotCounted) {
  Random random(1);
  for (double share : {.01, 1.}) {
    const Mesh moved = Shaken(bodies, share, .1, random);
    OpenIsland island(bodies, moved);
    tpa::Meter meter;
    meter.budget = 0;
    island.w.near_faces.meter = &meter;
    tpa::roll_back(island.w);
    EXPECT_EQ(meter.spent, 0u);
    EXPECT_EQ(meter.stop, tpa::Stop::no);
    EXPECT_EQ(island.Now().positions, bodies.positions);
    ExpectArranged(island.w.near_faces, island.w.edit.mesh);
  }
}

TEST(ContactsThatDoNotFit, NameNoPair) {
  OpenIsland island(bodies, Translated(bodies, {0, 0, 0}));
  tpa::Contact pairs[2] = {{3, 7}, {4, 9}};
  tpa::Detection d{{pairs, 2, 2}, 2, {}};
  EXPECT_EQ(tpa::fail_tangled(island.issue, d), TPA_E_TANGLED);
  EXPECT_EQ(island.issue.element, 3u);
  EXPECT_EQ(island.issue.other, 7u);
  EXPECT_EQ(island.issue.needed, 2u);
  d.found = 3;
  tpa::fail_tangled(island.issue, d);
  EXPECT_EQ(island.issue.element, 0u);
  EXPECT_EQ(island.issue.other, 0u);
  EXPECT_EQ(island.issue.needed, 3u);
}

TEST(FacesInContact, AreListedOnceAndMarked) {
  const Mesh moved = Together({Sphere({.2, 0, 0}, 1, 6), Sphere({2, 0, 0}, 1, 6), Torus({0, 0, 3}, 1, .3, 12, 6)});
  OpenIsland island(bodies, moved);
  tpa::collect_in_contact(island.w);
  std::set<uint32_t> wanted, listed;
  for (const auto& [f, g] : AllMeetingPairs(moved)) wanted.insert({f, g});
  for (uint32_t f : island.w.relocation.faces) EXPECT_TRUE(listed.insert(f).second);
  EXPECT_EQ(listed, wanted);
  for (uint32_t f = 0; f < TriangleCount(moved); ++f) EXPECT_EQ(island.w.relocation.face_mark[f], wanted.count(f));
  tpa::clear_marks(island.w.relocation);
}

}  // namespace
}  // namespace contacts_test
