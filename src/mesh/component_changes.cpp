#include "mesh/component_changes.h"

#include "base/sort.h"

namespace tpa {

// The transaction may have touched a face and left it as it was; it also starts with those of the last one. Slots of
// removed vertices are taken over by new ones.
bool is_changed(const Edit& e, u32 f) {
  const Journal& j = e.journal;
  if (f >= j.face_count) return true;
  if (!j.faces.contains(f)) return false;
  // Without a branch: what is touched is as good as random.
  u32 differing = 0, replaced = 0;
  for (u32 i = 0; i < 3; ++i) {
    const u32 old = j.face[f].corner[i];
    differing |= e.mesh.corner[3 * f + i] ^ old;
    replaced |= is_old(e.mesh, old) ? 0 : 1;
  }
  return (differing | replaced) != 0;
}

namespace {

u32 find_part(Parts& p, u32 i) {
  while (p.list[i].parent != i) {
    p.list[i].parent = p.list[p.list[i].parent].parent;
    i = p.list[i].parent;
  }
  return i;
}

// ---------------------------------------------------------------- families

u32 touch(Components& c, Parts& p, u32 i) {
  if (c.list[i].family == none) {
    c.list[i].family = i;
    p.touched.push(i);
    p.change[i] = 0;
  }
  return i;
}

// ---------------------------------------------------------------- what was touched

// The component that a vertex, new or old, comes from.
u32 origin_of(const Mesh& m, Components& c, Parts& p, u32 v) {
  return touch(c, p, component_of(c, m.vertex_origin[v].parents[0]));
}

// What went is taken out of the Euler numbers, and what came is added. A vertex that went has left a hole, or its slot
// to a new one.
void take_out(const Edit& e, Components& c, Parts& p, u32 v) {
  if (v < e.journal.vertex_count) p.change[touch(c, p, component_of(c, v))] -= 2;
}
void count_holes(const Edit& e, Components& c, Parts& p) {
  for (u32 v = e.mesh.free_vertex; v != none; v = e.mesh.vertex_origin[v].parents[0]) take_out(e, c, p, v);
}
void count_if_new(const Edit& e, Components& c, Parts& p, u32 v, u32 origin) {
  if (is_old(e.mesh, v)) return;
  take_out(e, c, p, v);
  p.change[origin] += 2;
}

// ---------------------------------------------------------------- parts

void add_vertex(Parts& p, u32 part, u32 v) {
  Part& to = p.list[part];
  p.part[v] = part;
  p.following[v] = none;
  (to.last == none ? to.first : p.following[to.last]) = v;
  to.last = v;
}

// b becomes a part of a.
void unite(Components& c, Parts& p, u32 a, u32 b) {
  Part &to = p.list[a], &from = p.list[b];
  from.parent = a;
  if (from.first != none) {
    (to.last == none ? to.first : p.following[to.last]) = from.first;
    to.last = from.last;
  }
  if (from.done != none) {
    (to.last_done == none ? to.done : p.following[to.last_done]) = from.done;
    to.last_done = from.last_done;
  }
  to.done_count += from.done_count;
  to.outgoing += from.outgoing;
  unite_families(c, to.component, from.component);
}

// With a face that is not as it was. Each new vertex has one.
void begin_part(const Edit& e, Components& c, Parts& p, u32 f) {
  const Mesh& m = e.mesh;
  u32 part = none;
  for (u32 i = 0; i < 3; ++i) {
    const u32 known = p.part[m.corner[3 * f + i]];
    if (known == none) continue;
    const u32 other = find_part(p, known);
    if (part != none && part != other) unite(c, p, part, other);
    if (part == none) part = other;
  }
  if (part == none) {
    part = p.list.size;
    const u32 origin = origin_of(m, c, p, m.corner[3 * f]);
    p.list.push({part, none, none, none, none, 0, 0, origin, false, none, none, 0, 0, unknown_volume, 0});
  }
  for (u32 i = 0; i < 3; ++i) {
    const u32 v = m.corner[3 * f + i];
    if (p.part[v] != none) continue;
    add_vertex(p, part, v);
    const u32 origin = origin_of(m, c, p, v);
    count_if_new(e, c, p, v, origin);
    unite_families(c, p.list[part].component, origin);
  }
}

// And counts the faces.
void begin_parts(const Edit& e, Components& c, Parts& p) {
  const Mesh& m = e.mesh;
  const Journal& j = e.journal;
  for (u32 f : j.faces) {
    if (!is_changed(e, f)) continue;
    if (f < j.face_count) ++p.change[touch(c, p, component_of(c, j.face[f].corner[0]))];
    if (f >= m.face_count || !face_lives(m, f)) continue;
    --p.change[origin_of(m, c, p, m.corner[3 * f])];
    begin_part(e, c, p, f);
  }
}

// Looks at the neighbours of up to `vertices` vertices of the part.
void grow(const Mesh& m, Components& c, Parts& p, u32 part, u32 vertices) {
  Part& here = p.list[part];
  for (u32 n = 0; n < vertices && here.first != none; ++n) {
    const u32 v = here.first;
    here.first = p.following[v];
    if (here.first == none) here.last = none;
    p.following[v] = here.done;
    if (here.done == none) here.last_done = v;
    here.done = v;
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
  here.whole = here.first == none;
}

// The searches take turns, each turn as long as all before, so that the longest costs little more than the one before.
constexpr u32 first_turn = 64;

void grow_parts(const Mesh& m, Components& c, Parts& p) {
  for (u32 turn = first_turn;; turn *= 2) {
    for (u32 i : p.touched) p.open[i] = 0;
    for (const Part& part : p.list)
      if (is_root(p, part) && !part.whole) ++p.open[find_family(c, part.component)];
    bool any = false;
    for (u32 i = 0; i < p.list.size; ++i) {
      const Part& part = p.list[i];
      if (!is_root(p, part) || part.whole || p.open[find_family(c, part.component)] < 2) continue;
      grow(m, c, p, i, turn);
      any = true;
    }
    if (!any) return;
  }
}

i32 genus_of(i32 euler) { return 1 - euler / 4; }

void list_families(Components& c, Parts& p) {
  u32* place = p.open;  // of the family that a component names
  sort_in_place(p.touched.data, p.touched.size);
  for (u32 i : p.touched) {
    const u32 name = find_family(c, i);
    if (name == i) {
      place[i] = p.families.size;
      p.families.push({0, 0, c.list[i].id, none, 0, 0, 0, none, 0, 0, 0});
    }
    Family& family = p.families[place[name]];
    ++family.before_count;
    family.genus_before += genus_of(c.list[i].euler);
    family.euler += c.list[i].euler + p.change[i];
  }
  for (u32 i = 0; i < p.list.size; ++i) {
    Part& part = p.list[i];
    if (!is_root(p, part)) continue;
    part.family = place[find_family(c, part.component)];
    Family& family = p.families[part.family];
    ++family.after_count;
    if (!part.whole) {
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

void find_parts(const Edit& e, Components& before, Parts& p) {
  p.list.clear();
  p.families.clear();
  p.touched.clear();
  count_holes(e, before, p);
  begin_parts(e, before, p);
  grow_parts(e.mesh, before, p);
  list_families(before, p);
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
  // What was not looked at keeps its label.
  for (u32 i : p.touched) {
    const u32 name = find_family(before, i), node = before.list[name].node;
    if (i != name) before.node[before.list[i].node] = node;
  }
  u32* place = p.open;
  for (u32 i : p.touched)
    if (find_family(before, i) == i) {
      Family& family = p.families[place[i]];
      if (family.open_part != none) p.list[family.open_part].node = before.list[i].node;
    }
  for (Part& part : p.list) {
    if (!is_root(p, part)) continue;
    if (part.whole) part.node = before.nodes++;
    for_each_vertex(p, part, [&](u32 v) { before.label[v] = part.node; });
  }
}

namespace {

// Where a vertex is after the commit.
u32 place_after(const Mesh& m, const Components& c, u32 v) {
  while (v >= m.vertex_count) v = c.label[v];
  return v;
}

}  // namespace

void commit_parts(const Edit& e, Components& c, Parts& p) {
  const Mesh& m = e.mesh;
  u32 kept = 0;
  for (const Component& old : c.list)
    if (old.family == none) c.list[kept++] = old;
  c.list.size = kept;
  for (const Part& part : p.list)
    if (is_root(p, part))
      c.list.push({none, part.node, none, part.euler, Turn::first, part.six_volumes, 0, part.volume_doubt, part.size});
  number_components(c);
  // The smallest vertex: of all that was touched or moved to another slot, and of the rest, which only grew smaller.
  for (u32 i = 0; i < kept; ++i)
    if (c.list[i].id >= m.vertex_count) c.list[i].id = none;
  for (const Part& part : p.list) {
    if (!is_root(p, part)) continue;
    u32& id = c.list[c.node[part.node] ^ root_node].id;
    for_each_vertex(p, part, [&](u32 v) { id = min_of(id, place_after(m, c, v)); });
    if (part.whole) continue;
    u32 v = p.families[part.family].before;
    while (v < id && v < m.vertex_count && find_root(c, c.label[v]) != part.node) ++v;
    id = min_of(id, v);
  }
  for (u32 v : e.journal.vertices) {
    if (v >= m.vertex_count) continue;
    Component& here = c.list[component_of(c, v)];
    here.id = min_of(here.id, v);
  }
  order_components(c);
  for (const Part& part : p.list)
    if (is_root(p, part)) {
      u32& after = p.families[part.family].after;
      after = min_of(after, c.list[c.node[part.node] ^ root_node].id);
    }
}

}  // namespace tpa
