#include "short_base.h"

namespace tpa {

void measure_distances(const ShortLoops& loops, BaseScratch& s) {
  const u32 n = loops.first[loops.count];
  for (u32 v = 0; v < n; ++v)
    for (u32 w = 0; w < n; ++w) s.distance[v][w] = length(loops.points[v] - loops.points[w]);
}

StripPlace strip_place(const ShortBase& b, u32 t) {
  const StripPlace ab{b.a, b.b, b.at_a, b.at_b};
  switch (b.kind) {
    case BaseKind::three:
    case BaseKind::tetrahedron:
      if (t == 0) return {b.c, b.a, b.at_c, b.at_a};
      return t == 1 ? StripPlace{b.b, b.c, b.at_b, b.at_c} : ab;
    case BaseKind::row:
      break;
  }
  return t == 0 ? StripPlace{b.a, b.c, b.at_a, b.at_c} : StripPlace{b.c, b.b, b.at_c, b.at_b};
}

u32 track_polygon(const ShortBase& b, u32 t) {
  if (t == 0) return b.a;
  return b.kind == BaseKind::tetrahedron && t == 1 ? b.c : b.b;
}
u32 track_origin(const ShortBase& b, u32 t) {
  if (t == 0) return b.at_a;
  return b.kind == BaseKind::tetrahedron && t == 1 ? b.at_c : b.at_b;
}

namespace {

constexpr u32 reach = StripPaths::reach;

constexpr bool same_place(const StripPlace& s, const StripPlace& t) {
  return s.x == t.x && s.y == t.y && s.at_x == t.at_x && s.at_y == t.at_y;
}

u32 strip_count(BaseKind kind) { return kind == BaseKind::row ? 2 : 3; }

void measure_strip(const ShortLoops& loops, const StripPlace& place, BaseScratch& s, StripPaths& out) {
  out.p = loops.sides(place.x), out.q = loops.sides(place.y);
  for (u32 i = 0; i <= out.p; ++i)
    for (u32 j = 0; j <= out.q; ++j)
      out.edge[i][j] = s.distance[loops.first[place.x] + forwards(out.p, place.at_x, i)]
                                 [loops.first[place.y] + backwards(out.q, place.at_y, j)];
  fill_strip_paths(out);
}

void measure_around(const ShortLoops& loops, const ShortBase& base, BaseScratch& s) {
  RoundWalk& w = s.walk;
  w.rows = loops.sides(base.d);
  w.tracks = base.kind == BaseKind::tetrahedron ? 3 : 2;
  w.must_move = base.kind == BaseKind::row;  // else D would lie between an edge and itself
  for (u32 t = 0; t < w.tracks; ++t) {
    const u32 polygon = track_polygon(base, t), origin = track_origin(base, t);
    w.sides[t] = loops.sides(polygon);
    for (u32 row = 0; row < w.rows; ++row) {
      const f64* from = s.distance[loops.first[base.d] + backwards(w.rows, 0, row)] + loops.first[polygon];
      for (u32 i = 0; i <= w.sides[t]; ++i) w.around[t][row][i] = from[forwards(w.sides[t], origin, i)];
    }
  }
}

// Leaving a track at step i, a strip takes what is left of it, and what the next one has before step j.
void link_by_strip(const StripPaths& paths, f64 (&link)[reach][reach]) {
  for (u32 i = 0; i <= paths.q; ++i)
    for (u32 j = 0; j <= paths.p; ++j) link[i][j] = least_strip(paths, j, paths.q - i);
}

void fill_middle(u32 m, u32 n, BaseScratch& s) {
  for (u32 i = 0; i <= m; ++i)
    for (u32 j = 0; j <= n; ++j) {
      f64 best = no_way;
      for (u32 v = 0; v <= s.paths[0].q; ++v) best = min_of(best, way_round_c(s, v, i, j));
      if (i > 0) best = min_of(best, s.middle[i - 1][j]);
      if (j > 0) best = min_of(best, s.middle[i][j - 1]);
      s.middle[i][j] = min_of(s.wide[i][j] + best, no_way);
    }
}
void fill_tail(u32 m, u32 n, BaseScratch& s) {
  for (u32 i = m + 1; i-- > 0;)
    for (u32 j = n + 1; j-- > 0;) {
      f64 best = i == m && j == n ? 0 : no_way;
      if (i < m) best = min_of(best, s.tail[i + 1][j]);
      if (j < n) best = min_of(best, s.tail[i][j + 1]);
      s.tail[i][j] = s.wide[i][j] + best;
    }
}

void link_row(const ShortLoops& loops, const ShortBase& base, BaseScratch& s) {
  const u32 m = loops.sides(base.a), n = loops.sides(base.b);
  for (u32 i = 0; i <= m; ++i)
    for (u32 j = 0; j <= n; ++j)
      s.wide[i][j] = s.distance[loops.first[base.a] + forwards(m, base.at_a, i)]
                             [loops.first[base.b] + backwards(n, base.at_b, j)];
  fill_middle(m, n, s);
  fill_tail(m, n, s);
  for (u32 i = 0; i <= m; ++i)
    for (u32 j = 0; j <= n; ++j) {
      s.walk.link[0][i][j] = s.tail[i][n - j];
      s.walk.link[1][j][i] = s.middle[i][n - j];
    }
}

}  // namespace

f64 way_round_c(const BaseScratch& s, u32 v, u32 i, u32 j) {
  const StripPaths &ac = s.paths[0], &cb = s.paths[1];
  // No way round C leads back to the edge it began with.
  if (i + j == 0 || (i == ac.p && j == cb.q)) return no_way;
  return min_of(least_strip(ac, i, v) + least_strip(cb, ac.q - v, j), no_way);
}

void measure_base(const ShortLoops& loops, const ShortBase& base, const ShortBase* previous, BaseScratch& s) {
  for (u32 t = 0; t < strip_count(base.kind); ++t) {
    const StripPlace place = strip_place(base, t);
    if (previous != nullptr && previous->kind == base.kind && same_place(place, strip_place(*previous, t))) continue;
    measure_strip(loops, place, s, s.paths[t]);
  }
  if (base.kind != BaseKind::three) measure_around(loops, base, s);
  if (base.kind == BaseKind::row) return link_row(loops, base, s);
  for (u32 t = 0; t < 3; ++t) link_by_strip(s.paths[t], s.walk.link[t]);
}

}  // namespace tpa
