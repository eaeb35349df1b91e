#include "zip.h"

#include "ear_heap.h"
#include "room.h"

namespace tpa {

namespace {

// A corner of the polygon that is left. A vertex has one more for each face that joins its loop to another's edge.
struct Corner {
  const Vec3* point;
  u32 vertex, loop;
  u32 previous, next;
  u32 stamp;  // none: clipped
  u32 same;   // another corner at the vertex that is not clipped
};

struct Zipper {
  Span<const Loop> loops;
  const FacePlacer& placer;
  Stack<Corner> corners;
  Stack<u32> free;          // corners that are clipped
  Stack<HandleFace> faces;  // placed; half-edge 3 f + i leaves corner i of face f
  u32 *leaving, *after;     // per vertex: the first half-edge that leaves it; per half-edge: another that does
  u32* corner_at;           // per vertex: the first corner
  Stack<Ear> heap;
  Stack<u32> front;         // corners whose edges are to be opened across
  u32* root;                // per loop: parent in the union-find of joined loops
  u32 openings = 0;
  bool within_loops = false;

  const Vec3& point(u32 corner) const { return *corners[corner].point; }
};

void list_half_edges(Zipper& z, u32 face) {
  for (u32 h = 3 * face; h < 3 * face + 3; ++h) {
    u32& first = z.leaving[z.faces[face].v[h % 3]];
    z.after[h] = first;
    first = h;
  }
}

void unlist_half_edges(Zipper& z, u32 face) {
  for (u32 h = 3 * face; h < 3 * face + 3; ++h) {
    u32* link = &z.leaving[z.faces[face].v[h % 3]];
    while (*link != h) link = &z.after[*link];
    *link = z.after[h];
  }
}

// The placed half-edge from u to v; none at a loop, and where both sides are open.
u32 placed_half_edge(const Zipper& z, u32 u, u32 v) {
  u32 h = z.leaving[u];
  while (h != none && z.faces[h / 3].v[(h + 1) % 3] != v) h = z.after[h];
  return h;
}

bool place(Zipper& z, u32 a, u32 b, u32 c) {
  const HandleFace face{{z.corners[a].vertex, z.corners[b].vertex, z.corners[c].vertex}};
  if (!z.placer.place(z.placer.caller, face) || !z.faces.push(face)) return false;
  list_half_edges(z, z.faces.size - 1);
  return true;
}

void take_back(Zipper& z, u32 face) {
  z.placer.take_back(z.placer.caller, face);
  unlist_half_edges(z, face);
  const u32 last = z.faces.size - 1;
  if (face != last) {
    unlist_half_edges(z, last);
    z.faces[face] = z.faces[last];
  }
  z.faces.pop();
  if (face != last) list_half_edges(z, face);
}

void list_corner(Zipper& z, u32 corner) {
  u32& first = z.corner_at[z.corners[corner].vertex];
  z.corners[corner].same = first;
  first = corner;
}

void free_corner(Zipper& z, u32 corner) {
  u32* link = &z.corner_at[z.corners[corner].vertex];
  while (*link != corner) link = &z.corners[*link].same;
  *link = z.corners[corner].same;
  z.corners[corner].stamp = none;
  z.free.push(corner);
}

// At the rim of what is open.
bool open_edge_exists(const Zipper& z, u32 u, u32 v) {
  u32 c = z.corner_at[u];
  while (c != none && z.corners[z.corners[c].next].vertex != v) c = z.corners[c].same;
  return c != none;
}

// Neighbours on a loop have their edge there, whether a face has been placed over it or not.
bool are_neighbours(const Zipper& z, u32 u, u32 v) {
  u32 first = 0, l = 0;
  while (u >= first + z.loops[l].count) first += z.loops[l++].count;
  const u32 n = z.loops[l].count;
  if (v < first || v >= first + n) return false;
  const u32 apart = u < v ? v - u : u - v;
  return apart == 1 || apart == n - 1;
}

bool edge_exists(const Zipper& z, u32 u, u32 v) {
  return are_neighbours(z, u, v) || placed_half_edge(z, u, v) != none || placed_half_edge(z, v, u) != none ||
         open_edge_exists(z, u, v) || open_edge_exists(z, v, u);
}

// ---------------------------------------------------------------- joining loops

// A face over the edge from a corner to the next, with an apex.
struct Join {
  f64 length;
  u32 corner, apex;
};

u32 find_root(const Zipper& z, u32 loop) {
  while (z.root[loop] != loop) loop = z.root[loop];
  return loop;
}

bool may_join(const Zipper& z, u32 a, u32 b) {
  return z.corners[b].stamp == 0 && find_root(z, z.corners[a].loop) != find_root(z, z.corners[b].loop);
}

// Enters the shortest join over the edge from last.corner that comes after `last`, of corners that have no face yet,
// with its apex for a stamp.
void enter_next_join(Zipper& z, const Join& last) {
  const Vec3 &p = z.point(last.corner), &q = z.point(z.corners[last.corner].next);
  Join best{no_way, last.corner, none};
  for (u32 b = 0; b < z.corners.size; ++b) {
    const f64 l = length(p - z.point(b)) + length(q - z.point(b));
    const bool after = l > last.length || (l == last.length && b > last.apex);
    if (after && l < best.length && may_join(z, last.corner, b)) best = {l, last.corner, b};
  }
  if (best.apex != none) push_ear(z.heap, {best.length, best.corner, best.apex});
}

// ... a, a' ... and ... b ... become ... a, b ... b again, a' ...
void splice(Zipper& z, const Join& join) {
  Stack<Corner>& c = z.corners;
  const u32 a = join.corner, after = c[a].next, b = join.apex, again = c.size;
  c.push({c[b].point, c[b].vertex, c[b].loop, c[b].previous, after, 1, none});
  list_corner(z, again);
  c[c[b].previous].next = again;
  c[a].next = b;
  c[b].previous = a;
  c[after].previous = again;
  c[a].stamp = c[after].stamp = c[b].stamp = 1;
  z.root[find_root(z, c[a].loop)] = find_root(z, c[b].loop);
}

// Places the shortest join that is free and splices the loops there. What is not free now will not be later.
bool join_next(Zipper& z) {
  // A join that is not free rules out little: its neighbours are tried next, but not all of them.
  constexpr u32 most_tries = 64;
  for (u32 tries = 0; z.heap.size > 0 && tries < most_tries;) {
    const Ear ear = pop_ear(z.heap);
    const Join join{ear.weight, ear.vertex, ear.stamp};
    const u32 after = z.corners[join.corner].next;
    if (z.corners[join.corner].stamp != 0 || z.corners[after].stamp != 0) continue;
    if (may_join(z, join.corner, join.apex)) {
      if (place(z, join.corner, after, join.apex)) {
        splice(z, join);
        return true;
      }
      ++tries;
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

// ---------------------------------------------------------------- clipping ears

// By how much an ear is to seem longer than it is: 1 to 5 times, another time after each opening, so that what was
// closed wrongly is not closed so again.
f64 scatter(const Zipper& z, u32 v) {
  if (z.openings == 0) return 1;
  const u64 hash = (u64{z.openings} << 32 | z.corners[v].vertex) * 0x9e3779b97f4a7c15u;
  return 1 + 4 * static_cast<f64>(hash >> 32) * 0x1p-32;
}

// The shortest chords first. Others make longer and more crooked faces, which the next steps then run into.
void consider(Zipper& z, u32 v) {
  Corner& c = z.corners[v];
  ++c.stamp;
  if (z.loops.size > 1 && !z.within_loops && z.corners[c.previous].loop == z.corners[c.next].loop) return;
  push_ear(z.heap, {length(z.point(c.next) - z.point(c.previous)) * scatter(z, v), v, c.stamp});
}

// Clips the ear at v if it may be; the last three corners are one face.
bool clip(Zipper& z, u32 v) {
  const u32 a = z.corners[v].previous, b = z.corners[v].next;
  const bool last = z.corners[b].next == a;
  const u32 u = z.corners[a].vertex, w = z.corners[b].vertex;
  if (u == w || (!last && edge_exists(z, u, w)) || !place(z, a, v, b)) return false;
  free_corner(z, v);
  if (last) {
    free_corner(z, a);
    free_corner(z, b);
    return true;
  }
  z.corners[a].next = b;
  z.corners[b].previous = a;
  consider(z, a);
  consider(z, b);
  return true;
}

bool is_closed(const Zipper& z) { return z.free.size == z.corners.size; }

bool clip_all(Zipper& z) {
  for (u32 stage = 0; stage < 2 && !is_closed(z); ++stage) {
    z.within_loops = stage == 1;
    z.heap.size = 0;
    for (u32 v = 0; v < z.corners.size; ++v)
      if (z.corners[v].stamp != none) consider(z, v);
    while (z.heap.size > 0 && !is_closed(z)) {
      const Ear ear = pop_ear(z.heap);
      if (z.corners[ear.vertex].stamp == ear.stamp) clip(z, ear.vertex);
    }
  }
  return is_closed(z);
}

// ---------------------------------------------------------------- opening again

// A corner at this vertex, linked to nothing yet.
Corner new_corner(const Zipper& z, u32 vertex) {
  u32 l = 0, first = 0;
  while (vertex >= first + z.loops[l].count) first += z.loops[l++].count;
  return {z.loops[l].points + (vertex - first), vertex, l, none, none, 0, none};
}

// Takes back the face on the other side of the open edge after this corner: its third vertex is a corner then.
void open_across(Zipper& z, u32 corner) {
  const u32 after = z.corners[corner].next;
  const u32 h = placed_half_edge(z, z.corners[after].vertex, z.corners[corner].vertex);
  if (h == none) return;
  if (z.free.size == 0) {
    z.corners.push({});
    z.free.push(z.corners.size - 1);
  }
  const u32 apex = z.faces[h / 3].v[(h + 2) % 3], c = z.free.pop();
  z.corners[c] = new_corner(z, apex);
  list_corner(z, c);
  z.corners[c].previous = corner;
  z.corners[c].next = after;
  z.corners[corner].next = c;
  z.corners[after].previous = c;
  take_back(z, h / 3);
}

// Takes back the faces round what is open, ring by ring.
void open_wider(Zipper& z, u32 rings) {
  for (u32 ring = 0; ring < rings; ++ring) {
    z.front.clear();
    for (u32 v = 0; v < z.corners.size; ++v)
      if (z.corners[v].stamp != none) z.front.push(v);
    for (u32 v : z.front) open_across(z, v);
  }
}

// Three times 63, so that the widest is 32 rings. Most that succeed at all do within 60.
constexpr u32 most_openings = 189;

// What is left is often small, and only faces placed before are in its way. They are opened and closed again. Most
// openings are one ring wide, and half as many twice as wide, and so on (the lowest bits of 1, 2, 3 ..): what lies
// nearby is settled there, without waiting long where it does not.
bool close_all(Zipper& z) {
  for (; !clip_all(z); ++z.openings) {
    if (z.openings == most_openings) return false;
    const u32 turn = z.openings / 3 + 1;
    open_wider(z, turn & (~turn + 1));
  }
  return true;
}

}  // namespace

u64 zip_scratch_bytes(u64 vertices, u64 loops) {
  const u64 corners = vertices + 2 * loops;
  Room room;
  room.take<Ear>(3 * corners);
  room.take<Corner>(corners);
  room.take<HandleFace>(corners);
  room.take<u32>(7 * corners + loops);
  return room.used;
}

bool zip(Span<const Loop> loops, Span<u8> scratch, const FacePlacer& placer) {
  u32 vertices = 0;
  for (const Loop& loop : loops) vertices += loop.count;
  if (zip_scratch_bytes(vertices, loops.size) > scratch.size) return false;
  // Cut open along its edges, a handle is a polygon of so many corners, and of two faces less.
  const u32 corners = vertices + 2 * loops.size;
  Room room{scratch.data};
  Ear* ears = room.take<Ear>(u64{3} * corners);
  Corner* corner = room.take<Corner>(corners);
  HandleFace* faces = room.take<HandleFace>(corners);
  u32* free = room.take<u32>(u64{7} * corners + loops.size);
  u32 *front = free + corners, *leaving = front + corners, *after = leaving + corners, *corner_at = after + 3 * corners,
      *root = corner_at + corners;
  Zipper z{loops, placer, {corner, corners, 0}, {free, corners, 0}, {faces, corners, 0}, leaving, after, corner_at,
           {ears, 3 * corners, 0}, {front, corners, 0}, root};
  for (u32 v = 0; v < vertices; ++v) z.leaving[v] = z.corner_at[v] = none;
  for (u32 l = 0, first = 0; l < loops.size; first += loops[l].count, ++l) {
    z.root[l] = l;
    for (u32 i = 0, n = loops[l].count; i < n; ++i) {
      z.corners.push({loops[l].points + i, first + i, l, first + (i + n - 1) % n, first + (i + 1) % n, 0, none});
      list_corner(z, first + i);
    }
  }
  return join_all(z) && close_all(z);
}

}  // namespace tpa
