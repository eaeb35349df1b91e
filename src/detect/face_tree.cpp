#include "detect/face_tree.h"

#include <float.h>

#include "base/sort.h"
#include "geometry/morton.h"

namespace tpa {

namespace {

// The work of one task. Bounds do not depend on the number of threads.
constexpr u32 vertex_chunk = 1u << 14, cluster_chunk = 1u << 7;

constexpr u32 most_tasks = 16;

constexpr u64 up(u64 x, u64 multiple) { return (x + multiple - 1) / multiple * multiple; }
constexpr u64 chunks_of(u64 n, u64 chunk) { return (n + chunk - 1) / chunk; }
// All clusters but the last one have as many faces as a patch that stays alone.
constexpr u64 most_clusters(u64 faces) { return faces / fewest_in_patch + 1; }
constexpr u64 most_nodes(u64 faces) {
  u64 nodes = 0;
  for (u64 n = most_clusters(faces);; n = chunks_of(n, tree_branching)) {
    nodes += up(n, tree_branching);
    if (n <= tree_branching) return nodes;
  }
}

struct Bytes {
  u64 searched, all;
};
Bytes cut(u8* memory, u64 vertices, u64 faces, FaceTree& c) {
  const u64 clusters = most_clusters(faces);
  Carver carver{memory};
  carver.take(c.place, faces);
  carver.take(c.face, faces);
  carver.take(c.first, clusters + 1);
  carver.take(c.end, clusters);
  // The order is over before there are boxes, neighbours and outlines, and all of detection before places are noted.
  c.cluster_of = c.place;
  Carver order = carver;
  lay_out_patches(order, faces, c.patches);
  order.take(c.item, most_patches(faces));
  order.take(c.unsorted, most_patches(faces));
  for (u32 i = 0; i < 3; ++i) {
    carver.take(c.box.low[i], faces + bytes_in_lanes);
    carver.take(c.box.high[i], faces + bytes_in_lanes);
  }
  carver.take(c.byte_frame, clusters);
  for (u32 i = 0; i < 3; ++i) {
    carver.take(c.node.low[i], most_nodes(faces));
    carver.take(c.node.high[i], most_nodes(faces));
  }
  carver.take(c.row_cluster, faces / places_in_row + 1);
  const u64 searched = carver.bytes;
  carver.take(c.neighbours, clusters);
  carver.take(c.outline, clusters);
  carver.bytes = max_of(carver.bytes, order.bytes);
  carver.take(c.point, 3 * vertices + 1);
  return {searched, carver.bytes};
}

// Runs task(t, first, last) on ranges of 0 .. n-1. Nothing may depend on their number: there is one where there are no
// threads.
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

// Two vertices at a time, their six numbers in three pairs.
Bounds bounds_of(const Vec3* position, u32 count) {
  static_assert(sizeof(Vec3) == 3 * sizeof(f64));
  D2 low[3] = {all2(DBL_MAX), all2(DBL_MAX), all2(DBL_MAX)}, high[3] = {-low[0], -low[1], -low[2]};
  for (u32 v = 0; v + 2 <= count; v += 2)
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

void make_points(FaceTree& c, const Mesh& m, const Exec& exec) {
  const Frame frame = c.frame = frame_of(m, exec);
  for_chunks(exec, m.vertex_count, vertex_chunk, [&](u32 first, u32 last) {
    for (u32 v = first; v < last; ++v) {
      const Vec3 p = frame.scale * (m.position[v] - frame.middle);
      f32* point = c.point + 3 * static_cast<size_t>(v);
      point[0] = static_cast<f32>(p.x), point[1] = static_cast<f32>(p.y), point[2] = static_cast<f32>(p.z);
    }
  });
  c.point[3 * static_cast<size_t>(m.vertex_count)] = 0;
}

// ---------------------------------------------------------------- order

// An item: a leading patch, and where it lies.
constexpr u32 patch_bits = 64 - 3 * curve_bits;
u32 patch_of_item(u64 item) { return static_cast<u32>(item & ((u64{1} << patch_bits) - 1)); }

// Parts of the curve, each the same part of space.
constexpr u32 part_bits = 9, curve_parts = 1u << part_bits;
u32 part_of_item(u64 item) { return static_cast<u32>(item >> (64 - part_bits)); }

// A patch lies where its first corner does. Items are dealt out to the parts of the curve, in any order, and each part
// is sorted then.
u32 sort_patches(FaceTree& c, const Mesh& m, const Exec& exec) {
  const Patches& p = c.patches;
  u32 end[curve_parts] = {}, leaders[most_zones];
  for_chunks(exec, p.zones, 1, [&](u32 z, u32) {
    u32 n = 0;
    for (u32 i = p.start[z]; i < p.start[z] + p.count[z]; ++i) {
      if (p.leader[i] != i) continue;
      const u32 vertex = m.corner[3 * static_cast<size_t>(p.face[p.first[i]])];
      const u64 item = place_on_curve(c.point + 3 * static_cast<size_t>(vertex)) << patch_bits | i;
      __atomic_fetch_add(end + part_of_item(item), 1, __ATOMIC_RELAXED);
      c.unsorted[p.start[z] + n++] = item;
    }
    leaders[z] = n;
  });
  u32 all = 0;
  for (u32& part : end) {
    const u32 count = part;
    part = all;  // for now, where it begins
    all += count;
  }
  for_chunks(exec, p.zones, 1, [&](u32 z, u32) {
    for (u32 i = p.start[z]; i < p.start[z] + leaders[z]; ++i)
      c.item[__atomic_fetch_add(end + part_of_item(c.unsorted[i]), 1, __ATOMIC_RELAXED)] = c.unsorted[i];
  });
  for_chunks(exec, curve_parts, curve_parts / most_tasks, [&](u32 first, u32 last) {
    for (u32 i = first; i < last; ++i) {
      const u32 begin = i == 0 ? 0 : end[i - 1];
      sort_in_place(c.item + begin, end[i] - begin);
    }
  });
  return all;
}

// The faces of a patch and of those that have joined it, from a place on.
void put_patches(FaceTree& c, u32 patch, u32 cluster, u32 place) {
  const Patches& p = c.patches;
  u32* const cluster_of = c.cluster_of;
  for (; patch != none; patch = p.following[patch]) {
    const u32* face = p.face + p.first[patch];
    const u32 count = p.first[patch + 1] - p.first[patch];
    memcpy(c.face + place, face, count * sizeof(u32));
    for (u32 i = 0; i < count; ++i) cluster_of[face[i]] = cluster;
    place += count;
  }
}

// Patches that are too small go together. `end` is, for now, the item behind those of a cluster.
void order_patches(FaceTree& c, const Mesh& m, const Exec& exec) {
  const u32 n = sort_patches(c, m, exec);
  c.faces = m.face_count;
  c.numbered = c.strays = c.count = c.places = c.first[0] = 0;
  for (u32 i = 0; i < n; ++i) {
    c.places += c.patches.size[patch_of_item(c.item[i])];
    if (c.places - c.first[c.count] < fewest_in_patch && i + 1 < n) continue;
    c.end[c.count] = i + 1;
    c.first[++c.count] = c.places;
  }
  for_chunks(exec, c.count, cluster_chunk, [&](u32 first, u32 last) {
    for (u32 k = first; k < last; ++k) {
      u32 place = c.first[k];
      for (u32 i = k == 0 ? 0 : c.end[k - 1]; i < c.end[k]; ++i) {
        const u32 patch = patch_of_item(c.item[i]);
        put_patches(c, patch, k, place);
        place += c.patches.size[patch];
      }
    }
  });
}

// ---------------------------------------------------------------- boxes

// Four faces: corners by axis, and twice the areas along each axis.
struct FourFaces {
  F4 corner[3][3];
  F4 normal[3];
};
// Most groups of four that a cluster has.
constexpr u32 most_groups = (most_in_cluster + 3) / 4;

// The boxes of all faces, and the one round them.
struct Bounds4 {
  F4 low[3][most_groups + 3], high[3][most_groups + 3];  // three more, as set_bounds() wants it
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

// The mean of the faces' normals, by area.
void set_normal(Outline& o, FourFaces* four, u32 groups) {
  F4 sum[3] = {};
  for (u32 g = 0; g < groups; ++g) {
    const auto& [a, b, d] = four[g].corner;
    F4 u[3], v[3];
    for (u32 k = 0; k < 3; ++k) u[k] = b[k] - a[k], v[k] = d[k] - a[k];
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

// `reach`: no face extends farther along an axis.
void set_extent(Outline& o, const FourFaces* four, u32 groups, f32 reach) {
  F4 low = all4(FLT_MAX), high = all4(-FLT_MAX), radius = all4(0), across = all4(0), largest = all4(0);
  I4 up{-1, -1, -1, -1};
  const f32 mx = o.middle[0], my = o.middle[1], mz = o.middle[2], nx = o.normal[0], ny = o.normal[1], nz = o.normal[2];
  for (u32 g = 0; g < groups; ++g) {
    const FourFaces& f = four[g];
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
    // Half of the roundings are left to the slope, which is a square yet.
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

// `end`: where the places of clusters end that are boxed after this one.
void box_cluster(FaceTree& c, const Mesh& m, u32 cluster, u32 end) {
  const u32 first = c.first[cluster], last = c.first[cluster + 1];
  FourFaces four[most_groups];
  u32 groups = 0;
  for (u32 at = first; at < last; at += 4) corners_of_four(c, m, at, last, four[groups++].corner);
  Outline& outline = c.outline[cluster];
  Bounds4 bounds;
  bound_faces(four, groups, bounds);
  const Box& box = bounds.all;
  const ByteFrame frame = c.byte_frame[cluster] = frame_round(box);
  for (u32 k = 0; k < 3; ++k) {
    // Places behind the cluster, up to `end`, are those of clusters boxed after it.
    set_bounds(frame, k, {bounds.low[k], groups}, c.box.low[k] + first, end - first);
    set_bounds(frame, k, {bounds.high[k], groups}, c.box.high[k] + first, end - first);
    c.node.low[k][cluster] = box.low[k], c.node.high[k][cluster] = box.high[k];
    outline.middle[k] = 0.5f * (box.low[k] + box.high[k]);
    outline.point[k] = (four[0].corner[0][k][0] + four[0].corner[1][k][0] + four[0].corner[2][k][0]) * (1.0f / 3);
  }
  set_normal(outline, four, groups);
  set_extent(outline, four, groups, extent_of(box));
}

// ---------------------------------------------------------------- neighbours

// What is read of the mesh for a cluster, while others are boxed: its rows first, and what these lead to when they have
// come. Inlined by force, as `fetch` is.
[[gnu::always_inline]] inline void fetch_rows(const FaceTree& c, const Mesh& m, u32 cluster, u32 last) {
  if (cluster >= last) return;
  for (u32 at = c.first[cluster]; at < c.first[cluster + 1]; ++at) {
    const size_t row = 3 * static_cast<size_t>(face_at(c, at));
    fetch(m.opposite + row);
    fetch(m.corner + row);
  }
}
[[gnu::always_inline]] inline void fetch_points(const FaceTree& c, const Mesh& m, u32 cluster, u32 last) {
  if (cluster >= last) return;
  for (u32 at = c.first[cluster]; at < c.first[cluster + 1]; ++at) {
    const size_t f = face_at(c, at);
    fetch(c.point + 3 * static_cast<size_t>(m.corner[3 * f]));
    fetch(c.cluster_of + f);
  }
}

// Which edges lead to others is as good as random: they are listed first, without a branch.
void find_neighbours(FaceTree& c, const Mesh& m, u32 cluster) {
  u32 beyond[3 * most_in_cluster + 1];
  u32 count = 0;
  for (u32 at = c.first[cluster]; at < c.first[cluster + 1]; ++at) {
    const u32* opposite = m.opposite + 3 * static_cast<size_t>(face_at(c, at));
    for (u32 i = 0; i < 3; ++i) {
      const u32 other = c.cluster_of[face_of(opposite[i])];
      beyond[count] = other;
      count += other == cluster ? 0 : 1;
    }
  }
  ClusterSet<Neighbours::capacity, 64> set;
  bool all = true;
  for (u32 i = 0; i < count; ++i) all = set.add(beyond[i]) && all;
  Neighbours& n = c.neighbours[cluster];
  n.count = all ? set.count : Neighbours::capacity + 1;
  memcpy(n.cluster, set.cluster, set.count * sizeof(u32));
}

// ---------------------------------------------------------------- tree

void box_nodes(FaceTree& c, u32 level) {
  const u32 below = c.level_first[level - 1], at = c.level_first[level];
  for (u32 i = 0; i < c.level_size[level]; ++i)
    for (u32 k = 0; k < 3; ++k) {
      const f32 *low = c.node.low[k] + below + tree_branching * i, *high = c.node.high[k] + below + tree_branching * i;
      c.node.low[k][at + i] = least_of(min4(load4(low), load4(low + 4)));
      c.node.high[k][at + i] = largest_of(max4(load4(high), load4(high + 4)));
    }
}

// Rows of eight are read as a whole: empty boxes fill the last one.
void fill_row(FaceTree& c, u32 level) {
  for (u32 i = c.level_size[level]; i % tree_branching != 0; ++i)
    for (u32 k = 0; k < 3; ++k) {
      c.node.low[k][c.level_first[level] + i] = FLT_MAX;
      c.node.high[k][c.level_first[level] + i] = -FLT_MAX;
    }
}

void build_tree(FaceTree& c) {
  c.levels = 1;
  c.level_first[0] = 0;
  c.level_size[0] = c.count;
  fill_row(c, 0);
  while (c.level_size[c.levels - 1] > tree_branching) {
    const u32 l = c.levels++;
    c.level_first[l] = c.level_first[l - 1] + static_cast<u32>(up(c.level_size[l - 1], tree_branching));
    c.level_size[l] = static_cast<u32>(chunks_of(c.level_size[l - 1], tree_branching));
    box_nodes(c, l);
    fill_row(c, l);
  }
}

}  // namespace

u64 face_tree_bytes(u64 vertices, u64 faces) {
  FaceTree c;
  return cut(nullptr, vertices, faces, c).all;
}

u64 search_tree_bytes(u64 vertices, u64 faces) {
  FaceTree c;
  return cut(nullptr, vertices, faces, c).searched;
}

FaceTree open_face_tree(u8* memory, u32 vertices, u32 faces) {
  FaceTree c;
  cut(memory, vertices, faces, c);
  return c;
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

void arrange(FaceTree& c, const Mesh& m, const Exec& exec) {
  make_points(c, m, exec);
  find_patches(m, c.point, exec, c.patches, c.cluster_of);
  order_patches(c, m, exec);
  const bool fetches = needs_fetching(m);
  for_chunks(exec, c.count, cluster_chunk, [&](u32 first, u32 last) {
    for (u32 i = first; i < last; ++i) {
      if (fetches) fetch_rows(c, m, i + 2, last), fetch_points(c, m, i + 1, last);
      find_neighbours(c, m, i);
      box_cluster(c, m, i, c.first[last]);
    }
  });
  build_tree(c);
}

void corners_of_four(const FaceTree& c, const Mesh& m, const u32 (&place)[4], F4 (&corner)[3][3]) {
  F4 p[3][4];
  for (u32 i = 0; i < 4; ++i) {
    const u32* v = m.corner + 3 * static_cast<size_t>(face_at(c, place[i]));
    for (u32 k = 0; k < 3; ++k) p[k][i] = load4(c.point + 3 * static_cast<size_t>(v[k]));
  }
  for (u32 k = 0; k < 3; ++k) {
    transpose(p[k][0], p[k][1], p[k][2], p[k][3]);
    for (u32 i = 0; i < 3; ++i) corner[k][i] = p[k][i];
  }
}

void face_tree_detail::search(const FaceTree& c, const Box& query, u32 from, Visitor visitor) {
  // A level and a node of it, written in one piece, as they are read.
  u64 stack[most_tree_levels * tree_branching];
  const auto entry = [](u32 level, u32 node) { return u64{level} << 32 | node; };
  u32 size = 0;
  const BroadBox q = broad(query);
  const ConstBoxLanes nodes = lanes_of(c.node);
  if (c.count > 0) stack[size++] = entry(c.levels - 1, 0);
  while (size > 0) {
    const u64 last = stack[--size];
    const u32 level = static_cast<u32>(last >> 32), node = static_cast<u32>(last);
    // The node's siblings with it are a row of eight; boxes beyond the end are empty.
    const u32 at = c.level_first[level] + node;
    u32 near = bits_of(lanes_meeting(nodes, at, q)) | bits_of(lanes_meeting(nodes, at + 4, q)) << 4;
    const u32 least = from >> tree_branching_bits * level;
    if (least > node) near &= 0xFFu << min_of(least - node, tree_branching);
    if (level == 0) {
      for (u32 rest = near; rest != 0; rest &= rest - 1)
        if (!visitor.visit(visitor.data, node + static_cast<u32>(__builtin_ctz(rest)))) return;
      continue;
    }
    while (near != 0) {
      const u32 i = 31 - static_cast<u32>(__builtin_clz(near));
      near ^= 1u << i;
      stack[size++] = entry(level - 1, tree_branching * (node + i));
    }
  }
}

}  // namespace tpa
