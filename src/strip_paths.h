// strip_paths: the shortest open strips that begin at one edge between two polygons, to all edges at once (design
// 4.4, "dynamic programming over strips"; after Fuchs, Kedem and Uselton 1977).
//
// An open strip is a lattice path: from edge (x_0, y_0) by steps forwards on x and backwards on y. It may take all
// steps of one polygon, but then not all of them in a row, and not all steps of both: an edge would occur twice.
#pragma once

#include "vec3.h"

namespace tpa {

// On one polygon: those of the database, for which the tables here are made.
inline constexpr u32 most_steps = 15;

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
  static constexpr u32 reach = most_steps + 1;
  u32 p = 0, q = 0;                 // sides of x and y
  f64 edge[reach][reach];           // length of the edge after i steps on x and j on y
  bool by_x[reach][reach], by_y[reach][reach];  // may it be reached by a step on x, on y?
  f64 least[strip_rules][reach][reach];  // total edge length of the shortest strip to there, both ends included
};

// Pre: all but `least` is set.
void fill_strip_paths(StripPaths& paths);

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
