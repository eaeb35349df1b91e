// cull_new_faces: proofs that the faces that an operation would make meet nothing.
//
// Look along an axis at the rectangle R that bounds them, and take all faces S over R within a slab of heights, of the
// mesh as the operation would leave it. If
// (1) no face of S reaches out of the slab, (2) all of S turn the same side up, and (3) some point of R is covered only
// once, then none of the new faces meets any face of S except in what they share.
// For an edge over R belongs to two faces that are over R, and so, by (1), both in S: no border of S runs over R.
// By (2) each point over R that lies on no edge is then covered equally often, by (3) once. Two sheets through one
// point in space would both cover what is near that point. Faces outside S have boxes that do not meet theirs.
// detect/cull_clusters.h proves whole clusters in the same way.
#pragma once

#include "detect/near_faces.h"

namespace tpa {

// A face that does not exist yet.
struct Trial {
  u32 v[3];
};

Vec3 normal_of(const Mesh& m, const Trial& t);

// Is it proven that n trial faces, n > 0, meet neither each other nor anything in the near_faces but faces marked as
// going? Pre: the mesh with the trial faces in place of those that go is closed.
bool covers_once(const Mesh& m, const NearFaces& g, const u8* going, const Trial* trials, u32 n);

}  // namespace tpa
