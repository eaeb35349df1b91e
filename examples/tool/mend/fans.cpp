// SPDX-License-Identifier: MIT
#include "tool/mend/fans.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "tool/mend/edges.h"
#include "tool/mend/exact.h"

namespace tool {

namespace {

constexpr uint32_t nobody = UINT32_MAX;

// The triangles round an edge by their angle about the edge from its low to its high vertex, as seen by exact signs.
// The first triangle has the angle 0.
class Round {
 public:
  Round(const TriangleMesh& mesh, uint32_t first) : p_(mesh.positions.data()), mesh_(mesh), zero_(apex(mesh, first)) {
    std::tie(low_, high_) = std::minmax({tail(mesh, first), head(mesh, first)});
    // An axis along which the first triangle is seen with an area.
    for (int axis = 0; axis < 3; ++axis)
      if (turn(axis, zero_) != 0) axis_ = axis;
  }

  bool is_before(uint32_t f, uint32_t g) const {
    const uint32_t p = apex(mesh_, f), q = apex(mesh_, g);
    const int a = quarter_of(p), b = quarter_of(q);
    if (a != b) return a < b;
    return a % 2 == 1 && side_of_plane(p_, low_, high_, p, at(q)) > 0;
  }

 private:
  const double* at(uint32_t v) const { return p_ + 3 * size_t{v}; }
  int turn(int axis, uint32_t v) const { return turn_without(axis, at(low_), at(high_), at(v)); }
  // 0: angle 0, 1: up to half a turn, 2: half a turn, 3: beyond.
  int quarter_of(uint32_t v) const {
    const int side = side_of_plane(p_, low_, high_, zero_, at(v));
    if (side != 0) return side > 0 ? 1 : 3;
    return turn(axis_, v) == turn(axis_, zero_) ? 0 : 2;
  }

  const double* p_;
  const TriangleMesh& mesh_;
  uint32_t low_ = 0, high_ = 0, zero_;
  int axis_ = 0;
};

// Going round, a side that runs down begins the inside, and a side that runs up ends the inside. Pairs are those of
// brackets; what is left over has no partner.
void pair_round(const TriangleMesh& mesh, std::vector<uint32_t> sides, std::vector<uint32_t>& partner) {
  const Round round(mesh, sides.front());
  // At one angle, the end of an inside comes before the next begins. Triangles that lie upon each other pair by number,
  // so that bodies listed one after the other keep their own.
  std::sort(sides.begin(), sides.end(), [&](uint32_t f, uint32_t g) {
    if (round.is_before(f, g)) return true;
    if (round.is_before(g, f)) return false;
    const bool ends = runs_up(mesh, f);
    return ends != runs_up(mesh, g) ? ends : ends ? f < g : f > g;
  });
  std::vector<uint32_t> begun;
  for (size_t i = 0; i < 2 * sides.size(); ++i) {  // twice round: an inside may hold the angle 0
    const uint32_t side = sides[i % sides.size()];
    if (partner[side] != nobody) continue;
    if (!runs_up(mesh, side)) {
      if (i < sides.size()) begun.push_back(side);
    } else if (!begun.empty()) {
      partner[side] = begun.back();
      partner[begun.back()] = side;
      begun.pop_back();
    }
  }
}

class Classes {
 public:
  explicit Classes(size_t count) : up_(count) { std::iota(up_.begin(), up_.end(), 0u); }
  uint32_t find(uint32_t i) {
    while (up_[i] != i) i = up_[i] = up_[up_[i]];
    return i;
  }
  void join(uint32_t i, uint32_t j) {
    const auto [low, high] = std::minmax({find(i), find(j)});
    up_[high] = low;
  }

 private:
  std::vector<uint32_t> up_;
};

// The partner of each side, if there is one.
std::vector<uint32_t> pair_sides(const TriangleMesh& mesh, Parted& parted) {
  std::vector<uint32_t> partner(mesh.triangles.size(), nobody);
  for_each_edge(mesh, [&](const uint32_t* first, const uint32_t* last) {
    if (last - first == 2 && runs_up(mesh, first[0]) != runs_up(mesh, first[1])) {
      partner[first[0]] = first[1];
      partner[first[1]] = first[0];
    } else if (last - first == 2) {
      ++parted.against;
    } else if (last - first > 2) {
      ++parted.edges;
      pair_round(mesh, {first, last}, partner);
    }
  });
  for (uint32_t side = 0; side < partner.size(); ++side)
    if (partner[side] == nobody) parted.open.push_back(side);
  return partner;
}

uint32_t add_copy(TriangleMesh& mesh, uint32_t v, Parted& parted) {
  parted.copied.push_back(v);
  for (size_t axis = 0; axis < 3; ++axis) mesh.positions.push_back(mesh.positions[3 * size_t{v} + axis]);
  return static_cast<uint32_t>(mesh.positions.size() / 3 - 1);
}

void part_vertices(TriangleMesh& mesh, const std::vector<uint32_t>& partner, Parted& parted) {
  // Corners of one fan are one class.
  Classes fans(mesh.triangles.size());
  for (uint32_t side = 0; side < partner.size(); ++side) {
    if (partner[side] == nobody) continue;
    fans.join(side, next_side(partner[side]));
    fans.join(next_side(side), partner[side]);
  }
  // The first fan of a vertex keeps its number.
  std::vector<uint32_t> fan_of(mesh.positions.size() / 3, nobody), vertex_of(mesh.triangles.size(), nobody);
  for (uint32_t corner = 0; corner < mesh.triangles.size(); ++corner) {
    const uint32_t fan = fans.find(corner), v = mesh.triangles[corner];
    if (vertex_of[fan] != nobody) continue;
    const bool is_first = fan_of[v] == nobody;
    if (is_first) fan_of[v] = fan;
    vertex_of[fan] = is_first ? v : add_copy(mesh, v, parted);
  }
  for (uint32_t corner = 0; corner < mesh.triangles.size(); ++corner)
    mesh.triangles[corner] = vertex_of[fans.find(corner)];
}

// The middles of sides that need one: pairs that still have both ends in common, since one fan passes twice at each
// end. Each pair has a middle of its own, all in one place. `middle` has an entry for each side.
std::vector<uint32_t> add_middles(TriangleMesh& mesh, const std::vector<uint32_t>& partner, Parted& parted) {
  std::vector<uint32_t> middle;
  for_each_edge(mesh, [&](const uint32_t* first, const uint32_t* last) {
    if (last - first <= 2) return;
    middle.resize(mesh.triangles.size(), nobody);
    for (const uint32_t* side = first; side != last; ++side) {
      if (partner[*side] == nobody || middle[*side] != nobody) continue;
      const uint32_t m = add_copy(mesh, tail(mesh, *side), parted), end = head(mesh, *side);
      for (size_t axis = 0; axis < 3; ++axis)
        mesh.positions[3 * size_t{m} + axis] +=
            (mesh.positions[3 * size_t{end} + axis] - mesh.positions[3 * size_t{m} + axis]) / 2;
      middle[*side] = middle[partner[*side]] = m;
    }
  });
  return middle;
}

// Cuts triangle f at the middles of its sides. The triangle keeps one part, and new triangles follow at the end.
void cut_at_middles(TriangleMesh& mesh, uint32_t f, const uint32_t* middle, Parted& parted) {
  std::vector<uint32_t> round;  // corners and middles in turn
  for (uint32_t i = 0; i < 3; ++i) {
    round.push_back(mesh.triangles[3 * size_t{f} + i]);
    if (middle[i] != nobody) round.push_back(middle[i]);
  }
  // Each cut takes a corner between two middles off, else a corner beside one.
  const auto is_middle = [&](uint32_t v) { return std::find(middle, middle + 3, v) != middle + 3; };
  while (round.size() > 3) {
    const size_t n = round.size();
    size_t at = n;
    for (size_t i = 0; i < n; ++i) {
      const int beside = is_middle(round[(i + n - 1) % n]) + is_middle(round[(i + 1) % n]);
      if (is_middle(round[i]) || beside == 0) continue;
      if (at == n || beside == 2) at = i;
      if (beside == 2) break;
    }
    mesh.triangles.insert(mesh.triangles.end(), {round[(at + n - 1) % n], round[at], round[(at + 1) % n]});
    parted.divided.push_back(f);
    round.erase(round.begin() + static_cast<std::ptrdiff_t>(at));
  }
  std::copy_n(round.begin(), 3, &mesh.triangles[3 * size_t{f}]);
}

}  // namespace

Parted part_fans(TriangleMesh& mesh) {
  Parted parted;
  const std::vector<uint32_t> partner = pair_sides(mesh, parted);
  part_vertices(mesh, partner, parted);
  const std::vector<uint32_t> middle = add_middles(mesh, partner, parted);
  for (size_t side = 0; side < middle.size(); side += 3)
    if (std::any_of(&middle[side], &middle[side] + 3, [](uint32_t v) { return v != nobody; }))
      cut_at_middles(mesh, static_cast<uint32_t>(side / 3), &middle[side], parted);
  return parted;
}

}  // namespace tool
