#include "seam.h"

#include "disjoint_sets.h"
#include "neck.h"
#include "order.h"
#include "predicates.h"

namespace tpa {

namespace {

// Nodes of the union-find of pieces: vertices, then piercings.
struct Pieces {
  SeamScratch& s;
  u32 vertices;

  u32 of_piercing(u32 i) const { return vertices + i; }
  u32& parent(u32 node) { return node < vertices ? s.piece[node] : s.piercings[node - vertices].parent; }
  u32 find(u32 node) {
    while (parent(node) != node) {
      parent(node) = parent(parent(node));
      node = parent(node);
    }
    return node;
  }
  // The smaller id becomes the root, so a piece with a vertex is named by one.
  void join(u32 a, u32 b) {
    a = find(a);
    b = find(b);
    if (a != b) parent(max_of(a, b)) = min_of(a, b);
  }
};

struct Seams {
  const Mesh& m;
  Regions& r;
  SeamScratch& s;
  Pieces pieces;
};

u32 lower_half_edge(const Mesh& m, u32 h) { return min_of(h, m.opposite[h]); }

bool has_corner(const Mesh& m, u32 f, u32 v) {
  const u32* c = m.corner + 3 * f;
  return c[0] == v || c[1] == v || c[2] == v;
}

// ---------------------------------------------------------------- piercings

// r.visited, left zero by find_loops: bit i of face f is set while something meets its half-edge 3 f + i.
bool is_met(const Seams& q, u32 h) { return (q.r.visited[face_of(h)] >> index_in_face(h) & 1) != 0; }
void set_met(Seams& q, u32 h) {
  u8& bits = q.r.visited[face_of(h)];
  bits = static_cast<u8>(bits | 1u << index_in_face(h));
}

f64 place_along(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& normal) {
  const f64 from = abs_of(dot(normal, p - a)), to = abs_of(dot(normal, q - a));
  return from + to > 0 ? from / (from + to) : 0;
}

// Where do edges of f pass through g?
void pierce(Seams& q, u32 f, u32 g) {
  const Mesh& m = q.m;
  const Vec3 &a = corner_position(m, 3 * g), &b = corner_position(m, 3 * g + 1), &c = corner_position(m, 3 * g + 2);
  for (u32 h = 3 * f; h < 3 * f + 3; ++h) {
    // Both faces of an edge are in contact with what meets it.
    if (h > m.opposite[h] || has_corner(m, g, tail(m, h)) || has_corner(m, g, head(m, h))) continue;
    const Vec3 &from = m.position[tail(m, h)], &to = m.position[head(m, h)];
    const Passage passage = segment_through_triangle(from, to, a, b, c);
    if (passage == Passage::misses) continue;
    set_met(q, h);
    set_met(q, m.opposite[h]);
    if (passage == Passage::touches) continue;
    const i8 turn = passage == Passage::enters ? 1 : -1;
    q.s.piercings.push({place_along(from, to, a, area_normal(a, b, c)), h, g, 0, turn, false});
  }
}

void find_piercings(Seams& q, Span<const Contact> contacts) {
  q.s.piercings.clear();
  for (const Contact& c : contacts) {
    pierce(q, c.a, c.b);
    pierce(q, c.b, c.a);
  }
  Stack<Piercing>& list = q.s.piercings;
  sort_in_place(list.data, list.size, [](const Piercing& x, const Piercing& y) {
    if (x.edge != y.edge) return x.edge < y.edge;
    return x.along != y.along ? x.along < y.along : x.face < y.face;
  });
  for (u32 i = 0; i < list.size; ++i) list[i].parent = q.pieces.of_piercing(i);
}

// The piercings of edge e: [first, end).
struct Range {
  u32 first, end;
};
Range piercings_of(const SeamScratch& s, u32 e) {
  const Stack<Piercing>& list = s.piercings;
  const u32 first = count_before(list.data, list.size, [&](const Piercing& p) { return p.edge < e; });
  u32 end = first;
  while (end < list.size && list[end].edge == e) ++end;
  return {first, end};
}
// Mostly none: those of an edge that nothing meets need not be sought.
Range piercings_of_half_edge(const Seams& q, u32 h) {
  return is_met(q, h) ? piercings_of(q.s, lower_half_edge(q.m, h)) : Range{0, 0};
}

// ---------------------------------------------------------------- sheets

void find_sheets(Seams& q) {
  const Mesh& m = q.m;
  for (u32 v : q.r.members) {
    q.s.sheet[v] = q.s.piece[v] = v;
    q.s.neck.front[v] = none;
  }
  for (u32 v : q.r.members)
    for_each_outgoing(m, v, [&](u32 h) {
      if (!in_cluster(q.r, head(m, h)) || is_met(q, h)) return;
      join_sets(q.s.sheet, v, head(m, h));
    });
  for (u32 v : q.r.members) q.pieces.join(v, find_set(q.s.sheet, v));
}

// Winding numbers beyond this are as good as this.
constexpr i32 most_winding = 100;

// The first piercing of an edge that leaves a cluster, seen from the end that stays; none where it has none.
u32 first_piercing(const Seams& q, u32 h) {
  const Range range = piercings_of_half_edge(q, h);
  if (range.first == range.end) return none;
  return head(q.m, h) == tail(q.m, lower_half_edge(q.m, h)) ? range.first : range.end - 1;
}

// A sheet that a loop bounds lies on the boundary, as the patch beyond the loop does, unless there is a seam between
// them; for others a ray is cast, from the first of its vertices where it tells.
void judge_sheets(Seams& q, const Grid& g, i32 winding_at_infinity) {
  const Mesh& m = q.m;
  for (u32 v : q.r.members) q.s.winding[v] = unknown_winding;
  for (const CutLoop& loop : q.r.loops) {
    const u32 h = q.r.cuts[loop.first].half_edge;
    if (first_piercing(q, h) == none) q.s.winding[find_set(q.s.sheet, tail(m, h))] = 0;
  }
  for (u32 v : q.r.members) {
    i8& known = q.s.winding[find_set(q.s.sheet, v)];
    i32 winding = 0;
    if (known == unknown_winding && outer_winding(m, g, v, winding_at_infinity, winding))
      known = static_cast<i8>(max_of(-most_winding, min_of(most_winding, winding)));
  }
  for (u32 v : q.r.members) q.s.winding[v] = q.s.winding[find_set(q.s.sheet, v)];
}

bool is_boundary(const Seams& q, u32 v) {
  return in_cluster(q.r, v) && (q.s.winding[v] == 0 || q.s.winding[v] == unknown_winding);
}

// ---------------------------------------------------------------- pieces

// Walks along an edge and joins what its parts on the boundary connect. What stays is no part of a piece.
void join_along_edge(Seams& q, Range range) {
  Stack<Piercing>& list = q.s.piercings;
  const u32 e = list[range.first].edge;
  const u32 ends[2] = {tail(q.m, e), head(q.m, e)};
  i32 total = 0;
  for (u32 i = range.first; i < range.end; ++i) total += list[i].turn;
  const bool from_tail = q.s.winding[ends[0]] != unknown_winding;
  if (!from_tail && q.s.winding[ends[1]] == unknown_winding) return;
  i32 winding = from_tail ? q.s.winding[ends[0]] : q.s.winding[ends[1]] - total;
  const auto node = [&](u32 v) { return in_cluster(q.r, v) ? v : none; };
  u32 before = node(ends[0]);
  for (u32 i = range.first; i <= range.end; ++i) {
    const bool last = i == range.end;
    const u32 after = last ? node(ends[1]) : q.pieces.of_piercing(i);
    if (winding == 0) {
      if (before != none && after != none) q.pieces.join(before, after);
      if (i > range.first) list[i - 1].kept = true;
      if (!last) list[i].kept = true;
    }
    if (!last) winding += list[i].turn;
    before = after;
  }
}

// Calls visit(i) for the piercings of edges of f through g, of those half-edges h that may_be_met(h).
template <class Met, class Visit>
void for_each_piercing(const Mesh& m, const SeamScratch& s, u32 f, u32 g, Met may_be_met, Visit visit) {
  for (u32 h = 3 * f; h < 3 * f + 3; ++h) {
    if (!may_be_met(h)) continue;
    const Range range = piercings_of(s, lower_half_edge(m, h));
    for (u32 i = range.first; i < range.end; ++i)
      if (s.piercings[i].face == g) visit(i);
  }
}

// The segment in which two faces cross joins its ends. Faces that only touch are joined by what they have on the
// boundary: touching counts as meeting.
void join_across_contact(Seams& q, const Contact& c) {
  u32 first = none;
  bool crossing = false;
  const auto add = [&](u32 node) {
    if (first == none) first = node;
    q.pieces.join(first, node);
  };
  const auto add_piercing = [&](u32 i) {
    crossing = true;
    if (q.s.piercings[i].kept) add(q.pieces.of_piercing(i));
  };
  const auto met = [&](u32 h) { return is_met(q, h); };
  for_each_piercing(q.m, q.s, c.a, c.b, met, add_piercing);
  for_each_piercing(q.m, q.s, c.b, c.a, met, add_piercing);
  if (crossing) return;
  for (u32 i = 0; i < 3; ++i) {
    if (const u32 v = q.m.corner[3 * c.a + i]; is_boundary(q, v)) add(v);
    if (const u32 v = q.m.corner[3 * c.b + i]; is_boundary(q, v)) add(v);
  }
}

// A seam that closes within one face, where a spike comes through it, meets no edge of that face: it is joined to the
// face's own corners.
void join_inside_face(Seams& q, u32 i) {
  const Piercing& p = q.s.piercings[i];
  bool leaves = false;
  for (u32 h = 3 * p.face; h < 3 * p.face + 3; ++h) {
    const Range range = piercings_of_half_edge(q, h);
    for (u32 k = range.first; k < range.end; ++k)
      leaves = leaves || (q.s.piercings[k].kept &&
                          q.pieces.find(q.pieces.of_piercing(k)) == q.pieces.find(q.pieces.of_piercing(i)));
  }
  if (leaves) return;
  for (u32 k = 0; k < 3; ++k) {
    const u32 v = q.m.corner[3 * p.face + k];
    if (is_boundary(q, v)) q.pieces.join(q.pieces.of_piercing(i), v);
  }
}

void join_pieces(Seams& q, Span<const Contact> contacts) {
  Stack<Piercing>& list = q.s.piercings;
  for (u32 i = 0; i < list.size;) {
    const Range range = piercings_of(q.s, list[i].edge);
    join_along_edge(q, range);
    i = range.end;
  }
  for (const Contact& c : contacts) join_across_contact(q, c);
  for (u32 i = 0; i < list.size; ++i)
    if (list[i].kept) join_inside_face(q, i);
}

// ---------------------------------------------------------------- loops

// Do several clusters have loops or vertices of the boundary in the piece of these loops?
bool is_mixed(Seams& q, Span<const CutLoop> loops) {
  if (!bound_one_cluster(loops)) return true;
  for (u32 v : q.r.members)
    if (is_boundary(q, v) && q.pieces.find(v) == loops[0].piece && find_cluster(q.r, v) != loops[0].cluster)
      return true;
  return false;
}

// What lies along a loop, the seam or the sheet within, is of one piece. Says how much of the cut edges is seen.
void join_along_loop(Seams& q, CutLoop& loop) {
  for (u32 i = loop.first; i < loop.first + loop.count; ++i) {
    Cut& cut = q.r.cuts[i];
    const u32 p = first_piercing(q, cut.half_edge);
    if (p != none) {
      const Piercing& piercing = q.s.piercings[p];
      cut.seen = tail(q.m, piercing.edge) == cut.outside ? piercing.along : 1 - piercing.along;
    }
    const u32 node = p != none ? q.pieces.of_piercing(p) : tail(q.m, cut.half_edge);
    if (i == loop.first) loop.piece = node;
    q.pieces.join(loop.piece, node);
  }
}

bool comes_before(const CutLoop& a, const CutLoop& b) {
  if (a.group != b.group) return a.group < b.group;
  if (a.piece != b.piece) return a.piece < b.piece;
  return a.cluster != b.cluster ? a.cluster < b.cluster : a.first < b.first;
}

// The loops of one piece of the surface, or of several where its legs came apart.
void push_pieces(Regions& r, u32 first, u32 end) {
  sort_in_place(r.loops.data + first, end - first, comes_before);
  for (u32 next = first + 1; next <= end; ++next) {
    if (next < end && r.loops[next].piece == r.loops[first].piece) continue;
    r.pieces.push({first, next - first});
    first = next;
  }
}

void list_pieces(Seams& q, const Grid& g, i32 winding_at_infinity) {
  Regions& r = q.r;
  for (CutLoop& loop : r.loops) join_along_loop(q, loop);
  for (CutLoop& loop : r.loops) loop.piece = q.pieces.find(loop.piece);
  sort_in_place(r.loops.data, r.loops.size, comes_before);
  for (u32 first = 0, end = 1; end <= r.loops.size; ++end) {
    if (end < r.loops.size && r.loops[end].piece == r.loops[first].piece && r.loops[end].group == r.loops[first].group)
      continue;
    const Span<CutLoop> loops = r.loops.span().part(first, end - first);
    if (loops.size > 1 && !is_mixed(q, loops)) part_legs(q.m, g, winding_at_infinity, r, loops, q.s.neck);
    push_pieces(r, first, end);
    first = end;
  }
}

}  // namespace

bool faces_cross(const Mesh& m, const SeamScratch& s, u32 f, u32 g) {
  bool cross = false;
  const auto any = [](u32) { return true; };
  for_each_piercing(m, s, f, g, any, [&](u32) { cross = true; });
  for_each_piercing(m, s, g, f, any, [&](u32) { cross = true; });
  return cross;
}

void find_pieces(const Mesh& m, const Grid& g, i32 winding_at_infinity, Span<const Contact> contacts, Regions& r,
                 SeamScratch& s) {
  Seams q{m, r, s, {s, m.vertex_count}};
  find_piercings(q, contacts);
  find_sheets(q);
  judge_sheets(q, g, winding_at_infinity);
  join_pieces(q, contacts);
  list_pieces(q, g, winding_at_infinity);
  const auto forget = [&](u32 f) {
    r.visited[f] = 0;
    for (u32 i = 0; i < 3; ++i) r.visited[face_of(m.opposite[3 * f + i])] = 0;
  };
  for (const Contact& c : contacts) {
    forget(c.a);
    forget(c.b);
  }
}

}  // namespace tpa
