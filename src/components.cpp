#include "components.h"

namespace tpa {

void find_components(const Mesh& m, Components& c, u32* queue) {
  c.list.clear();
  for (u32 v = 0; v < m.vertex_count; ++v) c.label[v] = none;
  for (u32 seed = 0; seed < m.vertex_count; ++seed) {
    if (!vertex_lives(m, seed) || c.label[seed] != none) continue;
    const u32 index = c.list.size;
    u32 count = 0, half_edges = 0;
    queue[count++] = seed;
    c.label[seed] = index;
    for (u32 i = 0; i < count; ++i)
      for_each_outgoing(m, queue[i], [&](u32 h) {
        ++half_edges;
        const u32 u = head(m, h);
        if (c.label[u] != none) return;
        c.label[u] = index;
        queue[count++] = u;
      });
    c.list.push({seed, none, static_cast<i32>(2 * i64{count} - half_edges / 3), Turn::first, 0, 0});
  }
}

namespace components_detail {

u32 find_family(Stack<Component>& list, u32 i) {
  while (list[i].family != i) {
    list[i].family = list[list[i].family].family;
    i = list[i].family;
  }
  return i;
}

void relate(const Mesh& m, Components& before, Components& after) {
  for (u32 i = 0; i < before.list.size; ++i) before.list[i].family = i;
  for (u32 v = 0; v < m.vertex_count; ++v) {
    if (!vertex_lives(m, v)) continue;
    const u32 parent = m.vertex_origin[v].parents[0];
    Component& c = after.list[after.label[v]];
    const u32 old = before.label[parent];
    if (c.family == none) {
      c.family = old;
      continue;
    }
    const u32 a = find_family(before.list, c.family), b = find_family(before.list, old);
    if (a != b) before.list[max_of(a, b)].family = min_of(a, b);
  }
}

ComponentChange change_of(const Components& before, Components& after, u32 family) {
  ComponentChange change{0, 0, none, none, 0, 0};
  Stack<Component> list = before.list;
  for (u32 i = family; i < list.size; ++i) {
    if (find_family(list, i) != family) continue;
    if (change.before_count++ == 0) change.before = list[i].id;
    change.genus_before += 1 - list[i].euler / 4;
  }
  for (const Component& c : after.list) {
    if (c.family == none || find_family(list, c.family) != family) continue;
    if (change.after_count++ == 0) change.after = c.id;
    change.genus_after += 1 - c.euler / 4;
  }
  return change;
}

}  // namespace components_detail

}  // namespace tpa
