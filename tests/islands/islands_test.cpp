// SPDX-License-Identifier: MIT
// Contacts divided into islands, against a division of the test; islands that end alone, whatever their neighbours do.
#include "islands/islands.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "islands/attempt.h"
#include "support/open_island.h"

namespace islands_test {
namespace {

using namespace support;

// ---------------------------------------------------------------- division

// Contacts belong together if their faces share a vertex, or vertices with a common neighbour, or vertices at both ends
// of an edge; and both faces of a contact do.
struct Division {
  std::vector<uint32_t> parent;
  uint32_t Find(uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  }
  void Join(uint32_t a, uint32_t b) { parent[Find(a)] = Find(b); }

  Division(const Mesh& m, const Pairs& contacts) : parent(VertexCount(m)) {
    std::iota(parent.begin(), parent.end(), 0u);
    std::set<uint32_t> colliding;
    const auto corner = [&](uint32_t f, size_t i) { return m.triangles[3 * f + i]; };
    for (const auto& [f, g] : contacts)
      for (size_t i = 0; i < 3; ++i) {
        colliding.insert({corner(f, i), corner(g, i)});
        Join(corner(f, i), corner(f, 0));
        Join(corner(g, i), corner(f, 0));
      }
    std::map<uint32_t, uint32_t> seen_from;  // a neighbour, and a colliding vertex beside it
    for (uint32_t h = 0; h < m.triangles.size(); ++h) {
      const uint32_t v = m.triangles[h], u = m.triangles[h % 3 == 2 ? h - 2 : h + 1];
      if (colliding.count(v) == 0) continue;
      if (colliding.count(u) != 0) Join(v, u);
      const auto [place, added] = seen_from.emplace(u, v);
      if (!added) Join(v, place->second);
    }
  }
};

// The islands with their contacts, by the number of each.
std::vector<Pairs> IslandsOf(const OpenIsland& island) {
  std::vector<Pairs> islands(island.t.islands.size);
  for (const tpa::IslandContact& c : island.t.contacts) islands[c.island].emplace_back(c.a, c.b);
  return islands;
}

// Pairs of balls apart, some of which meet in two places; and balls crumpled here and there.
Mesh Crowd(Random& random, bool moved) {
  std::vector<Mesh> bodies;
  Random noise(random());
  for (int i = 0; i < 4; ++i)
    for (double z : {0., moved ? 1.9 : 2.3}) {
      const Mesh ball = Sphere({4. * i, 0, z}, 1, 8);
      bodies.push_back(Mapped(ball, [&](const Point& p) {
        const bool jumps = Uniform(noise, 0, 1) < .01;
        const Point by = RandomPoint(noise, -.3, .3);
        return moved && jumps ? Sum(p, by) : p;
      }));
    }
  return Together(bodies);
}

TEST(Islands, AreContactsWhoseClustersTouch) {
  size_t several = 0;
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    Random random(seed), again(seed);
    const Mesh from = Crowd(random, false), to = Crowd(again, true);
    // Before any island ends: a cancelled call has divided its contacts.
    OpenIsland island(from, to);
    const Pairs contacts = AllMeetingPairs(to);
    Division wanted(to, contacts);
    island.Undivide();
    ASSERT_EQ(tpa::settle_islands(island.t), tpa::Outcome::clean);
    std::map<uint32_t, std::set<uint32_t>> ends;  // of each wanted island: the islands that it ended in
    for (const tpa::IslandContact& c : island.t.contacts) ends[wanted.Find(to.triangles[3 * c.a])].insert(c.island);
    // Islands join as they meet, and never come apart.
    for (const auto& [root, numbers] : ends) EXPECT_EQ(numbers.size(), 1u) << "seed " << seed;
    EXPECT_LE(ends.size(), island.t.islands.size);
    const size_t joined = static_cast<size_t>(std::count_if(
        island.t.islands.begin(), island.t.islands.end(), [](const tpa::Island& i) { return i.joined != tpa::none; }));
    EXPECT_EQ(island.t.islands.size, ends.size()) << "seed " << seed;
    EXPECT_LE(joined, island.t.islands.size - 1);
    // In the order of their lowest faces.
    const std::vector<Pairs> islands = IslandsOf(island);
    uint32_t last = 0;
    for (const Pairs& pairs : islands) {
      if (pairs.empty()) continue;
      uint32_t lowest = tpa::none;
      for (const auto& [f, g] : pairs) lowest = std::min({lowest, f, g});
      EXPECT_GE(lowest, last);
      last = lowest;
    }
    several += ends.size() > 4 ? 1u : 0u;
  }
  EXPECT_GT(several, 2u);
}

// ---------------------------------------------------------------- ends

struct Scene {
  Mesh from, to;
};
Scene Beside(const std::vector<Scene>& scenes) {
  Scene all;
  for (const Scene& s : scenes) {
    all.from = Together({all.from, s.from});
    all.to = Together({all.to, s.to});
  }
  return all;
}
Scene At(const Scene& s, const Point& by) { return {Translated(s.from, by), Translated(s.to, by)}; }

// Balls that the paper's way joins; boxes that it does not.
const Scene balls = {Together({Sphere({0, 0, 0}, 1, 8), Sphere({.1, 0, 2.5}, 1, 8)}),
                     Together({Sphere({0, 0, 0}, 1, 8), Sphere({.1, 0, 1.96}, 1, 8)})};
const Scene boxes = {Together({Box({0, 0, 0}, {1, 1, 1}, 1), Box({.25, .25, 1.5}, {.75, .75, 2.5}, 1)}),
                     Together({Box({0, 0, 0}, {1, 1, 1}, 1), Box({.25, .25, .5}, {.75, .75, 1.5}, 1)})};

Scene PairOf(int parts) {
  const Mesh lower = Sphere({0, 0, 0}, 1, parts);
  return {Together({lower, Translated(lower, {.1, .05, 2.5})}), Together({lower, Translated(lower, {.1, .05, 1.7})})};
}

struct Settled {
  tpa::Outcome outcome;
  std::vector<uint32_t> attempts;
  Mesh after;
  uint32_t refused;
};
Settled Settle(const Scene& s, uint32_t max_passes = 8) {
  OpenIsland island(s.from, s.to);
  island.w.context.config.max_passes = max_passes;
  island.Undivide();
  Settled end{tpa::settle_islands(island.t), {}, {}, 0};
  for (const tpa::Island& i : island.t.islands) {
    EXPECT_TRUE(i.is_done || i.joined != tpa::none);
    end.attempts.push_back(i.attempt);
  }
  end.after = island.Now();
  end.refused = island.t.refused;
  EXPECT_EQ(FaultOf(end.after), "");
  return end;
}

TEST(Islands, GoTheirOwnWays) {
  const Settled alone[] = {Settle(balls), Settle(boxes)};
  EXPECT_EQ(alone[0].attempts, (std::vector<uint32_t>{0}));
  EXPECT_EQ(alone[1].attempts, (std::vector<uint32_t>{1}));
  const Settled both = Settle(Beside({balls, At(boxes, {32, 0, 0}), At(balls, {64, 0, 0})}));
  EXPECT_EQ(both.attempts, (std::vector<uint32_t>{0, 1, 0}));
  EXPECT_EQ(both.refused, 0u);
  // Each result to the bit, in any order of numbers.
  const auto points = [](const Mesh& m, double low, double high) {
    std::vector<Point> all;
    for (uint32_t v = 0; v < VertexCount(m); ++v)
      if (const Point p = PositionOf(m, v); p[0] > low && p[0] < high) all.push_back(p);
    std::sort(all.begin(), all.end());
    return all;
  };
  EXPECT_EQ(points(both.after, -16, 16), points(alone[0].after, -16, 16));
  EXPECT_EQ(points(both.after, 16, 48), points(Settle(At(boxes, {32, 0, 0})).after, 16, 48));
  EXPECT_EQ(points(both.after, 48, 80), points(Settle(At(balls, {64, 0, 0})).after, 48, 80));
}

TEST(Islands, EndAsTheyDoAloneWhicheverComesFirst) {
  const Settled alone = Settle(boxes);
  for (const Scene& s : {Beside({boxes, At(balls, {32, 0, 0})}), Beside({At(balls, {32, 0, 0}), boxes})}) {
    const Settled both = Settle(s);
    EXPECT_EQ(TopologyOf(both.after).components.size(), 2u);
    std::multiset<double> near, wanted;
    for (uint32_t v = 0; v < VertexCount(both.after); ++v)
      if (PositionOf(both.after, v)[0] < 16) near.insert(PositionOf(both.after, v)[2]);
    for (uint32_t v = 0; v < VertexCount(alone.after); ++v) wanted.insert(PositionOf(alone.after, v)[2]);
    EXPECT_EQ(near, wanted);
  }
}

// Without a pass nothing is resolved: islands hold back the vertices round their contacts, and no others.
TEST(Islands, HoldBackTheirOwnVertices) {
  const Scene free{Sphere({64, 0, 0}, 1, 8), Sphere({64, 0, .5}, 1, 8)};
  const Settled of_balls = Settle(balls, 0), of_boxes = Settle(boxes, 0);
  EXPECT_GT(of_balls.refused, 8u);
  EXPECT_LT(of_balls.refused, VertexCount(Sphere({0, 0, 0}, 1, 8)) / 2);
  EXPECT_EQ(of_boxes.refused, 8u);  // of the upper box, all that moves
  EXPECT_EQ(of_boxes.after.positions, boxes.from.positions);
  const Settled all = Settle(Beside({balls, At(boxes, {32, 0, 0}), free}), 0);
  EXPECT_EQ(all.refused, of_balls.refused + of_boxes.refused);
  EXPECT_EQ(all.attempts, (std::vector<uint32_t>{of_balls.attempts[0], of_boxes.attempts[0]}));
  const std::vector<double>& now = all.after.positions;
  const std::vector<double> wanted = Together({of_balls.after, At(boxes, {32, 0, 0}).from, free.to}).positions;
  EXPECT_EQ(now, wanted);
}

// Of a failed attempt nothing is told. Without room for a single event, as many are lost as there would be.
TEST(Islands, LoseTheEventsOfTheirEndsOnly) {
  size_t attempts = 0;
  for (const Scene& s : {balls, boxes, Beside({boxes, At(balls, {32, 0, 0})}), PairOf(3), PairOf(4), PairOf(5)}) {
    uint64_t told[2] = {};
    for (const bool has_room : {true, false}) {
      OpenIsland island(s.from, s.to);
      if (!has_room) island.w.pending_events.capacity = 0;
      island.Undivide();
      ASSERT_EQ(tpa::settle_islands(island.t), tpa::Outcome::clean);
      EXPECT_EQ(island.t.events_lost == 0, has_room);
      told[has_room] = island.w.pending_events.size + island.t.events_lost;
      for (const tpa::Island& i : island.t.islands) attempts += i.attempt;
    }
    EXPECT_EQ(told[false], told[true]);
  }
  EXPECT_GT(attempts, 0u);
}

TEST(Islands, AreNoneWithoutContacts) {
  const Settled none = Settle({balls.from, Translated(balls.from, {0, 0, .125})});
  EXPECT_TRUE(none.attempts.empty());
  EXPECT_EQ(none.after.positions, Translated(balls.from, {0, 0, .125}).positions);
}

// Elements belong to no island after the call, whether it has edited them or only held vertices back. The larger box
// neither moves nor is edited then.
TEST(Islands, AreForgotten) {
  const Scene s = Beside({balls, At(boxes, {32, 0, 0})});
  for (uint32_t max_passes : {8u, 0u}) {
    OpenIsland island(s.from, s.to);
    island.w.context.config.max_passes = max_passes;
    island.Undivide();
    ASSERT_EQ(tpa::settle_islands(island.t), tpa::Outcome::clean);
    EXPECT_EQ(island.t.refused > 0, max_passes == 0);
    tpa::forget_islands(island.t);
    const tpa::Claims& claims = island.w.edit.journal.claims;
    for (uint32_t v = 0; v < island.w.edit.mesh.vertex_capacity; ++v) ASSERT_EQ(claims.vertex_owner[v], tpa::none);
    for (uint32_t f = 0; f < island.w.edit.mesh.face_capacity; ++f) ASSERT_EQ(claims.face_owner[f], tpa::none);
    EXPECT_EQ(claims.owner, tpa::none);
  }
}

}  // namespace
}  // namespace islands_test
