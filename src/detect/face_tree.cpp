// SPDX-License-Identifier: MIT
#include "detect/face_tree.h"

#include <float.h>

#include "base/sort.h"
#include "geometry/morton.h"

namespace tpa {

namespace {

// GCC 12 keeps vectors in registers only across loops that it unrolls first. Loops marked for that take 6 % off
// complete detection (docs/notes/detection.md).

// Vertices and leaves of a task.
constexpr u32 vertex_chunk = 1u << 14, leaf_chunk = 1u << 7;

constexpr u32 most_tasks = 16;

constexpr u64 up(u64 x, u64 multiple) { return (x + multiple - 1) / multiple * multiple; }
constexpr u64 chunks_of(u64 n, u64 size) { return (n + size - 1) / size; }
// All leaves but the last have at least fewest_in_bud faces.
constexpr u64 most_leaves(u64 faces) { return faces / fewest_in_bud + 1; }
constexpr u64 most_nodes(u64 faces) {
  u64 nodes = 0;
  for (u64 n = most_leaves(faces);; n = chunks_of(n, tree_branching)) {
    nodes += up(n, tree_branching);
    if (n <= tree_branching) return nodes;
  }
}

struct Bytes {
  u64 searched, all;
};
Bytes lay_out(u8* memory, u64 vertices, u64 faces, FaceTree& tree) {
  const u64 leaves = most_leaves(faces);
  Carver carver{memory};
  carver.take(tree.place, faces);
  carver.take(tree.face, faces);
  carver.take(tree.first, leaves + 1);
  carver.take(tree.end, leaves);
  // Arrays share memory if the use of one ends before the use of the other. Detection uses leaf_of, edits of the tree
  // use place. Scratch of the order goes before boxes and outlines come.
  tree.leaf_of = tree.place;
  Carver order = carver;
  lay_out_buds(order, faces, tree.buds);
  order.take(tree.item, most_buds(faces));
  order.take(tree.unsorted, most_buds(faces));
  for (u32 i = 0; i < 3; ++i) {
    carver.take(tree.box.low[i], faces + bytes_in_lanes);
    carver.take(tree.box.high[i], faces + bytes_in_lanes);
  }
  carver.take(tree.byte_frame, leaves);
  for (u32 i = 0; i < 3; ++i) {
    carver.take(tree.node.low[i], most_nodes(faces));
    carver.take(tree.node.high[i], most_nodes(faces));
  }
  carver.take(tree.row_leaf, faces / places_in_row + 1);
  carver.take(tree.trial_room, trial_room_bytes);
  carver.take(tree.hub, leaves);
  const u64 searched = carver.bytes;
  carver.take(tree.adjacent, leaves);
  carver.take(tree.outline, leaves);
  carver.bytes = max_of(carver.bytes, order.bytes);
  carver.take(tree.point, 3 * vertices + 1);
  return {searched, carver.bytes};
}

// Runs task(t, first, last) on ranges of 0 .. n-1. Results must not depend on the number of ranges: a single one
// without threads.
template <class Task>
void for_tasks(const Exec& exec, u32 n, Task task) {
  const u32 tasks = exec.parallel_for == nullptr ? 1 : most_tasks;
  const u32 share = n / tasks + 1;
  for_chunks(exec, tasks, 1, [&](u32 t, u32) { task(t, min_of(n, t * share), min_of(n, (t + 1) * share)); });
}

// ---------------------------------------------------------------- points

struct Bounds {
  Vec3 low{DBL_MAX, DBL_MAX, DBL_MAX}, high{-DBL_MAX, -DBL_MAX, -DBL_MAX};
  void add(const Vec3& p, const Vec3& q) {
    low = {min_of(low.x, p.x), min_of(low.y, p.y), min_of(low.z, p.z)};
    high = {max_of(high.x, q.x), max_of(high.y, q.y), max_of(high.z, q.z)};
  }
};

// Takes two vertices at a time, their six numbers as three pairs.
Bounds bounds_of(const Vec3* position, u32 count) {
  static_assert(sizeof(Vec3) == 3 * sizeof(f64));
  D2 low[3] = {all2(DBL_MAX), all2(DBL_MAX), all2(DBL_MAX)}, high[3] = {-low[0], -low[1], -low[2]};
  for (u32 v = 0; v + 2 <= count; v += 2)
#pragma GCC unroll 3
    for (u32 k = 0; k < 3; ++k) {
      D2 pair;
      memcpy(&pair, reinterpret_cast<const u8*>(position + v) + k * sizeof pair, sizeof pair);
      low[k] = min2(low[k], pair);
      high[k] = max2(high[k], pair);
    }
  Bounds b;
  b.add({low[0][0], low[0][1], low[1][0]}, {high[0][0], high[0][1], high[1][0]});
  b.add({low[1][1], low[2][0], low[2][1]}, {high[1][1], high[2][0], high[2][1]});
  if (count % 2 != 0) b.add(position[count - 1], position[count - 1]);
  return b;
}

Frame frame_of(const Mesh& m, const Exec& exec) {
  Bounds part[most_tasks], b;
  for_tasks(exec, m.vertex_count,
            [&](u32 t, u32 first, u32 last) { part[t] = bounds_of(m.position + first, last - first); });
  for (const Bounds& p : part) b.add(p.low, p.high);
  const Vec3 size = b.high - b.low;
  const f64 reach = max_of(size.x, max_of(size.y, size.z));
  f64 scale = 1;
  while (scale * reach > 1) scale *= 0.5;
  while (scale * reach <= 0.5 && reach > 0) scale *= 2;
  return {midpoint(b.low, b.high), 2 * scale * (1 - 0x1p-20)};
}

void make_points(FaceTree& tree, const Mesh& m, const Exec& exec) {
  const Frame frame = tree.frame = frame_of(m, exec);
  for_chunks(exec, m.vertex_count, vertex_chunk, [&](u32 first, u32 last) {
    for (u32 v = first; v < last; ++v) {
      const Vec3 p = frame.scale * (m.position[v] - frame.middle);
      f32* point = tree.point + 3 * static_cast<size_t>(v);
      point[0] = static_cast<f32>(p.x), point[1] = static_cast<f32>(p.y), point[2] = static_cast<f32>(p.z);
    }
  });
  tree.point[3 * static_cast<size_t>(m.vertex_count)] = 0;
}

// ---------------------------------------------------------------- order

// An item of the order: the place of a leading bud on the curve, and its number in the lower bits.
constexpr u32 bud_bits = 64 - 3 * curve_bits;
u32 bud_of_item(u64 item) { return static_cast<u32>(item & ((u64{1} << bud_bits) - 1)); }

// Equal parts of the curve, and so of space.
constexpr u32 part_bits = 9, curve_parts = 1u << part_bits;
u32 part_of_item(u64 item) { return static_cast<u32>(item >> (64 - part_bits)); }

// Sorts the leading buds by the place of their first corner on the curve; returns their number. A counting sort by
// parts of the curve comes first, in any order within a part; a sort of each part makes the order definite.
u32 sort_buds(FaceTree& tree, const Mesh& m, const Exec& exec) {
  const Buds& b = tree.buds;
  u32 end[curve_parts] = {}, leaders[most_zones];
  for_chunks(exec, b.zones, 1, [&](u32 z, u32) {
    u32 n = 0;
    for (u32 i = b.start[z]; i < b.start[z] + b.count[z]; ++i) {
      if (b.leader[i] != i) continue;
      const u32 vertex = m.corner[3 * static_cast<size_t>(b.face[b.first[i]])];
      const u64 item = place_on_curve(tree.point + 3 * static_cast<size_t>(vertex)) << bud_bits | i;
      __atomic_fetch_add(end + part_of_item(item), 1, __ATOMIC_RELAXED);
      tree.unsorted[b.start[z] + n++] = item;
    }
    leaders[z] = n;
  });
  u32 all = 0;
  for (u32& part : end) {
    const u32 count = part;
    part = all;  // for now the begin of the part
    all += count;
  }
  for_chunks(exec, b.zones, 1, [&](u32 z, u32) {
    for (u32 i = b.start[z]; i < b.start[z] + leaders[z]; ++i)
      tree.item[__atomic_fetch_add(end + part_of_item(tree.unsorted[i]), 1, __ATOMIC_RELAXED)] = tree.unsorted[i];
  });
  for_chunks(exec, curve_parts, curve_parts / most_tasks, [&](u32 first, u32 last) {
    for (u32 i = first; i < last; ++i) {
      const u32 begin = i == 0 ? 0 : end[i - 1];
      sort_in_place(tree.item + begin, end[i] - begin);
    }
  });
  return all;
}

// Puts the faces of a leading bud and of all buds joined to it at the places from `place` on.
void fill_leaf(FaceTree& tree, u32 bud, u32 leaf, u32 place) {
  const Buds& b = tree.buds;
  u32* const leaf_of = tree.leaf_of;
  for (; bud != none; bud = b.following[bud]) {
    const u32* face = b.face + b.first[bud];
    const u32 count = b.first[bud + 1] - b.first[bud];
    memcpy(tree.face + place, face, count * sizeof(u32));
    for (u32 i = 0; i < count; ++i) leaf_of[face[i]] = leaf;
    place += count;
  }
}

// Makes a leaf of each leading bud, or of several along the curve until they have fewest_in_bud faces. `end` holds, for
// now, the items' end of each leaf.
void make_leaves(FaceTree& tree, const Mesh& m, const Exec& exec) {
  const u32 n = sort_buds(tree, m, exec);
  tree.faces = m.face_count;
  tree.numbered = tree.strays = tree.count = tree.places = tree.first[0] = 0;
  for (u32 i = 0; i < n; ++i) {
    tree.places += tree.buds.size[bud_of_item(tree.item[i])];
    if (tree.places - tree.first[tree.count] < fewest_in_bud && i + 1 < n) continue;
    tree.end[tree.count] = i + 1;
    tree.first[++tree.count] = tree.places;
  }
  for_chunks(exec, tree.count, leaf_chunk, [&](u32 first, u32 last) {
    for (u32 k = first; k < last; ++k) {
      u32 place = tree.first[k];
      for (u32 i = k == 0 ? 0 : tree.end[k - 1]; i < tree.end[k]; ++i) {
        const u32 bud = bud_of_item(tree.item[i]);
        fill_leaf(tree, bud, k, place);
        place += tree.buds.size[bud];
      }
    }
  });
}

// ---------------------------------------------------------------- boxes

// Four faces in lanes: corners by axis, and normals twice as long as the area.
struct FourFaces {
  F4 corner[3][3];
  F4 normal[3];
};
constexpr u32 most_groups = (most_in_leaf + 3) / 4;

// The boxes of all faces of a leaf, and the box round all.
struct Bounds4 {
  F4 low[3][most_groups + 3], high[3][most_groups + 3];  // set_bounds() reads three more
  Box all;
};
void bound_faces(const FourFaces* four, u32 groups, Bounds4& b) {
  for (u32 k = 0; k < 3; ++k) {
    F4 low = all4(FLT_MAX), high = all4(-FLT_MAX);
    for (u32 g = 0; g < groups; ++g) {
      const F4 &x = four[g].corner[0][k], &y = four[g].corner[1][k], &z = four[g].corner[2][k];
      low = min4(low, b.low[k][g] = min4(x, min4(y, z)));
      high = max4(high, b.high[k][g] = max4(x, max4(y, z)));
    }
    for (u32 g = groups; g < groups + 3; ++g) b.low[k][g] = b.high[k][g] = low;
    b.all.low[k] = least_of(low);
    b.all.high[k] = largest_of(high);
  }
}

f32 sum_of(const F4& v) { return (v[0] + v[1]) + (v[2] + v[3]); }

// Sets the normals of all faces, and their mean, weighted by area.
void set_normal(Outline& o, FourFaces* four, u32 groups) {
  F4 sum[3] = {};
  for (u32 g = 0; g < groups; ++g) {
    const auto& [a, b, d] = four[g].corner;
    F4 u[3], v[3];
#pragma GCC unroll 3
    for (u32 k = 0; k < 3; ++k) u[k] = b[k] - a[k], v[k] = d[k] - a[k];
#pragma GCC unroll 3
    for (u32 k = 0; k < 3; ++k) {
      const u32 y = (k + 1) % 3, z = (k + 2) % 3;
      four[g].normal[k] = u[y] * v[z] - u[z] * v[y];
      sum[k] += four[g].normal[k];
    }
  }
  const f32 x = sum_of(sum[0]), y = sum_of(sum[1]), z = sum_of(sum[2]);
  const f32 size = square_root(x * x + y * y + z * z), scale = size > 0 ? 1 / size : 0;
  o.normal[0] = scale * x, o.normal[1] = scale * y, o.normal[2] = scale * z;
}

// Sets all but middle, normal and point. `reach`: extent of the leaf along any axis at most.
void set_extent(Outline& o, const FourFaces* four, u32 groups, f32 reach) {
  F4 low = all4(FLT_MAX), high = all4(-FLT_MAX), radius = all4(0), across = all4(0), largest = all4(0);
  I4 up{-1, -1, -1, -1};
  const f32 mx = o.middle[0], my = o.middle[1], mz = o.middle[2], nx = o.normal[0], ny = o.normal[1], nz = o.normal[2];
  for (u32 g = 0; g < groups; ++g) {
    const FourFaces& f = four[g];
#pragma GCC unroll 3
    for (u32 k = 0; k < 3; ++k) {
      const F4 x = f.corner[k][0] - mx, y = f.corner[k][1] - my, z = f.corner[k][2] - mz;
      const F4 height = nx * x + ny * y + nz * z;
      low = min4(low, height);
      high = max4(high, height);
      radius = max4(radius, x * x + y * y + z * z);
    }
    const F4 &x = f.normal[0], &y = f.normal[1], &z = f.normal[2];
    const F4 along = nx * x + ny * y + nz * z, square = along * along, part = 1 / along;
    up &= along > all4(0);
    // Half of the allowance for rounding; the other half follows with the root.
    across = max4(across, (x * x + y * y + z * z - square * (1 - 0x1p-20f)) * (part * part));
    largest = max4(largest, part);
  }
  o.level = 0.5f * (least_of(low) + largest_of(high));
  o.thickness = 0.5f * (largest_of(high) - least_of(low));
  o.radius = square_root(largest_of(radius));
  const bool known = bits_of(up) == 15;
  o.slope = known ? square_root(max_of(0.0f, largest_of(across))) * (1 + 0x1p-18f) : FLT_MAX;
  o.doubt = known ? certain_volume * reach * largest_of(largest) * (1 + 0x1p-18f) : FLT_MAX;
}

// Few faces have no meaning as a hub: searches test them as fast.
void find_hub(FaceTree& tree, const Mesh& m, u32 leaf) {
  const Span<const u32> faces{tree.face + tree.first[leaf], tree.first[leaf + 1] - tree.first[leaf]};
  const u32 hub = faces.size >= fewest_in_bud ? common_corner(m, faces) : none;
  tree.hub[leaf] = hub;
  if (hub != none) __atomic_store_n(&tree.has_hubs, true, __ATOMIC_RELAXED);
}

// Boxes the faces of a leaf, and sets its outline. `end`: behind the places of all leaves to be boxed by this task;
// bytes from the leaf on to `end` may be overwritten.
void box_leaf(FaceTree& tree, const Mesh& m, u32 leaf, u32 end) {
  const u32 first = tree.first[leaf], last = tree.first[leaf + 1];
  FourFaces four[most_groups];
  u32 groups = 0;
  for (u32 at = first; at < last; at += 4) corners_of_four(tree, m, at, last, four[groups++].corner);
  Outline& outline = tree.outline[leaf];
  Bounds4 bounds;
  bound_faces(four, groups, bounds);
  const Box& box = bounds.all;
  const QuantizedFrame frame = tree.byte_frame[leaf] = frame_round(box);
  for (u32 k = 0; k < 3; ++k) {
    set_bounds(frame, k, {bounds.low[k], groups}, tree.box.low[k] + first, end - first);
    set_bounds(frame, k, {bounds.high[k], groups}, tree.box.high[k] + first, end - first);
    tree.node.low[k][leaf] = box.low[k], tree.node.high[k][leaf] = box.high[k];
    outline.middle[k] = 0.5f * (box.low[k] + box.high[k]);
    outline.point[k] = (four[0].corner[0][k][0] + four[0].corner[1][k][0] + four[0].corner[2][k][0]) * (1.0f / 3);
  }
  set_normal(outline, four, groups);
  set_extent(outline, four, groups, extent_of(box));
}

// ---------------------------------------------------------------- adjacent leaves

// Fetch a leaf's rows of the mesh, and then the points they name, while other leaves are boxed. Inlined by force, as
// fetch() is.
[[gnu::always_inline]] inline void fetch_rows(const FaceTree& tree, const Mesh& m, u32 leaf, u32 last) {
  if (leaf >= last) return;
  for (u32 at = tree.first[leaf]; at < tree.first[leaf + 1]; ++at) {
    const size_t row = 3 * static_cast<size_t>(face_at(tree, at));
    fetch(m.opposite + row);
    fetch(m.corner + row);
  }
}
[[gnu::always_inline]] inline void fetch_points(const FaceTree& tree, const Mesh& m, u32 leaf, u32 last) {
  if (leaf >= last) return;
  for (u32 at = tree.first[leaf]; at < tree.first[leaf + 1]; ++at) {
    const size_t f = face_at(tree, at);
    fetch(tree.point + 3 * static_cast<size_t>(m.corner[3 * f]));
    fetch(tree.leaf_of + f);
  }
}

// Lists the leaves beyond edges first, without a branch for each edge, and drops repetitions afterwards.
void find_adjacent(FaceTree& tree, const Mesh& m, u32 leaf) {
  u32 beyond[3 * most_in_leaf + 1];
  u32 count = 0;
  for (u32 at = tree.first[leaf]; at < tree.first[leaf + 1]; ++at) {
    const u32* opposite = m.opposite + 3 * static_cast<size_t>(face_at(tree, at));
#pragma GCC unroll 3
    for (u32 i = 0; i < 3; ++i) {
      const u32 other = tree.leaf_of[face_of(opposite[i])];
      beyond[count] = other;
      count += other == leaf ? 0u : 1u;
    }
  }
  LeafSet<AdjacentLeaves::capacity, 64> set;
  bool all = true;
  for (u32 i = 0; i < count; ++i) all = set.add(beyond[i]) && all;
  AdjacentLeaves& n = tree.adjacent[leaf];
  n.count = all ? set.count : AdjacentLeaves::capacity + 1;
  memcpy(n.leaf, set.leaf, set.count * sizeof(u32));
}

// ---------------------------------------------------------------- tree

void box_nodes(FaceTree& tree, u32 level) {
  const u32 below = tree.level_first[level - 1], at = tree.level_first[level];
  for (u32 i = 0; i < tree.level_size[level]; ++i)
    for (u32 k = 0; k < 3; ++k) {
      const f32 *low = tree.node.low[k] + below + tree_branching * i,
                *high = tree.node.high[k] + below + tree_branching * i;
      tree.node.low[k][at + i] = least_of(min4(load4(low), load4(low + 4)));
      tree.node.high[k][at + i] = largest_of(max4(load4(high), load4(high + 4)));
    }
}

// Fills the last row of eight of a level with empty boxes, since rows are read as a whole.
void fill_row(FaceTree& tree, u32 level) {
  for (u32 i = tree.level_size[level]; i % tree_branching != 0; ++i)
    for (u32 k = 0; k < 3; ++k) {
      tree.node.low[k][tree.level_first[level] + i] = FLT_MAX;
      tree.node.high[k][tree.level_first[level] + i] = -FLT_MAX;
    }
}

void build_tree(FaceTree& tree) {
  tree.levels = 1;
  tree.level_first[0] = 0;
  tree.level_size[0] = tree.count;
  fill_row(tree, 0);
  while (tree.level_size[tree.levels - 1] > tree_branching) {
    const u32 l = tree.levels++;
    tree.level_first[l] = tree.level_first[l - 1] + static_cast<u32>(up(tree.level_size[l - 1], tree_branching));
    tree.level_size[l] = static_cast<u32>(chunks_of(tree.level_size[l - 1], tree_branching));
    box_nodes(tree, l);
    fill_row(tree, l);
  }
}

}  // namespace

u64 face_tree_bytes(u64 vertices, u64 faces) {
  FaceTree tree;
  return lay_out(nullptr, vertices, faces, tree).all;
}

u64 search_tree_bytes(u64 vertices, u64 faces) {
  FaceTree tree;
  return lay_out(nullptr, vertices, faces, tree).searched;
}

FaceTree open_face_tree(u8* memory, u32 vertices, u32 faces) {
  FaceTree tree;
  lay_out(memory, vertices, faces, tree);
  return tree;
}

Box flat_box(const Frame& frame, const Vec3& low, const Vec3& high) {
  const D2 farthest = all2(farthest_flat);
  const auto flat = [&](const D2& at, const D2& middle) {
    return max2(-farthest, min2(farthest, all2(frame.scale) * (at - middle)));
  };
#if defined(TPA_VECTORS)
  const auto flat_point = [&](const Vec3& p) {
    return nearest4(flat(load2(&p.x), load2(&frame.middle.x)), flat(all2(p.z), all2(frame.middle.z)));
  };
  return box_between(flat_point(low), flat_point(high));
#else
  Box b;
  for (int i = 0; i < 3; ++i) {
    const D2 within = flat(D2{low[i], high[i]}, all2(frame.middle[i]));
    b.low[i] = static_cast<f32>(within[0]), b.high[i] = static_cast<f32>(within[1]);
  }
  return b;
#endif
}

void arrange(FaceTree& tree, const Mesh& m, const Exec& exec) {
  spend(exec.meter, 2 * u64{m.face_count});
  make_points(tree, m, exec);
  grow_buds(m, tree.point, exec, tree.buds, tree.leaf_of);
  tree.has_hubs = false;
  make_leaves(tree, m, exec);
  const bool fetches = needs_fetching(m);
  for_chunks(exec, tree.count, leaf_chunk, [&](u32 first, u32 last) {
    for (u32 i = first; i < last; ++i) {
      if (fetches) fetch_rows(tree, m, i + 2, last), fetch_points(tree, m, i + 1, last);
      find_adjacent(tree, m, i);
      find_hub(tree, m, i);
      box_leaf(tree, m, i, tree.first[last]);
    }
  });
  build_tree(tree);
}

void corners_of_four(const FaceTree& tree, const Mesh& m, const u32 (&place)[4], F4 (&corner)[3][3]) {
  F4 p[3][4];
#pragma GCC unroll 4
  for (u32 i = 0; i < 4; ++i) {
    const u32* v = m.corner + 3 * static_cast<size_t>(face_at(tree, place[i]));
#pragma GCC unroll 3
    for (u32 k = 0; k < 3; ++k) p[k][i] = load4(tree.point + 3 * static_cast<size_t>(v[k]));
  }
#pragma GCC unroll 3
  for (u32 k = 0; k < 3; ++k) {
    transpose(p[k][0], p[k][1], p[k][2], p[k][3]);
#pragma GCC unroll 3
    for (u32 i = 0; i < 3; ++i) corner[k][i] = p[k][i];
  }
}

}  // namespace tpa
