// SPDX-License-Identifier: MIT
// Closing holes among obstacles: holes are cut into spheres, and obstacles stand in the way of caps and handles. The
// judge tries each new triangle with each triangle of the mesh, and knows the first free candidate.
#include "surgery/close_holes.h"

#include <algorithm>
#include <map>
#include <set>

#include "detect/new_faces.h"
#include "support/candidates_support.h"
#include "support/share.h"
#include "support/support.h"
#include "support/transaction.h"

namespace close_holes_test {
namespace {

using namespace support;
using candidates_support::Faces;

using Corners = std::array<uint32_t, 3>;

Corners Rotated(Corners v) {
  std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
  return v;
}

// The vertices along the edge of a hole, in the order of the half-edges inside. Empty if the edge is more than one
// loop.
std::vector<uint32_t> RimOf(const Mesh& m, const std::vector<bool>& goes) {
  std::map<uint32_t, uint32_t> next;
  std::set<std::pair<uint32_t, uint32_t>> inner;
  for (uint32_t h = 0; h < m.triangles.size(); ++h)
    if (goes[h / 3]) inner.insert({m.triangles[h], m.triangles[h % 3 == 2 ? h - 2 : h + 1]});
  for (const auto& [from, to] : inner)
    if (inner.count({to, from}) == 0 && !next.insert({from, to}).second) return {};
  std::vector<uint32_t> rim;
  if (next.empty()) return rim;
  uint32_t v = next.begin()->first;
  do {
    rim.push_back(v);
    v = next[v];
  } while (v != rim[0] && rim.size() <= next.size());
  return rim.size() == next.size() ? rim : std::vector<uint32_t>{};
}

// A sphere with a hole of a certain half width, in radians, in a certain direction.
struct Hole {
  Mesh sphere;
  std::vector<bool> goes;     // by triangle
  std::vector<uint32_t> rim;  // vertices
};
Hole MakeHole(const Point& center, const Point& towards, double width, int parts, Random& random) {
  Hole hole;
  const double rough = 0.2 / parts;  // an eighth of an edge
  hole.sphere = Mapped(Sphere({0, 0, 0}, 1, parts), [&](const Point& p) {
    const double stretch = Uniform(random, 1 - rough, 1 + rough);
    return Point{center[0] + stretch * p[0], center[1] + stretch * p[1], center[2] + stretch * p[2]};
  });
  const auto is_within = [&](uint32_t v) {
    const Point p = PositionOf(hole.sphere, v);
    double dot = 0;
    for (size_t c = 0; c < 3; ++c) dot += (p[c] - center[c]) * towards[c];
    return dot > std::cos(width);
  };
  for (uint32_t f = 0; f < TriangleCount(hole.sphere); ++f) {
    const uint32_t* v = hole.sphere.triangles.data() + 3 * f;
    hole.goes.push_back(is_within(v[0]) && is_within(v[1]) && is_within(v[2]));
  }
  hole.rim = RimOf(hole.sphere, hole.goes);
  return hole;
}

// Holes and obstacles in the library's hands, ready for connect_piece().
struct Site : Transaction {
  std::vector<std::vector<uint32_t>> rims;

  Site(tpa_context* context, const std::vector<Hole>& holes) : Transaction(context) {
    uint32_t vertices = 0, faces = 0;
    for (const Hole& hole : holes) {
      for (uint32_t f = 0; f < hole.goes.size(); ++f) {
        if (!hole.goes[f]) continue;
        tpa::remove(w.near_faces, faces + f);
        tpa::delete_face(w.edit, faces + f);
      }
      rims.emplace_back();
      for (uint32_t v : hole.rim) rims.back().push_back(vertices + v);
      vertices += VertexCount(hole.sphere);
      faces += TriangleCount(hole.sphere);
    }
    for (uint32_t l = 0; l < rims.size(); ++l) AddLoop(l);
    w.clusters.pieces.push({0, static_cast<uint32_t>(rims.size())});
  }
  void AddLoop(uint32_t l) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> half_edge;
    for (uint32_t h = 0; h < 3 * w.edit.mesh.face_count; ++h)
      if (tpa::face_lives(w.edit.mesh, h / 3)) half_edge[{tpa::tail(w.edit.mesh, h), tpa::head(w.edit.mesh, h)}] = h;
    const uint32_t n = static_cast<uint32_t>(rims[l].size());
    w.clusters.loops.push({w.clusters.cuts.size, n, rims[l][0], 0, l});
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t v = rims[l][i];
      w.clusters.cuts.push({tpa::none, v, v, half_edge.at({rims[l][(i + 1) % n], v}), 1});
    }
  }
  // The mesh as the library has it, and the placed faces by their numbers there.
  Mesh Now(std::vector<uint32_t>& placed) const {
    const tpa::Mesh& m = w.edit.mesh;
    Mesh now;
    for (uint32_t v = 0; v < m.vertex_count; ++v)
      now.positions.insert(now.positions.end(), {m.position[v].x, m.position[v].y, m.position[v].z});
    const std::set<uint32_t> is_placed(w.closing.placed.begin(), w.closing.placed.end());
    for (uint32_t f = 0; f < m.face_count; ++f) {
      if (!tpa::face_lives(m, f)) continue;
      if (is_placed.count(f) != 0) placed.push_back(TriangleCount(now));
      now.triangles.insert(now.triangles.end(), m.corner + 3 * f, m.corner + 3 * f + 3);
    }
    return now;
  }
};

// Tests triangles against all others of a growing mesh, with boxes first.
struct Judge {
  Mesh mesh;

  bool Apart(uint32_t f, uint32_t g) const {
    for (size_t c = 0; c < 3; ++c) {
      double low[2] = {1e30, 1e30}, high[2] = {-1e30, -1e30};
      for (size_t i = 0; i < 6; ++i) {
        const double x = mesh.positions[3 * size_t{mesh.triangles[3 * size_t{i < 3 ? f : g} + i % 3]} + c];
        low[i / 3] = std::min(low[i / 3], x);
        high[i / 3] = std::max(high[i / 3], x);
      }
      if (high[0] < low[1] || high[1] < low[0]) return true;
    }
    return false;
  }
  bool IsFree(uint32_t f) const {
    for (uint32_t g = 0; g < TriangleCount(mesh); ++g)
      if (g != f && !Apart(f, g) && TrianglesMeet(mesh, f, g)) return false;
    return true;
  }
  // Are the faces free, of the mesh and of each other?
  bool AreFree(const std::vector<Corners>& faces) {
    const size_t before = mesh.triangles.size();
    for (const Corners& v : faces) mesh.triangles.insert(mesh.triangles.end(), v.begin(), v.end());
    bool free = true;
    for (uint32_t f = static_cast<uint32_t>(before / 3); free && f < TriangleCount(mesh); ++f) free = IsFree(f);
    mesh.triangles.resize(before);
    return free;
  }
};

// The first free candidate, with vertices of the mesh, or nothing; `best`: is it the best of all?
struct Asked {
  Judge judge;
  std::vector<uint32_t> vertex;
  std::map<Corners, bool> known;

  Corners Named(const tpa::FaceCorners& f) const { return {vertex[f.v[0]], vertex[f.v[1]], vertex[f.v[2]]}; }
  static bool Ask(void* caller, const tpa::FaceCorners& f) {
    Asked& a = *static_cast<Asked*>(caller);
    const Corners v = a.Named(f);
    const auto [at, is_new] = a.known.insert({Rotated(v), false});
    if (is_new) at->second = a.judge.AreFree({v});
    return at->second;
  }
};
std::set<Corners> FirstFree(const Mesh& mesh, const std::vector<std::vector<uint32_t>>& rims, bool& best) {
  Asked asked{{mesh}, {}, {}};
  candidates_support::Loops loops;
  for (const auto& rim : rims) {
    loops.emplace_back();
    for (uint32_t v : rim) {
      const Point p = PositionOf(mesh, v);
      loops.back().push_back({p[0], p[1], p[2]});
      asked.vertex.push_back(v);
    }
  }
  const auto first = [&](const tpa::CandidateOptions& options, uint32_t most) {
    candidates_support::Search search(loops, options);
    Faces faces;
    for (uint32_t i = 0; i < most && search.Next(faces); ++i) {
      std::vector<Corners> named;
      for (const tpa::FaceCorners& f : faces) named.push_back(asked.Named(f));
      if (!asked.judge.AreFree(named)) continue;
      std::set<Corners> rotated;
      for (const Corners& v : named) rotated.insert(Rotated(v));
      return rotated;
    }
    return std::set<Corners>{};
  };
  best = !first({}, 1).empty();
  return first({64, {Asked::Ask, &asked}}, 64);
}

struct Tally {
  int best = 0, later = 0;
};

void Close(const std::vector<Hole>& holes, const std::vector<Mesh>& obstacles, const std::string& name, Tally& tally) {
  std::vector<Mesh> parts;
  for (const Hole& hole : holes) {
    if (hole.rim.empty()) return;
    parts.push_back(hole.sphere);
  }
  parts.insert(parts.end(), obstacles.begin(), obstacles.end());
  const Mesh all = Together(parts);
  const Arena arena(ConfigFor(all), all);
  Site site(*arena, holes);
  std::vector<uint32_t> placed;
  bool best = false;
  const Mesh before = site.Now(placed);
  const std::set<Corners> expected = FirstFree(before, site.rims, best);
  tpa::Workspace& w = site.w;
  const tpa::PieceOutcome outcome = tpa::connect_piece(w.edit, w.near_faces, w.clusters, w.clusters.pieces[0], {64, {}},
                                                       tpa::Candidates::tested, w.closing);
  EXPECT_FALSE(outcome.trusted || outcome.out_of_faces);
  placed.clear();
  const Judge judge{site.Now(placed)};
  std::set<Corners> made;
  for (uint32_t f : placed) {
    const uint32_t* v = judge.mesh.triangles.data() + 3 * f;
    made.insert(Rotated({v[0], v[1], v[2]}));
    EXPECT_TRUE(judge.IsFree(f)) << Written(judge.mesh, name);
  }
  EXPECT_EQ(outcome.done, !made.empty());
  EXPECT_TRUE(expected.empty() || made == expected) << Written(judge.mesh, name);
  EXPECT_EQ(judge.mesh.triangles.size(), before.triangles.size() + 3 * made.size());
  if (!expected.empty()) ++(best ? tally.best : tally.later);
}

Mesh Obstacle(const Point& near, double away, Random& random) {
  Point p = near;
  for (double& x : p) x += Uniform(random, -away, away);
  return Sphere(p, Uniform(random, 0.02, 0.1), 1);
}

void CloseOne(double width, int parts, int obstacles, Random& random, const std::string& name, Tally& tally) {
  const Hole hole = MakeHole({0, 0, 0}, {0.6, 0, 0.8}, width, parts, random);
  std::vector<Mesh> in_the_way;
  for (int k = 0; k < obstacles; ++k) {
    const double middle = std::cos(width);
    in_the_way.push_back(Obstacle({0.6 * middle, 0, 0.8 * middle}, 0.5 * std::sin(width), random));
  }
  Close({hole}, in_the_way, name, tally);
}

TEST(CloseHoles, ACapIsTheFirstThatIsFree) {
  Random random(1);
  Tally tally;
  for (int i = 0; i < Share(300); ++i)
    CloseOne(Uniform(random, 0.3, 1.1), 8, i % 3, random, "cap-" + std::to_string(i), tally);
  EXPECT_GT(tally.best, Least(50));
  EXPECT_GT(tally.later, Least(20));
}

// Caps of more faces than one search serves; a good part of the cases also with few tests.
TEST(CloseHoles, ALongCapIsTheFirstThatIsFree) {
  Random random(3);
  Tally tally;
  const double width = 1.1;
  const int parts = 20;
  EXPECT_GT(MakeHole({0, 0, 0}, {0.6, 0, 0.8}, width, parts, random).rim.size(), tpa::largest_star + 2);
  for (int i = 0; i < std::max(24, Share(60)); ++i)
    CloseOne(width, parts, i % 3, random, "long-cap-" + std::to_string(i), tally);
  EXPECT_GT(tally.best, Least(4));
  EXPECT_GT(tally.later, Least(20));
}

TEST(CloseHoles, AHandleIsTheFirstThatIsFree) {
  Random random(2);
  Tally tally;
  for (int i = 0; i < Share(200); ++i) {
    const double apart = Uniform(random, 2.05, 2.3);
    const std::vector<Hole> holes{MakeHole({0, 0, 0}, {1, 0, 0}, Uniform(random, 0.4, 0.9), 8, random),
                                  MakeHole({apart, 0, 0}, {-1, 0, 0}, Uniform(random, 0.4, 0.9), 8, random)};
    std::vector<Mesh> obstacles;
    for (int k = i % 3; k > 0; --k) {
      const double turn = Uniform(random, 0, 6.3);
      obstacles.push_back(Obstacle({0.5 * apart, 0.6 * std::cos(turn), 0.6 * std::sin(turn)}, 0.1, random));
    }
    Close(holes, obstacles, "handle-" + std::to_string(i), tally);
  }
  EXPECT_GT(tally.best, Least(50));
  EXPECT_GT(tally.later, Least(20));
}

// A search without enough room gives no candidates, and a hole would stay open. More room than it takes would ask for a
// limit that no call needs.
TEST(CloseHoles, RoomIsEnoughForEachPieceWithCandidates) {
  std::vector<tpa::CutLoop> list(tpa::most_loops_joined);
  tpa::Clusters r;
  for (tpa::u32 n = 3; tpa::has_candidates(n, 1); ++n)
    for (tpa::u32 loops = 1; 3 * loops <= n && tpa::has_candidates(n, loops); ++loops) {
      for (tpa::CutLoop& loop : list) loop.count = 3;
      list[0].count = n - 3 * (loops - 1);
      r.loops = {list.data(), loops, loops};
      const tpa::u64 room = tpa::room_to_close(r, {0, loops}), faces = n + 2 * (loops - 1);
      ASSERT_EQ(room, n + (loops > 2 ? 2 * (loops - 2) : 0)) << n << " vertices in " << loops << " loops";
      const tpa::u64 wanted = faces * sizeof(tpa::FaceCorners) + tpa::candidate_scratch_bytes(n, loops);
      ASSERT_LE(wanted, tpa::closing_scratch_bytes(static_cast<tpa::u32>(room)))
          << n << " vertices in " << loops << " loops";
    }
}

}  // namespace
}  // namespace close_holes_test
