// SPDX-License-Identifier: MIT
// balloon_state: the balloon at work, and as bytes to go on from.
#pragma once

#include <algorithm>
#include <chrono>

#include "tool/segment/balloon.h"
#include "tool/segment/forces.h"

namespace tool {

// The range of the volume, in mm3, over rows of iterations without a contact.
struct Swing {
  uint32_t iterations = 0;  // of the present row
  double least = 0, most = 0;
  double least_before = -1, most_before = -1;  // of the row before; below 0: none
  uint8_t at_rest = 0;                         // 1: both ranges are the same
};

struct Balloon {
  const BalloonOptions& o;
  const EdgeField& edges;  // where they are to be shorter than forces.edge_length
  Surface& surface;
  BalloonResult& result;
  Forces forces;
  const Workers& workers;
  TriangleMesh mesh;      // as last committed
  std::vector<double> x;  // present places of its vertices
  std::vector<Particle> particles;
  std::vector<Star> stars;     // of vertices not yet anchored
  uint32_t quiet[2] = {0, 0};  // iterations in a row with few moving vertices
  Swing swing = {};
  uint32_t patience = 0;   // iterations left before the contact met is resolved
  uint32_t remeshing = 0;  // sweeps due after the last step's events
  uint32_t hurry = 0;      // iterations without a chance for contacts to ripen
  uint8_t ripe = 0;        // 1: the next step resolves the contact
  double stretch = 1;      // edges in thin parts are so many times longer than in the end
};

// Edges too long by less than a third are never cut. Above this part the longest edge is too long by less than two
// thirds, and most edges would stay: such parts are fine from the start.
inline constexpr double least_stretched = 0.6;

// The edge length aimed at now, as a part of forces.edge_length.
inline double part_at(const Balloon& b, const Point& place) {
  const double part = b.edges.part_at(place);
  return part < least_stretched ? std::min(1.0, b.stretch * part) : part;
}

// For the surface to start with.
tpa_config balloon_config();

// The library's mesh as the state to go on from.
void adopt(Balloon& b);

inline double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Each vertex of the library's mesh gets the particle returned by pick(vertex, first parent, second parent or
// TPA_NONE).
template <class Pick>
void carry_particles(Balloon& b, Pick pick) {
  tpa_vertex_map_view map{};
  map.struct_size = sizeof map;
  if (tpa_vertex_map(b.surface.context(), &map) != TPA_OK) return;
  std::vector<Particle> next(map.new_count);
  for (uint32_t v = 0; v < map.new_count; ++v) next[v] = pick(v, map.origins[v].parents[0], map.origins[v].parents[1]);
  b.particles.swap(next);
}

// A task of a thread.
inline constexpr size_t vertices_at_once = 4096;

// Calls visit(v) for all vertices, on all threads.
template <class Visit>
void for_vertices(const Balloon& b, Visit visit) {
  const size_t n = b.particles.size();
  b.workers.for_each(static_cast<uint32_t>((n + vertices_at_once - 1) / vertices_at_once), [&](uint32_t task) {
    const size_t first = task * vertices_at_once, last = std::min(n, first + vertices_at_once);
    for (size_t v = first; v < last; ++v) visit(v);
  });
}

// The state between two iterations: the bytes of the library (tpa_save) and of the balloon, a hash of them all, and
// one of the volume and the options.
Status save(const Balloon& b, BalloonState& state);

// The surface is started here. Fails on bytes that `save` has not written, or has for another volume or other options.
Status restore(Balloon& b, const BalloonState& state);

}  // namespace tool
