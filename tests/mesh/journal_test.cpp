// SPDX-License-Identifier: MIT
// The journal: rollback restores the mesh after any edits, opposites included, though not saved.
#include "mesh/journal.h"

#include <array>
#include <cstring>
#include <numeric>

#include "mesh/component_changes.h"
#include "support/library_mesh.h"
#include "support/sample_meshes.h"
#include "support/share.h"
#include "support/support.h"

namespace journal_test {
namespace {

using namespace support;

constexpr uint32_t spare = 40;

// The whole mesh, byte for byte.
struct Copy {
  std::vector<tpa::Vec3> positions;
  std::vector<tpa::VertexOrigin> origins;
  std::vector<uint32_t> vertex_edge, corners, opposite, face_origins;

  explicit Copy(const EditedMesh& w)
      : positions(w.positions.begin(), w.positions.begin() + w.vertices),
        origins(w.origins.begin(), w.origins.begin() + w.vertices),
        vertex_edge(w.vertex_edge.begin(), w.vertex_edge.begin() + w.vertices),
        corners(w.corners.begin(), w.corners.begin() + 3 * w.faces),
        opposite(w.opposite.begin(), w.opposite.begin() + 3 * w.faces),
        face_origins(w.face_origins.begin(), w.face_origins.begin() + w.faces) {}
};

template <class T>
bool SameBytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

void ExpectSame(const Copy& now, const Copy& before, uint64_t seed) {
  EXPECT_TRUE(SameBytes(now.positions, before.positions)) << seed;
  EXPECT_TRUE(SameBytes(now.origins, before.origins)) << seed;
  EXPECT_EQ(now.vertex_edge, before.vertex_edge) << seed;
  EXPECT_EQ(now.corners, before.corners) << seed;
  EXPECT_EQ(now.opposite, before.opposite) << seed;
  EXPECT_EQ(now.face_origins, before.face_origins) << seed;
}

// Senseless edits, each legal for itself. Faces go, and others take over the slots; half-edges without a common vertex
// are linked, and the former partners left alone.
struct Edits {
  EditedMesh& w;
  Random& random;
  uint32_t counts[8] = {};

  uint32_t Upto(uint32_t n) { return static_cast<uint32_t>(random() % n); }
  uint32_t AnyVertex() { return Upto(w.e.mesh.vertex_count); }
  uint32_t LivingFace() {
    for (int i = 0; i < 100; ++i) {
      const uint32_t f = Upto(w.e.mesh.face_count);
      if (tpa::face_lives(w.e.mesh, f)) return f;
    }
    return tpa::none;
  }
  void DoOne() {
    const uint32_t kind = Upto(8), f = LivingFace(), g = LivingFace();
    if (f == tpa::none || g == tpa::none) return;
    ++counts[kind];
    const uint32_t h = 3 * f + Upto(3), k = 3 * g + Upto(3), v = AnyVertex();
    switch (kind) {
      case 0: tpa::delete_face(w.e, f); break;
      case 1: tpa::new_face(w.e, AnyVertex(), AnyVertex(), v, f); break;
      case 2: tpa::unlink(w.e, h); break;
      case 3: tpa::set_corner(w.e, h, v); break;
      case 4: tpa::set_vertex_edge(w.e, v, h); break;
      case 5: tpa::set_position(w.e, v, {1, 2, static_cast<double>(k)}); break;
      case 6:
        if (tpa::vertex_lives(w.e.mesh, v)) tpa::delete_vertex(w.e, v);
        tpa::new_vertex(w.e, {3, 4, 5}, {{AnyVertex(), v}, .5f});
        break;
      default:
        if (h != k) tpa::link(w.e, h, k);
    }
  }
};

uint32_t Count(const tpa::BitSet& set) {
  uint32_t count = 0;
  for ([[maybe_unused]] uint32_t id : set) ++count;
  return count;
}

TEST(Journal, RollbackBringsBackAllOfIt) {
  uint32_t counts[8] = {}, untouched = 0;
  for (uint64_t seed = 1; seed <= Share(400u); ++seed) {
    Random random(seed);
    EditedMesh w(seed % 2 == 0 ? Torus({}, 3, 1, 16, 10) : Sphere({}, 1, static_cast<int>(3 + seed % 3)), spare);
    const Copy before(w);
    for (int round = 0; round < 20; ++round) {
      Edits edits{w, random};
      const uint32_t most = 1 + edits.Upto(round % 4 == 0 ? 3 * w.faces : 12);
      for (uint32_t i = 0; i < most; ++i) edits.DoOne();
      for (int i = 0; i < 8; ++i) counts[i] += edits.counts[i];
      untouched += Count(w.e.journal.faces) < w.faces;
      tpa::rollback(w.e);
      ASSERT_EQ(w.e.mesh.vertex_count, w.vertices);
      ASSERT_EQ(w.e.mesh.face_count, w.faces);
      ExpectSame(Copy(w), before, seed);
      ASSERT_FALSE(HasFailure()) << "seed " << seed << ", round " << round;
      tpa::begin(w.e);
    }
  }
  for (const uint32_t count : counts) EXPECT_GT(count, Least(10000));
  EXPECT_GT(untouched, Least(2000));
}

// A face has changed if the slots of face and vertices were taken over, with the same numbers.
TEST(Journal, SlotsThatAreTakenOverHaveChanged) {
  EditedMesh w(Sphere({}, 1, 3));
  const uint32_t same = 0, changed = 5, taken_over = 10;
  tpa::touch_face(w.e, same);
  tpa::set_corner(w.e, 3 * changed, w.corners[3 * changed + 1]);
  const uint32_t* v = &w.corners[3 * taken_over];
  const std::array<uint32_t, 3> corners{v[0], v[1], v[2]};
  tpa::delete_face(w.e, taken_over);
  tpa::delete_vertex(w.e, corners[1]);
  ASSERT_EQ(tpa::new_vertex(w.e, {1, 2, 3}, {{corners[0], corners[2]}, .5f}), corners[1]);
  ASSERT_EQ(tpa::new_face(w.e, corners[0], corners[1], corners[2], tpa::none), taken_over);
  EXPECT_FALSE(tpa::is_changed(w.e, same));
  EXPECT_TRUE(tpa::is_changed(w.e, changed));
  EXPECT_TRUE(tpa::is_changed(w.e, taken_over));
}

// A commit that takes one of two balls. The map has no entry to spare, so what lies behind it belongs to others.
TEST(Journal, MapsAreResetToTheirEndAndNoFurther) {
  EditedMesh w(Together({Sphere({}, 1, 2), Sphere({5, 0, 0}, 1, 2)}));
  std::vector<uint32_t> map(w.vertices + 1), label(w.vertices);
  std::iota(map.begin(), map.end(), 0u);
  map.back() = tpa::none;
  const std::vector<uint32_t> identity = map;
  for (uint32_t f = 0; f < w.faces / 2; ++f) tpa::delete_face(w.e, f);
  for (uint32_t v = 0; v < w.vertices / 2; ++v) tpa::delete_vertex(w.e, v);
  tpa::commit(w.e, map.data(), label.data());
  ASSERT_EQ(w.e.mesh.vertex_count, w.vertices / 2);
  for (uint32_t v = 0; v < w.vertices; ++v) EXPECT_EQ(map[v] == tpa::none, v < w.vertices / 2) << v;
  tpa::forget_unmapped(w.e, map.data());
  tpa::begin(w.e);
  tpa::reset_map(w.e, map.data(), w.vertices);
  EXPECT_EQ(map, identity);
}

// Of three balls the first moves, the second goes, and the third takes the numbers of the second. What has its number
// still is in none of the sets that the next transaction begins with.
TEST(Journal, SetsOfMapsAreWhatHasAnotherNumber) {
  const Mesh ball = Sphere({}, 1, 2);
  EditedMesh w(Together({ball, Translated(ball, {5, 0, 0}), Translated(ball, {10, 0, 0})}));
  std::vector<uint32_t> map(w.vertices), label(w.vertices);
  std::iota(map.begin(), map.end(), 0u);
  const uint32_t n = VertexCount(ball), faces = TriangleCount(ball);
  for (uint32_t v = 0; v < n; ++v) tpa::set_position(w.e, v, 1.5 * w.positions[v]);
  for (uint32_t f = faces; f < 2 * faces; ++f) tpa::delete_face(w.e, f);
  for (uint32_t v = n; v < 2 * n; ++v) tpa::delete_vertex(w.e, v);
  tpa::commit(w.e, map.data(), label.data());
  ASSERT_EQ(w.e.mesh.vertex_count, 2 * n);
  const auto expect_second_ball = [&] {
    for (uint32_t v = 0; v < w.vertices; ++v) EXPECT_EQ(w.e.journal.vertices.contains(v), v >= n && v < 2 * n) << v;
    for (uint32_t f = 0; f < w.faces; ++f) EXPECT_EQ(w.e.journal.faces.contains(f), f >= faces && f < 2 * faces) << f;
  };
  tpa::forget_unmapped(w.e, map.data());
  expect_second_ball();
  w.e.journal.vertices.clear();
  w.e.journal.faces.clear();
  tpa::note_mapped(w.e, map.data());
  expect_second_ball();
}

}  // namespace
}  // namespace journal_test
