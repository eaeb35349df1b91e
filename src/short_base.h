// short_base: what a handle can be, given its base, which is one of its inner triangles (design 4.4). The triangle is
// chosen such that every handle has exactly one base.
//
// Three polygons A, B, C: the base is the inner triangle from which the strip between A and B starts in the direction
// of A; all three strips lead from there to the other inner triangle. Four in a tetrahedron: the base is the triangle
// ABC opposite to D, with three strips around it. Four in a row, A and B wide: C lies between A and B opposite to D;
// the base is the triangle where C begins in the direction of A. Then follow C, a strip between A and B (with C:
// `middle`), D, another strip (`tail`), C again.
#pragma once

#include "face_filter.h"
#include "round_walk.h"
#include "strip_paths.h"

namespace tpa {

inline constexpr u32 most_short_vertices = FaceMemory::most_vertices;
static_assert(most_short_vertices == 4 * most_steps);

// Three or four loops, one after another, in handle direction: loop l has vertices first[l] .. first[l + 1] - 1.
struct ShortLoops {
  const Vec3* points = nullptr;
  u32 count = 0;
  u32 first[5] = {};
  FaceFilter filter;
  u32 sides(u32 loop) const { return first[loop + 1] - first[loop]; }
};

enum class BaseKind : u8 { three, tetrahedron, row };

struct ShortBase {
  BaseKind kind = BaseKind::three;
  u8 a = 0, b = 0, c = 0, d = 0;    // polygons; d is unused for three
  u8 at_a = 0, at_b = 0, at_c = 0;  // the base's vertices, counted within their polygons
};

// Everything that is measured from a base.
struct BaseScratch {
  f64 distance[most_short_vertices][most_short_vertices];
  FaceMemory memory;
  StripPaths paths[3];
  // For a row, after i steps on A and j on B from the base: the edge between them, and how it may be reached; the
  // shortest way to there from the base, through C; and on from there round to the base.
  f64 wide[StripPaths::reach][StripPaths::reach];
  bool wide_by_a[StripPaths::reach][StripPaths::reach], wide_by_b[StripPaths::reach][StripPaths::reach];
  f64 middle[StripPaths::reach][StripPaths::reach], tail[StripPaths::reach][StripPaths::reach];
  RoundWalk walk;
};

void measure_distances(const ShortLoops& loops, BaseScratch& scratch);

// A vertex by polygon and steps from the base, forwards or backwards.
constexpr u32 forwards(u32 sides, u32 at, u32 steps) { return (at + steps) % sides; }
constexpr u32 backwards(u32 sides, u32 at, u32 steps) { return (at + 2 * sides - steps) % sides; }

// The polygons and base vertices of strip number t of a base: x runs forwards, y backwards.
struct StripPlace {
  u8 x = 0, y = 0, at_x = 0, at_y = 0;
};
StripPlace strip_place(const ShortBase& base, u32 t);
// The polygon of track t, which starts at the base.
u32 track_polygon(const ShortBase& base, u32 t);
u32 track_origin(const ShortBase& base, u32 t);

// Measures all that lies around D. `previous` is the base measured before, or null: strips that it shares are kept.
void measure_base(const ShortLoops& loops, const ShortBase& base, const ShortBase* previous, BaseScratch& scratch);

// Row: the shortest way round C that ends after i steps on A and j on B, with v steps on C facing A.
f64 way_round_c(const BaseScratch& scratch, u32 v, u32 i, u32 j);

}  // namespace tpa
