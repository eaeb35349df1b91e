// four_base: what a handle can be, given its base, which is one of its inner triangles (docs/handles.md). The triangle
// is chosen such that every handle has exactly one base.
//
// Four polygons in a tetrahedron: the base is the triangle ABC opposite to D, with three strips around it, of which the
// one between A and B starts in the direction of A. Four in a row, A and B wide: C lies between A and B opposite to D;
// the base is the triangle where C begins in the direction of A. Then follow C, a strip between A and B, the middle, D,
// another strip, the tail, and C again.
#pragma once

#include "triangulate/face_filter.h"
#include "triangulate/four_star_walk.h"
#include "triangulate/four_strips.h"

namespace tpa {

// Four loops, one after another, in handle direction: loop l has vertices first[l] .. first[l + 1] - 1.
struct ShortLoops {
  const Vec3* points = nullptr;
  u32 first[5] = {};
  FaceFilter filter;
  u32 sides(u32 loop) const { return first[loop + 1] - first[loop]; }
};

enum class BaseKind : u8 { tetrahedron, row };

struct ShortBase {
  BaseKind kind = BaseKind::tetrahedron;
  u8 a = 0, b = 0, c = 0, d = 0;     // polygons
  u16 at_a = 0, at_b = 0, at_c = 0;  // the base's vertices, counted within their polygons
};

// Strips of a row: both sides of C come first.
inline constexpr u32 tail_strip = 2, middle_strip = 3;

// Everything that is measured from a base.
struct BaseScratch {
  Rows<f64> distance;  // of all vertices
  FaceMemory memory;   // of faces over a polygon's edge
  StripPaths paths[4];
  // Of a row, after i steps on A and j on B from the base: the shortest way to there round C, and the same where a case
  // lets it end there (triangulate/four_row_cases.h).
  Rows<f64> round_c, before_middle;
  RoundWalk walk;
};

// Products of two polygons' sides, each with one more, and the sum of both: the most that a table needs.
struct MostCells {
  u64 cells = 0, line = 0;
  u32 longest = 0;
};
MostCells most_cells(const ShortLoops& loops);

void lay_out_bases(Carver& carver, const ShortLoops& loops, BaseScratch& scratch);
void measure_distances(const ShortLoops& loops, BaseScratch& scratch);

// A vertex by polygon and steps from the base, forwards or backwards.
constexpr u32 forwards(u32 sides, u32 at, u32 steps) { return (at + steps) % sides; }
constexpr u32 backwards(u32 sides, u32 at, u32 steps) { return (at + 2 * sides - steps) % sides; }

// The polygons and base vertices of strip number t of a base: x runs forwards, y backwards.
struct StripPlace {
  u8 x = 0, y = 0;
  u16 at_x = 0, at_y = 0;
};
StripPlace strip_place(const ShortBase& base, u32 t);
// The polygon of track t, which starts at the base.
u32 track_polygon(const ShortBase& base, u32 t);
u32 track_origin(const ShortBase& base, u32 t);

// Measures all that lies around D; of a row, all but what depends on its case. `previous` is the base measured before,
// or null: strips that it shares are kept.
void measure_base(const ShortLoops& loops, const ShortBase& base, const ShortBase* previous, BaseScratch& scratch);

// Measures the edges of a strip.
void measure_strip_edges(const ShortLoops& loops, const StripPlace& place, BaseScratch& scratch, const StripPaths& out);

// Row: the shortest way round C that ends after i steps on A and j on B, with v steps on C facing A.
f64 way_round_c(const BaseScratch& scratch, u32 v, u32 i, u32 j);

}  // namespace tpa
