// four_strips: the shortest open strips that begin at one edge between two polygons, to all edges at once, by
// dynamic programming (docs/handles.md; after Fuchs, Kedem and Uselton 1977).
//
// An open strip is a lattice path: from edge (x_0, y_0) by steps forwards on x and backwards on y. It may take all
// steps of one polygon, but then not all of them in a row, and not all steps of both: an edge would occur twice.
#pragma once

#include "base/arena.h"
#include "base/vec3.h"

namespace tpa {

// What is asked of the steps of a strip, read up to some edge.
enum class StripRule : u8 {
  any,
  x_split,   // steps on x at two places at least, with a step on y between them
  x_before,  // a step on x, and after it a step on y
  y_split,
  y_before
};
inline constexpr u32 strip_rules = 5;

struct StripPaths {
  u32 p = 0, q = 0;              // sides of x and y
  Rows<f64> edge;                // length of the edge after i steps on x and j on y
  Rows<bool> by_x, by_y;         // may it be reached by a step on x, on y?
  Rows<f64> least[strip_rules];  // total edge length of the shortest strip to there, both ends included
};

// Takes room for loops whose (p + 1) (q + 1) and p + q + 1 are at most these.
void lay_out_strip_paths(Carver& carver, u64 cells, u64 line, StripPaths& paths);
// To be called before anything is set.
void set_sides(u32 p, u32 q, StripPaths& paths);
// Pre: all but `least` is set. With `before`, strips begin wherever it has a way: it tells what that costs, by steps on
// x and y, without the edge there. Rules other than `any` are then for strips that all begin on the same border.
void fill_strip_paths(StripPaths& paths, const Rows<f64>* before = nullptr);

// The rule for strips that end after i steps on x and j on y, and the length of the shortest one.
constexpr bool strip_is_possible(const StripPaths& s, u32 i, u32 j) { return i < s.p || j < s.q; }
constexpr StripRule strip_rule(const StripPaths& s, u32 i, u32 j) {
  return i == s.p ? StripRule::x_split : j == s.q ? StripRule::y_split : StripRule::any;
}
constexpr f64 least_strip(const StripPaths& s, StripRule rule, u32 i, u32 j) {
  return s.least[static_cast<u32>(rule)][i][j];
}
constexpr f64 least_strip(const StripPaths& s, u32 i, u32 j) {
  return strip_is_possible(s, i, j) ? least_strip(s, strip_rule(s, i, j), i, j) : no_way;
}

// What is left to ask of a strip once its last step has been read off.
constexpr StripRule rule_before_x(StripRule rule) {
  return rule == StripRule::x_split ? StripRule::x_before : rule == StripRule::y_before ? StripRule::any : rule;
}
constexpr StripRule rule_before_y(StripRule rule) {
  return rule == StripRule::y_split ? StripRule::y_before : rule == StripRule::x_before ? StripRule::any : rule;
}

}  // namespace tpa
