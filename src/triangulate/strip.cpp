// SPDX-License-Identifier: MIT
// strip: shortest closed strips by dynamic programming (Fuchs, Kedem and Uselton 1977), and the zipper.
#include "triangulate/strip.h"

#include "base/simd.h"

namespace tpa {

namespace {

// y_start minus j, round the loop. Pre: j <= size.
u32 backwards(u32 start, u32 j, u32 size) { return start >= j ? start - j : start + size - j; }

// Bits of the trace: how the best path reaches a cell.
constexpr u8 by_x = 1;      // by a step on x, else on y
constexpr u8 from_top = 2;  // the best path goes straight down column i from row 0

// Paths from edge (x_0, y_start), column by column. No path takes all q steps on y in one column.
struct Column {
  f64 top;    // along row 0
  f64* best;  // the shortest path to row j of this column
};

// Moves on to column i. `edge_from` has the lengths from x_i; `mixed` is the shortest path to a row by way of a row
// below 0 of this column. A null `trace` means that only the length is wanted.
void sweep_column(u32 i, u32 q, u32 start, const f64* edge_from, Column& c, u8* trace) {
  if (i > 0) c.top += edge_from[start];
  f64 straight = c.top, above = no_way;
  for (u32 j = 0; j <= q; ++j) {
    const f64 edge = edge_from[backwards(start, j, q)];
    const f64 across = i > 0 && j > 0 ? c.best[j] + edge : no_way;
    const f64 down = above + edge;  // no_way in row 0
    const f64 mixed = across <= down ? across : down;
    if (j > 0) straight += edge;
    const bool takes_top = j < q && straight < mixed;
    c.best[j] = takes_top ? straight : mixed;
    above = min_of(mixed, no_way);
    if (trace != nullptr) trace[j] = static_cast<u8>((across <= down ? by_x : 0) | (takes_top ? from_top : 0));
  }
}

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

// sweep_column() for two neighbouring starts at a time. `edge` points at the length from x_i to y_start in a list that
// goes round twice. `row` has rows 0 to q of the column before, two by two, and no_way before the first column.
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

// The length of the shortest path, whose last step is on x.
f64 sweep(const StripLoops& loops, u32 start, f64* scratch, u8* trace) {
  const u32 q = loops.y.size;
  Column c{0, scratch + q};
  for (u32 i = 0; i < loops.x.size; ++i) {
    measure_from(loops, i, scratch);
    sweep_column(i, q, start, scratch, c, trace == nullptr ? nullptr : trace + u64{i} * (q + 1));
  }
  return c.best[q] + edge_length(loops, 0, start);
}

}  // namespace

f64 shortest_strip_length(const StripLoops& loops, u32 start, u8* scratch) {
  return sweep(loops, start, reinterpret_cast<f64*>(scratch), nullptr);
}

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

f64 shortest_strip_from(const StripLoops& loops, u32 start, u8* scratch, FaceCorners* out) {
  const u32 p = loops.x.size, q = loops.y.size;
  u8* trace = scratch + 3 * sizeof(f64) * (q + 1);
  const f64 total = sweep(loops, start, reinterpret_cast<f64*>(scratch), trace);
  // Back from (p, q), where the last step is on x. `straight`: the path came down this column from row 0.
  u32 i = p, j = q, at = p + q;
  bool straight = false;
  while (i > 0 || j > 0) {
    const u32 b = loops.y[backwards(start, j, q)];
    const u8 how = i < p ? trace[u64{i} * (q + 1) + j] : by_x;
    const bool x_step = i > 0 && (j == 0 || (!straight && (how & by_x)));
    if (x_step) {
      out[--at] = {{loops.x[i - 1], loops.x[i == p ? 0 : i], b}};
      --i;
      // A step on x continues the best path of the column that it left.
      straight = (trace[u64{i} * (q + 1) + j] & from_top) != 0;
    } else {
      out[--at] = {{b, loops.y[backwards(start, j - 1, q)], loops.x[i == p ? 0 : i]}};
      --j;
    }
  }
  return total;
}

void zip_strip(const StripLoops& loops, u32 i0, u32 j0, FaceCorners* out) {
  const u32 p = loops.x.size, q = loops.y.size;
  u32 i = 0, j = 0, at = 0, run = 0;
  bool last_x = false;
  while (i < p || j < q) {
    const u32 xi = (i0 + i) % p, xn = (i0 + i + 1) % p;
    const u32 yj = backwards(j0, j % q, q), yn = backwards(j0, (j + 1) % q, q);
    bool x_step = edge_length(loops, xn, yj) <= edge_length(loops, xi, yn);
    if (last_x && run + 1 == p) x_step = false;  // never all steps of a loop in one run
    if (!last_x && run + 1 == q) x_step = true;
    if (i == p) x_step = false;
    if (j == q) x_step = true;
    run = x_step == last_x ? run + 1 : 1;
    last_x = x_step;
    out[at++] = x_step ? FaceCorners{{loops.x[xi], loops.x[xn], loops.y[yj]}}
                       : FaceCorners{{loops.y[yn], loops.y[yj], loops.x[xi]}};
    x_step ? ++i : ++j;
  }
}

u32 nearest_on_y(const StripLoops& loops, u32 i) {
  u32 nearest = 0;
  for (u32 j = 1; j < loops.y.size; ++j)
    if (edge_length(loops, i, j) < edge_length(loops, i, nearest)) nearest = j;
  return nearest;
}

void nearest_pair(const StripLoops& loops, u32& i, u32& j) {
  constexpr u32 rounds = 8;
  i = 0, j = none;
  for (u32 round = 0; round < rounds; ++round) {
    const u32 next_j = nearest_on_y(loops, i);
    u32 next_i = 0;
    for (u32 t = 1; t < loops.x.size; ++t)
      if (edge_length(loops, t, next_j) < edge_length(loops, next_i, next_j)) next_i = t;
    const bool settled = next_i == i && next_j == j;
    i = next_i, j = next_j;
    if (settled) return;
  }
}

}  // namespace tpa
