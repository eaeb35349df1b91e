#include "vertex_hash.h"

#include <string.h>

#include "order.h"

namespace tpa {

namespace {

// ---------------------------------------------------------------- equation (1)

// hash_cell() of the cell of a point, without divisions where they can be had for less.
struct Hasher {
  f64 cell, inverse_cell, inverse_slots;
  i64 slots;

  // floor(x / cell), where t is the product with the inverse, below 2^24, and so off by less than 2^-26: only next to
  // an integer does that matter.
  i64 index(f64 x, f64 t) const {
    const i32 cut = static_cast<i32>(t);
    const i32 low = cut - (t < static_cast<f64>(cut) ? 1 : 0);
    const f64 rest = t - static_cast<f64>(low);
    return ((rest > 0x1p-25) & (rest < 1 - 0x1p-25)) ? low : floor_to_integer(x / cell);
  }
  u32 far_slot(const Vec3& p) const {
    return hash_cell(floor_to_integer(p.x / cell), floor_to_integer(p.y / cell), floor_to_integer(p.z / cell),
                     static_cast<u32>(slots));
  }
  u32 slot(const Vec3& p) const {
    const Vec3 t = inverse_cell * p;
    constexpr f64 far = 0x1p24;
    if (!(max_of(abs_of(t.x), max_of(abs_of(t.y), abs_of(t.z))) < far)) return far_slot(p);
    // At most 53 bits: the quotient by the slots, rounded, is off by one at most.
    const i64 sum = index(p.x, t.x) * hash_primes[0] + index(p.y, t.y) * hash_primes[1] + index(p.z, t.z) * hash_primes[2];
    i64 rest = sum - static_cast<i64>(static_cast<f64>(sum) * inverse_slots) * slots;
    rest += rest < 0 ? slots : 0;
    return static_cast<u32>(rest >= slots ? rest - slots : rest < 0 ? rest + slots : rest);
  }
};

// Marks the head of a list in which two vertices are so near that their triangles may meet. Vertices are fewer than
// 2^31.
constexpr u32 near_ones = 0x80000000u;

// Triangles adjacent to a vertex lie within an edge's length of it.
struct Nearness {
  const Mesh& m;
  f64 limit;  // of squared distances
  bool operator()(u32 v, u32 w) const { return !(squared_length(m.position[v] - m.position[w]) > limit); }
};
Nearness nearness(const Mesh& m, f64 edge) { return {m, 4 * edge * edge * (1 + 0x1p-40)}; }

void enter(const VertexHash& h, const Nearness& near, u32 slot, u32 v) {
  const u32 old = h.head[slot];
  u32 mark = 0;
  h.link[v] = none;
  if (old != none) {
    mark = old & near_ones;
    h.link[v] = old & ~near_ones;
    for (u32 w = h.link[v]; mark == 0 && w != none; w = h.link[w])
      if (near(v, w)) mark = near_ones;
  }
  h.head[slot] = v | mark;
}

// Slots are computed some time before they are used, and so are the vertices in them, so that memory has time to
// answer.
void enter_vertices(const Mesh& m, const VertexHash& h) {
  constexpr u32 block = 32;
  const Hasher hasher{h.cell, 1 / h.cell, 1 / static_cast<f64>(h.slots), h.slots};
  const Nearness near = nearness(m, h.longest_edge);
  memset(h.head, 0xFF, static_cast<size_t>(h.slots) * sizeof *h.head);
  u32 slot[3][block];
  const u32 blocks = (m.vertex_count + block - 1) / block;
  const auto for_block = [&](u32 b, auto work) {
    if (b >= blocks) return;
    for (u32 i = 0; i < min_of(block, m.vertex_count - b * block); ++i) work(slot[b % 3][i], b * block + i);
  };
  for (u32 b = 0; b < blocks + 2; ++b) {
    for_block(b, [&](u32& s, u32 v) {
      s = hasher.slot(m.position[v]);
      __builtin_prefetch(h.head + s, 1);
    });
    for_block(b - 1, [&](u32 s, u32) {
      const u32 old = h.head[s], w = old == none ? 0 : old & ~near_ones;
      __builtin_prefetch(m.position + w);
      __builtin_prefetch(h.link + w);
    });
    for_block(b - 2, [&](u32 s, u32 v) { enter(h, near, s, v); });
  }
}

// ---------------------------------------------------------------- components of a slot

u32 find_root(const u32* root, u32 v) {
  while (root[v] != v) v = root[v];
  return v;
}

bool connected(const Mesh& m, u32 v, u32 w) {
  const u32 first = m.vertex_edge[v];
  u32 h = first;
  do {
    if (head(m, h) == w) return true;
    h = rotate(m, h);
  } while (h != first);
  return false;
}

// Joins the vertices of one slot that mesh edges connect. True if all are joined.
bool gather_components(const Mesh& m, const VertexHash& h, const Nearness& near, u32 first) {
  for (u32 v = first; v != none; v = h.link[v]) h.root[v] = v;
  bool one = true;
  for (u32 v = first; v != none; v = h.link[v])
    for (u32 w = h.link[v]; w != none; w = h.link[w]) {
      const u32 a = find_root(h.root, v), b = find_root(h.root, w);
      if (a == b) continue;
      if (near(v, w) && connected(m, v, w))
        h.root[max_of(a, b)] = min_of(a, b);
      else
        one = false;
    }
  return one;
}

// A pair is found once for each pair of vertices that leads to it: collects them without repetition.
struct DistinctPairs {
  Stack<Contact>& pairs;
  u32 sorted = 0;     // pairs[0 .. sorted - 1] are sorted and distinct
  u64 left_out = 0;   // found when there was no room, perhaps more than once

  void tidy() {
    sort_in_place(pairs.data, pairs.size);
    sorted = 0;
    for (const Contact& c : pairs)
      if (sorted == 0 || pairs[sorted - 1] < c) pairs[sorted++] = c;
    pairs.size = sorted;
  }
  void add(u32 f, u32 g) {
    const Contact c{min_of(f, g), max_of(f, g)};
    if (pairs.size == pairs.capacity && sorted < pairs.size) tidy();
    if (pairs.push(c)) return;
    const u32 at = lower_bound(pairs.data, pairs.size, c);
    if (at == pairs.size || c < pairs[at]) ++left_out;
  }
};

Box star_box(const Mesh& m, u32 v) {
  Box box = face_box(m, face_of(m.vertex_edge[v]));
  for_each_outgoing(m, v, [&](u32 h) {
    const Box other = face_box(m, face_of(h));
    for (int i = 0; i < 3; ++i) {
      box.low[i] = min_of(box.low[i], other.low[i]);
      box.high[i] = max_of(box.high[i], other.high[i]);
    }
  });
  return box;
}

void test_stars(const Mesh& m, u32 v, u32 w, DistinctPairs& found) {
  const Box around = star_box(m, w);
  for_each_outgoing(m, v, [&](u32 hv) {
    const u32 f = face_of(hv);
    const Box box = face_box(m, f);
    if (!boxes_meet(box, around)) return;
    for_each_outgoing(m, w, [&](u32 hw) {
      const u32 g = face_of(hw);
      if (f != g && boxes_meet(box, face_box(m, g)) && faces_meet(m, f, g)) found.add(f, g);
    });
  });
}

}  // namespace

f64 longest_edge(const Mesh& m) {
  f64 longest = 0;
  for (u32 f = 0; f < m.face_count; ++f) {
    const Vec3 &a = corner_position(m, 3 * f), &b = corner_position(m, 3 * f + 1), &c = corner_position(m, 3 * f + 2);
    longest = max_of(longest, max_of(squared_length(b - a), max_of(squared_length(c - b), squared_length(a - c))));
  }
  return square_root(longest) * (1 + 0x1p-40);
}

void detect_by_vertices(const Mesh& m, const VertexHash& h, Detection& out) {
  out.pairs.clear();
  DistinctPairs found{out.pairs};
  const Nearness near = nearness(m, h.longest_edge);
  enter_vertices(m, h);
  for (u32 s = 0; s < h.slots; ++s) {
    if (h.head[s] == none || (h.head[s] & near_ones) == 0) continue;
    const u32 first = h.head[s] & ~near_ones;
    if (gather_components(m, h, near, first)) continue;
    for (u32 v = first; v != none; v = h.link[v])
      for (u32 w = h.link[v]; w != none; w = h.link[w])
        if (find_root(h.root, v) != find_root(h.root, w) && near(v, w)) test_stars(m, v, w, found);
  }
  found.tidy();
  out.found = out.pairs.size + found.left_out;
}

}  // namespace tpa
