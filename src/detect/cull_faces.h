// cull_faces: proofs that some faces of the mesh meet nothing of the sheet that they are part of.
//
// Look along about the mean normal of the faces P at an octagon R that bounds them. Let S be P and all faces that are
// reached from it over edges by way of such as may reach over R. If (1) all of S turn the same side up, and (2) some
// point within R is covered by no face of S but one, then no face of P meets any face of S except in what they share,
// as in detect/cull_clusters.h, where clusters take the place of faces and a disc that of R: an edge of S over R
// belongs to two faces over R, both in S, so each point over R that lies on no edge is covered equally often, once; and
// two faces through one point in space, with the faces round it, would both cover what is near that point.
#pragma once

#include "base/simd.h"
#include "detect/face_list.h"
#include "mesh/projection.h"

namespace tpa {

// As many faces are proven at once. Where there are more, R has a shorter border for each, but they bend more, and more
// of another sheet lies beside them (docs/notes/detection.md). S has some 1.5 times as many.
inline constexpr u32 most_unfolded = 256;

// What bounds a face, or R: first x and y, then their sum and difference.
struct Octagon {
  D2 low[2], high[2];
};

// Along any direction onto the plane of two axes: from the origin, the third coordinate times a slope is taken away.
struct Slant {
  View axes;       // the third one has the largest part of the direction
  f64 by_x, by_y;  // the slopes
  f64 origin[3];   // along x, y and z of `axes`
};

struct Unfolded {
  static constexpr u32 most = 768, places = 1024;  // a power of two
  Slant view;
  Octagon r;
  FaceList s;
  u32 face[most], place[places];

  Unfolded() { s.face = face, s.place = place, s.capacity = most; }
  Unfolded(const Unfolded&) = delete;
  bool has(u32 f) const { return number_of(s, f) != none; }  // in S
};

// Is it proven, of up to most_unfolded faces, each given once? O(faces over R), of which it looks at 768 at most.
bool are_unfolded(const Mesh& m, Span<const u32> some, Unfolded& u);

// Is a face certainly not over R? Then it meets none of them either.
bool is_aside(const Mesh& m, const Unfolded& u, u32 f);

}  // namespace tpa
