// SPDX-License-Identifier: MIT
#include "cut/intersection_curves.h"

#include "base/disjoint_sets.h"
#include "base/open_hash.h"
#include "base/sort.h"
#include "cut/neck.h"
#include "detect/face_pair.h"
#include "geometry/predicates.h"

namespace tpa {

namespace {

// The disjoint sets of pieces: nodes are vertices, then piercings.
struct Pieces {
  SeamScratch& s;
  u32 vertices;

  u32 of_piercing(u32 i) const { return vertices + i; }
  auto parent() const {
    return [this](u32 node) -> u32& { return node < vertices ? s.piece[node] : s.piercings[node - vertices].parent; };
  }
  u32 find(u32 node) const { return find_set(parent(), node); }
  // The lower number names a piece, so a piece with a vertex is named by a vertex.
  void join(u32 a, u32 b) const { join_sets(parent(), a, b); }
};

struct Seams {
  const Mesh& m;
  Clusters& r;
  SeamScratch& s;
  Pieces pieces;
};

u32 lower_half_edge(const Mesh& m, u32 h) { return min_of(h, m.opposite[h]); }

// ---------------------------------------------------------------- piercings

void set_met(Seams& q, u32 h, u32 by) {
  u8& bits = q.r.met[face_of(h)];
  bits = static_cast<u8>(bits | by << index_in_face(h));
}

// Given a bit for each corner: the bits of the next corners.
u32 of_next(u32 corners) { return corners >> 1 | (corners & 1) << 2; }

// Finds the edges of f that pass through g. `sides` tells where the corners of f lie beside the plane of g.
void pierce(Seams& q, u32 f, u32 g, const CertainSides& sides) {
  const Mesh& m = q.m;
  const Triangle of_g = triangle_of(m, m.corner + 3 * g);
  const u32 shared = shared_corners(m.corner + 3 * f, m.corner + 3 * g), open = 7 ^ (sides.above | sides.below);
  const u32 uncertain = open | of_next(open), across = sides.above ^ of_next(sides.above);
  // Both faces of an edge are in contact with a pierced face: the edge belongs to the face of its lower half-edge.
  u32 own = 0;
  for (u32 i = 0; i < 3; ++i) own |= u32{3 * f + i < m.opposite[3 * f + i]} << i;
  for (u32 edges = own & ~(shared | of_next(shared)) & (uncertain | across); edges != 0; edges &= edges - 1) {
    const u32 i = static_cast<u32>(__builtin_ctz(edges)), h = 3 * f + i;
    const Vec3 &from = m.position[tail(m, h)], &to = m.position[head(m, h)];
    const Passage passage = (uncertain >> i & 1) != 0 ? segment_through_triangle(from, to, of_g)
                                                      : passage_across(from, to, of_g, (sides.above >> i & 1) != 0);
    if (passage == Passage::misses) continue;
    const u32 by = passage == Passage::touches || is_met(q.r, h) ? by_one | by_more : by_one;
    set_met(q, h, by);
    set_met(q, m.opposite[h], by);
    if (passage == Passage::touches) continue;
    const i8 turn = passage == Passage::enters ? 1 : -1;
    q.s.piercings.push({place_along(from, to, of_g), h, g, 0, turn, false});
  }
}

void find_piercings(Seams& q, Span<const Contact> contacts) {
  q.s.piercings.clear();
  for (const Contact& c : contacts) {
    const u32* corner = q.m.corner;
    const FacingSides sides = facing_sides(triangle_of(q.m, corner + 3 * c.a), triangle_of(q.m, corner + 3 * c.b));
    pierce(q, c.a, c.b, sides.of_a);
    pierce(q, c.b, c.a, sides.of_b);
  }
  Stack<Piercing>& list = q.s.piercings;
  sort_in_place(list.data, list.size, [](const Piercing& x, const Piercing& y) {
    if (x.edge != y.edge) return x.edge < y.edge;
    return x.along != y.along ? x.along < y.along : x.face < y.face;
  });
  for (u32 i = 0; i < list.size; ++i) list[i].parent = q.pieces.of_piercing(i);
}

// The piercings of edge e: [first, end).
struct EdgePiercings {
  u32 first, end;
};
EdgePiercings piercings_of(const SeamScratch& s, u32 e) {
  const Stack<Piercing>& list = s.piercings;
  const u32 first = count_before(list.data, list.size, [&](const Piercing& p) { return p.edge < e; });
  u32 end = first;
  while (end < list.size && list[end].edge == e) ++end;
  return {first, end};
}
// Mostly none: edges without contact need no search.
EdgePiercings piercings_of_half_edge(const Seams& q, u32 h) {
  return is_met(q.r, h) ? piercings_of(q.s, lower_half_edge(q.m, h)) : EdgePiercings{0, 0};
}

// ---------------------------------------------------------------- sheets

void find_sheets(Seams& q) {
  for (u32 v : q.r.members) q.s.sheet[v] = v;
  join_members(q.m, q.r, q.s.sheet);
  // A sheet belongs to a single piece.
  for (u32 v : q.r.members) q.s.piece[v] = find_set(q.s.sheet, v);
}

// Larger winding numbers are cut off here.
constexpr i32 most_winding = 100;

i8& winding_of_sheet(Seams& q, u32 v) { return q.s.winding[find_set(q.s.sheet, v)]; }

// The first piercing of an edge that leaves a cluster, seen from the end outside, or none.
u32 first_piercing(const Seams& q, u32 h) {
  const EdgePiercings range = piercings_of_half_edge(q, h);
  if (range.first == range.end) return none;
  return head(q.m, h) == tail(q.m, lower_half_edge(q.m, h)) ? range.first : range.end - 1;
}

// An edge through a single face leads from a sheet on the boundary to a sheet of winding number 1 or -1. Exceptions are
// ends with a star that meets itself.
void judge_across_edges(Seams& q) {
  for (const Piercing& p : q.s.piercings) {
    const u32 from = tail(q.m, p.edge), to = head(q.m, p.edge);
    if (is_met(q.r, p.edge, by_more) || !in_cluster(q.r, from) || !in_cluster(q.r, to)) continue;
    i8 &before = winding_of_sheet(q, from), &after = winding_of_sheet(q, to);
    if (before == 0 && after == unknown_winding) after = p.turn;
    if (after == 0 && before == unknown_winding) before = static_cast<i8>(-p.turn);
  }
}

// A sheet along a loop lies on the boundary, as the patch beyond the loop does, unless a seam runs between both. Other
// sheets are judged along edges, or by a ray from the first vertex with an answer.
void judge_sheets(Seams& q, const NearFaces& g, i32 winding_at_infinity) {
  const Mesh& m = q.m;
  for (u32 v : q.r.members) q.s.winding[v] = unknown_winding;
  for (const CutLoop& loop : q.r.loops) {
    const u32 h = q.r.cuts[loop.first].half_edge;
    if (first_piercing(q, h) == none) winding_of_sheet(q, tail(m, h)) = 0;
  }
  judge_across_edges(q);
  for (u32 v : q.r.members) {
    i8& known = winding_of_sheet(q, v);
    i32 winding = 0;
    if (known == unknown_winding && outer_winding(m, g, v, winding_at_infinity, winding))
      known = static_cast<i8>(max_of(-most_winding, min_of(most_winding, winding)));
  }
  for (u32 v : q.r.members) q.s.winding[v] = winding_of_sheet(q, v);
}

bool is_boundary(const Seams& q, u32 v) {
  return in_cluster(q.r, v) && (q.s.winding[v] == 0 || q.s.winding[v] == unknown_winding);
}

// ---------------------------------------------------------------- pieces

// Walks along an edge and joins the nodes at both ends of each part on the boundary. Ends outside clusters are no
// nodes.
void join_along_edge(Seams& q, EdgePiercings range) {
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

// A crossing: twice the number of a piercing, and 0 or 1 for the first or second face beside the edge.
u32 face_of_crossing(const Mesh& m, const SeamScratch& s, u32 crossing) {
  const u32 e = s.piercings[crossing / 2].edge;
  return face_of(crossing % 2 == 0 ? e : m.opposite[e]);
}

// The table of crossings. Half of the slots are taken, as two crossing faces have two piercings mostly. Never are all
// taken: each piercing is of two contacts, and there is room for as many piercings as contacts.
OpenHash table_of_crossings(const SeamScratch& s) {
  return {s.crossing, 2 * s.piercings.size + (s.piercings.size < s.piercings.capacity ? 1 : 0)};
}

// The crossing of two faces, or an empty slot.
u32& crossing_of(const Mesh& m, const SeamScratch& s, u32 f, u32 g) {
  return table_of_crossings(s).find(scattered(f ^ g, f + g), [&](u32 crossing) {
    const u32 own = face_of_crossing(m, s, crossing), met = s.piercings[crossing / 2].face;
    return (own == f && met == g) || (own == g && met == f);
  });
}

// The segment in which two faces cross joins its ends.
void join_across_crossings(Seams& q) {
  const Stack<Piercing>& list = q.s.piercings;
  table_of_crossings(q.s).clear();
  for (u32 c = 0; c < 2 * list.size; ++c) {
    u32& known = crossing_of(q.m, q.s, face_of_crossing(q.m, q.s, c), list[c / 2].face);
    if (known == none || !list[known / 2].kept)
      known = c;
    else if (list[c / 2].kept)
      q.pieces.join(q.pieces.of_piercing(known / 2), q.pieces.of_piercing(c / 2));
  }
}

// Joins the corners of f on the boundary to a node, or to each other if the node is none; returns the node.
u32 join_corners(Seams& q, u32 f, u32 node) {
  for (u32 k = 0; k < 3; ++k) {
    const u32 v = q.m.corner[3 * f + k];
    if (!is_boundary(q, v)) continue;
    if (node == none) node = v;
    q.pieces.join(node, v);
  }
  return node;
}

// A seam closed within a face, round a spike, meets no edge of the face, and is joined to the corners of the face.
void join_inside_face(Seams& q, u32 i) {
  const u32 f = q.s.piercings[i].face, node = q.pieces.of_piercing(i);
  for (u32 h = 3 * f; h < 3 * f + 3; ++h) {
    const EdgePiercings range = piercings_of_half_edge(q, h);
    for (u32 k = range.first; k < range.end; ++k)
      if (q.s.piercings[k].kept && q.pieces.find(q.pieces.of_piercing(k)) == q.pieces.find(node)) return;
  }
  join_corners(q, f, node);
}

void join_pieces(Seams& q, Span<const Contact> contacts) {
  const Stack<Piercing>& list = q.s.piercings;
  for (u32 first = 0, end = 1; end <= list.size; ++end) {
    if (end < list.size && list[end].edge == list[first].edge) continue;
    join_along_edge(q, {first, end});
    first = end;
  }
  join_across_crossings(q);
  // Touching counts as meeting: faces without a piercing are joined by their corners on the boundary.
  for (const Contact& c : contacts)
    if (!faces_cross(q.m, q.s, c.a, c.b)) join_corners(q, c.b, join_corners(q, c.a, none));
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

// Seam or sheet along a loop, just within the cluster, belong to one piece. Also finds the visible share of cut edges.
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

// Lists the loops [first, end) of one piece of surface, or of several if its legs came apart.
void push_pieces(Clusters& r, u32 first, u32 end) {
  sort_in_place(r.loops.data + first, end - first, comes_before);
  for (u32 next = first + 1; next <= end; ++next) {
    if (next < end && r.loops[next].piece == r.loops[first].piece) continue;
    r.pieces.push({first, next - first});
    first = next;
  }
}

void list_pieces(Seams& q, const NearFaces& g, i32 winding_at_infinity) {
  Clusters& r = q.r;
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

bool faces_cross(const Mesh& m, const SeamScratch& s, u32 f, u32 g) { return crossing_of(m, s, f, g) != none; }

void find_pieces(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, Span<const Contact> contacts, Clusters& r,
                 SeamScratch& s) {
  Seams q{m, r, s, {s, m.vertex_count}};
  find_piercings(q, contacts);
  find_sheets(q);
  judge_sheets(q, g, winding_at_infinity);
  join_pieces(q, contacts);
  list_pieces(q, g, winding_at_infinity);
  const auto forget = [&](u32 f) {
    r.met[f] = 0;
    for (u32 h = 3 * f; h < 3 * f + 3; ++h) r.met[face_of(m.opposite[h])] = 0;
  };
  for (const Contact& c : contacts) {
    forget(c.a);
    forget(c.b);
  }
}

}  // namespace tpa
