// SPDX-License-Identifier: MIT
#include "cut/short_loops.h"

namespace tpa {

namespace {

// Bits of a face: each edge that bounds a disc together with the tree, and the face itself if all corners are near.
constexpr u8 face_is_near = 8;
constexpr u8 edge_bit(u32 h) { return static_cast<u8>(1u << index_in_face(h)); }

f64 length_of(const Mesh& m, u32 h) { return length(m.position[head(m, h)] - m.position[tail(m, h)]); }

// ---------------------------------------------------------------- the tree

void reach_vertex(const Mesh& m, ShortLoopSearch& s, u32 v, u32 through, f64 way) {
  if (s.near[v] == 0) {
    if (s.vertices.size == most_near_vertices || has_more_faces(m, v, most_faces_of_vertex)) return;
    s.vertices.push(v);
    s.near[v] = 1;
  } else if (!(way < s.way[v])) {
    return;
  }
  s.way[v] = way;
  s.towards[v] = through;
  push_entry(s.heap, {way, v, 0});
}

// Shortest paths from v, none longer than this.
void grow_tree(const Mesh& m, u32 v, f64 longest, ShortLoopSearch& s) {
  s.vertices.clear();
  s.heap.clear();
  reach_vertex(m, s, v, none, 0);
  while (s.heap.size > 0) {
    const HeapEntry entry = pop_least(s.heap);
    if (entry.weight > s.way[entry.number]) continue;
    for_each_outgoing(m, entry.number, [&](u32 h) {
      const f64 way = entry.weight + length_of(m, h);
      if (way <= longest) reach_vertex(m, s, head(m, h), h, way);
    });
    spend(s.meter, 4);
  }
}

// ---------------------------------------------------------------- discs

void collect_near_faces(const Mesh& m, ShortLoopSearch& s) {
  s.faces.clear();
  for (u32 v : s.vertices)
    for_each_outgoing(m, v, [&](u32 h) {
      u8& mark = s.face_mark[face_of(h)];
      if (mark != 0 || s.near[head(m, h)] == 0 || s.near[apex(m, h)] == 0) return;
      mark = face_is_near;
      s.faces.push(face_of(h));
    });
}

void set_half_edge(ShortLoopSearch& s, u32 h) {
  u8& mark = s.face_mark[face_of(h)];
  if (mark != 0) mark = static_cast<u8>(mark | edge_bit(h));
}

void set_edge(const Mesh& m, ShortLoopSearch& s, u32 h) {
  set_half_edge(s, h);
  set_half_edge(s, m.opposite[h]);
}

// The only edge of a face near by that is not set; none if there are none or several.
u32 last_edge(const ShortLoopSearch& s, u32 f) {
  switch (s.face_mark[f] ^ face_is_near) {
    case 3: return 3 * f + 2;
    case 5: return 3 * f + 1;
    case 6: return 3 * f;
    default: return none;
  }
}

// Sets the edges of the tree, and all edges that bound a disc of near faces together with the tree: a face with two
// edges set has the third one set.
void set_edges_of_discs(const Mesh& m, ShortLoopSearch& s) {
  for (u32 v : s.vertices)
    if (s.towards[v] != none) set_edge(m, s, s.towards[v]);
  for (u32 first : s.faces)
    for (u32 f = first, h = last_edge(s, f); h != none; h = last_edge(s, f)) {
      set_edge(m, s, h);
      f = face_of(m.opposite[h]);
    }
}

// ---------------------------------------------------------------- loops

// The loop of h and the paths to its ends, without their common part. False if it has too many edges.
bool collect_loop(const Mesh& m, ShortLoopSearch& s, u32 h, ShortLoop& loop) {
  u32 a = tail(m, h), b = head(m, h);
  loop.count = 0;
  u32 from_b = longest_short_loop;
  while (a != b) {
    if (loop.count + 1 >= from_b) return false;
    if (s.way[a] > s.way[b] || (s.way[a] == s.way[b] && s.towards[b] == none)) {
      loop.half_edge[loop.count++] = m.opposite[s.towards[a]];
      a = tail(m, s.towards[a]);
    } else {
      loop.half_edge[--from_b] = s.towards[b];
      b = tail(m, s.towards[b]);
    }
  }
  while (from_b < longest_short_loop) loop.half_edge[loop.count++] = loop.half_edge[from_b++];
  loop.half_edge[loop.count++] = m.opposite[h];
  return loop.count >= 3;
}

// Marks or unmarks the edges of the loop in the faces at both sides.
void mark_loop(const Mesh& m, const ShortLoop& loop, ShortLoopSearch& s, bool marked) {
  for (u32 i = 0; i < loop.count; ++i) {
    const u32 h = loop.half_edge[i], g = m.opposite[h];
    s.face_mark[face_of(h)] = static_cast<u8>(marked ? s.face_mark[face_of(h)] | edge_bit(h) : 0);
    s.face_mark[face_of(g)] = static_cast<u8>(marked ? s.face_mark[face_of(g)] | edge_bit(g) : 0);
  }
}

// Is there a way over the faces from the left side of the loop to its right side? Both sides grow in turn, until they
// meet, or one of them is found whole.
bool joins_both_sides(const Mesh& m, const ShortLoop& loop, ShortLoopSearch& s) {
  constexpr u8 side_bit[2] = {8, 16};  // of faces found
  u32 open[2] = {};                    // faces found, and not yet left
  bool joined = false;
  const auto reach = [&](u32 f, u32 side) {
    if (s.face_mark[f] >= side_bit[0]) {
      joined = joined || (s.face_mark[f] & side_bit[side]) == 0;
    } else if (s.faces.size < most_faces_beside) {
      s.face_mark[f] = static_cast<u8>(s.face_mark[f] | side_bit[side]);
      s.faces.push(f);
      ++open[side];
    }
  };
  s.faces.clear();
  mark_loop(m, loop, s, true);
  reach(face_of(loop.half_edge[0]), 0);
  reach(face_of(m.opposite[loop.half_edge[0]]), 1);
  for (u32 i = 0; !joined && open[0] > 0 && open[1] > 0; ++i) {
    const u32 f = s.faces[i], side = (s.face_mark[f] & side_bit[0]) != 0 ? 0 : 1;
    --open[side];
    for (u32 h = 3 * f; h < 3 * f + 3; ++h)
      if ((s.face_mark[f] & edge_bit(h)) == 0) reach(face_of(m.opposite[h]), side);
  }
  mark_loop(m, loop, s, false);
  for (u32 f : s.faces) s.face_mark[f] = 0;
  spend(s.meter, s.faces.size / 2);
  return joined;
}

// The half-edge between two vertices of the loop that are not next to each other, from number `from` to number `to`.
struct Chord {
  u32 from = none, to = none, half_edge = none;
};

Chord find_chord(const Mesh& m, const ShortLoop& loop) {
  for (u32 i = 0; i + 2 < loop.count; ++i)
    for (u32 j = i + 2; j < loop.count; ++j) {
      if (i == 0 && j + 1 == loop.count) continue;
      const u32 h = find_edge(m, tail(m, loop.half_edge[i]), tail(m, loop.half_edge[j]));
      if (h != none) return {i, j, h};
    }
  return {};
}

// A cap may need the chord once more, so the loop becomes one of its halves beside the chord: one at least leaves the
// surface in one piece, too.
bool drop_chords(const Mesh& m, ShortLoopSearch& s, ShortLoop& loop) {
  for (Chord c = find_chord(m, loop); c.half_edge != none; c = find_chord(m, loop)) {
    ShortLoop near, rest;
    for (u32 i = 0; i < loop.count; ++i) {
      ShortLoop& half = i >= c.from && i < c.to ? near : rest;
      if (i == c.to) rest.half_edge[rest.count++] = c.half_edge;
      half.half_edge[half.count++] = loop.half_edge[i];
    }
    near.half_edge[near.count++] = m.opposite[c.half_edge];
    spend(s.meter, loop.count);
    if (joins_both_sides(m, near, s))
      loop = near;
    else if (joins_both_sides(m, rest, s))
      loop = rest;
    else
      return false;
  }
  return true;
}

// Edges that are not set, with the lengths of their loops, in the heap.
void collect_closing_edges(const Mesh& m, f64 longest, ShortLoopSearch& s) {
  s.heap.clear();
  for (u32 v : s.vertices)
    for_each_outgoing(m, v, [&](u32 h) {
      const u32 u = head(m, h);
      if (v > u || s.near[u] == 0 || s.towards[u] == h || s.towards[v] == m.opposite[h]) return;
      const u32 f = face_of(h), g = face_of(m.opposite[h]);
      if ((s.face_mark[f] & edge_bit(h)) != 0 || (s.face_mark[g] & edge_bit(m.opposite[h])) != 0) return;
      const f64 way = s.way[v] + s.way[u] + length_of(m, h);
      if (way <= longest) push_entry(s.heap, {way, h, 0});
    });
}

// The middle of the loop lies outside if it lies before the faces at the loop.
f64 thickness_of(const Mesh& m, const ShortLoop& loop, const LoopLengths& longest) {
  Vec3 middle;
  f64 way = 0, before = 0, area = 0;
  for (u32 i = 0; i < loop.count; ++i) {
    middle = middle + (1.0 / loop.count) * m.position[tail(m, loop.half_edge[i])];
    way += length_of(m, loop.half_edge[i]);
  }
  for (u32 i = 0; i < loop.count; ++i) {
    const u32 h = loop.half_edge[i];
    const Vec3 normal = face_normal(m, face_of(h)) + face_normal(m, face_of(m.opposite[h]));
    before += dot(normal, middle - m.position[tail(m, h)]);
    area += 0.5 * length(area_normal(middle, m.position[tail(m, h)], m.position[head(m, h)]));
  }
  constexpr f64 four_pi = 12.566;
  if (!(before > 0)) return way <= longest.handle ? way / longest.handle : no_way;
  return max_of(way / longest.flat_tunnel, square_root(four_pi * area) / longest.tunnel);
}

// A loop with new vertices belongs to the lowest of them.
bool belongs_to(const Mesh& m, const ShortLoop& loop, u32 v) {
  u32 lowest = none;
  for (u32 i = 0; i < loop.count; ++i) {
    const u32 u = tail(m, loop.half_edge[i]);
    if (!is_old(m, u)) lowest = min_of(lowest, u);
  }
  return lowest == v || lowest == none;
}

}  // namespace

bool find_short_loop(const Mesh& m, u32 v, const LoopLengths& longest, u32 skipped, ShortLoopSearch& s,
                     ShortLoop& loop) {
  const f64 most = max_of(longest.flat_tunnel, longest.handle);
  grow_tree(m, v, 0.5 * most, s);
  collect_near_faces(m, s);
  spend(s.meter, s.faces.size);
  set_edges_of_discs(m, s);
  collect_closing_edges(m, most, s);
  for (u32 f : s.faces) s.face_mark[f] = 0;
  const auto is_wanted = [&] {
    loop.thickness = belongs_to(m, loop, v) ? thickness_of(m, loop, longest) : no_way;
    return loop.thickness <= 1;
  };
  u32 found = 0;
  for (u32 tried = 0; found <= skipped && tried < most_loops_tried && s.heap.size > 0 && !has_stopped(s.meter);) {
    spend(s.meter, 2);
    if (!collect_loop(m, s, pop_least(s.heap).number, loop) || !is_wanted()) continue;
    ++tried;
    found += joins_both_sides(m, loop, s) && drop_chords(m, s, loop) && is_wanted() ? 1u : 0u;
  }
  for (u32 u : s.vertices) s.near[u] = 0;
  return found > skipped;
}

}  // namespace tpa
