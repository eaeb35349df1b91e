// components: which parts the mesh has, and what became of them in a transaction. Components before and after are
// related by the vertices that lived on, and by the parents of the new ones; merge, split, genus change, birth and
// death follow from the relation and from Euler's formula alone, so they hold whatever was done to the mesh.
#pragma once

#include "mesh.h"

namespace tpa {

// When it is united with others, where that is done one by one.
enum class Turn : u8 { first, cavity, waits };  // cavity: first, too, since it encloses space or meets what does

struct Component {
  u32 id = none;      // smallest vertex
  u32 family = none;  // before: parent in the union-find of related components; after: an old relative, or none
  i32 euler = 0;      // 2 V - F, twice the Euler characteristic of a closed triangle mesh
  Turn turn = Turn::first;
  f64 six_volumes = 0, six_volumes_before = 0;  // signed, now and at the start of the transaction; where asked for
};

struct Components {
  u32* label = nullptr;  // per vertex: index of its component
  Stack<Component> list; // ascending by id; a closed component has at least four vertices, which bounds it
};

// Fills label and list. `queue` has room for all vertices. O(V).
void find_components(const Mesh& m, Components& c, u32* queue);

// What happened to one family of related components.
struct ComponentChange {
  u32 before_count, after_count;  // components in the family
  u32 before, after;              // smallest ids, or none
  i64 genus_before, genus_after;  // sums
};

// Relates the components (after: of the present mesh, whose vertex_origin gives old ids) and calls visit(change) for
// each family in which anything changed, in the order of their smallest old id, new ones last. O(V).
template <class Visit>
void for_each_change(const Mesh& m, Components& before, Components& after, Visit visit);

namespace components_detail {
u32 find_family(Stack<Component>& list, u32 i);
void relate(const Mesh& m, Components& before, Components& after);
ComponentChange change_of(const Components& before, Components& after, u32 family);
}  // namespace components_detail

template <class Visit>
void for_each_change(const Mesh& m, Components& before, Components& after, Visit visit) {
  using namespace components_detail;
  relate(m, before, after);
  for (u32 i = 0; i < before.list.size; ++i) {
    if (before.list[i].family != i) continue;
    const ComponentChange c = change_of(before, after, i);
    if (c.before_count != c.after_count || c.before_count > 1 || c.genus_before != c.genus_after) visit(c);
  }
  for (const Component& c : after.list)
    if (c.family == none) visit(ComponentChange{0, 1, none, c.id, 0, 1 - c.euler / 4});
}

}  // namespace tpa
