// SPDX-License-Identifier: MIT
// tangle_shapes: closed meshes, free of self-intersections unless said otherwise, that tangles are put
// together from.
#pragma once

#include "support/support.h"

namespace support {

int WholeIn(Random& random, int low, int high);
bool Coin(Random& random);
Point RandomDirection(Random& random);

// Turned about the origin, evenly over all rotations.
Mesh RandomlyTurned(Mesh m, Random& random);
// Wound the other way.
Mesh Reversed(Mesh m);
Mesh Resized(Mesh m, double factor);

// A box with counts[i] cells along axis i, each square cut in two.
Mesh Block(Point low, Point high, std::array<int, 3> counts);
// A block about the origin with edges of about `edge`.
Mesh Slab(double x, double y, double z, double edge);
// A straight tube along z about the origin with flat ends and edges of about 2 pi radius / sides.
Mesh Stick(double radius, double length, int sides);
// A tube round a closed curve, in frames of least turning (Wang et al. 2008). May meet itself.
Mesh Ring(const std::vector<Point>& curve, double radius, int sides);
// A ring along the torus knot that goes 2 times round the axis and 3 times through: R = 2, r = 1 across,
// `height` along the axis. In a low one the strands pass through each other, three times.
Mesh Trefoil(double height, double radius, int around, int sides);
// A sphere with waves of up to `height`.
Mesh Bumpy(double height, int parts, Random& random);
// A cone along z with its tip at the origin and rounded ends, of length 1 and this radius at the wide end:
// edges grow with the distance from the tip, from `radius` / `ratio` on.
Mesh Horn(double radius, double ratio, int sides);
// All vertices moved at random, so far that this share of the triangles meet others.
Mesh Noisy(const Mesh& m, double share, Random& random);
// A sphere with the cap within `angle` of the north pole pushed down by up to `depth`: beyond 2 it comes out
// at the bottom.
Mesh Dented(double angle, double depth, int parts);
// A tube along z, pressed flat in `waists` places until its sides are `depth` times its radius past each other. At a
// waist the tube is turned inside out, so waists + 1 parts remain.
Mesh Pinched(double depth, int waists, int sides);

// A mesh from the folder of real meshes; empty if absent.
Mesh SharedMesh(const std::string& file);

}  // namespace support
