// SPDX-License-Identifier: MIT
#include "tool/segment/balloon_remesh.h"

namespace tool {

namespace {

// Edges are collapsed below this part of the length aimed at, if lengths differ from place to place: halves of cut
// edges stay, also where voxels near by ask for longer ones.
constexpr double uneven_collapse_ratio = 0.5;

// Sweeps reach so many edges beyond the vertices that moved: edges towards vertices at rest stretch, too. Beyond the
// long triangles of an event each sweep evens out a ring more.
constexpr uint32_t rings_round_moved = 1;
constexpr uint32_t rings_round_made = 3;

// New vertices take after their livelier parent, so that a surface at rest stays at rest. The middle of a long edge in
// a thin part lies inside a round border, even where the ends are at rest on it, and moves on.
void carry_through_remeshing(Balloon& b) {
  tpa_vertex_map_view map{};
  map.struct_size = sizeof map;
  if (tpa_vertex_map(b.surface.context(), &map) != TPA_OK) return;
  const auto stays = [&](uint32_t v) { return map.old_to_new[v] != TPA_NONE; };
  carry_particles(b, [&](uint32_t, uint32_t parent, uint32_t other) {
    if (other == TPA_NONE) return b.particles[parent];
    const Particle& livelier = b.particles[b.particles[other].gain > b.particles[parent].gain ? other : parent];
    const bool is_middle = stays(parent) && stays(other);
    const bool is_thin = is_middle && part_at(b, point_at(&b.x[3 * size_t{parent}])) < 1;
    return is_thin ? Particle{std::max(settling_gain, livelier.gain), 0, 0, Due::none} : livelier;
  });
}

// Adds the neighbours of all vertices in the set.
void grow(const std::vector<uint32_t>& triangles, std::vector<uint8_t>& set) {
  const std::vector<uint8_t> before = set;
  for (size_t h = 0; h < triangles.size(); h += 3) {
    const uint32_t* c = &triangles[h];
    if ((before[c[0]] | before[c[1]] | before[c[2]]) != 0) set[c[0]] = set[c[1]] = set[c[2]] = 1;
  }
}

// The lengths of edges that the object asks for at each vertex of the set; none where it asks for one length
// everywhere. Others are as long as any.
std::vector<float> edge_lengths(const Balloon& b, const std::vector<uint8_t>& set) {
  std::vector<float> lengths;
  if (b.edges.least >= 1) return lengths;
  lengths.resize(b.particles.size(), static_cast<float>(b.forces.edge_length));
  for_vertices(b, [&](size_t v) {
    if (set[v] != 0) lengths[v] = static_cast<float>(b.forces.edge_length * part_at(b, point_at(&b.x[3 * v])));
  });
  return lengths;
}

// Lengths are those at the vertices of `part`, or of the whole mesh, and at their neighbours.
Status remesh(Balloon& b, uint32_t sweeps, const std::vector<uint32_t>* part, const std::vector<float>& lengths) {
  tpa_remesh_options options{};
  options.struct_size = sizeof options;
  options.iterations = sweeps;
  options.target_length = b.forces.edge_length;
  options.lengths = lengths.empty() ? nullptr : lengths.data();
  if (!lengths.empty()) options.collapse_ratio = uneven_collapse_ratio;
  options.relaxation = 0.5;
  if (part != nullptr) {
    options.vertices = part->data();
    options.count = static_cast<uint32_t>(part->size());
  }
  Status s = b.surface.run(
      [&](tpa_context* c, tpa_issue* issue) { return tpa_remesh(c, &options, b.workers.exec(), nullptr, issue); });
  if (s) {
    carry_through_remeshing(b);
    adopt(b);
  }
  return s;
}

}  // namespace

Status remesh_all(Balloon& b, uint32_t sweeps) {
  const double start = seconds_now();
  for (Particle& p : b.particles) p.due = Due::none;
  const Status s = remesh(b, sweeps, nullptr, edge_lengths(b, std::vector<uint8_t>(b.particles.size(), 1)));
  b.result.seconds.remesh += seconds_now() - start;
  return s;
}

Status remesh_due(Balloon& b, Due due, uint32_t sweeps) {
  const double start = seconds_now();
  std::vector<uint8_t> set(b.particles.size());
  for (size_t v = 0; v < set.size(); ++v) {
    Particle& p = b.particles[v];
    if (p.due < due) continue;
    set[v] = 1;
    p.due = due == Due::made ? Due::moved : Due::none;
  }
  const uint32_t rings = due == Due::made ? rings_round_made : rings_round_moved;
  for (uint32_t ring = 0; ring < rings; ++ring) grow(b.mesh.triangles, set);
  std::vector<uint32_t> part;
  for (uint32_t v = 0; v < set.size(); ++v)
    if (set[v] != 0) part.push_back(v);
  grow(b.mesh.triangles, set);
  const Status s = part.empty() ? success() : remesh(b, sweeps, &part, edge_lengths(b, set));
  b.result.seconds.remesh += seconds_now() - start;
  return s;
}

}  // namespace tool
