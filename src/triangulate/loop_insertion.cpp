// SPDX-License-Identifier: MIT
// loop_insertion: handles for many or long loops (docs/handles.md).
#include "triangulate/loop_insertion.h"

#include "base/open_hash.h"

namespace tpa {

namespace {

Vec3 centre_of(const WeaveLoops& loops, u32 loop) {
  Vec3 sum;
  for (u32 v = loops.first[loop]; v < loops.first[loop + 1]; ++v) sum = sum + loops.points[v];
  return 1.0 / static_cast<f64>(loops.first[loop + 1] - loops.first[loop]) * sum;
}
Vec3 centre_of(const WeaveLoops& loops, const FaceCorners& face) {
  return 1.0 / 3 * (loops.points[face.v[0]] + loops.points[face.v[1]] + loops.points[face.v[2]]);
}
Span<const u32> vertices_of(const WeaveLoops& loops, u32 loop) {
  return {loops.numbers + loops.first[loop], loops.first[loop + 1] - loops.first[loop]};
}

// The shortest strip over all starts, where room and time allow, else a zipper.
void strip_between(const StripLoops& pair, Span<u8> scratch, Meter* meter, FaceCorners* out) {
  const u64 p = pair.x.size, q = pair.y.size;
  spend(meter, 4 * (p + q));
  if (strip_scratch_bytes(p, q) > scratch.size || p * q > exact_strip_work / q) {
    u32 i, j;
    nearest_pair(pair, i, j);
    return zip_strip(pair, i, j, out);
  }
  spend(meter, strip_work(p, q) * (q + 1));
  u32 best = 0;
  f64 best_length = shortest_strip_length(pair, 0, scratch.data);
  for (u32 start = 1; start < q; ++start) {
    const f64 l = shortest_strip_length(pair, start, scratch.data);
    if (l < best_length) best_length = l, best = start;
  }
  shortest_strip_from(pair, best, scratch.data, out);
}

// The loop to weave in next.
struct Nearest {
  u32 loop = none;
  f64 distance = 0;
};

void insert_loop(const WeaveLoops& loops, u32 loop, const WeaveScratch& scratch, FaceCorners* faces, u32& count) {
  const Vec3 centre = centre_of(loops, loop);
  u32 nearest = 0;
  f64 nearest_distance = squared_length(centre_of(loops, faces[0]) - centre);
  spend(loops.meter, count);
  for (u32 f = 1; f < count; ++f) {
    const f64 d = squared_length(centre_of(loops, faces[f]) - centre);
    if (d < nearest_distance) nearest_distance = d, nearest = f;
  }
  const FaceCorners hole = faces[nearest];
  faces[nearest] = faces[--count];
  const StripLoops pair{loops.points, vertices_of(loops, loop), {hole.v, 3}};
  strip_between(pair, scratch.strip, loops.meter, faces + count);
  count += pair.x.size + 3;
}

}  // namespace

u32 weave_loops(const WeaveLoops& loops, u32 start, const WeaveScratch& scratch, FaceCorners* faces) {
  u32 count = 0, woven = 1;
  u32* done = scratch.twin.data;  // not yet in use; loops are fewer than faces
  for (u32 l = 0; l < loops.count; ++l) done[l] = l == start;
  for (; woven < loops.count; ++woven) {
    Nearest nearest;
    for (u32 a = 0; a < loops.count && !has_stopped(loops.meter); ++a) {
      if (done[a] != 0) continue;
      spend(loops.meter, loops.first[loops.count] / 8 + 1);
      const Vec3 centre = centre_of(loops, a);
      for (u32 b = 0; b < loops.count; ++b) {
        if (done[b] == 0) continue;
        const f64 d = squared_length(centre_of(loops, b) - centre);
        if (nearest.loop == none || d < nearest.distance) nearest = {a, d};
      }
    }
    if (has_stopped(loops.meter)) return count;
    done[nearest.loop] = 1;
    if (woven == 1) {
      const StripLoops pair{loops.points, vertices_of(loops, start), vertices_of(loops, nearest.loop)};
      strip_between(pair, scratch.strip, loops.meter, faces);
      count = pair.x.size + pair.y.size;
    } else {
      insert_loop(loops, nearest.loop, scratch, faces, count);
    }
  }
  return count;
}

namespace {

u32 next_in_face(u32 h) { return h % 3 == 2 ? h - 2 : h + 1; }
u32 previous_in_face(u32 h) { return h % 3 == 0 ? h + 2 : h - 1; }
u32 tail(Span<FaceCorners> faces, u32 h) { return faces[h / 3].v[h % 3]; }
u32 head(Span<FaceCorners> faces, u32 h) { return tail(faces, next_in_face(h)); }

// twin[h] is the half-edge beside half-edge h, or none at a loop.
void link_faces(Span<FaceCorners> faces, Span<u32> slots, Span<u32> twin) {
  OpenHash hash{slots.data, slots.size};
  hash.clear();
  for (u32 h = 0; h < 3 * faces.size; ++h) {
    const u32 a = tail(faces, h), b = head(faces, h);
    u32& slot = hash.find(scattered(min_of(a, b), max_of(a, b)), [&](u32 g) {
      const u32 c = tail(faces, g), d = head(faces, g);
      return (a == c && b == d) || (a == d && b == c);
    });
    twin[h] = slot;
    if (slot == none)
      slot = h;
    else
      twin[slot] = h;
  }
}

// Does an edge join the tail of half-edge h to vertex v? Looks at the faces round the tail both ways from h, as far as
// the loop.
bool reaches(Span<FaceCorners> faces, Span<const u32> twin, u32 h, u32 v, u32& looked) {
  for (u32 at = h;; ++looked) {
    if (head(faces, at) == v) return true;
    if (twin[at] == none) break;
    at = next_in_face(twin[at]);
    if (at == h) return false;
  }
  for (u32 at = h;; ++looked) {
    const u32 into = previous_in_face(at);
    if (tail(faces, into) == v) return true;
    at = twin[into];
    if (at == none) return false;
  }
}

void join(Span<u32> twin, u32 h, u32 other) {
  twin[h] = other;
  if (other != none) twin[other] = h;
}

// Turns the edge a -> b of half-edge h, with c and d across, into c - d. Faces keep their numbers.
void flip(Span<FaceCorners> faces, Span<u32> twin, u32 h) {
  const u32 g = twin[h], h1 = next_in_face(h), h2 = next_in_face(h1), g1 = next_in_face(g), g2 = next_in_face(g1);
  const u32 a = tail(faces, h), b = tail(faces, h1), c = tail(faces, h2), d = tail(faces, g2);
  const u32 bc = twin[h1], ca = twin[h2], ad = twin[g1], db = twin[g2];
  const u32 f = h / 3, e = g / 3;
  faces[f] = {{c, a, d}};
  faces[e] = {{d, b, c}};
  join(twin, 3 * f, ca);
  join(twin, 3 * f + 1, ad);
  join(twin, 3 * e, db);
  join(twin, 3 * e + 1, bc);
  join(twin, 3 * f + 2, 3 * e + 2);
}

}  // namespace

void shorten_by_flips(const WeaveLoops& loops, u32 sweeps, const WeaveScratch& scratch, Span<FaceCorners> faces) {
  const Span<u32> twin = scratch.twin;
  link_faces(faces, scratch.half_edges, twin);
  for (u32 sweep = 0; sweep < sweeps; ++sweep) {
    bool changed = false;
    spend(loops.meter, faces.size);
    if (has_stopped(loops.meter)) return;
    for (u32 h = 0; h < 3 * faces.size; ++h) {
      const u32 g = twin[h];
      if (g == none || g < h) continue;
      const u32 a = tail(faces, h), b = head(faces, h);
      const u32 c = tail(faces, previous_in_face(h)), d = tail(faces, previous_in_face(g));
      if (loops.loop_of[c] == loops.loop_of[d]) continue;
      if (!(squared_length(loops.points[c] - loops.points[d]) < squared_length(loops.points[a] - loops.points[b])))
        continue;
      u32 looked = 2;
      const bool exists = reaches(faces, twin, previous_in_face(h), d, looked);
      spend(loops.meter, looked / 2);
      if (exists) continue;
      flip(faces, twin, h);
      changed = true;
    }
    if (!changed) return;
  }
}

}  // namespace tpa
