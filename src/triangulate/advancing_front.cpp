// SPDX-License-Identifier: MIT
#include "triangulate/advancing_front.h"

#include "base/arena.h"
#include "base/heap.h"
#include "base/sort.h"
#include "triangulate/front.h"

namespace tpa {

namespace {

struct Zipper : Polygons {
  const FacePlacer& placer;
  Stack<HeapEntry> heap;
  Stack<u32> front;  // corners whose edges are to be opened across
  u32 stamps = 1;    // given to edges
  u32 openings = 0;
  bool within_loops = false;
};

bool place(Zipper& z, u32 a, u32 b, u32 c) {
  const FaceCorners face{{z.corners[a].vertex, z.corners[b].vertex, z.corners[c].vertex}};
  if (z.faces.size == z.faces.capacity || !z.placer.place(z.placer.caller, face)) return false;
  list_face(z, face);
  return true;
}

void take_back(Zipper& z, u32 face) {
  z.placer.take_back(z.placer.caller, face);
  unlist_face(z, face);
}

// ---------------------------------------------------------------- joining loops

// A face over the edge from a corner to the next, with an apex.
struct Join {
  f64 length;
  u32 corner, apex;
};

// Joined loops are one polygon.
bool may_join(const Zipper& z, u32 a, u32 b) {
  return z.corners[b].stamp == 0 && z.corners[a].polygon != z.corners[b].polygon;
}

// A point at this squared distance or more from one end of an edge makes a way longer than `way` between both ends.
f64 squared_reach(f64 way, f64 edge) { return 0.25 * (way + edge) * (way + edge); }

// Units of work to take up an edge; each corner looked at is one more.
constexpr u64 of_edge = 8;

// Enters the shortest join over the edge from last.corner that comes after `last`, between corners without a face. Its
// apex serves as stamp.
void enter_next_join(Zipper& z, const Join& last) {
  const Vec3 &p = z.point(last.corner), &q = z.point(z.corners[last.corner].next);
  Join best{no_way, last.corner, none};
  f64 reach = no_way;
  u64 units = of_edge;
  for_each_near(z.points, p, reach, [&](u32 vertex) {
    for (u32 b = z.corner_at[vertex]; b != none; b = z.corners[b].same) {
      ++units;
      const f64 l = length(p - z.point(b)) + length(q - z.point(b));
      const bool after = l > last.length || (l == last.length && b > last.apex);
      const bool before = l < best.length || (l == best.length && b < best.apex);
      if (!after || !before || !may_join(z, last.corner, b)) continue;
      best = {l, last.corner, b};
      reach = squared_reach(l, length(q - p));
    }
  });
  spend(z.placer.meter, units);
  if (best.apex != none) push_entry(z.heap, {best.length, best.corner, best.apex});
}

// Places the shortest free join and splices the loops there. A join that is not free now will not be free later.
bool join_next(Zipper& z) {
  // Joins beside a refused join are often refused too: beyond this number the loops count as out of reach.
  constexpr u32 most_refused = 64;
  for (u32 refused = 0; z.heap.size > 0 && refused < most_refused && !has_stopped(z.placer.meter);) {
    const HeapEntry least = pop_least(z.heap);
    const Join join{least.weight, least.number, least.tag};
    const u32 after = z.corners[join.corner].next;
    if (z.corners[join.corner].stamp != 0 || z.corners[after].stamp != 0) continue;
    if (may_join(z, join.corner, join.apex)) {
      if (place(z, join.corner, after, join.apex)) {
        splice(z, join.corner, join.apex);
        z.corners[join.corner].stamp = z.corners[after].stamp = z.corners[join.apex].stamp = 1;
        return true;
      }
      ++refused;
    }
    enter_next_join(z, join);
  }
  return false;
}

bool join_all(Zipper& z) {
  if (z.loops.size == 1) return true;
  for (u32 a = 0, count = z.corners.size; a < count; ++a) enter_next_join(z, {-1, a, 0});
  for (u32 left = z.loops.size - 1; left > 0; --left)
    if (!join_next(z)) return false;
  return true;
}

// ---------------------------------------------------------------- closing polygons

// Factor by which a face seems longer than it is: 1 to 5, drawn anew after each opening, so that a wrong closing is not
// repeated.
f64 scatter(const Zipper& z, u32 c, u32 apex) {
  if (z.openings == 0) return 1;
  const u64 hash = (((u64{z.openings} << 32 | z.corners[c].vertex) * scattering) ^ z.corners[apex].vertex) * scattering;
  return 1 + 4 * static_cast<f64>(hash >> 32) * 0x1p-32;
}

// The new edges of a face over the edge from c; none where the polygon has an edge already.
struct Chords {
  bool to, from;  // from c to the apex; from the apex to the next of c
};
Chords chords_of(const Zipper& z, u32 c, u32 apex) {
  return {z.corners[apex].next != c, z.corners[z.corners[c].next].next != apex};
}

// The length of both chords, scattered.
f64 weigh(const Zipper& z, u32 c, u32 apex) {
  const Chords chords = chords_of(z, c, apex);
  const f64 to = chords.to ? length(z.point(apex) - z.point(c)) : 0,
            from = chords.from ? length(z.point(apex) - z.point(z.corners[c].next)) : 0;
  return (to + from) * scatter(z, c, apex);
}

// Seen along n, does the line from a corner in this direction begin on the open side of the polygon?
bool is_open_towards(const Zipper& z, u32 corner, const Vec3& direction, const Vec3& n) {
  const Vec3 to = z.point(z.corners[corner].next) - z.point(corner),
             from = z.point(z.corners[corner].previous) - z.point(corner);
  const auto turns_left = [n](const Vec3& a, const Vec3& b) { return dot(n, cross(a, b)); };
  if (turns_left(to, from) >= 0) return turns_left(to, direction) > 0 && turns_left(direction, from) > 0;
  return turns_left(from, direction) < 0 || turns_left(direction, to) < 0;
}

// Do both ends of both chords begin on the open side? Otherwise the face lies over closed parts.
bool lies_inside(const Zipper& z, u32 c, u32 apex) {
  const u32 after = z.corners[c].next;
  const Chords chords = chords_of(z, c, apex);
  const Vec3 p = z.point(c), q = z.point(after), r = z.point(apex), n = cross(q - p, r - p);
  const auto is_open = [&](u32 a, u32 b) {
    const Vec3 ab = z.point(b) - z.point(a);
    return is_open_towards(z, a, ab, n) && is_open_towards(z, b, -1.0 * ab, n);
  };
  return (!chords.to || is_open(c, apex)) && (!chords.from || is_open(after, apex));
}

// Has the vertex another corner in this polygon?
bool has_twin(const Zipper& z, u32 corner) {
  u32 c = z.corner_at[z.corners[corner].vertex];
  while (c != none && (c == corner || z.corners[c].polygon != z.corners[corner].polygon)) c = z.corners[c].same;
  return c != none;
}

bool may_span(const Zipper& z, u32 c, u32 apex) {
  const Corner &a = z.corners[c], &b = z.corners[apex], &after = z.corners[a.next];
  if (b.vertex == a.vertex || b.vertex == after.vertex) return false;
  if (b.polygon != a.polygon) return false;
  const Chords chords = chords_of(z, c, apex);
  if (chords.to && chords.from && has_twin(z, apex)) return false;
  if (z.within_loops || z.loops.size == 1) return true;
  const u32 loop = z.loop_of[b.vertex];
  const bool stays = (chords.to && z.loop_of[a.vertex] == loop) || (chords.from && z.loop_of[after.vertex] == loop);
  return !stays && lies_inside(z, c, apex);
}

// Faces tried for each edge. Further faces are longer still, and in the way of later faces.
constexpr u32 most_tries = 8;

// Enters the shortest face over the edge from c that comes after the last face tried.
void enter_next_face(Zipper& z, u32 c) {
  Corner& corner = z.corners[c];
  if (corner.tries++ == most_tries) return;
  f64 weight = no_way, reach = no_way;
  u32 best = none;
  u64 units = of_edge;
  const f64 edge = length(z.point(corner.next) - z.point(c));
  const auto consider = [&](u32 b) {
    ++units;
    const f64 w = weigh(z, c, b);
    const bool after = w > corner.weight || (w == corner.weight && b > corner.apex);
    if (!after || w > weight || (w == weight && b > best) || !may_span(z, c, b)) return;
    weight = w;
    best = b;
    reach = squared_reach(w, edge);
  };
  const u32 before = corner.previous, beyond = z.corners[corner.next].next;
  consider(before);
  if (beyond != before) consider(beyond);
  for_each_near(z.points, z.point(c), reach, [&](u32 vertex) {
    for (u32 b = z.corner_at[vertex]; b != none; b = z.corners[b].same)
      if (b != c && b != corner.next && b != before && b != beyond) consider(b);
  });
  spend(z.placer.meter, units);
  if (best == none) return;
  corner.weight = weight;
  corner.apex = best;
  push_entry(z.heap, {weight, c, corner.stamp});
}

// The edge from c is new, or gets another turn.
void consider_edge(Zipper& z, u32 c) {
  Corner& corner = z.corners[c];
  corner.stamp = ++z.stamps;
  corner.tries = corner.apex = 0;
  corner.weight = -1;
  enter_next_face(z, c);
}

// Brings the polygons up to date after a face has been placed over the edge from c.
void advance(Zipper& z, u32 c, u32 apex) {
  const u32 after = z.corners[c].next;
  const Chords chords = chords_of(z, c, apex);
  if (chords.to && chords.from) {
    splice(z, c, apex);
    consider_edge(z, c);
    consider_edge(z, apex);
    return;
  }
  if (!chords.to) free_corner(z, c);
  if (!chords.from) free_corner(z, after);
  if (!chords.to && !chords.from) {
    free_corner(z, apex);
    return;
  }
  const u32 first = chords.to ? c : apex;
  connect(z, first, chords.to ? apex : after);
  consider_edge(z, first);
}

// Places the face over the edge from c that the heap has given out, if that is still allowed.
bool close_edge(Zipper& z, u32 c) {
  const u32 apex = z.corners[c].apex, after = z.corners[c].next;
  if (!z.is_open(apex) || apex == after || !may_span(z, c, apex)) return false;
  const Chords chords = chords_of(z, c, apex);
  const u32 u = z.corners[c].vertex, v = z.corners[after].vertex, w = z.corners[apex].vertex;
  if ((chords.to && edge_exists(z, u, w)) || (chords.from && edge_exists(z, v, w))) return false;
  if (chords.to && chords.from && !has_room(z)) return false;
  if (!place(z, c, after, apex)) return false;
  advance(z, c, apex);
  return true;
}

bool is_closed(const Zipper& z) { return z.closed == z.corners.size; }

bool close_polygons(Zipper& z) {
  for (u32 stage = 0; stage < 2 && !is_closed(z); ++stage) {
    z.within_loops = stage == 1;
    z.heap.size = 0;
    for (u32 c = 0; c < z.corners.size; ++c)
      if (z.is_open(c)) consider_edge(z, c);
    while (z.heap.size > 0 && !is_closed(z) && !has_stopped(z.placer.meter)) {
      const HeapEntry least = pop_least(z.heap);
      const u32 c = least.number;
      if (z.corners[c].stamp == least.tag && !close_edge(z, c)) enter_next_face(z, c);
    }
  }
  return is_closed(z);
}

// ---------------------------------------------------------------- opening again

// Takes back the face on the other side of the open edge after this corner; the third vertex of the face becomes a
// corner.
void open_across(Zipper& z, u32 corner) {
  const u32 after = z.corners[corner].next;
  const u32 h = placed_half_edge(z, z.corners[after].vertex, z.corners[corner].vertex);
  if (h == none || !has_room(z)) return;
  const u32 vertex = z.faces[h / 3].v[(h + 2) % 3];
  const u32 apex = new_corner(z, vertex);
  z.corners[apex].polygon = z.corners[corner].polygon;
  connect(z, corner, apex);
  connect(z, apex, after);
  take_back(z, h / 3);
  drop_edge(z, apex);
  if (z.is_open(corner)) drop_edge(z, corner);
}

// Takes back the faces round all open polygons, ring by ring.
void open_wider(Zipper& z, u32 rings) {
  for (u32 ring = 0; ring < rings; ++ring) {
    z.front.clear();
    spend(z.placer.meter, z.corners.size);
    for (u32 v = 0; v < z.corners.size; ++v)
      if (z.is_open(v)) z.front.push(v);
    for (u32 v : z.front)
      if (z.is_open(v)) open_across(z, v);
  }
}

// Three times 21: the widest opening has 16 rings. Wider openings would be closed by faces far from the shortest; a new
// cut does better.
constexpr u32 most_openings = 63;

// The open rest is often small, and only faces placed before are in its way, which are opened and closed again. Most
// openings are one ring wide, half as many two rings, and so on (the lowest bits of 1, 2, 3 ..): small knots are
// settled nearby, and large knots do not wait long.
bool close_all(Zipper& z) {
  for (; !close_polygons(z); ++z.openings) {
    if (z.openings == most_openings || has_stopped(z.placer.meter)) return false;
    const u32 turn = z.openings / 3 + 1;
    open_wider(z, turn & (~turn + 1));
  }
  return true;
}

// Cut open along its edges, a surface without handles is a polygon of vertices + 2 * loops corners, and of four faces
// less. Each face that parts a polygon makes one more corner; as long as parts have three, half as many.
constexpr u32 faces_each = 2, corners_each = 3, ears_each = 4;  // for each vertex; a loop has three at least

struct ZipperTables {
  Stack<HeapEntry> heap;
  Stack<Corner> corners;
  Stack<FaceCorners> faces;
  Stack<u32> front;
  u32 *order, *leaving, *after, *corner_at, *loop_of;
};
ZipperTables lay_out(Carver& carver, u64 vertices) {
  const auto stack = [&]<class T>(Stack<T>& s, u32 each) { carver.take(s, static_cast<u32>(each * vertices)); };
  ZipperTables t{};
  stack(t.heap, ears_each);
  stack(t.corners, corners_each);
  stack(t.faces, faces_each);
  stack(t.front, corners_each);
  carver.take(t.order, vertices);
  carver.take(t.leaving, vertices);
  carver.take(t.after, 3 * faces_each * vertices);
  carver.take(t.corner_at, vertices);
  carver.take(t.loop_of, vertices);
  return t;
}

}  // namespace

u64 zip_scratch_bytes(u64 vertices) {
  Carver carver{nullptr, element_alignment};
  lay_out(carver, vertices);
  return carver.bytes;
}

bool zip(Span<const Loop> loops, Span<u8> scratch, const FacePlacer& placer, Stack<u32>& open) {
  open.clear();
  u32 vertices = 0;
  for (const Loop& loop : loops) vertices += loop.count;
  if (zip_scratch_bytes(vertices) > scratch.size) return false;
  Carver carver{scratch.data, element_alignment};
  const ZipperTables t = lay_out(carver, vertices);
  const KdTree points{loops[0].points, t.order, vertices};
  Zipper z{{loops, points, t.corners, t.faces, t.leaving, t.after, t.corner_at, t.loop_of}, placer, t.heap, t.front};
  spend(placer.meter, 2 * sorting_steps(vertices) + 4 * u64{vertices});
  build(z.points);
  begin(z);
  if (!join_all(z)) return false;
  const bool closed = close_all(z);
  for (u32 v = 0; v < vertices; ++v)
    if (z.corner_at[v] != none) open.push(v);
  return closed;
}

}  // namespace tpa
