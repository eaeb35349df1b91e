// SPDX-License-Identifier: MIT
#include "mesh/winding_samples.h"

#include "base/base.h"

namespace tpa {

namespace {

// The fraction of i times the golden ratio: numbers in a row fill 0 .. 1 evenly, any run of them nearly so.
f64 spread(u32 i) { return 0x1p-32 * (i * 0x9e3779b9u); }

// The line of points of a row of cells. Lines of a layer differ in height, lines above each other in y.
// The factors keep the three sequences apart.
struct SampleLine {
  f64 y, z, offset;  // offset: of the points, in steps
};
SampleLine line_of(const SampleGrid& g, u32 layer, u32 row) {
  return {g.low.y + (row + spread(layer + 7 * row)) * g.cell.y, g.low.z + (layer + spread(row + 11 * layer)) * g.cell.z,
          spread(3 * row + 5 * layer)};
}

// The cell of a coordinate, kept within the grid.
u32 cell_at(f64 x, f64 low, f64 cell, u32 side) {
  const f64 place = (x - low) / cell;
  return place > 0 ? static_cast<u32>(min_of(place, f64(side - 1))) : 0;
}

// An edge from its lower end on, and how x and y grow with z: the same for both faces at the edge.
struct RisingEdge {
  Vec3 from;
  f64 top, x_slope, y_slope;
  bool is_upward;  // in the order of the face
};
RisingEdge rising_edge(const Vec3& p, const Vec3& q) {
  const bool is_upward = p.z < q.z;
  const Vec3 &a = is_upward ? p : q, &b = is_upward ? q : p;
  const f64 height = b.z - a.z;
  return {a, b.z, height > 0 ? (b.x - a.x) / height : 0, height > 0 ? (b.y - a.y) / height : 0, is_upward};
}

struct PlanarPoint {
  f64 x, y;
};

// A line meets a triangle if it meets the segment that the triangle has in common with the line's plane of equal z.
// Where the edge upwards has the smaller y, the surface turns its inner side to growing x.
void add_crossing(const SampleGrid& g, const SampleLine& line, const RisingEdge (&edge)[3], i32* change) {
  PlanarPoint up{}, down{};
  bool crosses = false;
  for (const RisingEdge& e : edge) {
    if (!(e.from.z <= line.z && line.z < e.top)) continue;
    const f64 height = line.z - e.from.z;
    (e.is_upward ? up : down) = {e.from.x + height * e.x_slope, e.from.y + height * e.y_slope};
    crosses = true;
  }
  const bool enters = up.y < down.y;
  const PlanarPoint &a = enters ? up : down, &b = enters ? down : up;
  if (!crosses || !(a.y <= line.y && line.y < b.y)) return;
  const f64 x = a.x + (line.y - a.y) / (b.y - a.y) * (b.x - a.x);
  const f64 place = (x - g.low.x) / g.step() - line.offset;  // behind point 0, in steps
  if (place >= g.row - 1) return;
  const u32 first = place < 0 ? 0 : static_cast<u32>(place) + 1;
  change[first] += enters ? 1 : -1;
}

}  // namespace

SampleGrid grid_between(const Vec3& low, const Vec3& high, u32 side) {
  return {low, 1.0 / side * (high - low), side, 0};
}

u32 add_crossings(const SampleGrid& g, const Vec3& a, const Vec3& b, const Vec3& c, i32* change, const u8* wanted) {
  const Vec3 low = {min_of(a.x, min_of(b.x, c.x)), min_of(a.y, min_of(b.y, c.y)), min_of(a.z, min_of(b.z, c.z))};
  const Vec3 high = {0, max_of(a.y, max_of(b.y, c.y)), max_of(a.z, max_of(b.z, c.z))};
  const Vec3 end = g.low + f64(g.side) * g.cell;
  // Lines of the grid miss the triangle, or cross it behind all points.
  if (low.x > end.x || low.y > end.y || high.y < g.low.y || low.z > end.z || high.z < g.low.z) return 0;
  const u32 row = cell_at(low.y, g.low.y, g.cell.y, g.side), last_row = cell_at(high.y, g.low.y, g.cell.y, g.side);
  const u32 layer = max_of(g.layer, cell_at(low.z, g.low.z, g.cell.z, g.side));
  const u32 last_layer = min_of(g.layer + g.layers() - 1, cell_at(high.z, g.low.z, g.cell.z, g.side));
  if (layer > last_layer) return 0;
  const RisingEdge edge[] = {rising_edge(a, b), rising_edge(b, c), rising_edge(c, a)};
  for (u32 i = layer; i <= last_layer; ++i)
    for (u32 k = row, n = g.side * (i - g.layer) + row; k <= last_row; ++k, ++n) {
      if (wanted != nullptr && wanted[n] == 0) continue;
      const SampleLine line = line_of(g, i, k);
      if (low.z <= line.z && line.z < high.z) add_crossing(g, line, edge, change + g.row * n);
    }
  return (last_layer - layer + 1) * (last_row - row + 1);
}

void sum_crossings(const SampleGrid& g, i32 at_infinity, i32* change) {
  for (u32 line = 0; line < g.lines(); ++line) {
    i32 winding = at_infinity;
    for (u32 i = g.row * line; i < g.row * (line + 1); ++i) change[i] = winding += change[i];
  }
}

}  // namespace tpa
