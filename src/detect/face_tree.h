// face_tree: all faces in clusters of some forty, these in the order of a space-filling curve (Morton 1966), with a
// tree of boxes above them. Complete detection looks at clusters first and at faces only where it must. FaceTree are
// connected but for the smallest, which may be of several pieces: what is proven of a cluster does not need it to be.
//
// Boxes are of positions relative to the middle of the mesh, in units of its size, rounded to single precision.
// Rounding is monotone, so boxes that meet still meet: no margin is needed.
#pragma once

#include "base/arena.h"
#include "base/parallel.h"
#include "detect/leaves.h"
#include "geometry/quantized_boxes.h"
#include "mesh/half_edges.h"

namespace tpa {

inline constexpr u32 most_in_cluster = fewest_in_patch + most_in_joined_patches;
inline constexpr u32 tree_branching_bits = 3, tree_branching = 1u << tree_branching_bits;
inline constexpr u32 most_tree_levels = 12;
inline constexpr u32 places_in_row = 32;  // about as many as a cluster has

// Coordinates relative to the middle, times scale, lie within -1 .. 1.
struct Frame {
  Vec3 middle;
  f64 scale = 1;
};

// What there is of an arrangement besides its arrays.
struct TreeShape {
  Frame frame;
  u32 faces = 0;              // of the mesh, with holes in its numbering
  u32 places = 0, count = 0;  // faces that live, clusters
  u32 numbered = 0;           // detect/face_tree_edit.h: of how many faces, with holes, the places are known
  u32 strays =
      0;  // detect/face_tree_edit.h: how often a face came far from the cluster that suits it, which had no gap
  u32 levels = 0;
  u32 level_first[most_tree_levels] = {}, level_size[most_tree_levels] = {};
};

// A few clusters in the order of their coming, and an open hash of their places in the list, counted from 1. Most of
// its slots are empty, so that few clusters are not in their own.
template <u32 most, u32 slots>
struct ClusterSet {
  u32 count = 0;
  u32 cluster[most + 1];  // one more is written than is counted
  u8 place[slots] = {};

  // The slot of a cluster, or the empty one where it belongs.
  u32 slot_of(u32 wanted) const {
    u32 at = wanted % slots;
    while (place[at] != 0 && cluster[place[at] - 1] != wanted) at = (at + 1) % slots;
    return at;
  }
  // Where in the list a slot leads: an empty one behind all. Without a branch, which would be as good as random.
  u32 target_of(u32 slot) const {
    const u32 before = place[slot] - 1u, empty = before >> 31;
    return (before + empty) | (count & (0 - empty));
  }
  // Once; false where there is no room. Behind all stands the cluster itself, so what is new is found too.
  bool add(u32 wanted) {
    cluster[count] = wanted;
    u32 slot = wanted % slots, at = target_of(slot);
    if (cluster[at] != wanted) {
      slot = slot_of(wanted);
      at = target_of(slot);
    }
    if (at == most) return false;
    place[slot] = static_cast<u8>(at + 1);
    count += at == count ? 1 : 0;
    return true;
  }
  void clear() {
    count = 0;
    memset(place, 0, sizeof place);
  }
};

// FaceTree that share an edge with one; more than fit are not listed.
struct Neighbours {
  static constexpr u32 capacity = 13;
  u32 count = 0;  // more than the capacity where there are more
  u32 cluster[capacity];
};

// Where a cluster is, and how its faces turn.
struct Outline {
  // Read four at a time, too.
  f32 middle[3], radius;     // all points are within the radius
  f32 normal[3], thickness;  // and within the thickness of a plane, whose height above the middle is `level`
  f32 level;
  // Each face's normal is that of the cluster, plus what is across to it, of `slope` times its size at most, plus the
  // error of rounding, of `doubt` times its size. That is told from the extent of the whole cluster: too large to prove
  // anything where faces are smaller than some 2^-15 of the mesh.
  f32 slope, doubt;
  f32 point[3];  // in the first face
};

struct FaceTree : TreeShape {
  u32* place = nullptr;  // detect/face_tree_edit.h: by face
  // By place: the faces of cluster c are at the places first[c] .. first[c + 1] - 1.
  u32* face = nullptr;
  u32* first = nullptr;
  u32* end = nullptr;  // detect/face_tree_edit.h: only those before end[c] are taken
  u32* row_cluster =
      nullptr;  // detect/face_tree_edit.h: of each row of places, the cluster that the first of them is in; if loose
  ByteLanes box{};
  ByteFrame* byte_frame = nullptr;  // by cluster
  // Level 0 are the clusters; node i of level l has the nodes 8 i .. 8 i + 7 of level l - 1.
  BoxLanes node{};
  // What is above serves searches; what is below, only the detection that arranges the faces.
  f32* point = nullptr;              // by vertex: x, y, z; and a number more, for four are read at once
  u32* cluster_of = nullptr;         // by face, in the memory of `place`
  Neighbours* neighbours = nullptr;  // by cluster
  Outline* outline = nullptr;
  // Scratch of the order, in the memory of boxes and of what comes after.
  Patches patches;
  u64 *item = nullptr, *unsorted = nullptr;
};

// Bytes that open_face_tree() wants; how many of them at the start searches want; and the arrays laid out in them.
u64 face_tree_bytes(u64 vertices, u64 faces);
u64 search_tree_bytes(u64 vertices, u64 faces);
FaceTree open_face_tree(u8* memory, u32 vertices, u32 faces);

// What belongs to fewer faces, a megabyte, is near enough not to be fetched ahead (docs/performance.md).
inline bool needs_fetching(const Mesh& m) { return !TPA_SMALL && m.face_count > 1u << 14; }

inline u32 face_at(const FaceTree& c, u32 place) { return c.face[place]; }

// The corners of the faces at four places, by axis.
void corners_of_four(const FaceTree& c, const Mesh& m, const u32 (&place)[4], F4 (&corner)[3][3]);
// Of those at `at` .. at + 3, and again of the one before `last` where there are fewer.
inline void corners_of_four(const FaceTree& c, const Mesh& m, u32 at, u32 last, F4 (&corner)[3][3]) {
  if (last - at >= 4)
    corners_of_four(c, m, {at, at + 1, at + 2, at + 3}, corner);
  else
    corners_of_four(c, m, {at, min_of(at + 1, last - 1), min_of(at + 2, last - 1), last - 1}, corner);
}

// Arranges all living faces. O(V).
void arrange(FaceTree& c, const Mesh& m, const Exec& exec);

// In units of the clusters coordinates are off by 2^-25 at most, differences by 2^-24 and a rounding, so each component
// of the cross product of two with components up to L <= 2 is off by less than 21 * 2^-24 L, and its product with a
// vector of length 1 by less than sqrt(3) times that and 20 * 2^-24 L: less than this times L.
inline constexpr f32 certain_volume = 0x1p-18f;

// What a box of the mesh becomes; boxes that meet still do. The middle of the mesh is at 0, and nothing is beyond 1; of
// what has gone there since, all that lies beyond `farthest_flat` is taken for the same place.
inline constexpr f64 farthest_flat = 2;
inline bool is_beyond(const Frame& frame, const Vec3& p) {
  const Vec3 away = p - frame.middle;
  return max_of(abs_of(away.x), max_of(abs_of(away.y), abs_of(away.z))) * frame.scale > farthest_flat;
}
Box flat_box(const Frame& frame, const Vec3& low, const Vec3& high);

inline Box node_box(const FaceTree& c, u32 node) {
#if defined(TPA_VECTORS)
  const auto at = [&](f32* const(&bound)[3]) { return F4{bound[0][node], bound[1][node], bound[2][node], 0}; };
  return box_between(at(c.node.low), at(c.node.high));
#else
  Box b;
  for (u32 i = 0; i < 3; ++i) b.low[i] = c.node.low[i][node], b.high[i] = c.node.high[i][node];
  return b;
#endif
}
namespace face_tree_detail {
// Whom to tell of a cluster: a function and what it is called with, so that there is one search for all.
struct Visitor {
  bool (*visit)(void* data, u32 cluster);
  void* data;
};
void search(const FaceTree& c, const Box& query, u32 from, Visitor visitor);
}  // namespace face_tree_detail

// Four clusters in lanes: where they are, and how they turn.
struct FourOutlines {
  F4 middle[3], radius, normal[3], thickness, level;
};
inline FourOutlines outlines_of(const FaceTree& c, const u32 (&cluster)[4]) {
  static_assert(offsetof(Outline, normal) == sizeof(F4) && offsetof(Outline, level) == 2 * sizeof(F4));
  F4 place[4], turn[4], level;
  for (u32 i = 0; i < 4; ++i) {
    const u8* o = reinterpret_cast<const u8*>(c.outline + cluster[i]);
    memcpy(place + i, o, sizeof(F4));
    memcpy(turn + i, o + sizeof(F4), sizeof(F4));
    level[i] = c.outline[cluster[i]].level;
  }
  transpose(place[0], place[1], place[2], place[3]);
  transpose(turn[0], turn[1], turn[2], turn[3]);
  return {{place[0], place[1], place[2]}, place[3], {turn[0], turn[1], turn[2]}, turn[3], level};
}

// Four elements of a list, the last one again where there are fewer.
struct Four {
  u32 at[4];
};
inline Four four_of(const u32* list, u32 from, u32 size) {
  Four four;
  for (u32 i = 0; i < 4; ++i) four.at[i] = list[min_of(from + i, size - 1)];
  return four;
}

// Calls visit(c) for each cluster from `from` on whose box meets the query, in ascending order, until one answers
// false.
template <class Visit>
inline void for_each_cluster_near(const FaceTree& c, const Box& query, u32 from, Visit visit) {
  face_tree_detail::search(c, query, from,
                           {[](void* data, u32 cluster) { return (*static_cast<Visit*>(data))(cluster); }, &visit});
}

}  // namespace tpa
