#include "triangulate/four_strips.h"

namespace tpa {

namespace {

using Lengths = Rows<f64>;

Lengths& table_of(StripPaths& s, StripRule rule) { return s.least[static_cast<u32>(rule)]; }

f64 begun(const Rows<f64>* before, u32 i, u32 j) { return before == nullptr ? no_way : (*before)[i][j]; }

// Steps of one kind only: no change of direction.
void fill_borders(const StripPaths& s, const Rows<f64>* before, const Lengths& any, const Lengths& x_before,
                  const Lengths& y_before) {
  any[0][0] = before == nullptr ? s.edge[0][0] : min_of(no_way, begun(before, 0, 0) + s.edge[0][0]);
  for (u32 i = 1; i <= s.p; ++i)
    any[i][0] = min_of(no_way, s.edge[i][0] + min_of(begun(before, i, 0), s.by_x[i][0] ? any[i - 1][0] : no_way));
  for (u32 j = 1; j <= s.q; ++j)
    any[0][j] = min_of(no_way, s.edge[0][j] + min_of(begun(before, 0, j), s.by_y[0][j] ? any[0][j - 1] : no_way));
  for (u32 i = 0; i <= s.p; ++i) x_before[i][0] = y_before[i][0] = no_way;
  for (u32 j = 0; j <= s.q; ++j) x_before[0][j] = y_before[0][j] = no_way;
}

}  // namespace

void lay_out_strip_paths(Carver& carver, u64 cells, u64 line, StripPaths& s) {
  carver.take(s.edge.data, cells);
  carver.take(s.by_x.data, cells), carver.take(s.by_y.data, cells);
  for (u32 rule = 0; rule < strip_rules; ++rule) {
    const bool split = rule == static_cast<u32>(StripRule::x_split) || rule == static_cast<u32>(StripRule::y_split);
    carver.take(s.least[rule].data, split ? line : cells);
  }
}

void set_sides(u32 p, u32 q, StripPaths& s) {
  s.p = p, s.q = q;
  s.edge.width = s.by_x.width = s.by_y.width = q + 1;
  for (Lengths& table : s.least) table.width = q + 1;
  // Only strips that take all steps of a polygon are asked to split them: one line, (p, j) at j, or (i, q) at i + q.
  table_of(s, StripRule::x_split).width = 0, table_of(s, StripRule::y_split).width = 1;
}

void fill_strip_paths(StripPaths& s, const Rows<f64>* before) {
  const Lengths any = table_of(s, StripRule::any), x_before = table_of(s, StripRule::x_before),
                y_before = table_of(s, StripRule::y_before);
  fill_borders(s, before, any, x_before, y_before);
  // "A step before" is met by a change of direction, whatever comes before that.
  for (u32 i = 1; i <= s.p; ++i)
    for (u32 j = 1; j <= s.q; ++j) {
      const f64 edge = s.edge[i][j];
      const f64 from_x = s.by_x[i][j] ? any[i - 1][j] : no_way, from_y = s.by_y[i][j] ? any[i][j - 1] : no_way;
      any[i][j] = min_of(no_way, edge + min_of(begun(before, i, j), min_of(from_x, from_y)));
      x_before[i][j] = min_of(no_way, edge + min_of(s.by_x[i][j] ? x_before[i - 1][j] : no_way, from_y));
      y_before[i][j] = min_of(no_way, edge + min_of(s.by_y[i][j] ? y_before[i][j - 1] : no_way, from_x));
    }
  const Lengths x_split = table_of(s, StripRule::x_split), y_split = table_of(s, StripRule::y_split);
  for (u32 j = 0; j <= s.q; ++j)
    x_split[s.p][j] = min_of(no_way, s.edge[s.p][j] + min_of(j > 0 && s.by_y[s.p][j] ? x_split[s.p][j - 1] : no_way,
                                                             s.by_x[s.p][j] ? x_before[s.p - 1][j] : no_way));
  for (u32 i = 0; i <= s.p; ++i)
    y_split[i][s.q] = min_of(no_way, s.edge[i][s.q] + min_of(i > 0 && s.by_x[i][s.q] ? y_split[i - 1][s.q] : no_way,
                                                             s.by_y[i][s.q] ? y_before[i][s.q - 1] : no_way));
}

}  // namespace tpa
