// components: which connected components the mesh has.
#pragma once

#include <float.h>

#include "mesh/half_edges.h"

namespace tpa {

// When it is united with others, where that is done one by one.
enum class Turn : u8 { first, cavity, waits };  // cavity: first, too, since it encloses space or meets what does

inline constexpr f64 unknown_volume = DBL_MAX;

struct Component {
  u32 id = none;      // smallest vertex
  u32 node = none;    // see Components
  u32 family = none;  // for whoever relates or judges components, a union-find of places in the list; none in between
  i32 euler = 0;      // 2 V - F, twice the Euler characteristic of a closed triangle mesh
  Turn turn = Turn::first;
  f64 six_volumes = 0, six_volumes_before = 0;  // signed, now and at the start of the transaction; where asked for
  f64 volume_doubt = unknown_volume;            // by how much six_volumes may be off; see mesh/volume.h
  f64 size = 0;                                 // no two of its vertices are farther apart, in the sum of coordinates
};

// The label of a vertex is a node. Nodes are united where components are (Galler & Fischer 1964), so that no vertex
// needs another label for that; the root of a tree of nodes knows the place in the list.
struct Components {
  u32* label = nullptr;   // per vertex
  u32* node = nullptr;    // the node it was united into, or root_node | place in the list
  u32 nodes = 0;          // twice as many as components at most
  Stack<Component> list;  // ascending by id
};

inline constexpr u32 root_node = 1u << 31;

u32 find_root(const Components& c, u32 node);
// Its place in the list.
u32 component_of(const Components& c, u32 v);

// The smallest of its components names a family.
u32 find_family(Components& c, u32 i);
void unite_families(Components& c, u32 i, u32 j);

// Tells the roots where the components are in the list.
void number_components(Components& c);
// Puts the list in order.
void order_components(Components& c);
// Where vertices have other numbers, and their labels went with them: the smallest ones, and the order by them. O(V),
// less where the smallest are small.
void name_components(const Mesh& m, Components& c);

// Labels all vertices, and returns how many components there are. Those that there is no room for are not listed.
// `queue` has room for all vertices and one more. O(V).
u32 find_components(const Mesh& m, Components& c, u32* queue);

}  // namespace tpa
