#include "triangulate/four_base.h"

namespace tpa {

MostCells most_cells(const ShortLoops& loops) {
  MostCells most;
  for (u32 k = 0; k < 4; ++k) {
    most.longest = max_of(most.longest, loops.sides(k));
    for (u32 l = 0; l < k; ++l) {
      most.cells = max_of(most.cells, (u64{loops.sides(k)} + 1) * (loops.sides(l) + 1));
      most.line = max_of(most.line, u64{loops.sides(k)} + loops.sides(l) + 1);
    }
  }
  return most;
}

void lay_out_bases(Carver& carver, const ShortLoops& loops, BaseScratch& s) {
  const u64 n = loops.first[4];
  const MostCells most = most_cells(loops);
  s.distance.width = static_cast<u32>(n);
  carver.take(s.distance.data, n * n);
  if (loops.filter.ask != nullptr) lay_out_face_memory(carver, n * n, s.memory);
  for (StripPaths& paths : s.paths) lay_out_strip_paths(carver, most.cells, most.line, paths);
  carver.take(s.round_c.data, most.cells), carver.take(s.before_middle.data, most.cells);
  lay_out_round_walk(carver, most.cells, s.walk);
}

void measure_distances(const ShortLoops& loops, BaseScratch& s) {
  const u32 n = loops.first[4];
  forget(s.memory);
  for (u32 v = 0; v < n; ++v)
    for (u32 w = 0; w < n; ++w) s.distance[v][w] = length(loops.points[v] - loops.points[w]);
}

StripPlace strip_place(const ShortBase& b, u32 t) {
  const StripPlace ab{b.a, b.b, b.at_a, b.at_b};
  switch (b.kind) {
    case BaseKind::tetrahedron:
      if (t == 0) return {b.c, b.a, b.at_c, b.at_a};
      return t == 1 ? StripPlace{b.b, b.c, b.at_b, b.at_c} : ab;
    case BaseKind::row: break;
  }
  if (t == middle_strip) return ab;
  if (t == tail_strip) return {b.b, b.a, b.at_b, b.at_a};
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

constexpr bool same_place(const StripPlace& s, const StripPlace& t) {
  return s.x == t.x && s.y == t.y && s.at_x == t.at_x && s.at_y == t.at_y;
}

u32 vertex(const ShortLoops& loops, u32 polygon, u32 at) { return loops.first[polygon] + at; }

// May the face be used that lies over the edge from v to the next vertex?
bool edge_face_is_free(const ShortLoops& loops, const BaseScratch& s, u32 v, u32 next, u32 apex) {
  return loops.filter.ask == nullptr ||
         is_free(loops.filter, s.memory, u64{v} * s.distance.width + apex, {{v, next, apex}});
}

void measure_strip(const ShortLoops& loops, const StripPlace& place, BaseScratch& s, StripPaths& out) {
  set_sides(loops.sides(place.x), loops.sides(place.y), out);
  measure_strip_edges(loops, place, s, out);
  fill_strip_paths(out);
}

void measure_around(const ShortLoops& loops, const ShortBase& base, BaseScratch& s) {
  RoundWalk& w = s.walk;
  const u32 tracks = base.kind == BaseKind::tetrahedron ? 3 : 2;
  u32 sides[3] = {};
  for (u32 t = 0; t < tracks; ++t) sides[t] = loops.sides(track_polygon(base, t));
  set_sides(loops.sides(base.d), tracks, sides, w);
  w.must_move = base.kind == BaseKind::row;  // else D would lie between an edge and itself
  for (u32 t = 0; t < w.tracks; ++t) {
    const u32 polygon = track_polygon(base, t), origin = track_origin(base, t);
    for (u32 row = 0; row < w.rows; ++row) {
      const u32 d = vertex(loops, base.d, backwards(w.rows, 0, row));
      const u32 before_d = vertex(loops, base.d, forwards(w.rows, backwards(w.rows, 0, row), 1));
      for (u32 i = 0; i <= w.sides[t]; ++i) {
        const u32 v = vertex(loops, polygon, forwards(w.sides[t], origin, i));
        const u32 before_v = vertex(loops, polygon, forwards(w.sides[t], origin, i + w.sides[t] - 1));
        w.around[t][row][i] = s.distance[d][v];
        w.by_track[t][row][i] = i > 0 && edge_face_is_free(loops, s, before_v, v, d);
        w.by_d[t][row][i] = edge_face_is_free(loops, s, d, before_d, v);
      }
    }
  }
}

// Leaving a track at step i, a strip takes what is left of it, and what the next one has before step j.
void link_by_strip(const StripPaths& paths, const Rows<f64>& link) {
  for (u32 i = 0; i <= paths.q; ++i)
    for (u32 j = 0; j <= paths.p; ++j) link[i][j] = least_strip(paths, j, paths.q - i);
}

void measure_round_c(u32 m, u32 n, BaseScratch& s) {
  s.round_c.width = n + 1;
  for (u32 i = 0; i <= m; ++i)
    for (u32 j = 0; j <= n; ++j) {
      f64 best = no_way;
      for (u32 v = 0; v <= s.paths[0].q; ++v) best = min_of(best, way_round_c(s, v, i, j));
      s.round_c[i][j] = best;
    }
}

}  // namespace

void measure_strip_edges(const ShortLoops& loops, const StripPlace& place, BaseScratch& s, const StripPaths& out) {
  const u32 p = loops.sides(place.x), q = loops.sides(place.y);
  for (u32 i = 0; i <= p; ++i)
    for (u32 j = 0; j <= q; ++j) {
      const u32 x = vertex(loops, place.x, forwards(p, place.at_x, i));
      const u32 y = vertex(loops, place.y, backwards(q, place.at_y, j));
      out.edge[i][j] = s.distance[x][y];
      const u32 before_x = vertex(loops, place.x, forwards(p, place.at_x, i + p - 1));
      const u32 before_y = vertex(loops, place.y, forwards(q, backwards(q, place.at_y, j), 1));
      out.by_x[i][j] = i > 0 && edge_face_is_free(loops, s, before_x, x, y);
      out.by_y[i][j] = j > 0 && edge_face_is_free(loops, s, y, before_y, x);
    }
}

f64 way_round_c(const BaseScratch& s, u32 v, u32 i, u32 j) {
  const StripPaths &ac = s.paths[0], &cb = s.paths[1];
  // No way round C leads back to the edge it began with.
  if (i + j == 0 || (i == ac.p && j == cb.q)) return no_way;
  return min_of(least_strip(ac, i, v) + least_strip(cb, ac.q - v, j), no_way);
}

void measure_base(const ShortLoops& loops, const ShortBase& base, const ShortBase* previous, BaseScratch& s) {
  for (u32 t = 0; t < 3; ++t) {
    const StripPlace place = strip_place(base, t);
    if (previous != nullptr && previous->kind == base.kind && same_place(place, strip_place(*previous, t))) continue;
    measure_strip(loops, place, s, s.paths[t]);
  }
  measure_around(loops, base, s);
  if (base.kind == BaseKind::row) return measure_round_c(loops.sides(base.a), loops.sides(base.b), s);
  for (u32 t = 0; t < 3; ++t) link_by_strip(s.paths[t], s.walk.link[t]);
}

}  // namespace tpa
