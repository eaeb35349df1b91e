#include "grid.h"

#include <string.h>

namespace tpa {

namespace {

constexpr i32 base_level = grid_levels / 2;

// Floats not above, or not below, x: the nearest one is off by at most 2^-24 of its size, and the correction by as
// much again, so 2^-22 is ample. The exact range keeps everything normal.
f32 round_down(f64 x) {
  const f32 f = static_cast<f32>(x);
  return f - 0x1p-22f * __builtin_fabsf(f);
}
f32 round_up(f64 x) { return -round_down(-x); }

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

f32 extent(const Box& b) {
  return max_of(b.high[0] - b.low[0], max_of(b.high[1] - b.low[1], b.high[2] - b.low[2]));
}

// Level base_level holds boxes in (2^(base - 2), 2^base], the next (2^base, 2^(base + 2)], and so on.
i32 level_of(const Grid& g, const Box& b) {
  const i32 above = ceiling_exponent(extent(b)) - g.base_exponent;
  const i32 steps = above > 0 ? (above + 1) / 2 : -((-above) / 2);
  return max_of(0, min_of(grid_levels - 1, base_level + steps));
}

// A large query looks into every cell of a level that it covers, so a level of small cells must be worth it: sizes
// below the base that fewer than one face in sixteen has are entered with the next larger ones.
void open_levels(Grid& g, const u32 (&faces)[grid_levels], u32 count) {
  u32 waiting = 0;
  i32 first_waiting = 0;
  for (i32 l = 0; l < grid_levels; ++l) {
    waiting += faces[l];
    if (l < base_level && waiting < count / 16) continue;
    for (; first_waiting <= l; ++first_waiting) g.entered_at[first_waiting] = static_cast<u8>(l);
    waiting = 0;
  }
}

// Cells are powers of two, so multiplying by the inverse is exact.
i64 cell_index(f64 x, f32 cell) { return floor_to_integer(x * (1.0 / static_cast<f64>(cell))); }

}  // namespace

Box box_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  Box box;
  for (int i = 0; i < 3; ++i) {
    box.low[i] = round_down(min_of(a[i], min_of(b[i], c[i])));
    box.high[i] = round_up(max_of(a[i], max_of(b[i], c[i])));
  }
  return box;
}

namespace {

struct Place {
  u32 level, slot, key;
};

Place place_of(const Grid& g, const Box& box) {
  const u32 l = g.entered_at[level_of(g, box)];
  const f32 cell = g.levels[l].cell;
  const i64 x = cell_index(static_cast<f64>(box.low[0]), cell), y = cell_index(static_cast<f64>(box.low[1]), cell),
            z = cell_index(static_cast<f64>(box.low[2]), cell);
  return {l, hash_cell(x, y, z, g.slots), grid_detail::key_of(x, y, z, l)};
}

// By its box, which is in place.
void enter(Grid& g, u32 f) {
  const Box& box = g.entry[f].box;
  const Place p = place_of(g, box);
  GridLevel& level = g.levels[p.level];
  g.entry[f].key = p.key;
  g.entry[f].link = g.head[p.slot];
  g.head[p.slot] = f;
  ++level.faces;
  for (int i = 0; i < 3; ++i) {
    // Rounded up: a difference of floats may round down.
    const f32 size = round_up(static_cast<f64>(box.high[i]) - static_cast<f64>(box.low[i]));
    level.largest[i] = max_of(level.largest[i], size);
    g.low[i] = min_of(g.low[i], box.low[i]);
    g.high[i] = max_of(g.high[i], box.high[i]);
  }
}

}  // namespace

void insert(Grid& g, const Mesh& m, u32 f) {
  g.entry[f].box = face_box(m, f);
  enter(g, f);
}

void remove(Grid& g, u32 f) {
  const Place p = place_of(g, g.entry[f].box);
  u32* place = &g.head[p.slot];
  while (*place != f) place = &g.entry[*place].link;
  *place = g.entry[f].link;
  --g.levels[p.level].faces;
}

void rebuild(Grid& g, const Mesh& m) {
  f64 sum = 0;
  u32 count = 0;
  for (u32 f = 0; f < m.face_count; ++f) {
    if (!face_lives(m, f)) continue;
    g.entry[f].box = face_box(m, f);
    sum += static_cast<f64>(extent(g.entry[f].box));
    ++count;
  }
  // Half as large again as the mean box, rounded up to a power of two: most faces then share one level, with a few
  // faces in a cell.
  const f64 mean = count == 0 ? 1 : sum / count;
  g.base_exponent = ceiling_exponent(static_cast<f32>(1.5 * mean));
  u32 faces[grid_levels] = {};
  for (u32 f = 0; f < m.face_count; ++f)
    if (face_lives(m, f)) ++faces[level_of(g, g.entry[f].box)];
  open_levels(g, faces, count);
  for (i32 l = 0; l < grid_levels; ++l) g.levels[l] = {0, power_of_two(g.base_exponent + 2 * (l - base_level)), {}};
  for (int i = 0; i < 3; ++i) {
    g.low[i] = FLT_MAX;
    g.high[i] = -FLT_MAX;
  }
  memset(g.head, 0xFF, static_cast<size_t>(g.slots) * sizeof(u32));
  // Backwards, so that each list runs through memory forwards.
  for (u32 f = m.face_count; f-- > 0;)
    if (face_lives(m, f)) enter(g, f);
}

namespace grid_detail {

CellRange cells_of(const GridLevel& level, const Box& query, const f32* low, const f32* high) {
  CellRange r;
  f64 cells = 1;
  r.wide = false;
  for (int i = 0; i < 3; ++i) {
    const f64 from = static_cast<f64>(max_of(query.low[i], low[i])) - static_cast<f64>(level.largest[i]);
    const f64 to = static_cast<f64>(min_of(query.high[i], high[i]));
    r.low[i] = cell_index(max_of(from, static_cast<f64>(low[i])), level.cell);
    r.high[i] = cell_index(to, level.cell);
    r.wide = r.wide || r.high[i] - r.low[i] >= key_span;
    cells *= static_cast<f64>(max_of(i64{0}, r.high[i] - r.low[i] + 1));
  }
  r.cells = cells < 0x1p62 ? static_cast<u64>(cells) : u64{1} << 62;
  return r;
}

bool in_cell(const Grid& g, u32 f, i64 x, i64 y, i64 z) {
  const f32 cell = g.levels[g.entry[f].key >> 28].cell;
  const Box& box = g.entry[f].box;
  return cell_index(static_cast<f64>(box.low[0]), cell) == x && cell_index(static_cast<f64>(box.low[1]), cell) == y &&
         cell_index(static_cast<f64>(box.low[2]), cell) == z;
}

}  // namespace grid_detail

}  // namespace tpa
