// SPDX-License-Identifier: MIT
#include "mesh/components.h"

#include "base/disjoint_sets.h"
#include "base/sort.h"

namespace tpa {

u32 find_root(const Components& c, u32 node) {
  while ((c.node[node] & root_node) == 0) {
    const u32 above = c.node[node];
    if ((c.node[above] & root_node) == 0) c.node[node] = c.node[above];
    node = above;
  }
  return node;
}

u32 component_of(const Components& c, u32 v) { return c.node[find_root(c, c.label[v])] ^ root_node; }

void flatten(Components& c) {
  for (u32 i = 0; i < c.nodes; ++i)
    if ((c.node[i] & root_node) == 0) c.node[i] = find_root(c, i);
}

void number_components(Components& c) {
  for (u32 i = 0; i < c.list.size; ++i) c.node[c.list[i].node] = root_node | i;
}

void order_components(Components& c) {
  sort_in_place(c.list.data, c.list.size, [](const Component& a, const Component& b) { return a.id < b.id; });
  number_components(c);
}

void name_components(const Mesh& m, Components& c) {
  for (Component& component : c.list) component.id = none;
  u32 unnamed = c.list.size;
  for (u32 v = 0; v < m.vertex_count && unnamed > 0; ++v) {
    u32& id = c.list[component_of(c, v)].id;
    if (id == none) id = v, --unnamed;
  }
  order_components(c);
}

u32 find_components(const Mesh& m, Components& c, u32* queue) {
  u32 index = 0;
  c.list.clear();
  for (u32 v = 0; v < m.vertex_count; ++v) c.label[v] = none;
  for (u32 seed = 0; seed < m.vertex_count; ++seed) {
    if (!vertex_lives(m, seed) || c.label[seed] != none) continue;
    u32 count = 0, half_edges = 0;
    queue[count++] = seed;
    c.label[seed] = index;
    // No branch, which would be as good as random: a known neighbour is written, but not counted.
    for (u32 i = 0; i < count; ++i)
      for_each_neighbour(m, queue[i], [&](u32 u) {
        ++half_edges;
        queue[count] = u;
        count += c.label[u] == none ? 1u : 0u;
        c.label[u] = index;
      });
    const i32 euler = static_cast<i32>(2 * i64{count} - half_edges / 3);
    if (c.list.push({.id = seed, .node = index, .euler = euler, .size = 0})) c.node[index] = root_node | index;
    ++index;
  }
  c.nodes = c.list.size;
  return index;
}

u32 find_family(Components& c, u32 i) {
  return find_set([&](u32 k) -> u32& { return c.list[k].family; }, i);
}

void unite_families(Components& c, u32 i, u32 j) {
  join_sets([&](u32 k) -> u32& { return c.list[k].family; }, i, j);
}

}  // namespace tpa
