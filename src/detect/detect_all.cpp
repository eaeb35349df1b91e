// SPDX-License-Identifier: MIT
#include "detect/detect_all.h"

#include <float.h>

#include "detect/cull_leaves.h"
#include "detect/face_pair.h"
#include "geometry/parting_axes.h"

namespace tpa {

namespace {

// Leaves of a task, a bit for each: some 2400 faces, enough work to make the cost of a task negligible.
constexpr u32 leaves_in_word = 64;

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

// Faces near a leaf, to be tested against its faces.
struct Batch {
  static constexpr u32 capacity = 192;
  u32 count;
  u32 own;  // the first faces of the batch are the faces of the leaf itself, or none are
  Box box;
  u32 place[capacity];
  I4 corner[capacity];
  u8 low[3][capacity + bytes_in_lanes], high[3][capacity + bytes_in_lanes];  // in the frame of the leaf

  QuantizedLanes boxes() { return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}; }
};

constexpr i32 no_corner = -2;  // no vertex, and not the number in the fourth lane of others

// A face of the leaf, and faces of the batch with boxes that meet its own.
struct FaceProbe {
  u32 place;
  f32 reach;     // no face of the batch is farther off
  I4 corner[3];  // in all lanes: no_corner, or a vertex with a proven star: faces with the vertex in common do not meet
  PartingProbe axes;
  u32 count;
  u32 other[Batch::capacity + 1];  // by place; the last is spare: it may be written but not counted
};

// A list of leaves with their boxes in lanes.
struct LeafBoxes {
  static constexpr u32 most = 128;
  u32 count;
  u32 leaf[most];
  f32 low[3][most + 4], high[3][most + 4];

  void add(const FaceTree& tree, u32 other) {
    for (u32 k = 0; k < 3; ++k) low[k][count] = tree.node.low[k][other], high[k][count] = tree.node.high[k][other];
    leaf[count++] = other;
  }
};

// The arrays of a task.
struct LeafRoom {
  Query query;
  LeafBoxes around;
  u32 near[LeafBoxes::most + 1];  // the last is spare: it may be written but not counted
  Batch batch;
  FaceProbe probe;
};

void clear(Batch& b) {
  b.count = b.own = 0;
  b.box = empty_box;
}

I4 corners_of(const CompleteSearch& s, u32 place) {
  const u32* v = face_corners(s.m, face_at(s.tree, place));
  return I4{static_cast<i32>(v[0]), static_cast<i32>(v[1]), static_cast<i32>(v[2]), -1};
}

void add(const CompleteSearch& s, u32 leaf, u32 place, Batch& b) {
  const u32 at = b.count++;
  b.place[at] = place;
  const I4 v = b.corner[at] = corners_of(s, place);
  const auto point = [&](u32 i) { return load4(s.tree.point + 3 * static_cast<size_t>(static_cast<u32>(v[i]))); };
  const F4 x = point(0), y = point(1), z = point(2);
  const Box box = box_between(min4(x, min4(y, z)), max4(x, max4(y, z)));
  b.box = united(b.box, box);
  set_box(b.boxes(), at, byte_box(s.tree.byte_frame[leaf], box));
}

void test_exactly(CompleteSearch& s, u32 f, u32 g) {
  s.units += of_exact_test;
  // The plane of g comes first: the plane of f has g on both sides.
  if ((is_active(s, f) || is_active(s, g)) && faces_meet(s.m, g, f)) s.sink.add(f, g);
}

TriangleLanes triangles_at(const CompleteSearch& s, const u32 (&place)[4]) {
  TriangleLanes t;
  corners_of_four(s.tree, s.m, place, t.corner);
  return t;
}

void test_others(CompleteSearch& s, FaceProbe& p) {
  set_probe(p.axes, triangles_at(s, {p.place, p.place, p.place, p.place}), p.reach);
  for (u32 at = 0; at < p.count; at += 4) {
    s.units += of_group;
    const Four four = four_of(p.other, at, p.count);
    const u32 all = (1u << min_of(p.count - at, 4u)) - 1;
    for (u32 rest = lanes_not_parted(p.axes, triangles_at(s, four.at), all); rest != 0; rest &= rest - 1)
      test_exactly(s, face_at(s.tree, p.place), face_at(s.tree, four.at[__builtin_ctz(rest)]));
  }
}

QuantizedBox box_at(const QuantizedLanes& boxes, u32 i) {
  return {{boxes.low[0][i], boxes.low[1][i], boxes.low[2][i]}, {boxes.high[0][i], boxes.high[1][i], boxes.high[2][i]}};
}

// Tests a face of the leaf against the batch from a place on. `share`: may it have a vertex in common with these faces?
// No branch depends on whether it has, since no processor could predict it.
void test_face(CompleteSearch& s, Batch& batch, u32 mine, u32 from, bool share) {
  FaceProbe& p = s.room.probe;
  p.place = mine;
  p.count = 0;
  const I4 v = corners_of(s, mine);
  for (u32 i = 0; i < 3; ++i)
    p.corner[i] = I4{} + (share && star_proven(s.m, s.star, static_cast<u32>(v[i])) ? v[i] : no_corner);
  for_each_meeting(batch.boxes(), from, batch.count, box_at(s.tree.box, mine), [&](u32 i) {
    const I4 w = batch.corner[i];
    const u32 shared = bits_of((w == p.corner[0]) | (w == p.corner[1]) | (w == p.corner[2]));
    p.other[p.count] = batch.place[i];
    p.count += shared == 0 ? 1u : 0u;
    return true;
  });
  s.units += of_group * (1 + (batch.count - from) / 64);
  if (p.count > 0) test_others(s, p);
}

void test_batch(CompleteSearch& s, u32 leaf, bool share, Batch& batch) {
  if (batch.count == 0) return;
  const FaceTree& tree = s.tree;
  const u32 first = tree.first[leaf];
  s.room.probe.reach = extent_of(united(node_box(tree, leaf), batch.box)) * (1 + 0x1p-20f);
  for_each_meeting(tree.box, first, tree.first[leaf + 1], byte_box(tree.byte_frame[leaf], batch.box), [&](u32 mine) {
    const u32 from = min_of(mine - first + 1, batch.own);
    if (from < batch.count) test_face(s, batch, mine, from, share);
    return s.goes_on();
  });
  clear(batch);
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

// Leaves out leaves that lie aside of a leaf; returns how many are left.
u32 leave_out_aside(const FaceTree& tree, u32 leaf, u32* near, u32 count) {
  const FourOutlines mine = outlines_of(tree, {leaf, leaf, leaf, leaf});
  u32 left = 0;
  for (u32 at = 0; at < count; at += 4) {
    const Four others = four_of(near, at, count);
    for (u32 rest = first_bits_of(~lie_aside(mine, outlines_of(tree, others.at)), count - at); rest != 0;
         rest &= rest - 1)
      near[left++] = others.at[__builtin_ctz(rest)];
  }
  return left;
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
      const u64 is_left = bit < leaves_in_word ? left >> (bit % leaves_in_word) & 1 : 0;
      const u64 taken = is_left & (lean_little(first, tree.outline[n.leaf[i]]) ? 1 : 0);
      left &= ~(taken << (bit % leaves_in_word));
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

// Lanes of four faces that do not certainly lie on one side of the slab of a leaf. Heights are off by 14 * 2^-24, with
// differences up to 2; the slab is off by 11, points by 2, and sums by 5. In all that is half of the allowance of
// 2^-18.
I4 reach_into(const Outline& o, const TriangleLanes& four) {
  F4 low = all4(FLT_MAX), high = all4(-FLT_MAX);
  for (u32 i = 0; i < 3; ++i) {
    F4 height{};
    for (u32 k = 0; k < 3; ++k) height += o.normal[k] * (four.corner[i][k] - o.middle[k]);
    low = min4(low, height);
    high = max4(high, height);
  }
  const f32 reach = o.thickness + 0x1p-18f;
  return (low <= all4(o.level + reach)) & (all4(o.level - reach) <= high);
}

// Leaves out faces that lie on one side of the slab of a leaf; returns how many are left.
u32 leave_out_beside(const CompleteSearch& s, u32 leaf, u32* face, u32 count) {
  u32 left = 0;
  for (u32 at = 0; at < count; at += 4) {
    const Four four = four_of(face, at, count);
    for (u32 rest = first_bits_of(reach_into(s.tree.outline[leaf], triangles_at(s, four.at)), count - at); rest != 0;
         rest &= rest - 1)
      face[left++] = four.at[__builtin_ctz(rest)];
  }
  return left;
}

// Tests a leaf against itself and the near leaves.
void test_leaf(CompleteSearch& s, u32 leaf, bool share, Span<const u32> near) {
  const FaceTree& tree = s.tree;
  const Box box = node_box(tree, leaf);
  // Adjacent faces mostly reach into the slab, unless it is thin.
  const bool thin = !share || 16 * tree.outline[leaf].thickness < tree.outline[leaf].radius;
  Batch& batch = s.room.batch;
  clear(batch);
  for (u32 other : near) {
    if (batch.count + most_in_leaf > Batch::capacity) test_batch(s, leaf, share, batch);
    if (has_stopped(s.meter)) return;
    u32 face[most_in_leaf], count = 0;
    for_each_meeting(tree.box, tree.first[other], tree.first[other + 1], byte_box(tree.byte_frame[other], box),
                     [&](u32 place) {
                       face[count++] = place;
                       return true;
                     });
    if (thin && other != leaf) count = leave_out_beside(s, leaf, face, count);
    for (u32 i = 0; i < count; ++i) add(s, leaf, face[i], batch);
    if (other == leaf) batch.own = count;
  }
  test_batch(s, leaf, share, batch);
}

// Tests each of some leaves against the leaves around. The first leaf of a pair sees to the pair.
void test_around(CompleteSearch& s, const Query& q, Span<const u32> some) {
  LeafBoxes& around = s.room.around;
  u32* const near = s.room.near;
  const ConstBoxLanes boxes{{around.low[0], around.low[1], around.low[2]},
                            {around.high[0], around.high[1], around.high[2]}};
  for (u32 leaf : some) {
    const BroadBox bounds = broad(node_box(s.tree, leaf));
    u32 count = 0;
    for (u32 at = 0; at < around.count; at += 4)
      for (u32 rest = first_bits_of(lanes_meeting(boxes, at, bounds), around.count - at); rest != 0; rest &= rest - 1) {
        near[count] = around.leaf[at + static_cast<u32>(__builtin_ctz(rest))];
        count += near[count] >= leaf ? 1u : 0u;
      }
    test_leaf(s, leaf, !q.proven, {near, leave_out_aside(s.tree, leaf, near, count)});
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
    if (around.count == LeafBoxes::most) test_around(s, q, some);
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
  for_metered_runs(exec, tree.count, leaves_in_word, rooms.count, [&](u32 run, u32 first, u32 last, Meter* meter) {
    CompleteSearch s{m, tree, active, star, sink, rooms.room<LeafRoom>(run), meter};
    search_chunk(s, first, last);
  });
  memset(star, 0, m.vertex_count);
  sink.finish();
  spend(exec.meter, sorting_steps(out.pairs.size));
}

}  // namespace tpa
