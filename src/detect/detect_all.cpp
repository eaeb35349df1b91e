#include "detect/detect_all.h"

#include <float.h>

#include "detect/cull_clusters.h"
#include "detect/face_pair.h"

namespace tpa {

namespace {

// Some 2400 faces: a hundred microseconds of work and more, against the few that handing out a chunk costs. At most 64
// clusters, for a bit each.
constexpr u32 chunk = 64;

struct Search {
  const Mesh& m;
  const FaceTree& c;
  const u8* active;
  u8* star;
  ContactSink& sink;
};

// A cluster, and what is known of it, or of several with a common sheet.
struct Query {
  u32 cluster;
  bool active;  // some of their faces are
  bool judged = false, proven = false;
  Sheet sheet;
};

bool is_active(const Search& s, u32 face) { return s.active == nullptr || s.active[face] != 0; }

bool any_active(const Search& s, u32 cluster) {
  if (s.active == nullptr) return true;
  for (u32 i = s.c.first[cluster]; i < s.c.first[cluster + 1]; ++i)
    if (s.active[face_at(s.c, i)] != 0) return true;
  return false;
}

// Faces that those of a cluster are tested against, in lanes.
struct Batch {
  static constexpr u32 capacity = 192;
  u32 count = 0;
  u32 place[capacity];
  f32 low[3][capacity + 4], high[3][capacity + 4];
  f32 point[3][3][capacity + 4];  // by corner and axis
  i32 corner[3][capacity + 4];
  f32 reach = 0;  // largest extent of a box
  // Boxes of four faces each.
  static constexpr u32 group = 4, groups = capacity / group;
  f32 group_low[3][groups + 4], group_high[3][groups + 4];
};

// The box round all, too.
FlatBox box_groups(Batch& b) {
  FlatBox all{};
  for (u32 k = 0; k < 3; ++k) {
    F4 low = all4(FLT_MAX), high = all4(-FLT_MAX);
    for (u32 i = b.count; i < b.count + 4; ++i) {
      b.low[k][i] = FLT_MAX;
      b.high[k][i] = -FLT_MAX;
    }
    for (u32 at = 0; at < b.count; at += Batch::group) {
      const F4 group_low = load4(b.low[k] + at), group_high = load4(b.high[k] + at);
      b.group_low[k][at / Batch::group] = least_of(group_low);
      b.group_high[k][at / Batch::group] = largest_of(group_high);
      low = min4(low, group_low);
      high = max4(high, group_high);
    }
    all.low[k] = least_of(low);
    all.high[k] = largest_of(high);
  }
  return all;
}

// Adds a face.
void add(const Search& s, u32 place, Batch& b) {
  const FaceTree& c = s.c;
  const u32* v = s.m.corner + 3 * static_cast<size_t>(face_at(c, place));
  const u32 at = b.count++;
  b.place[at] = place;
  for (u32 i = 0; i < 3; ++i) {
    memcpy(&b.corner[i][at], v + i, sizeof(u32));
    const f32* point = c.point + 3 * static_cast<size_t>(v[i]);
    for (u32 k = 0; k < 3; ++k) b.point[i][k][at] = point[k];
  }
  for (u32 k = 0; k < 3; ++k) {
    const f32 x = b.point[0][k][at], y = b.point[1][k][at], z = b.point[2][k][at];
    b.low[k][at] = min_of(x, min_of(y, z));
    b.high[k][at] = max_of(x, max_of(y, z));
    b.reach = max_of(b.reach, b.high[k][at] - b.low[k][at]);
  }
}

// One face against four at a time.
struct Probe {
  BroadBox box;
  I4 corner[3];  // where the star is proven unfolded: faces that share it do not meet
  F4 origin[3], normal[3];
  F4 bound;
};

FlatBox face_box(const Search& s, u32 place) {
  const u32* v = s.m.corner + 3 * static_cast<size_t>(face_at(s.c, place));
  const F4 x = load4(s.c.point + 3 * static_cast<size_t>(v[0])), y = load4(s.c.point + 3 * static_cast<size_t>(v[1])),
           z = load4(s.c.point + 3 * static_cast<size_t>(v[2])), low = min4(x, min4(y, z)), high = max4(x, max4(y, z));
  return box_between(low, high);
}

// `share`: may it share vertices with a face of the batch?
Probe probe_of(const Search& s, u32 place, bool share, f32 batch_reach) {
  const FaceTree& c = s.c;
  Probe p;
  const FlatBox box = face_box(s, place);
  p.box = broad(box);
  const u32* v = s.m.corner + 3 * static_cast<size_t>(face_at(c, place));
  const f32* at[3];
  for (u32 i = 0; i < 3; ++i) {
    const i32 id = share && star_proven(s.m, s.star, v[i]) ? static_cast<i32>(v[i]) : -1;
    p.corner[i] = I4{id, id, id, id};
    at[i] = c.point + 3 * static_cast<size_t>(v[i]);
  }
  f32 a[3], b[3];
  for (u32 k = 0; k < 3; ++k) {
    p.origin[k] = all4(at[0][k]);
    a[k] = at[1][k] - at[0][k];
    b[k] = at[2][k] - at[0][k];
  }
  for (u32 k = 0; k < 3; ++k) {
    const u32 y = (k + 1) % 3, z = (k + 2) % 3;
    p.normal[k] = all4(a[y] * b[z] - a[z] * b[y]);
  }
  // Boxes that meet reach no farther than both extents together. Each difference is off by 2^-24 (1 + reach), which
  // makes 18 reach^2 times that in the six products of three differences, and their roundings 30 * 2^-24 reach^3.
  const f32 reach = (extent_of(box) + batch_reach) * (1 + 0x1p-20f);
  p.bound = all4(0x1p-24f * (reach * reach) * (20 + 50 * reach));
  return p;
}

// Which of the faces at .. at + 3 of the batch may meet the probe.
u32 lanes_left(const Probe& p, const Batch& b, u32 at) {
  const ConstBoxLanes boxes{{b.low[0], b.low[1], b.low[2]}, {b.high[0], b.high[1], b.high[2]}};
  const u32 left = first_bits_of(lanes_meeting(boxes, at, p.box), b.count - at);
  if (left == 0) return 0;
  I4 shared{}, above{-1, -1, -1, -1}, below = above;
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
  return left & ~bits_of(shared | above | below);
}

// Pairs within the cluster are met from both sides: the first face sees to the pair.
bool is_seen_to(u32 first, u32 mine, u32 other) { return other - first <= mine - first; }

// A face of the cluster against those at `from` and the three after it.
void test_group(Search& s, u32 first, u32 mine, const Probe& probe, const Batch& batch, u32 from) {
  const u32 f = face_at(s.c, mine);
  for (u32 rest = lanes_left(probe, batch, from); rest != 0; rest &= rest - 1) {
    const u32 other = batch.place[from + static_cast<u32>(__builtin_ctz(rest))];
    if (is_seen_to(first, mine, other)) continue;
    const u32 g = face_at(s.c, other);
    // The plane of g is asked first: that of f has left g on both sides.
    if ((is_active(s, f) || is_active(s, g)) && faces_meet(s.m, g, f)) s.sink.add(f, g);
  }
}

// A face of the cluster against the groups from that one on whose boxes meet its own.
void test_groups(Search& s, const Query& q, u32 mine, const Batch& batch, u32 seen_to) {
  const ConstBoxLanes boxes{{batch.group_low[0], batch.group_low[1], batch.group_low[2]},
                            {batch.group_high[0], batch.group_high[1], batch.group_high[2]}};
  const u32 groups = (batch.count + Batch::group - 1) / Batch::group;
  const BroadBox box = broad(face_box(s, mine));
  Probe probe;
  bool known = false;
  for_each_meeting(boxes, seen_to / Batch::group, groups, box, [&](u32 group) {
    if (!known) probe = probe_of(s, mine, !q.proven, batch.reach);
    known = true;
    test_group(s, s.c.first[q.cluster], mine, probe, batch, Batch::group * group);
    return true;
  });
}

void test_batch(Search& s, const Query& q, Batch& batch) {
  if (batch.count == 0) return;
  const ByteBox all = byte_box(s.c.byte_frame[q.cluster], box_groups(batch));
  const u32 first = s.c.first[q.cluster];
  u32 seen_to = 0;  // so many faces of the batch
  for_each_meeting(s.c.box, first, s.c.first[q.cluster + 1], all, [&](u32 mine) {
    while (seen_to < batch.count && is_seen_to(first, mine, batch.place[seen_to])) ++seen_to;
    test_groups(s, q, mine, batch, seen_to);
    return true;
  });
  batch.count = 0;
  batch.reach = 0;
}

// Is b on one side of all of a, or a on one of b? Along a's normal b reaches as far from its plane as its thickness
// does, and its radius as far as the normals differ. All roundings make 24 * 2^-24 of the lengths together at most,
// those of points another 2 * 2^-24: half of the margin.
I4 lie_aside(const FourOutlines& a, const FourOutlines& b) {
  F4 above_a = -a.level, above_b = -b.level, size{}, cosine{}, sine_a{}, sine_b{};
  for (u32 k = 0; k < 3; ++k) {
    const F4 d = b.middle[k] - a.middle[k];
    above_a += a.normal[k] * d;
    above_b -= b.normal[k] * d;
    size += abs4(d);
    cosine += a.normal[k] * b.normal[k];
  }
  above_a += cosine * b.level;
  above_b += cosine * a.level;
  for (u32 k = 0; k < 3; ++k) {
    const F4 beside_b = a.normal[k] - cosine * b.normal[k], beside_a = b.normal[k] - cosine * a.normal[k];
    sine_a += beside_b * beside_b;
    sine_b += beside_a * beside_a;
  }
  cosine = abs4(cosine);
  const F4 margin = 0x1p-22f + 0x1p-18f * (size + a.radius + b.radius);
  return (abs4(above_a) > a.thickness + b.thickness * cosine + b.radius * root4(sine_a) + margin) |
         (abs4(above_b) > b.thickness + a.thickness * cosine + a.radius * root4(sine_b) + margin);
}

// Is nothing to be tested between the cluster and another one?
bool passes_over(const Search& s, Query& q, u32 other) {
  if (!q.active && !any_active(s, other)) return true;
  if (!q.judged) q.proven = find_sheet(s.c, s.m, q.cluster, q.sheet);
  q.judged = true;
  return q.proven && q.sheet.has(other);
}

// FaceTree whose boxes meet that of the query, then those of their faces that may meet it.
struct Near {
  static constexpr u32 most_clusters = 128, most_faces = 256;
  u32 clusters = 0, faces = 0;
  u32 cluster[most_clusters], face[most_faces];
};

// Leaves out clusters that are aside.
void leave_out_aside(const FaceTree& c, u32 cluster, Near& near) {
  const FourOutlines mine = outlines_of(c, {cluster, cluster, cluster, cluster});
  u32 left = 0;
  for (u32 at = 0; at < near.clusters; at += 4) {
    const Four others = four_of(near.cluster, at, near.clusters);
    for (u32 rest = first_bits_of(~lie_aside(mine, outlines_of(c, others.at)), near.clusters - at); rest != 0;
         rest &= rest - 1)
      near.cluster[left++] = others.at[__builtin_ctz(rest)];
  }
  near.clusters = left;
}

// Which of four faces do not lie on one side of all of a cluster? Heights are off by 14 * 2^-24, since differences are
// up to 2, the slab by 11, points by 2, and sums by 5: half of what is allowed.
I4 reach_into(const Outline& o, const F4 (&corner)[3][3]) {
  F4 low = all4(FLT_MAX), high = all4(-FLT_MAX);
  for (u32 i = 0; i < 3; ++i) {
    F4 height{};
    for (u32 k = 0; k < 3; ++k) height += o.normal[k] * (corner[i][k] - o.middle[k]);
    low = min4(low, height);
    high = max4(high, height);
  }
  const f32 reach = o.thickness + 0x1p-18f;
  return at_most(low, all4(o.level + reach)) & at_most(all4(o.level - reach), high);
}

void test_near_faces(Search& s, const Query& q, Near& near, Batch& batch) {
  for (u32 i = 0; i < near.faces; ++i) {
    const u32* v = s.m.corner + 3 * static_cast<size_t>(face_at(s.c, near.face[i]));
    for (u32 k = 0; k < 3; ++k) fetch(s.c.point + 3 * static_cast<size_t>(v[k]));
  }
  for (u32 at = 0; at < near.faces; at += 4) {
    const Four four = four_of(near.face, at, near.faces);
    F4 corner[3][3];
    corners_of_four(s.c, s.m, four.at, corner);
    for (u32 rest = first_bits_of(reach_into(s.c.outline[q.cluster], corner), near.faces - at); rest != 0;
         rest &= rest - 1) {
      if (batch.count == Batch::capacity) test_batch(s, q, batch);
      add(s, four.at[__builtin_ctz(rest)], batch);
    }
  }
  near.faces = 0;
}

void test_near_clusters(Search& s, const Query& q, const FlatBox& bounds, Near& near, Batch& batch) {
  const FaceTree& c = s.c;
  leave_out_aside(c, q.cluster, near);
  for (u32 k = 0; k < near.clusters; ++k) {
    if (near.faces + most_in_cluster > Near::most_faces) test_near_faces(s, q, near, batch);
    const ByteBox box = byte_box(c.byte_frame[near.cluster[k]], bounds);
    for_each_meeting(c.box, c.first[near.cluster[k]], c.first[near.cluster[k] + 1], box, [&](u32 place) {
      fetch(s.m.corner + 3 * static_cast<size_t>(face_at(c, place)));
      near.face[near.faces++] = place;
      return true;
    });
  }
  test_near_faces(s, q, near, batch);
  near.clusters = 0;
}

// Several clusters, one and others round it that lean little from it. More at once are not proven sooner each, and
// where they lean more, fewer are proven at all (docs/performance.md).
struct Together {
  static constexpr u32 most = 10;
  u32 count = 0;
  u32 cluster[most + 1];  // one more is written than is counted
};
constexpr f32 little = 0.9f;  // the cosine

bool lean_little(const Outline& a, const Outline& b) {
  return a.normal[0] * b.normal[0] + a.normal[1] * b.normal[1] + a.normal[2] * b.normal[2] > little;
}

// Does the surface hardly bend there? If not, it does not in more than a cluster either.
bool neighbours_lean_little(const FaceTree& c, u32 cluster) {
  const Neighbours& n = c.neighbours[cluster];
  for (u32 i = 0; i < min_of(n.count, Neighbours::capacity); ++i)
    if (!lean_little(c.outline[cluster], c.outline[n.cluster[i]])) return false;
  return true;
}

// The first of the chunk's clusters that are left, by bit, and what is reached from it over edges of those that are.
Together take_together(const FaceTree& c, u32 chunk_first, u64& left) {
  Together t;
  t.cluster[t.count++] = chunk_first + static_cast<u32>(__builtin_ctzll(left));
  left &= left - 1;
  if (!neighbours_lean_little(c, t.cluster[0])) return t;
  const Outline& first = c.outline[t.cluster[0]];
  // Which of the neighbours are left is as good as random, so nothing branches on it.
  for (u32 k = 0; k < t.count; ++k) {
    const Neighbours& n = c.neighbours[t.cluster[k]];
    for (u32 i = 0; i < min_of(n.count, Neighbours::capacity) && t.count < Together::most; ++i) {
      const u32 bit = n.cluster[i] - chunk_first;
      const u64 is_left = bit < chunk ? left >> (bit % chunk) & 1 : 0;
      const u64 taken = is_left & (lean_little(first, c.outline[n.cluster[i]]) ? 1 : 0);
      left &= ~(taken << (bit % chunk));
      t.cluster[t.count] = n.cluster[i];
      t.count += static_cast<u32>(taken);
    }
  }
  return t;
}

FlatBox box_round(const FaceTree& c, Span<const u32> some) {
  FlatBox b = node_box(c, some[0]);
  for (u32 i : some) b = united(b, node_box(c, i));
  return b;
}

// FaceTree near some, with their boxes.
struct Around {
  u32 count = 0;
  u32 cluster[Near::most_clusters];
  f32 low[3][Near::most_clusters + 4], high[3][Near::most_clusters + 4];

  void add(const FaceTree& c, u32 other) {
    for (u32 k = 0; k < 3; ++k) low[k][count] = c.node.low[k][other], high[k][count] = c.node.high[k][other];
    cluster[count++] = other;
  }
};

// Each of some clusters against those around. A pair of clusters is seen to by the first one.
void test_around(Search& s, Query& q, Span<const u32> some, Around& around) {
  const ConstBoxLanes boxes{{around.low[0], around.low[1], around.low[2]},
                            {around.high[0], around.high[1], around.high[2]}};
  Near near;
  Batch batch;
  for (u32 cluster : some) {
    q.cluster = cluster;
    const FlatBox box = node_box(s.c, cluster);
    const BroadBox bounds = broad(box);
    for (u32 at = 0; at < around.count; at += 4)
      for (u32 rest = first_bits_of(lanes_meeting(boxes, at, bounds), around.count - at); rest != 0; rest &= rest - 1) {
        const u32 other = around.cluster[at + static_cast<u32>(__builtin_ctz(rest))];
        near.cluster[near.clusters] = other;
        near.clusters += other >= cluster ? 1 : 0;
      }
    test_near_clusters(s, q, box, near, batch);
    test_batch(s, q, batch);
  }
  around.count = 0;
}

// All pairs of some clusters, the first one the lowest: of one, or of several whose common sheet is known.
void search_round(Search& s, Query& q, Span<const u32> some) {
  Around around;
  for_each_cluster_near(s.c, box_round(s.c, some), some[0], [&](u32 other) {
    if (passes_over(s, q, other)) return true;
    if (around.count == Near::most_clusters) test_around(s, q, some, around);
    around.add(s.c, other);
    return true;
  });
  if (around.count > 0) test_around(s, q, some, around);
}

void search_together(Search& s, const Together& t) {
  Query q;
  u32 active = 0;  // by bit
  for (u32 i = 0; i < t.count; ++i) active |= (any_active(s, t.cluster[i]) ? 1u : 0u) << i;
  q.active = active != 0;
  // Where nothing is active, most clusters need no proof.
  q.judged = q.proven = t.count > 1 && q.active && find_common_sheet(s.c, s.m, {t.cluster, t.count}, q.sheet);
  if (q.proven) return search_round(s, q, {t.cluster, t.count});
  for (u32 i = 0; i < t.count; ++i) {
    q.cluster = t.cluster[i];
    q.active = (active >> i & 1) != 0;
    q.judged = q.proven = false;
    search_round(s, q, {t.cluster + i, 1});
  }
}

// Fetches what the proof of the next clusters begins with: boxes, and the corners of faces round the middle of the
// first one. Inlined by force, as `fetch` is.
[[gnu::always_inline]] inline void fetch_cluster(const Search& s, u32 cluster) {
  const FaceTree& c = s.c;
  const u32 first = c.first[cluster], last = c.first[cluster + 1];
  for (u32 k = 0; k < 3; ++k) {
    fetch(c.box.low[k] + first);
    fetch(c.box.high[k] + first);
  }
  for (u32 i = first; i < min_of(first + 8, last); ++i) {
    const u32* v = s.m.corner + 3 * static_cast<size_t>(face_at(c, i));
    for (u32 k = 0; k < 3; ++k) fetch(c.point + 3 * static_cast<size_t>(v[k]));
  }
}

void search_chunk(Search& s, u32 first, u32 last) {
  const bool fetches = needs_fetching(s.m);
  for (u64 left = ~u64{0} >> (64 - (last - first)); left != 0;) {
    const Together t = take_together(s.c, first, left);
    if (left != 0 && fetches) fetch_cluster(s, first + static_cast<u32>(__builtin_ctzll(left)));
    search_together(s, t);
  }
}

}  // namespace

void detect_complete(const Mesh& m, FaceTree& c, const u8* active, u8* star, const Exec& exec, Detection& out) {
  out.pairs.clear();
  arrange(c, m, exec);
  ContactSink sink{out};
  Search s{m, c, active, star, sink};
  for_chunks(exec, c.count, chunk, [&](u32 first, u32 last) { search_chunk(s, first, last); });
  memset(star, 0, m.vertex_count);
  sink.finish();
}

}  // namespace tpa
