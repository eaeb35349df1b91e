// SPDX-License-Identifier: MIT
// new_faces: would faces that do not exist yet meet anything? Every operation on the mesh asks before it makes faces,
// so the mesh stays free of contacts (sections 5 and 7).
#pragma once

#include "detect/cull_new_faces.h"

namespace tpa {

// Largest star that an operation may touch or make: bounds the stack. Ordinary valences are 5 to 7.
inline constexpr u32 largest_star = 48;

// Is the angle between two normals less than 60 degrees?
bool turns_little(const Vec3& before, const Vec3& after);

// The expected shape of the surface round an operation decides on the proof.
enum class Expected : u8 {
  flat,  // detect/cull_new_faces.h first, then pairs
  bent   // as round an event, where the proof would fail: pairs at once
};

// Do up to largest_star trial faces meet neither each other nor a face in NearFaces? Faces marked in `going`, which may
// be nullptr, do not count. One search serves all trial faces, since they lie close together. Pre of Expected::flat:
// `going` is given, and the mesh with the trial faces in place of the going ones is closed. Expected O(log V + faces
// near by).
bool trials_are_free(const Mesh& m, const NearFaces& g, const u8* going, const FaceCorners* trials, u32 n,
                     Expected expected);

}  // namespace tpa
