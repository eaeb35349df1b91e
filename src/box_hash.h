// box_hash: the spatial hash of section 3, for the boxes of triangles. Each box is entered once, in the cell of its
// lowest corner, with cells that suit its size (levels), so that the memory is one link for each box and the slots
// whatever the mesh looks like; a query looks as far below as the largest box of the level reaches. Boxes enter and
// leave one by one.
#pragma once

#include "vec3.h"

namespace tpa {

// Equation (1): primes of Teschner et al. (2003). The paper adds what they combine by xor.
inline constexpr i64 hash_primes[3] = {73856093, 19349663, 83492791};

constexpr i64 positive_remainder(i64 x, i64 m) {
  const i64 r = x % m;
  return r < 0 ? r + m : r;
}
constexpr u32 hash_cell(i64 x, i64 y, i64 z, u32 slots) {
  // Cells beyond 2^31 are reduced first, so that no product overflows; the result is the same.
  constexpr i64 far = i64{1} << 31;
  const i64 m = slots;
  if (x <= -far || x >= far || y <= -far || y >= far || z <= -far || z >= far) {
    x %= m;
    y %= m;
    z %= m;
  }
  return static_cast<u32>(positive_remainder(x * hash_primes[0] + y * hash_primes[1] + z * hash_primes[2], m));
}

// Bounds rounded outward to single precision: half the memory, and never too small.
struct Box {
  f32 low[3], high[3];
};
Box box_of(const Vec3& a, const Vec3& b, const Vec3& c);
inline bool boxes_meet(const Box& a, const Box& b) {
  return (a.low[0] <= b.high[0]) & (b.low[0] <= a.high[0]) & (a.low[1] <= b.high[1]) & (b.low[1] <= a.high[1]) &
         (a.low[2] <= b.high[2]) & (b.low[2] <= a.high[2]);
}

// No box: what is not there.
inline constexpr Box empty_box = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
inline bool is_empty(const Box& b) { return b.low[0] > b.high[0]; }

inline f32 extent_of(const Box& b) {
  return max_of(b.high[0] - b.low[0], max_of(b.high[1] - b.low[1], b.high[2] - b.low[2]));
}

inline Box united(const Box& a, const Box& b) {
  return {{min_of(a.low[0], b.low[0]), min_of(a.low[1], b.low[1]), min_of(a.low[2], b.low[2])},
          {max_of(a.high[0], b.high[0]), max_of(a.high[1], b.high[1]), max_of(a.high[2], b.high[2])}};
}

// Sizes are grouped by factors of four; the lowest and highest levels take what lies beyond.
inline constexpr i32 hash_levels = 16;

struct HashLevel {
  u32 boxes = 0;         // entered at this level now
  f32 cell = 0;          // edge length of its cells, a power of two
  f32 largest[3] = {};   // largest box extents ever entered at this level since the last fill()
};

// All that a search reads of a box, in half a cache line.
struct HashEntry {
  u32 link;  // next in the list
  u32 key;   // low bits of its cell and its level; tells cells apart that share a slot
  Box box;
};

// What there is of a hash besides its arrays.
struct HashShape {
  u32 slots = 0;        // section 3: twice the number of vertices
  i32 base_exponent = 0;  // cells of level `hash_levels / 2` measure 2^base_exponent
  u8 entered_at[hash_levels] = {};  // small sizes that are rare share the level of larger ones: see fill()
  HashLevel levels[hash_levels];
  f32 low[3] = {}, high[3] = {};  // bounds of everything entered since the last fill()
};

struct BoxHash : HashShape {
  u32* head = nullptr;  // per slot: first entry of its list, or none
  HashEntry* entry = nullptr;
};

// Empties the table, chooses cells that suit the boxes of the entries 0 .. count - 1, and enters all but empty ones.
// O(slots + count).
void fill(BoxHash& h, u32 count);
// Entry i, whose box is in place.
void enter(BoxHash& h, u32 i);
void leave(BoxHash& h, u32 i);

namespace box_hash_detail {

// Cells whose indices differ by less than this in each axis have different keys.
inline constexpr i64 key_span = 512;
constexpr u32 key_of(i64 x, i64 y, i64 z, u32 level) {
  return level << 28 | (static_cast<u32>(static_cast<u64>(z)) & 0x3FFu) << 18 |
         (static_cast<u32>(static_cast<u64>(y)) & 0x1FFu) << 9 | (static_cast<u32>(static_cast<u64>(x)) & 0x1FFu);
}
static_assert(hash_levels <= 16, "a level fits four bits of the key");

constexpr u64 wrapped(u64 slot, u64 slots) { return slot >= slots ? slot - slots : slot; }

struct CellRange {
  i64 low[3], high[3];
  u64 cells;  // saturated
  bool wide;  // spans more cells than keys can tell apart
};
CellRange cells_of(const HashLevel& level, const Box& query, const f32* low, const f32* high);

// Is (x, y, z) the cell that entry i was entered in?
bool in_cell(const BoxHash& h, u32 i, i64 x, i64 y, i64 z);

}  // namespace box_hash_detail

// Asks hit(i) exactly once for each entered i whose box meets the query, until one answers true; returns that entry, or
// none. Expected O(entries asked + 1) for queries of about the size of the boxes; never more than
// O(slots + boxes) for each occupied level.
template <class Hit>
inline u32 find_near(const BoxHash& h, const Box& query, Hit hit) {
  using namespace box_hash_detail;
  const u64 step[3] = {hash_cell(1, 0, 0, h.slots), hash_cell(0, 1, 0, h.slots), hash_cell(0, 0, 1, h.slots)};
  for (u32 l = 0; l < hash_levels; ++l) {
    const HashLevel& level = h.levels[l];
    if (level.boxes == 0) continue;
    const CellRange r = cells_of(level, query, h.low, h.high);
    if (r.cells == 0) continue;
    if (r.cells >= h.slots) {
      for (u32 s = 0; s < h.slots; ++s)
        for (u32 i = h.head[s]; i != none; i = h.entry[i].link)
          if (h.entry[i].key >> 28 == l && boxes_meet(h.entry[i].box, query) && hit(i)) return i;
      continue;
    }
    // Equation (1) is linear: the slot of the next cell is one addition away.
    u64 slot_z = hash_cell(r.low[0], r.low[1], r.low[2], h.slots);
    for (i64 z = r.low[2]; z <= r.high[2]; ++z, slot_z = wrapped(slot_z + step[2], h.slots)) {
      u64 slot_y = slot_z;
      for (i64 y = r.low[1]; y <= r.high[1]; ++y, slot_y = wrapped(slot_y + step[1], h.slots)) {
        u64 slot = slot_y;
        for (i64 x = r.low[0]; x <= r.high[0]; ++x, slot = wrapped(slot + step[0], h.slots)) {
          const u32 key = key_of(x, y, z, l);
          for (u32 i = h.head[slot]; i != none; i = h.entry[i].link) {
            const HashEntry& e = h.entry[i];
            if (e.key == key && boxes_meet(e.box, query) && (!r.wide || in_cell(h, i, x, y, z)) && hit(i)) return i;
          }
        }
      }
    }
  }
  return none;
}

}  // namespace tpa
