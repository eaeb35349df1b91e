// SPDX-License-Identifier: MIT
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>

#include "cgal_surface.h"
#include "cutters.h"

namespace bench {

namespace pmp = CGAL::Polygon_mesh_processing;

std::optional<Cut> AutorefineWithCgal(const Mesh& mesh) {
  Surface s = SurfaceOf(mesh);
  const double start = Now();
  if (!pmp::experimental::autorefine_and_remove_self_intersections(s)) return std::nullopt;
  const double seconds = Now() - start;
  return Cut{seconds, MeshOf(s)};
}

std::optional<Cut> UniteWithCgal(const Mesh& mesh) {
  std::vector<Surface> bodies;
  pmp::split_connected_components(SurfaceOf(mesh), bodies);
  Surface all;
  const double start = Now();
  for (Surface& body : bodies) {
    Surface united;
    if (!pmp::corefine_and_compute_union(all, body, united, CGAL::parameters::throw_on_self_intersection(true)))
      return std::nullopt;
    all = std::move(united);
  }
  const double seconds = Now() - start;
  return Cut{seconds, MeshOf(all)};
}

}  // namespace bench
