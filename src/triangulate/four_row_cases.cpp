#include "triangulate/four_row_cases.h"

namespace tpa {

namespace {

bool may_end_round_c(FacingC facing, u32 i, u32 j) {
  switch (facing) {
    case FacingC::both: return i > 0 && j > 0;
    case FacingC::only_b: return i == 0;
    case FacingC::only_a: return j == 0;
    case FacingC::either: break;
  }
  return true;
}

// A slit's middle has left its first polygon once it has a step on the other.
void keep_slits_only(FacingC facing, const StripPaths& middle) {
  for (u32 i = 0; i <= middle.p; ++i)
    for (u32 j = 0; j <= middle.q; ++j) {
      if (facing == FacingC::only_b && i > 0) middle.by_y[i][j] = false;
      if (facing == FacingC::only_a && j > 0) middle.by_x[i][j] = false;
    }
}

void fill_middle(const ShortLoops& loops, const ShortBase& base, const RowCase& row, BaseScratch& s) {
  StripPaths& middle = s.paths[middle_strip];
  set_sides(loops.sides(base.a), loops.sides(base.b), middle);
  measure_strip_edges(loops, strip_place(base, middle_strip), s, middle);
  if (row.middle == MiddleTurns::slit) keep_slits_only(row.c, middle);
  s.before_middle.width = s.round_c.width;
  for (u32 i = 0; i <= middle.p; ++i)
    for (u32 j = 0; j <= middle.q; ++j) s.before_middle[i][j] = may_end_round_c(row.c, i, j) ? s.round_c[i][j] : no_way;
  fill_strip_paths(middle, &s.before_middle);
}

f64 least_tail(const RowCase& row, const StripPaths& tail, u32 i, u32 j) {
  return strip_is_possible(tail, i, j) ? least_strip(tail, tail_rule(row, tail, i, j), i, j) : no_way;
}

}  // namespace

// All steps on a polygon in a row would have an edge twice. A middle can have them only where C does not face it.
StripRule middle_rule(const RowCase& row, const StripPaths& middle, u32 i, u32 j) {
  if (row.c == FacingC::only_b && i == middle.p) return StripRule::x_split;
  if (row.c == FacingC::only_a && j == middle.q) return StripRule::y_split;
  if (row.middle != MiddleTurns::other) return StripRule::any;
  return row.c == FacingC::only_b ? StripRule::x_before : StripRule::y_before;
}

// Where all steps have to be split, there are turns enough.
StripRule tail_rule(const RowCase& row, const StripPaths& tail, u32 i, u32 j) {
  const StripRule rule = strip_rule(tail, i, j);
  return rule == StripRule::any ? row.tail : rule;
}

void link_row(const ShortLoops& loops, const ShortBase& base, const RowCase& row, BaseScratch& s) {
  fill_middle(loops, base, row, s);
  const StripPaths &middle = s.paths[middle_strip], &tail = s.paths[tail_strip];
  const u32 m = middle.p, n = middle.q;
  ask_of_track(row.track, row.steps, s.walk);
  for (u32 i = 0; i <= m; ++i)
    for (u32 j = 0; j <= n; ++j) {
      s.walk.link[0][i][j] = least_tail(row, tail, j, m - i);
      s.walk.link[1][j][i] = least_strip(middle, middle_rule(row, middle, i, n - j), i, n - j);
    }
}

}  // namespace tpa
