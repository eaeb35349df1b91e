// SPDX-License-Identifier: MIT
// field_shapes: extruded outlines and swept profiles, closed and oriented, that field meshes are put together from.
#pragma once

#include <array>
#include <vector>

#include "support/sample_meshes.h"

namespace support {

using Flat = std::array<double, 2>;
// A closed polygon in the plane. May cross itself.
using Outline = std::vector<Flat>;

double SignedVolume(const Mesh& m);
// Each triangle cut in four, at the middles of its edges.
Mesh Subdivided(const Mesh& m);
double MeanEdgeOf(const Mesh& m);
double DiagonalOf(const Mesh& m);
// Means of the normals at each vertex, weighted by area, of length 1.
std::vector<Point> VertexNormals(const Mesh& m);

// Each edge cut into so many.
Outline Refined(const Outline& outline, int parts);

// A cap is a fan about a vertex in its middle, or about the first corner.
enum class Cap { middle, corner };
// From z = 0 to `height`, in layers. The winding number in between is the outline's.
Mesh Extruded(const Outline& outline, double height, int layers, Cap cap);
// Extruded, for a simple polygon of whole numbers wound counter-clockwise, without three corners in a row on a line.
// Caps are cut by ear clipping.
Mesh Prism(const Outline& outline, double height);

// Rings of equally many points, each joined to the next, and the last to the first if `closed`, else with fans about
// the first corners as ends. Wound so that its volume is positive.
Mesh Lofted(const std::vector<std::vector<Point>>& rings, bool closed);

}  // namespace support
