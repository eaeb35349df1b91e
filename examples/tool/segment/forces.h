// SPDX-License-Identifier: MIT
// forces: what moves the vertices of the balloon: x' = f - g of Chen & Medioni (1995). f drives a vertex along its
// normal by what the image says at its place; g are springs to the neighbours. Lengths in millimetres.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "tool/io/mesh_io.h"
#include "tool/segment/object.h"

namespace tool {

// Remeshing goes where vertices have moved, and at once where events have made or placed them.
enum class Due : uint8_t { none, moved, made };

// The balloon's state of a vertex, carried along when the mesh changes.
struct Particle {
  float gain = 1;       // of the speed; halved at each turn, 0: anchored
  float last = 0;       // last drive, to notice a turn
  int32_t resting = 0;  // iterations at rest in a row
  Due due = Due::made;  // what has happened here since the last remeshing
};

// The surroundings of a vertex.
struct Star {
  Point normal{};  // area weighted
  Point sum{};     // of the neighbours
  uint32_t degree = 0;
  double shortest = 1e300;  // squared edge
};

struct Forces {
  const Volume& volume;
  Affine to_index;
  double voxel = 1;  // mean side of a voxel
  Threshold threshold;
  double width = 1;        // w: grey values from T to full drive
  double speed = 0.38;     // k: edge lengths for each iteration at full drive
  double tension = 0.25;   // g: part of the way to the mean of the neighbours
  double edge_length = 1;  // aimed at now
  double noise = 0;        // standard deviation of grey values within the object
  // Coordinates are multiples of it. Sums of two have bits to spare, so that middles of edges are exact, and
  // remeshing has nothing to prove for these.
  double grid = 0x1p-24;
};

// The power of two nearest to a 2^24th of a voxel, from below.
inline double grid_for(double voxel) { return std::ldexp(1, std::ilogb(voxel) - 24); }

inline Point point_at(const double* p) { return {p[0], p[1], p[2]}; }

// s: 1 well inside the object, 0 on its border, -1 well outside: clamp(depth / w). The object ends with the volume, at
// the outer faces of its voxels.
double drive(const Forces& forces, const Point& p);

// The stars of all vertices not yet anchored, for vertices at `x`.
void measure_stars(const std::vector<uint32_t>& triangles, const std::vector<double>& x,
                   const std::vector<Particle>& particles, std::vector<Star>& stars);

// Moves a vertex from `p` to `next`; at most half of its shortest edge. Returns false, and moves nothing, where the
// vertex is anchored: after so many turns of its drive, or a few iterations almost at rest.
bool move_vertex(const Forces& forces, const Star& star, const double* p, Particle& particle, double* next);

}  // namespace tool
