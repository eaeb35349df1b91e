#include "sheet.h"

#include <float.h>

namespace tpa {

namespace {

struct View {
  u32 x, y, z;  // z is the axis looked along
  f32 up;       // 1 or -1: which way the faces turn
};

// The axis along which the area of the faces is seen largest.
View view_of(const Clusters& c, u32 first, u32 last) {
  f32 sum[3];
  for (u32 k = 0; k < 3; ++k) {
    F4 lanes = all4(0);
    for (u32 i = first; i < last; i += 4) lanes += (F4)(first_lanes(last - i) & (I4)load4(c.normal[k] + i));
    sum[k] = lanes[0] + lanes[1] + lanes[2] + lanes[3];
  }
  const auto size = [&](u32 k) { return sum[k] < 0 ? -sum[k] : sum[k]; };
  u32 z = size(1) > size(0) ? 1 : 0;
  if (size(2) > size(z)) z = 2;
  return {(z + 1) % 3, (z + 2) % 3, z, sum[z] < 0 ? -1.0f : 1.0f};
}

// Do all faces certainly turn the same side up?
bool faces_up(const Clusters& c, const View& view, u32 first, u32 last) {
  I4 down{};
  for (u32 i = first; i < last; i += 4)
    down |= first_lanes(last - i) & ~(load4(c.normal[view.z] + i) * all4(view.up) > all4(0));
  return bits_of(down) == 0;
}

// What is over the rectangle and in the slab.
struct Survey {
  I4 down{};          // lanes in which some face does not certainly face up
  I4 beyond{};        // lanes in which a face reaches out of the slab
  F4 area = all4(0);  // upper bounds of twice the area over the rectangle
};

// The length that intervals share with low .. high.
F4 shared_length(F4 from, F4 to, F4 low, F4 high) { return min4(to, high) - max4(from, low); }

void survey(const Clusters& c, const View& view, const BroadBox& slab, u32 cluster, Survey& s) {
  const f32 *x_low = c.box.low[view.x], *x_high = c.box.high[view.x], *y_low = c.box.low[view.y],
            *y_high = c.box.high[view.y], *z_low = c.box.low[view.z], *z_high = c.box.high[view.z],
            *normal = c.normal[view.z];
  const F4 up = all4(view.up), ax = slab.low[view.x], bx = slab.high[view.x], ay = slab.low[view.y],
           by = slab.high[view.y], az = slab.low[view.z], bz = slab.high[view.z];
  Survey sum = s;
  const u32 last = c.first[cluster + 1];
  for (u32 i = c.first[cluster]; i < last; i += 4) {
    const F4 xl = load4(x_low + i), xh = load4(x_high + i), yl = load4(y_low + i), yh = load4(y_high + i),
             zl = load4(z_low + i), zh = load4(z_high + i);
    I4 in = (xl <= bx) & (xh >= ax) & (yl <= by) & (yh >= ay) & (zl <= bz) & (zh >= az);
    if (last - i < 4) in &= first_lanes(last - i);
    const F4 n = load4(normal + i) * up;
    sum.down |= in & ~(n > all4(0));
    sum.beyond |= in & ((zl < az) | (zh > bz));
    const F4 shared = shared_length(xl, xh, ax, bx) * shared_length(yl, yh, ay, by);
    sum.area += (F4)(in & (I4)min4(n, shared + shared));
  }
  s = sum;
}

// Clusters that the proof may have to look at; more are not worth it.
constexpr u32 most_near = 80;
// The slab reaches beyond the clusters by this much of their height and of their width and depth; more where that
// proves too little.
constexpr f32 by_height[] = {0.5f, 1, 2}, by_width[] = {0.05f, 0.12f, 0.3f};
constexpr u32 surveys = 3;

}  // namespace

bool is_single_sheet(const Clusters& c, u32 node, u32 first_cluster, u32 last_cluster) {
  const u32 first = c.first[first_cluster], last = c.first[last_cluster];
  const View view = view_of(c, first, last);
  if (!faces_up(c, view, first, last)) return false;
  FlatBox slab = node_box(c, node), reach = slab;
  const f32 width = slab.high[view.x] - slab.low[view.x], depth = slab.high[view.y] - slab.low[view.y];
  const f32 height = slab.high[view.z] - slab.low[view.z];
  if (!(width > 0x1p-20f && depth > 0x1p-20f)) return false;
  // In normals, which are twice the areas, and off by an eighth at most: 2 * 2 / (1 + 1/8) times the rectangle, less
  // what the sum's roundings take. The sides are off by 2^-24, and a rounding.
  const f32 allowed = 3.5f * (width - 0x1p-22f) * (depth - 0x1p-22f);
  const FlatBox bounds = slab;
  const auto extend = [&](FlatBox& box, u32 round) {
    const f32 margin = by_height[round] * height + by_width[round] * (width + depth);
    box.low[view.z] = bounds.low[view.z] - margin;
    box.high[view.z] = bounds.high[view.z] + margin;
  };
  extend(reach, surveys - 1);
  u32 near[most_near], count = 0;
  bool fits = true;
  for_each_cluster_near(c, reach, [&](u32 other) {
    fits = count < most_near;
    if (fits) near[count++] = other;
    return fits;
  });
  if (!fits) return false;
  for (u32 round = 0; round < surveys; ++round) {
    extend(slab, round);
    const BroadBox wide = broad(slab);
    Survey s;
    for (u32 i = 0; i < count; ++i) {
      if (!boxes_meet(node_box(c, near[i]), slab)) continue;
      survey(c, view, wide, near[i], s);
      if (bits_of(s.down) != 0 || !(s.area[0] + s.area[1] + s.area[2] + s.area[3] < allowed)) return false;
    }
    if (bits_of(s.beyond) == 0) return true;
  }
  return false;
}

}  // namespace tpa
