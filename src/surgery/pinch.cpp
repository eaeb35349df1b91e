// SPDX-License-Identifier: MIT
#include "surgery/pinch.h"

#include "detect/new_faces.h"

namespace tpa {

namespace {

// The share of its shortest edge by which a copy moves at most: far enough for the next moves, or hardly.
constexpr f64 far_parting = 0.125, near_parting = 0x1p-10;

struct Pinching {
  Edit& e;
  NearFaces& g;
  u8* face_mark;
  // The place of a vertex of the loop and its copy before, and of the vertex after.
  Vec3 *place, *on_left;
  // Half-edges along the loop, on the left and on the right; vertices at the tails of the left ones, that stay on the
  // left, their copies on the right.
  u32 count;
  u32 left[longest_short_loop], right[longest_short_loop], vertex[longest_short_loop], copy[longest_short_loop];
  // Faces of both caps, two fewer each than the loop has edges.
  u32 caps;
  u32 cap[2 * (longest_short_loop - 2)];

  u32 before(u32 i) const { return (i + count - 1) % count; }
};

// ---------------------------------------------------------------- fans

// Visits the half-edges from a vertex of the loop on one side, between two edges of the loop.
template <class Visit>
void walk_fan(const Mesh& m, u32 first, u32 last, Visit visit) {
  for (u32 h = first;; h = rotate(m, h)) {
    visit(h);
    if (previous_edge(h) == last) return;
  }
}

template <class Visit>
void walk_left(const Pinching& p, u32 i, Visit visit) {
  walk_fan(p.e.mesh, p.left[i], p.left[p.before(i)], visit);
}
template <class Visit>
void walk_right(const Pinching& p, u32 i, Visit visit) {
  walk_fan(p.e.mesh, p.right[p.before(i)], p.right[i], visit);
}

template <class Visit>
void visit_faces(const Pinching& p, Visit visit) {
  for (u32 i = 0; i < p.count; ++i) {
    walk_left(p, i, [&](u32 h) { visit(face_of(h)); });
    walk_right(p, i, [&](u32 h) { visit(face_of(h)); });
  }
}

// The mean of the directions from a vertex into its fan, and the shortest edge there.
struct Inwards {
  const Mesh& m;
  Vec3 at, sum = {};
  f64 shortest = no_way;
  u32 edges = 0;

  void add(u32 v) {
    const Vec3 way = m.position[v] - at;
    const f64 far = length(way);
    if (!(far > 0)) return;
    sum = sum + (1 / far) * way;
    shortest = min_of(shortest, far);
    ++edges;
  }
  void add_ends(u32 h) {
    add(head(m, h));
    add(apex(m, h));
  }
  Vec3 mean() const { return edges == 0 ? Vec3{} : (1 / static_cast<f64>(edges)) * sum; }
};

// ---------------------------------------------------------------- two sides

// Copies move into the faces at the loop, or to the middle of their fans.
enum class Towards : u8 { faces, middle };
struct Parting {
  Towards way;
  f64 share;
};

// From the edge h into its face, at right angles, of length 1.
Vec3 into_face(const Mesh& m, u32 h) {
  const Vec3 along = m.position[head(m, h)] - m.position[tail(m, h)];
  const Vec3 in = m.position[apex(m, h)] - m.position[tail(m, h)];
  const Vec3 away = squared_length(along) * in - dot(in, along) * along;
  const f64 far = length(away);
  return far > 0 ? (1 / far) * away : Vec3{};
}

// Where a copy goes, between two edges of the loop.
Vec3 place_in(const Mesh& m, const Inwards& fan, u32 h, u32 g, const Parting& how) {
  const Vec3 way = how.way == Towards::middle ? fan.mean() : 0.5 * (into_face(m, h) + into_face(m, g));
  return into_exact_range(fan.at + how.share * fan.shortest * way);
}

// Adds the copies; the loop itself is as before. Like other stages, with a frame of its own: the search for caps, far
// deeper, is not to stand on it (P5).
[[gnu::noinline]] void choose_places(Pinching& p, const Parting& how) {
  const Mesh& m = p.e.mesh;
  for (u32 i = 0; i < p.count; ++i) {
    Inwards on_left{m, p.place[i]}, on_right{m, p.place[i]};
    walk_left(p, i, [&](u32 h) { on_left.add_ends(h); });
    walk_right(p, i, [&](u32 h) { on_right.add_ends(h); });
    p.on_left[i] = place_in(m, on_left, p.left[i], p.left[p.before(i)], how);
    p.copy[i] = new_vertex(p.e, place_in(m, on_right, p.right[i], p.right[p.before(i)], how),
                           blend_origins(m, p.vertex[i], p.vertex[i], 0));
  }
}

void part(Pinching& p) {
  Edit& e = p.e;
  for (u32 i = 0; i < p.count; ++i) {
    walk_right(p, i, [&](u32 h) { set_corner(e, h, p.copy[i]); });
    set_vertex_edge(e, p.vertex[i], p.left[i]);
    set_vertex_edge(e, p.copy[i], p.right[p.before(i)]);
    set_position(e, p.vertex[i], p.on_left[i]);
  }
  for (u32 i = 0; i < p.count; ++i) {
    unlink(e, p.left[i]);
    unlink(e, p.right[i]);
  }
  visit_faces(p, [&](u32 f) { insert(p.g, e.mesh, f); });
}

void delete_copies(Pinching& p) {
  for (u32 i = 0; i < p.count; ++i) delete_vertex(p.e, p.copy[i]);
}

void join_again(Pinching& p) {
  Edit& e = p.e;
  for (u32 i = 0; i < p.count; ++i) {
    walk_right(p, i, [&](u32 h) { set_corner(e, h, p.vertex[i]); });
    set_position(e, p.vertex[i], p.place[i]);
  }
  for (u32 i = 0; i < p.count; ++i) link(e, p.left[i], p.right[i]);
  delete_copies(p);
  visit_faces(p, [&](u32 f) { insert(p.g, e.mesh, f); });
}

[[gnu::noinline]] bool fans_are_free(const Pinching& p) {
  const Mesh& m = p.e.mesh;
  bool free = true;
  visit_faces(p, [&](u32 f) {
    if (!free || has_stopped(p.g.meter)) return;
    const FaceCorners face{{m.corner[3 * f], m.corner[3 * f + 1], m.corner[3 * f + 2]}};
    p.face_mark[f] = 1;
    free = trials_are_free(m, p.g, p.face_mark, &face, 1, Expected::bent);
    p.face_mark[f] = 0;
  });
  return free;
}

// ---------------------------------------------------------------- caps

// Loops as cut() leaves them: borders run against the direction of the new faces.
void list_loops(const Pinching& p, Clusters& r) {
  const auto begin_loop = [&] { r.loops.push({r.cuts.size, p.count, none, 0, 0}); };
  begin_loop();
  for (u32 i = p.count; i-- > 0;) r.cuts.push({none, p.vertex[(i + 1) % p.count], none, p.left[i], 1});
  begin_loop();
  for (u32 i = 0; i < p.count; ++i) r.cuts.push({none, p.copy[i], none, p.right[i], 1});
}

void forget_pinched_loops(Clusters& r) {
  r.cuts.clear();
  r.loops.clear();
}

void remove_caps(Pinching& p) {
  for (u32 i = 0; i < p.caps; ++i) {
    remove(p.g, p.cap[i]);
    delete_face(p.e, p.cap[i]);
  }
  p.caps = 0;
}

PinchOutcome cap_both(Pinching& p, Clusters& r, ClosingScratch& closing, const CandidateOptions& options) {
  list_loops(p, r);
  PinchOutcome outcome = PinchOutcome::done;
  for (u32 side = 0; side < 2 && outcome == PinchOutcome::done; ++side) {
    const PieceOutcome capped = connect_piece(p.e, p.g, r, {side, 1}, options, Candidates::tested, closing);
    if (!capped.done) outcome = capped.out_of_faces ? PinchOutcome::triangles : PinchOutcome::blocked;
    for (u32 i = 0; capped.done && i < closing.placed.size; ++i) p.cap[p.caps++] = closing.placed[i];
  }
  forget_pinched_loops(r);
  if (outcome != PinchOutcome::done) remove_caps(p);
  return outcome;
}

// ---------------------------------------------------------------- the region

// Of a corner of a cap, its place along the loop.
u32 index_of(const Pinching& p, u32 v) {
  u32 i = 0;
  while (v != p.vertex[i] && v != p.copy[i]) ++i;
  return i;
}

// Where a corner of a fan is once the first `moved` vertices of the loop have moved on that side.
Vec3 place_while_moving(const Pinching& p, u32 v, u32 moved, bool on_left) {
  for (u32 i = 0; i < moved; ++i)
    if (v == p.vertex[i]) return on_left ? p.on_left[i] : p.e.mesh.position[p.copy[i]];
  return p.e.mesh.position[v];
}

// The moves of the copies, one after the other, before both sides part: each face of a fan sweeps a tetrahedron.
[[gnu::noinline]] RegionChange change_of_moves(const Pinching& p, const RegionChange& before) {
  const Mesh& m = p.e.mesh;
  RegionChange change{0, 0, before.reach, before.met};
  for (u32 i = 0; i < p.count; ++i) {
    const auto move = [&](const Vec3& to, bool on_left) {
      return [&p, &m, &change, i, to, on_left](u32 h) {
        change.add_sweep(p.place[i], to, place_while_moving(p, head(m, h), i, on_left),
                         place_while_moving(p, apex(m, h), i, on_left), p.vertex[i], face_of(h));
      };
    };
    walk_left(p, i, move(p.on_left[i], true));
    walk_right(p, i, move(m.position[p.copy[i]], false));
  }
  return change;
}

// The volume between the caps: upon the loop as it was, both make a closed surface. Then each moves with its loop, in
// the order of the fans, so that no volume lies between the ways of both.
[[gnu::noinline]] void add_caps(const Pinching& p, RegionChange& change) {
  const Mesh& m = p.e.mesh;
  f64 between = 0;
  for (u32 c = 0; c < p.caps; ++c) {
    const u32* v = m.corner + 3 * static_cast<size_t>(p.cap[c]);
    const u32 at[3] = {index_of(p, v[0]), index_of(p, v[1]), index_of(p, v[2])};
    between += six_volumes_of(p.place[0], p.place[at[0]], p.place[at[1]], p.place[at[2]]);
    for (u32 k = 0; k < 3; ++k) {
      const auto seen = [&](u32 i) { return at[i] < at[k] ? m.position[v[i]] : p.place[at[i]]; };
      change.add_sweep(p.place[at[k]], m.position[v[k]], seen((k + 1) % 3), seen((k + 2) % 3), v[k], p.cap[c]);
    }
  }
  if (between == 0) return;
  change.add_volume(between);
  change.add_hull(p.place, p.count, none);
}

}  // namespace

PinchOutcome pinch(Edit& e, NearFaces& g, const ShortLoop& loop, Clusters& r, ClosingScratch& closing,
                   const CandidateOptions& options, u8* face_mark, f64 most, RegionChange& region) {
  if (!has_free_vertices(e, loop.count)) return PinchOutcome::vertices;
  Pinching p{e, g, face_mark, r.middle, r.middle + loop.count, loop.count, {}, {}, {}, {}, 0, {}};
  for (u32 i = 0; i < p.count; ++i) {
    p.left[i] = loop.half_edge[i];
    p.right[i] = e.mesh.opposite[p.left[i]];
    p.vertex[i] = tail(e.mesh, p.left[i]);
    p.place[i] = e.mesh.position[p.vertex[i]];
  }
  constexpr Parting partings[] = {
      {Towards::faces, far_parting}, {Towards::faces, near_parting}, {Towards::middle, near_parting}};
  PinchOutcome last = PinchOutcome::dear;
  for (const Parting& how : partings) {
    choose_places(p, how);
    RegionChange change = change_of_moves(p, region);
    if (change.volume() > most) {
      delete_copies(p);
      continue;
    }
    part(p);
    // Most partings that fail have no free cap, and fans are far more faces to test than caps.
    const PinchOutcome capped = cap_both(p, r, closing, options);
    const PinchOutcome outcome = capped == PinchOutcome::blocked || fans_are_free(p) ? capped : PinchOutcome::blocked;
    if (outcome == PinchOutcome::done) {
      add_caps(p, change);
      if (change.volume() <= most) {
        region.add(change);
        return outcome;
      }
    } else {
      last = outcome;
    }
    remove_caps(p);
    join_again(p);
    if (last == PinchOutcome::vertices || last == PinchOutcome::triangles) return last;
  }
  return last;
}

}  // namespace tpa
