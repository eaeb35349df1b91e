// SPDX-License-Identifier: MIT
#include "tool/io/affine.h"

#include <cmath>

namespace tool {

namespace {

// Sides shorter or longer than this are no lengths of voxels, whatever the unit.
constexpr double shortest_side = 1e-9, longest_side = 1e9;
// Least volume of a voxel, as a part of the product of its sides.
constexpr double least_volume = 1e-6;

}  // namespace

const char* name_of(Space space) {
  switch (space) {
    case Space::ras: return "ras";
    case Space::lps: return "lps";
    case Space::unnamed: break;
  }
  return "unnamed";
}

double determinant(const Affine& map) { return dot(map.axes[0], cross(map.axes[1], map.axes[2])); }

bool is_regular(const Affine& map) {
  double sides = 1;
  for (size_t k = 0; k < 3; ++k) {
    const double side = map.spacing(k);
    if (!(side >= shortest_side && side <= longest_side)) return false;
    if (!(std::fabs(map.origin[k]) <= longest_side)) return false;
    sides *= side;
  }
  return std::fabs(determinant(map)) >= least_volume * sides;
}

Affine inverse(const Affine& map) {
  const double d = determinant(map);
  const Point rows[3] = {1 / d * cross(map.axes[1], map.axes[2]), 1 / d * cross(map.axes[2], map.axes[0]),
                         1 / d * cross(map.axes[0], map.axes[1])};
  Affine back;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t k = 0; k < 3; ++k) back.axes[k][i] = rows[i][k];
    back.origin[i] = 0 - dot(rows[i], map.origin);
  }
  return back;
}

Affine turned_about_z(const Affine& map) {
  Affine turned = map;
  for (Point* p : {&turned.axes[0], &turned.axes[1], &turned.axes[2], &turned.origin})
    for (size_t k = 0; k < 2; ++k) (*p)[k] = 0 - (*p)[k];
  return turned;
}

}  // namespace tool
