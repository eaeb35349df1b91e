// SPDX-License-Identifier: MIT
#include "detect/detect_all.h"

#include <float.h>

#include "detect/cull_leaves.h"
#include "detect/face_pair.h"
#include "geometry/parting_axes.h"

namespace tpa {

namespace {

// Leaves of a task, a bit for each: some 2400 faces, enough work to make the cost of a task negligible.
constexpr u32 chunk = 64;

struct CompleteSearch {
  const Mesh& m;
  const FaceTree& tree;
  const u8* active;
  u8* star;
  ContactSink& sink;
  struct LeafRoom& room;  // of this task
  Meter* meter;
  u64 units = 0;  // since the last look at the meter

  bool goes_on() {
    spend(meter, units);
    units = 0;
    return !has_stopped(meter);
  }
};

// Units of work.
constexpr u64 of_leaf = 24, of_leaf_near = 2, of_group = 1;

// A leaf in turn, with the neighbourhood of the leaf, or of several leaves together. `judged`: a proof was tried.
struct Query {
  u32 leaf;
  bool active;  // some faces are
  bool judged, proven;
  Neighbourhood neighbourhood;
};

bool is_active(const CompleteSearch& s, u32 face) { return s.active == nullptr || s.active[face] != 0; }

bool any_active(const CompleteSearch& s, u32 leaf) {
  if (s.active == nullptr) return true;
  for (u32 i = s.tree.first[leaf]; i < s.tree.first[leaf + 1]; ++i)
    if (s.active[face_at(s.tree, i)] != 0) return true;
  return false;
}

// Faces to be tested against the faces of a leaf, in lanes.
struct Batch {
  static constexpr u32 capacity = 192;
  u32 count;
  u32 place[capacity];
  f32 low[3][capacity + 4], high[3][capacity + 4];
  f32 point[3][3][capacity + 4];  // by corner and axis
  i32 corner[3][capacity + 4];
  f32 reach;  // largest extent of a box
  // Boxes of four faces each.
  static constexpr u32 group = 4, groups = capacity / group;
  f32 group_low[3][groups + 4], group_high[3][groups + 4];
};

// Boxes the groups; returns the box round all.
Box box_groups(Batch& b) {
  Box all{};
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

void add(const CompleteSearch& s, u32 place, Batch& b) {
  const FaceTree& tree = s.tree;
  const u32* v = s.m.corner + 3 * static_cast<size_t>(face_at(tree, place));
  const u32 at = b.count++;
  b.place[at] = place;
  for (u32 i = 0; i < 3; ++i) {
    memcpy(&b.corner[i][at], v + i, sizeof(u32));
    const f32* point = tree.point + 3 * static_cast<size_t>(v[i]);
    for (u32 k = 0; k < 3; ++k) b.point[i][k][at] = point[k];
  }
  for (u32 k = 0; k < 3; ++k) {
    const f32 x = b.point[0][k][at], y = b.point[1][k][at], z = b.point[2][k][at];
    b.low[k][at] = min_of(x, min_of(y, z));
    b.high[k][at] = max_of(x, max_of(y, z));
    b.reach = max_of(b.reach, b.high[k][at] - b.low[k][at]);
  }
}

// A face in all lanes, against four faces of a batch at a time.
struct LaneProbe {
  BroadBox box;
  I4 vertex[3];  // -1, or a vertex with a proven star: faces with the vertex in common do not meet
  F4 origin[3];  // its first corner
  TriangleLanes face;
  PartingAxes axes;
  F4 doubt;  // of a point along an axis
};

Box face_box(const CompleteSearch& s, u32 place) {
  const u32* v = s.m.corner + 3 * static_cast<size_t>(face_at(s.tree, place));
  const F4 x = load4(s.tree.point + 3 * static_cast<size_t>(v[0])),
           y = load4(s.tree.point + 3 * static_cast<size_t>(v[1])),
           z = load4(s.tree.point + 3 * static_cast<size_t>(v[2])), low = min4(x, min4(y, z)),
           high = max4(x, max4(y, z));
  return box_between(low, high);
}

// `share`: may the face have a vertex in common with faces of the batch?
LaneProbe probe_of(const CompleteSearch& s, u32 place, bool share, f32 batch_reach) {
  const FaceTree& tree = s.tree;
  LaneProbe p;
  const Box box = face_box(s, place);
  p.box = broad(box);
  const u32* v = s.m.corner + 3 * static_cast<size_t>(face_at(tree, place));
  const f32* first = tree.point + 3 * static_cast<size_t>(v[0]);
  for (u32 k = 0; k < 3; ++k) p.origin[k] = all4(first[k]);
  for (u32 i = 0; i < 3; ++i) {
    const i32 id = share && star_proven(s.m, s.star, v[i]) ? static_cast<i32>(v[i]) : -1;
    p.vertex[i] = I4{id, id, id, id};
    const f32* at = tree.point + 3 * static_cast<size_t>(v[i]);
    for (u32 k = 0; k < 3; ++k) p.face.corner[i][k] = all4(at[k] - first[k]);
  }
  p.axes = parting_axes_of(p.face);
  // Boxes that meet reach no farther than both extents together.
  p.doubt = all4(parting_doubt((extent_of(box) + batch_reach) * (1 + 0x1p-20f)));
  return p;
}

// Lanes of the faces at .. at + 3 of the batch that may meet the probe.
u32 lanes_left(const LaneProbe& p, const Batch& b, u32 at) {
  const ConstBoxLanes boxes{{b.low[0], b.low[1], b.low[2]}, {b.high[0], b.high[1], b.high[2]}};
  u32 left = first_bits_of(lanes_meeting(boxes, at, p.box), b.count - at);
  if (left == 0) return 0;
  I4 shared{};
  for (u32 i = 0; i < 3; ++i) {
    I4 corner;
    memcpy(&corner, b.corner[i] + at, sizeof corner);
    shared |= (corner == p.vertex[0]) | (corner == p.vertex[1]) | (corner == p.vertex[2]);
  }
  left &= ~bits_of(shared);
  if (left == 0) return 0;
  TriangleLanes four;
  for (u32 i = 0; i < 3; ++i)
    for (u32 k = 0; k < 3; ++k) four.corner[i][k] = load4(b.point[i][k] + at) - p.origin[k];
  return lanes_not_parted(p.face, p.axes, four, p.doubt, left);
}

// Pairs within the leaf come up from both faces: the first face, by place, sees to the pair.
bool is_seen_to(u32 first, u32 mine, u32 other) { return other - first <= mine - first; }

// Tests a face of the leaf against the faces of the batch at from .. from + 3.
void test_group(CompleteSearch& s, u32 first, u32 mine, const LaneProbe& probe, const Batch& batch, u32 from) {
  s.units += of_group;
  const u32 f = face_at(s.tree, mine);
  for (u32 rest = lanes_left(probe, batch, from); rest != 0; rest &= rest - 1) {
    const u32 other = batch.place[from + static_cast<u32>(__builtin_ctz(rest))];
    if (is_seen_to(first, mine, other)) continue;
    const u32 g = face_at(s.tree, other);
    s.units += of_exact_test;
    // The plane of g comes first: the plane of f has g on both sides.
    if ((is_active(s, f) || is_active(s, g)) && faces_meet(s.m, g, f)) s.sink.add(f, g);
  }
}

// Tests a face of the leaf against groups with boxes meeting its own. The first `seen_to` faces are left out.
void test_groups(CompleteSearch& s, const Query& q, u32 mine, const Batch& batch, u32 seen_to) {
  const ConstBoxLanes boxes{{batch.group_low[0], batch.group_low[1], batch.group_low[2]},
                            {batch.group_high[0], batch.group_high[1], batch.group_high[2]}};
  const u32 groups = (batch.count + Batch::group - 1) / Batch::group;
  const BroadBox box = broad(face_box(s, mine));
  LaneProbe probe;
  bool known = false;
  for_each_meeting(boxes, seen_to / Batch::group, groups, box, [&](u32 group) {
    if (!known) probe = probe_of(s, mine, !q.proven, batch.reach);
    known = true;
    test_group(s, s.tree.first[q.leaf], mine, probe, batch, Batch::group * group);
    return true;
  });
}

void test_batch(CompleteSearch& s, const Query& q, Batch& batch) {
  if (batch.count == 0) return;
  const QuantizedBox all = byte_box(s.tree.byte_frame[q.leaf], box_groups(batch));
  const u32 first = s.tree.first[q.leaf];
  u32 seen_to = 0;  // faces of the batch
  for_each_meeting(s.tree.box, first, s.tree.first[q.leaf + 1], all, [&](u32 mine) {
    while (seen_to < batch.count && is_seen_to(first, mine, batch.place[seen_to])) ++seen_to;
    test_groups(s, q, mine, batch, seen_to);
    return s.goes_on();
  });
  batch.count = 0;
  batch.reach = 0;
}

// Does b certainly lie on one side of the slab of a, or a on one side of the slab of b? Along the normal of a, b
// reaches from its plane by its thickness times the cosine between both normals, and by its radius times the sine. All
// roundings make 24 * 2^-24 of the lengths together at most, the roundings of points another 2 * 2^-24: half of the
// margin.
I4 lie_aside(const FourOutlines& a, const FourOutlines& b) {
  F4 above_a = -a.level, above_b = -b.level, size{}, cosine{}, sine_a{}, sine_b{};
  for (u32 k = 0; k < 3; ++k) {
    const F4 d = b.middle[k] - a.middle[k];
    above_a += a.normal[k] * d;
    above_b -= b.normal[k] * d;
    size += abs_of(d);
    cosine += a.normal[k] * b.normal[k];
  }
  above_a += cosine * b.level;
  above_b += cosine * a.level;
  for (u32 k = 0; k < 3; ++k) {
    const F4 beside_b = a.normal[k] - cosine * b.normal[k], beside_a = b.normal[k] - cosine * a.normal[k];
    sine_a += beside_b * beside_b;
    sine_b += beside_a * beside_a;
  }
  cosine = abs_of(cosine);
  const F4 margin = 0x1p-22f + 0x1p-18f * (size + a.radius + b.radius);
  return (abs_of(above_a) > a.thickness + b.thickness * cosine + b.radius * square_root(sine_a) + margin) |
         (abs_of(above_b) > b.thickness + a.thickness * cosine + a.radius * square_root(sine_b) + margin);
}

// Needs the leaf no test against another leaf? Tries the proof when first needed.
bool passes_over(const CompleteSearch& s, Query& q, u32 other) {
  if (!q.active && !any_active(s, other)) return true;
  if (!q.judged) q.proven = find_neighbourhood(s.tree, s.m, q.leaf, q.neighbourhood);
  q.judged = true;
  return q.proven && q.neighbourhood.has(other);
}

// Leaves with boxes that meet the box of the leaf in turn, and then places of their faces that may meet its faces.
struct NearCandidates {
  static constexpr u32 most_leaves = 128, most_faces = 256;
  u32 leaves, faces;
  u32 leaf[most_leaves], face[most_faces];
};

// Leaves out candidates that lie aside.
void leave_out_aside(const FaceTree& tree, u32 leaf, NearCandidates& near) {
  const FourOutlines mine = outlines_of(tree, {leaf, leaf, leaf, leaf});
  u32 left = 0;
  for (u32 at = 0; at < near.leaves; at += 4) {
    const Four others = four_of(near.leaf, at, near.leaves);
    for (u32 rest = first_bits_of(~lie_aside(mine, outlines_of(tree, others.at)), near.leaves - at); rest != 0;
         rest &= rest - 1)
      near.leaf[left++] = others.at[__builtin_ctz(rest)];
  }
  near.leaves = left;
}

// Lanes of four faces that do not certainly lie on one side of the slab of a leaf. Heights are off by 14 * 2^-24, with
// differences up to 2; the slab is off by 11, points by 2, and sums by 5. In all that is half of the allowance of
// 2^-18.
I4 reach_into(const Outline& o, const F4 (&corner)[3][3]) {
  F4 low = all4(FLT_MAX), high = all4(-FLT_MAX);
  for (u32 i = 0; i < 3; ++i) {
    F4 height{};
    for (u32 k = 0; k < 3; ++k) height += o.normal[k] * (corner[i][k] - o.middle[k]);
    low = min4(low, height);
    high = max4(high, height);
  }
  const f32 reach = o.thickness + 0x1p-18f;
  return (low <= all4(o.level + reach)) & (all4(o.level - reach) <= high);
}

void test_near_faces(CompleteSearch& s, const Query& q, NearCandidates& near, Batch& batch) {
  for (u32 i = 0; i < near.faces; ++i) {
    const u32* v = s.m.corner + 3 * static_cast<size_t>(face_at(s.tree, near.face[i]));
    for (u32 k = 0; k < 3; ++k) fetch(s.tree.point + 3 * static_cast<size_t>(v[k]));
  }
  for (u32 at = 0; at < near.faces; at += 4) {
    const Four four = four_of(near.face, at, near.faces);
    F4 corner[3][3];
    corners_of_four(s.tree, s.m, four.at, corner);
    for (u32 rest = first_bits_of(reach_into(s.tree.outline[q.leaf], corner), near.faces - at); rest != 0;
         rest &= rest - 1) {
      if (batch.count == Batch::capacity) test_batch(s, q, batch);
      add(s, four.at[__builtin_ctz(rest)], batch);
    }
  }
  near.faces = 0;
}

void test_near_leaves(CompleteSearch& s, const Query& q, const Box& bounds, NearCandidates& near, Batch& batch) {
  const FaceTree& tree = s.tree;
  leave_out_aside(tree, q.leaf, near);
  for (u32 k = 0; k < near.leaves; ++k) {
    if (near.faces + most_in_leaf > NearCandidates::most_faces) test_near_faces(s, q, near, batch);
    const QuantizedBox box = byte_box(tree.byte_frame[near.leaf[k]], bounds);
    for_each_meeting(tree.box, tree.first[near.leaf[k]], tree.first[near.leaf[k] + 1], box, [&](u32 place) {
      fetch(s.m.corner + 3 * static_cast<size_t>(face_at(tree, place)));
      near.face[near.faces++] = place;
      return true;
    });
  }
  test_near_faces(s, q, near, batch);
  near.leaves = 0;
}

// Leaves judged together: a leaf and leaves around it with about the same normal. With more leaves, the proof gets no
// cheaper for each; with larger angles, it fails more often (docs/notes/detection.md).
struct Together {
  static constexpr u32 most = 10;
  u32 count = 0;
  u32 leaf[most + 1];  // the last is spare: it may be written but not counted
};
constexpr f32 least_cosine = 0.9f;

bool lean_little(const Outline& a, const Outline& b) {
  return a.normal[0] * b.normal[0] + a.normal[1] * b.normal[1] + a.normal[2] * b.normal[2] > least_cosine;
}

// Do all adjacent leaves lean little from the leaf? If not, a larger part of the surface leans more still.
bool adjacent_lean_little(const FaceTree& tree, u32 leaf) {
  const AdjacentLeaves& n = tree.adjacent[leaf];
  for (u32 i = 0; i < min_of(n.count, AdjacentLeaves::capacity); ++i)
    if (!lean_little(tree.outline[leaf], tree.outline[n.leaf[i]])) return false;
  return true;
}

// Takes the first leaf left of a chunk, and leaves left around, reached over edges from leaf to leaf. `left`: a bit for
// each leaf of the chunk.
Together take_together(const FaceTree& tree, u32 chunk_first, u64& left) {
  Together t;
  t.leaf[t.count++] = chunk_first + static_cast<u32>(__builtin_ctzll(left));
  left &= left - 1;
  if (!adjacent_lean_little(tree, t.leaf[0])) return t;
  const Outline& first = tree.outline[t.leaf[0]];
  // Without a branch on whether a leaf is left: no processor could predict it.
  for (u32 k = 0; k < t.count; ++k) {
    const AdjacentLeaves& n = tree.adjacent[t.leaf[k]];
    for (u32 i = 0; i < min_of(n.count, AdjacentLeaves::capacity) && t.count < Together::most; ++i) {
      const u32 bit = n.leaf[i] - chunk_first;
      const u64 is_left = bit < chunk ? left >> (bit % chunk) & 1 : 0;
      const u64 taken = is_left & (lean_little(first, tree.outline[n.leaf[i]]) ? 1 : 0);
      left &= ~(taken << (bit % chunk));
      t.leaf[t.count] = n.leaf[i];
      t.count += static_cast<u32>(taken);
    }
  }
  return t;
}

Box box_round(const FaceTree& tree, Span<const u32> some) {
  Box b = node_box(tree, some[0]);
  for (u32 i : some) b = united(b, node_box(tree, i));
  return b;
}

// A list of leaves with their boxes in lanes.
struct LeafBoxes {
  u32 count;
  u32 leaf[NearCandidates::most_leaves];
  f32 low[3][NearCandidates::most_leaves + 4], high[3][NearCandidates::most_leaves + 4];

  void add(const FaceTree& tree, u32 other) {
    for (u32 k = 0; k < 3; ++k) low[k][count] = tree.node.low[k][other], high[k][count] = tree.node.high[k][other];
    leaf[count++] = other;
  }
};

// The arrays of a task.
struct LeafRoom {
  Query query;
  LeafBoxes around;
  NearCandidates near;
  Batch batch;
};

// Tests each of some leaves against the leaves around. The first leaf of a pair sees to the pair.
void test_around(CompleteSearch& s, Query& q, Span<const u32> some) {
  LeafBoxes& around = s.room.around;
  NearCandidates& near = s.room.near;
  Batch& batch = s.room.batch;
  const ConstBoxLanes boxes{{around.low[0], around.low[1], around.low[2]},
                            {around.high[0], around.high[1], around.high[2]}};
  near.leaves = near.faces = batch.count = 0;
  batch.reach = 0;
  for (u32 leaf : some) {
    q.leaf = leaf;
    const Box box = node_box(s.tree, leaf);
    const BroadBox bounds = broad(box);
    for (u32 at = 0; at < around.count; at += 4)
      for (u32 rest = first_bits_of(lanes_meeting(boxes, at, bounds), around.count - at); rest != 0; rest &= rest - 1) {
        const u32 other = around.leaf[at + static_cast<u32>(__builtin_ctz(rest))];
        near.leaf[near.leaves] = other;
        near.leaves += other >= leaf ? 1u : 0u;
      }
    test_near_leaves(s, q, box, near, batch);
    test_batch(s, q, batch);
  }
  around.count = 0;
}

// Tests all pairs with one of some leaves as the first: a single leaf, or several with a common neighbourhood. some[0]
// is the lowest.
void search_round(CompleteSearch& s, Query& q, Span<const u32> some) {
  LeafBoxes& around = s.room.around;
  around.count = 0;
  const u32 hub = some.size == 1 ? s.tree.hub[some[0]] : none;
  const bool star = hub != none && star_proven(s.m, s.star, hub);
  for_each_leaf_near(s.tree, box_round(s.tree, some), some[0], [&](u32 other) {
    // Faces round a proven star meet nowhere else. Around a hub, boxes of most leaves meet.
    if (star && s.tree.hub[other] == hub) return true;
    s.units += of_leaf_near;
    if (passes_over(s, q, other)) return true;
    if (around.count == NearCandidates::most_leaves) test_around(s, q, some);
    around.add(s.tree, other);
    return !has_stopped(s.meter);
  });
  if (around.count > 0) test_around(s, q, some);
}

void search_together(CompleteSearch& s, const Together& t) {
  Query& q = s.room.query;
  u32 active = 0;  // by bit
  for (u32 i = 0; i < t.count; ++i) active |= (any_active(s, t.leaf[i]) ? 1u : 0u) << i;
  q.active = active != 0;
  // Without an active face, most leaves need no proof.
  q.judged = q.proven =
      t.count > 1 && q.active && find_common_neighbourhood(s.tree, s.m, {t.leaf, t.count}, q.neighbourhood);
  if (q.proven) return search_round(s, q, {t.leaf, t.count});
  for (u32 i = 0; i < t.count; ++i) {
    q.leaf = t.leaf[i];
    q.active = (active >> i & 1) != 0;
    q.judged = q.proven = false;
    search_round(s, q, {t.leaf + i, 1});
  }
}

// Fetches the memory needed first by the proof of the next leaf: its boxes, and the corners of its first faces, amid
// the leaf. Inlined by force, as fetch() is.
[[gnu::always_inline]] inline void fetch_leaf(const CompleteSearch& s, u32 leaf) {
  const FaceTree& tree = s.tree;
  const u32 first = tree.first[leaf], last = tree.first[leaf + 1];
  for (u32 k = 0; k < 3; ++k) {
    fetch(tree.box.low[k] + first);
    fetch(tree.box.high[k] + first);
  }
  for (u32 i = first; i < min_of(first + 8, last); ++i) {
    const u32* v = s.m.corner + 3 * static_cast<size_t>(face_at(tree, i));
    for (u32 k = 0; k < 3; ++k) fetch(tree.point + 3 * static_cast<size_t>(v[k]));
  }
}

void search_chunk(CompleteSearch& s, u32 first, u32 last) {
  const bool fetches = needs_fetching(s.m);
  for (u64 left = ~u64{0} >> (64 - (last - first)); left != 0 && s.goes_on();) {
    const Together t = take_together(s.tree, first, left);
    if (left != 0 && fetches) fetch_leaf(s, first + static_cast<u32>(__builtin_ctzll(left)));
    search_together(s, t);
    s.units += of_leaf * t.count;
  }
  s.goes_on();
}

}  // namespace

void detect_complete(const Mesh& m, FaceTree& tree, const u8* active, u8* star, const TaskRooms& rooms,
                     const Exec& exec, Detection& out) {
  out.pairs.clear();
  arrange(tree, m, exec);
  ContactSink sink{out};
  for_metered_runs(exec, tree.count, chunk, rooms.count, [&](u32 run, u32 first, u32 last, Meter* meter) {
    CompleteSearch s{m, tree, active, star, sink, rooms.room<LeafRoom>(run), meter};
    search_chunk(s, first, last);
  });
  memset(star, 0, m.vertex_count);
  sink.finish();
  spend(exec.meter, sorting_steps(out.pairs.size));
}

}  // namespace tpa
