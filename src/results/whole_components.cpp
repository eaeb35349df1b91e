// SPDX-License-Identifier: MIT
#include "results/whole_components.h"

#include "base/disjoint_sets.h"
#include "block/way_back.h"

namespace tpa {

namespace {

struct FirstComponents {
  u32* label;  // per vertex before: the place of its component
  FirstComponent* list;
  u32 count;
};

FirstComponents first_components(const Context& c, u32 count) {
  return {table_data<u32>(c, table_first_label), table_data<FirstComponent>(c, table_first_components), count};
}

// Component::before becomes a place among the first components. `set` joins first components of one family.
void relate(Workspace& w, const FirstComponents& first, u32* set) {
  const Mesh& m = w.edit.mesh;
  for (u32 i = 0; i < first.count; ++i) set[i] = i;
  for (Component& component : w.before.list) component.before = none;
  for (u32 v = 0; v < m.vertex_count; ++v) {
    u32& before = w.before.list[component_of(w.before, v)].before;
    for (u32 parent : m.vertex_origin[v].parents) {
      if (parent == none) continue;
      const u32 place = first.label[parent];
      if (before != none && before != place) join_sets(set, before, place);
      before = min_of(before, place);
    }
  }
}

// The family of each first component, by its place; families ascend.
void list_families(Workspace& w, const FirstComponents& first, u32* set, u32* family) {
  w.parts.families.clear();
  for (u32 i = 0; i < first.count; ++i) {
    const u32 root = find_set(set, i);
    if (root == i) {
      family[i] = w.parts.families.size;
      w.parts.families.push({.before = first.list[i].id});
    }
    family[i] = family[root];
    Family& f = w.parts.families[family[i]];
    ++f.before_count;
    f.genus_before += genus_of(first.list[i].euler);
  }
}

// Backwards, so that chains ascend.
void chain_components(Workspace& w, const FirstComponents& first, const u32* family) {
  for (u32 i = w.before.list.size; i-- > 0;) {
    Component& component = w.before.list[i];
    Family& f = w.parts.families[family[component.before]];
    w.parts.next_after[i] = f.first_after;
    f.first_after = i;
    f.after = component.id;
    ++f.after_count;
    f.genus_after += genus_of(component.euler);
    component.before = first.list[component.before].id;
  }
}

}  // namespace

void note_first_components(Workspace& w) {
  know_components(w);
  const FirstComponents first = first_components(w.context, w.before.list.size);
  for (u32 v = 0; v < w.edit.mesh.vertex_count; ++v) first.label[v] = component_of(w.before, v);
  for (u32 i = 0; i < first.count; ++i) first.list[i] = {w.before.list[i].id, w.before.list[i].euler};
}

void relate_first_components(Workspace& w) {
  const FirstComponents first = first_components(w.context, kept_context(w.context).component_count);
  u32 *const set = w.parts.open, *const family = w.parts.place;
  relate(w, first, set);
  list_families(w, first, set, family);
  chain_components(w, first, family);
  note_ancestors(w);
}

}  // namespace tpa
