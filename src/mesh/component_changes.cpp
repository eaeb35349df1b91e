// SPDX-License-Identifier: MIT
#include "mesh/component_changes.h"

#include "base/disjoint_sets.h"
#include "base/sort.h"

namespace tpa {

// A touched face need not differ: the journal also has the faces of the last transaction. A slot of a removed vertex
// may have a new vertex.
bool is_changed(const Edit& e, u32 f) {
  const Journal& j = e.journal;
  if (f >= j.face_count) return true;
  if (!j.faces.contains(f)) return false;
  for (u32 i = 0; i < 3; ++i) {
    const u32 old = j.face[f].corner[i];
    if (e.mesh.corner[3 * f + i] != old || !is_old(e.mesh, old)) return true;
  }
  return false;
}

namespace {

u32 find_part(Parts& p, u32 i) {
  return find_set([&](u32 k) -> u32& { return p.list[k].parent; }, i);
}

// ---------------------------------------------------------------- lists

void push_back(Parts& p, VertexList& list, u32 v) {
  p.following[v] = none;
  (list.last == none ? list.first : p.following[list.last]) = v;
  list.last = v;
}

void push_front(Parts& p, VertexList& list, u32 v) {
  p.following[v] = list.first;
  list.first = v;
  if (list.last == none) list.last = v;
}

u32 pop_front(Parts& p, VertexList& list) {
  const u32 v = list.first;
  list.first = p.following[v];
  if (list.first == none) list.last = none;
  return v;
}

void append(Parts& p, VertexList& to, const VertexList& from) {
  if (from.first == none) return;
  (to.last == none ? to.first : p.following[to.last]) = from.first;
  to.last = from.last;
}

// ---------------------------------------------------------------- touched components

u32 touch(Components& c, Parts& p, u32 i) {
  if (c.list[i].family == none) {
    c.list[i].family = i;
    p.touched.push(i);
    p.change[i] = 0;
  }
  return i;
}

// The component of an old vertex, or of the first parent of a new vertex.
u32 origin_of(const Mesh& m, Components& c, Parts& p, u32 v) {
  return touch(c, p, component_of(c, m.vertex_origin[v].parents[0]));
}

// Euler numbers lose removed vertices and gain new vertices. A removed vertex leaves a hole, or a slot with a new
// vertex.
void take_out(const Edit& e, Components& c, Parts& p, u32 v) {
  if (v < e.journal.vertex_count) p.change[touch(c, p, component_of(c, v))] -= 2;
}
void count_holes(const Edit& e, Components& c, Parts& p) {
  for (u32 v = e.mesh.free_vertex; v != e.journal.resting_vertex; v = e.mesh.vertex_origin[v].parents[0])
    take_out(e, c, p, v);
}
void count_if_new(const Edit& e, Components& c, Parts& p, u32 v, u32 origin) {
  if (is_old(e.mesh, v)) return;
  take_out(e, c, p, v);
  p.change[origin] += 2;
}

// ---------------------------------------------------------------- parts

void add_vertex(Parts& p, u32 part, u32 v) {
  p.part[v] = part;
  push_back(p, p.list[part].found, v);
}

// Part b joins part a.
void unite(Components& c, Parts& p, u32 a, u32 b) {
  Part &to = p.list[a], &from = p.list[b];
  from.parent = a;
  append(p, to.found, from.found);
  append(p, to.done, from.done);
  to.done_count += from.done_count;
  to.outgoing += from.outgoing;
  unite_families(c, to.component, from.component);
  to.component = min_of(to.component, from.component);
}

// The part of a changed face, united from the parts of the corners.
u32 part_of_face(const Mesh& m, Components& c, Parts& p, u32 f) {
  u32 part = none;
  for (u32 i = 0; i < 3; ++i) {
    const u32 known = p.part[m.corner[3 * f + i]];
    if (known == none) continue;
    const u32 other = find_part(p, known);
    if (part != none && part != other) unite(c, p, part, other);
    if (part == none) part = other;
  }
  if (part != none) return part;
  p.list.push({.parent = p.list.size, .component = origin_of(m, c, p, m.corner[3 * f])});
  return p.list.size - 1;
}

// Every new vertex is a corner of a changed face.
void begin_part(const Edit& e, Components& c, Parts& p, u32 f) {
  const Mesh& m = e.mesh;
  const u32 part = part_of_face(m, c, p, f);
  for (u32 i = 0; i < 3; ++i) {
    const u32 v = m.corner[3 * f + i];
    if (p.part[v] != none) continue;
    add_vertex(p, part, v);
    const u32 origin = origin_of(m, c, p, v);
    count_if_new(e, c, p, v, origin);
    unite_families(c, p.list[part].component, origin);
    p.list[part].component = min_of(p.list[part].component, origin);
  }
}

// Begins a part at each changed face, and counts faces into the Euler numbers.
void begin_parts(const Edit& e, const BitSet& faces, Components& c, Parts& p) {
  const Mesh& m = e.mesh;
  const Journal& j = e.journal;
  for (u32 f : faces) {
    if (!is_changed(e, f)) continue;
    if (f < j.face_count) ++p.change[touch(c, p, component_of(c, j.face[f].corner[0]))];
    if (f >= m.face_count || !face_lives(m, f)) continue;
    --p.change[origin_of(m, c, p, m.corner[3 * f])];
    begin_part(e, c, p, f);
  }
}

// Finds the neighbours of at most `vertices` vertices of the part.
void grow(const Mesh& m, Components& c, Parts& p, u32 part, u32 vertices) {
  Part& here = p.list[part];
  for (u32 n = 0; n < vertices && here.found.first != none; ++n) {
    const u32 v = pop_front(p, here.found);
    push_front(p, here.done, v);
    ++here.done_count;
    for_each_neighbour(m, v, [&](u32 u) {
      ++here.outgoing;
      if (p.part[u] == none) {
        add_vertex(p, part, u);
        return;
      }
      const u32 other = find_part(p, p.part[u]);
      if (other != part) unite(c, p, part, other);
    });
  }
  here.is_whole = here.found.first == none;
}

// The searches take turns. Each turn is as long as all before together, so the longest search costs little more than
// the second longest.
constexpr u32 first_turn = 64;

void grow_parts(const Mesh& m, Components& c, Parts& p) {
  for (u32 turn = first_turn;; turn *= 2) {
    for (u32 i : p.touched) p.open[i] = 0;
    for (const Part& part : p.list)
      if (is_root(p, part) && !part.is_whole) ++p.open[find_family(c, part.component)];
    bool any = false;
    for (u32 i = 0; i < p.list.size; ++i) {
      const Part& part = p.list[i];
      if (!is_root(p, part) || part.is_whole || p.open[find_family(c, part.component)] < 2) continue;
      grow(m, c, p, i, turn);
      any = true;
    }
    if (!any) return;
  }
}

// ---------------------------------------------------------------- families

void list_families(Components& c, Parts& p) {
  sort_in_place(p.touched.data, p.touched.size);
  for (u32 i : p.touched) {
    const u32 name = find_family(c, i);
    if (name == i) {
      p.place[i] = p.families.size;
      p.families.push({.before = c.list[i].id});
    }
    Family& family = p.families[p.place[name]];
    ++family.before_count;
    family.genus_before += genus_of(c.list[i].euler);
    family.euler += c.list[i].euler + p.change[i];
  }
}

// The open part of a family has the rest of the Euler number.
void count_parts(Components& c, Parts& p) {
  for (u32 i = 0; i < p.list.size; ++i) {
    Part& part = p.list[i];
    if (!is_root(p, part)) continue;
    part.family = p.place[find_family(c, part.component)];
    part.before = c.list[part.component].id;
    Family& family = p.families[part.family];
    ++family.after_count;
    if (!part.is_whole) {
      family.open_part = i;
      continue;
    }
    part.euler = static_cast<i32>(2 * i64{part.done_count} - part.outgoing / 3);
    family.euler -= part.euler;
    family.genus_after += genus_of(part.euler);
  }
  for (Family& family : p.families) {
    if (family.open_part == none) continue;
    p.list[family.open_part].euler = family.euler;
    family.genus_after += genus_of(family.euler);
  }
}

}  // namespace

void find_parts(const Edit& e, const BitSet& faces, Components& before, Parts& p) {
  p.list.clear();
  p.families.clear();
  p.touched.clear();
  count_holes(e, before, p);
  begin_parts(e, faces, before, p);
  grow_parts(e.mesh, before, p);
  list_families(before, p);
  count_parts(before, p);
}

void forget_parts(Components& before, Parts& p) {
  for (const Part& part : p.list)
    if (is_root(p, part)) for_each_vertex(p, part, [&](u32 v) { p.part[v] = none; });
  for (u32 i : p.touched)
    if (i < before.list.size) before.list[i].family = none;
}

u32 count_components(const Components& before, const Parts& p) {
  u32 count = before.list.size - p.touched.size;
  for (const Family& family : p.families) count += family.after_count;
  return count;
}

void label_parts(Components& before, Parts& p) {
  // Vertices out of reach keep their labels, and all nodes of a family lead to the node of the open part.
  for (u32 i : p.touched) {
    const u32 name = find_family(before, i), node = before.list[name].node;
    if (i != name) before.node[before.list[i].node] = node;
  }
  for (u32 i : p.touched)
    if (find_family(before, i) == i) {
      Family& family = p.families[p.place[i]];
      if (family.open_part != none) p.list[family.open_part].node = before.list[i].node;
    }
  for (Part& part : p.list) {
    if (!is_root(p, part)) continue;
    if (part.is_whole) part.node = before.nodes++;
    for_each_vertex(p, part, [&](u32 v) { before.label[v] = part.node; });
  }
}

namespace {

// The slot of a vertex after the commit.
u32 place_after(const Mesh& m, const Components& c, u32 v) {
  while (v >= m.vertex_count) v = c.label[v];
  return v;
}

Component& component_after(const Components& c, const Part& part) { return c.list.data[c.node[part.node] ^ root_node]; }

// Parts take the place of touched components. Returns the number of untouched components.
u32 replace_touched(Components& c, const Parts& p) {
  u32 kept = 0;
  for (const Component& old : c.list)
    if (old.family == none) {
      c.list[kept] = old;
      c.list[kept++].before = old.id;
    }
  c.list.size = kept;
  for (const Part& part : p.list)
    if (is_root(p, part))
      c.list.push(
          {.node = part.node, .euler = part.euler, .before = part.before, .volume = part.volume, .size = part.size});
  number_components(c);
  return kept;
}

// The smallest vertex of a component is a vertex of a part, or a vertex with a new number, or as before.
void name_after(const Edit& e, Components& c, const Parts& p, u32 kept) {
  const Mesh& m = e.mesh;
  for (u32 i = 0; i < kept; ++i)
    if (c.list[i].id >= m.vertex_count) c.list[i].id = none;
  for (const Part& part : p.list) {
    if (!is_root(p, part)) continue;
    u32& id = component_after(c, part).id;
    for_each_vertex(p, part, [&](u32 v) { id = min_of(id, place_after(m, c, v)); });
    if (part.is_whole) continue;
    u32 v = p.families[part.family].before;
    while (v < id && v < m.vertex_count && find_root(c, c.label[v]) != part.node) ++v;
    id = min_of(id, v);
  }
  for (u32 v : e.journal.vertices) {
    if (v >= m.vertex_count) continue;
    u32& id = c.list[component_of(c, v)].id;
    id = min_of(id, v);
  }
}

// Chains the components of each family, backwards so that chains ascend. The places of families are needed no more.
void chain_families(const Components& c, Parts& p) {
  u32* family = p.place;
  for (u32 i = 0; i < c.list.size; ++i) family[i] = none;
  for (const Part& part : p.list)
    if (is_root(p, part)) family[c.node[part.node] ^ root_node] = part.family;
  for (u32 i = c.list.size; i-- > 0;) {
    if (family[i] == none) continue;
    Family& f = p.families[family[i]];
    p.next_after[i] = f.first_after;
    f.first_after = i;
    f.after = c.list[i].id;
  }
}

}  // namespace

void commit_parts(const Edit& e, Components& c, Parts& p) {
  const u32 kept = replace_touched(c, p);
  name_after(e, c, p, kept);
  order_components(c);
  flatten(c);
  chain_families(c, p);
}

}  // namespace tpa
