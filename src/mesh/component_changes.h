// component_changes: what a transaction did to components, told from what it touched. From the faces that are not as
// they were, the connected parts of the mesh are searched in turns, until in each family of related components no more
// than one part has an end that was not reached: all that was not looked at belongs to that one. So it costs about what
// was touched, and all but the largest part. Merge, split, genus change and death follow from the relation and from
// Euler's formula alone, so they hold whatever was done to the mesh.
#pragma once

#include "mesh/components.h"
#include "mesh/journal.h"

namespace tpa {

// A connected part of the mesh with a face that is not as it was. Its vertices as far as they are known lie in two
// lists.
struct Part {
  u32 parent;                // in the union-find of parts that have met
  u32 first, last;           // found
  u32 done, last_done;       // found, and all neighbours too
  u32 done_count, outgoing;  // of those: vertices, half-edges that leave them
  u32 component;             // a component before that it is related to
  bool whole;                // nothing is left to find
  u32 family;                // place among the families
  u32 node;                  // as a component after, as what follows
  i32 euler;
  f64 six_volumes, volume_doubt, size;
};

// Components before and parts after that are related by vertices that lived on, or by the parents of new ones.
struct Family {
  u32 before_count, after_count;
  u32 before, after;                    // smallest ids, or none; `after` is known from commit_parts() on
  i32 genus_before, genus_after;        // sums: less than faces
  i32 euler;                            // after, of the part that is not whole
  u32 open_part;                        // which that is, or none
  f64 six_volumes, volume_doubt, size;  // of that part
};

struct Parts {
  u32* part = nullptr;       // per vertex: its part; none outside, and all none before and after
  u32* following = nullptr;  // per vertex: next in its list
  Stack<Part> list;          // a third of the vertices
  Stack<Family> families;    // ordered by their smallest id before; as many as components
  Stack<u32> touched;        // components before, ascending once related; as many as components
  i32* change = nullptr;     // per touched component: of its Euler number, by what was touched
  u32* open = nullptr;       // per touched component that names a family: parts that are not whole
};

inline bool is_root(const Parts& p, const Part& part) { return &p.list[part.parent] == &part; }

// Is the face not as it was?
bool is_changed(const Edit& e, u32 f);

template <class Visit>
void for_each_vertex(const Parts& p, const Part& part, Visit visit) {
  for (u32 v = part.first; v != none; v = p.following[v]) visit(v);
  for (u32 v = part.done; v != none; v = p.following[v]) visit(v);
}

// Finds parts and families. The mesh may have holes in its numbering. `before` is as it was at the start of the
// transaction, and stays so but for `family`, until forget_parts().
void find_parts(const Edit& e, Components& before, Parts& p);
void forget_parts(Components& before, Parts& p);

// How many components there are after.
u32 count_components(const Components& before, const Parts& p);

// Calls visit(family) for each family in which anything changed, in order.
template <class Visit>
void for_each_change(const Parts& p, Visit visit) {
  for (const Family& f : p.families)
    if (f.before_count != f.after_count || f.before_count > 1 || f.genus_before != f.genus_after) visit(f);
}

// Writes the labels after, with as many new nodes as components after at most. Then the mesh is committed, which takes
// labels along.
void label_parts(Components& before, Parts& p);
// After the commit: brings the list of components up to date. The labels of slots beyond the mesh tell where their
// vertices have gone. O(what was found + components); more where the smallest vertex of a large part is gone.
void commit_parts(const Edit& e, Components& c, Parts& p);

}  // namespace tpa
