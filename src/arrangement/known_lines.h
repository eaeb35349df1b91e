// SPDX-License-Identifier: MIT
// known_lines: points that lie in one plane or on one line by the elements of the mesh that make them. Most ties of an
// arrangement are of this kind, and need no arithmetic.
#pragma once

#include "arrangement/points.h"

namespace tpa {

// Does the point lie in the plane by its origin? False tells nothing.
bool comes_from_plane(const Mesh& m, const ArrangementPoint& p, PlaneRef plane);

// Do the points, not all of them vertices, lie on one edge, or in two planes that cross, by their origins? False tells
// nothing.
bool come_from_line(const Mesh& m, const ArrangementPoint& p, const ArrangementPoint& q, const ArrangementPoint& r);

}  // namespace tpa
