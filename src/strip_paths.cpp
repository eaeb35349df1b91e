#include "strip_paths.h"

namespace tpa {

namespace {

using Table = f64[StripPaths::reach][StripPaths::reach];

Table& table_of(StripPaths& s, StripRule rule) { return s.least[static_cast<u32>(rule)]; }

// All strips, and those with a step on one polygon before one on the other: these begin with a change of direction.
void fill_cell(StripPaths& s, u32 i, u32 j) {
  Table &any = table_of(s, StripRule::any), &x_before = table_of(s, StripRule::x_before),
        &y_before = table_of(s, StripRule::y_before);
  const f64 edge = s.edge[i][j];
  const bool bent = i > 0 && j > 0;
  const f64 from_x = i > 0 ? any[i - 1][j] : no_way, from_y = j > 0 ? any[i][j - 1] : no_way;
  any[i][j] = i + j == 0 ? edge : edge + min_of(from_x, from_y);
  x_before[i][j] = bent ? edge + min_of(x_before[i - 1][j], from_y) : no_way;
  y_before[i][j] = bent ? edge + min_of(y_before[i][j - 1], from_x) : no_way;
}

}  // namespace

void fill_strip_paths(StripPaths& s) {
  for (u32 i = 0; i <= s.p; ++i)
    for (u32 j = 0; j <= s.q; ++j) fill_cell(s, i, j);
  // Only strips that take all steps of a polygon are asked to split them.
  Table &x_split = table_of(s, StripRule::x_split), &y_split = table_of(s, StripRule::y_split);
  const Table &x_before = table_of(s, StripRule::x_before), &y_before = table_of(s, StripRule::y_before);
  for (u32 j = 0; j <= s.q; ++j)
    x_split[s.p][j] = min_of(no_way, s.edge[s.p][j] + min_of(j > 0 ? x_split[s.p][j - 1] : no_way, x_before[s.p - 1][j]));
  for (u32 i = 0; i <= s.p; ++i)
    y_split[i][s.q] = min_of(no_way, s.edge[i][s.q] + min_of(i > 0 ? y_split[i - 1][s.q] : no_way, y_before[i][s.q - 1]));
}

}  // namespace tpa
