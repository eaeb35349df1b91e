// SPDX-License-Identifier: MIT
#include "detect/detect_by_vertices.h"

#include <string.h>

#include "base/disjoint_sets.h"
#include "base/simd.h"
#include "detect/face_pair.h"
#include "detect/near_faces.h"

namespace tpa {

namespace {

// ---------------------------------------------------------------- equation (1)

// Primes of Teschner et al. (2003), who combine the products by xor; the paper adds them.
constexpr i64 hash_primes[3] = {73856093, 19349663, 83492791};

constexpr i64 positive_remainder(i64 x, i64 m) {
  const i64 r = x % m;
  return r < 0 ? r + m : r;
}
// hash = (x p1 + y p2 + z p3) mod m, with m slots, for the cell x = floor(v_x / l), y = floor(v_y / l), z = floor(v_z /
// l).
constexpr u32 hash_cell(i64 x, i64 y, i64 z, u32 slots) {
  // Cells beyond 2^31 are reduced first, so that no product overflows. The result is the same.
  constexpr i64 far = i64{1} << 31;
  const i64 m = slots;
  if (x <= -far || x >= far || y <= -far || y >= far || z <= -far || z >= far) {
    x %= m;
    y %= m;
    z %= m;
  }
  return static_cast<u32>(positive_remainder(x * hash_primes[0] + y * hash_primes[1] + z * hash_primes[2], m));
}

// ---------------------------------------------------------------- first pass: a slot for each vertex

// An integer less than 1 from x; x itself if x is an integer. Pre: |x| < 2^51.
D2 near_integer(const D2& x) {
  constexpr f64 ones = 0x1.8p52;  // doubles of this size have no fractions
  return (x + ones) - ones;
}

// hash_cell() for the cells of points, two points at a time, with products in place of divisions.
struct Hasher {
  f64 cell;
  u32 slots;

  // True if all quotients by the cell are below 2^30, so that their rounding is below 2^-22.
  bool slots_of(const Vec3* p, u32 count, u32* slot_of) const {
    const D2 inverse_cell = all2(1 / cell), inverse_slots = all2(1 / static_cast<f64>(slots));
    bool near_origin = true;
    u32 i = 0;
    for (; count - i >= 2; i += 2)
      if (!slots_of_two(p + i, inverse_cell, inverse_slots, slot_of + i))
        slot_of[i] = slot(p[i], near_origin), slot_of[i + 1] = slot(p[i + 1], near_origin);
    if (i < count) slot_of[i] = slot(p[i], near_origin);
    return near_origin;
  }

 private:
  u32 slot(const Vec3& p, bool& near_origin) const {
    const Vec3 q = {p.x / cell, p.y / cell, p.z / cell};
    near_origin = near_origin && squared_length(q) < 0x1p60;
    return hash_cell(floor_to_integer(q.x), floor_to_integer(q.y), floor_to_integer(q.z), slots);
  }

  // floor(x / cell), given t, the rounded product of x and 1 / cell. For |t| < 2^24, t differs from the rounded
  // quotient by less than 2^-26, and t - 1/2 is off by 2^-30 more. Only next to an integer could the floor differ;
  // there, and for larger t, `safe` is cleared.
  static D2 floor_of(const D2& t, I2& safe) {
    const D2 middle = t - all2(.5), low = near_integer(middle), off = middle - low;
    safe &= (off * off < all2(.25 - 0x1p-24)) & (t * t < all2(0x1p48));
    return low;
  }

  // All numbers but the quotient by the slots are integers of at most 53 bits, so exact; the integer near the quotient
  // is off by one at most. False if a floor is not safe.
  bool slots_of_two(const Vec3* p, const D2& inverse_cell, const D2& inverse_slots, u32* slot_of) const {
    constexpr f64 px = hash_primes[0], py = hash_primes[1], pz = hash_primes[2];
    I2 safe = {-1, -1};
    const D2 xy = floor_of(load2(&p[0].x) * inverse_cell, safe) * D2{px, py};
    const D2 zx = floor_of(D2{p[0].z, p[1].x} * inverse_cell, safe) * D2{pz, px};
    const D2 yz = floor_of(load2(&p[1].y) * inverse_cell, safe) * D2{py, pz};
    const D2 sum = shuffled<0, 3>(xy, zx) + shuffled<1, 2>(xy, yz) + shuffled<0, 3>(zx, yz);
    if ((safe[0] & safe[1]) == 0) return false;
    const D2 m = all2(slots);
    D2 rest = sum - near_integer(sum * inverse_slots) * m;
    rest = rest + chosen(rest < all2(0), m, all2(0));
    slot_of[0] = static_cast<u32>(static_cast<i32>(rest[0]));
    slot_of[1] = static_cast<u32>(static_cast<i32>(rest[1]));
    return true;
  }
};

// ---------------------------------------------------------------- cells

// Do two vertices of one slot lie in one cell? Cells that share a slot by chance must not count as one, or contacts
// would depend on the number of slots.
struct SameCell {
  const Mesh& m;
  f64 cell;
  bool by_distance;  // cells beside each other, and the next ones, have slots of their own
  f64 width;         // a little more than a cell

  bool operator()(u32 v, u32 w) const {
    const Vec3 &p = m.position[v], &q = m.position[w], d = p - q;
    if ((d.x > width) | (-d.x > width) | (d.y > width) | (-d.y > width) | (d.z > width) | (-d.z > width)) return false;
    return by_distance || (in_one_layer(p.x, q.x) && in_one_layer(p.y, q.y) && in_one_layer(p.z, q.z));
  }

 private:
  // floor(x / cell) == floor(y / cell), for quotients of any size.
  bool in_one_layer(f64 x, f64 y) const {
    constexpr f64 all_integers = 0x1p52;
    const f64 a = x / cell, b = y / cell;
    if (abs_of(a) >= all_integers || abs_of(b) >= all_integers) return a == b;
    return floor_to_integer(a) == floor_to_integer(b);
  }
};

// True if no two cells at most `reach` apart along each axis share a slot.
bool near_cells_have_slots_of_their_own(u32 slots, i64 reach) {
  // One half of the offsets; the other half mirrors them.
  for (i64 x = 0; x <= reach; ++x)
    for (i64 y = x == 0 ? 0 : -reach; y <= reach; ++y)
      for (i64 z = x == 0 && y == 0 ? 1 : -reach; z <= reach; ++z)
        if (hash_cell(x, y, z, slots) == 0) return false;
  return true;
}

// Cells of points at most `far` apart along each axis differ by this at most; none beyond a few cells.
i64 cells_apart(f64 far, f64 cell) {
  constexpr f64 most = 4;
  const f64 cells = far / cell + 0x1p-20;  // more than the rounding of a quotient
  return cells < most ? static_cast<i64>(cells) + 1 : 0;
}

// ---------------------------------------------------------------- lists of slots

// The second pass matters only for slots with strangers: vertices of one cell in different components. Most slots have
// no strangers, as one pass over the faces shows. A first vertex is a vertex without a neighbour of lower number in its
// cell. Each component has a first vertex, so a cell with only one first vertex has one component. Lists of all
// vertices are made only for slots with two first vertices in one cell.

// The end of a list: more than any vertex, with equal bytes for memset.
constexpr u32 end_of_list = 0x7F7F7F7Fu;
// Set in the head of a slot that may have strangers.
constexpr u32 strangers = 0x80000000u;

// Sets lower[v] if a neighbour of v with a lower number lies in the same cell. same_cell(v, w) is asked for neighbours
// with one slot.
template <class Same>
void find_lower_neighbours(const Mesh& m, const u32* slot, u8* lower, Same same_cell) {
  memset(lower, 0, m.vertex_count);
  const bool holes = m.free_face != none;
  const auto see = [&](u32 a, u32 b, u32 slot_a, u32 slot_b) {
    lower[max_of(a, b)] |= static_cast<u8>(slot_a == slot_b && same_cell(a, b));
  };
  for (const u32 *c = m.corner, *end = c + 3 * u64{m.face_count}; c != end; c += 3) {
    if (holes && c[0] == none) continue;
    const u32 i = slot[c[0]], j = slot[c[1]], k = slot[c[2]];
    see(c[0], c[1], i, j);
    see(c[1], c[2], j, k);
    see(c[2], c[0], k, i);
  }
}

// Lists the first vertices of each slot, and marks slots with two of them in one cell. Returns the number of slots in
// h.marked.
u32 list_first_vertices(const VertexHash& h, const SameCell& same_cell, const u32* vertices, u32 count) {
  constexpr u32 ahead = 16;  // vertices; memory has time to answer
  u32 marked = 0;
  for (u32 i = 0; i < count; ++i) {
    if (count - i > ahead) fetch(h.head + h.slot[vertices[i + ahead]]);
    const u32 v = vertices[i], s = h.slot[v], old = h.head[s], first = old & ~strangers;
    h.link[v] = first;
    u32 mark = old & strangers;
    u32 looked = 0;
    if (mark == 0)
      for (u32 w = first; w != end_of_list && mark == 0; w = h.link[w], ++looked)
        if (same_cell(v, w)) {
          mark = strangers;
          h.marked[marked++] = s;
        }
    if (looked > 1) spend(h.meter, looked / 2);
    h.head[s] = v | mark;
  }
  return marked;
}

// Adds the other vertices to the lists of marked slots.
void complete_marked_lists(const VertexHash& h, const u32* vertices, u32 count) {
  for (u32 i = 0; i < count; ++i) {
    const u32 v = vertices[i], s = h.slot[v], old = h.head[s];
    if ((old & strangers) == 0) continue;
    h.link[v] = old & ~strangers;
    h.head[s] = v | strangers;
  }
}

// Lists all vertices of the slots that may have strangers. Returns the number of slots in h.marked.
u32 list_slots_with_strangers(const Mesh& m, const VertexHash& h, const SameCell& same_cell) {
  const i64 apart = cells_apart(h.longest_edge, h.cell);
  if (same_cell.by_distance && apart > 0 && (apart <= 2 || near_cells_have_slots_of_their_own(h.slots, apart)))
    find_lower_neighbours(m, h.slot, h.lower, [](u32, u32) { return true; });
  else
    find_lower_neighbours(m, h.slot, h.lower, same_cell);
  // First vertices from the front, the others from the back.
  const bool holes = m.free_vertex != none;
  u32 first = 0, other = m.vertex_count;
  for (u32 v = 0; v < m.vertex_count; ++v) {
    if (holes && !vertex_lives(m, v)) continue;
    h.order[first] = h.order[other - 1] = v;
    const u32 is_other = h.lower[v];
    other -= is_other;
    first += 1 - is_other;
  }
  memset(h.head, end_of_list & 0xFF, static_cast<size_t>(h.slots) * sizeof *h.head);
  const u32 marked = list_first_vertices(h, same_cell, h.order, first);
  if (marked > 0) complete_marked_lists(h, h.order + other, m.vertex_count - other);
  return marked;
}

// ---------------------------------------------------------------- second pass: components of a slot

// Triangles adjacent to a vertex lie within an edge's length of the vertex; two vertices farther apart than two edges
// have no triangles that meet.
struct Nearness {
  const Mesh& m;
  f64 limit;  // of squared distances
  bool operator()(u32 v, u32 w) const { return !(squared_length(m.position[v] - m.position[w]) > limit); }
};
Nearness nearness(const Mesh& m, f64 edge) { return {m, 4 * edge * edge * (1 + 0x1p-40)}; }

// Gathers the vertices of one slot to components: vertices of one cell, connected by edges.
void gather_components(const Mesh& m, const VertexHash& h, const SameCell& same_cell, u32 first, u32* parent) {
  for (u32 v = first; v != end_of_list; v = h.link[v]) parent[v] = v;
  for (u32 v = first; v != end_of_list; v = h.link[v])
    for_each_neighbour(m, v, [&](u32 w) {
      if (w < v && h.slot[w] == h.slot[v] && same_cell(v, w)) join_sets(parent, v, w);
    });
}

// Collects pairs of faces without repetition, since several pairs of vertices may lead to one pair of faces.
struct DistinctPairs {
  Stack<Contact>& pairs;
  u32 sorted = 0;    // pairs[0 .. sorted - 1] are sorted and distinct
  u64 left_out = 0;  // pairs without room, some perhaps counted more than once

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
    const u32 at = count_before(pairs.data, pairs.size, [&](const Contact& known) { return known < c; });
    if (at == pairs.size || c < pairs[at]) ++left_out;
  }
};

Box star_box(const Mesh& m, u32 v) {
  Box box = face_box(m, face_of(m.vertex_edge[v]));
  for_each_outgoing(m, v, [&](u32 h) { box = united(box, face_box(m, face_of(h))); });
  return box;
}

// Intersects each two triangles adjacent to v and to w.
void intersect_stars(const Mesh& m, u32 v, u32 w, Meter* meter, DistinctPairs& found) {
  const Box around = star_box(m, w);
  for_each_outgoing(m, v, [&](u32 hv) {
    spend(meter, 1);
    const u32 f = face_of(hv);
    const Box box = face_box(m, f);
    if (has_stopped(meter) || !boxes_meet(box, around)) return;
    for_each_outgoing(m, w, [&](u32 hw) {
      spend(meter, 1);
      const u32 g = face_of(hw);
      if (f == g || !boxes_meet(box, face_box(m, g))) return;
      spend(meter, of_exact_test);
      if (faces_meet(m, f, g)) found.add(f, g);
    });
  });
}

}  // namespace

f64 longest_edge(const Mesh& m) {
  f64 longest = 0;
  for (u32 f = 0; f < m.face_count; ++f) {
    if (!face_lives(m, f)) continue;
    const Vec3 &a = corner_position(m, 3 * f), &b = corner_position(m, 3 * f + 1), &c = corner_position(m, 3 * f + 2);
    longest = max_of(longest, max_of(squared_length(b - a), max_of(squared_length(c - b), squared_length(a - c))));
  }
  return square_root(longest) * (1 + 0x1p-40);
}

void detect_by_vertices(const Mesh& m, const VertexHash& h, Detection& out) {
  out.pairs.clear();
  DistinctPairs found{out.pairs};
  spend(h.meter, m.vertex_count);
  // First pass: a slot for each vertex, by equation (1).
  const bool near_origin = Hasher{h.cell, h.slots}.slots_of(m.position, m.vertex_count, h.slot);
  // Points within `width` lie in cells at most two apart.
  const SameCell same_cell{m, h.cell, near_origin && near_cells_have_slots_of_their_own(h.slots, 2),
                           near_origin ? h.cell * (1 + 0x1p-20) : no_way};
  const u32 marked = list_slots_with_strangers(m, h, same_cell);
  // Second pass: for each slot, intersect triangles adjacent to vertices of different components.
  u32* const parent = h.order;
  const Nearness near = nearness(m, h.longest_edge);
  for (u32 i = 0; i < marked; ++i) {
    const u32 first = h.head[h.marked[i]] & ~strangers;
    gather_components(m, h, same_cell, first, parent);
    for (u32 v = first; v != end_of_list && !has_stopped(h.meter); v = h.link[v]) {
      spend(h.meter, 4);
      for (u32 w = h.link[v]; w != end_of_list; w = h.link[w]) {
        spend(h.meter, 1);
        if (near(v, w) && same_cell(v, w) && find_set(parent, v) != find_set(parent, w))
          intersect_stars(m, v, w, h.meter, found);
      }
    }
  }
  found.tidy();
  out.found = out.pairs.size + found.left_out;
}

}  // namespace tpa
