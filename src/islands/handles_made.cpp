// SPDX-License-Identifier: MIT
#include "islands/handles_made.h"

#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "mesh/component_changes.h"

namespace tpa {

namespace {

auto parents_of(Components& c) {
  return [&c](u32 i) -> u32& { return c.list[i].joined; };
}

// Relates the components that the island has edited, and calls visit() while they are known.
template <class Visit>
void with_parts(Transaction& t, Visit visit) {
  Workspace& w = t.w;
  find_parts(w.edit, w.edit.journal.claims.faces, w.before, w.parts);
  u64 units = 0;
  for (const Part& part : w.parts.list) units += part.done_count + part.outgoing / 2;
  spend(t.meter(), units);
  visit(w.before, w.parts);
  forget_parts(w.before, w.parts);
}

// By how much an island has changed twice the Euler characteristic, V - F / 2 in closed triangle meshes.
i64 euler_change(const Edit& e) {
  const Journal& j = e.journal;
  i64 change = 0;
  for (u32 v : j.claims.vertices)
    change += (v < e.mesh.vertex_count && vertex_lives(e.mesh, v) ? 2 : 0) - (v < j.vertex_count ? 2 : 0);
  for (u32 f : j.claims.faces)
    change -= (f < e.mesh.face_count && face_lives(e.mesh, f) ? 1 : 0) - (f < j.face_count ? 1 : 0);
  return change;
}

// Of the components before the transaction, those that the island has edited, each set once in each family.
u32 count_sets(Components& c, Parts& p) {
  struct Place {
    u32 family, set;
    bool operator<(const Place& other) const {
      return family != other.family ? family < other.family : set < other.set;
    }
  };
  const auto place = [&](u32 i) { return Place{find_family(c, i), find_set(parents_of(c), i)}; };
  sort_in_place(p.touched.data, p.touched.size, [&](u32 i, u32 k) { return place(i) < place(k); });
  u32 count = 0;
  for (u32 i = 0; i < p.touched.size; ++i) count += i == 0 || place(p.touched[i - 1]) < place(p.touched[i]) ? 1u : 0u;
  return count;
}

}  // namespace

void forget_joins(Components& c) {
  for (u32 i = 0; i < c.list.size; ++i) c.list[i].joined = i;
}

void note_joins(Transaction& t) {
  with_parts(t, [](Components& c, const Parts& p) {
    for (u32 i : p.touched) join_sets(parents_of(c), i, find_family(c, i));
  });
}

// Of 2 - 2 genus for each component, the Euler characteristic is the sum.
i64 handles_made(Transaction& t) {
  i64 components = 0;
  with_parts(t, [&](Components& c, Parts& p) {
    for (const Family& f : p.families) components += f.after_count;
    components -= count_sets(c, p);
  });
  return components - euler_change(t.w.edit) / 4;
}

}  // namespace tpa
