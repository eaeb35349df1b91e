// SPDX-License-Identifier: MIT
// mesh_oracle: what a mesh is, told from positions and triangles alone: every pair of triangles, maps instead of
// half-edges.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "support/mesh_on_failure.h"
#include "support/sample_meshes.h"

namespace support {

using Pairs = std::vector<std::pair<uint32_t, uint32_t>>;

// Every pair of triangles that meet outside their common corners and edges, sorted: each tried with each. Pre: no
// triangle is degenerate.
Pairs AllMeetingPairs(const Mesh& m);
bool TrianglesMeet(const Mesh& m, uint32_t f, uint32_t g);

struct Component {
  uint32_t smallest_vertex, vertices, triangles;
  int64_t genus;
  double volume;
};

struct Topology {
  std::string defect;                 // empty: closed, oriented, manifold
  std::vector<Component> components;  // by smallest vertex
  int64_t Genus() const;
  double Volume() const;
  // Genera in ascending order, independent of the numbering.
  std::vector<int64_t> Genera() const;
};
Topology TopologyOf(const Mesh& m);

// Solid angle of a triangle seen from p, in full turns. The sum over a closed mesh is the winding number at p (van
// Oosterom and Strackee 1983).
double SolidAngle(const Mesh& m, size_t triangle, const Point& p);

// Closed, oriented, manifold and free of self-intersections (P1)? Empty, or the first fault.
std::string FaultOf(const Mesh& m);
// Writes a faulty mesh to a file (support/mesh_on_failure.h).
testing::AssertionResult IsSound(const Mesh& m, const std::string& name);

}  // namespace support
