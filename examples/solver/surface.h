// SPDX-License-Identifier: MIT
// A moving surface for Eigen: positions and triangles of a mesh as matrices, without copies.
#ifndef SOLVER_SURFACE_H
#define SOLVER_SURFACE_H

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <topoadapt.hpp>

namespace solver {

using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Triangles = Eigen::Matrix<uint32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Surface = topoadapt::Mesh;

// Valid until the next call that is not const.
inline Eigen::Map<const Points> points_of(const Surface& surface) {
  return {surface.positions().data(), static_cast<Eigen::Index>(surface.vertex_count()), 3};
}
inline Eigen::Map<const Triangles> triangles_of(const Surface& surface) {
  return {surface.triangles().data(), static_cast<Eigen::Index>(surface.triangle_count()), 3};
}

}  // namespace solver

#endif
