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
  u32 piece;    // name of the piece of surface that the loop bounds, unique within the group
};

// Loops for one handle to join, or a single loop for a cap: loops[first_loop ..].
struct Piece {
  u32 first_loop, loops;
};

// Marks of old vertices from an attempt for the next; step/attempt.h has further marks in the same byte.
inline constexpr u8 taken_along = 16;  // the vertex joins the clusters beside it; faces round it are not halved
inline constexpr u8 left_coarse = 32;  // the vertex joins nothing; faces round it are not halved
// Does v come from an old vertex with one of the marks in `which`?
bool comes_from_marked(const Mesh& m, const u8* marks, u8 which, u32 v);

struct Clusters {
  u32* cluster = nullptr;  // per vertex: parent in the disjoint sets of clusters; none outside
  Stack<u32> members;      // all vertices of clusters
  Stack<Cut> cuts;
  Vec3* middle = nullptr;  // per snapped cut: the mean of the middles of all edges cut at its vertex
  Stack<CutLoop> loops;    // after find_pieces(): ordered by group and piece
  Stack<Piece> pieces;
  u32 groups = 0;
  u32 removed_patches = 0, removed_patch_vertices = 0;

  // Two views of one array, zero before and after use. Per face:
  u8* walked = nullptr;  // find_loops(): bit i is set while the loop through half-edge 3 f + i is known
  u8* met = nullptr;     // find_pieces(): what meets the half-edges, see MetBy

  // Notes. The stages of step/scratch.h lay these arrays over each other. An array is alive in the function named
  // beside it, together with other arrays of the same function only. Notes on a cluster stand at the vertex that names
  // it.
  u32* group = nullptr;          // form_groups(), on clusters: parent in the disjoint sets of groups
  u32* group_number = nullptr;   // form_groups(), on clusters
  u8* stays = nullptr;           // keep_exposed() and drop_staying(), on members: 1 to leave the clusters
  i32* steepness = nullptr;      // keep_exposed(), on clusters: steep contacts less flat contacts
  u32* traits = nullptr;         // find_coarse_faces() to spare_largest(), on clusters: ClusterTrait
  i32* euler = nullptr;          // find_coarse_faces(), on clusters: Euler's number
  u32* volume_rank = nullptr;    // spare_largest(), on clusters, first: ordered as volumes of their components
  u32* member_traits = nullptr;  // spare_largest(), on members, afterwards: traits of the cluster
  u32* stretches = nullptr;      // snap_cuts(), on vertices outside: stretches of loops along the vertex
  u32* taken_in = nullptr;       // merge_cuts(), on vertices outside: new vertices that the vertex has taken in
};

// Moves a cut to a place in the list that is free by now.
inline void move_cut(Clusters& r, u32 from, u32 to) {
  r.cuts[to] = r.cuts[from];
  if (is_snapped(r.cuts[to])) r.middle[to] = r.middle[from];
}

inline bool in_cluster(const Clusters& r, u32 v) { return r.cluster[v] != none; }

// In Clusters::met: bit i of face f is set while something meets half-edge 3 f + i. Bit i + 3 is set as well, unless
// only one face meets the half-edge and passes through.
enum MetBy : u8 { by_one = 1, by_more = 8 };
inline bool is_met(const Clusters& r, u32 h, MetBy by = by_one) {
  return (r.met[face_of(h)] >> index_in_face(h) & by) != 0;
}

// Joins members across edges, but for the edges marked in `met`. Pre: each member is a set of its own in the disjoint
// sets `parent`. O(members).
void join_members(const Mesh& m, const Clusters& r, u32* parent);

// The vertex that names v's cluster.
u32 find_cluster(const Clusters& r, u32 v);

// Do all loops bound the same cluster? If not, several parts of the surface meet there.
bool bound_one_cluster(Span<const CutLoop> loops);

// The cluster of a face in contact.
u32 cluster_of_face(const Mesh& m, const Clusters& r, u32 f);

// Forgets all clusters and loops. O(members).
void forget_clusters(Clusters& r);

// Section 5, "make components of colliding vertices": collects the vertices of all faces in contact, joined across
// edges. Clusters with a common neighbour merge, and the common neighbours join. Merging goes in rounds, each based on
// the clusters before the round, so the result does not depend on the numbering. Old vertices marked taken_along join
// first, if a path of such vertices connects them with a cluster; `marks` is nullptr without such vertices. O(members).
void gather_clusters(const Mesh& m, Span<const Contact> contacts, const u8* marks, Clusters& r);

// Drops the members with `stays` set, and all loops. The other members make clusters anew, across their edges; common
// neighbours do not join. O(members).
void drop_staying(const Mesh& m, Clusters& r);

// Section 5, "local refinement": the loops of edges to cut round all clusters, with their cuts. False if there are more
// cuts than fit; cuts_needed is their number in any case. O(members).
bool find_loops(const Mesh& m, Clusters& r, u64& cuts_needed);

// The least that makes a patch an object of its own, rather than a gap in a cluster.
enum class LeastObject : u8 {
  closed_mesh,  // as many vertices as the smallest closed mesh
  inner_face    // a face of three vertices without neighbours in clusters: merge_cuts leaves no other face as it was
};

// Section 5, "nested objects": keeps a loop if the patch beyond bounds the region of winding number >= 1 and is an
// object. All other patches join their cluster, except that a gap stays if it is the largest patch of its cluster.
// Expected O(faces along a ray from each loop + vertices of joining patches), and O(loops) for each gap.
void judge_patches(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, LeastObject least, Clusters& r);

// Unites clusters in contact to groups, numbers the groups in the order of their first contacts, and writes cluster and
// group of each loop. O(members + contacts).
void form_groups(const Mesh& m, Span<const Contact> contacts, Clusters& r);

}  // namespace tpa
