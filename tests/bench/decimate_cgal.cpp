// SPDX-License-Identifier: MIT
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_ratio_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "real_meshes.h"

namespace bench {

Mesh DecimatedWithCgal(const Mesh& mesh, double share) {
  namespace Simplification = CGAL::Surface_mesh_simplification;
  using Kernel = CGAL::Simple_cartesian<double>;
  using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
  using Vertex = Surface::Vertex_index;
  Surface surface;
  for (size_t i = 0; i < mesh.positions.size(); i += 3)
    surface.add_vertex({mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]});
  for (size_t i = 0; i < mesh.triangles.size(); i += 3)
    surface.add_face(Vertex(mesh.triangles[i]), Vertex(mesh.triangles[i + 1]), Vertex(mesh.triangles[i + 2]));
  Simplification::edge_collapse(surface, Simplification::Count_ratio_stop_predicate<Surface>(share));
  surface.collect_garbage();
  Mesh out;
  for (const Vertex v : surface.vertices()) {
    const Kernel::Point_3& p = surface.point(v);
    out.positions.insert(out.positions.end(), {p.x(), p.y(), p.z()});
  }
  for (const auto f : surface.faces())
    for (const Vertex v : CGAL::vertices_around_face(surface.halfedge(f), surface)) out.triangles.push_back(v);
  return out;
}

}  // namespace bench
