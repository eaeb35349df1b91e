#include "box_hash.h"

#include <string.h>

#include "lanes.h"

namespace tpa {

namespace {

constexpr i32 base_level = hash_levels / 2;

// The nearest float is off by at most 2^-24 of its size, and the correction by as much again, so this is ample. The
// exact range keeps everything normal.
constexpr f32 outward = 0x1p-22f;

F4 nearest(const D2& xy, f64 z) {
  return F4{static_cast<f32>(xy[0]), static_cast<f32>(xy[1]), static_cast<f32>(z), 0};
}

f32 power_of_two(i32 exponent) {
  const u32 bits = static_cast<u32>(max_of(-126, min_of(127, exponent)) + 127) << 23;
  f32 p;
  memcpy(&p, &bits, sizeof p);
  return p;
}

// Smallest e with x <= 2^e, for x >= 0; at least -120, so that cells stay normal numbers.
i32 ceiling_exponent(f32 x) {
  u32 bits;
  memcpy(&bits, &x, sizeof bits);
  const i32 e = static_cast<i32>(bits >> 23) - 127 + ((bits & 0x7FFFFFu) != 0 ? 1 : 0);
  return max_of(-120, e);
}

// Level base_level holds boxes in (2^(base - 2), 2^base], the next (2^base, 2^(base + 2)], and so on.
i32 level_of(const BoxHash& h, const Box& b) {
  const i32 above = ceiling_exponent(extent_of(b)) - h.base_exponent;
  const i32 steps = above > 0 ? (above + 1) / 2 : -((-above) / 2);
  return max_of(0, min_of(hash_levels - 1, base_level + steps));
}

// A large query looks into every cell of a level that it covers, so a level of small cells must be worth it: sizes
// below the base that fewer than one box in sixteen has are entered with the next larger ones.
void open_levels(BoxHash& h, const u32 (&boxes)[hash_levels], u32 count) {
  u32 waiting = 0;
  i32 first_waiting = 0;
  for (i32 l = 0; l < hash_levels; ++l) {
    waiting += boxes[l];
    if (l < base_level && waiting < count / 16) continue;
    for (; first_waiting <= l; ++first_waiting) h.entered_at[first_waiting] = static_cast<u8>(l);
    waiting = 0;
  }
}

// Cells are powers of two, so multiplying by the inverse is exact.
i64 cell_index(f64 x, f32 cell) { return floor_to_integer(x * (1.0 / static_cast<f64>(cell))); }

}  // namespace

Box box_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const D2 p = load2(&a.x), q = load2(&b.x), r = load2(&c.x);
  const F4 low = nearest(min2(p, min2(q, r)), min_of(a.z, min_of(b.z, c.z)));
  const F4 high = nearest(max2(p, max2(q, r)), max_of(a.z, max_of(b.z, c.z)));
  const F4 below = low - outward * abs4(low), above = high + outward * abs4(high);
  Box box;
  memcpy(box.low, &below, sizeof box.low);
  memcpy(box.high, &above, sizeof box.high);
  return box;
}

namespace {

struct Place {
  u32 level, slot, key;
};

Place place_of(const BoxHash& h, const Box& box) {
  const u32 l = h.entered_at[level_of(h, box)];
  const f32 cell = h.levels[l].cell;
  const i64 x = cell_index(static_cast<f64>(box.low[0]), cell), y = cell_index(static_cast<f64>(box.low[1]), cell),
            z = cell_index(static_cast<f64>(box.low[2]), cell);
  return {l, hash_cell(x, y, z, h.slots), box_hash_detail::key_of(x, y, z, l)};
}

}  // namespace

void enter(BoxHash& h, u32 i) {
  const Box& box = h.entry[i].box;
  const Place p = place_of(h, box);
  HashLevel& level = h.levels[p.level];
  h.entry[i].key = p.key;
  h.entry[i].link = h.head[p.slot];
  h.head[p.slot] = i;
  ++level.boxes;
  for (int k = 0; k < 3; ++k) {
    // A difference of floats may round down.
    const f32 size = box.high[k] - box.low[k];
    level.largest[k] = max_of(level.largest[k], size + outward * size);
    h.low[k] = min_of(h.low[k], box.low[k]);
    h.high[k] = max_of(h.high[k], box.high[k]);
  }
}

void leave(BoxHash& h, u32 i) {
  const Place p = place_of(h, h.entry[i].box);
  u32* place = &h.head[p.slot];
  while (*place != i) place = &h.entry[*place].link;
  *place = h.entry[i].link;
  --h.levels[p.level].boxes;
}

void fill(BoxHash& h, u32 count) {
  f64 sum = 0;
  u32 boxes = 0;
  for (u32 i = 0; i < count; ++i) {
    if (is_empty(h.entry[i].box)) continue;
    sum += static_cast<f64>(extent_of(h.entry[i].box));
    ++boxes;
  }
  // Half as large again as the mean box, rounded up to a power of two: most boxes then share one level, with a few
  // in a cell.
  const f64 mean = boxes == 0 ? 1 : sum / boxes;
  h.base_exponent = ceiling_exponent(static_cast<f32>(1.5 * mean));
  u32 at_level[hash_levels] = {};
  for (u32 i = 0; i < count; ++i)
    if (!is_empty(h.entry[i].box)) ++at_level[level_of(h, h.entry[i].box)];
  open_levels(h, at_level, boxes);
  for (i32 l = 0; l < hash_levels; ++l) h.levels[l] = {0, power_of_two(h.base_exponent + 2 * (l - base_level)), {}};
  for (int k = 0; k < 3; ++k) {
    h.low[k] = FLT_MAX;
    h.high[k] = -FLT_MAX;
  }
  memset(h.head, 0xFF, static_cast<size_t>(h.slots) * sizeof(u32));
  // Backwards, so that each list runs through memory forwards.
  for (u32 i = count; i-- > 0;)
    if (!is_empty(h.entry[i].box)) enter(h, i);
}

namespace box_hash_detail {

CellRange cells_of(const HashLevel& level, const Box& query, const f32* low, const f32* high) {
  CellRange r;
  f64 cells = 1;
  r.wide = false;
  for (int i = 0; i < 3; ++i) {
    const f64 from = static_cast<f64>(max_of(query.low[i], low[i])) - static_cast<f64>(level.largest[i]);
    const f64 to = static_cast<f64>(min_of(query.high[i], high[i]));
    r.low[i] = cell_index(max_of(from, static_cast<f64>(low[i])), level.cell);
    r.high[i] = cell_index(to, level.cell);
    // Indices saturate, and differences of those would not fit.
    const f64 count = static_cast<f64>(r.high[i]) - static_cast<f64>(r.low[i]) + 1;
    r.wide = r.wide || count > static_cast<f64>(key_span);
    cells *= max_of(0.0, count);
  }
  r.cells = cells < 0x1p62 ? static_cast<u64>(cells) : u64{1} << 62;
  return r;
}

bool in_cell(const BoxHash& h, u32 i, i64 x, i64 y, i64 z) {
  const f32 cell = h.levels[h.entry[i].key >> 28].cell;
  const Box& box = h.entry[i].box;
  return cell_index(static_cast<f64>(box.low[0]), cell) == x && cell_index(static_cast<f64>(box.low[1]), cell) == y &&
         cell_index(static_cast<f64>(box.low[2]), cell) == z;
}

}  // namespace box_hash_detail

}  // namespace tpa
