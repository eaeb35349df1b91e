// SPDX-License-Identifier: MIT
#include "cut/neck.h"

#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "geometry/predicates.h"

namespace tpa {

f64 place_along(const Vec3& p, const Vec3& q, const Triangle& triangle) {
  const Vec3 normal = area_normal(triangle[0], triangle[1], triangle[2]);
  const f64 from = abs_of(dot(normal, p - triangle[0])), to = abs_of(dot(normal, q - triangle[0]));
  return from + to > 0 ? from / (from + to) : 0;
}

namespace {

Vec3 middle_of_cut(const Mesh& m, const Clusters& r, u32 cut) {
  const u32 h = r.cuts[cut].half_edge;
  return midpoint(m.position[tail(m, h)], m.position[head(m, h)]);
}

Vec3 middle_of_loop(const Mesh& m, const Clusters& r, const CutLoop& loop) {
  Vec3 sum;
  for (u32 i = 0; i < loop.count; ++i) sum = sum + middle_of_cut(m, r, loop.first + i);
  return 1.0 / loop.count * sum;
}

// Twice the loop's area, as a vector along its axis.
Vec3 axis_of(const Mesh& m, const Clusters& r, const CutLoop& loop, const Vec3& middle) {
  Vec3 sum;
  Vec3 before = middle_of_cut(m, r, loop.first + loop.count - 1) - middle;
  for (u32 i = 0; i < loop.count; ++i) {
    const Vec3 now = middle_of_cut(m, r, loop.first + i) - middle;
    sum = sum + cross(before, now);
    before = now;
  }
  return sum;
}

// Faces along a loop look away from the loop's axis round a neck, and towards the axis round a hole. A facing is clear
// if its faces have this many times the area of the others. Loops along creases that wind about between several bodies
// have both kinds. In the scenes with balls, loops with misleading middles have a ratio of up to 4.6, and loops of
// pinched rings 6.5 and more.
constexpr f64 clear_majority = 5;

i8 facing_of(const Mesh& m, const Clusters& r, const CutLoop& loop, const Vec3& middle) {
  const Vec3 axis = axis_of(m, r, loop, middle);
  const f64 square = squared_length(axis);
  f64 outward = 0, inward = 0;
  for (u32 i = loop.first; i < loop.first + loop.count; ++i) {
    const u32 first = 3 * face_of(r.cuts[i].half_edge);
    const Vec3 from = middle_of_cut(m, r, i) - middle;
    const Vec3 away = square > 0 ? from - dot(from, axis) / square * axis : from;
    const Vec3 normal =
        area_normal(corner_position(m, first), corner_position(m, first + 1), corner_position(m, first + 2));
    const f64 share = dot(away, normal);
    (share > 0 ? outward : inward) += abs_of(share);
  }
  if (outward > clear_majority * inward) return 1;
  return inward > clear_majority * outward ? -1 : 0;
}

// Crossings of faces with the way from p to q, as shares of the way, in order; with both ends.
constexpr u32 most_crossings = 126;
struct Crossings {
  f64 at[most_crossings + 2];
  u32 count = 0;
  bool fits = true;
};
void find_crossings(const Mesh& m, const NearFaces& g, const Vec3& p, const Vec3& q, Crossings& found) {
  const auto add = [&](f64 at) {
    found.fits = found.fits && found.count < most_crossings + 2;
    if (found.fits) found.at[found.count++] = at;
  };
  add(0);
  add(1);
  for_each_near(g, box_of(p, q, q), [&](u32 f) {
    const Triangle corners = triangle_of(m, m.corner + 3 * f);
    if (segment_through_triangle(p, q, corners) != Passage::misses) add(place_along(p, q, corners));
  });
  if (found.fits) sort_in_place(found.at, found.count, [](f64 x, f64 y) { return x < y; });
}

// Does the way leave the body, or the outside if `body` is false? Between two crossings the winding number is the same
// all along. A way with too many crossings to list is too tangled to tell.
bool leaves(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, const Vec3& from, const Vec3& to, bool body) {
  const auto is_body = [&](const Vec3& p) { return winding_at(m, g, p, winding_at_infinity) >= 1; };
  Crossings crossings;
  find_crossings(m, g, from, to, crossings);
  if (!crossings.fits || is_body(from) != body) return false;
  for (u32 i = 1; i < crossings.count; ++i) {
    const f64 at = 0.5 * (crossings.at[i - 1] + crossings.at[i]);
    if (crossings.at[i - 1] < crossings.at[i] && is_body(from + at * (to - from)) != body) return true;
  }
  return false;
}

struct NeckRing {
  const Mesh& m;
  const Clusters& r;
  Span<CutLoop> loops;
  NeckScratch& s;
};

// The end of a cut edge in the ring.
u32 rim_vertex(const NeckRing& q, u32 cut) { return tail(q.m, q.r.cuts[cut].half_edge); }

// Lists the loops as the first fronts. False if there are too many.
bool list_loops(NeckRing& q) {
  Stack<Front>& fronts = q.s.fronts;
  fronts.clear();
  for (const CutLoop& loop : q.loops) {
    const Vec3 middle = middle_of_loop(q.m, q.r, loop);
    if (!fronts.push({middle, loop.count, fronts.size, false, facing_of(q.m, q.r, loop, middle)})) return false;
  }
  return true;
}

// Collects vertices of the ring in the order of their levels, each a front of its own at first. A winding loop sends no
// front: its middle is nowhere in particular.
void collect_ring(NeckRing& q) {
  Stack<u32>& ring = q.s.ring;
  const auto add = [&](u32 v, u8 level) {
    if (q.s.front[v] != none) return;
    q.s.front[v] = v;
    q.s.level[v] = level;
    ring.push(v);
  };
  for (u32 v : q.r.members) q.s.front[v] = none;
  ring.clear();
  for (u32 i = 0; i < q.loops.size; ++i) {
    const CutLoop& loop = q.loops[i];
    if (q.s.fronts[i].facing == 0) continue;
    for (u32 cut = loop.first; cut < loop.first + loop.count; ++cut) add(rim_vertex(q, cut), 0);
  }
  for (u32 i = 0; i < ring.size; ++i)
    for_each_neighbour(q.m, ring[i], [&](u32 u) {
      if (in_cluster(q.r, u)) add(u, static_cast<u8>(q.s.level[ring[i]] + 1));
    });
}

// Levels of neighbours differ by 1 at most, so comparing modulo 256 is safe.
void join_levels(NeckRing& q) {
  for (u32 v : q.s.ring)
    for_each_neighbour(q.m, v, [&](u32 u) {
      if (!in_cluster(q.r, u) || q.s.level[u] != q.s.level[v]) return;
      join_sets(q.s.front, u, v);
    });
}

// Numbers the fronts: front[v] is a place in `fronts` afterwards. False if there are too many.
bool number_fronts(NeckRing& q) {
  constexpr u32 numbered = 1u << 31;
  u32* front = q.s.front;
  Stack<Front>& fronts = q.s.fronts;
  for (u32 v : q.s.ring) front[v] = find_set(front, v);
  for (u32 v : q.s.ring) {
    if (front[v] != v) continue;
    front[v] = numbered | fronts.size;
    if (!fronts.push({{}, 0, fronts.size, false, 0})) return false;
  }
  for (u32 v : q.s.ring)
    if ((front[v] & numbered) == 0) front[v] = front[front[v]];
  for (u32 v : q.s.ring) front[v] &= ~numbered;
  return true;
}

void find_middles(NeckRing& q) {
  Stack<Front>& fronts = q.s.fronts;
  for (u32 v : q.s.ring) {
    Front& f = fronts[q.s.front[v]];
    f.middle = f.middle + q.m.position[v];
    ++f.size;
  }
  for (u32 i = q.loops.size; i < fronts.size; ++i) fronts[i].middle = 1.0 / fronts[i].size * fronts[i].middle;
}

// Calls visit(front) for the fronts of v's neighbours.
template <class Visit>
void for_each_front_beside(const NeckRing& q, u32 v, Visit visit) {
  for_each_neighbour(q.m, v, [&](u32 u) {
    if (in_cluster(q.r, u)) visit(q.s.front[u]);
  });
}

// Legs: sets of connected fronts.
auto leg_parent(Stack<Front>& fronts) {
  return [&fronts](u32 i) -> u32& { return fronts[i].parent; };
}
u32 find_leg(Stack<Front>& fronts, u32 i) { return find_set(leg_parent(fronts), i); }

struct Skeleton {
  const NeckRing& q;
  const NearFaces& g;
  i32 winding_at_infinity;
  bool body;                           // true for a ring round a neck, false for a ring round a hole
  u32 cut_from = none, cut_to = none;  // the last fronts found cut apart

  void unite(u32 a, u32 b) { join_sets(leg_parent(q.s.fronts), a, b); }
  bool is_cut(const Front& a, const Front& b) const {
    if (a.right != b.right) return true;
    return a.right && leaves(q.m, g, winding_at_infinity, a.middle, b.middle, body);
  }
  void join(u32 a, u32 b) {
    Stack<Front>& fronts = q.s.fronts;
    if (find_leg(fronts, a) == find_leg(fronts, b) || (a == cut_from && b == cut_to)) return;
    if (!is_cut(fronts[a], fronts[b])) return unite(a, b);
    cut_from = a;
    cut_to = b;
  }
};

// One or two vertices have their middle on the surface: they count with a front, or a loop, beside them.
void absorb_small(Skeleton& k) {
  const NeckRing& q = k.q;
  Stack<Front>& fronts = q.s.fronts;
  const auto absorb = [&](u32 small, u32 by) {
    fronts[small] = {fronts[by].middle, 3, small, fronts[by].right, 0};
    k.unite(small, by);
  };
  for (u32 i = 0; i < q.loops.size; ++i)
    for (u32 cut = q.loops[i].first; cut < q.loops[i].first + q.loops[i].count; ++cut)
      if (const u32 rim = q.s.front[rim_vertex(q, cut)]; fronts[rim].size < 3) absorb(rim, i);
  for (u32 v : q.s.ring)
    for_each_front_beside(q, v, [&](u32 f) {
      if (const u32 own = q.s.front[v]; fronts[own].size < 3 && f < own) absorb(own, f);
    });
}

// A loop with its middle on the wrong side, or without clear facing, says nothing of the fronts beside it.
void join_fronts(Skeleton& k) {
  const NeckRing& q = k.q;
  for (u32 v : q.s.ring)
    for_each_front_beside(q, v, [&](u32 f) {
      if (f < q.s.front[v]) k.join(f, q.s.front[v]);
    });
  for (u32 i = 0; i < q.loops.size; ++i) {
    const bool tells = q.s.fronts[i].right && q.s.fronts[i].facing != 0;
    for (u32 cut = q.loops[i].first; cut < q.loops[i].first + q.loops[i].count; ++cut) {
      const u32 rim = q.s.front[rim_vertex(q, cut)];
      if (tells)
        k.join(i, rim);
      else
        k.unite(i, rim);
    }
  }
}

}  // namespace

void part_legs(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, const Clusters& r, Span<CutLoop> loops,
               NeckScratch& s) {
  NeckRing q{m, r, loops, s};
  if (!list_loops(q)) return;
  bool body = false, hole = false;
  for (const Front& loop : s.fronts) {
    body = body || loop.facing > 0;
    hole = hole || loop.facing < 0;
  }
  if (body == hole) return;
  collect_ring(q);
  join_levels(q);
  if (number_fronts(q)) {
    find_middles(q);
    for (Front& f : s.fronts) f.right = (winding_at(m, g, f.middle, winding_at_infinity) >= 1) == body;
    Skeleton skeleton{q, g, winding_at_infinity, body};
    absorb_small(skeleton);
    join_fronts(skeleton);
    for (u32 i = 0; i < loops.size; ++i) loops[i].piece = find_leg(s.fronts, i);
  }
}

}  // namespace tpa
