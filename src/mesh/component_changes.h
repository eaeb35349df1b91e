// SPDX-License-Identifier: MIT
// component_changes: the fate of components in a transaction, told from the touched elements (section 2: merging,
// splitting, changes of genus). A search for connected parts begins at the changed faces. The search ends when each
// family of related components has at most one part with an end not reached: everything not visited belongs to this
// part. The cost grows with the touched elements and all parts but the largest of each family. Relations between
// vertices and Euler's formula alone tell merge, split, change of genus and death, so the answers hold after any edits.
#pragma once

#include "mesh/components.h"
#include "mesh/journal.h"

namespace tpa {

// A list of vertices, linked by Parts::following.
struct VertexList {
  u32 first = none, last = none;
};

// A connected part of the edited mesh, begun at a changed face. Parts unite when they meet. At the end of the search
// each root is a component after the transaction.
struct Part {
  u32 parent;     // in the disjoint sets of united parts
  u32 component;  // the smallest related component before; all others are of the same family

  // While parts are searched.
  VertexList found{};                // vertices with unknown neighbours
  VertexList done{};                 // vertices with all of their neighbours known
  u32 done_count = 0, outgoing = 0;  // of `done`: vertices, outgoing half-edges
  bool is_whole = false;             // nothing is left to find

  // From the end of the search on.
  u32 family = none;  // place among the families
  u32 before = none;  // id of `component`
  i32 euler = 0;

  u32 node = none;                         // from label_parts() on
  SignedVolume volume{0, unknown_volume};  // from measure_parts() on
  f64 size = 0;                            // from measure_parts() on
};

// Components before and parts after, related by old vertices, or by the parents of new vertices.
struct Family {
  u32 before_count = 0, after_count = 0;
  u32 before = none, after = none;        // smallest ids; `after` is known from commit_parts() on
  u32 first_after = none;                 // from commit_parts() on: place of the component `after`
  i32 genus_before = 0, genus_after = 0;  // sums, less than the number of faces
  u32 open_part = none;                   // the part not searched to the end
  // For the open part: the family without all whole parts.
  i32 euler = 0;
  SignedVolume volume{};
  f64 size = 0;
};

struct Parts {
  u32* part = nullptr;        // per vertex: its part; none outside, and everywhere before find_parts() and after
                              // forget_parts()
  u32* following = nullptr;   // per vertex: the next vertex of a list
  Stack<Part> list;           // at most a third of the vertices
  Stack<Family> families;     // ascending by `before`; at most as many as components
  Stack<u32> touched;         // components before, ascending once related; at most as many as components
  i32* change = nullptr;      // per touched component: change of the Euler number
  u32* open = nullptr;        // per family name, while parts are searched: number of parts not whole
  u32* place = nullptr;       // per family name, from then on: place among the families
  u32* next_after = nullptr;  // per component, from commit_parts() on: the next of its family
};

inline bool is_root(const Parts& p, const Part& part) { return &p.list[part.parent] == &part; }

// Has the transaction changed, made or removed the face?
bool is_changed(const Edit& e, u32 f);

template <class Visit>
void for_each_vertex(const Parts& p, const Part& part, Visit visit) {
  for (u32 v = part.found.first; v != none; v = p.following[v]) visit(v);
  for (u32 v = part.done.first; v != none; v = p.following[v]) visit(v);
}

// Finds parts and families from the changed faces among `faces`: those of the journal, or of a part of the transaction
// with holes of its own. The numbering may have holes. `before` has the components at the start of the transaction,
// and their families until forget_parts(); all else stays.
void find_parts(const Edit& e, const BitSet& faces, Components& before, Parts& p);
void forget_parts(Components& before, Parts& p);

// The number of components after the transaction.
u32 count_components(const Components& before, const Parts& p);

// Calls visit(family) for each family with a change, in their order.
template <class Visit>
void for_each_change(const Parts& p, Visit visit) {
  for (const Family& f : p.families)
    if (f.before_count != f.after_count || f.before_count > 1 || f.genus_before != f.genus_after) visit(f);
}

// Calls visit(place) for the components of the family after the commit, ascending.
template <class Visit>
void for_each_after(const Parts& p, const Family& f, Visit visit) {
  for (u32 i = f.first_after; i != none; i = p.next_after[i]) visit(i);
}

// Writes the labels after, with at most as many new nodes as components after. The commit of the mesh comes next, and
// moves labels along.
void label_parts(Components& before, Parts& p);
// After the commit: brings the list of components up to date, with Component::before, and flattens it. The labels of
// slots beyond the mesh are the new numbers of the vertices. O(found vertices + components); more if the smallest
// vertex of a large part is gone.
void commit_parts(const Edit& e, Components& c, Parts& p);

}  // namespace tpa
