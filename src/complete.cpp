#include "complete.h"

#include <float.h>

#include "sheet.h"

namespace tpa {

namespace {

// A cluster: some faces are active; nothing meets any of its faces.
enum : u8 { has_active = 1, proven = 2 };

// 16 clusters are some 500 faces: ten microseconds of work and more, against the few that handing out a chunk costs.
constexpr u32 chunk = 16;

struct Search {
  const Mesh& m;
  const Clusters& c;
  const u8* active;
  u8* star;
  ContactSink& sink;
};

bool is_active(const Search& s, u32 face) { return s.active == nullptr || s.active[face] != 0; }

bool any_active(const Search& s, u32 cluster) {
  for (u32 i = s.c.first[cluster]; i < s.c.first[cluster + 1]; ++i)
    if (is_active(s, face_at(s.c, i))) return true;
  return false;
}

// Clusters that a node of the tree holds are tried together first: what they look at beyond themselves is less.
void judge_row(Search& s, u32 row) {
  const Clusters& c = s.c;
  const u32 first = row * tree_branching, last = min_of(c.count, first + tree_branching);
  bool active = s.active == nullptr;
  for (u32 i = first; i < last; ++i) {
    c.state[i] = s.active == nullptr || any_active(s, i) ? has_active : 0;
    active = active || c.state[i] != 0;
  }
  if (!active) return;
  const bool all = c.levels > 1 && is_single_sheet(c, c.level_first[1] + row, first, last);
  for (u32 i = first; i < last; ++i)
    if (c.state[i] != 0 && (all || is_single_sheet(c, i, i, i + 1))) c.state[i] |= proven;
}

// Faces that those of a cluster are tested against, in lanes.
struct Batch {
  static constexpr u32 capacity = 192;
  u32 count = 0;
  u32 place[capacity];
  f32 low[3][capacity + 4], high[3][capacity + 4];
  f32 point[3][3][capacity + 4];  // by corner and axis
  i32 corner[3][capacity + 4];
  f32 reach = 0;                  // largest extent of a box
  // Boxes of four faces each.
  static constexpr u32 group = 4, groups = capacity / group;
  f32 group_low[3][groups + 4], group_high[3][groups + 4];
};

void box_groups(Batch& b) {
  for (u32 k = 0; k < 3; ++k) {
    for (u32 i = b.count; i < b.count + 4; ++i) {
      b.low[k][i] = FLT_MAX;
      b.high[k][i] = -FLT_MAX;
    }
    for (u32 at = 0; at < b.count; at += Batch::group) {
      b.group_low[k][at / Batch::group] = least_of(load4(b.low[k] + at));
      b.group_high[k][at / Batch::group] = largest_of(load4(b.high[k] + at));
    }
  }
}

void add(const Search& s, u32 place, Batch& b) {
  const Clusters& c = s.c;
  const u32 at = b.count++;
  b.place[at] = place;
#pragma GCC unroll 3
  for (u32 k = 0; k < 3; ++k) {
    b.low[k][at] = c.box.low[k][place];
    b.high[k][at] = c.box.high[k][place];
    b.reach = max_of(b.reach, b.high[k][at] - b.low[k][at]);
  }
  const u32* v = s.m.corner + 3 * static_cast<size_t>(face_at(c, place));
#pragma GCC unroll 3
  for (u32 i = 0; i < 3; ++i) {
    memcpy(&b.corner[i][at], v + i, sizeof(u32));
#pragma GCC unroll 3
    for (u32 k = 0; k < 3; ++k) b.point[i][k][at] = c.point[4 * static_cast<size_t>(v[i]) + k];
  }
}

// One face against four at a time.
struct Probe {
  BroadBox box;
  I4 corner[3];    // where the star is proven unfolded: faces that share it do not meet
  F4 origin[3], normal[3];
  F4 bound;
};

Probe probe_of(const Search& s, u32 place, f32 batch_reach) {
  const Clusters& c = s.c;
  Probe p;
  f32 reach = 0;
#pragma GCC unroll 3
  for (u32 k = 0; k < 3; ++k) {
    const f32 low = c.box.low[k][place], high = c.box.high[k][place];
    p.box.low[k] = all4(low);
    p.box.high[k] = all4(high);
    reach = max_of(reach, high - low);
  }
  const u32* v = s.m.corner + 3 * static_cast<size_t>(face_at(c, place));
  const f32* at[3];
#pragma GCC unroll 3
  for (u32 i = 0; i < 3; ++i) {
    const i32 id = star_proven(s.m, s.star, v[i]) ? static_cast<i32>(v[i]) : -1;
    p.corner[i] = I4{id, id, id, id};
    at[i] = c.point + 4 * static_cast<size_t>(v[i]);
  }
  f32 a[3], b[3];
#pragma GCC unroll 3
  for (u32 k = 0; k < 3; ++k) {
    p.origin[k] = all4(at[0][k]);
    a[k] = at[1][k] - at[0][k];
    b[k] = at[2][k] - at[0][k];
  }
#pragma GCC unroll 3
  for (u32 k = 0; k < 3; ++k) {
    const u32 y = (k + 1) % 3, z = (k + 2) % 3;
    p.normal[k] = all4(a[y] * b[z] - a[z] * b[y]);
  }
  // Boxes that meet reach no farther than both extents together. Each difference is off by 2^-24 (1 + reach), which
  // makes 18 reach^2 times that in the six products of three differences, and their roundings 30 * 2^-24 reach^3.
  reach = (reach + batch_reach) * (1 + 0x1p-20f);
  p.bound = all4(0x1p-24f * (reach * reach) * (20 + 50 * reach));
  return p;
}

// Which of the faces at .. at + 3 of the batch may meet the probe.
I4 lanes_left(const Probe& p, const Batch& b, u32 at) {
  I4 left = lanes_meeting({{b.low[0], b.low[1], b.low[2]}, {b.high[0], b.high[1], b.high[2]}}, at, p.box);
  if (at + 4 > b.count) left &= first_lanes(b.count - at);
  if (bits_of(left) == 0) return left;
  I4 shared{}, above{-1, -1, -1, -1}, below = above;
#pragma GCC unroll 3
  for (u32 i = 0; i < 3; ++i) {
    I4 corner;
    memcpy(&corner, b.corner[i] + at, sizeof corner);
    shared |= (corner == p.corner[0]) | (corner == p.corner[1]) | (corner == p.corner[2]);
    const F4 side = p.normal[0] * (load4(b.point[i][0] + at) - p.origin[0]) +
                    p.normal[1] * (load4(b.point[i][1] + at) - p.origin[1]) +
                    p.normal[2] * (load4(b.point[i][2] + at) - p.origin[2]);
    above &= side > p.bound;
    below &= side < -p.bound;
  }
  return left & ~(shared | above | below);
}

// A face of the cluster against those at `from` and the three after it. Pairs within the cluster are met from both
// sides: the first face sees to the pair.
void test_group(Search& s, u32 first, u32 mine, const Probe& probe, const Batch& batch, u32 from) {
  const u32 f = face_at(s.c, mine);
  for (u32 rest = bits_of(lanes_left(probe, batch, from)); rest != 0; rest &= rest - 1) {
    const u32 other = batch.place[from + static_cast<u32>(__builtin_ctz(rest))];
    if (other >= first && other <= mine) continue;
    const u32 g = face_at(s.c, other);
    if ((is_active(s, f) || is_active(s, g)) && faces_meet(s.m, f, g)) s.sink.add(f, g);
  }
}

void test_batch(Search& s, u32 cluster, Batch& batch) {
  const Clusters& c = s.c;
  if (batch.count == 0) return;
  box_groups(batch);
  const ConstBoxLanes boxes{{batch.group_low[0], batch.group_low[1], batch.group_low[2]},
                       {batch.group_high[0], batch.group_high[1], batch.group_high[2]}};
  const u32 groups = (batch.count + Batch::group - 1) / Batch::group;
  for (u32 mine = c.first[cluster]; mine < c.first[cluster + 1]; ++mine) {
    const Probe probe = probe_of(s, mine, batch.reach);
    for (u32 at = 0; at < groups; at += 4)
      for (u32 rest = bits_of(lanes_meeting(boxes, at, probe.box) & first_lanes(groups - at)); rest != 0;
           rest &= rest - 1)
        test_group(s, c.first[cluster], mine, probe, batch, Batch::group * (at + static_cast<u32>(__builtin_ctz(rest))));
  }
  batch.count = 0;
  batch.reach = 0;
}

// Two open clusters with active faces meet from both sides: the first one sees to the pair.
bool sees_to(const Search& s, u32 cluster, u32 other) {
  const u8 state = s.c.state[other];
  return state == 0 || (state == has_active && other >= cluster);
}

void open_cluster(Search& s, u32 cluster) {
  const Clusters& c = s.c;
  if (c.state[cluster] != has_active) return;
  const FlatBox bounds = node_box(c, cluster);
  const BroadBox wide = broad(bounds);
  const ConstBoxLanes boxes = lanes_of(c.box);
  Batch batch;
  for_each_cluster_near(c, bounds, [&](u32 other) {
    if (!sees_to(s, cluster, other)) return true;
    const u32 last = c.first[other + 1];
    for (u32 i = c.first[other]; i < last; i += 4)
      for (u32 rest = bits_of(lanes_meeting(boxes, i, wide) & first_lanes(last - i)); rest != 0; rest &= rest - 1) {
        if (batch.count == Batch::capacity) test_batch(s, cluster, batch);
        add(s, i + static_cast<u32>(__builtin_ctz(rest)), batch);
      }
    return true;
  });
  test_batch(s, cluster, batch);
}

}  // namespace

void detect_complete(const Mesh& m, Clusters& c, const u8* active, u8* star, const Exec& exec, Detection& out) {
  out.pairs.clear();
  arrange(c, m, exec);
  ContactSink sink{out};
  Search s{m, c, active, star, sink};
  for_chunks(exec, (c.count + tree_branching - 1) / tree_branching, 1, [&](u32 row, u32) { judge_row(s, row); });
  for_chunks(exec, c.count, chunk, [&](u32 first, u32 last) {
    for (u32 i = first; i < last; ++i) open_cluster(s, i);
  });
  memset(star, 0, m.vertex_count);
  sink.finish();
}

}  // namespace tpa
