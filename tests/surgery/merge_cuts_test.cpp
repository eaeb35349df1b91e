// SPDX-License-Identifier: MIT
// Local refinement taken back: random holes are cut into a sphere and closed by caps. The judge knows, from the
// triangles before, which ends outside have a whole face left.
#include "surgery/merge_cuts.h"

#include <map>
#include <set>

#include "support/share.h"
#include "support/support.h"
#include "support/transaction.h"
#include "surgery/close_holes.h"

namespace merge_cuts_test {
namespace {

using namespace support;

// Vertices are removed, and each loop of cuts is closed by a cap, before the cuts are merged.
struct Site : Transaction {
  bool closed = true;

  Site(tpa_context* context, const std::vector<uint32_t>& goes) : Transaction(context) {
    tpa::Clusters& r = w.clusters;
    for (uint32_t v : goes) {
      r.cluster[v] = goes[0];
      r.members.push(v);
    }
    uint64_t needed = 0;
    EXPECT_TRUE(tpa::find_loops(w.edit.mesh, r, needed));
    EXPECT_TRUE(tpa::cut(w.edit, w.near_faces, r));
    for (uint32_t l = 0; l < r.loops.size; ++l) {
      const tpa::Piece piece{l, 1};
      closed = closed && tpa::can_be_closed(r, piece) &&
               tpa::connect_piece(w.edit, w.near_faces, r, piece, {64, {}}, tpa::Candidates::tested, w.closing).done;
    }
  }
  Mesh Now() const {
    const tpa::Mesh& m = w.edit.mesh;
    Mesh now;
    std::vector<uint32_t> number(m.vertex_count, tpa::none);
    for (uint32_t v = 0; v < m.vertex_count; ++v) {
      if (!tpa::vertex_lives(m, v)) continue;
      number[v] = VertexCount(now);
      now.positions.insert(now.positions.end(), {m.position[v].x, m.position[v].y, m.position[v].z});
    }
    for (uint32_t h = 0; h < 3 * m.face_count; ++h)
      if (tpa::face_lives(m, h / 3)) now.triangles.push_back(number[m.corner[h]]);
    return now;
  }
  Point At(uint32_t v) const {
    const tpa::Vec3& p = w.edit.mesh.position[v];
    return {p.x, p.y, p.z};
  }
};

// An end outside, as it is before the cuts are merged.
struct End {
  Point at;
  bool has_whole_face = false;
  std::vector<uint32_t> cuts;  // places in the list
};
std::map<uint32_t, End> EndsOf(const Site& site) {
  const tpa::Mesh& m = site.w.edit.mesh;
  const tpa::Stack<tpa::Cut>& cuts = site.w.clusters.cuts;
  std::set<uint32_t> made;
  std::map<uint32_t, End> ends;
  for (uint32_t i = 0; i < cuts.size; ++i) {
    made.insert(cuts[i].vertex);
    ends[cuts[i].outside].at = site.At(cuts[i].outside);
    ends[cuts[i].outside].cuts.push_back(i);
  }
  for (uint32_t f = 0; f < m.face_count; ++f) {
    const uint32_t* v = m.corner + 3 * f;
    if (!tpa::face_lives(m, f) || made.count(v[0]) + made.count(v[1]) + made.count(v[2]) > 0) continue;
    for (uint32_t i = 0; i < 3; ++i)
      if (const auto end = ends.find(v[i]); end != ends.end()) end->second.has_whole_face = true;
  }
  return ends;
}

struct Tally {
  int merged = 0, refused = 0, left = 0;
};

void MergeWithout(const Mesh& m, const std::vector<uint32_t>& goes, Tally& tally) {
  const Arena arena(DefaultConfig(4 * VertexCount(m) + 1000), m);
  Site site(*arena, goes);
  if (!site.closed) return;
  const std::map<uint32_t, End> ends = EndsOf(site);
  std::vector<Point> made;
  for (const tpa::Cut& cut : site.w.clusters.cuts) made.push_back(site.At(cut.vertex));
  const Topology before = TopologyOf(site.Now());
  tpa::Workspace& w = site.w;
  tpa::merge_cuts(w.edit, w.near_faces, w.clusters, w.relocation.vertex_mark, w.relocation.face_mark);
  for (const auto& [v, end] : ends) {
    Point sum{};
    double merged = 0;
    for (uint32_t i : end.cuts) {
      if (w.clusters.cuts[i].vertex != tpa::none) continue;
      sum = Sum(sum, made[i]);
      ++merged;
    }
    const Point wanted = merged == 0 ? end.at : Scaled(1 / merged, sum);
    EXPECT_LT(Distance(site.At(v), wanted), 1e-14) << v;
    EXPECT_TRUE(end.has_whole_face || merged == 0) << v;
    ++(!end.has_whole_face ? tally.left : merged > 0 ? tally.merged : tally.refused);
  }
  const Mesh after = site.Now();
  const Topology now = TopologyOf(after);
  EXPECT_EQ(now.defect, "");
  EXPECT_EQ(now.Genera(), before.Genera());
  EXPECT_TRUE(AllMeetingPairs(after).empty());
  for (uint32_t v = 0; v < w.edit.mesh.vertex_count; ++v) EXPECT_EQ(w.relocation.vertex_mark[v], 0);
}

// Among the vertices that stay are lone ones, chains and spits, without a whole face.
TEST(MergeCuts, MovesEndsOutsideThatHaveAWholeFaceLeft) {
  Tally tally;
  for (uint64_t seed = 1; seed <= Share(60u); ++seed) {
    Random random(seed);
    const Mesh m =
        Mapped(Sphere({0, 0, 0}, 1, 5), [&](const Point& p) { return Scaled(Uniform(random, .97, 1.03), p); });
    const double share = Uniform(random, .1, .8);
    std::vector<uint32_t> goes;
    for (uint32_t v = 0; v < VertexCount(m); ++v)
      if (Uniform(random, 0, 1) < share) goes.push_back(v);
    MergeWithout(m, goes, tally);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  EXPECT_GT(tally.merged, Least(200));
  EXPECT_GT(tally.left, Least(200));
}

}  // namespace
}  // namespace merge_cuts_test
