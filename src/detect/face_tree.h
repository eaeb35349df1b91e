// SPDX-License-Identifier: MIT
// face_tree: all faces of the mesh in leaves of some forty connected faces, with a tree of boxes above. Leaves follow a
// space-filling curve (Morton 1966). Complete detection (section 3) compares leaves first, and faces only if it must.
// The smallest leaves may consist of several pieces; no proof about a leaf needs it to be connected.
//
// Boxes bound positions relative to the middle of the mesh, in units of its size (tree units), rounded to single
// precision. Rounding is monotone: boxes that meet still meet, without a margin.
#pragma once

#include "base/arena.h"
#include "base/parallel.h"
#include "detect/leaves.h"
#include "geometry/quantized_boxes.h"
#include "mesh/half_edges.h"

namespace tpa {

// Faces of a leaf: a small leaf ends with the bud that makes it large enough (make_leaves() in face_tree.cpp).
inline constexpr u32 most_in_leaf = fewest_in_bud + most_in_joined_buds;
inline constexpr u32 tree_branching_bits = 3, tree_branching = 1u << tree_branching_bits;
inline constexpr u32 most_tree_levels = 12;
inline constexpr u32 places_in_row = 32;  // about as many as a leaf has

// Coordinates relative to the middle, times scale, lie within -1 .. 1.
struct Frame {
  Vec3 middle;
  f64 scale = 1;
};

// Numbers of an arrangement, without its arrays. `numbered` and `strays` serve detect/face_tree_edit.h.
struct TreeShape {
  Frame frame;
  u32 faces = 0;              // of the mesh, with holes in its numbering
  u32 places = 0, count = 0;  // living faces, leaves
  u32 numbered = 0;           // places are known of so many faces, with holes
  u32 strays = 0;             // faces placed far from the best leaf, for lack of a gap there; counts up
  bool has_hubs = false;      // `hub` names vertices
  u32 levels = 0;
  u32 level_first[most_tree_levels] = {}, level_size[most_tree_levels] = {};
};

// A few different leaves in the order of addition, with an open hash of places in the list, counted from 1; 0 is an
// empty slot. Bytes keep the table small on the stack. add() has no branch on whether a leaf is new, since no processor
// could predict it (docs/notes/detection.md).
template <u32 most, u32 slots>
struct LeafSet {
  u32 count = 0;
  u32 leaf[most + 1];  // the last is spare: add() writes before it counts
  u8 place[slots] = {};

  // The slot of a leaf, or the empty slot for it.
  u32 slot_of(u32 wanted) const {
    u32 at = wanted % slots;
    while (place[at] != 0 && leaf[place[at] - 1] != wanted) at = (at + 1) % slots;
    return at;
  }
  // Place in the list for a slot; the end of the list for an empty slot.
  u32 target_of(u32 slot) const {
    const u32 before = place[slot] - 1u, empty = before >> 31;
    return (before + empty) | (count & (0 - empty));
  }
  // Adds a leaf unless it is known; false without room. The leaf is written to the end of the list first, so that an
  // empty slot leads to it as well.
  bool add(u32 wanted) {
    leaf[count] = wanted;
    u32 slot = wanted % slots, at = target_of(slot);
    if (leaf[at] != wanted) {
      slot = slot_of(wanted);
      at = target_of(slot);
    }
    if (at == most) return false;
    place[slot] = static_cast<u8>(at + 1);
    count += at == count ? 1u : 0u;
    return true;
  }
  void clear() {
    count = 0;
    memset(place, 0, sizeof place);
  }
};

// Leaves with an edge in common with a leaf.
struct AdjacentLeaves {
  static constexpr u32 capacity = 13;
  u32 count = 0;  // more than the capacity: not all are listed
  u32 leaf[capacity];
};

// Bounds on the points and normals of the faces of a leaf.
struct Outline {
  // Two vectors of four, read as such.
  f32 middle[3], radius;     // all points are within the radius
  f32 normal[3], thickness;  // and within the thickness of a plane, `level` above the middle
  f32 level;
  // The normal of each face, scaled to length 1 along `normal`, is `normal` plus a vector across of length `slope` at
  // most. An error of rounding may add `doubt` at most. The extent of the whole leaf bounds the error: too large to
  // prove anything of faces smaller than some 2^-15 of the mesh.
  f32 slope, doubt;
  f32 point[3];  // in the first face
};

struct FaceTree : TreeShape {
  // `place`, `end` and `row_leaf` serve detect/face_tree_edit.h.
  u32* place = nullptr;                  // by face
  u32* face = nullptr;                   // by place
  u32* first = nullptr;                  // leaf i has the places first[i] .. first[i + 1] - 1
  u32* end = nullptr;                    // by leaf: only places before have faces
  u32* row_leaf = nullptr;               // by row of places: the leaf of its first place
  QuantizedLanes box{};                  // by place
  QuantizedFrame* byte_frame = nullptr;  // by leaf
  u32* hub = nullptr;                    // by leaf: a vertex that all of its faces have in common, if many, or none
  BoxLanes node{};           // level 0: the leaves; node i of level l has nodes 8 i .. 8 i + 7 of level l - 1 below
  u8* trial_room = nullptr;  // trial_room_bytes
  // Arrays from here on serve only the detection that arranges the faces.
  f32* point = nullptr;                // by vertex: x, y, z; and a number more, since four are read at once
  u32* leaf_of = nullptr;              // by face, in the memory of `place`
  AdjacentLeaves* adjacent = nullptr;  // by leaf
  Outline* outline = nullptr;          // by leaf
  // Scratch of the order, in the memory of `box` and all behind but `point`.
  Buds buds;
  u64 *item = nullptr, *unsorted = nullptr;
};

// For trials of new faces (detect/new_faces.cpp, detect/cull_new_faces.cpp), whose arrays are too large for the stack.
inline constexpr u64 trial_room_bytes = 10240;

// Bytes for a tree, and for its first part, the part needed by searches after arrange().
u64 face_tree_bytes(u64 vertices, u64 faces);
u64 search_tree_bytes(u64 vertices, u64 faces);
// Lays out a tree in memory of face_tree_bytes(vertices, faces), owned by the caller. Pre: aligned to arena_alignment.
FaceTree open_face_tree(u8* memory, u32 vertices, u32 faces);

// Data of smaller meshes, a megabyte, lie in a cache near enough not to be fetched ahead (docs/notes/detection.md).
inline bool needs_fetching(const Mesh& m) { return !TPA_SMALL && m.face_count > 1u << 14; }

inline u32 face_at(const FaceTree& tree, u32 place) { return tree.face[place]; }

// Corners of the faces at four places, by corner and axis.
void corners_of_four(const FaceTree& tree, const Mesh& m, const u32 (&place)[4], F4 (&corner)[3][3]);
// Corners of the faces at places at .. at + 3; the last place before `last` stands in for all behind.
inline void corners_of_four(const FaceTree& tree, const Mesh& m, u32 at, u32 last, F4 (&corner)[3][3]) {
  if (last - at >= 4)
    corners_of_four(tree, m, {at, at + 1, at + 2, at + 3}, corner);
  else
    corners_of_four(tree, m, {at, min_of(at + 1, last - 1), min_of(at + 2, last - 1), last - 1}, corner);
}

// Arranges all living faces. Bits do not depend on the number of threads. O(V).
void arrange(FaceTree& tree, const Mesh& m, const Exec& exec);

// Error bound of a triple product, relative to L, in single precision. Coordinates in tree units are off by 2^-25 at
// most, differences by 2^-24 and a rounding. Each component of the cross product of two differences, with components up
// to L <= 2, is then off by less than 21 * 2^-24 L. Its product with a vector of length 1 is off by less than sqrt(3)
// times as much, and 20 * 2^-24 L more. In all the error stays below 57 * 2^-24 L < 2^-18 L.
inline constexpr f32 certain_volume = 0x1p-18f;

// A box of the mesh in tree units; boxes that meet still meet. The mesh lies within -1 .. 1 when it is arranged.
// Coordinates beyond `farthest_flat`, of faces moved since, count as `farthest_flat`.
inline constexpr f64 farthest_flat = 2;
inline bool is_beyond(const Frame& frame, const Vec3& p) {
  const Vec3 away = p - frame.middle;
  return max_of(abs_of(away.x), max_of(abs_of(away.y), abs_of(away.z))) * frame.scale > farthest_flat;
}
Box flat_box(const Frame& frame, const Vec3& low, const Vec3& high);

inline Box node_box(const FaceTree& tree, u32 node) {
#if defined(TPA_VECTORS)
  const auto at = [&](f32* const(&bound)[3]) { return F4{bound[0][node], bound[1][node], bound[2][node], 0}; };
  return box_between(at(tree.node.low), at(tree.node.high));
#else
  Box b;
  for (u32 i = 0; i < 3; ++i) b.low[i] = tree.node.low[i][node], b.high[i] = tree.node.high[i][node];
  return b;
#endif
}

namespace face_tree_detail {
// A function to call for each leaf, with its data: no template, so that all searches share one function. `enters` may
// be nullptr; false of it passes over all below a node.
struct LeafVisitor {
  bool (*visit)(void* data, u32 leaf);
  void* data;
  bool (*enters)(void* data, u32 node) = nullptr;
};
void search(const FaceTree& tree, const Box& query, u32 from, LeafVisitor visitor);
}  // namespace face_tree_detail

// Outlines of four leaves in lanes, without slope, doubt and point.
struct FourOutlines {
  F4 middle[3], radius, normal[3], thickness, level;
};
inline FourOutlines outlines_of(const FaceTree& tree, const u32 (&leaf)[4]) {
  static_assert(offsetof(Outline, normal) == sizeof(F4) && offsetof(Outline, level) == 2 * sizeof(F4));
  F4 place[4], turn[4], level;
  for (u32 i = 0; i < 4; ++i) {
    const u8* o = reinterpret_cast<const u8*>(tree.outline + leaf[i]);
    memcpy(place + i, o, sizeof(F4));
    memcpy(turn + i, o + sizeof(F4), sizeof(F4));
    level[i] = tree.outline[leaf[i]].level;
  }
  transpose(place[0], place[1], place[2], place[3]);
  transpose(turn[0], turn[1], turn[2], turn[3]);
  return {{place[0], place[1], place[2]}, place[3], {turn[0], turn[1], turn[2]}, turn[3], level};
}

// Elements from .. from + 3 of a list; its last element stands in for all behind.
struct Four {
  u32 at[4];
};
inline Four four_of(const u32* list, u32 from, u32 size) {
  Four four;
  for (u32 i = 0; i < 4; ++i) four.at[i] = list[min_of(from + i, size - 1)];
  return four;
}

// Calls visit(leaf) for each leaf from `from` on with a box that meets the query, in ascending order, until an answer
// is false. Expected O(log V + leaves visited).
template <class Visit>
inline void for_each_leaf_near(const FaceTree& tree, const Box& query, u32 from, Visit visit) {
  face_tree_detail::search(tree, query, from,
                           {[](void* data, u32 leaf) { return (*static_cast<Visit*>(data))(leaf); }, &visit});
}
// The same where boxes say too little: visitor.enters(node) is asked for each node above the leaves,
// visitor.visit(leaf) for each leaf.
template <class Visitor>
inline void search_leaves(const FaceTree& tree, const Box& query, Visitor& visitor) {
  face_tree_detail::search(tree, query, 0,
                           {[](void* data, u32 leaf) { return static_cast<Visitor*>(data)->visit(leaf); }, &visitor,
                            [](void* data, u32 node) { return static_cast<Visitor*>(data)->enters(node); }});
}

}  // namespace tpa
