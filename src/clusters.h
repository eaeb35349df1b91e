// clusters: all faces in the order of a space-filling curve (Morton 1966), cut into clusters of some thirty, with a
// tree of boxes above them. Complete detection looks at clusters first and at faces only where it must.
//
// Boxes are of positions relative to the middle of the mesh, in units of its size, rounded to single precision.
// Rounding is monotone, so boxes that meet still meet: no margin is needed.
#pragma once

#include "arena.h"
#include "exec.h"
#include "lanes.h"
#include "mesh.h"

namespace tpa {

inline constexpr u32 fewest_in_cluster = 16, most_in_cluster = 64;
inline constexpr u32 tree_branching = 8;
inline constexpr u32 most_tree_levels = 12;

struct BoxLanes {
  f32* low[3];
  f32* high[3];
};

struct ConstBoxLanes {
  const f32* low[3];
  const f32* high[3];
};
inline ConstBoxLanes lanes_of(const BoxLanes& b) {
  return {{b.low[0], b.low[1], b.low[2]}, {b.high[0], b.high[1], b.high[2]}};
}

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
  u32 numbered = 0;           // refit.h: how many faces, with holes, items tell the places of
  u32 levels = 0;
  u32 level_first[most_tree_levels] = {}, level_size[most_tree_levels] = {};
};

struct Clusters : TreeShape {
  // By place, that is in the order of the curve.
  u64* item = nullptr;  // place on the curve << 32 | face
  BoxLanes box{};
  // By cluster; a cluster holds the places first[c] .. first[c + 1] - 1.
  u32* first = nullptr;
  u32* end = nullptr;  // refit.h: only those before end[c] are taken
  // Level 0 are the clusters; node i of level l has the nodes 8 i .. 8 i + 7 of level l - 1.
  BoxLanes node{};
  // What is above serves searches; what is below, only the detection that arranges the faces.
  f32* normal[3] = {};  // twice the area along each axis; 0 where rounding leaves the sign or more than 1/8 of it open
  f32* point = nullptr;  // by vertex: x, y, z, and the bits of its place on the curve
  u8* state = nullptr;   // by cluster
  // Scratch of the sort.
  u64* other_item = nullptr;
  u32* digit_count = nullptr;
  u32* chunk_first = nullptr;
};

// Bytes that open_clusters() wants; how many of them at the start searches want; and the arrays laid out in them.
u64 clusters_bytes(u64 vertices, u64 faces);
u64 searched_bytes(u64 vertices, u64 faces);
Clusters open_clusters(u8* memory, u32 vertices, u32 faces);

inline u32 face_at(const Clusters& c, u32 place) { return static_cast<u32>(c.item[place]); }

// Arranges all living faces. O(V).
void arrange(Clusters& c, const Mesh& m, const Exec& exec);

// A box in the units of the clusters.
struct FlatBox {
  f32 low[3], high[3];
};
// What a box of the mesh becomes; boxes that meet still do. The middle of the mesh is at 0, and nothing is beyond 1.
FlatBox flat_box(const Frame& frame, const Vec3& low, const Vec3& high);

inline FlatBox node_box(const Clusters& c, u32 node) {
  FlatBox b;
  for (u32 i = 0; i < 3; ++i) b.low[i] = c.node.low[i][node], b.high[i] = c.node.high[i][node];
  return b;
}
inline bool boxes_meet(const FlatBox& a, const FlatBox& b) {
  return (a.low[0] <= b.high[0]) & (b.low[0] <= a.high[0]) & (a.low[1] <= b.high[1]) & (b.low[1] <= a.high[1]) &
         (a.low[2] <= b.high[2]) & (b.low[2] <= a.high[2]);
}
// The same box in all lanes.
struct BroadBox {
  F4 low[3], high[3];
};
inline BroadBox broad(const FlatBox& b) {
  return {{all4(b.low[0]), all4(b.low[1]), all4(b.low[2])}, {all4(b.high[0]), all4(b.high[1]), all4(b.high[2])}};
}
// Which of the boxes at .. at + 3 meet b.
inline I4 lanes_meeting(const ConstBoxLanes& boxes, u32 at, const BroadBox& b) {
  return (load4(boxes.low[0] + at) <= b.high[0]) & (load4(boxes.high[0] + at) >= b.low[0]) &
         (load4(boxes.low[1] + at) <= b.high[1]) & (load4(boxes.high[1] + at) >= b.low[1]) &
         (load4(boxes.low[2] + at) <= b.high[2]) & (load4(boxes.high[2] + at) >= b.low[2]);
}

// Calls visit(c) for each cluster whose box meets the query, in ascending order, until one answers false.
template <class Visit>
inline void for_each_cluster_near(const Clusters& c, const FlatBox& query, Visit visit) {
  struct Entry {
    u32 level, node;
  };
  Entry stack[most_tree_levels * tree_branching];
  u32 size = 0;
  const BroadBox q = broad(query);
  const ConstBoxLanes nodes = lanes_of(c.node);
  if (c.count > 0) stack[size++] = {c.levels - 1, 0};
  while (size > 0) {
    const Entry e = stack[--size];
    // The node's siblings with it are a row of eight; boxes beyond the end are empty.
    const u32 at = c.level_first[e.level] + e.node;
    const u32 near = bits_of(lanes_meeting(nodes, at, q)) | bits_of(lanes_meeting(nodes, at + 4, q)) << 4;
    if (e.level == 0) {
      for (u32 rest = near; rest != 0; rest &= rest - 1)
        if (!visit(e.node + static_cast<u32>(__builtin_ctz(rest)))) return;
      continue;
    }
    for (u32 i = tree_branching; i-- > 0;)
      if ((near >> i & 1) != 0) stack[size++] = {e.level - 1, tree_branching * (e.node + i)};
  }
}

}  // namespace tpa
