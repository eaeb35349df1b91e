// SPDX-License-Identifier: MIT
// strip: shortest closed strips by dynamic programming (Fuchs, Kedem and Uselton 1977).
#include "triangulate/strip.h"

#include "base/simd.h"

namespace tpa {

namespace {

void measure_from(const StripLoops& loops, u32 i, f64* edge_from) {
  const u32 q = loops.y.size;
  u32 j = 0;
#if defined(TPA_VECTORS)
  const Vec3 from = loops.points[loops.x[i]];
  for (; j + 2 <= q; j += 2) {
    const Vec3 &a = loops.points[loops.y[j]], &b = loops.points[loops.y[j + 1]];
    const D2 x = from.x - D2{a.x, b.x}, y = from.y - D2{a.y, b.y}, z = from.z - D2{a.z, b.z};
    store2(edge_from + j, square_root(x * x + y * y + z * z));
  }
#endif
  for (; j < q; ++j) edge_from[j] = edge_length(loops, i, j);
}

// Moves on to column i of two lattices, of neighbouring starts. No path takes all q steps on y in one column, so the
// shortest path to a row by way of a row below 0 of this column, `mixed`, is kept apart from the path straight down
// from row 0. `edge` points at the length from x_i to y_start in a list that goes round twice. `row` has rows 0 to q of
// the column before, two by two, and no_way before the first column.
void sweep_two(u32 i, u32 q, const f64* edge, f64* row) {
  D2 straight = i == 0 ? all2(0) : load2(row) + load2(edge), mixed = all2(no_way);
  store2(row, straight);
  const f64* const last = edge - q;
  while (--edge > last) {
    row += 2;
    const D2 step = load2(edge);
    mixed = min2(load2(row), mixed) + step;
    straight += step;
    store2(row, min2(straight, mixed));
  }
  store2(row + 2, min2(load2(row + 2), mixed) + load2(last));
}

}  // namespace

void shortest_strip_lengths(const StripLoops& loops, u32 first, u32 end, Span<f64> scratch, f64* lengths) {
  const u32 p = loops.x.size, q = loops.y.size;
  // Lengths from x_i go round the loop twice, so that neighbouring starts stand side by side.
  f64* edge_from = scratch.data;
  f64* rows = scratch.data + 2 * u64{q} + 1;
  const u32 most = 2 * static_cast<u32>((scratch.size - (2 * u64{q} + 1)) / (2 * (u64{q} + 1)));
  for (; first < end; first += most, lengths += most) {
    const u32 count = min_of(end - first, most);
    const auto rows_of = [&](u32 number) { return rows + u64{number} * (q + 1); };
    for (u64 r = 0; r < u64{(count + 1) / 2} * 2 * (q + 1); ++r) rows[r] = no_way;
    for (u32 i = 0; i < p; ++i) {
      measure_from(loops, i, edge_from);
      for (u32 j = q; j <= 2 * q; ++j) edge_from[j] = edge_from[j - q];
      for (u32 n = 0; n < count; n += 2) sweep_two(i, q, edge_from + first + n + q, rows_of(n));
    }
    for (u32 n = 0; n < count; ++n)
      lengths[n] = rows_of(n - n % 2)[2 * u64{q} + n % 2] + edge_length(loops, 0, first + n);
  }
}

namespace {

// All edges, and the shortest edge at each vertex. Each step of a strip adds an edge at the vertex to which it goes.
// The excess of the step is the length of this edge beyond the shortest at the vertex.
struct StripEdges {
  u32 p, q;
  f64 *length, *least_x, *least_y;
  f64 x_excess(u32 i, u32 y) const { return length[u64{i} * q + y] - least_x[i]; }
  f64 y_excess(u32 i, u32 y) const { return length[u64{i} * q + y] - least_y[y]; }
};

StripEdges measure_edges(const StripLoops& loops, f64* scratch) {
  const u32 p = loops.x.size, q = loops.y.size;
  const StripEdges e{p, q, scratch, scratch + u64{p} * q, scratch + u64{p} * q + p};
  for (u32 y = 0; y < q; ++y) e.least_y[y] = no_way;
  for (u32 i = 0; i < p; ++i) {
    f64* row = e.length + u64{i} * q;
    measure_from(loops, i, row);
    e.least_x[i] = row[0];
    for (u32 y = 0; y < q; ++y) {
      e.least_x[i] = min_of(e.least_x[i], row[y]);
      e.least_y[y] = min_of(e.least_y[y], row[y]);
    }
  }
  return e;
}

}  // namespace

// Every strip passes the middle column. The way from its start to any place in that column has at least the least
// excess of all such ways, and so has the way from there back to the start.
void bound_strip_lengths(const StripLoops& loops, f64* scratch, f64* at_least) {
  const u32 p = loops.x.size, q = loops.y.size, middle = p / 2;
  const StripEdges e = measure_edges(loops, scratch);
  f64 *to_middle = at_least, *from_middle = e.least_y + q;
  for (u32 y = 0; y < q; ++y) to_middle[y] = from_middle[y] = 0;
  // Steps on y go backwards; twice round, since they may start anywhere.
  for (u32 i = middle; i-- > 0;) {
    for (u32 y = 0; y < q; ++y) to_middle[y] += e.x_excess(i + 1, y);
    for (u32 n = 0, y = 0, before = q - 1; n < 2 * q; ++n, before = y, y = y + 1 == q ? 0 : y + 1)
      to_middle[y] = min_of(to_middle[y], to_middle[before] + e.y_excess(i, before));
  }
  for (u32 i = middle + 1; i < p; ++i) {
    for (u32 y = 0; y < q; ++y) from_middle[y] += e.x_excess(i, y);
    for (u32 n = 0, y = q - 1, before = 0; n < 2 * q; ++n, before = y, y = y == 0 ? q - 1 : y - 1)
      from_middle[y] = min_of(from_middle[y], from_middle[before] + e.y_excess(i, y));
  }
  f64 least = 0;
  for (u32 i = 0; i < p; ++i) least += e.least_x[i];
  for (u32 y = 0; y < q; ++y) least += e.least_y[y];
  for (u32 y = 0; y < q; ++y)
    at_least[y] = (least + (to_middle[y] + from_middle[y] + e.x_excess(0, y))) * (1 - strip_rounding);
}

}  // namespace tpa
