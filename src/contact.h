// contact: the narrow phase of section 3. Which pairs of faces meet anywhere but in the vertex or edge that they
// share? Candidates come from the grid; the answers are exact.
#pragma once

#include "exec.h"
#include "grid.h"

namespace tpa {

struct Contact {
  u32 a, b;  // faces, a < b
  friend constexpr bool operator<(Contact p, Contact q) { return p.a != q.a ? p.a < q.a : p.b < q.b; }
};

// Do two faces meet beyond what they share? Exact; touching counts.
bool faces_meet(const Mesh& m, u32 f, u32 g);
// The same for two triangles given by their vertices, which need not be faces yet.
bool corners_meet(const Mesh& m, const u32* f, const u32* g);

// The first face, in the grid's order, that meets f; none if there is none.
u32 find_meeting(const Mesh& m, const Grid& g, u32 f);

struct Detection {
  Stack<Contact> pairs;  // sorted; only the first `capacity` in no particular order when there are more
  u64 found = 0;         // how many there are
};

// What detection may take for granted, and where it keeps notes.
struct DetectScope {
  const u8* active = nullptr;  // per face: nonzero where the face is new or has moved; pairs of two inactive faces are
                               // known not to meet. nullptr: all are active
  Span<const u32> faces;       // if data is set: exactly the active faces, each once
  u8* star = nullptr;          // per vertex, zeroed by the caller: whether its star is proven unfolded
};

// All contacts in the scope. Expected O(faces in scope + pairs).
void detect(const Mesh& m, const Grid& g, const DetectScope& scope, const Exec& exec, Detection& out);

// Section 3 to the letter: vertices are hashed with cells of edge length `cell`; of the vertices of one slot, triangles
// adjacent to vertices that no path of mesh edges within the slot connects are tested. `head` has `slots` entries,
// `link` and `root` one for each vertex. Expected O(V).
struct VertexHash {
  u32* head;
  u32* link;
  u32* root;
  u32 slots;
  f64 cell;
};
void detect_by_vertices(const Mesh& m, const VertexHash& hash, Detection& out);

}  // namespace tpa
