// SPDX-License-Identifier: MIT
// many_pairs: pairs of spheres that meet in one step of all vertices, an island each.
#pragma once

#include "stepping.h"
#include "tool/scenes/sphere.h"

namespace bench {

struct ManyPairs {
  Mesh mesh;
  std::vector<double> side;  // of each vertex: 1 or -1, and the other sphere of the pair lies the other way along x
  double edge = 0;
};

inline constexpr double pairs_apart = 4, pair_gap = 0.5, pair_overlap = 1;  // radii; edges before and after the step

inline ManyPairs MakePairs(uint32_t vertices, int pairs) {
  const int parts = PartsFor(vertices / static_cast<uint32_t>(2 * pairs));
  ManyPairs s;
  s.edge = MeanEdge(tool::make_sphere({0, 0, 0}, 1, parts));
  for (int i = 0; i < pairs; ++i)
    for (const double side : {-1., 1.}) {
      const double middle[3] = {side * (1 + pair_gap / 2 * s.edge), i % 7 * pairs_apart, i / 7 * pairs_apart};
      Append(s.mesh, tool::make_sphere(middle, 1, parts), false);
      s.side.resize(VertexCount(s.mesh), side);
    }
  return s;
}

// Each vertex goes so many edges towards the other sphere.
inline std::vector<double> Towards(const ManyPairs& s, double edges) {
  std::vector<double> targets = s.mesh.positions;
  for (size_t v = 0; v < s.side.size(); ++v) targets[3 * v] -= s.side[v] * edges * s.edge;
  return targets;
}

// The way by which each pair meets.
inline constexpr double way_to_meet = (pair_gap + pair_overlap) / 2;

inline void MoveTo(const Arena& arena, const std::vector<double>& targets) {
  tpa_issue issue{};
  tpa_move_input move{};
  move.struct_size = sizeof move;
  move.count = static_cast<uint32_t>(targets.size() / 3);
  move.position_type = TPA_FLOAT64;
  move.positions = targets.data();
  Check(tpa_move(arena.context, &move, &issue), "tpa_move", issue);
}

}  // namespace bench
