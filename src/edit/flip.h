// SPDX-License-Identifier: MIT
// flip: the other diagonal of the two faces at an edge, for even angles.
#pragma once

#include "detect/new_faces.h"

namespace tpa {

struct Diamond {
  u32 h, k;  // the half-edges
  u32 f, q;  // their faces
  u32 a, b;  // h runs from a to b
  u32 c, d;  // the third corners of f and q
};

Diamond diamond_at(const Mesh& m, u32 h);

// Is the edge not locally Delaunay? The angles at the apexes add up to more than pi exactly if the sum of the
// cotangents is negative. A margin prevents flips to and fro between equal diagonals.
bool wants_flip(const Mesh& m, u32 h);

// Is the surface nearly flat at x, and would the flip keep a manifold without turning any face over? `trials`: the
// faces of the other diagonal.
bool may_flip(const Mesh& m, const Diamond& x, const FaceCorners (&trials)[2]);

// f = (a, b, c) from h becomes (d, b, c), and q = (b, a, d) from k becomes (c, a, d). The faces enter `near` anew.
void turn_edge(Edit& e, NearFaces& near, const Diamond& x);

}  // namespace tpa
