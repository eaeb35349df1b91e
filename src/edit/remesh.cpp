// SPDX-License-Identifier: MIT
#include "edit/remesh.h"

#include "detect/hub_stars.h"
#include "edit/bisect.h"
#include "edit/collapse.h"
#include "edit/flip.h"
#include "geometry/expansion.h"

namespace tpa {

namespace {

// In most places twice the estimate is enough.
u64 units_of_gate(const Mesh& m, u64 faces) { return 2 * units_to_detect(m, faces); }

struct Remesher {
  Edit& e;
  NearFaces& near;
  FaceTree& tree;
  VolumesOnDemand volumes;
  Unsettled& unsettled;
  const RemeshOptions& options;
  EdgeAims aims;
  u8* chosen;  // those of the aims
  const Exec& exec;
  Relocation& r;
  Stack<u32>& touched;                                            // vertices to relax
  u64 allowed_vertices = UINT64_MAX, allowed_faces = UINT64_MAX;  // slots
  HubStars hubs{};
  bool hub_waited = false;    // in this sweep, a split
  u64 edited = 0;             // faces, each as often as it was edited
  u64 begun_at = 0;           // units spent before the present operation
  u64 tested = 0;             // units spent by operations done
  bool cannot_relax = false;  // the rest of the budget does not hold it
  RemeshResult result{};

  Mesh& mesh() { return e.mesh; }
  // The gate will look at edited faces. Large faces beside many small ones, and hubs, take many units; operations have
  // searched there, too, with a third of these units or more (KeepRemesh.HoldsItsGate).
  void note_edited(u64 faces) {
    edited += faces;
    tested += spent_by(exec.meter) - begun_at;
    begun_at = spent_by(exec.meter);
    set_aside(exec.meter, max_of(units_of_gate(e.mesh, edited), 3 * tested));
  }
  void touch(u32 v) {
    if (r.vertex_mark[v] != 0 || !is_chosen(aims, v)) return;
    r.vertex_mark[v] = 1;
    touched.push(v);
  }
  template <class... More>
  void touch(u32 v, More... more) {
    touch(v);
    touch(more...);
  }
};

bool is_too_long(const Remesher& s, u32 h) {
  const Mesh& m = s.e.mesh;
  return is_too_long(s.aims, squared_edge(m, h), tail(m, h), head(m, h));
}
bool is_too_short(const Remesher& s, u32 h) {
  const Mesh& m = s.e.mesh;
  return is_too_short(s.aims, squared_edge(m, h), tail(m, h), head(m, h));
}

// Has the face an edge with is_so(aims, squared length, end, end)? Most faces of a mesh have none.
template <class IsSo>
bool any_edge(const Remesher& s, u32 f, IsSo is_so) {
  const Mesh& m = s.e.mesh;
  const u32* v = m.corner + 3 * static_cast<size_t>(f);
  const Vec3 &p = m.position[v[0]], &q = m.position[v[1]], &r = m.position[v[2]];
  return is_so(s.aims, squared_length(q - p), v[0], v[1]) || is_so(s.aims, squared_length(r - q), v[1], v[2]) ||
         is_so(s.aims, squared_length(p - r), v[2], v[0]);
}
bool any_too_long(const Remesher& s, u32 f) {
  return any_edge(s, f,
                  [](const EdgeAims& aims, f64 squared, u32 a, u32 b) { return is_too_long(aims, squared, a, b); });
}
bool any_too_short(const Remesher& s, u32 f) {
  return any_edge(s, f,
                  [](const EdgeAims& aims, f64 squared, u32 a, u32 b) { return is_too_short(aims, squared, a, b); });
}

bool is_chosen(const Remesher& s, u32 h) { return is_chosen(s.aims, tail(s.e.mesh, h), head(s.e.mesh, h)); }

bool limit_met(const Remesher& s) { return s.result.out_of_vertices || s.result.out_of_faces; }
bool ends_early(const Remesher& s) { return limit_met(s) || s.cannot_relax || has_stopped(s.exec.meter); }

// ---------------------------------------------------------------- an edge and its faces

// Units of work, without the search of near faces.
constexpr u64 of_trial = 10;

// May `trials` take the place of the two faces of x, without contacts and without turning the component inside out?
template <u32 n>
bool may_replace(Remesher& s, const Diamond& x, const FaceCorners (&trials)[n], const SignedVolume& change) {
  u8* mark = s.r.face_mark;
  spend(s.exec.meter, of_trial);
  if (s.tree.has_hubs) know_stars(s.hubs, s.mesh(), s.exec.meter, trials, n);
  mark[x.f] = mark[x.q] = 1;
  const bool free = trials_are_free(s.mesh(), s.near, mark, trials, n, Expected::flat) &&
                    stays_outside_out(measured(s.volumes, s.mesh()), x.a, change);
  mark[x.f] = mark[x.q] = 0;
  return free;
}

// ---------------------------------------------------------------- flip

enum class Flip : u8 { unwanted, blocked, done };

Flip try_flip(Remesher& s, u32 h) {
  const Mesh& m = s.mesh();
  if (!wants_flip(m, h)) return Flip::unwanted;
  if (!is_chosen(s, h)) return Flip::blocked;
  const Diamond x = diamond_at(m, h);
  const FaceCorners trials[] = {{{x.a, x.d, x.c}}, {{x.d, x.b, x.c}}};
  if (!may_flip(m, x, trials)) return Flip::unwanted;
  if (find_edge(m, x.c, x.d) != none) return Flip::blocked;
  SignedVolume change;
  add(change, 1, m.position[x.a], m.position[x.d], m.position[x.b], m.position[x.c]);
  if (!may_replace(s, x, trials, change)) return Flip::blocked;
  note_change(s.volumes.components, x.a, change);
  turn_edge(s.e, s.near, x);
  unsettle_round(s.unsettled, m, x.f);
  unsettle_round(s.unsettled, m, x.q);
  s.touch(x.a, x.b, x.c, x.d);
  s.note_edited(2);
  ++s.result.flips;
  return Flip::done;
}

// The three functions that try an edge return whether it is to be tried again even if nothing changes at the corners of
// its faces: something else was in the way.

bool flip_edge(Remesher& s, u32 h) { return try_flip(s, h) == Flip::blocked; }

// ---------------------------------------------------------------- split

// Is p the middle of a and b to the bit? Triangles with p for a or b cover those of the edge then, and meet nothing
// else, as these did.
bool is_exact_midpoint(const Vec3& p, const Vec3& a, const Vec3& b) {
  bool exact = true;
  for (int k = 0; k < 3; ++k) {
    const ExactPair sum = two_sum(a[k], b[k]);
    exact = exact && sum.low == 0 && 2 * p[k] == sum.high;
  }
  return exact;
}

bool split_freely(Remesher& s, u32 h) {
  Mesh& m = s.mesh();
  const Diamond x = diamond_at(m, h);
  const Vec3 p = into_exact_range(midpoint(m.position[x.a], m.position[x.b]));
  const u32 v = new_vertex(s.e, p, blend_origins(m, x.a, x.b, 0.5));
  if (v == none) {
    s.result.out_of_vertices = s.allowed_vertices > m.vertex_capacity;
    return false;
  }
  aim_at_mean(s.aims, v, x.a, x.b);
  if (s.chosen != nullptr) s.chosen[v] = 1;
  const FaceCorners trials[] = {{{v, x.b, x.c}}, {{v, x.c, x.a}}, {{v, x.a, x.d}}, {{v, x.d, x.b}}};
  SignedVolume change;
  add(change, -1, p, m.position[x.a], m.position[x.b], m.position[x.c]);
  add(change, -1, p, m.position[x.b], m.position[x.a], m.position[x.d]);
  const bool free = is_exact_midpoint(p, m.position[x.a], m.position[x.b]) || may_replace(s, x, trials, change);
  if (!free || !split_edge(s.e, s.near, h, v)) {
    s.result.out_of_faces = free && s.allowed_faces > m.face_capacity;
    delete_vertex(s.e, v);
    return false;
  }
  Components& components = s.volumes.components;
  components.label[v] = components.label[x.a];
  note_change(components, x.a, change);
  unsettle_star(s.unsettled, m, v);
  s.touch(x.a, x.b, x.c, x.d, v);
  s.note_edited(4);
  ++s.result.splits;
  return true;
}

// An edge between a hub and a short edge waits for the collapse of the latter: the splits of a fan of needles would all
// be undone, and cost the square of the hub's valence.
bool waits_at_hub(const Remesher& s, u32 h) {
  const Mesh& m = s.e.mesh;
  return s.aims.hubs_wait && (any_too_short(s, face_of(h)) || any_too_short(s, face_of(m.opposite[h]))) &&
         (is_hub(m, tail(m, h)) || is_hub(m, head(m, h)));
}

// Does a flip serve in place of a split, with an edge that is short enough? Two long edges split into four leave such a
// place between both faces. A third split would be undone by a collapse.
bool flips_in_place(Remesher& s, u32 h) {
  const Mesh& m = s.e.mesh;
  const u32 c = apex(m, h), d = apex(m, m.opposite[h]);
  return !is_too_long(s.aims, squared_length(m.position[d] - m.position[c]), c, d) && try_flip(s, h) == Flip::done;
}

// Splits longer edges nearby until h itself is split. Ends: every split makes the longest edge of the path shorter, and
// every flip leaves one long edge less.
bool split_long_edge(Remesher& s, u32 h) {
  if (!is_too_long(s, h)) return false;
  if (!is_chosen(s, h)) return true;
  if (waits_at_hub(s, h)) {
    s.hub_waited = true;
    return true;
  }
  while (is_too_long(s, h) && !ends_early(s)) {
    const u32 longest = locally_longest(s.e.mesh, s.aims, h);
    if (!flips_in_place(s, longest) && !split_freely(s, longest)) break;
  }
  return true;
}

// ---------------------------------------------------------------- collapse

bool try_short_edge(Remesher& s, u32 h) {
  const Mesh& m = s.e.mesh;
  if (!is_too_short(s, h)) return false;
  if (!is_chosen(s, h)) return true;
  const u32 a = tail(m, h), b = head(m, h);
  const Collapse outcome = collapse_short_edge(s.e, s.near, a, b, s.aims, s.r.face_mark, s.volumes);
  if (outcome != Collapse::done) return outcome == Collapse::refused;
  aim_at_mean(s.aims, b, a, b);
  unsettle_star(s.unsettled, m, b);
  u32 faces = 0;
  for_each_neighbour(m, b, [&](u32 u) {
    s.touch(u);
    ++faces;
  });
  s.touch(b);
  s.note_edited(faces);
  ++s.result.collapses;
  return false;
}

// ---------------------------------------------------------------- sweeps

// Only between operations, when all faces are entered.
void arrange_anew(Remesher& s) {
  arrange(s.tree, s.e.mesh, s.exec);
  watch(s.near, s.e.mesh, s.tree);
}

// Calls visit(h) once for each edge in the face. Is one to be tried again, though nothing changes nearby? So it is
// where the meter has stopped.
bool visit_edges(Remesher& s, u32 f, bool (*visit)(Remesher& s, u32 h)) {
  const Mesh& m = s.mesh();
  bool again = false;
  for (u32 h = 3 * f; h < 3 * f + 3 && face_lives(m, f) && !ends_early(s); ++h) {
    if (h > m.opposite[h]) continue;
    s.begun_at = spent_by(s.exec.meter);
    again = visit(s, h) || again;
    if (is_crowded(s.near) && can_afford(s.exec.meter, 2 * u64{m.face_count})) arrange_anew(s);
  }
  return again || has_stopped(s.exec.meter);
}

// Calls look(f) for the living faces in order, new and newly unsettled faces included.
enum class Over { all, unsettled };
template <class Look>
void for_each_face(Remesher& s, Over over, const BitSet& unsettled, Look look) {
  const Mesh& m = s.mesh();
  const auto from = [&](u32 f) { return over == Over::all ? f : unsettled.next(f); };
  u64 looked = 0;
  for (u32 f = from(0); f < m.face_count && !has_stopped(s.exec.meter); f = from(f + 1)) {
    if (face_lives(m, f)) look(f);
    spend(s.exec.meter, ++looked % 2);
  }
}

void sweep_splits(Remesher& s, Over over) {
  BitSet& unsettled = s.unsettled.lengths;
  for_each_face(s, over, unsettled, [&](u32 f) {
    if (any_too_long(s, f) && visit_edges(s, f, split_long_edge)) unsettled.add(f);
  });
}

// Changes on the way unsettle faces, so a face is settled first.
void sweep_collapses(Remesher& s, Over over) {
  BitSet& unsettled = s.unsettled.lengths;
  for_each_face(s, over, unsettled, [&](u32 f) {
    unsettled.remove(f);
    const bool waits = any_too_long(s, f);
    if ((any_too_short(s, f) && visit_edges(s, f, try_short_edge)) || waits) unsettled.add(f);
  });
}

void sweep_flips(Remesher& s) {
  BitSet& unsettled = s.unsettled.flips;
  for_each_face(s, Over::unsettled, unsettled, [&](u32 f) {
    unsettled.remove(f);
    if (visit_edges(s, f, flip_edge)) unsettled.add(f);
  });
}

// Splits, then collapses. Edges at hubs that had to wait are split in the end.
void sweep_lengths(Remesher& s, Over over) {
  s.aims.hubs_wait = true;
  s.hub_waited = false;
  sweep_splits(s, over);
  sweep_collapses(s, over);
  // A look at all faces that has not come to its end leaves all to be looked at.
  if (over == Over::all && has_stopped(s.exec.meter)) unsettle_all(s.unsettled, s.e.mesh);
  s.aims.hubs_wait = false;
  if (s.hub_waited) sweep_splits(s, Over::unsettled);
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
  const u64 more = most_faces_bisected(m, s.aims) - living;
  return vertices ? remesh_allowed(m.vertex_count + more / 2 + 1) : remesh_allowed(m.face_count + more);
}

// ---------------------------------------------------------------- relax

// Vertices touched in earlier sweeps are relaxed again.
void remember_touched(Remesher& s) {
  for (u32 v : s.touched) s.r.vertex_mark[v] = 1;
}

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

// Faces round the vertices, each as often as it has such a corner.
u64 faces_round(const Mesh& m, Span<const u32> vertices) {
  u64 faces = 0;
  for (u32 v : vertices) faces += valence(m, v);
  return faces;
}

// Vertices look at the old positions of neighbours. So new positions wait in r.saved until all are known, and change
// places with the old positions then.
void relax(Remesher& s) {
  keep_living(s);
  if (s.options.relaxation == 0 || s.touched.empty() || ends_early(s)) return;
  const Mesh& m = s.mesh();
  Vec3* saved = s.r.saved;
  const u64 faces = keeps_done(s.exec.meter) ? faces_round(m, s.touched.span()) : 0;
  s.begun_at = spent_by(s.exec.meter);
  s.note_edited(faces);
  s.cannot_relax = !can_afford(s.exec.meter, 2 * faces + units_of_gate(m, faces));
  if (s.cannot_relax) return;
  spend(s.exec.meter, 4 * u64{s.touched.size});
  Components& components = measured(s.volumes, m);
  for (u32 v : s.touched) saved[v] = relaxed_place(m, v, s.options.relaxation);
  for (u32 v : s.touched) {
    const Vec3 to = saved[v];
    saved[v] = m.position[v];
    set_position(s.e, v, to);
  }
  unsettle_stars(s.unsettled, m, s.touched.span());
  forget_stars(s.hubs);
  const u32 kept = settle_many(s.e, s.near, s.tree, s.touched.span(), s.exec, s.r, &components);
  if (has_stopped(s.exec.meter))
    put_all_back(s.e, s.near, s.touched.span(), s.r);
  else
    s.result.relaxed += kept;
}

u32 operations(const RemeshResult& r) { return r.splits + r.collapses + r.flips; }

}  // namespace

RemeshResult remesh(Edit& e, NearFaces& near, FaceTree& tree, Components& components, Unsettled& unsettled,
                    const RemeshOptions& options, u8* chosen, const Exec& exec, Relocation& r, Stack<u32>& touched) {
  Remesher s{.e = e,
             .near = near,
             .tree = tree,
             .volumes = {components},
             .unsettled = unsettled,
             .options = options,
             .aims = options.aims,
             .chosen = chosen,
             .exec = exec,
             .r = r,
             .touched = touched};
  near.hubs = &s.hubs;
  spread(unsettled, e.mesh, r.faces);
  keep(unsettled);
  Over lengths = options.new_aims ? Over::all : Over::unsettled;
  if (options.new_aims && options.only_part) {
    unsettle_part(unsettled, e.mesh, options.part);
    lengths = Over::unsettled;
  }
  if (chosen != nullptr) set_flips_aside(unsettled, e.mesh, options.part);
  touched.clear();
  for (u32 i = 0; i < options.iterations && !ends_early(s); ++i) {
    remember_touched(s);
    const u32 before = operations(s.result);
    sweep_lengths(s, lengths);
    if (i == 0 && !ends_early(s)) allow_half_again(s);
    sweep_flips(s);
    relax(s);
    if (s.cannot_relax || has_stopped(exec.meter)) s.result.unfinished = options.iterations - i;
    const bool relaxes = options.relaxation > 0 && touched.size > 0;
    if (operations(s.result) == before && !relaxes) break;
    lengths = Over::unsettled;
  }
  if (chosen != nullptr) take_flips_up(unsettled, e.mesh, chosen);
  near.hubs = nullptr;
  if (limit_met(s) && !has_stopped(s.exec.meter)) s.result.wanted = wanted_slots(s);
  return s.result;
}

}  // namespace tpa
