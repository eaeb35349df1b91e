// SPDX-License-Identifier: MIT
// tpa_reorder: the order against one worked out bit by bit, and all later results against those of the same mesh
// loaded with its new numbers.
#include <algorithm>
#include <numeric>

#include "support/field_shapes.h"
#include "support/random_commits.h"
#include "support/share.h"
#include "support/state_support.h"

namespace reorder_test {
namespace {

using namespace support;

// The place on the curve of each vertex, in a cube round the mesh with 2^21 cells along each axis.
std::vector<uint64_t> PlacesOnCurve(const Mesh& m) {
  Point low = PositionOf(m, 0), high = low;
  for (size_t v = 0; v < VertexCount(m); ++v)
    for (size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], PositionOf(m, v)[k]);
      high[k] = std::max(high[k], PositionOf(m, v)[k]);
    }
  const double side = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  std::vector<uint64_t> places;
  for (size_t v = 0; v < VertexCount(m); ++v) {
    uint64_t place = 0;
    for (uint64_t bit = 0; bit < 21; ++bit)
      for (size_t k = 0; k < 3; ++k) {
        const double cell = side > 0 ? (PositionOf(m, v)[k] - low[k]) * (2097152 / side) : 0;
        const uint64_t whole = std::min<uint64_t>(static_cast<uint64_t>(cell), 2097151);
        place |= (whole >> bit & 1) << (3 * bit + k);
      }
    places.push_back(place);
  }
  return places;
}

template <class Key>
std::vector<uint32_t> SortedBy(const std::vector<Key>& key) {
  std::vector<uint32_t> order(key.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key[a] < key[b]; });
  return order;
}

struct Reordered {
  Mesh mesh;
  std::vector<uint32_t> new_vertex, old_triangle;
};

Reordered InSpaceOrder(const Mesh& m) {
  Reordered r;
  const std::vector<uint32_t> old_vertex = SortedBy(PlacesOnCurve(m));
  r.new_vertex.resize(old_vertex.size());
  for (uint32_t v = 0; v < old_vertex.size(); ++v) {
    r.new_vertex[old_vertex[v]] = v;
    const Point p = PositionOf(m, old_vertex[v]);
    r.mesh.positions.insert(r.mesh.positions.end(), p.begin(), p.end());
  }
  std::vector<uint32_t> first;
  for (size_t f = 0; f < TriangleCount(m); ++f)
    first.push_back(std::min({r.new_vertex[m.triangles[3 * f]], r.new_vertex[m.triangles[3 * f + 1]],
                              r.new_vertex[m.triangles[3 * f + 2]]}));
  r.old_triangle = SortedBy(first);
  for (const uint32_t f : r.old_triangle)
    for (size_t i = 0; i < 3; ++i) r.mesh.triangles.push_back(r.new_vertex[m.triangles[3 * size_t{f} + i]]);
  return r;
}

void ExpectOrder(const tpa_context* context, const Mesh& before) {
  const Reordered expected = InSpaceOrder(before);
  const Mesh now = MeshOf(context);
  ASSERT_EQ(now.positions, expected.mesh.positions);
  ASSERT_EQ(now.triangles, expected.mesh.triangles);
  ASSERT_EQ(OldToNewOf(context), expected.new_vertex);
  ASSERT_EQ(TriangleOriginsOf(context), expected.old_triangle);
  const std::vector<tpa_vertex_origin> origins = VertexOriginsOf(context);
  for (uint32_t v = 0; v < origins.size(); ++v) {
    ASSERT_EQ(expected.new_vertex[origins[v].parents[0]], v);
    ASSERT_EQ(origins[v].parents[1], TPA_NONE);
    ASSERT_EQ(origins[v].weight, 1.0f);
  }
}

uint32_t ChangedElements(const tpa_context* context) {
  auto list = Sized<tpa_change_list>();
  EXPECT_EQ(tpa_changes(context, &list, nullptr), TPA_OK);
  return list.changed_vertices + list.changed_triangles;
}

TEST(Reorder, FollowsTheCurve) {
  size_t commits = 0;
  for (uint64_t seed = 1; seed <= Share(20u); ++seed)
    PlayRandomCommits(seed, 8, [&](tpa_context* context, const RandomCommit& commit) {
      if (commit.kind != "reorder") return;
      ExpectOrder(context, commit.before);
      ++commits;
    });
  EXPECT_GT(commits, Share(5u));
}

TEST(Reorder, IsACommitWithoutEvents) {
  const Mesh m = Together({Sphere({0, 0, 0}, 1, 6), Sphere({1.5, 0, 0}, 1, 6), Sphere({9, 9, 9}, 1, 3)});
  const Arena arena(ConfigFor(m), m);
  ASSERT_EQ(tpa_adapt(*arena, nullptr, nullptr, nullptr), TPA_OK);
  const Mesh before = MeshOf(*arena);
  auto view = Sized<tpa_mesh_view>();
  ASSERT_EQ(tpa_view(*arena, &view), TPA_OK);
  const uint64_t epoch = view.epoch;
  ASSERT_EQ(MoveSome(*arena, {3}, {4, 4, 4}), TPA_OK);
  ASSERT_FALSE(EventsOf(*arena).empty());
  std::vector<tpa_component> old(2), now(2);
  uint32_t count = 0;
  ASSERT_EQ(tpa_components(*arena, old.data(), 2, nullptr, &count, nullptr), TPA_OK);
  ASSERT_EQ(count, 2u);

  ASSERT_EQ(tpa_reorder(*arena, nullptr), TPA_OK);
  ExpectOrder(*arena, before);
  ASSERT_EQ(tpa_view(*arena, &view), TPA_OK);
  EXPECT_GT(view.epoch, epoch);
  EXPECT_TRUE(EventsOf(*arena).empty());
  EXPECT_EQ(tpa_targets(*arena, nullptr, nullptr, 0, &count), TPA_OK);
  EXPECT_EQ(count, 0u);
  ASSERT_EQ(tpa_components(*arena, now.data(), 2, nullptr, &count, nullptr), TPA_OK);
  for (const tpa_component& c : now) {
    const auto same = std::find_if(old.begin(), old.end(), [&](const tpa_component& o) { return o.id == c.before; });
    ASSERT_NE(same, old.end());
    EXPECT_EQ(c.vertices, same->vertices);
    EXPECT_EQ(c.genus, same->genus);
    EXPECT_TRUE(std::equal(c.box, c.box + 6, same->box));
  }
}

TEST(Reorder, ASecondCallChangesNothing) {
  Random random(1);
  const Mesh m = Renumbered(Torus({0, 0, 0}, 2, .5, 30, 12), random);
  const Arena arena(ConfigFor(m), m);
  ASSERT_EQ(tpa_reorder(*arena, nullptr), TPA_OK);
  EXPECT_GT(ChangedElements(*arena), VertexCount(m));
  const Mesh once = MeshOf(*arena);
  ASSERT_EQ(tpa_reorder(*arena, nullptr), TPA_OK);
  EXPECT_EQ(MeshOf(*arena).positions, once.positions);
  EXPECT_EQ(MeshOf(*arena).triangles, once.triangles);
  EXPECT_EQ(ChangedElements(*arena), 0u);
}

// Steps and sweeps go on as from a load of the renumbered mesh.
TEST(Reorder, GoesOnAsAfterALoad) {
  for (uint64_t seed = 1; seed <= Share(6u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Mesh scene = RandomScene(random);
    tpa_config config = DefaultConfig(12 * VertexCount(scene) + 2000);
    config.max_contacts = config.max_cut_edges = 1 << 14;
    config.max_pieces = 1 << 17;
    const Arena arena(config, scene);
    ASSERT_EQ(tpa_adapt(*arena, nullptr, nullptr, nullptr), TPA_OK);
    ASSERT_EQ(tpa_reorder(*arena, nullptr), TPA_OK);
    const Mesh renumbered = MeshOf(*arena);
    if (renumbered.positions.empty()) continue;
    const Arena fresh(config, renumbered);
    auto sweeps = Sized<tpa_remesh_options>();
    sweeps.iterations = 2;
    sweeps.target_length = MeanEdgeOf(renumbered);
    sweeps.relaxation = .5;
    Mesh moved[2];
    for (size_t i = 0; i < 2; ++i) {
      tpa_context* const context = i == 0 ? *arena : *fresh;
      moved[i] = MeshOf(context);
      for (double& x : moved[i].positions) x *= x < 0 ? .9 : 1.1;
      ASSERT_EQ(MoveAll(context, moved[i].positions), TPA_OK);
      ASSERT_EQ(tpa_step(context, nullptr, nullptr, nullptr), TPA_OK);
      ASSERT_EQ(tpa_remesh(context, &sweeps, nullptr, nullptr, nullptr), TPA_OK);
      moved[i] = MeshOf(context);
    }
    EXPECT_EQ(moved[0].positions, moved[1].positions);
    EXPECT_EQ(moved[0].triangles, moved[1].triangles);
  }
}

TEST(Reorder, ATangleStaysOne) {
  const Mesh m = Together({Sphere({0, 0, 0}, 1, 4), Sphere({1.2, 0, 0}, 1, 4)});
  const Arena arena(ConfigFor(m), m);
  ASSERT_EQ(tpa_reorder(*arena, nullptr), TPA_OK);
  ExpectOrder(*arena, m);
  EXPECT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_E_TANGLED);
  ASSERT_EQ(tpa_adapt(*arena, nullptr, nullptr, nullptr), TPA_OK);
  auto validation = Sized<tpa_validation>();
  ASSERT_EQ(tpa_validate(*arena, nullptr, &validation, nullptr), TPA_OK);
  EXPECT_EQ(validation.components, 1u);
}

// All vertices in one place are in the order that they were.
TEST(Reorder, WithoutExtentKeepsTheNumbers) {
  Mesh m = Sphere({0, 0, 0}, 1, 2);
  std::fill(m.positions.begin(), m.positions.end(), 3.0);
  const Arena arena(ConfigFor(m), m);
  ASSERT_EQ(tpa_reorder(*arena, nullptr), TPA_OK);
  ExpectOrder(*arena, m);
}

TEST(Reorder, AtTheEndsOfTheRange) {
  for (const double scale : {1e-25, 1e25}) {
    Random random(7);
    Mesh m = Renumbered(Sphere({1, 2, 3}, 1, 6), random);
    for (double& x : m.positions) x *= scale;
    const Arena arena(ConfigFor(m), m);
    ASSERT_EQ(tpa_reorder(*arena, nullptr), TPA_OK) << scale;
    ExpectOrder(*arena, m);
  }
}

}  // namespace
}  // namespace reorder_test
