// SPDX-License-Identifier: MIT
// sample_meshes: closed meshes as samples, and random changes and rotations for them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "support/point.h"
#include "tool/io/mesh_io.h"
#include "tool/scenes/sphere.h"

namespace support {

using Mesh = tool::TriangleMesh;

inline uint32_t VertexCount(const Mesh& m) { return static_cast<uint32_t>(m.positions.size() / 3); }
inline uint32_t TriangleCount(const Mesh& m) { return static_cast<uint32_t>(m.triangles.size() / 3); }
inline Point PositionOf(const Mesh& m, size_t v) {
  return {m.positions[3 * v], m.positions[3 * v + 1], m.positions[3 * v + 2]};
}

// Each vertex p moved to map(p).
template <class Map>
Mesh Mapped(Mesh m, Map map) {
  for (size_t v = 0; v < VertexCount(m); ++v) {
    const Point p = map(PositionOf(m, v));
    std::copy(p.begin(), p.end(), m.positions.begin() + static_cast<std::ptrdiff_t>(3 * v));
  }
  return m;
}

Mesh Sphere(Point center, double radius, int parts);
// A ring round the z axis through `center`: `around` times `across` quadrilaterals, each cut in two.
Mesh Torus(Point center, double ring, double tube, int around, int across);
// A box with each side cut into n by n squares.
Mesh Box(Point low, Point high, int n);
// A closed tube with flat ends round the curve points[0 .. n-1]; `sides` vertices on each circle. The frames are
// square to the curve and keep `up` as well as they can.
Mesh Tube(const std::vector<Point>& points, const std::vector<double>& radii, int sides, Point up);
// One mesh of several components.
Mesh Together(const std::vector<Mesh>& parts);
Mesh Translated(Mesh m, Point by);

using Random = std::mt19937_64;
double Uniform(Random& random, double low, double high);
Point RandomPoint(Random& random, double low, double high);

// Two tips over a ring of three to ten vertices, all nearly in a plane. Many of them cross themselves.
Mesh ThinBody(Random& random);

// The same surface with vertices, triangles and first corners shuffled.
Mesh Renumbered(const Mesh& m, Random& random);
// Turned by one of the 24 rotations that permute the axes: exact.
Point QuarterTurned(Point p, int rotation);
Mesh QuarterTurned(Mesh m, int rotation);

}  // namespace support
