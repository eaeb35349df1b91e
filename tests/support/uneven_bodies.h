// SPDX-License-Identifier: MIT
// uneven_bodies: unit spheres of uneven sampling, round the z axis.
#pragma once

#include <vector>

#include "support/sample_meshes.h"

namespace support {

// Rings of `meridians` vertices at these angles from the pole, and a vertex at each pole.
Mesh SphereOfRings(const std::vector<double>& angles, int meridians);
Mesh Globe(int meridians, int bands);
// Bands by turns wide and fifty times as narrow.
Mesh Slivers(int meridians, int bands);
// Meridians by turns wide and fifty times as narrow.
Mesh Needles(int meridians, int bands);
// A sphere as of Sphere(), every third vertex of which has moved up to a fiftieth of an edge to a neighbour, unless
// triangles would turn over: slivers in all directions.
Mesh Squeezed(int parts);
// Edges grow from one pole to the equator, 1 to `ratio`, each ring as far from the next as its vertices are.
Mesh GradedSphere(int meridians, double ratio);

}  // namespace support
