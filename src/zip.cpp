#include "zip.h"

#include "ear_heap.h"
#include "room.h"

namespace tpa {

namespace {

// A corner of the polygon that is left. A vertex has one more for each face that joins its loop to another's edge.
struct Corner {
  u32 vertex, loop;
  u32 previous, next;
  u32 stamp;  // none: clipped
};

struct Zipper {
  Span<const Loop> loops;
  DiscWeight weight;
  const FacePlacer& placer;
  Stack<Corner> corners;
  Stack<HandleFace> faces;  // placed
  Stack<Ear> heap;
  u32* root;  // per loop: parent in the union-find of joined loops
  bool within_loops = false;

  const Vec3& point(u32 corner) const {
    const Corner& c = corners[corner];
    u32 first = 0;
    for (u32 l = 0; l < c.loop; ++l) first += loops[l].count;
    return loops[c.loop].points[c.vertex - first];
  }
};

bool place(Zipper& z, u32 a, u32 b, u32 c) {
  const HandleFace face{{z.corners[a].vertex, z.corners[b].vertex, z.corners[c].vertex}};
  return z.placer.place(z.placer.caller, face) && z.faces.push(face);
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
  if (are_neighbours(z, u, v)) return true;
  for (const HandleFace& face : z.faces) {
    const bool has_u = face.v[0] == u || face.v[1] == u || face.v[2] == u;
    const bool has_v = face.v[0] == v || face.v[1] == v || face.v[2] == v;
    if (has_u && has_v) return true;
  }
  return false;
}

// ---------------------------------------------------------------- joining loops

struct Join {
  f64 length;
  u32 corner, apex;  // the face over the edge from corner, with apex
};
bool operator<(const Join& a, const Join& b) {
  if (a.length != b.length) return a.length < b.length;
  return a.corner != b.corner ? a.corner < b.corner : a.apex < b.apex;
}

u32 find_root(const Zipper& z, u32 loop) {
  while (z.root[loop] != loop) loop = z.root[loop];
  return loop;
}

// The shortest join after `last` between loops that are not joined yet, of corners that have no face yet.
bool next_join(const Zipper& z, const Join& last, Join& best) {
  best = {no_way, none, none};
  for (u32 a = 0; a < z.corners.size; ++a)
    for (u32 b = 0; b < z.corners.size; ++b) {
      if (z.corners[a].loop == z.corners[b].loop) continue;
      const u32 after = z.corners[a].next;
      if (z.corners[a].stamp != 0 || z.corners[after].stamp != 0 || z.corners[b].stamp != 0) continue;
      const Join join{length(z.point(a) - z.point(b)) + length(z.point(after) - z.point(b)), a, b};
      if (last < join && join < best && find_root(z, z.corners[a].loop) != find_root(z, z.corners[b].loop)) best = join;
    }
  return best.corner != none;
}

// ... a, a' ... and ... b ... become ... a, b ... b again, a' ...
void splice(Zipper& z, const Join& join) {
  Stack<Corner>& c = z.corners;
  const u32 a = join.corner, after = c[a].next, b = join.apex, again = c.size;
  c.push({c[b].vertex, c[b].loop, c[b].previous, after, 1});
  c[c[b].previous].next = again;
  c[a].next = b;
  c[b].previous = a;
  c[after].previous = again;
  c[a].stamp = c[after].stamp = c[b].stamp = 1;
  z.root[find_root(z, c[a].loop)] = find_root(z, c[b].loop);
}

bool join_all(Zipper& z) {
  // A join that is not free rules out little: its neighbours are tried next, but not all of them.
  constexpr u32 most_tries = 64;
  for (u32 left = z.loops.size - 1; left > 0; --left) {
    Join last{-1, 0, 0}, join;
    bool joined = false;
    for (u32 i = 0; i < most_tries && !joined && next_join(z, last, join); ++i, last = join)
      joined = place(z, join.corner, z.corners[join.corner].next, join.apex);
    if (!joined) return false;
    splice(z, join);
  }
  return true;
}

// ---------------------------------------------------------------- clipping ears

void consider(Zipper& z, u32 v) {
  Corner& c = z.corners[v];
  ++c.stamp;
  if (z.loops.size > 1 && !z.within_loops && z.corners[c.previous].loop == z.corners[c.next].loop) return;
  const Vec3 &a = z.point(c.previous), &b = z.point(c.next);
  push_ear(z.heap, {z.weight == DiscWeight::length ? length(b - a) : corner_cost(z.weight, a, z.point(v), b), v, c.stamp});
}

// Clips the ear at v if it may be; the last three corners are one face.
bool clip(Zipper& z, u32 v, u32& open) {
  const u32 a = z.corners[v].previous, b = z.corners[v].next;
  const bool last = z.corners[b].next == a;
  const u32 u = z.corners[a].vertex, w = z.corners[b].vertex;
  if (u == w || (!last && edge_exists(z, u, w)) || !place(z, a, v, b)) return false;
  z.corners[v].stamp = none;
  z.corners[a].next = b;
  z.corners[b].previous = a;
  open -= last ? 3 : 1;
  if (!last) {
    consider(z, a);
    consider(z, b);
  }
  return true;
}

bool clip_all(Zipper& z) {
  u32 open = z.corners.size;
  for (u32 stage = 0; stage < 2 && open > 0; ++stage) {
    z.within_loops = stage == 1;
    z.heap.size = 0;
    for (u32 v = 0; v < z.corners.size; ++v)
      if (z.corners[v].stamp != none) consider(z, v);
    while (z.heap.size > 0 && open > 0) {
      const Ear ear = pop_ear(z.heap);
      if (z.corners[ear.vertex].stamp == ear.stamp) clip(z, ear.vertex, open);
    }
  }
  return open == 0;
}

}  // namespace

u64 zip_scratch_bytes(u64 vertices, u64 loops) {
  const u64 corners = vertices + loops;
  Room room;
  room.take<Ear>(3 * corners);
  room.take<Corner>(corners);
  room.take<HandleFace>(corners + loops);
  room.take<u32>(loops);
  return room.used;
}

bool zip(Span<const Loop> loops, DiscWeight weight, Span<u8> scratch, const FacePlacer& placer) {
  u32 vertices = 0;
  for (const Loop& loop : loops) vertices += loop.count;
  if (zip_scratch_bytes(vertices, loops.size) > scratch.size) return false;
  const u32 corners = vertices + loops.size;
  Room room{scratch.data};
  Ear* ears = room.take<Ear>(u64{3} * corners);
  Corner* corner = room.take<Corner>(corners);
  HandleFace* faces = room.take<HandleFace>(u64{corners} + loops.size);
  u32* root = room.take<u32>(loops.size);
  Zipper z{loops, weight, placer, {corner, corners, 0}, {faces, corners + loops.size, 0}, {ears, 3 * corners, 0}, root};
  for (u32 l = 0, first = 0; l < loops.size; first += loops[l].count, ++l) {
    root[l] = l;
    for (u32 i = 0; i < loops[l].count; ++i)
      z.corners.push({first + i, l, first + (i == 0 ? loops[l].count : i) - 1, first + (i + 1 == loops[l].count ? 0 : i + 1), 0});
  }
  return join_all(z) && clip_all(z);
}

}  // namespace tpa
