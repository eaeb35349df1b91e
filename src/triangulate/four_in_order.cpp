// four_in_order: a search for the shortest handles, depth first, with the least lengths to go (docs/handles.md).
#include "triangulate/four_in_order.h"

namespace tpa {

namespace {

using Phase = ShortStep::Phase;

// A step of the depth-first search being one: filling a walk table, or the tables of polygons in a row, up to so many
// sums; a bound for several starts is made of a third of these, having fewer marks; measuring another base, up to so
// many edges; asking about a face, which is a query of the mesh.
constexpr u64 work_of_a_table = 64, bounds_in_a_table = 3, table_sums = 15 * 3 * 16 * 16, work_of_a_base = 8,
              base_edges = 6 * 16 * 16, work_of_a_question = 16;
constexpr u64 times(u64 work, u64 count, u64 usual) { return work * max_of<u64>(1, (count + usual - 1) / usual); }

// Sums of less than 2^11 lengths in different orders differ by less than this, relatively.
constexpr f64 rounding = 1.0 / (u64{1} << 40);

struct Search {
  const ShortLoops& loops;
  ShortestScratch& s;
  f64 limit;
  u64 work = 0, most_work = 0;
  ShortBase base = {}, measured = {};
  RowCase row = {};  // where the base is a row's
  bool any_measured = false;
  u64 of_a_table = 0, of_a_base = 0;  // work, for the base's polygons
  WalkEnds ends = {};
  u32 pieces = 0;
};

// How long a handle may be that is looked for: shorter than the last one of as many as are wanted. Less than no_way in
// any case: what leads nowhere is never followed.
f64 allowed(const Search& x) {
  const f64 limit = min_of(x.limit, 0.5 * no_way) * (1 + rounding);
  const ShortHandles& found = x.s.found;
  return found.count < found.best.size ? limit : min_of(limit, found.best[found.count - 1].length * (1 - rounding));
}

u32 vertex(const Search& x, u32 polygon, u32 at) { return x.loops.first[polygon] + at; }

void put_face(Search& x, ShortStep& step, u32 a, u32 b, u32 c) { x.s.face[step.faces++] = {{a, b, c}}; }

// The place of an inner triangle in the memory: the loop that it does not touch, its corners in the order of the loops,
// and which way round it goes.
u64 inner_place(const ShortLoops& loops, const ShortestScratch& s, u32 a, u32 b, u32 c) {
  u32 at[4] = {none, none, none, none};
  const u32 la = loop_of(loops, a), lb = loop_of(loops, b), lc = loop_of(loops, c);
  at[la] = a - loops.first[la], at[lb] = b - loops.first[lb], at[lc] = c - loops.first[lc];
  u64 place = 0;
  for (u32 l = 0; l < 4; ++l)
    if (at[l] != none) place = loops.sides(l) * place + at[l];
  const bool ascending = (la < lb) + (lb < lc) + (lc < la) == 2;
  return s.inner_places[6 - la - lb - lc] + 2 * place + (ascending ? 1 : 0);
}

// Other faces are asked for when their strips are measured.
bool inner_is_free(Search& x, u32 a, u32 b, u32 c) {
  if (x.loops.filter.ask == nullptr) return true;
  const u64 place = inner_place(x.loops, x.s, a, b, c);
  if (!is_known(x.s.inner, place)) x.work += work_of_a_question;
  return is_free(x.loops.filter, x.s.inner, place, {{a, b, c}});
}

// False where the triangle may not be part of a handle.
bool put_inner_face(Search& x, ShortStep& step, u32 a, u32 b, u32 c) {
  put_face(x, step, a, b, c);
  return inner_is_free(x, a, b, c);
}

// ---------------------------------------------------------------- complete handles

// Of the handle in hand. Each edge has two faces, one for each direction.
f64 measure_faces(const Search& x) {
  f64 length = 0;
  for (u32 f = 0; f < x.loops.first[4] + 4; ++f)
    for (u32 c = 0; c < 3; ++c) {
      const u32 v = x.s.face[f].v[c], w = x.s.face[f].v[(c + 1) % 3];
      if (v < w && loop_of(x.loops, v) != loop_of(x.loops, w)) length += x.s.base.distance[v][w];
    }
  return length;
}

void enter_handle(Search& x) {
  const f64 length = measure_faces(x);
  if (length <= allowed(x)) enter_handle(x.loops, length, x.s.face, x.s.found);
}

// ---------------------------------------------------------------- pieces: what the walk leaves

f64 to_go(const Search& x, const ShortStep& step) {
  if (step.phase == Phase::walk) return length_to_go(x.s.table, step.walk);
  return least_strip(x.s.base.paths[x.s.piece[step.piece].strip], step.rule, step.i, step.j);
}

StripRule piece_rule(const Search& x, const ShortPiece& piece) {
  const StripPaths& paths = x.s.base.paths[piece.strip];
  if (x.base.kind == BaseKind::row && piece.strip == middle_strip) return middle_rule(x.row, paths, piece.i, piece.j);
  if (x.base.kind == BaseKind::row && piece.strip == tail_strip) return tail_rule(x.row, paths, piece.i, piece.j);
  return strip_rule(paths, piece.i, piece.j);
}

// Nothing is left of a strip that has come back to the base.
bool is_over(u32 i, u32 j) { return i + j == 0; }

// Goes on with piece `number`, or enters the handle where there is none. `spent` includes the shortest way for all
// that is left.
bool begin_piece(Search& x, u32 number, u16 faces, f64 spent, ShortStep& step) {
  while (number < x.pieces && is_over(x.s.piece[number].i, x.s.piece[number].j)) ++number;
  if (number == x.pieces) {
    enter_handle(x);
    return false;
  }
  const ShortPiece& piece = x.s.piece[number];
  step = {};
  step.phase = Phase::strip, step.piece = static_cast<u8>(number);
  step.i = piece.i, step.j = piece.j, step.faces = faces;
  step.rule = piece_rule(x, piece);
  step.spent = spent - to_go(x, step);
  return true;
}

void list_pieces(Search& x) {
  const RoundWalk& w = x.s.base.walk;
  const u16 *left = x.s.left_at, *entered = x.s.entered_at;
  x.pieces = 0;
  switch (x.base.kind) {
    case BaseKind::tetrahedron:
      for (u32 t = 0; t < 3; ++t)
        x.s.piece[x.pieces++] = {static_cast<u8>(t), entered[(t + 1) % 3],
                                 static_cast<u16>(x.s.base.paths[t].q - left[t])};
      return;
    case BaseKind::row: break;
  }
  x.s.piece[x.pieces++] = {tail_strip, entered[1], static_cast<u16>(w.sides[0] - left[0])};
  x.s.piece[x.pieces++] = {middle_strip, entered[0], static_cast<u16>(w.sides[1] - left[1])};
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

// Option 2 + v of a middle: C came before, v of its steps facing A.
bool extend_to_c(Search& x, const ShortStep& from, ShortStep& child) {
  const ShortBase& b = x.base;
  const u32 m = x.loops.sides(b.a), n = x.loops.sides(b.b), q = x.loops.sides(b.c), v = from.option - 2u;
  if (from.rule != StripRule::any || x.s.base.before_middle[from.i][from.j] == no_way) return false;
  child.spent += x.s.base.paths[middle_strip].edge[from.i][from.j];
  const f64 way = way_round_c(x.s.base, v, from.i, from.j);
  if (child.spent + way > allowed(x)) return false;
  if (!put_inner_face(x, child, vertex(x, b.a, forwards(m, b.at_a, from.i)),
                      vertex(x, b.b, backwards(n, b.at_b, from.j)), vertex(x, b.c, backwards(q, b.at_c, v))))
    return false;
  x.pieces = from.piece + 1u;
  x.s.piece[x.pieces++] = {0, from.i, static_cast<u16>(v)};
  x.s.piece[x.pieces++] = {1, static_cast<u16>(q - v), from.j};
  return begin_piece(x, from.piece + 1u, child.faces, child.spent + way, child);
}

bool is_middle(const Search& x, const ShortStep& step) {
  return step.phase == Phase::strip && x.s.piece[step.piece].strip == middle_strip;
}

bool extend_piece(Search& x, const ShortStep& from, ShortStep& child) {
  if (from.option >= 2) return extend_to_c(x, from, child);
  if (!extend_strip(x, from, child)) return false;
  if (is_middle(x, from) || !is_over(child.i, child.j)) return true;
  const f64 spent = child.spent + to_go(x, child);
  return spent <= allowed(x) && begin_piece(x, from.piece + 1u, child.faces, spent, child);
}

// ---------------------------------------------------------------- the walk

u32 walk_vertex(const Search& x, u32 track, u32 step) {
  const u32 polygon = track_polygon(x.base, track);
  return vertex(x, polygon, forwards(x.loops.sides(polygon), track_origin(x.base, track), step));
}
u32 row_vertex(const Search& x, u32 row) { return vertex(x, x.base.d, backwards(x.loops.sides(x.base.d), 0, row)); }

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
  x.s.left_at[track] = from.walk.step, x.s.entered_at[next] = static_cast<u16>(j);
  return put_inner_face(x, child, walk_vertex(x, track, from.walk.step), walk_vertex(x, next, j),
                        row_vertex(x, from.walk.row));
}

bool extend_walk(Search& x, const ShortStep& from, ShortStep& child) {
  if (from.option == 0) return step_down(x, from, child);
  return from.option == 1 ? step_along(x, from, child) : change_track(x, from, child);
}

// ---------------------------------------------------------------- the search

u32 option_count(const Search& x, const ShortStep& step) {
  if (step.phase == Phase::strip) return is_middle(x, step) ? 3 + x.loops.sides(x.base.c) : 2;
  const RoundWalk& w = x.s.base.walk;
  return 3 + w.sides[(track_of(w, x.ends, step.walk.layer) + 1) % w.tracks];
}

// Follows every way from the step at the bottom that can still be among the best.
void search_from(Search& x, const ShortStep& bottom) {
  ShortStep* steps = x.s.step;
  u32 depth = 0;
  steps[0] = bottom;
  for (;;) {
    ShortStep& top = steps[depth];
    if (top.option == option_count(x, top)) {
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

// The least length of walks that begin on a track at one of its steps, and end there.
f64 least_from(Search& x, const WalkEnds& ends) {
  fill_walk_table(x.s.base.walk, ends, x.s.table);
  x.work += x.of_a_table;
  return x.s.base.walk.around[ends.start][0][ends.end] + length_to_go(x.s.table, walk_start(ends, ends.end));
}

void search_start(Search& x, const WalkEnds& ends) {
  if (least_from(x, ends) > allowed(x)) return;
  x.ends = ends;
  ShortStep bottom;
  bottom.walk = walk_start(ends, ends.end);
  bottom.spent = x.s.base.walk.around[ends.start][0][ends.end];
  put_base_face(x, bottom);
  search_from(x, bottom);
}

// Can walks that begin and end at some of these steps of a track be among the best? Knows their least lengths then.
bool bound_starts(Search& x, u32 start, u32 low, u32 high) {
  const RoundWalk& w = x.s.base.walk;
  const WalkEnds ends{start, none, low, high};
  bool any = low == 0 && high == w.sides[start];
  for (u32 i = low; i <= high; ++i) any |= x.s.least[i] <= allowed(x);
  if (!any) return false;
  fill_walk_table(w, ends, x.s.table);
  x.work += x.of_a_table / bounds_in_a_table;
  any = false;
  for (u32 i = low; i <= high; ++i) {
    x.s.least[i] = w.around[start][0][i] + length_to_go(x.s.table, walk_start(ends, i));
    any |= x.s.least[i] <= allowed(x);
  }
  return any;
}

// Goes through the starts on a track that can be among the best. Where all together can, halves are asked about, and so
// on. Ends where `visit` does.
template <class Visit>
bool visit_starts(Search& x, u32 start, Visit visit) {
  const u32 n = x.s.base.walk.sides[start];
  u32 all = 1;
  while (all <= n) all *= 2;
  for (u32 low = 0, width = all; low <= n && x.work < x.most_work;) {
    if (bound_starts(x, start, low, min_of(low + width - 1, n))) {
      if (width > 2) {
        width /= 2;
        continue;
      }
      for (u32 i = low; i < low + width && i <= n; ++i)
        if (x.s.least[i] <= allowed(x) && visit(WalkEnds{start, i})) return true;
    }
    low += width;
    width = low & (~low + 1);
  }
  return false;
}

void search_walks(Search& x) {
  for (u32 start = 0; start < x.s.base.walk.tracks; ++start)
    visit_starts(x, start, [&x](const WalkEnds& ends) {
      search_start(x, ends);
      return x.work >= x.most_work;
    });
}

// Can any walk be among the best?
bool may_have_walks(Search& x) {
  for (u32 start = 0; start < x.s.base.walk.tracks; ++start)
    if (visit_starts(x, start, [&x](const WalkEnds& ends) { return least_from(x, ends) <= allowed(x); })) return true;
  return false;
}

// Few rows come near the best: for the others one bound for all cases will do.
void search_row(Search& x) {
  link_row(x.loops, x.base, any_row, x.s.base);
  if (!may_have_walks(x)) return;
  for (const RowCase& row : row_cases) {
    if (x.work >= x.most_work) return;
    x.row = row;
    link_row(x.loops, x.base, row, x.s.base);
    x.work += x.of_a_base;
    search_walks(x);
  }
}

void search_base(Search& x, const ShortBase& base) {
  const HandleFace face = base_face(x, base);
  if (x.work >= x.most_work || !inner_is_free(x, face.v[0], face.v[1], face.v[2])) return;
  x.work += base.kind == BaseKind::row ? x.of_a_table : x.of_a_base;
  x.base = base;
  measure_base(x.loops, base, x.any_measured ? &x.measured : nullptr, x.s.base);
  x.measured = base, x.any_measured = true;
  base.kind == BaseKind::row ? search_row(x) : search_walks(x);
}

void set_work(Search& x, const ShortBase& b) {
  const u64 m = x.loops.sides(b.a) + 1, n = x.loops.sides(b.b) + 1, q = x.loops.sides(b.c) + 1, d = x.loops.sides(b.d);
  const u64 sums = b.kind == BaseKind::row ? (2 * d + q) * m * n : d * (m * n + n * q + q * m);
  x.of_a_table = times(work_of_a_table, sums, table_sums);
  x.of_a_base = times(work_of_a_base, m * n + n * q + q * m + d * (m + n + q), base_edges);
}

void search_bases(Search& x, ShortBase base) {
  const u32 m = x.loops.sides(base.a), n = x.loops.sides(base.b), q = x.loops.sides(base.c);
  set_work(x, base);
  for (u32 a = 0; a < m; ++a)
    for (u32 b = 0; b < n && x.work < x.most_work; ++b)
      for (u32 c = 0; c < q; ++c) {
        base.at_a = static_cast<u16>(a), base.at_b = static_cast<u16>(b), base.at_c = static_cast<u16>(c);
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

// ---------------------------------------------------------------- room

void lay_out_search(Carver& carver, const ShortLoops& loops, ShortestScratch& s) {
  const u32 vertices = loops.first[4];
  const MostCells most = most_cells(loops);
  lay_out_bases(carver, loops, s.base);
  lay_out_walk_table(carver, most.cells, most.longest, s.table);
  carver.take(s.least, u64{most.longest} + 1);
  carver.take(s.face, u64{vertices} + 4);
  carver.take(s.step, u64{vertices} + 6);  // a step makes a face at least, but the first
  u64 places = 0;
  for (u32 l = 0; l < 4; ++l) {
    s.inner_places[l] = places;
    u64 triples = 2;
    for (u32 o = 0; o < 4; ++o) triples *= o == l ? 1 : loops.sides(o);
    places += triples;
  }
  if (loops.filter.ask != nullptr) lay_out_face_memory(carver, places, s.inner);
}

}  // namespace

u64 four_scratch_bytes(const ShortLoops& loops, u32 wanted) {
  ShortestScratch s;
  Carver carver{nullptr, element_alignment};
  lay_out_search(carver, loops, s);
  lay_out_short_handles(carver, loops, wanted, s.found);
  return carver.bytes;
}

bool lay_out_four(const ShortLoops& loops, u32 wanted, u8* bytes, u64 size, ShortestScratch& s) {
  s = {};
  Carver carver{bytes, element_alignment};
  lay_out_search(carver, loops, s);
  if (carver.bytes > size) return false;
  const u64 fit = (size - carver.bytes) / short_handle_bytes(loops);
  lay_out_short_handles(carver, loops, static_cast<u32>(min_of<u64>(wanted, fit)), s.found);
  return !s.found.best.empty();
}

u32 shortest_of_four(const ShortLoops& loops, f64 limit, u64 work, ShortestScratch& scratch, bool& complete) {
  Search x{loops, scratch, limit};
  x.most_work = work;
  forget(scratch.inner);
  scratch.found.count = 0;
  measure_distances(loops, scratch.base);
  search_four(x);
  complete = x.work < x.most_work;
  return scratch.found.count;
}

}  // namespace tpa
