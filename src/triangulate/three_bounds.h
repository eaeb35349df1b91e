// three_bounds: how short handles between three polygons can be (docs/handles.md).
//
// Let one edge of polygon A be chosen. Every handle has exactly one face over it, the base, whose apex is on B, or else
// on C; then B and C are exchanged and all is looked at in a mirror. Cut along the base, A and B are one polygon, whose
// corners are here called places: those of A from 0, the end of the edge, to p - 1, its beginning; and those of B from
// 0, the apex, backwards all round to q, the apex again. The rest of the handle lies between this polygon and C:
// going round C forwards, from a place of A down to a smaller one, by an inner triangle to a place of B, up to a
// greater one, by an inner triangle back to A. What the triangles leave between A and B are two strips that end at the
// base, so each of them costs what its own two places tell (`after`, `before`), not both together. That is why the
// shortest way round C is found in O(n^3) for each base.
//
// The way round is cut open at vertex 0 of C, and has to end at the place where it began. Here it need not: but it pays
// at its beginning and gets back at its end what the place is worth, which is the shortest way from there to a certain
// end. So nothing is gained by leaving out a part of the way, and what comes out is a close lower bound. It is rounded:
// bounds are compared with more than enough room for that (three_slack). What strips cost is not.
#pragma once

#include "base/vec3.h"
#include "triangulate/face_filter.h"

namespace tpa {

inline constexpr u32 most_three_vertices = 640;

// Of arrays in scratch memory: those of single-precision numbers are read four at a time.
inline constexpr u64 three_alignment = 16;

// Three loops, one after another, in handle direction: loop l has vertices first[l] .. first[l + 1] - 1.
struct ThreeLoops {
  const Vec3* points = nullptr;
  u32 first[4] = {};
  FaceFilter filter;
  u32 sides(u32 loop) const { return first[loop + 1] - first[loop]; }
};

// Above every sum of lengths, and sums of a few of these are numbers too.
inline constexpr f32 far_away = 0x1p124f;

// Which polygon is A, which of its edges is the base's, and whether the base's apex is on the loop after A, or in the
// mirror on the one before.
struct ThreeView {
  u32 loop = 0, edge = 0;
  bool mirrored = false;
};

struct ThreeTables {
  u32 p = 0, q = 0, r = 0;                       // sides of A, B, C
  u32 wide_p = 0, wide_q = 0;                    // row lengths for p places of A, q + 1 of B
  u16 *a = nullptr, *b = nullptr, *c = nullptr;  // vertices by place
  // The polygon edge between place t and the next one, by the vertex with which it begins.
  u16 *edge_a = nullptr, *edge_b = nullptr, *edge_c = nullptr;
  f32 *ca = nullptr, *cb = nullptr;         // lengths: [place of C][place of A], [place of C][place of B]
  f64 *after = nullptr, *before = nullptr;  // strips from the base on, [A][B]; to the base, [B][A]; ends included
  f32* reached = nullptr;                   // [place of C][place of B]: shortest way to there
  f32 *worth_a = nullptr, *worth_b = nullptr;
  f32 *lent_a = nullptr, *lent_b = nullptr;  // the worth of places for another base
  f32 *line_a[2] = {}, *line_b[2] = {};      // all places of the first and of the second time round
  f64* entry = nullptr;
  u32* blocked = nullptr;  // bit [edge's first vertex][apex]: the face is not free
  u32 vertices = 0;
  bool filtered = false;
};

u64 three_tables_bytes(u32 longest, u32 vertices);
// Relative error of a bound of so many lengths.
constexpr f32 three_slack(u32 vertices) { return static_cast<f32>(vertices + 64) * 0x1p-22f; }

// Lays the tables out. Returns the bytes used.
u64 lay_out_three(const ThreeLoops& loops, u8* room, ThreeTables& tables);
// Asks about all faces over polygon edges.
void ask_for_faces(const ThreeLoops& loops, ThreeTables& tables);
// The places of a base whose apex is vertex `apex` of B, as counted in the view.
void set_places(const ThreeLoops& loops, const ThreeView& view, u32 apex, ThreeTables& tables);
// Measures all that the next two need.
void measure_base(const ThreeLoops& loops, ThreeTables& tables);
// The worth of places: found for this base, which takes about as long as a bound does; or taken over from another base,
// whose apex is `ahead` places of B before this one's or, for a negative number, after it.
void find_worth(ThreeTables& tables);
void lend_worth(ThreeTables& tables);
void borrow_worth(ThreeTables& tables, i32 ahead);

// A part of the places in their order round C: those of A from the last one, then those of B.
struct ThreePart {
  u32 begin = 0, end = 0;
};
constexpr u32 count_places(const ThreeTables& t) { return t.p + t.q + 1; }
constexpr bool begins_on_a(const ThreeTables& t, const ThreePart& part) { return part.begin < t.p; }
constexpr bool ends_on_b(const ThreeTables& t, const ThreePart& part) { return part.end > t.p; }
// A lower bound for the handles with this base whose way round C begins in a part. Pre: places have a worth.
f32 bound_part(const ThreePart& part, ThreeTables& tables);
// For C's places from the last to the first, after bound_part: least lengths from there on, of ways that have just come
// back to A, into line_a[1]; without the edge that they start from.
void step_back(const ThreePart& part, u32 place, ThreeTables& tables);

inline bool is_blocked(const ThreeTables& t, u32 edge, u32 apex) {
  if (!t.filtered) return false;
  const u32 bit = edge * t.vertices + apex;
  return (t.blocked[bit / 32] >> (bit % 32)) & 1;
}

// A strip between C and A or B: from place `at` on X down and from place `c` on C forwards or backwards.
struct ThreeStrip {
  const u16 *x = nullptr, *edge_x = nullptr;
  u32 at = 0, all_x = 0;  // so many steps are all of X
  u32 c = 0;
  bool forwards = true;
  f64* least = nullptr;  // [steps on X][steps on C], at + 1 rows of r + 1
};
constexpr u32 place_on_c(const ThreeTables& t, const ThreeStrip& s, u32 steps) {
  return s.forwards ? (s.c + steps) % t.r : (s.c + t.r - steps) % t.r;
}
// The edge of C before the step number `steps` > 0.
constexpr u32 edge_on_c(const ThreeTables& t, const ThreeStrip& s, u32 steps) {
  return place_on_c(t, s, s.forwards ? steps - 1 : steps);
}
// `least`: total length of the shortest strip, both ends included. All steps of a polygon may not be in a row, and not
// all of both be in one strip. `line` has room for r + 1.
void fill_three_strip(const ThreeLoops& loops, const ThreeTables& tables, const ThreeStrip& strip, f64* line);

}  // namespace tpa
