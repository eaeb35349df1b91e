// SPDX-License-Identifier: MIT
#include "curvature.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <stdexcept>

namespace solver {

namespace {

Eigen::Vector3d corner(const Points& points, const Triangles& triangles, Eigen::Index t, int i) {
  return points.row(triangles(t, i)).transpose();
}

// Twice the area, along the normal.
Eigen::Vector3d double_area(const Points& points, const Triangles& triangles, Eigen::Index t) {
  const Eigen::Vector3d a = corner(points, triangles, t, 0);
  return (corner(points, triangles, t, 1) - a).cross(corner(points, triangles, t, 2) - a);
}

}  // namespace

Sparse stiffness(const Points& points, const Triangles& triangles) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<size_t>(12 * triangles.rows()));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const double area = double_area(points, triangles, t).norm();
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d at = corner(points, triangles, t, i);
      const int b = static_cast<int>(triangles(t, (i + 1) % 3)), c = static_cast<int>(triangles(t, (i + 2) % 3));
      const double product =
          (corner(points, triangles, t, (i + 1) % 3) - at).dot(corner(points, triangles, t, (i + 2) % 3) - at);
      // Obtuse angles would make the matrix indefinite; slivers would make it huge.
      const double weight = std::clamp(0.5 * product / std::max(area, 1e-300), 0.0, 100.0);
      entries.emplace_back(b, b, weight);
      entries.emplace_back(c, c, weight);
      entries.emplace_back(b, c, -weight);
      entries.emplace_back(c, b, -weight);
    }
  }
  Sparse matrix(points.rows(), points.rows());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Eigen::VectorXd vertex_areas(const Points& points, const Triangles& triangles) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(points.rows());
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int i = 0; i < 3; ++i) areas(triangles(t, i)) += double_area(points, triangles, t).norm() / 6;
  return areas;
}

Points vertex_normals(const Points& points, const Triangles& triangles) {
  Points normals = Points::Zero(points.rows(), 3);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int i = 0; i < 3; ++i) normals.row(triangles(t, i)) += double_area(points, triangles, t).transpose();
  return normals.rowwise().normalized();
}

Eigen::MatrixXd diffuse(const Sparse& stiffness, const Eigen::VectorXd& mass, double factor,
                        const Eigen::MatrixXd& before) {
  Sparse matrix = factor * stiffness;
  matrix.diagonal() += mass;
  const Eigen::SimplicialLDLT<Sparse> solved(matrix);
  if (solved.info() != Eigen::Success) throw std::runtime_error("the system cannot be solved");
  return solved.solve(mass.asDiagonal() * before);
}

}  // namespace solver
