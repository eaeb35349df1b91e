// SPDX-License-Identifier: MIT
#include "edit/remesh.h"

#include <float.h>

#include "edit/bisect.h"
#include "edit/collapse.h"

namespace tpa {

namespace {

// Flips change the surface, so only nearly flat pairs of faces are flipped: at most 25 degrees across the edge.
constexpr f64 flat_cosine = 0.9063;

struct Remesher {
  Edit& e;
  NearFaces& near;
  FaceTree& tree;
  Components& measured;
  const RemeshOptions& options;
  const Exec& exec;
  Relocation& r;
  Stack<u32>& touched;    // vertices to relax
  f64 shortest, longest;  // squares of lengths; shorter edges are collapsed, longer edges split
  u64 allowed_vertices = UINT64_MAX, allowed_faces = UINT64_MAX;  // slots
  RemeshResult result{};

  Mesh& mesh() { return e.mesh; }
  void touch(u32 v) {
    if (r.vertex_mark[v] != 0) return;
    r.vertex_mark[v] = 1;
    touched.push(v);
  }
  template <class... More>
  void touch(u32 v, More... more) {
    touch(v);
    touch(more...);
  }
};

bool limit_met(const Remesher& s) { return s.result.out_of_vertices || s.result.out_of_faces; }
bool ends_early(const Remesher& s) { return limit_met(s) || has_stopped(s.exec.meter); }

// ---------------------------------------------------------------- an edge and its faces

struct Diamond {
  u32 h, k;  // the half-edges
  u32 f, q;  // their faces
  u32 a, b;  // h runs from a to b
  u32 c, d;  // the third corners of f and q
};

Diamond diamond_at(const Mesh& m, u32 h) {
  const u32 k = m.opposite[h];
  return {h, k, face_of(h), face_of(k), tail(m, h), head(m, h), apex(m, h), apex(m, k)};
}

// Units of work, without the search of near faces.
constexpr u64 of_trial = 10;

// May `trials` take the place of the two faces of x, without contacts and without turning the component inside out?
template <u32 n>
bool may_replace(Remesher& s, const Diamond& x, const FaceCorners (&trials)[n], const SignedVolume& change) {
  u8* mark = s.r.face_mark;
  spend(s.exec.meter, of_trial);
  mark[x.f] = mark[x.q] = 1;
  const bool free =
      stays_outside_out(s.measured, x.a, change) && trials_are_free(s.mesh(), s.near, mark, trials, n, Expected::flat);
  mark[x.f] = mark[x.q] = 0;
  return free;
}

// ---------------------------------------------------------------- split

bool split_freely(Remesher& s, u32 h) {
  Mesh& m = s.mesh();
  const Diamond x = diamond_at(m, h);
  const Vec3 p = into_exact_range(midpoint(m.position[x.a], m.position[x.b]));
  const u32 v = new_vertex(s.e, p, blend_origins(m, x.a, x.b, 0.5));
  if (v == none) {
    s.result.out_of_vertices = s.allowed_vertices > m.vertex_capacity;
    return false;
  }
  const FaceCorners trials[] = {{{v, x.b, x.c}}, {{v, x.c, x.a}}, {{v, x.a, x.d}}, {{v, x.d, x.b}}};
  SignedVolume change;
  add(change, -1, p, m.position[x.a], m.position[x.b], m.position[x.c]);
  add(change, -1, p, m.position[x.b], m.position[x.a], m.position[x.d]);
  const bool free = may_replace(s, x, trials, change);
  if (!free || !split_edge(s.e, s.near, h, v)) {
    s.result.out_of_faces = free && s.allowed_faces > m.face_capacity;
    delete_vertex(s.e, v);
    return false;
  }
  s.measured.label[v] = s.measured.label[x.a];
  note_change(s.measured, x.a, change);
  s.touch(x.a, x.b, x.c, x.d, v);
  ++s.result.splits;
  return true;
}

// Splits longer edges nearby until h itself is split. Ends: every split makes the longest edge of the path shorter.
void split_long_edge(Remesher& s, u32 h) {
  while (squared_edge(s.e.mesh, h) > s.longest && !ends_early(s) && split_freely(s, locally_longest(s.e.mesh, h))) {
  }
}

// ---------------------------------------------------------------- collapse

void collapse_short_edge(Remesher& s, u32 h) {
  const Mesh& m = s.e.mesh;
  if (!(squared_edge(m, h) < s.shortest)) return;
  const u32 a = tail(m, h), b = head(m, h);
  const Vec3 middle = into_exact_range(midpoint(m.position[a], m.position[b]));
  if (!collapse(s.e, s.near, a, b, middle, blend_origins(m, a, b, 0.5), s.longest, Expected::flat, s.r.face_mark,
                &s.measured))
    return;
  for_each_neighbour(m, b, [&](u32 u) { s.touch(u); });
  s.touch(b);
  ++s.result.collapses;
}

// ---------------------------------------------------------------- flip

// Is the edge not locally Delaunay? The angles at the apexes add up to more than pi exactly if the sum of the
// cotangents is negative. A margin prevents flips to and fro between equal diagonals.
bool wants_flip(const Mesh& m, u32 h) {
  struct Wedge {
    Vec3 u, v;
  };
  const auto wedge = [&](u32 e) {
    const Vec3 p = m.position[apex(m, e)];
    return Wedge{m.position[tail(m, e)] - p, m.position[head(m, e)] - p};
  };
  const Wedge w1 = wedge(h), w2 = wedge(m.opposite[h]);
  const f64 c1 = dot(w1.u, w1.v), c2 = dot(w2.u, w2.v);
  if (c1 >= 0 && c2 >= 0) return false;
  const f64 a1 = length(cross(w1.u, w1.v)), a2 = length(cross(w2.u, w2.v));
  return c1 * a2 + c2 * a1 < -1e-6 * a1 * a2;
}

// Is the surface nearly flat at x, and would the flip keep a manifold without turning any face over?
bool may_flip(const Mesh& m, const Diamond& x, const FaceCorners (&trials)[2]) {
  const Vec3 nf = face_normal(m, x.f), nq = face_normal(m, x.q);
  const f64 between = dot(nf, nq);
  if (!(between > flat_cosine * square_root(squared_length(nf) * squared_length(nq)))) return false;
  if (!has_more_faces(m, x.a, 3) || !has_more_faces(m, x.b, 3) || find_edge(m, x.c, x.d) != none) return false;
  const Vec3 n = nf + nq;
  return turns_little(n, normal_of(m, trials[0])) && turns_little(n, normal_of(m, trials[1]));
}

// f = (a, b, c) from h becomes (d, b, c), and q = (b, a, d) from k becomes (c, a, d).
void turn_edge(Edit& e, NearFaces& near, const Diamond& x) {
  const Mesh& m = e.mesh;
  const u32 ca = m.opposite[previous_edge(x.h)], db = m.opposite[previous_edge(x.k)];
  set_corner(e, x.h, x.d);
  set_corner(e, x.k, x.c);
  link(e, x.h, db);
  link(e, x.k, ca);
  link(e, previous_edge(x.h), previous_edge(x.k));
  set_vertex_edge(e, x.a, next_edge(x.k));
  set_vertex_edge(e, x.b, next_edge(x.h));
  set_vertex_edge(e, x.c, x.k);
  set_vertex_edge(e, x.d, x.h);
  insert(near, m, x.f);
  insert(near, m, x.q);
}

void flip_edge(Remesher& s, u32 h) {
  const Mesh& m = s.mesh();
  if (!wants_flip(m, h)) return;
  const Diamond x = diamond_at(m, h);
  const FaceCorners trials[] = {{{x.a, x.d, x.c}}, {{x.d, x.b, x.c}}};
  if (!may_flip(m, x, trials)) return;
  SignedVolume change;
  add(change, 1, m.position[x.a], m.position[x.d], m.position[x.b], m.position[x.c]);
  if (!may_replace(s, x, trials, change)) return;
  note_change(s.measured, x.a, change);
  turn_edge(s.e, s.near, x);
  s.touch(x.a, x.b, x.c, x.d);
  ++s.result.flips;
}

// ---------------------------------------------------------------- sweeps

// Only between operations, when all faces are entered.
void arrange_anew(Remesher& s) {
  arrange(s.tree, s.e.mesh, s.exec);
  watch(s.near, s.e.mesh, s.tree);
}

// Squares of lengths of edges.
struct Squares {
  f64 least, most;
};
Squares squares_of(const Mesh& m, u32 f) {
  const Vec3 &p = corner_position(m, 3 * f), &q = corner_position(m, 3 * f + 1), &r = corner_position(m, 3 * f + 2);
  const f64 pq = squared_length(q - p), qr = squared_length(r - q), rp = squared_length(p - r);
  return {min_of(pq, min_of(qr, rp)), max_of(pq, max_of(qr, rp))};
}

// Calls visit(h) once for each living edge, in the order of the faces, new faces included. Skips faces with all edges
// within `as_wanted`, if given; most faces are.
void for_each_edge(Remesher& s, const Squares* as_wanted, void (*visit)(Remesher& s, u32 h)) {
  const Mesh& m = s.mesh();
  spend(s.exec.meter, m.face_count / 2);
  for (u32 f = 0; f < m.face_count; ++f) {
    if (!face_lives(m, f)) continue;
    if (as_wanted != nullptr) {
      const Squares edges = squares_of(m, f);
      if (edges.least >= as_wanted->least && edges.most <= as_wanted->most) continue;
    }
    for (u32 h = 3 * f; h < 3 * f + 3 && face_lives(m, f) && !ends_early(s); ++h) {
      if (h > m.opposite[h]) continue;
      visit(s, h);
      if (is_crowded(s.near)) arrange_anew(s);
    }
  }
}

// ---------------------------------------------------------------- room

// After the splits of the first sweep.
void allow_half_again(Remesher& s) {
  const Mesh& m = s.mesh();
  s.allowed_vertices = remesh_allowed(m.vertex_count);
  s.allowed_faces = remesh_allowed(m.face_count);
  allow_slots(s.e, s.allowed_vertices, s.allowed_faces);
}

// Elements have run out. Each split makes a vertex and two faces.
u64 wanted_slots(const Remesher& s) {
  const bool vertices = s.result.out_of_vertices;
  if (s.allowed_faces != UINT64_MAX) return vertices ? s.allowed_vertices : s.allowed_faces;
  const Mesh& m = s.e.mesh;
  u64 living = 0;
  for (u32 f = 0; f < m.face_count; ++f) living += face_lives(m, f) ? 1u : 0u;
  const u64 more = most_faces_bisected(m, s.longest) - living;
  return vertices ? remesh_allowed(m.vertex_count + more / 2 + 1) : remesh_allowed(m.face_count + more);
}

// ---------------------------------------------------------------- relax

// Forgets touched vertices removed since, and clears the marks.
void keep_living(Remesher& s) {
  u32 n = 0;
  for (u32 v : s.touched) {
    s.r.vertex_mark[v] = 0;
    if (vertex_lives(s.mesh(), v)) s.touched[n++] = v;
  }
  s.touched.size = n;
}

// A place closer to the mean of the neighbours, within the tangent plane.
Vec3 relaxed_place(const Mesh& m, u32 v, f64 relaxation) {
  Vec3 sum, normal;
  u32 count = 0;
  for_each_outgoing(m, v, [&](u32 h) {
    sum = sum + m.position[head(m, h)];
    normal = normal + face_normal(m, face_of(h));
    ++count;
  });
  const Vec3 p = m.position[v], move = 1.0 / count * sum - p;
  const f64 nn = squared_length(normal);
  const Vec3 tangential = nn > 0 ? move - (dot(move, normal) / nn) * normal : Vec3{};
  return into_exact_range(p + relaxation * tangential);
}

// Vertices look at the old positions of neighbours. So new positions wait in r.saved until all are known, and change
// places with the old positions then.
void relax(Remesher& s) {
  keep_living(s);
  if (s.options.relaxation == 0 || ends_early(s)) return;
  const Mesh& m = s.mesh();
  Vec3* saved = s.r.saved;
  spend(s.exec.meter, 4 * u64{s.touched.size});
  for (u32 v : s.touched) saved[v] = relaxed_place(m, v, s.options.relaxation);
  for (u32 v : s.touched) {
    const Vec3 to = saved[v];
    saved[v] = m.position[v];
    set_position(s.e, v, to);
  }
  s.result.relaxed += settle_many(s.e, s.near, s.tree, s.touched.span(), s.exec, s.r, &s.measured);
}

}  // namespace

RemeshResult remesh(Edit& e, NearFaces& near, FaceTree& tree, Components& measured, const RemeshOptions& options,
                    const Exec& exec, Relocation& r, Stack<u32>& touched) {
  Remesher s{.e = e,
             .near = near,
             .tree = tree,
             .measured = measured,
             .options = options,
             .exec = exec,
             .r = r,
             .touched = touched,
             .shortest = options.collapse_length * options.collapse_length,
             .longest = options.split_length * options.split_length};
  for (u32 i = 0; i < options.iterations && !ends_early(s); ++i) {
    touched.clear();
    const u32 before = s.result.splits + s.result.collapses + s.result.flips;
    const Squares not_long{0, s.longest}, not_short{s.shortest, DBL_MAX};
    for_each_edge(s, &not_long, split_long_edge);
    if (i == 0 && !ends_early(s)) allow_half_again(s);
    for_each_edge(s, &not_short, collapse_short_edge);
    for_each_edge(s, nullptr, flip_edge);
    relax(s);
    if (s.result.splits + s.result.collapses + s.result.flips == before) break;
  }
  if (limit_met(s) && !has_stopped(s.exec.meter)) s.result.wanted = wanted_slots(s);
  return s.result;
}

}  // namespace tpa
