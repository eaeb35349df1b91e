// SPDX-License-Identifier: MIT
#include "tool/scenes/sphere.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace tool {

namespace {

// Rings of latitude 0 (north pole) to 2 * parts (south pole), each cut into four sides.
int side_length(int parts, int ring) { return parts - std::abs(parts - ring); }
int ring_size(int parts, int ring) { return std::max(1, 4 * side_length(parts, ring)); }
int ring_start(int parts, int ring) {
  int start = 0;
  for (int r = 0; r < ring; ++r) start += ring_size(parts, r);
  return start;
}

void add_vertex(TriangleMesh& mesh, const double (&center)[3], double radius, int parts, int ring, int i) {
  constexpr double corner[5][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 0}};
  const int length = std::max(1, side_length(parts, ring)), side = i / length;
  const double t = static_cast<double>(i % length) / length;
  const double z = static_cast<double>(parts - ring) / parts, rim = 1 - std::fabs(z);
  const double x = rim * ((1 - t) * corner[side][0] + t * corner[side + 1][0]);
  const double y = rim * ((1 - t) * corner[side][1] + t * corner[side + 1][1]);
  const double scale = radius / std::sqrt(x * x + y * y + z * z);
  for (const double c : {center[0] + scale * x, center[1] + scale * y, center[2] + scale * z})
    mesh.positions.push_back(c);
}

// The triangles between two neighbouring rings: on each side, one more with its base on the longer ring.
void add_band(TriangleMesh& mesh, int parts, int ring) {
  const bool north = ring < parts;
  const int outer = north ? ring + 1 : ring, inner = north ? ring : ring + 1;  // by length
  const int outer_start = ring_start(parts, outer), inner_start = ring_start(parts, inner);
  const int outer_side = side_length(parts, outer), inner_side = side_length(parts, inner);
  const auto at = [&](int start, int r, int i) { return static_cast<uint32_t>(start + i % ring_size(parts, r)); };
  const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
    if (!north) std::swap(b, c);
    mesh.triangles.insert(mesh.triangles.end(), {a, b, c});
  };
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < outer_side; ++i) {
      const uint32_t tip = at(inner_start, inner, side * inner_side + i);
      const uint32_t left = at(outer_start, outer, side * outer_side + i);
      const uint32_t right = at(outer_start, outer, side * outer_side + i + 1);
      add(tip, left, right);
      if (i + 1 < outer_side) add(tip, right, at(inner_start, inner, side * inner_side + i + 1));
    }
}

}  // namespace

TriangleMesh make_sphere(const double (&center)[3], double radius, int parts) {
  parts = std::max(1, parts);
  TriangleMesh mesh;
  for (int ring = 0; ring <= 2 * parts; ++ring)
    for (int i = 0; i < ring_size(parts, ring); ++i) add_vertex(mesh, center, radius, parts, ring, i);
  for (int ring = 0; ring < 2 * parts; ++ring) add_band(mesh, parts, ring);
  return mesh;
}

}  // namespace tool
