#include "collapse.h"

namespace tpa {

namespace {

struct Star {
  u32 n = 0;
  u32 edge[largest_star];
};

bool read_star(const Mesh& m, u32 v, Star& star) {
  for_each_outgoing(m, v, [&](u32 h) {
    if (star.n < largest_star) star.edge[star.n] = h;
    ++star.n;
  });
  return star.n <= largest_star;
}

// Link condition (Dey et al. 1999): a and b have exactly the two apexes of their edge as common neighbours, and those
// keep at least three neighbours.
bool link_condition(const Mesh& m, u32 h, const Star& a, const Star& b) {
  u32 common = 0;
  for (u32 i = 0; i < a.n; ++i)
    for (u32 k = 0; k < b.n; ++k) common += head(m, a.edge[i]) == head(m, b.edge[k]) ? 1 : 0;
  return common == 2 && valence(m, apex(m, h)) > 3 && valence(m, apex(m, m.opposite[h])) > 3;
}

// Would the edges to the star's other vertices be short enough?
bool edges_fit(const Mesh& m, const Star& star, Vec3 to, u32 a, u32 b, f64 most_squared_length) {
  for (u32 i = 0; i < star.n; ++i) {
    const u32 x = head(m, star.edge[i]);
    if (x != a && x != b && squared_length(m.position[x] - to) > most_squared_length) return false;
  }
  return true;
}

// The faces that the merged vertex b would have, with b at its new place already.
bool collapse_trials(const Mesh& m, u32 a, u32 b, Vec3 old_b, const Star& sa, const Star& sb, Trial* trials, u32& n) {
  n = 0;
  const auto add = [&](u32 h, Vec3 from) {
    const u32 x = head(m, h), y = apex(m, h);
    if (x == a || x == b || y == a || y == b) return true;
    const Trial t{{b, x, y}};
    if (!turns_little(area_normal(from, m.position[x], m.position[y]), normal_of(m, t))) return false;
    trials[n++] = t;
    return true;
  };
  for (u32 i = 0; i < sa.n; ++i)
    if (!add(sa.edge[i], m.position[a])) return false;
  for (u32 i = 0; i < sb.n; ++i)
    if (!add(sb.edge[i], old_b)) return false;
  return true;
}

void mark_star(const Star& star, u8* face_mark, u8 value) {
  for (u32 i = 0; i < star.n; ++i) face_mark[face_of(star.edge[i])] = value;
}

void contract(Edit& e, Grid& g, u32 h, const Star& star_of_tail) {
  const Mesh& m = e.mesh;
  const u32 k = m.opposite[h];
  const u32 a = tail(m, h), b = head(m, h), c = apex(m, h), d = apex(m, k);
  const u32 bc = m.opposite[next_edge(h)], ca = m.opposite[previous_edge(h)];  // run c -> b, a -> c
  const u32 ad = m.opposite[next_edge(k)], db = m.opposite[previous_edge(k)];  // run d -> a, b -> d
  for (u32 i = 0; i < star_of_tail.n; ++i) set_corner(e, star_of_tail.edge[i], b);
  link(e, bc, ca);
  link(e, ad, db);
  set_vertex_edge(e, b, ca);
  set_vertex_edge(e, c, bc);
  set_vertex_edge(e, d, ad);
  const u32 gone[2] = {face_of(h), face_of(k)};
  for (u32 f : gone) {
    remove(g, f);
    delete_face(e, f);
  }
  delete_vertex(e, a);
}

}  // namespace

bool collapse(Edit& e, Grid& g, u32 h, Vec3 to, VertexOrigin origin, f64 most_squared_length, u8* face_mark) {
  Mesh& m = e.mesh;
  const u32 a = tail(m, h), b = head(m, h);
  Star sa, sb;
  if (!read_star(m, a, sa) || !read_star(m, b, sb) || sa.n + sb.n > largest_star) return false;
  // What is asked cheapest first: of the short edges that remeshing finds, most are refused for their neighbours' length.
  const Vec3 old = m.position[b], middle = into_exact_range(to);
  const f64 most = most_squared_length;
  if (!edges_fit(m, sa, middle, a, b, most) || !edges_fit(m, sb, middle, a, b, most)) return false;
  if (!link_condition(m, h, sa, sb)) return false;
  set_position(e, b, middle);
  Trial trials[largest_star];
  u32 n = 0;
  bool good = collapse_trials(m, a, b, old, sa, sb, trials, n);
  if (good) {
    mark_star(sa, face_mark, 1);
    mark_star(sb, face_mark, 1);
    good = trials_are_free(m, g, face_mark, trials, n);
    mark_star(sa, face_mark, 0);
    mark_star(sb, face_mark, 0);
  }
  if (!good) {
    m.position[b] = old;
    return false;
  }
  contract(e, g, h, sa);
  m.vertex_origin[b] = origin;
  for_each_outgoing(m, b, [&](u32 x) {
    remove(g, face_of(x));
    insert(g, m, face_of(x));
  });
  return true;
}

}  // namespace tpa
