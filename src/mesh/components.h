// SPDX-License-Identifier: MIT
// components: the connected components of the mesh, each with its number, its topology and its volume.
#pragma once

#include "mesh/volume.h"

namespace tpa {

// The verdict on a component (cut/swallowed_components.h): goes if it bounds nothing. An untouched void is doubted,
// since its body may be gone.
enum class Verdict : u8 { unknown, doubted, stays, goes };

struct Component {
  u32 id = none;      // smallest vertex
  u32 node = none;    // see Components
  i32 euler = 0;      // 2 V - F, twice the Euler characteristic of a closed triangle mesh
  u32 before = none;  // in a commit: the smallest component before that it comes from

  // Fields of single stages.
  u32 family = none;                   // while components are related: disjoint sets of places in the list; else none
  u32 joined = none;                   // while islands are settled: a lower place, of a component joined to this one
  Verdict verdict = Verdict::unknown;  // while components are judged
  bool is_followed = false;            // while moves or edits are followed: one of its elements is among them
  bool was_flat = false;               // from measure_volumes() on: the sign of sum_before is uncertain

  SignedVolume volume{0, unknown_volume};  // see mesh/component_volumes.h
  f64 sum_before = 0;  // volume.sum at the start of the transaction, or of the moves; where a function says so
  union {
    f64 size = 0;     // no two vertices are farther apart, in the sum of coordinates
    f64 lost_in_sum;  // while volumes are summed: the losses of additions to volume.sum
  };
};

// From Component::euler.
inline i32 genus_of(i32 euler) { return 1 - euler / 4; }

// The label of a vertex is a node. When components unite, nodes unite (Galler & Fischer 1964), and no vertex needs
// another label. Not by base/disjoint_sets.h: there a root points to itself, but here to the place of the component in
// the list.
struct Components {
  u32* label = nullptr;   // per vertex
  u32* node = nullptr;    // another node of the set, or root_node | place in the list
  u32 nodes = 0;          // at most twice the number of components
  Stack<Component> list;  // ascending by id
};

inline constexpr u32 root_node = 1u << 31;

u32 find_root(const Components& c, u32 node);
// The place of v's component in the list.
u32 component_of(const Components& c, u32 v);

// Every node leads to its root in one step, so that places can be read without a write. O(nodes).
void flatten(Components& c);
// The same as component_of(), of flat components.
inline u32 place_of(const Components& c, u32 v) {
  const u32 above = c.node[c.label[v]];
  return ((above & root_node) != 0 ? above : c.node[above]) ^ root_node;
}

// A family is named by the smallest place of its components.
u32 find_family(Components& c, u32 i);
void unite_families(Components& c, u32 i, u32 j);

// Tells the roots the places of their components.
void number_components(Components& c);
// Sorts the list by id.
void order_components(Components& c);
// After vertices changed their numbers and took their labels along: finds the smallest vertices, and sorts the list.
// O(V), less if the smallest vertices are small.
void name_components(const Mesh& m, Components& c);

// Labels all vertices, and returns the number of components. The list takes as many as it has room for. `queue` has
// room for all vertices and one more. O(V).
u32 find_components(const Mesh& m, Components& c, u32* queue);

}  // namespace tpa
