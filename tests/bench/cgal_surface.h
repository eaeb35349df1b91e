// SPDX-License-Identifier: MIT
// cgal_surface: meshes as CGAL has them, for the peers that take a whole surface.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <time.h>

#include "meshes.h"

namespace bench {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;

inline double Now() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

inline Surface SurfaceOf(const Mesh& mesh) {
  Surface s;
  const auto at = [&](size_t v) {
    return Point(mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]);
  };
  std::vector<Surface::Vertex_index> vertices;
  for (size_t v = 0; v < VertexCount(mesh); ++v) vertices.push_back(s.add_vertex(at(v)));
  for (size_t t = 0; t < mesh.triangles.size(); t += 3)
    s.add_face(vertices[mesh.triangles[t]], vertices[mesh.triangles[t + 1]], vertices[mesh.triangles[t + 2]]);
  return s;
}

inline Mesh MeshOf(Surface& s) {
  s.collect_garbage();
  Mesh mesh;
  for (const auto v : s.vertices())
    mesh.positions.insert(mesh.positions.end(), {s.point(v).x(), s.point(v).y(), s.point(v).z()});
  for (const auto f : s.faces())
    for (const auto v : s.vertices_around_face(s.halfedge(f))) mesh.triangles.push_back(static_cast<uint32_t>(v.idx()));
  return mesh;
}

}  // namespace bench
