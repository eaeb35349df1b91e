// SPDX-License-Identifier: MIT
// remeshers: those that the benchmark of remeshing compares, each with the same mesh, length and number of sweeps.
#pragma once

#include "meshes.h"

namespace bench {

struct Remeshed {
  double seconds = 0;  // of processor time, without the making of the remesher's own mesh
  Mesh mesh;
};

// CGAL's isotropic_remeshing (Botsch & Kobbelt 2004), relaxed and projected once in each sweep.
Remeshed RemeshWithCgal(const Mesh& mesh, double length, uint32_t sweeps);

// Distances of points to a surface.
struct Distances {
  double mean = 0, most = 0;
};
// From vertices and middles of triangles of `from` to the triangles of `to`.
Distances DistancesTo(const Mesh& from, const Mesh& to);

// Pairs of triangles that meet, by CGAL.
size_t MeetingPairs(const Mesh& mesh);

}  // namespace bench
