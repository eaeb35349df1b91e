// SPDX-License-Identifier: MIT
// Events of components against an oracle that labels the meshes before and after, and relates labels by the maps. Many
// steps in a row, since a step inherits knowledge of components from the step before.
#include <cmath>
#include <map>
#include <numeric>
#include <ostream>

#include "support/share.h"
#include "support/support.h"

namespace {

using namespace support;

struct Label {
  std::vector<uint32_t> of;    // per vertex: smallest vertex of the component
  std::vector<int64_t> euler;  // per vertex, if smallest of a component
};

Label LabelOf(const Mesh& m) {
  Label l;
  l.of.resize(VertexCount(m));
  l.euler.resize(VertexCount(m));
  std::iota(l.of.begin(), l.of.end(), 0u);
  const auto find = [&](uint32_t v) {
    while (l.of[v] != v) v = l.of[v] = l.of[l.of[v]];
    return v;
  };
  for (size_t h = 0; h < m.triangles.size(); ++h) {
    const uint32_t a = find(m.triangles[h]), b = find(m.triangles[h % 3 == 2 ? h - 2 : h + 1]);
    l.of[std::max(a, b)] = std::min(a, b);
  }
  for (uint32_t v = 0; v < VertexCount(m); ++v) l.euler[l.of[v] = find(v)] += 2;
  for (size_t h = 0; h < m.triangles.size(); h += 3) --l.euler[l.of[m.triangles[h]]];
  return l;
}

struct Change {
  int32_t type;
  uint32_t amount, before, after;
  bool operator==(const Change&) const = default;
};
void PrintTo(const Change& c, std::ostream* out) {
  *out << "type " << c.type << " amount " << c.amount << " before " << c.before << " after " << c.after;
}

std::vector<Change> ReportedBy(const tpa_context* context) {
  std::vector<Change> changes;
  for (const tpa_event& e : EventsOf(context))
    if (e.type == TPA_EVENT_MERGE || e.type == TPA_EVENT_SPLIT || e.type == TPA_EVENT_GENUS_UP ||
        e.type == TPA_EVENT_GENUS_DOWN || e.type == TPA_EVENT_DEATH)
      changes.push_back({e.type, e.amount, e.before, e.after});
  return changes;
}

std::vector<Change> Expected(const Mesh& before, const Mesh& after, const std::vector<tpa_vertex_origin>& origins) {
  const Label old = LabelOf(before), now = LabelOf(after);
  // Old components with a common descendant form a family, named by the smallest.
  std::vector<uint32_t> family(VertexCount(before)), relative(VertexCount(after), TPA_NONE);
  std::vector<uint32_t> smallest(VertexCount(after), TPA_NONE);  // of the components before with vertices in common
  std::iota(family.begin(), family.end(), 0u);
  const auto find = [&](uint32_t i) {
    while (family[i] != i) i = family[i];
    return i;
  };
  for (uint32_t v = 0; v < VertexCount(after); ++v) {
    uint32_t& known = relative[now.of[v]];
    const uint32_t parent = find(old.of[origins[v].parents[0]]);
    if (known == TPA_NONE) known = parent;
    smallest[now.of[v]] = std::min(smallest[now.of[v]], old.of[origins[v].parents[0]]);
    const uint32_t other = find(known);
    family[std::max(parent, other)] = std::min(parent, other);
  }
  std::vector<Change> changes;
  for (uint32_t name = 0; name < VertexCount(before); ++name) {
    if (old.of[name] != name || find(name) != name) continue;
    uint32_t count_before = 0, count_after = 0, first_after = TPA_NONE;
    int64_t genus = 0;
    for (uint32_t v = 0; v < VertexCount(before); ++v)
      if (old.of[v] == v && find(v) == name) ++count_before, genus -= 1 - old.euler[v] / 4;
    for (uint32_t v = 0; v < VertexCount(after); ++v)
      if (now.of[v] == v && find(relative[v]) == name) {
        if (count_after++ == 0) first_after = v;
        genus += 1 - now.euler[v] / 4;
      }
    const auto say = [&](int32_t type, int64_t amount) {
      changes.push_back({type, static_cast<uint32_t>(amount), name, first_after});
    };
    if (count_after == 0) {
      say(TPA_EVENT_DEATH, count_before);
      continue;
    }
    if (count_before > 1) say(TPA_EVENT_MERGE, count_before);
    for (uint32_t v = 0; v < VertexCount(after) && count_after > 1; ++v)
      if (now.of[v] == v && find(relative[v]) == name)
        changes.push_back({TPA_EVENT_SPLIT, count_after, smallest[v], v});
    if (genus > 0) say(TPA_EVENT_GENUS_UP, genus);
    if (genus < 0) say(TPA_EVENT_GENUS_DOWN, -genus);
  }
  return changes;
}

// Pushes the vertices near a place, far enough to pass through other bodies.
Mesh Pushed(const Mesh& m, Random& random) {
  const Point place = PositionOf(m, random() % VertexCount(m)), way = RandomPoint(random, -1.2, 1.2);
  const double reach = Uniform(random, .2, .6);
  return Mapped(m, [&](Point p) {
    const double square = std::pow(p[0] - place[0], 2) + std::pow(p[1] - place[1], 2) + std::pow(p[2] - place[2], 2);
    const double far = square / (reach * reach);
    for (size_t k = 0; far < 1 && k < 3; ++k) p[k] += (1 - far) * way[k];
    return p;
  });
}

// Presses a waist flat, and through the axis.
Mesh Pinched(const Mesh& m, Random& random) {
  const Point place = PositionOf(m, random() % VertexCount(m));
  const size_t axis = random() % 3;
  const double width = Uniform(random, .1, .3);
  return Mapped(m, [&](Point p) {
    const double far = std::fabs(p[axis] - place[axis]) / width;
    for (size_t k = 0; far < 1 && k < 3; ++k)
      if (k != axis && std::fabs(p[k] - place[k]) < 1) p[k] = place[k] + (far - .3 * (1 - far)) * (p[k] - place[k]);
    return p;
  });
}

Mesh Shaken(const Mesh& m, Random& random) {
  const double size = Uniform(random, .01, .1);
  return Mapped(m, [&](Point p) {
    for (double& x : p) x += Uniform(random, -size, size);
    return p;
  });
}

TEST(Parts, EventsAreWhatLabelsFromNothingTell) {
  std::map<int32_t, int> seen;
  for (uint64_t seed = 1; seed <= Share(14u); ++seed) {
    Random random(seed);
    const Mesh scene =
        Renumbered(Together({Torus({0, 0, 0}, 1, .3, 40, 14), Sphere({2.2, 0, 0}, .7, 7), Sphere({-2, .5, 0}, .5, 5),
                             Tube({{0, -2, -1}, {0, -2, -.5}, {0, -2, 0}, {0, -2, .5}, {0, -2, 1}},
                                  {.4, .35, .25, .35, .4}, 9, {0, 1, 0}),
                             Sphere({0, 2.5, 0}, .4, 4), Sphere({0, 2.5, 0}, .8, 8)}),
                   random);
    tpa_config config = DefaultConfig(12 * VertexCount(scene));
    config.max_contacts = 1 << 13;
    config.max_cut_edges = 1 << 14;
    Arena arena(config, scene);
    for (int step = 0; step < 12; ++step) {
      const Mesh before = MeshOf(*arena);
      if (before.positions.empty()) break;
      const uint64_t kind = random() % 5;
      const Mesh target = kind < 2   ? Pushed(before, random)
                          : kind < 4 ? Pinched(before, random)
                                     : Shaken(before, random);
      ASSERT_EQ(MoveAll(*arena, target.positions), TPA_OK);
      tpa_issue issue;
      const tpa_status status = tpa_step(*arena, nullptr, nullptr, &issue);
      if (status == TPA_E_LIMIT) break;  // crumpled beyond the room given here
      ASSERT_EQ(status, TPA_OK) << Text(issue);
      const std::vector<Change> expected = Expected(before, MeshOf(*arena), VertexOriginsOf(*arena));
      ASSERT_EQ(ReportedBy(*arena), expected) << "seed " << seed << " step " << step;
      for (const Change& c : expected) ++seen[c.type];
    }
  }
  for (int32_t type : {TPA_EVENT_MERGE, TPA_EVENT_SPLIT, TPA_EVENT_GENUS_UP, TPA_EVENT_GENUS_DOWN, TPA_EVENT_DEATH}) {
    EXPECT_GE(seen[type], Least(2)) << "type " << type;
    RecordProperty("events-" + std::to_string(type), seen[type]);
  }
}

TEST(Parts, EventsOfTangledMeshesToo) {
  for (uint64_t seed = 1; seed <= Share(20u); ++seed) {
    Random random(seed);
    std::vector<Mesh> balls;
    for (int i = 0; i < 8; ++i) {
      const Point center = RandomPoint(random, -1, 1);
      const double radius = Uniform(random, .3, .7);
      balls.push_back(Sphere(center, radius, 3 + static_cast<int>(random() % 5)));
    }
    Mesh before = Renumbered(Together(balls), random);
    Arena arena(DefaultConfig(4 * VertexCount(before)), before);
    for (int round = 0; round < 2; ++round) {
      ASSERT_EQ(tpa_adapt(*arena, nullptr, nullptr, nullptr), TPA_OK);
      EXPECT_EQ(ReportedBy(*arena), Expected(before, MeshOf(*arena), VertexOriginsOf(*arena))) << "seed " << seed;
      before = MeshOf(*arena);
    }
  }
}

}  // namespace
