// SPDX-License-Identifier: MIT
// topology: components of a closed mesh, for reports; what a mesh may need before its load. Counted from the triangles
// alone, not asked of the library.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tool/io/mesh_io.h"

namespace tool {

struct Part {
  size_t vertices = 0, triangles = 0;
  long genus = 0;
  double volume = 0;        // signed
  double volume_doubt = 0;  // most that rounding may make of it
  std::array<double, 3> low{}, high{};
};

// Largest component (by vertices) first. O(V).
std::vector<Part> parts_of(const TriangleMesh& mesh);
// The same, with the component of each triangle.
std::vector<Part> parts_of(const TriangleMesh& mesh, std::vector<uint32_t>& part_of_triangle);

// Is the signed volume of all triangles together negative, by more than rounding may make it? `volume` receives it.
bool is_inside_out(const TriangleMesh& mesh, double& volume);

// Makes every triangle wind the other way round.
void turn_round(TriangleMesh& mesh);

// Takes out the components whose volume is of less than `least` in magnitude. Returns their number. O(V).
size_t drop_small_parts(TriangleMesh& mesh, double least);

// The library takes 0 and magnitudes from 2^-100 to 2^100. Sets smaller ones to 0, and returns how many there were.
size_t clear_tiny_coordinates(TriangleMesh& mesh);

}  // namespace tool
