// SPDX-License-Identifier: MIT
#include "arrangement/pieces_wanted.h"

#include "arrangement/traces.h"
#include "base/sort.h"
#include "geometry/predicates.h"

namespace tpa {

namespace {

// ---------------------------------------------------------------- crossings of traces in a facet

struct FacetTraces {
  Span<u32> traces;  // numbers
  u32 axis;
};

u32 lower_end(const Trace& t) { return min_of(t.p, t.q); }
u32 higher_end(const Trace& t) { return max_of(t.p, t.q); }

// The different points of the traces.
u32 count_ends(const Arrangement& a, Span<const u32> traces) {
  u32 count = 0;
  const auto note = [&](u32 p) {
    count += a.place[p] == none ? 1u : 0u;
    a.place[p] = 0;
  };
  for (u32 number : traces) note(a.traces[number].p), note(a.traces[number].q);
  for (u32 number : traces) a.place[a.traces[number].p] = a.place[a.traces[number].q] = none;
  return count;
}

// Leaves one trace of those with the same ends, and none without an extent.
void keep_distinct(const Arrangement& a, Span<u32>& traces) {
  spend(meter_of(a), sorting_steps(2 * traces.size));
  const auto trace = [&](u32 number) -> const Trace& { return a.traces[number]; };
  sort_in_place(traces.data, traces.size, [&](u32 i, u32 k) {
    const Trace &s = trace(i), &t = trace(k);
    if (lower_end(s) != lower_end(t)) return lower_end(s) < lower_end(t);
    return higher_end(s) != higher_end(t) ? higher_end(s) < higher_end(t) : i < k;
  });
  u32 kept = 0;
  for (u32 number : traces) {
    const Trace& t = trace(number);
    if (t.p == t.q) continue;
    if (kept > 0 && lower_end(trace(traces[kept - 1])) == lower_end(t) &&
        higher_end(trace(traces[kept - 1])) == higher_end(t))
      continue;
    traces[kept++] = number;
  }
  traces.size = kept;
}

// ---------------------------------------------------------------- room

// Until so many pairs of traces are compared, crossings are counted one by one: a tenth of a second or so.
constexpr u64 most_compared = u64{1} << 22;

// Pieces with room for so many points (arrangement.cpp).
constexpr u64 pieces_for_points(u64 points) { return points > 8 ? 2 * (points - 8) : 0; }
constexpr u64 pieces_for_work(u64 words) { return pieces_for_points((words + 5) / 6); }
// Triangles between so many points, and the words of scratch to open all of them (planar_segments.cpp).
constexpr u64 most_in_map(u64 points) { return max_of<u64>(2 * points, 6) - 5; }
constexpr u64 most_words(u64 points) { return 8 * most_in_map(points) + 28; }

// Do two traces cross within both? Ends upon the other trace are points already.
bool cross(const Arrangement& a, u32 axis, const Trace& s, const Trace& t) {
  if (s.p == t.p || s.p == t.q || s.q == t.p || s.q == t.q) return false;
  const ArrangementPoints& points = a.points;
  return turn(points, axis, s.p, s.q, t.p) * turn(points, axis, s.p, s.q, t.q) < 0 &&
         turn(points, axis, t.p, t.q, s.p) * turn(points, axis, t.p, t.q, s.q) < 0;
}

// What facets need so far.
struct Counted {
  u64 refused;  // more pieces than that are refused
  u64 pieces = 0, points = 0, most_in_facet = 0, compared = 0;

  // Does the whole count matter, with a facet of so many points?
  bool is_open(u64 ends, u64 crossings) const {
    return compared < most_compared ||
           max_of(pieces + most_in_map(ends + crossings), pieces_for_points(points + crossings)) <= refused;
  }
};

// Traces that begin along one axis before another ends are compared, or else count as crossing; rounding keeps that
// order. Adds the comparisons.
u64 count_crossings(const Arrangement& a, FacetTraces facet, u64 ends, Counted& all) {
  keep_distinct(a, facet.traces);
  const int u = static_cast<int>((facet.axis + 1) % 3), v = static_cast<int>((facet.axis + 2) % 3);
  const auto low = [&](const Trace& t, int i) { return min_of(a.points.list[t.p].at[i], a.points.list[t.q].at[i]); };
  const auto high = [&](const Trace& t, int i) { return max_of(a.points.list[t.p].at[i], a.points.list[t.q].at[i]); };
  sort_in_place(facet.traces.data, facet.traces.size, [&](u32 i, u32 k) {
    const f64 x = low(a.traces[i], u), y = low(a.traces[k], u);
    return x != y ? x < y : i < k;
  });
  u64 count = 0;
  for (u32 i = 0; i < facet.traces.size && !has_stopped(a); ++i) {
    const Trace& s = a.traces[facet.traces[i]];
    const u32* const after = facet.traces.data + i + 1;
    const u32 beside = count_before(after, facet.traces.size - i - 1,
                                    [&](u32 number) { return low(a.traces[number], u) <= high(s, u); });
    const bool compares = all.is_open(ends, count);
    all.compared += compares ? beside : 0;
    spend(meter_of(a), compares ? 1 + beside : 1);
    if (!compares) count += beside;
    for (u32 k = 0; compares && k < beside; ++k) {
      const Trace& t = a.traces[after[k]];
      if (low(t, v) <= high(s, v) && low(s, v) <= high(t, v)) count += cross(a, facet.axis, s, t) ? 1u : 0u;
    }
  }
  return count;
}

bool is_flat(const Mesh& m, const Contact& c) {
  const u32* f = m.corner + 3 * static_cast<size_t>(c.a);
  const Plane plane = plane_of(m.position[f[0]], m.position[f[1]], m.position[f[2]]);
  for (u32 h = 3 * c.b; h < 3 * c.b + 3; ++h)
    if (side_of(plane, corner_position(m, h)) != 0) return false;
  return true;
}

}  // namespace

u64 pieces_used(const Arrangement& a) {
  return max_of(max_of<u64>(a.pieces.size, a.traces.size),
                max_of(pieces_for_points(a.points.list.size), pieces_for_work(a.map.most_work)));
}

bool is_crowded(const Arrangement& a) {
  u64 pairs = 0;
  for (u32 i = 0; i < a.faces.size; ++i) {
    const u64 traces = a.first_trace[i + 1] - a.first_trace[i];
    pairs += traces * traces / 2;
  }
  return pairs > crowded_share * a.pieces.capacity;
}

u64 most_pieces(Arrangement& a, u64 refused) {
  Counted all{refused};
  all.points = a.points.list.size;
  for (u32 first = 0; first < a.faces.size;) {
    const u32 name = a.facet[a.facet_faces[first]], from = a.first_trace[name], to = a.first_trace[name + 1];
    const FacetTraces facet{{a.map.work.data, to - from}, axis_of(*a.mesh, a.faces[a.facet_faces[first]])};
    for (u32 i = from; i < to; ++i) facet.traces.data[i - from] = a.facet_traces[i];
    const u64 ends = count_ends(a, facet.traces), crossings = count_crossings(a, facet, ends, all);
    all.pieces += most_in_map(ends + crossings);
    all.points += crossings;
    all.most_in_facet = max_of(all.most_in_facet, ends + crossings);
    while (first < a.faces.size && a.facet[a.facet_faces[first]] == name) ++first;
  }
  return max_of(max_of<u64>(all.pieces, a.traces.size),
                max_of(pieces_for_points(all.points), pieces_for_work(most_words(all.most_in_facet))));
}

// A pair across each other has two traces and two points at most; a pair in one plane six of each. Faces have three
// sides and corners.
u64 pieces_for_traces(const Mesh& m, Span<const Contact> contacts, u32 faces) {
  u64 traces = 3 * u64{faces};
  for (const Contact& c : contacts) traces += is_flat(m, c) ? 6u : 2u;
  return max_of(traces, pieces_for_points(traces));
}

}  // namespace tpa
