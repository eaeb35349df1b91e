// SPDX-License-Identifier: MIT
#include "tool/mend/facing.h"

#include <vector>

#include "tool/mend/edges.h"
#include "tool/scenes/points.h"

namespace tool {

namespace {

constexpr uint32_t no_side = UINT32_MAX;

// Over each side, the other triangle of an edge of two.
std::vector<uint32_t> neighbours_of(const TriangleMesh& mesh) {
  std::vector<uint32_t> beyond(mesh.triangles.size(), no_side);
  for_each_edge(mesh, [&](const uint32_t* first, const uint32_t* last) {
    if (last - first != 2) return;
    beyond[first[0]] = first[1];
    beyond[first[1]] = first[0];
  });
  return beyond;
}

struct Patch {
  std::vector<uint32_t> kept, turned;  // triangles, as if the first were right
  bool is_consistent = true;
};

// From a triangle over its edges. `state`: 0 unseen, 1 as given, 2 to be turned.
Patch spread(const TriangleMesh& mesh, const std::vector<uint32_t>& beyond, uint32_t from,
             std::vector<uint8_t>& state) {
  Patch patch;
  std::vector<uint32_t> ahead = {from};
  state[from] = 1;
  while (!ahead.empty()) {
    const uint32_t f = ahead.back();
    ahead.pop_back();
    (state[f] == 1 ? patch.kept : patch.turned).push_back(f);
    for (uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      if (beyond[side] == no_side) continue;
      const uint32_t g = beyond[side] / 3;
      const bool agree = runs_up(mesh, side) != runs_up(mesh, beyond[side]);
      const uint8_t wanted = agree ? state[f] : static_cast<uint8_t>(3 - state[f]);
      if (state[g] == 0) {
        state[g] = wanted;
        ahead.push_back(g);
      }
      patch.is_consistent = patch.is_consistent && state[g] == wanted;
    }
  }
  return patch;
}

// Six times the signed volume of the patch as if the first triangle were right, as seen from a vertex of it.
double volume_of_patch(const TriangleMesh& mesh, const Patch& patch) {
  const auto at = [&](uint32_t f, size_t i) {
    const double* p = &mesh.positions[3 * size_t{mesh.triangles[3 * size_t{f} + i]}];
    return Point{p[0], p[1], p[2]};
  };
  const Point origin = at(patch.kept[0], 0);
  double volume = 0;
  for (const bool is_turned : {false, true})
    for (const uint32_t f : is_turned ? patch.turned : patch.kept)
      volume += (is_turned ? -1 : 1) * dot(at(f, 0) - origin, cross(at(f, 1) - origin, at(f, 2) - origin));
  return volume;
}

}  // namespace

size_t turn_facets(TriangleMesh& mesh) {
  const auto count = static_cast<uint32_t>(mesh.triangles.size() / 3);
  const std::vector<uint32_t> beyond = neighbours_of(mesh);
  std::vector<uint8_t> state(count);
  std::vector<uint32_t> turned;
  for (uint32_t f = 0; f < count; ++f) {
    if (state[f] != 0) continue;
    Patch patch = spread(mesh, beyond, f, state);
    if (!patch.is_consistent) continue;
    const bool turns_kept = patch.kept.size() == patch.turned.size() ? volume_of_patch(mesh, patch) < 0
                                                                     : patch.kept.size() < patch.turned.size();
    const std::vector<uint32_t>& few = turns_kept ? patch.kept : patch.turned;
    turned.insert(turned.end(), few.begin(), few.end());
  }
  for (const uint32_t f : turned) std::swap(mesh.triangles[3 * size_t{f} + 1], mesh.triangles[3 * size_t{f} + 2]);
  return turned.size();
}

}  // namespace tool
