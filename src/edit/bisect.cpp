// SPDX-License-Identifier: MIT
#include "edit/bisect.h"

namespace tpa {

namespace {

// The square of an edge's length as a part of the aim; less than 0 for an edge that is not chosen.
f64 relative_square(const Mesh& m, const EdgeAims& aims, u32 h) {
  const u32 a = tail(m, h), b = head(m, h);
  return is_chosen(aims, a, b) ? squared_edge(m, h) / square(aim_between(aims, a, b)) : -1;
}

// A strict order of the edges: by length, then by number.
bool is_longer(const Mesh& m, const EdgeAims& aims, u32 g, u32 h) {
  const f64 a = relative_square(m, aims, g), b = relative_square(m, aims, h);
  return a != b ? a > b : min_of(g, m.opposite[g]) < min_of(h, m.opposite[h]);
}

u32 longest_edge(const Mesh& m, const EdgeAims& aims, u32 f) {
  u32 longest = 3 * f;
  for (u32 h = 3 * f + 1; h < 3 * f + 3; ++h)
    if (is_longer(m, aims, h, longest)) longest = h;
  return longest;
}

}  // namespace

bool split_edge(Edit& e, NearFaces& near, u32 h, u32 v) {
  const Mesh& m = e.mesh;
  const u32 k = m.opposite[h];
  const u32 b = head(m, h), c = apex(m, h), d = apex(m, k);
  const u32 f = face_of(h), q = face_of(k);
  const u32 x = new_face(e, v, b, c, m.face_origin[f]);
  const u32 y = x != none ? new_face(e, v, d, b, m.face_origin[q]) : none;
  if (y == none) {
    if (x != none) delete_face(e, x);
    return false;
  }
  // With a the tail of h: f keeps (a, v, c), q keeps (v, a, d); x = (v, b, c) and y = (v, d, b) are new.
  const u32 bc = m.opposite[next_edge(h)], db = m.opposite[previous_edge(k)];
  set_corner(e, next_edge(h), v);
  set_corner(e, k, v);
  link(e, 3 * x, 3 * y + 2);
  link(e, 3 * x + 1, bc);
  link(e, 3 * x + 2, next_edge(h));
  link(e, 3 * y, previous_edge(k));
  link(e, 3 * y + 1, db);
  set_vertex_edge(e, v, 3 * x);
  set_vertex_edge(e, b, 3 * y + 2);
  insert(near, m, f);
  insert(near, m, q);
  insert(near, m, x);
  insert(near, m, y);
  return true;
}

u32 locally_longest(const Mesh& m, const EdgeAims& aims, u32 h) {
  for (;;) {
    const u32 here = longest_edge(m, aims, face_of(h)), there = longest_edge(m, aims, face_of(m.opposite[h]));
    const u32 longest = is_longer(m, aims, there, here) ? there : here;
    if (longest == h || longest == m.opposite[h]) return h;
    h = longest;
  }
}

namespace {

struct Bisected {
  Vec3 at[3];
};

// The corner from which the longest edge runs to the next corner.
u32 longest_side(const Bisected& t, f64& squared) {
  u32 best = 0;
  for (u32 i = 0; i < 3; ++i) {
    const f64 side = squared_length(t.at[(i + 1) % 3] - t.at[i]);
    if (i > 0 && side <= squared) continue;
    squared = side;
    best = i;
  }
  return best;
}

// Deeper bisections make more triangles than any mesh has.
constexpr u32 deepest_bisection = 30;

u64 count_bisected(Bisected t, f64 longest, u64 most) {
  Bisected waiting[deepest_bisection];
  u32 depth = 0;
  for (u64 count = 1; count <= most;) {
    f64 squared = 0;
    const u32 i = longest_side(t, squared), k = (i + 1) % 3;
    if (!(squared > longest)) {
      if (depth == 0) return count;
      t = waiting[--depth];
      continue;
    }
    if (depth == deepest_bisection) return most + 1;
    const Vec3 middle = into_exact_range(midpoint(t.at[i], t.at[k]));
    waiting[depth] = t;
    waiting[depth++].at[i] = middle;
    t.at[k] = middle;
    ++count;
  }
  return most + 1;
}

// The square beyond which edges of the face are split, at the earliest.
f64 longest_in(const Mesh& m, const EdgeAims& aims, u32 f) {
  const u32* v = m.corner + 3 * f;
  if (!is_chosen(aims, v[0], v[1]) && !is_chosen(aims, v[1], v[2]) && !is_chosen(aims, v[2], v[0])) return no_way;
  if (aims.length == nullptr) return square(aims.split);
  return square(aims.split * f64{min_of(aims.length[v[0]], min_of(aims.length[v[1]], aims.length[v[2]]))});
}

// As count_bisected() for all faces, with squares `scale` times as large.
u64 count_all_bisected(const Mesh& m, const EdgeAims& aims, f64 scale, u64 most) {
  u64 count = 0;
  for (u32 f = 0; f < m.face_count && count <= most; ++f)
    if (face_lives(m, f))
      count +=
          count_bisected({{corner_position(m, 3 * f), corner_position(m, 3 * f + 1), corner_position(m, 3 * f + 2)}},
                         scale * longest_in(m, aims, f), most - count);
  return count;
}

}  // namespace

u64 most_faces_bisected(const Mesh& m, const EdgeAims& aims) {
  // Edges half as long make four times as many faces, so large numbers follow from smaller ones.
  const u64 most = (u64{1} << 20) + 16 * u64{m.face_count};
  f64 scale = 1;
  for (u32 halvings = 0; halvings < 16; ++halvings, scale *= 4)
    if (const u64 count = count_all_bisected(m, aims, scale, most); count <= most) return count << 2 * halvings;
  return most << 32;
}

}  // namespace tpa
