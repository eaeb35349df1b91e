#include "clusters.h"

#include <float.h>

namespace tpa {

namespace {

// The work of one task. Bounds do not depend on the number of threads.
constexpr u32 vertex_chunk = 1u << 14, place_chunk = 1u << 12;
constexpr u32 clusters_in_chunk = place_chunk / fewest_in_cluster;

constexpr u32 most_digit_bits = 11, most_tasks = 16;

constexpr u64 up(u64 x, u64 multiple) { return (x + multiple - 1) / multiple * multiple; }
constexpr u64 chunks_of(u64 n, u64 chunk) { return (n + chunk - 1) / chunk; }
constexpr u64 most_clusters(u64 faces) { return chunks_of(faces, place_chunk) * clusters_in_chunk; }
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
Bytes cut(u8* memory, u64 vertices, u64 faces, Clusters& c) {
  Carver carver{memory};
  carver.take(c.item, faces);
  // Four more than there are, so that whole vectors can be read. The sort is over before the boxes are made.
  const u64 lanes = faces + 4;
  Carver sort = carver;
  sort.take(c.other_item, faces);
  for (u32 i = 0; i < 3; ++i) {
    carver.take(c.box.low[i], lanes);
    carver.take(c.box.high[i], lanes);
  }
  for (u32 i = 0; i < 3; ++i) {
    carver.take(c.node.low[i], most_nodes(faces));
    carver.take(c.node.high[i], most_nodes(faces));
  }
  carver.take(c.first, most_clusters(faces) + 1);
  carver.take(c.end, most_clusters(faces));
  const u64 searched = carver.bytes;
  for (f32*& normal : c.normal) carver.take(normal, lanes);
  carver.take(c.point, 4 * vertices);
  carver.take(c.chunk_first, most_clusters(faces) + chunks_of(faces, place_chunk) + 1);
  carver.take(c.state, most_clusters(faces));
  carver.take(c.digit_count, u64{most_tasks} << most_digit_bits);
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

Frame frame_of(const Mesh& m, const Exec& exec) {
  Bounds part[most_tasks], b;
  for_tasks(exec, m.vertex_count, [&](u32 t, u32 first, u32 last) {
    Bounds mine;
    for (u32 v = first; v < last; ++v) mine.add(m.position[v], m.position[v]);
    part[t] = mine;
  });
  for (const Bounds& p : part) b.add(p.low, p.high);
  const Vec3 size = b.high - b.low;
  const f64 reach = max_of(size.x, max_of(size.y, size.z));
  f64 scale = 1;
  while (scale * reach > 1) scale *= 0.5;
  while (scale * reach <= 0.5 && reach > 0) scale *= 2;
  return {midpoint(b.low, b.high), 2 * scale * (1 - 0x1p-20)};
}

// x's bits, two apart.
constexpr u32 spread(u32 x) {
  x = (x | x << 16) & 0x030000FFu;
  x = (x | x << 8) & 0x0300F00Fu;
  x = (x | x << 4) & 0x030C30C3u;
  return (x | x << 2) & 0x09249249u;
}
constexpr u32 most_curve_bits = 10;

// Cells of about two edges' length for a surface that fills the frame as a sphere does: F triangles of edge h make an
// area of .43 F h^2, and the sphere's is 3.1 of its diameter squared. Finer ones cost passes of the sort, and do not
// make better clusters.
u32 curve_bits(u32 faces) {
  u32 bits = 2;
  while (bits < most_curve_bits && (u64{1} << 2 * bits) < u64{faces} / 28) ++bits;
  return bits;
}

void make_points(Clusters& c, const Mesh& m, u32 bits, const Exec& exec) {
  const Frame frame = c.frame = frame_of(m, exec);
  const f32 cells = static_cast<f32>(1u << (bits - 1)) * (1 - 0x1p-20f);
  for_chunks(exec, m.vertex_count, vertex_chunk, [&](u32 first, u32 last) {
    for (u32 v = first; v < last; ++v) {
      const Vec3 p = frame.scale * (m.position[v] - frame.middle);
      const f32 x = static_cast<f32>(p.x), y = static_cast<f32>(p.y), z = static_cast<f32>(p.z);
      const auto cell = [&](f32 t) { return spread(static_cast<u32>(static_cast<i32>((t + 1) * cells))); };
      const u32 place = cell(x) | cell(y) << 1 | cell(z) << 2;
      f32* point = c.point + 4 * static_cast<size_t>(v);
      point[0] = x, point[1] = y, point[2] = z;
      memcpy(point + 3, &place, sizeof place);
    }
  });
}

// ---------------------------------------------------------------- order

struct Digit {
  u32 shift, bits;
  u32 of(u64 item) const { return static_cast<u32>(item >> shift) & ((1u << bits) - 1); }
};

// Counting sort by one digit, stable.
void sort_by_digit(const u64* from, u64* to, u32 n, Digit digit, u32* count, const Exec& exec) {
  const u32 values = 1u << digit.bits, tasks = exec.parallel_for == nullptr ? 1 : most_tasks;
  for_tasks(exec, n, [&](u32 t, u32 first, u32 last) {
    u32* mine = count + (static_cast<size_t>(t) << most_digit_bits);
    memset(mine, 0, values * sizeof *mine);
    for (u32 i = first; i < last; ++i) ++mine[digit.of(from[i])];
  });
  u32 sum = 0;
  for (u32 d = 0; d < values; ++d)
    for (u32 t = 0; t < tasks; ++t) {
      u32& place = count[(static_cast<size_t>(t) << most_digit_bits) + d];
      const u32 here = place;
      place = sum;
      sum += here;
    }
  for_tasks(exec, n, [&](u32 t, u32 first, u32 last) {
    u32* mine = count + (static_cast<size_t>(t) << most_digit_bits);
    for (u32 i = first; i < last; ++i) to[mine[digit.of(from[i])]++] = from[i];
  });
}

u32 count_holes(const Mesh& m) {
  u32 holes = 0;
  for (u32 f = m.free_face; f != none; f = m.corner[3 * f + 1]) ++holes;
  return holes;
}

// A face lies where its first corner does; holes in the numbering lie beyond the last cell.
void order_faces(Clusters& c, const Mesh& m, u32 bits, const Exec& exec) {
  const u32 n = m.face_count, all_bits = 3 * bits + 1;
  const u32 passes = (all_bits + most_digit_bits - 1) / most_digit_bits;
  const u32 digit_bits = (all_bits + passes - 1) / passes;
  u64 *from = passes % 2 == 0 ? c.item : c.other_item, *to = passes % 2 == 0 ? c.other_item : c.item;
  for_chunks(exec, n, vertex_chunk, [&](u32 first, u32 last) {
    for (u32 f = first; f < last; ++f) {
      u32 place = 1u << 3 * bits;
      if (face_lives(m, f)) memcpy(&place, c.point + 4 * static_cast<size_t>(m.corner[3 * f]) + 3, sizeof place);
      from[f] = u64{place} << 32 | f;
    }
  });
  for (u32 p = 0; p < passes; ++p) {
    sort_by_digit(from, to, n, {32 + p * digit_bits, digit_bits}, c.digit_count, exec);
    swap_values(from, to);
  }
  c.faces = n;
  c.places = n - count_holes(m);
  c.numbered = 0;
}

// ---------------------------------------------------------------- boxes

// Twice the area that a triangle with sides u, v shows along axis x; y and z are the axes after it. In these units
// coordinates are off by 2^-25 at most, differences by 2^-24 and a rounding, so with components up to L <= 2 the result
// is off by less than 21 * 2^-24 L: less than an eighth of what passes.
F4 certain_normal(F4 uy, F4 uz, F4 vy, F4 vz, F4 reach) {
  const F4 n = uy * vz - uz * vy;
  return (F4)((abs4(n) > reach * 0x1p-16f) & (I4)n);
}

void place_boxes(Clusters& c, const Mesh& m, u32 at, u32 n) {
  F4 corner[3][4];
#pragma GCC unroll 4
  for (u32 i = 0; i < 4; ++i) {
    const u32* v = m.corner + 3 * static_cast<size_t>(face_at(c, at + min_of(i, n - 1)));
#pragma GCC unroll 3
    for (u32 k = 0; k < 3; ++k) corner[k][i] = load4(c.point + 4 * static_cast<size_t>(v[k]));
  }
  for (auto& p : corner) transpose(p[0], p[1], p[2], p[3]);
  const auto& [a, b, d] = corner;
  F4 u[3], v[3], reach = all4(0);
  const bool whole = n == 4;
  const auto put = [&](f32* to, F4 x) {
    if (whole)
      store4(to + at, x);
    else
      memcpy(to + at, &x, n * sizeof(f32));
  };
#pragma GCC unroll 3
  for (u32 i = 0; i < 3; ++i) {
    u[i] = b[i] - a[i];
    v[i] = d[i] - a[i];
    reach = max4(reach, max4(abs4(u[i]), abs4(v[i])));
    put(c.box.low[i], min4(a[i], min4(b[i], d[i])));
    put(c.box.high[i], max4(a[i], max4(b[i], d[i])));
  }
#pragma GCC unroll 3
  for (u32 i = 0; i < 3; ++i) {
    const u32 y = (i + 1) % 3, z = (i + 2) % 3;
    put(c.normal[i], certain_normal(u[y], u[z], v[y], v[z], reach));
  }
}

// ---------------------------------------------------------------- clusters

// Cuts a chunk of places where the curve leaves the largest cells. Returns the number of clusters; writes their first
// places.
u32 cut_chunk(const Clusters& c, u32 first, u32 last, u32* out) {
  u32 n = 0;
  for (u32 at = first; at < last;) {
    out[n++] = at;
    if (last - at <= most_in_cluster) break;
    u32 best = at + most_in_cluster;
    u64 step = 0;
    for (u32 i = at + fewest_in_cluster; i <= at + most_in_cluster; ++i) {
      const u64 here = (c.item[i - 1] ^ c.item[i]) >> 32;
      if (here >= step) {
        step = here;
        best = i;
      }
    }
    at = best;
  }
  return n;
}

void box_cluster(Clusters& c, u32 cluster) {
  const u32 first = c.first[cluster], last = c.first[cluster + 1];
  for (u32 k = 0; k < 3; ++k) {
    F4 low = all4(FLT_MAX), high = all4(-FLT_MAX);
    u32 i = first;
    for (; i + 4 <= last; i += 4) {
      low = min4(low, load4(c.box.low[k] + i));
      high = max4(high, load4(c.box.high[k] + i));
    }
    f32 least = least_of(low), largest = largest_of(high);
    for (; i < last; ++i) {
      least = min_of(least, c.box.low[k][i]);
      largest = max_of(largest, c.box.high[k][i]);
    }
    c.node.low[k][cluster] = least;
    c.node.high[k][cluster] = largest;
  }
}

void cut_clusters(Clusters& c, const Exec& exec) {
  const u32 chunks = static_cast<u32>(chunks_of(c.places, place_chunk));
  u32* sizes = c.chunk_first;
  u32* cuts = c.chunk_first + chunks + 1;
  for_chunks(exec, c.places, place_chunk, [&](u32 first, u32 last) {
    const u32 chunk = first / place_chunk;
    sizes[chunk] = cut_chunk(c, first, last, cuts + static_cast<size_t>(chunk) * clusters_in_chunk);
  });
  c.count = 0;
  for (u32 chunk = 0; chunk < chunks; ++chunk) {
    memcpy(c.first + c.count, cuts + static_cast<size_t>(chunk) * clusters_in_chunk, sizes[chunk] * sizeof(u32));
    c.count += sizes[chunk];
  }
  c.first[c.count] = c.places;
}

void box_nodes(Clusters& c, u32 level) {
  const u32 below = c.level_first[level - 1], at = c.level_first[level];
  for (u32 i = 0; i < c.level_size[level]; ++i)
    for (u32 k = 0; k < 3; ++k) {
      const f32 *low = c.node.low[k] + below + tree_branching * i, *high = c.node.high[k] + below + tree_branching * i;
      c.node.low[k][at + i] = least_of(min4(load4(low), load4(low + 4)));
      c.node.high[k][at + i] = largest_of(max4(load4(high), load4(high + 4)));
    }
}

// Rows of eight are read as a whole: empty boxes fill the last one.
void fill_row(Clusters& c, u32 level) {
  for (u32 i = c.level_size[level]; i % tree_branching != 0; ++i)
    for (u32 k = 0; k < 3; ++k) {
      c.node.low[k][c.level_first[level] + i] = FLT_MAX;
      c.node.high[k][c.level_first[level] + i] = -FLT_MAX;
    }
}

void build_tree(Clusters& c) {
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

u64 clusters_bytes(u64 vertices, u64 faces) {
  Clusters c;
  return cut(nullptr, vertices, faces, c).all;
}

u64 searched_bytes(u64 vertices, u64 faces) {
  Clusters c;
  return cut(nullptr, vertices, faces, c).searched;
}

Clusters open_clusters(u8* memory, u32 vertices, u32 faces) {
  Clusters c;
  cut(memory, vertices, faces, c);
  return c;
}

FlatBox flat_box(const Frame& frame, const Vec3& low, const Vec3& high) {
  FlatBox b;
  const auto flat = [&](f64 x, f64 middle) {
    return static_cast<f32>(max_of(-2.0, min_of(2.0, frame.scale * (x - middle))));
  };
  b.low[0] = flat(low.x, frame.middle.x), b.high[0] = flat(high.x, frame.middle.x);
  b.low[1] = flat(low.y, frame.middle.y), b.high[1] = flat(high.y, frame.middle.y);
  b.low[2] = flat(low.z, frame.middle.z), b.high[2] = flat(high.z, frame.middle.z);
  return b;
}

void arrange(Clusters& c, const Mesh& m, const Exec& exec) {
  const u32 bits = curve_bits(m.face_count);
  make_points(c, m, bits, exec);
  order_faces(c, m, bits, exec);
  for_chunks(exec, c.places, place_chunk, [&](u32 first, u32 last) {
    for (u32 i = first; i < last; i += 4) place_boxes(c, m, i, min_of(4u, last - i));
  });
  cut_clusters(c, exec);
  for_chunks(exec, c.count, 256, [&](u32 first, u32 last) {
    for (u32 i = first; i < last; ++i) box_cluster(c, i);
  });
  build_tree(c);
}

}  // namespace tpa
