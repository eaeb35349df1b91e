// shortest: a search for the shortest handles, depth first, with the least lengths to go (design 4.4).
#include "shortest.h"

namespace tpa {

namespace {

using Phase = ShortStep::Phase;

// A step of the depth-first search being one: filling a walk table, or the tables of polygons in a row; measuring another
// base; asking about a face, which is a query of the mesh.
constexpr u64 work_of_a_table = 64, work_of_a_base = 8, work_of_a_question = 16;

// Sums of less than 200 lengths in different orders differ by less than this, relatively.
constexpr f64 rounding = 1.0 / (u64{1} << 40);

struct Search {
  const ShortLoops& loops;
  ShortestScratch& s;
  Span<ShortHandle> best;
  f64 limit;
  u32 count = 0;
  u32 faces = 0;  // of a handle
  u64 work = 0, most_work = 0;
  ShortBase base = {}, measured = {};
  bool any_measured = false;
  WalkEnds ends = {};
  u32 pieces = 0;
};

// Less than no_way in any case: what leads nowhere is never followed.
f64 allowed(const Search& x) {
  f64 most = min_of(x.limit, 0.5 * no_way);
  if (x.count == x.best.size) most = min_of(most, x.best[x.count - 1].length);
  return most + most * rounding;
}

u32 vertex(const Search& x, u32 polygon, u32 at) { return x.loops.first[polygon] + at; }

void put_face(Search& x, ShortStep& step, u32 a, u32 b, u32 c) {
  u8(&face)[3] = x.s.face[step.faces++];
  face[0] = static_cast<u8>(a), face[1] = static_cast<u8>(b), face[2] = static_cast<u8>(c);
}

constexpr u32 loop_of(const ShortLoops& loops, u32 v) {
  u32 l = 0;
  while (v >= loops.first[l + 1]) ++l;
  return l;
}

// The place of an inner triangle in the memory: the loop that it does not touch, its corners in the order of the loops,
// and which way round it goes.
u32 inner_place(const ShortLoops& loops, u32 a, u32 b, u32 c) {
  u32 at[4] = {none, none, none, none};
  const u32 la = loop_of(loops, a), lb = loop_of(loops, b), lc = loop_of(loops, c);
  at[la] = a - loops.first[la], at[lb] = b - loops.first[lb], at[lc] = c - loops.first[lc];
  u32 place = 6 - la - lb - lc;
  for (u32 l = 0; l < 4; ++l)
    if (at[l] != none) place = most_steps * place + at[l];
  const bool ascending = (la < lb) + (lb < lc) + (lc < la) == 2;
  return 2 * place + (ascending ? 1 : 0);
}

// Other faces are asked for when their strips are measured.
bool inner_is_free(Search& x, u32 a, u32 b, u32 c) {
  if (x.loops.filter.ask == nullptr) return true;
  const u32 place = inner_place(x.loops, a, b, c), word = place / 32, bit = 1u << (place % 32);
  InnerMemory& memory = x.s.inner;
  if ((memory.asked[word] & bit) == 0) {
    memory.asked[word] |= bit;
    x.work += work_of_a_question;
    if (is_free(x.loops.filter, a, b, c)) memory.free[word] |= bit;
  }
  return (memory.free[word] & bit) != 0;
}

// False where the triangle may not be part of a handle.
bool put_inner_face(Search& x, ShortStep& step, u32 a, u32 b, u32 c) {
  put_face(x, step, a, b, c);
  return inner_is_free(x, a, b, c);
}

// ---------------------------------------------------------------- complete handles

// The length of the handle in hand, or false where it has an edge twice.
bool measure_faces(const Search& x, u32 faces, f64& length) {
  u64 seen[most_short_vertices] = {};
  length = 0;
  for (u32 f = 0; f < faces; ++f)
    for (u32 c = 0; c < 3; ++c) {
      const u32 v = x.s.face[f][c], w = x.s.face[f][(c + 1) % 3];
      if ((seen[v] >> w) & 1) return false;
      seen[v] |= u64{1} << w;
      if (v < w && loop_of(x.loops, v) != loop_of(x.loops, w)) length += x.s.base.distance[v][w];
    }
  return true;
}

void enter_handle(Search& x) {
  f64 length;
  if (!measure_faces(x, x.faces, length) || length > allowed(x)) return;
  const bool full = x.count == x.best.size;
  if (full && length >= x.best[x.count - 1].length) return;
  u32 at = full ? x.count - 1 : x.count++;
  for (; at > 0 && length < x.best[at - 1].length; --at) x.best[at] = x.best[at - 1];
  x.best[at].length = length;
  for (u32 f = 0; f < x.faces; ++f)
    for (u32 c = 0; c < 3; ++c) x.best[at].face[f][c] = x.s.face[f][c];
}

// ---------------------------------------------------------------- pieces: what the walk leaves

f64 to_go(const Search& x, const ShortStep& step) {
  switch (step.phase) {
    case Phase::walk:
      return length_to_go(x.s.table, step.walk);
    case Phase::tail:
      return x.s.base.tail[step.i][step.j];
    case Phase::middle:
      return x.s.base.middle[step.i][step.j];
    case Phase::strip:
      break;
  }
  return least_strip(x.s.base.paths[x.s.piece[step.piece].strip], step.rule, step.i, step.j);
}

// Nothing is left of a strip that has come back to the base, nor of a tail that has come round to it.
bool is_over(const Search& x, Phase phase, u32 i, u32 j) {
  if (phase == Phase::tail) return i == x.loops.sides(x.base.a) && j == x.loops.sides(x.base.b);
  return phase == Phase::strip && i + j == 0;
}

// Goes on with piece `number`, or enters the handle where there is none. `spent` includes the shortest way for all
// that is left.
bool begin_piece(Search& x, u32 number, u8 faces, f64 spent, ShortStep& step) {
  while (number < x.pieces && is_over(x, x.s.piece[number].phase, x.s.piece[number].i, x.s.piece[number].j)) ++number;
  if (number == x.pieces) {
    enter_handle(x);
    return false;
  }
  const ShortPiece& piece = x.s.piece[number];
  step = {};
  step.phase = piece.phase, step.piece = static_cast<u8>(number);
  step.i = piece.i, step.j = piece.j, step.faces = faces;
  if (piece.phase == Phase::strip) step.rule = strip_rule(x.s.base.paths[piece.strip], piece.i, piece.j);
  step.spent = spent - to_go(x, step);
  return true;
}

void list_pieces(Search& x) {
  const RoundWalk& w = x.s.base.walk;
  const u8 *left = x.s.left_at, *entered = x.s.entered_at;
  x.pieces = 0;
  switch (x.base.kind) {
    case BaseKind::three:
    case BaseKind::tetrahedron:
      for (u32 t = 0; t < 3; ++t)
        x.s.piece[x.pieces++] = {Phase::strip, static_cast<u8>(t), entered[(t + 1) % 3],
                                 static_cast<u8>(x.s.base.paths[t].q - left[t])};
      return;
    case BaseKind::row:
      break;
  }
  x.s.piece[x.pieces++] = {Phase::tail, 0, left[0], static_cast<u8>(w.sides[1] - entered[1])};
  x.s.piece[x.pieces++] = {Phase::middle, 0, entered[0], static_cast<u8>(w.sides[1] - left[1])};
}

// Options 0 and 1 of a strip: its last step was on x, or on y.
bool extend_strip(Search& x, const ShortStep& from, ShortStep& child) {
  const StripPaths& paths = x.s.base.paths[x.s.piece[from.piece].strip];
  const StripPlace at = strip_place(x.base, x.s.piece[from.piece].strip);
  const bool on_x = from.option == 0;
  if (!(on_x ? paths.by_x : paths.by_y)[from.i][from.j]) return false;
  child.spent += paths.edge[from.i][from.j];
  const u32 a = vertex(x, at.x, forwards(paths.p, at.at_x, from.i));
  const u32 b = vertex(x, at.y, backwards(paths.q, at.at_y, from.j));
  if (on_x) {
    --child.i, child.rule = rule_before_x(from.rule);
    put_face(x, child, vertex(x, at.x, forwards(paths.p, at.at_x, child.i)), a, b);
  } else {
    --child.j, child.rule = rule_before_y(from.rule);
    put_face(x, child, b, vertex(x, at.y, backwards(paths.q, at.at_y, child.j)), a);
  }
  return true;
}

// The strip's face between edge (i, j) and the next one, between A and B of a row.
void put_row_face(Search& x, ShortStep& child, bool on_a, u32 i, u32 j) {
  const ShortBase& base = x.base;
  const u32 m = x.loops.sides(base.a), n = x.loops.sides(base.b);
  const u32 a = vertex(x, base.a, forwards(m, base.at_a, i)), b = vertex(x, base.b, backwards(n, base.at_b, j));
  if (on_a)
    put_face(x, child, a, vertex(x, base.a, forwards(m, base.at_a, i + 1)), b);
  else
    put_face(x, child, vertex(x, base.b, backwards(n, base.at_b, j + 1)), b, a);
}

// Options 0 and 1 of a tail: the next step is on A, or on B.
bool extend_tail(Search& x, const ShortStep& from, ShortStep& child) {
  const bool on_a = from.option == 0;
  if (on_a ? from.i == x.loops.sides(x.base.a) : from.j == x.loops.sides(x.base.b)) return false;
  child.spent += x.s.base.wide[from.i][from.j];
  put_row_face(x, child, on_a, from.i, from.j);
  ++(on_a ? child.i : child.j);
  return (on_a ? x.s.base.wide_by_a : x.s.base.wide_by_b)[child.i][child.j];
}

// Options 0 and 1 of a middle: its last step was on A, or on B. Option 2 + v: C came before, v of its steps facing A.
bool extend_middle(Search& x, const ShortStep& from, ShortStep& child) {
  child.spent += x.s.base.wide[from.i][from.j];
  if (from.option < 2) {
    const bool on_a = from.option == 0;
    if (!(on_a ? x.s.base.wide_by_a : x.s.base.wide_by_b)[from.i][from.j]) return false;
    --(on_a ? child.i : child.j);
    put_row_face(x, child, on_a, child.i, child.j);
    return true;
  }
  const ShortBase& b = x.base;
  const u32 m = x.loops.sides(b.a), n = x.loops.sides(b.b), q = x.loops.sides(b.c), v = from.option - 2u;
  if (v > q) return false;
  const f64 way = way_round_c(x.s.base, v, from.i, from.j);
  if (child.spent + way > allowed(x)) return false;
  if (!put_inner_face(x, child, vertex(x, b.a, forwards(m, b.at_a, from.i)),
                      vertex(x, b.b, backwards(n, b.at_b, from.j)), vertex(x, b.c, backwards(q, b.at_c, v))))
    return false;
  x.pieces = from.piece + 1u;
  x.s.piece[x.pieces++] = {Phase::strip, 0, from.i, static_cast<u8>(v)};
  x.s.piece[x.pieces++] = {Phase::strip, 1, static_cast<u8>(q - v), from.j};
  return begin_piece(x, from.piece + 1u, child.faces, child.spent + way, child);
}

bool extend_piece(Search& x, const ShortStep& from, ShortStep& child) {
  if (from.phase == Phase::middle) return extend_middle(x, from, child);
  const bool extended = from.phase == Phase::tail ? extend_tail(x, from, child) : extend_strip(x, from, child);
  if (!extended) return false;
  if (!is_over(x, child.phase, child.i, child.j)) return true;
  const f64 spent = child.spent + to_go(x, child);
  return spent <= allowed(x) && begin_piece(x, from.piece + 1u, child.faces, spent, child);
}

// ---------------------------------------------------------------- the walk

u32 walk_vertex(const Search& x, u32 track, u32 step) {
  const u32 polygon = track_polygon(x.base, track);
  return vertex(x, polygon, forwards(x.loops.sides(polygon), track_origin(x.base, track), step));
}
u32 row_vertex(const Search& x, u32 row) {
  return vertex(x, x.base.d, backwards(x.loops.sides(x.base.d), 0, row));
}

// Option 0: a step on D.
bool step_down(Search& x, const ShortStep& from, ShortStep& child) {
  const RoundWalk& w = x.s.base.walk;
  const u32 track = track_of(w, x.ends, from.walk.layer);
  const bool home = is_home(w, x.ends, from.walk);
  if (!home && !down(w, x.ends, child.walk)) return false;
  put_face(x, child, row_vertex(x, from.walk.row + 1u), row_vertex(x, from.walk.row),
           walk_vertex(x, track, from.walk.step));
  if (home) {
    list_pieces(x);
    return begin_piece(x, 0, child.faces, from.spent, child);
  }
  child.spent += w.around[track][child.walk.row][child.walk.step];
  return true;
}

// Option 1: a step on the track.
bool step_along(Search& x, const ShortStep& from, ShortStep& child) {
  const RoundWalk& w = x.s.base.walk;
  const u32 track = track_of(w, x.ends, from.walk.layer);
  if (!along(w, x.ends, child.walk)) return false;
  put_face(x, child, walk_vertex(x, track, from.walk.step), walk_vertex(x, track, child.walk.step),
           row_vertex(x, from.walk.row));
  child.spent += w.around[track][child.walk.row][child.walk.step];
  return true;
}

// Option 2 + j: on to step j of the next track.
bool change_track(Search& x, const ShortStep& from, ShortStep& child) {
  const RoundWalk& w = x.s.base.walk;
  const u32 j = from.option - 2u, track = track_of(w, x.ends, from.walk.layer), next = (track + 1) % w.tracks;
  if (!change(w, x.ends, j, child.walk)) return false;
  child.spent += w.link[track][from.walk.step][j] + w.around[next][from.walk.row][j];
  if (child.spent + to_go(x, child) > allowed(x)) return false;
  x.s.left_at[track] = from.walk.step, x.s.entered_at[next] = static_cast<u8>(j);
  return put_inner_face(x, child, walk_vertex(x, track, from.walk.step), walk_vertex(x, next, j),
                        row_vertex(x, from.walk.row));
}

bool extend_walk(Search& x, const ShortStep& from, ShortStep& child) {
  if (from.option == 0) return step_down(x, from, child);
  return from.option == 1 ? step_along(x, from, child) : change_track(x, from, child);
}

// ---------------------------------------------------------------- the search

u32 option_count(const ShortStep& step) {
  constexpr u32 changes = RoundWalk::reach;
  return step.phase == Phase::walk || step.phase == Phase::middle ? 2 + changes : 2;
}

// Follows every way from the step at the bottom that can still be among the best.
void search_from(Search& x, const ShortStep& bottom) {
  ShortStep* steps = x.s.step;
  u32 depth = 0;
  steps[0] = bottom;
  for (;;) {
    ShortStep& top = steps[depth];
    if (top.option == option_count(top)) {
      if (depth-- == 0) return;
      continue;
    }
    ShortStep& child = steps[depth + 1];
    child = top, child.option = 0;
    const bool extended = top.phase == Phase::walk ? extend_walk(x, top, child) : extend_piece(x, top, child);
    ++top.option;
    if (++x.work >= x.most_work) return;
    if (extended && child.spent + to_go(x, child) <= allowed(x)) ++depth;
  }
}

// The face of a base that no walk passes.
HandleFace base_face(const Search& x, const ShortBase& b) {
  const u32 va = vertex(x, b.a, b.at_a), vb = vertex(x, b.b, b.at_b), vc = vertex(x, b.c, b.at_c);
  return b.kind == BaseKind::row ? HandleFace{{va, vc, vb}} : HandleFace{{va, vb, vc}};
}
void put_base_face(Search& x, ShortStep& step) {
  const HandleFace face = base_face(x, x.base);
  put_face(x, step, face.v[0], face.v[1], face.v[2]);
}

// Walks that begin on a track at one of its steps, and end there.
void search_start(Search& x, const WalkEnds& ends) {
  x.ends = ends;
  fill_walk_table(x.s.base.walk, ends, x.s.table);
  x.work += work_of_a_table;
  ShortStep bottom;
  bottom.walk = walk_start(ends, ends.end);
  bottom.spent = x.s.base.walk.around[ends.start][0][ends.end];
  if (bottom.spent + to_go(x, bottom) > allowed(x)) return;
  put_base_face(x, bottom);
  search_from(x, bottom);
}

void search_walks(Search& x) {
  const RoundWalk& w = x.s.base.walk;
  f64 least[RoundWalk::reach];
  for (u32 start = 0; start < w.tracks; ++start) {
    fill_walk_table(w, {start, none}, x.s.table);
    x.work += work_of_a_table;
    for (u32 i = 0; i <= w.sides[start]; ++i)
      least[i] = w.around[start][0][i] + length_to_go(x.s.table, walk_start({start, none}, i));
    for (u32 i = 0; i <= w.sides[start] && x.work < x.most_work; ++i)
      if (least[i] <= allowed(x)) search_start(x, {start, i});
  }
}

// Three polygons: the strips leave A after i, C after k, B after j steps from the base, at the other inner triangle.
void search_triangle(Search& x, u32 i, u32 k, u32 j, f64 length) {
  const ShortBase& b = x.base;
  const u32 at[3] = {vertex(x, b.a, forwards(x.loops.sides(b.a), b.at_a, i)),
                     vertex(x, b.c, forwards(x.loops.sides(b.c), b.at_c, k)),
                     vertex(x, b.b, forwards(x.loops.sides(b.b), b.at_b, j))};
  ShortStep bottom;
  put_base_face(x, bottom);
  if (!put_inner_face(x, bottom, at[0], at[1], at[2])) return;
  const u32 steps[3] = {i, k, j};
  for (u32 t = 0; t < 3; ++t) x.s.left_at[t] = x.s.entered_at[t] = static_cast<u8>(steps[t]);
  list_pieces(x);
  if (begin_piece(x, 0, bottom.faces, length, bottom)) search_from(x, bottom);
}

// All second triangles that can still be among the best, found by what each pair of its corners costs.
void search_triangles(Search& x) {
  const u32 m = x.loops.sides(x.base.a), q = x.loops.sides(x.base.c), n = x.loops.sides(x.base.b);
  const auto &ac = x.s.base.walk.link[0], &cb = x.s.base.walk.link[1], &ba = x.s.base.walk.link[2];
  f64 least_cb[RoundWalk::reach];  // from any step of C
  for (u32 j = 0; j <= n; ++j) least_cb[j] = cb[0][j];
  for (u32 k = 1; k <= q; ++k)
    for (u32 j = 0; j <= n; ++j) least_cb[j] = min_of(least_cb[j], cb[k][j]);
  for (u32 i = 0; i <= m; ++i) {
    f64 least_ac = ac[i][0];
    for (u32 k = 1; k <= q; ++k) least_ac = min_of(least_ac, ac[i][k]);
    const f64 most = allowed(x) - least_ac;
    for (u32 j = 0; j <= n; ++j) {
      if (least_cb[j] + ba[j][i] > most) continue;
      for (u32 k = 0; k <= q; ++k) {
        const f64 length = ac[i][k] + (cb[k][j] + ba[j][i]);
        if (length <= allowed(x)) search_triangle(x, i, k, j, length);
      }
    }
  }
}

void search_base(Search& x, const ShortBase& base) {
  const HandleFace face = base_face(x, base);
  if (x.work >= x.most_work || !inner_is_free(x, face.v[0], face.v[1], face.v[2])) return;
  x.work += base.kind == BaseKind::row ? work_of_a_table : work_of_a_base;
  x.base = base;
  measure_base(x.loops, base, x.any_measured ? &x.measured : nullptr, x.s.base);
  x.measured = base, x.any_measured = true;
  if (base.kind == BaseKind::three)
    search_triangles(x);
  else
    search_walks(x);
}

void search_bases(Search& x, ShortBase base) {
  const u32 m = x.loops.sides(base.a), n = x.loops.sides(base.b), q = x.loops.sides(base.c);
  for (u32 a = 0; a < m; ++a)
    for (u32 b = 0; b < n; ++b)
      for (u32 c = 0; c < q; ++c) {
        base.at_a = static_cast<u8>(a), base.at_b = static_cast<u8>(b), base.at_c = static_cast<u8>(c);
        search_base(x, base);
      }
}

f64 perimeter(const ShortLoops& loops, u32 loop) {
  const u32 n = loops.sides(loop);
  f64 sum = 0;
  for (u32 v = 0; v < n; ++v)
    sum += length(loops.points[loops.first[loop] + v] - loops.points[loops.first[loop] + (v + 1) % n]);
  return sum;
}

// D is the longest polygon: the one least likely to have all its edges facing one vertex.
u8 longer_of(const ShortLoops& loops, u32 a, u32 b) {
  return static_cast<u8>(perimeter(loops, b) > perimeter(loops, a) ? b : a);
}

void search_three(Search& x) { search_bases(x, {BaseKind::three, 0, 1, 2, 0, 0, 0, 0}); }

void search_four(Search& x) {
  const u8 d = longer_of(x.loops, longer_of(x.loops, 0, 1), longer_of(x.loops, 2, 3));
  u8 other[3] = {};
  for (u8 l = 0, n = 0; l < 4; ++l)
    if (l != d) other[n++] = l;
  search_bases(x, {BaseKind::tetrahedron, other[0], other[1], other[2], d, 0, 0, 0});
  search_bases(x, {BaseKind::tetrahedron, other[0], other[2], other[1], d, 0, 0, 0});
  for (u8 a = 0; a < 4; ++a)
    for (u8 b = static_cast<u8>(a + 1); b < 4; ++b) {
      const u8 c = a == 0 ? (b == 1 ? 2 : 1) : 0, rest = static_cast<u8>(6 - a - b - c);
      const u8 narrow = longer_of(x.loops, c, rest);
      search_bases(x, {BaseKind::row, a, b, static_cast<u8>(c + rest - narrow), narrow, 0, 0, 0});
    }
}

}  // namespace

u32 shortest_handles(const ShortLoops& loops, f64 limit, u64 work, ShortestScratch& scratch, Span<ShortHandle> best,
                     bool& complete) {
  const u32 faces = loops.first[loops.count] + 2 * loops.count - 4;
  Search x{loops, scratch, best, limit};
  x.faces = faces, x.most_work = work;
  for (u32 w = 0; w < InnerMemory::words; ++w) scratch.inner.asked[w] = scratch.inner.free[w] = 0;
  measure_distances(loops, scratch.base);
  loops.count == 3 ? search_three(x) : search_four(x);
  complete = x.work < x.most_work;
  return x.count;
}

}  // namespace tpa
