// SPDX-License-Identifier: MIT
// Snapping cuts: for all clusters, the cut leaves simple loops, and the outside as before. The judge knows
// triangles only.
#include "cut/snap_cuts.h"

#include <algorithm>
#include <map>
#include <set>

#include "support/cut_workbench.h"
#include "support/share.h"
#include "support/support.h"
#include "surgery/cut_and_sew.h"

namespace snap_cuts_test {
namespace {

using namespace support;

using Edge = std::pair<uint32_t, uint32_t>;

// Grown from some vertices at random, to all sides, or raggedly.
std::set<uint32_t> RandomClusters(const Mesh& m, Random& random) {
  std::vector<std::set<uint32_t>> neighbours(VertexCount(m));
  for (size_t h = 0; h < m.triangles.size(); ++h)
    for (size_t k = h / 3 * 3; k < h / 3 * 3 + 3; ++k)
      if (k != h) neighbours[m.triangles[h]].insert(m.triangles[k]);
  std::set<uint32_t> inside;
  for (uint64_t i = random() % 3 + 1; i > 0; --i) inside.insert(static_cast<uint32_t>(random() % VertexCount(m)));
  const uint64_t often = random() % 4 + 1;
  for (uint64_t rings = random() % 4; rings > 0; --rings) {
    const std::set<uint32_t> before = inside;
    for (const uint32_t v : before)
      for (const uint32_t u : neighbours[v])
        if (random() % often == 0) inside.insert(u);
  }
  return inside;
}

Mesh RandomMesh(Random& random) {
  switch (random() % 4) {
    case 0: return Renumbered(Sphere({0, 0, 0}, 1, 4), random);
    case 1: return Renumbered(Torus({0, 0, 0}, 1, .4, 14, 7), random);
    case 2: return Renumbered(Box({0, 0, 0}, {1, 1, 1}, 4), random);
    default: return ThinBody(random);
  }
}

// If cuts run out, their number is known, and no face keeps a mark: the next search finds all loops.
TEST(Loops, ThatDoNotFitLeaveNoMarks) {
  int tried = 0;
  for (uint64_t seed = 1; seed <= Share(200u); ++seed) {
    Random random(seed);
    const Mesh mesh = RandomMesh(random);
    Workbench w(mesh, RandomClusters(mesh, random));
    const uint32_t cuts = w.r.cuts.size, loops = w.r.loops.size;
    if (cuts == 0) continue;
    ++tried;
    const auto find = [&](uint32_t room) {
      w.r.cuts = {w.cuts.data(), room, 0};
      w.r.loops.clear();
      uint64_t needed = 0;
      EXPECT_EQ(tpa::find_loops(w.e.mesh, w.r, needed), room >= cuts) << "seed " << seed;
      EXPECT_EQ(needed, cuts) << "seed " << seed;
      EXPECT_EQ(std::count(w.walked.begin(), w.walked.end(), 0), static_cast<long>(w.faces)) << "seed " << seed;
    };
    find(static_cast<uint32_t>(random() % cuts));
    find(cuts);
    EXPECT_EQ(w.r.loops.size, loops) << "seed " << seed;
  }
  EXPECT_GT(tried, Least(100));
}

struct CutOpen {
  Workbench& w;
  const Mesh& m;
  const std::set<uint32_t>& inside;
  uint64_t seed;

  bool IsOld(uint32_t v) const { return v < w.vertices && !inside.contains(v) && tpa::is_old(w.e.mesh, v); }

  // All triangles outside are still there; all other triangles have a new vertex.
  void ExpectTheRestAsItWas() const {
    std::set<std::array<uint32_t, 3>> left;
    for (uint32_t f = 0; f < w.e.mesh.face_count; ++f) {
      if (!tpa::face_lives(w.e.mesh, f)) continue;
      const uint32_t* c = &w.corners[3 * f];
      if (IsOld(c[0]) && IsOld(c[1]) && IsOld(c[2])) left.insert({c[0], c[1], c[2]});
    }
    std::set<std::array<uint32_t, 3>> wanted;
    for (uint32_t f = 0; f < TriangleCount(m); ++f) {
      const uint32_t* c = &m.triangles[3 * f];
      if (!inside.contains(c[0]) && !inside.contains(c[1]) && !inside.contains(c[2])) wanted.insert({c[0], c[1], c[2]});
    }
    EXPECT_EQ(left, wanted) << "seed " << seed;
  }

  // Half-edges by their ends, each once; half-edges without an opposite lie on loops.
  void ExpectSimpleLoops() const {
    std::map<Edge, uint32_t> edges;
    for (uint32_t h = 0; h < 3 * w.e.mesh.face_count; ++h)
      if (tpa::face_lives(w.e.mesh, tpa::face_of(h))) {
        EXPECT_TRUE(edges.insert({{tpa::tail(w.e.mesh, h), tpa::head(w.e.mesh, h)}, h}).second) << "seed " << seed;
      }
    std::set<uint32_t> corners;
    std::set<Edge> borders;
    for (const tpa::CutLoop& loop : w.r.loops) {
      EXPECT_GE(loop.count, 3u) << "seed " << seed;
      for (uint32_t i = 0; i < loop.count; ++i) {
        const tpa::Cut& cut = w.r.cuts[loop.first + i];
        const Edge border = {w.r.cuts[loop.first + (i + 1) % loop.count].vertex, cut.vertex};
        EXPECT_TRUE(corners.insert(cut.vertex).second) << "vertex " << cut.vertex << " comes twice, seed " << seed;
        ASSERT_TRUE(edges.contains(border)) << "seed " << seed;
        EXPECT_EQ(edges[border], cut.border) << "seed " << seed;
        EXPECT_EQ(tpa::tail(w.e.mesh, w.vertex_edge[cut.vertex]), cut.vertex) << "seed " << seed;
        EXPECT_TRUE(tpa::face_lives(w.e.mesh, tpa::face_of(w.vertex_edge[cut.vertex]))) << "seed " << seed;
        borders.insert(border);
      }
    }
    for (const auto& [edge, h] : edges) {
      const auto back = edges.find({edge.second, edge.first});
      EXPECT_EQ(borders.contains(edge), back == edges.end()) << "seed " << seed;
      EXPECT_EQ(w.opposite[h], back == edges.end() ? tpa::none : back->second) << "seed " << seed;
      // New faces may join corners of loops, so no old edge may.
      if (corners.contains(edge.first) && corners.contains(edge.second)) {
        EXPECT_TRUE(borders.contains(edge) || borders.contains({edge.second, edge.first})) << "seed " << seed;
      }
    }
  }

  std::map<uint32_t, tpa::Vec3> Snapped() const {
    std::map<uint32_t, tpa::Vec3> snapped;
    for (const tpa::CutLoop& loop : w.r.loops)
      for (uint32_t i = 0; i < loop.count; ++i)
        if (const tpa::Cut& cut = w.r.cuts[loop.first + i]; tpa::is_snapped(cut))
          snapped[cut.vertex] = w.r.middle[loop.first + i];
    return snapped;
  }

  // The noted middle is the mean over all edges from the vertex into the clusters.
  void ExpectMiddles() const {
    for (const tpa::CutLoop& loop : w.r.loops)
      for (uint32_t i = 0; i < loop.count; ++i) {
        const tpa::Cut& cut = w.r.cuts[loop.first + i];
        if (!tpa::is_snapped(cut)) continue;
        std::set<uint32_t> ends;
        for (size_t h = 0; h < m.triangles.size(); ++h)
          for (size_t k = h / 3 * 3; k < h / 3 * 3 + 3; ++k)
            if (m.triangles[h] == cut.vertex && inside.contains(m.triangles[k])) ends.insert(m.triangles[k]);
        Point sum{};
        for (const uint32_t v : ends) sum = Sum(sum, Scaled(1. / static_cast<double>(ends.size()), PositionOf(m, v)));
        const Point middle = Scaled(.5, Sum(sum, PositionOf(m, cut.vertex)));
        const tpa::Vec3& noted = w.r.middle[loop.first + i];
        EXPECT_NEAR(Distance(middle, {noted.x, noted.y, noted.z}), 0, 1e-14) << "seed " << seed;
      }
  }
};

TEST(SnapCuts, LeavesSimpleLoopsRoundAllClusters) {
  size_t snapped = 0, made = 0;
  for (uint64_t seed = 1; seed <= Share(3000u); ++seed) {
    Random random(seed);
    const Mesh m = RandomMesh(random);
    const std::set<uint32_t> inside = RandomClusters(m, random);
    Workbench w(m, inside);
    tpa::snap_cuts(w.e.mesh, w.r, w.vertex_marks.data());
    ASSERT_TRUE(tpa::cut(w.e, w.g, w.r));
    const CutOpen judge{w, m, inside, seed};
    judge.ExpectTheRestAsItWas();
    judge.ExpectSimpleLoops();
    judge.ExpectMiddles();
    for (const tpa::CutLoop& loop : w.r.loops)
      for (uint32_t i = 0; i < loop.count; ++i) ++(tpa::is_snapped(w.r.cuts[loop.first + i]) ? snapped : made);
    EXPECT_EQ(std::count(w.vertex_marks.begin(), w.vertex_marks.end(), 0), w.vertices) << "seed " << seed;
    // Pieces have loops in any order.
    std::shuffle(w.r.loops.begin(), w.r.loops.end(), random);
    const std::map<uint32_t, tpa::Vec3> wanted = judge.Snapped();
    std::map<uint32_t, tpa::Vec3> collected;
    const tpa::Span<const tpa::Cut> cuts = tpa::collect_snapped(w.r);
    for (uint32_t i = 0; i < cuts.size; ++i)
      EXPECT_TRUE(collected.insert({cuts[i].vertex, w.r.middle[i]}).second) << "seed " << seed;
    EXPECT_EQ(collected, wanted) << "seed " << seed;
    tpa::rollback(w.e);
    EXPECT_EQ(std::vector<uint32_t>(w.corners.begin(), w.corners.begin() + 3 * w.faces), m.triangles)
        << "seed " << seed;
    if (HasFailure()) return;
  }
  EXPECT_GT(snapped, Least<size_t>(10000));
  EXPECT_GT(made, Least<size_t>(10000));
}

// Round cuts on an even mesh need no new vertices.
TEST(SnapCuts, MakesNoVerticesRoundAnEvenDisc) {
  const Mesh m = Sphere({0, 0, 0}, 1, 12);
  for (const double radius : {.05, .2, .4, .8}) {
    std::set<uint32_t> inside;
    for (uint32_t v = 0; v < VertexCount(m); ++v)
      if (Distance(PositionOf(m, v), Scaled(1 / Length({1, 2, 3}), {1, 2, 3})) < radius) inside.insert(v);
    if (inside.empty()) inside.insert(0);
    Workbench w(m, inside);
    tpa::snap_cuts(w.e.mesh, w.r, w.vertex_marks.data());
    ASSERT_TRUE(tpa::cut(w.e, w.g, w.r));
    EXPECT_EQ(w.e.mesh.vertex_count, VertexCount(m)) << radius;
  }
}

}  // namespace
}  // namespace snap_cuts_test
