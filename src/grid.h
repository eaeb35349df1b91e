// grid: the spatial hash of section 3, for triangles. Each face is entered once, in the cell of its box's lowest
// corner, with cells that suit its size (levels), so that the memory is one link for each face and 2 V slots whatever
// the mesh looks like; a query looks as far below as the largest box of the level reaches. Faces enter and leave one
// by one while the mesh is edited.
#pragma once

#include "mesh.h"

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
inline Box face_box(const Mesh& m, u32 f) {
  return box_of(corner_position(m, 3 * f), corner_position(m, 3 * f + 1), corner_position(m, 3 * f + 2));
}

// Sizes are grouped by factors of four; the lowest and highest levels take what lies beyond.
inline constexpr i32 grid_levels = 16;

struct GridLevel {
  u32 faces = 0;         // entered at this level now
  f32 cell = 0;          // edge length of its cells, a power of two
  f32 largest[3] = {};   // largest box extents ever entered at this level since the last rebuild
};

// All that a search reads of a face, in half a cache line.
struct GridEntry {
  u32 link;  // next in the list
  u32 key;   // low bits of its cell and its level; tells cells apart that share a slot
  Box box;
};

struct Grid {
  u32* head = nullptr;  // 2 V slots: first face of the slot's list, or none
  GridEntry* entry = nullptr;  // per face
  u32 slots = 0;
  i32 base_exponent = 0;  // cells of level `grid_levels / 2` measure 2^base_exponent
  u8 entered_at[grid_levels] = {};  // small sizes that are rare share the level of larger ones: see rebuild()
  GridLevel levels[grid_levels];
  f32 low[3] = {}, high[3] = {};  // bounds of everything entered since the last rebuild
};

// Empties the grid, chooses cells that suit the mesh and enters all living faces. O(V).
void rebuild(Grid& g, const Mesh& m);
void insert(Grid& g, const Mesh& m, u32 f);
void remove(Grid& g, u32 f);

namespace grid_detail {

// Cells whose indices differ by less than this in each axis have different keys.
inline constexpr i64 key_span = 512;
constexpr u32 key_of(i64 x, i64 y, i64 z, u32 level) {
  return level << 28 | (static_cast<u32>(static_cast<u64>(z)) & 0x3FFu) << 18 |
         (static_cast<u32>(static_cast<u64>(y)) & 0x1FFu) << 9 | (static_cast<u32>(static_cast<u64>(x)) & 0x1FFu);
}
static_assert(grid_levels <= 16, "a level fits four bits of the key");

constexpr u64 wrapped(u64 slot, u64 slots) { return slot >= slots ? slot - slots : slot; }

struct CellRange {
  i64 low[3], high[3];
  u64 cells;  // saturated
  bool wide;  // spans more cells than keys can tell apart
};
CellRange cells_of(const GridLevel& level, const Box& query, const f32* low, const f32* high);

// Is (x, y, z) the cell that the face was entered in?
bool in_cell(const Grid& g, u32 f, i64 x, i64 y, i64 z);

}  // namespace grid_detail

// Asks hit(f) exactly once for each entered face f with want(f) whose box meets the query, until one answers true;
// returns that face, or none. Expected O(faces asked + 1) for queries of about the size of the faces; never more than O(slots + faces) for
// each occupied level.
template <class Want, class Hit>
inline u32 find_near(const Grid& g, const Box& query, Want want, Hit hit) {
  using namespace grid_detail;
  const u64 step[3] = {hash_cell(1, 0, 0, g.slots), hash_cell(0, 1, 0, g.slots), hash_cell(0, 0, 1, g.slots)};
  for (u32 l = 0; l < grid_levels; ++l) {
    const GridLevel& level = g.levels[l];
    if (level.faces == 0) continue;
    const CellRange r = cells_of(level, query, g.low, g.high);
    if (r.cells >= g.slots) {
      for (u32 s = 0; s < g.slots; ++s)
        for (u32 f = g.head[s]; f != none; f = g.entry[f].link)
          if (g.entry[f].key >> 28 == l && want(f) && boxes_meet(g.entry[f].box, query) && hit(f)) return f;
      continue;
    }
    // Equation (1) is linear: the slot of the next cell is one addition away.
    u64 slot_z = hash_cell(r.low[0], r.low[1], r.low[2], g.slots);
    for (i64 z = r.low[2]; z <= r.high[2]; ++z, slot_z = wrapped(slot_z + step[2], g.slots)) {
      u64 slot_y = slot_z;
      for (i64 y = r.low[1]; y <= r.high[1]; ++y, slot_y = wrapped(slot_y + step[1], g.slots)) {
        u64 slot = slot_y;
        for (i64 x = r.low[0]; x <= r.high[0]; ++x, slot = wrapped(slot + step[0], g.slots)) {
          const u32 key = key_of(x, y, z, l);
          for (u32 f = g.head[slot]; f != none; f = g.entry[f].link) {
            const GridEntry& e = g.entry[f];
            if (e.key == key && want(f) && boxes_meet(e.box, query) && (!r.wide || in_cell(g, f, x, y, z)) && hit(f))
              return f;
          }
        }
      }
    }
  }
  return none;
}

// Calls visit(f) exactly once for each entered face whose box meets the query.
template <class Visit>
inline void for_each_near(const Grid& g, const Box& query, Visit visit) {
  find_near(g, query, [](u32) { return true; }, [&](u32 f) {
    visit(f);
    return false;
  });
}

}  // namespace tpa
