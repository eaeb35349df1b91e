// SPDX-License-Identifier: MIT
#include "arrangement/arrangement.h"

#include "base/sort.h"

namespace tpa {

namespace {

// Stages that follow each other share memory.
void carve_map(Carver& c, Arrangement& a, u32 points) {
  PlanarMap& m = a.map;
  const u32 triangles = 2 * points;
  c.take(m.vertex, points);
  c.take(m.leaving, points);
  c.take(m.after, points);
  c.take(m.before, points);
  c.take(m.corner, 3 * triangles);
  c.take(m.opposite, 3 * u64{triangles});
  c.take(m.trace, 3 * u64{triangles});
  c.take(m.mark, triangles);
  c.take(m.work, 6 * points);
  for (u32 side = 0; side < 2; ++side) {
    c.take(a.cover[side], triangles);
    c.take(a.origin[side], triangles);
  }
}
void carve_edges(Carver& c, Arrangement& a, u32 points, u32 pieces) {
  c.take(a.edges.slot, 3 * u64{pieces} + 1);
  a.edges.size = 3 * pieces + 1;
  c.take(a.around, 3 * u64{pieces});
  c.take(a.mate, 3 * u64{pieces});
  c.take(a.reached, pieces);
  c.take(a.queue, 3 * pieces);
  c.take(a.shared, 3 * pieces / 2 + 1);
  c.take(a.borders, pieces);
  c.take(a.origins, points);
  c.take(a.vertex, points);
}

void carve(Carver& c, Arrangement& a, u32 pieces) {
  const u32 points = pieces / 2 + 8;
  c.take(a.points.list, points);
  a.points.by_position.size = point_hash_slots(points);
  a.points.by_origin.size = a.points.by_position.size;
  c.take(a.points.by_position.slot, a.points.by_position.size);
  c.take(a.points.by_origin.slot, a.points.by_origin.size);
  c.take(a.pieces, pieces);
  c.take(a.faces, pieces);
  c.take(a.facet, pieces);
  c.take(a.facet_faces, pieces);
  c.take(a.first_trace, u64{pieces} + 1);
  c.take(a.traces, pieces);
  c.take(a.facet_traces, pieces);
  c.take(a.place, points);
  Carver edges = c;
  carve_map(c, a, points);
  carve_edges(edges, a, points, pieces);
  c.bytes = max_of(c.bytes, edges.bytes);
}

}  // namespace

u64 arrangement_bytes(u64 pieces) {
  Carver c;
  Arrangement a;
  carve(c, a, static_cast<u32>(pieces));
  return c.bytes;
}

Arrangement open_arrangement(u8* memory, u32 pieces, const Mesh& m, Meter* meter) {
  Carver c{memory};
  Arrangement a;
  carve(c, a, pieces);
  a.mesh = a.points.mesh = &m;
  a.points.meter = meter;
  return a;
}

u32 place_of_face(const Arrangement& a, u32 f) {
  const u32 at = count_before(a.faces.data, a.faces.size, [&](u32 g) { return g < f; });
  return at < a.faces.size && a.faces[at] == f ? at : none;
}

}  // namespace tpa
