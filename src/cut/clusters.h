// clusters: what has to go (section 5 and figures 6, 7). Colliding vertices are gathered into clusters; the cut round
// each cluster is found as simple closed loops; patches that the surface has swallowed or turned inside out are judged
// by their winding number and join their cluster; clusters that collide with each other form one group.
#pragma once

#include "detect/contact.h"
#include "detect/winding_number.h"

namespace tpa {

// An edge from a vertex of a cluster to one outside. It gets a new vertex, and the part towards the cluster goes; or,
// drawn back, all of it goes.
struct Cut {
  u32 half_edge;  // leaves the cluster
  u32 vertex;     // the new vertex on it; or `outside`, where the cut is drawn back to that
  u32 outside;    // the end that stays
  u32 border;     // after the cut: the half-edge of the rest that runs from the next cut's vertex to this one
  f64 seen;       // how much of the edge, from the end that stays up to the first face that it pierces; 1: all of it
};

inline bool is_drawn(const Cut& c) { return c.vertex == c.outside; }

// The cuts[first .. first + count - 1] in the order in which new faces must run through them.
struct CutLoop {
  u32 first, count;
  u32 cluster;  // a vertex of its cluster
  u32 group;    // number of its group
  u32 piece;    // names the piece of the surface that it bounds, among those of its group
};

// Loops that one handle is to join, or a single one that gets a cap: loops[first_loop ..].
struct Piece {
  u32 first_loop, loops;
};

// Marks of vertices, with others beside them (step/attempt.h), from which these tell what goes.
inline constexpr u8 taken_along = 16;  // it joins the clusters that it hangs together with
inline constexpr u8 left_coarse = 32;  // only that the faces round it are not halved, as they are not before either
// Does v come from an old vertex that has one of these marks?
bool comes_from_marked(const Mesh& m, const u8* marks, u8 which, u32 v);

struct Clusters {
  u32* cluster = nullptr;  // per vertex: parent in the union-find of clusters, none outside
  u32* group = nullptr;    // per cluster root: parent in the union-find of groups
  u32* number = nullptr;   // per vertex scratch
  // Per face: bit i set while the loop through half-edge 3 f + i is known; for seams, what meets that (MetBy). Left
  // zero.
  u8* visited = nullptr;
  Stack<u32> members;  // all vertices of clusters
  Stack<Cut> cuts;
  Vec3* middle = nullptr;  // of each cut that is drawn back: the mean of the middles of all edges cut at its vertex
  Stack<CutLoop> loops;    // after find_pieces: ordered by group and piece
  Stack<Piece> pieces;
  u32 groups = 0;
  u32 removed_patches = 0, removed_patch_vertices = 0;
};

// To a place in the list that is not wanted any more.
inline void move_cut(Clusters& r, u32 from, u32 to) {
  r.cuts[to] = r.cuts[from];
  if (is_drawn(r.cuts[to])) r.middle[to] = r.middle[from];
}

inline bool in_cluster(const Clusters& r, u32 v) { return r.cluster[v] != none; }

// In `visited`, for seams: bit i of face f is set while something meets its half-edge 3 f + i, and bit i + 3 unless
// that is one face, which it passes through.
enum MetBy : u8 { by_one = 1, by_more = 8 };
inline bool is_met(const Clusters& r, u32 h, MetBy by = by_one) {
  return (r.visited[face_of(h)] >> index_in_face(h) & by) != 0;
}

// Joins in a union-find, in which each member is by itself, those that an edge connects that nothing is known to meet.
// Which do is as good as random: they are listed before they are joined. O(members).
void join_members(const Mesh& m, const Clusters& r, u32* parent);

// The vertex that names v's cluster.
u32 find_cluster(const Clusters& r, u32 v);

// Else several parts of the surface meet in them.
bool bound_one_cluster(Span<const CutLoop> loops);

// Of a face in contact.
u32 cluster_of_face(const Mesh& m, const Clusters& r, u32 f);

// Undoes what gather() wrote per vertex, in O(members).
void clear(Clusters& r);

// Section 5, "make components of colliding vertices": the vertices of all faces in contact, joined where they are
// neighbours; clusters with a common neighbour merge, and the common neighbours join. Done in rounds that look at the
// clusters as they were before the round, so the result does not depend on the numbering. FaceTree also take in the old
// vertices that are marked as taken_along and hang together with them; `marks` is nullptr where there are none.
// O(result).
void gather(const Mesh& m, Span<const Contact> contacts, const u8* marks, Clusters& r);

// Takes the members out that have a `number` other than 0, and forgets the loops. The others make clusters where they
// are neighbours; common neighbours do not join. O(members).
void release(const Mesh& m, Clusters& r);

// The loops of cut edges round all clusters. False where cuts run out; cuts_needed then says how many there are.
bool find_loops(const Mesh& m, Clusters& r, u64& cuts_needed);

// What a patch must have to be an object of its own and no gap in a cluster.
enum class LeastObject : u8 {
  closed_mesh,  // as many vertices as the smallest closed mesh
  inner_face    // a face of three vertices without neighbours in clusters: coarsening the cut leaves no other as it is
};

// Keeps the loops whose outer patch bounds the region of winding number >= 1 and is an object; the other patches join
// their cluster.
void judge_patches(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, LeastObject least, Clusters& r);

// Groups of clusters that collide, numbered in the order of their first contact; writes cluster and group of each loop.
void form_groups(const Mesh& m, Span<const Contact> contacts, Clusters& r);

}  // namespace tpa
