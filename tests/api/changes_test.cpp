// SPDX-License-Identifier: MIT
// tpa_changes against the meshes before and after, id by id.
#include <vector>

#include "oracle/commit_oracle.h"
#include "support/random_commits.h"
#include "support/share.h"
#include "support/state_support.h"

namespace changes_test {
namespace {

using namespace support;

struct Ranges {
  tpa_change_list list = Sized<tpa_change_list>();
  std::vector<tpa_range> vertices, triangles;
};

Ranges ChangesOf(const tpa_context* context, uint32_t gap, uint32_t capacity) {
  Ranges r;
  r.vertices.resize(capacity), r.triangles.resize(capacity);
  r.list.gap = gap;
  r.list.vertex_capacity = r.list.triangle_capacity = capacity;
  r.list.vertices = r.vertices.data(), r.list.triangles = r.triangles.data();
  EXPECT_EQ(tpa_changes(context, &r.list, nullptr), TPA_OK);
  r.vertices.resize(r.list.vertex_ranges), r.triangles.resize(r.list.triangle_ranges);
  return r;
}

std::vector<std::pair<uint32_t, uint32_t>> Pairs(const std::vector<tpa_range>& ranges) {
  std::vector<std::pair<uint32_t, uint32_t>> pairs;
  for (const tpa_range& r : ranges) pairs.emplace_back(r.first, r.first + r.count - 1);
  return pairs;
}

template <class Number>
void Upload(const std::vector<tpa_range>& ranges, const std::vector<Number>& from, std::vector<Number>& to) {
  to.resize(from.size());
  for (const tpa_range& r : ranges) {
    ASSERT_LE(3 * (size_t{r.first} + r.count), from.size());
    std::copy_n(from.begin() + 3 * r.first, 3 * r.count, to.begin() + 3 * r.first);
  }
}

TEST(Changes, AreWhatTheMeshesTell) {
  size_t few = 0, none = 0, renumbered = 0;
  for (uint64_t seed = 1; seed <= Share(20u); ++seed)
    PlayRandomCommits(seed, 8, [&](tpa_context* context, const RandomCommit& commit) {
      const Mesh after = MeshOf(context);
      const std::vector<uint32_t> vertices = Differing(commit.before.positions, after.positions);
      const std::vector<uint32_t> triangles = Differing(commit.before.triangles, after.triangles);
      for (uint32_t gap : {0u, 1u, 7u, TPA_NONE}) {
        const Ranges exact = ChangesOf(context, gap, TriangleCount(after) + 1);
        ASSERT_EQ(Pairs(exact.vertices), Joined(vertices, gap)) << commit.kind;
        ASSERT_EQ(Pairs(exact.triangles), Joined(triangles, gap)) << commit.kind;
        ASSERT_EQ(exact.list.changed_vertices, vertices.size());
        ASSERT_EQ(exact.list.changed_triangles, triangles.size());
        ASSERT_EQ(exact.list.old_vertex_count, VertexCount(commit.before));
        ASSERT_EQ(exact.list.old_triangle_count, TriangleCount(commit.before));
        ASSERT_EQ(exact.list.vertex_count, VertexCount(after));
        ASSERT_EQ(exact.list.triangle_count, TriangleCount(after));
      }
      for (uint32_t capacity : {1u, 2u, 5u}) {
        Mesh copy = commit.before;
        const Ranges fitted = ChangesOf(context, 0, capacity);
        ASSERT_LE(fitted.list.vertex_ranges, capacity);
        Upload(fitted.vertices, after.positions, copy.positions);
        Upload(fitted.triangles, after.triangles, copy.triangles);
        ASSERT_TRUE(Differing(copy.positions, after.positions).empty());
        ASSERT_EQ(copy.triangles, after.triangles);
      }
      few += !vertices.empty() && vertices.size() < VertexCount(after) / 4 ? 1u : 0u;
      none += triangles.empty() ? 1u : 0u;
      const std::vector<uint32_t> ids = OldToNewOf(context);
      for (uint32_t v = 0; v < ids.size(); ++v) renumbered += ids[v] != TPA_NONE && ids[v] != v ? 1u : 0u;
    });
  EXPECT_GT(few, Least(10u));
  EXPECT_GT(none, Least(5u));
  EXPECT_GT(renumbered, Least(100u));
}

TEST(Changes, AreEverythingAfterALoadAndNothingAfterAnEmptyStep) {
  const Mesh m = Sphere({0, 0, 0}, 1, 3);
  const Arena arena(ConfigFor(m), m);
  Ranges r = ChangesOf(*arena, 0, 4);
  EXPECT_EQ(Pairs(r.vertices), Joined(Differing({}, m.positions), 0));
  EXPECT_EQ(Pairs(r.triangles), Joined(Differing({}, m.triangles), 0));
  EXPECT_EQ(r.list.changed_vertices, VertexCount(m));
  ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
  r = ChangesOf(*arena, 0, 4);
  EXPECT_EQ(r.list.vertex_ranges + r.list.triangle_ranges + r.list.changed_vertices + r.list.changed_triangles, 0u);
}

TEST(Changes, AreCarriedIntoAGrownContextAndEverythingInARestoredOne) {
  const Mesh m = Sphere({0, 0, 0}, 1, 3);
  const Arena arena(ConfigFor(m), m);
  ASSERT_EQ(MoveSome(*arena, {3, 4, 9}, {0, 0, 0, .1, 0, 0, .2, 0, 0}), TPA_OK);
  ASSERT_EQ(tpa_adapt(*arena, nullptr, nullptr, nullptr), TPA_OK);
  ASSERT_EQ(MoveSome(*arena, {7}, {.7, .1, .1}), TPA_OK);
  ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
  const Ranges changes = ChangesOf(*arena, 0, 99);
  ASSERT_GT(changes.list.changed_vertices, 0u);
  ASSERT_LT(changes.list.changed_vertices, VertexCount(m));
  tpa_config config = ConfigFor(m);
  config.max_vertices *= 2;
  const Arena larger(config);
  tpa_context* grown = nullptr;
  ASSERT_EQ(tpa_grow(*arena, larger.block(), larger.size().bytes, &config, &grown, nullptr), TPA_OK);
  EXPECT_EQ(Pairs(ChangesOf(grown, 0, 99).vertices), Pairs(changes.vertices));
  EXPECT_EQ(Pairs(ChangesOf(grown, 0, 99).triangles), Pairs(changes.triangles));
  const Bytes bytes = SavedFrom(*arena);
  ASSERT_EQ(tpa_restore(grown, bytes.data(), bytes.size(), nullptr), TPA_OK);
  EXPECT_EQ(ChangesOf(grown, 0, 99).list.changed_vertices, VertexCount(MeshOf(grown)));
}

TEST(Changes, RefuseWrongArguments) {
  const Mesh m = Sphere({0, 0, 0}, 1, 3);
  const Arena arena(ConfigFor(m));
  auto list = Sized<tpa_change_list>();
  EXPECT_EQ(tpa_changes(*arena, &list, nullptr), TPA_E_STATE);
  ASSERT_EQ(Load(*arena, m), TPA_OK);
  EXPECT_EQ(tpa_changes(*arena, nullptr, nullptr), TPA_E_ARGUMENT);
  EXPECT_EQ(tpa_changes(nullptr, &list, nullptr), TPA_E_CONTEXT);
  list.vertex_capacity = 1;
  EXPECT_EQ(tpa_changes(*arena, &list, nullptr), TPA_E_ARGUMENT);
  list.vertex_capacity = 0;
  EXPECT_EQ(tpa_changes(*arena, &list, nullptr), TPA_OK);
  EXPECT_EQ(list.vertex_ranges, 0u);
  EXPECT_EQ(list.changed_vertices, VertexCount(m));
}

}  // namespace
}  // namespace changes_test
