// SPDX-License-Identifier: MIT
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>
#include <time.h>

#include "cutters.h"

namespace bench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;
namespace pmp = CGAL::Polygon_mesh_processing;

double ProcessorTime() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Surface CuttableOf(const Mesh& mesh) {
  Surface s;
  std::vector<Surface::Vertex_index> vertices;
  for (size_t i = 0; i < mesh.positions.size(); i += 3)
    vertices.push_back(s.add_vertex(Point(mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2])));
  for (size_t t = 0; t < mesh.triangles.size(); t += 3)
    s.add_face(vertices[mesh.triangles[t]], vertices[mesh.triangles[t + 1]], vertices[mesh.triangles[t + 2]]);
  return s;
}

Mesh MeshOfCut(Surface& s) {
  s.collect_garbage();
  Mesh mesh;
  for (const auto v : s.vertices())
    mesh.positions.insert(mesh.positions.end(), {s.point(v).x(), s.point(v).y(), s.point(v).z()});
  for (const auto f : s.faces())
    for (const auto v : s.vertices_around_face(s.halfedge(f))) mesh.triangles.push_back(static_cast<uint32_t>(v.idx()));
  return mesh;
}

}  // namespace

std::optional<Cut> AutorefineWithCgal(const Mesh& mesh) {
  Surface s = CuttableOf(mesh);
  const double start = ProcessorTime();
  if (!pmp::experimental::autorefine_and_remove_self_intersections(s)) return std::nullopt;
  const double seconds = ProcessorTime() - start;
  return Cut{seconds, MeshOfCut(s)};
}

std::optional<Cut> UniteWithCgal(const Mesh& mesh) {
  std::vector<Surface> bodies;
  pmp::split_connected_components(CuttableOf(mesh), bodies);
  Surface all;
  const double start = ProcessorTime();
  for (Surface& body : bodies) {
    Surface united;
    if (!pmp::corefine_and_compute_union(all, body, united, CGAL::parameters::throw_on_self_intersection(true)))
      return std::nullopt;
    all = std::move(united);
  }
  const double seconds = ProcessorTime() - start;
  return Cut{seconds, MeshOfCut(all)};
}

}  // namespace bench
