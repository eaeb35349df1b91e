// SPDX-License-Identifier: MIT
// cull_new_faces: proofs that the faces to be made by an operation meet nothing (sections 5 and 7).
//
// Look along an axis at the rectangle R that bounds the new faces. Let S be all faces over R within a slab of heights,
// of the mesh as the operation would leave it. Suppose:
// (1) No face of S reaches out of the slab.
// (2) All faces of S turn the same side up.
// (3) A single face of S covers some point of R.
// Then no new face meets a face of S except in common vertices and edges, nor any other face.
//
// Proof. An edge over R within the slab belongs to two faces over R; by (1) both are in S. So no border of S runs over
// R. By (2) each point over R off all edges is then covered equally often, by (3) once. Two faces with a common point
// in space would both cover points close to it, with the faces next to them. Faces outside S have boxes apart from the
// boxes of new faces. detect/cull_leaves.h proves whole leaves in the same way.
#pragma once

#include "detect/near_faces.h"

namespace tpa {

Vec3 normal_of(const Mesh& m, const FaceCorners& t);

// Is it proven that n trial faces, n > 0, meet neither each other nor any face in NearFaces except faces marked as
// going? Pre: the mesh with the trial faces in place of the going faces is closed. Expected O(log V + faces over R), of
// which it looks at 64 at most.
bool covers_once(const Mesh& m, const NearFaces& g, const u8* going, const FaceCorners* trials, u32 n);

}  // namespace tpa
