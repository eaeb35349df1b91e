// three_strips: the shortest handles between three polygons whose inner triangles are known, in order
// (docs/handles.md).
//
// The totals of the strips are known from each of their edges on, and so the strips are followed, step by step, as far
// as they can be among the best.
#pragma once

#include "triangulate/three_bounds.h"

namespace tpa {

// A handle as its base, its two inner triangles, by places, and the steps of its strips.
struct ThreeHandle {
  f64 length = 0;  // of all edges that are not a polygon's
  ThreeView view;
  u16 apex = 0;                             // of the base
  u16 from_a = 0, from_b = 0, from_c = 0;   // the triangle that strips lead away from, both ways round C
  u16 to_a = 0, to_b = 0;                   // the other one
  u16 steps_c = 0;                          // between them, facing A
  u32 word[most_three_vertices / 32] = {};  // bit set: a step on A or B before C, on A before B
};

// One side of a strip in hand, by the steps that are left on it.
struct ThreeTrack {
  const u16 *vertex = nullptr, *edge = nullptr;
  u32 at = 0;            // the place when no steps are left
  bool forwards = true;  // places grow with the steps that are left
  u32 round = 0;         // of C: its sides
};

// A strip in hand, read from the end at which `least` has its total.
struct ThreePiece {
  ThreeTrack x, y;
  const f64* least = nullptr;  // where no steps are left
  i32 row = 0, column = 0;     // from there for each step that is left on x, on y
  u32 steps_x = 0, steps_y = 0;
  bool split_x = false, split_y = false;  // these are all steps of the polygon: not in a row
};
inline constexpr u32 three_pieces = 4;

// A step of the search: what is left of the present piece.
struct ThreeStep {
  u8 piece = 0, option = 0;
  bool flat = true;  // all steps on A between A and B so far face the base's apex
  u16 x = 0, y = 0;
  u16 at_x = 0,
      at_y = 0;   // if all steps on x so far were with so many left on y, then that, else `apart`; and so for y
  f64 spent = 0;  // in this piece and those before
};

// Answers for inner triangles, each at a place that its corners tell; the last one there stays.
struct InnerAnswers {
  static constexpr u32 count = 512;
  u32 face[count];
  bool free[count];
};

// First triangles that have been searched, for the present base. When it is full, more may be searched again, in vain.
struct SearchedSet {
  static constexpr u32 capacity = 2048, most = 1536;
  u32 triangle[capacity];
  u32 count;
};

struct ThreeScratch {
  static constexpr u32 most_parts = 16;  // halves of halves of most_three_vertices
  ThreeTables tables;
  ThreePart* part;
  f64 *strip_a, *strip_b;  // from the first triangle on: round A, round B
  f64 *least_a, *least_b;  // for all steps on C
  f64* line;
  f32* bound[2];  // of each base, and in the mirror
  ThreeStep* step;
  InnerAnswers* inner;
  SearchedSet* searched;
};

// A search for the shortest handles.
struct ThreeSearch {
  const ThreeLoops& loops;
  ThreeScratch& s;
  Span<ThreeHandle> best;
  f64 limit;
  u32 count = 0;
  u64 work = 0, most_work = 0;
  ThreeHandle hand = {};  // the handle in hand
  ThreePiece piece[three_pieces] = {};
  f64 rest[three_pieces] = {};               // of the pieces after this one
  f64 least_entered = 0, most_followed = 0;  // handles with these triangles that have their turn
  u32 measured_b = none, measured_c = none;  // where strip_b begins
};

// Sums of less than 2^11 lengths in different orders differ by less than this, relatively. Handles whose lengths do are
// taken for equally long.
inline constexpr f64 three_rounding = 1.0 / (u64{1} << 40);

inline f64 allowed(const ThreeSearch& x) {
  return x.count == x.best.size ? min_of(x.limit, x.best[x.count - 1].length) : x.limit;
}
// Handles that are as long as this need not be followed.
inline f64 too_long(const ThreeSearch& x) {
  const f64 most = x.count == x.best.size ? x.best[x.count - 1].length * (1 - three_rounding) : no_way;
  return min_of(most, x.limit * (1 + three_rounding));
}
inline bool is_done(const ThreeSearch& x) { return x.work >= x.most_work; }

// All handles with the triangles of the one in hand that can still be among the best.
// Pre: strip_a and strip_b are measured from its first triangle on.
void search_strips(ThreeSearch& search);

// Its faces, mu + 2 of them.
void write_three(const ThreeLoops& loops, const ThreeHandle& handle, u8* scratch, HandleFace* out);

}  // namespace tpa
