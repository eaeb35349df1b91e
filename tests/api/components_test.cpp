// SPDX-License-Identifier: MIT
// tpa_components against disjoint sets over the exported mesh, and sums in long double.
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "support/share.h"
#include "support/step_scenes.h"
#include "support/support.h"
#include "support/tangle_shapes.h"

namespace components_test {
namespace {

using namespace support;

struct Listed {
  std::vector<tpa_component> components;
  std::vector<uint32_t> labels;
};

Listed ComponentsOf(const tpa_context* context) {
  Listed l;
  uint32_t count = 0;
  EXPECT_EQ(tpa_components(context, nullptr, 0, nullptr, &count, nullptr), TPA_OK);
  l.components.resize(count);
  l.labels.resize(VertexCount(MeshOf(context)));
  EXPECT_EQ(tpa_components(context, l.components.data(), count, l.labels.data(), &count, nullptr), TPA_OK);
  EXPECT_EQ(count, l.components.size());
  return l;
}

// Per vertex: the smallest vertex of its component.
std::vector<uint32_t> NamesOf(const Mesh& m) {
  std::vector<uint32_t> name(VertexCount(m));
  std::iota(name.begin(), name.end(), 0u);
  const auto find = [&](uint32_t v) {
    while (name[v] != v) v = name[v] = name[name[v]];
    return v;
  };
  for (size_t h = 0; h < m.triangles.size(); ++h) {
    const uint32_t a = find(m.triangles[h]), b = find(m.triangles[h % 3 == 2 ? h - 2 : h + 1]);
    name[std::max(a, b)] = std::min(a, b);
  }
  for (uint32_t v = 0; v < name.size(); ++v) name[v] = find(v);
  return name;
}

struct Sums {
  uint32_t vertices = 0, triangles = 0;
  long double volume = 0, area = 0, size = 0;
  std::array<double, 6> box{HUGE_VAL, HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
};

// By the divergence theorem, about the middle of the first vertex's component.
std::vector<Sums> SumsOf(const Mesh& m, const std::vector<uint32_t>& names) {
  std::vector<Sums> sums(names.size());
  for (uint32_t v = 0; v < names.size(); ++v) {
    Sums& s = sums[names[v]];
    ++s.vertices;
    for (size_t k = 0; k < 3; ++k) {
      s.box[k] = std::min(s.box[k], m.positions[3 * v + k]);
      s.box[3 + k] = std::max(s.box[3 + k], m.positions[3 * v + k]);
    }
  }
  for (size_t f = 0; f < TriangleCount(m); ++f) {
    Sums& s = sums[names[m.triangles[3 * f]]];
    ++s.triangles;
    std::array<std::array<long double, 3>, 3> p;
    for (size_t i = 0; i < 3; ++i)
      for (size_t k = 0; k < 3; ++k)
        p[i][k] = static_cast<long double>(m.positions[3 * m.triangles[3 * f + i] + k]) -
                  (static_cast<long double>(s.box[k]) + static_cast<long double>(s.box[3 + k])) / 2;
    std::array<long double, 3> n{}, a{}, b{};
    for (size_t k = 0; k < 3; ++k) a[k] = p[1][k] - p[0][k], b[k] = p[2][k] - p[0][k];
    for (size_t k = 0; k < 3; ++k) n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    s.area += std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
    // The flow of x through the triangle.
    s.volume += n[0] / 2 * (p[0][0] + p[1][0] + p[2][0]) / 3;
  }
  for (Sums& s : sums) {
    const auto side = [&](size_t k) {
      return static_cast<long double>(s.box[3 + k]) - static_cast<long double>(s.box[k]);
    };
    s.size = side(0) + side(1) + side(2);
  }
  return sums;
}

// All but `before`, which the caller knows.
void ExpectListed(const tpa_context* context) {
  const Mesh m = MeshOf(context);
  const Listed l = ComponentsOf(context);
  const std::vector<uint32_t> names = NamesOf(m);
  const std::vector<Sums> sums = SumsOf(m, names);
  for (uint32_t v = 0; v < names.size(); ++v) {
    ASSERT_LT(l.labels[v], l.components.size());
    ASSERT_EQ(l.components[l.labels[v]].id, names[v]) << "vertex " << v;
  }
  uint32_t last = 0, vertices = 0;
  for (size_t i = 0; i < l.components.size(); ++i) {
    const tpa_component& c = l.components[i];
    const Sums& s = sums[c.id];
    ASSERT_TRUE(i == 0 || c.id > last);
    last = c.id;
    vertices += c.vertices;
    EXPECT_EQ(c.vertices, s.vertices);
    EXPECT_EQ(c.triangles, s.triangles);
    EXPECT_EQ(2 - 2 * c.genus, static_cast<int64_t>(s.vertices) - static_cast<int64_t>(s.triangles) / 2);
    EXPECT_EQ(c.reserved, 0u);
    for (size_t k = 0; k < 6; ++k) EXPECT_EQ(c.box[k], s.box[k]);
    const long double n = s.triangles;
    EXPECT_LE(std::abs(static_cast<long double>(c.volume) - s.volume), n * 0x1p-50L * s.size * s.size * s.size);
    EXPECT_LE(std::abs(static_cast<long double>(c.area) - s.area), n * 0x1p-50L * s.size * s.size);
  }
  EXPECT_EQ(vertices, names.size());
}

void ExpectItself(const tpa_context* context) {
  for (const tpa_component& c : ComponentsOf(context).components) EXPECT_EQ(c.before, c.id);
}

// The smallest component before with a vertex in this one, or a parent of a vertex.
void ExpectAncestors(const tpa_context* context, const Mesh& before) {
  const std::vector<uint32_t> old = NamesOf(before);
  const std::vector<tpa_vertex_origin> origins = VertexOriginsOf(context);
  const Listed l = ComponentsOf(context);
  std::vector<uint32_t> smallest(l.components.size(), TPA_NONE);
  for (uint32_t v = 0; v < origins.size(); ++v)
    smallest[l.labels[v]] = std::min(smallest[l.labels[v]], old[origins[v].parents[0]]);
  for (size_t i = 0; i < smallest.size(); ++i) EXPECT_EQ(l.components[i].before, smallest[i]) << "component " << i;
}

Mesh SomeBodies(Random& random) {
  return Renumbered(Together({Torus({0, 0, 0}, 1, .3, 24, 9), Sphere({2.2, 0, 0}, .7, 5), Sphere({-2, .5, 0}, .5, 4),
                              Sphere({0, 2.5, 0}, .4, 4), Reversed(Sphere({2.2, 0, 0}, .3, 3)),
                              Tube({{0, -2, -1}, {0, -2, -.5}, {0, -2, 0}, {0, -2, .5}, {0, -2, 1}},
                                   {.4, .3, .15, .3, .4}, 9, {0, 1, 0})}),
                    random);
}

TEST(Components, AreListedAfterALoad) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    Random random(seed);
    const Mesh m = Translated(SomeBodies(random), {seed == 5 ? 1e6 : 0, 0, 0});
    const Arena arena(ConfigFor(m), m);
    ExpectListed(*arena);
    ExpectItself(*arena);
    const Listed l = ComponentsOf(*arena);
    EXPECT_EQ(l.components.size(), 6u);
    EXPECT_EQ(
        std::count_if(l.components.begin(), l.components.end(), [](const tpa_component& c) { return c.volume < 0; }),
        1);
    EXPECT_EQ(
        std::count_if(l.components.begin(), l.components.end(), [](const tpa_component& c) { return c.genus == 1; }),
        1);
  }
}

// Steps, remeshing, smoothing and adapting in a row.
void ExpectListedAfterEachCommit(uint64_t first, uint64_t last, size_t least) {
  size_t merged = 0, came_apart = 0;
  for (uint64_t seed = first; seed <= last; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Mesh scene = SomeBodies(random);
    tpa_config config = DefaultConfig(12 * VertexCount(scene));
    config.max_contacts = 1 << 13;
    config.max_cut_edges = config.max_pieces = 1 << 15;
    const Arena arena(config, scene);
    for (int round = 0; round < 12; ++round) {
      const Mesh before = MeshOf(*arena);
      if (before.positions.empty()) break;
      const size_t count = ComponentsOf(*arena).components.size();
      tpa_issue issue;
      tpa_status status = TPA_OK;
      if (round % 4 == 3) {
        auto even = Sized<tpa_remesh_options>();
        even.iterations = 2;
        even.target_length = .3;
        even.relaxation = .3;
        status = tpa_remesh(*arena, &even, nullptr, nullptr, &issue);
      } else {
        const Point place = PositionOf(before, random() % VertexCount(before)), way = RandomPoint(random, -1, 1);
        const bool pinch = random() % 2 == 0;
        const Mesh target = Mapped(before, [&](Point p) {
          const double far = pinch ? std::abs(p[2] - place[2]) / .2 : Distance(p, place) / .5;
          for (size_t k = 0; k < 3 && far < 1; ++k)
            if (!pinch)
              p[k] += (1 - far) * way[k];
            else if (k < 2 && std::abs(p[k] - place[k]) < 1)
              p[k] = place[k] + (far - .3 * (1 - far)) * (p[k] - place[k]);
          return p;
        });
        ASSERT_EQ(MoveAll(*arena, target.positions), TPA_OK);
        status = tpa_step(*arena, nullptr, nullptr, &issue);
      }
      if (status == TPA_E_LIMIT) break;  // crumpled beyond the room given here
      ASSERT_EQ(status, TPA_OK) << Text(issue);
      ExpectListed(*arena);
      ExpectAncestors(*arena, before);
      const size_t now = ComponentsOf(*arena).components.size();
      merged += now < count ? 1u : 0u;
      came_apart += now > count ? 1u : 0u;
      ASSERT_FALSE(testing::Test::HasFailure()) << "round " << round;
      auto validation = Sized<tpa_validation>();
      ASSERT_EQ(tpa_validate(*arena, nullptr, &validation, nullptr), TPA_OK);
      ExpectAncestors(*arena, before);  // validating forgets nothing
    }
    const auto all = Sized<tpa_smooth_options>();
    ASSERT_EQ(tpa_smooth(*arena, &all, nullptr, nullptr, nullptr), TPA_OK);
    ExpectListed(*arena);
    ExpectItself(*arena);
  }
  EXPECT_GE(merged, least);
  EXPECT_GE(came_apart, least / 2);
}

TEST(Components, AreListedAfterEachCommit) { ExpectListedAfterEachCommit(3, 2 + Share(2u), Least(2u)); }
TEST(ComponentsLong, AreListedAfterEachCommit) { ExpectListedAfterEachCommit(5, 8, 4); }

TEST(Components, OfATangleComeFromTheBodiesThatMadeIt) {
  for (uint64_t seed = 1; seed <= Share(10u); ++seed) {
    Random random(seed);
    std::vector<Mesh> balls;
    for (int i = 0; i < 8; ++i) balls.push_back(Sphere(RandomPoint(random, -1, 1), Uniform(random, .3, .7), 4));
    const Mesh before = Renumbered(Together(balls), random);
    const Arena arena(DefaultConfig(4 * VertexCount(before)), before);
    ASSERT_EQ(tpa_adapt(*arena, nullptr, nullptr, nullptr), TPA_OK);
    ExpectListed(*arena);
    ExpectAncestors(*arena, before);
  }
}

// A failing call changes nothing, whatever it has used for its work.
TEST(Components, OutlastFailures) {
  Random random(1);
  const Mesh m = SomeBodies(random);
  tpa_config config = ConfigFor(m);
  config.max_vertices = VertexCount(m) + 8;
  config.max_components = 6;
  const Arena arena(config, m);
  const Listed known = ComponentsOf(*arena);
  const auto expect_known = [&] {
    ExpectListed(*arena);
    EXPECT_EQ(ComponentsOf(*arena).labels, known.labels);
  };
  auto fine = Sized<tpa_remesh_options>();
  fine.iterations = 3;
  fine.target_length = .02;
  EXPECT_EQ(tpa_remesh(*arena, &fine, nullptr, nullptr, nullptr), TPA_E_LIMIT);
  expect_known();
  Mesh open = Sphere({0, 0, 0}, 1, 3);
  open.triangles.resize(open.triangles.size() - 3);
  EXPECT_EQ(Load(*arena, open), TPA_E_MESH);
  expect_known();
  std::vector<Mesh> many;
  for (int i = 0; i < 7; ++i) many.push_back(Sphere({3.0 * i, 0, 0}, 1, 1));
  EXPECT_EQ(Load(*arena, Together(many)), TPA_E_LIMIT);
  expect_known();
}

TEST(Components, ASplitNamesAllPieces) {
  const Mesh before = Pinched(.5, 3, 12);
  const Arena arena(DefaultConfig(4 * VertexCount(before)), before);
  ASSERT_EQ(tpa_adapt(*arena, nullptr, nullptr, nullptr), TPA_OK);
  const Listed l = ComponentsOf(*arena);
  ASSERT_GT(l.components.size(), 2u);
  std::vector<uint32_t> named, ids;
  for (const tpa_event& e : EventsOf(*arena)) {
    if (e.type != TPA_EVENT_SPLIT) continue;
    EXPECT_EQ(e.amount, l.components.size());
    EXPECT_EQ(e.before, 0u);
    named.push_back(e.after);
  }
  for (const tpa_component& c : l.components) ids.push_back(c.id);
  EXPECT_EQ(named, ids);
}

TEST(Components, RefuseWhatTheyCannotFill) {
  Random random(1);
  const Mesh m = SomeBodies(random);
  const Arena arena(ConfigFor(m));
  tpa_issue issue;
  uint32_t count = 0, *labels = nullptr;
  tpa_component few[5] = {};
  few[0].id = 77;
  EXPECT_EQ(tpa_components(*arena, nullptr, 0, labels, &count, &issue), TPA_E_STATE);
  ASSERT_EQ(Load(*arena, m), TPA_OK);
  EXPECT_EQ(tpa_components(nullptr, nullptr, 0, labels, &count, &issue), TPA_E_CONTEXT);
  EXPECT_EQ(tpa_components(*arena, nullptr, 1, labels, &count, &issue), TPA_E_ARGUMENT);
  EXPECT_EQ(issue.argument, 2);
  EXPECT_EQ(tpa_components(*arena, few, 5, labels, nullptr, &issue), TPA_E_ARGUMENT);
  EXPECT_EQ(issue.argument, 5);
  std::vector<uint32_t> untouched(VertexCount(m), 99);
  EXPECT_EQ(tpa_components(*arena, few, 5, untouched.data(), &count, &issue), TPA_E_LIMIT);
  EXPECT_EQ(issue.limit, TPA_LIMIT_COMPONENTS);
  EXPECT_EQ(issue.needed, 6u);
  EXPECT_EQ(issue.available, 5u);
  EXPECT_EQ(count, 6u);
  EXPECT_EQ(few[0].id, 77u);
  EXPECT_EQ(untouched, std::vector<uint32_t>(VertexCount(m), 99));
}

}  // namespace
}  // namespace components_test
