#include "vertex_hash.h"

#include <string.h>

#include "lanes.h"
#include "order.h"

namespace tpa {

namespace {

// ---------------------------------------------------------------- equation (1)

using I2 = i64 __attribute__((vector_size(16)));

// x for integers x of less than 2^51, else the next one above or below.
D2 next_integer(D2 x) {
  constexpr f64 ones = 0x1.8p52;  // doubles of this size have no fractions
  return (x + ones) - ones;
}

// hash_cell() of the cells of points, without divisions where they can be had for less.
struct Hasher {
  f64 cell;
  u32 slots;

  u32 slot(const Vec3& p) const {
    return hash_cell(floor_to_integer(p.x / cell), floor_to_integer(p.y / cell), floor_to_integer(p.z / cell), slots);
  }

  void slots_of(const Vec3* p, u32 count, u32* slot_of) const {
    const D2 inverse_cell = all2(1 / cell), inverse_slots = all2(1 / static_cast<f64>(slots));
    u32 i = 0;
    for (; count - i >= 2; i += 2) {
      if (slots_of_two(p + i, inverse_cell, inverse_slots, slot_of + i)) continue;
      slot_of[i] = slot(p[i]), slot_of[i + 1] = slot(p[i + 1]);
    }
    if (i < count) slot_of[i] = slot(p[i]);
  }

 private:
  // floor(x / cell) for t, the product of x with the inverse: below 2^24 it is off by less than 2^-26 from the rounded
  // quotient, and half of one less by 2^-30 more. Only next to an integer does that matter; there, and beyond 2^24,
  // `safe` is cleared.
  static D2 floor_of(D2 t, I2& safe) {
    const D2 middle = t - all2(.5), low = next_integer(middle), off = middle - low;
    safe &= (off * off < all2(.25 - 0x1p-24)) & (t * t < all2(0x1p48));
    return low;
  }

  // All numbers are integers of at most 53 bits, so nothing is rounded but the quotient by the slots, which is off by one
  // at most. False where a floor is not safe.
  bool slots_of_two(const Vec3* p, D2 inverse_cell, D2 inverse_slots, u32* slot_of) const {
    constexpr f64 px = hash_primes[0], py = hash_primes[1], pz = hash_primes[2];
    I2 safe = {-1, -1};
    const D2 xy = floor_of(load2(&p[0].x) * inverse_cell, safe) * D2{px, py};
    const D2 zx = floor_of(D2{p[0].z, p[1].x} * inverse_cell, safe) * D2{pz, px};
    const D2 yz = floor_of(load2(&p[1].y) * inverse_cell, safe) * D2{py, pz};
    const D2 sum = __builtin_shufflevector(xy, zx, 0, 3) + __builtin_shufflevector(xy, yz, 1, 2) +
                   __builtin_shufflevector(zx, yz, 0, 3);
    if ((safe[0] & safe[1]) == 0) return false;
    const D2 m = all2(slots);
    D2 rest = sum - next_integer(sum * inverse_slots) * m;
    rest = rest + (rest < all2(0) ? m : all2(0));
    slot_of[0] = static_cast<u32>(static_cast<i32>(rest[0]));
    slot_of[1] = static_cast<u32>(static_cast<i32>(rest[1]));
    return true;
  }
};

// Ends a list. All of its bytes are the same, and vertices are fewer.
constexpr u32 end_of_list = 0x7F7F7F7Fu;
// Marks the head of a list in which two vertices are so near that their triangles may meet, and no edge joins them.
constexpr u32 strangers = 0x80000000u;

// Triangles adjacent to a vertex lie within an edge's length of it.
struct Nearness {
  const Mesh& m;
  f64 limit;  // of squared distances
  bool operator()(u32 v, u32 w) const { return !(squared_length(m.position[v] - m.position[w]) > limit); }
};
Nearness nearness(const Mesh& m, f64 edge) { return {m, 4 * edge * edge * (1 + 0x1p-40)}; }

bool connected(const Mesh& m, u32 v, u32 w) {
  const u32 first = m.vertex_edge[v];
  u32 h = first;
  do {
    if (head(m, h) == w) return true;
    h = rotate(m, h);
  } while (h != first);
  return false;
}

// The neighbours of v are asked now, while what lies round it is at hand.
void enter(u32* head, u32* link, const Nearness& near, u32 slot, u32 v) {
  const u32 old = head[slot], first = old & ~strangers;
  u32 mark = old & strangers;
  link[v] = first;
  if (mark == 0)
    for (u32 w = first; w != end_of_list && mark == 0; w = link[w])
      if (near(v, w) && !connected(near.m, v, w)) mark = strangers;
  head[slot] = v | mark;
}

// Slots are computed some time before they are used, and so are the vertices in them, so that memory has time to
// answer.
void enter_vertices(const Mesh& m, const VertexHash& h) {
  constexpr u32 block = 32;
  const Hasher hasher{h.cell, h.slots};
  const Nearness near = nearness(m, h.longest_edge);
  u32 *const head = h.head, *const link = h.link;
  memset(head, end_of_list & 0xFF, static_cast<size_t>(h.slots) * sizeof *head);
  u32 slot[3][block];
  const u32 blocks = (m.vertex_count + block - 1) / block;
  const auto size_of = [&](u32 b) { return b < blocks ? min_of(block, m.vertex_count - b * block) : 0; };
  for (u32 b = 0; b < blocks + 2; ++b) {
    // Of blocks -1 and -2, which are empty, nothing is looked at.
    u32 *const hashed = slot[b % 3], *const looked_up = slot[(b + 2) % 3], *const entered = slot[(b + 1) % 3];
    const u32 to_hash = size_of(b), to_look_up = size_of(b - 1), to_enter = size_of(b - 2);
    hasher.slots_of(m.position + u64{block} * b, to_hash, hashed);
    for (u32 i = 0; i < to_hash; ++i) __builtin_prefetch(head + hashed[i], 1);
    for (u32 i = 0; i < to_look_up; ++i) {
      const u32 w = head[looked_up[i]] & ~strangers, known = w == end_of_list ? 0 : w;
      __builtin_prefetch(m.position + known);
      __builtin_prefetch(link + known);
    }
    for (u32 i = 0; i < to_enter; ++i) enter(head, link, near, entered[i], (b - 2) * block + i);
  }
}

// ---------------------------------------------------------------- components of a slot

u32 find_root(const u32* root, u32 v) {
  while (root[v] != v) v = root[v];
  return v;
}

// Joins the vertices of one slot that mesh edges connect. True if all are joined.
bool gather_components(const Mesh& m, const VertexHash& h, const Nearness& near, u32 first) {
  for (u32 v = first; v != end_of_list; v = h.link[v]) h.root[v] = v;
  bool one = true;
  for (u32 v = first; v != end_of_list; v = h.link[v])
    for (u32 w = h.link[v]; w != end_of_list; w = h.link[w]) {
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

// Calls visit(first vertex) for each slot with strangers in it.
template <class Visit>
void for_each_marked(const VertexHash& h, Visit visit) {
  constexpr u64 two = u64{strangers} << 32 | strangers;
  const auto visit_from = [&](u32 s, u32 count) {
    for (u32 i = 0; i < count; ++i)
      if ((h.head[s + i] & strangers) != 0) visit(h.head[s + i] & ~strangers);
  };
  u32 s = 0;
  for (; h.slots - s >= 4; s += 4) {
    u64 heads[2];
    memcpy(heads, h.head + s, sizeof heads);
    if (((heads[0] | heads[1]) & two) != 0) visit_from(s, 4);
  }
  visit_from(s, h.slots - s);
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
  for_each_marked(h, [&](u32 first) {
    if (gather_components(m, h, near, first)) return;
    for (u32 v = first; v != end_of_list; v = h.link[v])
      for (u32 w = h.link[v]; w != end_of_list; w = h.link[w])
        if (find_root(h.root, v) != find_root(h.root, w) && near(v, w)) test_stars(m, v, w, found);
  });
  found.tidy();
  out.found = out.pairs.size + found.left_out;
}

}  // namespace tpa
