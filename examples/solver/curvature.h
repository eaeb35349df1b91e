// SPDX-License-Identifier: MIT
// Differential operators on a triangle mesh, and implicit steps with them (Desbrun et al. 1999).
#ifndef SOLVER_CURVATURE_H
#define SOLVER_CURVATURE_H

#include <Eigen/SparseCore>

#include "surface.h"

namespace solver {

using Sparse = Eigen::SparseMatrix<double>;

// Minus the integrated Laplacian, with cotangents: symmetric, rows with sum 0, no negative weights.
Sparse stiffness(const Points& points, const Triangles& triangles);
// A third of the area of a vertex's triangles.
Eigen::VectorXd vertex_areas(const Points& points, const Triangles& triangles);
// Unit normals of vertices, weighted by area; zero where triangles cancel.
Points vertex_normals(const Points& points, const Triangles& triangles);
// The solution x of (mass + factor * stiffness) x = mass * before, for each column: a step of diffusion backward in
// time, which keeps the sum of mass * x.
Eigen::MatrixXd diffuse(const Sparse& stiffness, const Eigen::VectorXd& mass, double factor,
                        const Eigen::MatrixXd& before);

}  // namespace solver

#endif
