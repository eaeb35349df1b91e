// SPDX-License-Identifier: MIT
// Surfaces of revolution round the x axis.
#ifndef SOLVER_SHAPES_H
#define SOLVER_SHAPES_H

#include <functional>

#include "surface.h"

namespace solver {

struct Shape {
  Points points;
  Triangles triangles;
};

// Through the points (x, radius) of `profile` at 0 < t < 1, with poles at t = 0 and 1.
Shape revolve(const std::function<Eigen::Vector2d(double t)>& profile, int rings, int sectors);
Shape ball(double x, double radius, double edge_length);
// Two balls on a thin neck.
Shape dumbbell(double edge_length);
Shape join(const Shape& a, const Shape& b);

}  // namespace solver

#endif
