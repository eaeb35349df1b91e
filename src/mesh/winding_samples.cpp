// SPDX-License-Identifier: MIT
#include "mesh/winding_samples.h"

#include "base/base.h"

namespace tpa {

namespace {

constexpr u32 grid_side = SampleGrid::side;

// The fraction of i times the golden ratio: numbers in a row fill 0 .. 1 evenly, any run of them nearly so.
f64 spread(u32 i) { return 0x1p-32 * (i * 0x9e3779b9u); }

// The points of a row of cells lie on a line along x. Lines of a layer differ in height, lines above each other in y.
// The factors keep the three sequences apart.
struct SampleLine {
  f64 y, z, offset;  // offset: of the points, in cells
};
SampleLine line_of(const SampleGrid& g, u32 layer, u32 row) {
  return {g.low.y + (row + spread(layer + 7 * row)) * g.cell.y, g.low.z + (layer + spread(row + 11 * layer)) * g.cell.z,
          spread(3 * row + 5 * layer)};
}

// The cell of a coordinate, kept within the grid.
u32 cell_at(f64 x, f64 low, f64 cell) {
  const f64 place = (x - low) / cell;
  return place > 0 ? static_cast<u32>(min_of(place, f64{grid_side - 1})) : 0;
}

// Where an edge crosses a plane of equal z, from its lower end on: the same for both faces at the edge.
struct PlanarPoint {
  f64 x, y;
};
PlanarPoint crossing(const Vec3& p, const Vec3& q, f64 z) {
  const Vec3 &a = p.z < q.z ? p : q, &b = p.z < q.z ? q : p;
  const f64 t = (z - a.z) / (b.z - a.z);
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

// The line of a row meets a triangle if it meets the segment that the triangle has in common with the plane. Where the
// edge upwards has the smaller y, the surface turns its inner side to growing x.
template <class Winding>
void add_crossing(const SampleGrid& g, u32 layer, u32 row, const Vec3* const* corner, Winding* change) {
  const SampleLine line = line_of(g, layer, row);
  PlanarPoint up{}, down{};
  bool crosses = false;
  for (u32 i = 0; i < 3; ++i) {
    const Vec3 &p = *corner[i], &q = *corner[(i + 1) % 3];
    if (p.z <= line.z && line.z < q.z) up = crossing(p, q, line.z), crosses = true;
    if (q.z <= line.z && line.z < p.z) down = crossing(p, q, line.z);
  }
  const bool enters = up.y < down.y;
  const PlanarPoint &a = enters ? up : down, &b = enters ? down : up;
  if (!crosses || !(a.y <= line.y && line.y < b.y)) return;
  const f64 x = a.x + (line.y - a.y) / (b.y - a.y) * (b.x - a.x);
  const f64 place = (x - g.low.x) / g.cell.x - line.offset;  // behind point 0, in cells
  if (place >= grid_side - 1) return;
  const u32 first = place < 0 ? 0 : static_cast<u32>(place) + 1;
  Winding& at = change[(grid_side * layer + row) * grid_side + first];
  at = static_cast<Winding>(at + (enters ? 1 : -1));
}

}  // namespace

SampleGrid grid_between(const Vec3& low, const Vec3& high) { return {low, 1.0 / grid_side * (high - low)}; }

template <class Winding>
u32 add_crossings(const SampleGrid& g, const Vec3& a, const Vec3& b, const Vec3& c, Winding* change) {
  const Vec3 low = {min_of(a.x, min_of(b.x, c.x)), min_of(a.y, min_of(b.y, c.y)), min_of(a.z, min_of(b.z, c.z))};
  const Vec3 high = {0, max_of(a.y, max_of(b.y, c.y)), max_of(a.z, max_of(b.z, c.z))};
  const Vec3 end = g.low + f64{grid_side} * g.cell;
  // Lines of the grid miss the triangle, or cross it behind all points.
  if (low.x > end.x || low.y > end.y || high.y < g.low.y || low.z > end.z || high.z < g.low.z) return 0;
  const Vec3* const corner[] = {&a, &b, &c};
  const u32 row = cell_at(low.y, g.low.y, g.cell.y), last_row = cell_at(high.y, g.low.y, g.cell.y);
  const u32 layer = cell_at(low.z, g.low.z, g.cell.z), last_layer = cell_at(high.z, g.low.z, g.cell.z);
  for (u32 i = layer; i <= last_layer; ++i)
    for (u32 k = row; k <= last_row; ++k) add_crossing(g, i, k, corner, change);
  return (last_layer - layer + 1) * (last_row - row + 1);
}

template <class Winding>
void sum_crossings(i32 at_infinity, Winding* change) {
  for (u32 line = 0; line < grid_side * grid_side; ++line) {
    i32 winding = at_infinity;
    for (u32 i = 0; i < grid_side; ++i) {
      Winding& at = change[grid_side * line + i];
      at = static_cast<Winding>(winding += at);
    }
  }
}

template u32 add_crossings(const SampleGrid&, const Vec3&, const Vec3&, const Vec3&, i16*);
template u32 add_crossings(const SampleGrid&, const Vec3&, const Vec3&, const Vec3&, i32*);
template void sum_crossings(i32, i16*);
template void sum_crossings(i32, i32*);

}  // namespace tpa
