// SPDX-License-Identifier: MIT
#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <algorithm>
#include <cmath>

#include "cgal_surface.h"
#include "remeshers.h"

namespace bench {

namespace pmp = CGAL::Polygon_mesh_processing;

Remeshed RemeshWithCgal(const Mesh& mesh, double length, uint32_t sweeps) {
  Surface s = SurfaceOf(mesh);
  const double start = Now();
  pmp::isotropic_remeshing(s.faces(), length, s,
                           CGAL::parameters::number_of_iterations(sweeps).number_of_relaxation_steps(1));
  Remeshed done;
  done.seconds = Now() - start;
  done.mesh = MeshOf(s);
  return done;
}

Distances DistancesTo(const Mesh& from, const Mesh& to) {
  Surface s = SurfaceOf(to);
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Surface>;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(faces(s).first, faces(s).second, s);
  tree.accelerate_distance_queries();
  Distances d;
  size_t count = 0;
  const auto add = [&](const double(&p)[3]) {
    const double one = std::sqrt(tree.squared_distance(Point(p[0], p[1], p[2])));
    d.mean += one;
    d.most = std::max(d.most, one);
    ++count;
  };
  for (size_t i = 0; i < from.positions.size(); i += 3)
    add({from.positions[i], from.positions[i + 1], from.positions[i + 2]});
  for (size_t t = 0; t < from.triangles.size(); t += 3) {
    double middle[3] = {};
    for (size_t i = 0; i < 3; ++i)
      for (size_t k = 0; k < 3; ++k) middle[k] += from.positions[3 * size_t{from.triangles[t + i]} + k] / 3;
    add(middle);
  }
  d.mean /= static_cast<double>(count);
  return d;
}

size_t MeetingPairs(const Mesh& mesh) {
  const Surface s = SurfaceOf(mesh);
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> pairs;
  pmp::self_intersections(s, std::back_inserter(pairs));
  return pairs.size();
}

}  // namespace bench
