// SPDX-License-Identifier: MIT
// cull_faces: proofs that some faces P of the mesh meet nothing of the surface round them (section 3, ahead of the
// exact tests).
//
// View P along about its mean normal. Let R be an octagon that bounds P in the view. The neighbourhood S of P is P with
// all faces that are reached from P over edges by way of faces that may reach over R. If
//   (1) all faces of S turn the same side up, and
//   (2) some point within R is covered by exactly one face of S,
// then no face of P meets a face of S beyond common vertices and edges:
//   An edge of S over R belongs to two faces over R, both in S. With (1), S thus covers all points over R that lie on
//   no edge equally often, by (2) once. Two faces through one point in space, with the faces round that point, would
//   both cover points near by.
// detect/cull_leaves.h has the same proof with leaves for faces and a disc for R.
#pragma once

#include "base/open_hash.h"
#include "base/simd.h"
#include "mesh/projection.h"

namespace tpa {

// Faces that are proven at once. More faces would bend more, and have more of other surfaces beside them; fewer would
// have a longer border of R each (docs/notes/detection.md). S has about 1.5 times as many.
inline constexpr u32 most_unfolded = 256;

// Bounds in a view: of x and y, then of x + y and x - y.
struct Octagon {
  D2 low[2], high[2];
};

// A view along any direction: relative to the origin, x and y less z times the slopes.
struct Slant {
  View axes;       // z is the largest component of the direction
  f64 by_x, by_y;  // the slopes, -1 .. 1
  f64 origin[3];   // x, y and z as in `axes`
};

// P's proof: R and S.
struct Unfolded {
  static constexpr u32 most = 768, slots = 1024;
  Slant view;
  Octagon r;
  Point once;  // of (2), on the first face of P
  u32 count = 0;
  u32 face[most];  // S; P comes first

  bool has(u32 f) const { return number_of(f) != none; }  // in S
  void clear() {
    count = 0;
    numbers_ = {slot_, slots};
    numbers_.clear();
  }
  // Pre: f is not in S, and count < most.
  void add(u32 f) {
    face[count] = f;
    number_of(f) = count;
    ++count;
  }

 private:
  u32& number_of(u32 f) const {
    return numbers_.find(scattered(f), [&](u32 i) { return face[i] == f; });
  }
  u32 slot_[slots];
  OpenHash numbers_;  // of the faces in S
};

// Finds the proof for up to most_unfolded faces, each given once. False if there is none, or S has more than
// Unfolded::most faces. O(faces over R).
bool are_unfolded(const Mesh& m, Span<const u32> some, Unfolded& u);

// Is f certainly not over R? Then f meets no face of P either.
bool is_aside(const Mesh& m, const Unfolded& u, u32 f);

}  // namespace tpa
