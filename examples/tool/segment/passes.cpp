// SPDX-License-Identifier: MIT
#include "tool/segment/passes.h"

#include <algorithm>
#include <cmath>

namespace tool {

namespace {

constexpr uint8_t still_missing = 1, now_filled = 2;

// A pass goes on to the next where it has filled this part of what was missing, and round voxels that it has filled.
constexpr double least_gain_of_pass = 0.25;
constexpr int reach_of_gain = 2;  // voxels

uint64_t marked_voxels(const std::vector<uint8_t>& mask) {
  return static_cast<uint64_t>(std::count_if(mask.begin(), mask.end(), [](uint8_t flag) { return flag != 0; }));
}

// 1 within reach_of_gain, along faces, of the voxels that the last pass has filled.
std::vector<uint8_t> reach_gain(const Volume& volume, const std::vector<uint8_t>& outcome) {
  std::vector<uint8_t> reached(outcome.size());
  std::vector<Index> front, next;
  for (int k = 0; k < volume.nz; ++k)
    for (int j = 0; j < volume.ny; ++j)
      for (int i = 0; i < volume.nx; ++i)
        if (outcome[volume.index(i, j, k)] == now_filled) front.push_back({i, j, k});
  for (int round = 0; round < reach_of_gain; ++round, front.swap(next), next.clear())
    for (const Index& here : front)
      for_each_face_neighbour(volume, here, [&](const Index& v) {
        uint8_t& flag = reached[volume.index(v.i, v.j, v.k)];
        if (flag == 0) next.push_back(v);
        flag = 1;
      });
  return reached;
}

// The voxels left out for want of shorter edges: those further away than noise and edges reach, and for the first pass
// those within the reach of their own edges, too.
std::vector<uint8_t> find_missing(const Segmentation& s, const std::vector<uint8_t>& outcome) {
  const double longest = s.options.edge_length;
  const std::vector<float> away = distances_left_out(s.volume, s.object, s.mesh, reach_of_edges(s.volume, longest));
  const bool first = s.passes.empty();
  const std::vector<uint8_t> reached = first ? std::vector<uint8_t>() : reach_gain(s.volume, outcome);
  std::vector<uint8_t> missing(away.size());
  for (size_t id = 0; id < away.size(); ++id) {
    const double part = s.edges.parts.empty() ? 1 : s.edges.parts[id] / 255.0;
    const bool is_far = !std::isfinite(away[id]);
    const bool by_edge = away[id] > 0 && static_cast<double>(away[id]) <= reach_of_edge * part * longest;
    missing[id] = (first ? is_far || by_edge : is_far && reached[id] != 0) ? 1 : 0;
  }
  return missing;
}

}  // namespace

bool begin_pass(Segmentation& s, std::vector<uint8_t>& missing) {
  const bool first = s.passes.empty();
  const Filling& f = s.filling;
  if (f.enclosed_share() >= least_share || (!first && f.share() >= least_share)) return false;
  if (!first) {
    const Pass& last = s.passes.back();
    if (static_cast<double>(last.filled) < least_gain_of_pass * static_cast<double>(last.missing)) return false;
  }
  missing = find_missing(s, missing);
  const uint64_t count = marked_voxels(missing);
  if (first && static_cast<double>(count) <= (1 - least_share) * static_cast<double>(f.object)) return false;
  const double longest = s.options.edge_length;
  if (shorten_edges(s.volume, s.object, missing, s.options.edge_fine / longest, longest, s.edges) == 0) return false;
  Pass pass;
  pass.shortest = s.edges.least * longest;
  pass.missing = count;
  pass.seconds = s.result.seconds.total;
  s.passes.push_back(pass);
  return true;
}

void end_pass(Segmentation& s, std::vector<uint8_t>& missing) {
  const std::vector<float> away = distances_left_out(s.volume, s.object, s.mesh, 0);
  Pass& pass = s.passes.back();
  for (size_t id = 0; id < missing.size(); ++id) {
    if (missing[id] == 0) continue;
    missing[id] = away[id] > 0 ? still_missing : now_filled;
    pass.filled += missing[id] == now_filled ? 1u : 0u;
  }
  pass.iterations = s.result.iterations;
  pass.vertices = s.mesh.positions.size() / 3;
  pass.seconds = s.result.seconds.total - pass.seconds;
}

}  // namespace tool
