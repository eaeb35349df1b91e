// SPDX-License-Identifier: MIT
// clusters: the part of the surface that goes (section 5 and figures 6, 7). Colliding vertices are gathered into
// clusters, the paper's C_i. The edges to cut round a cluster form loops. The surface beyond a loop is a patch. Winding
// numbers judge the patches: a patch that was swallowed by another body or turned inside out joins its cluster.
// Clusters in contact with each other form a group.
#pragma once

#include "detect/contact.h"
#include "detect/winding_number.h"

namespace tpa {

// An edge from a vertex of a cluster to a vertex outside. Local refinement puts a new vertex on the edge, and the part
// towards the cluster goes. A snapped cut runs through the end outside instead, and the whole edge goes.
struct Cut {
  u32 half_edge;  // leaves the cluster
  u32 vertex;     // the new vertex on the edge; `outside` for a snapped cut
  u32 outside;    // the end of the edge outside the cluster, which stays
  u32 border;     // after cut(): the remaining half-edge from the vertex of the next cut to `vertex`
  f64 seen;       // visible share of the edge: from `outside` to the nearest piercing face; 1 without piercing
};

inline bool is_snapped(const Cut& c) { return c.vertex == c.outside; }

// A closed polygon of cuts, cuts[first .. first + count - 1], in the direction of the new faces along its edges.
struct CutLoop {
  u32 first, count;
  u32 cluster;  // a vertex of the loop's cluster; after form_groups() the vertex that names the cluster
  u32 group;    // number of the group
  u32 place;    // form_pieces() of cut/pieces.h: in the list before
};

// Loops for one handle to join, or a single loop for a cap: loops[first_loop ..].
struct Piece {
  u32 first_loop, loops;
};

struct Clusters {
  u32* cluster = nullptr;  // per vertex: parent in the disjoint sets of clusters; none outside
  Stack<u32> members;      // all vertices of clusters
  Stack<Cut> cuts;
  Vec3* middle = nullptr;  // per snapped cut: the mean of the middles of all edges cut at its vertex
  Stack<CutLoop> loops;    // after form_pieces(): ordered by group
  Stack<Piece> pieces;
  u32 groups = 0;
  u32 removed_patches = 0, removed_patch_vertices = 0;

  Meter* meter = nullptr;  // counts the work; where it stops, what is known is of no use
  u8* walked = nullptr;    // per face, zero before and after use. find_loops(): bit i is set while the loop through
                           // half-edge 3 f + i is known

  // Notes. The stages of block/scratch.h lay these arrays over each other. An array is alive in the function named
  // beside it, together with other arrays of the same function only. Notes on a cluster stand at the vertex that names
  // it.
  u32* group = nullptr;         // form_groups(), on clusters: parent in the disjoint sets of groups
  u32* group_number = nullptr;  // form_groups(), on clusters
  u32* stretches = nullptr;     // snap_cuts(), on vertices outside: stretches of loops along the vertex
  u32* taken_in = nullptr;      // merge_cuts(), on vertices outside: new vertices that the vertex has taken in
};

// Moves a cut to a place in the list that is free by now.
inline void move_cut(Clusters& r, u32 from, u32 to) {
  r.cuts[to] = r.cuts[from];
  if (is_snapped(r.cuts[to])) r.middle[to] = r.middle[from];
}

inline bool in_cluster(const Clusters& r, u32 v) { return r.cluster[v] != none; }

// The vertex that names v's cluster.
u32 find_cluster(const Clusters& r, u32 v);

// The cluster of a face in contact.
u32 cluster_of_face(const Mesh& m, const Clusters& r, u32 f);

// Forgets all clusters and loops. O(members).
void forget_clusters(Clusters& r);

// Section 5, "make components of colliding vertices": collects the vertices of all faces in contact, joined across
// edges. Clusters with a common neighbour merge, and the common neighbours join. Merging goes in rounds, each based on
// the clusters before the round, so the result does not depend on the numbering. O(members).
void gather_clusters(const Mesh& m, Span<const Contact> contacts, Clusters& r);

// Section 5, "local refinement": the loops of edges to cut round all clusters, with their cuts. False if there are more
// cuts than fit; cuts_needed is their number in any case. O(members).
bool find_loops(const Mesh& m, Clusters& r, u64& cuts_needed);

// Section 5, "nested objects": keeps a loop if the patch beyond bounds the region of winding number >= 1 and is an
// object: has a face of three vertices without neighbours in clusters, since merge_cuts leaves no other face as it was.
// All other patches join their cluster, except that a gap stays if it is the largest patch of its cluster. Expected
// O(faces along a ray from each loop + vertices of joining patches), and O(loops) for each gap.
void judge_patches(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, Clusters& r);

// After form_groups(): the number of the group of a contact.
u32 number_of_group(const Mesh& m, const Clusters& r, const Contact& c);

// Unites clusters in contact to groups, numbers the groups in the order of their first contacts, and writes cluster and
// group of each loop. O(members + contacts).
void form_groups(const Mesh& m, Span<const Contact> contacts, Clusters& r);

}  // namespace tpa
