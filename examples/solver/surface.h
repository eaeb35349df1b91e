// SPDX-License-Identifier: MIT
// A moving surface: a context of topoadapt in a block that frees itself, errors as exceptions, and data of a solver
// that follow each commit.
#ifndef SOLVER_SURFACE_H
#define SOLVER_SURFACE_H

#include <topoadapt.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <vector>

namespace solver {

using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Triangles = Eigen::Matrix<uint32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

class Surface {
 public:
  Surface(const Points& points, const Triangles& triangles, uint32_t most_vertices);

  // Without copies; valid until the next call that is not const.
  Eigen::Map<const Points> points() const;
  Eigen::Map<const Triangles> triangles() const;

  // Each call is a commit: data of the solver have to follow() before the next one.
  tpa_report step(const Points& targets);
  void remesh(double edge_length);

  // One value for each vertex, from before the last commit to after it. Works for everything that has sums and
  // multiples.
  template <class Value>
  void follow(std::vector<Value>& values) const;
  tpa_vertex_map_view map() const;

  std::vector<tpa_component> components(std::vector<uint32_t>& labels) const;
  tpa_validation validate();
  const tpa_context* context() const { return context_; }

 private:
  std::unique_ptr<unsigned char[]> block_;
  tpa_context* context_ = nullptr;
};

template <class Value>
void Surface::follow(std::vector<Value>& values) const {
  const tpa_vertex_map_view origins = map();
  std::vector<Value> after;
  after.reserve(origins.new_count);
  for (uint32_t v = 0; v < origins.new_count; ++v) {
    const tpa_vertex_origin& o = origins.origins[v];
    if (o.parents[1] == TPA_NONE) {
      after.push_back(values[o.parents[0]]);  // an old vertex, to the bit
    } else {
      const double weight = o.weight;
      after.push_back(weight * values[o.parents[0]] + (1 - weight) * values[o.parents[1]]);
    }
  }
  values.swap(after);
}

}  // namespace solver

#endif
