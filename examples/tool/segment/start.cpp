// SPDX-License-Identifier: MIT
#include "tool/segment/start.h"

#include <algorithm>
#include <cmath>

#include "tool/io/volume_io.h"
#include "tool/segment/mask_surface.h"
#include "tool/topology.h"

namespace tool {

namespace {

void move_by(const Affine& map, TriangleMesh& mesh) {
  for (size_t v = 0; v < mesh.positions.size(); v += 3) {
    double* p = &mesh.positions[v];
    const Point at = map({p[0], p[1], p[2]});
    std::copy(at.begin(), at.end(), p);
  }
  if (determinant(map) < 0) turn_round(mesh);
}

template <class IsInside>
TriangleMesh surface_where(const Volume& volume, IsInside is_inside) {
  std::vector<uint8_t> mask(volume.voxels());
  for (size_t id = 0; id < mask.size(); ++id) mask[id] = is_inside(static_cast<double>(volume.values[id])) ? 1 : 0;
  return mask_surface(volume, mask);
}

}  // namespace

TriangleMesh label_surface(const Volume& volume, double label) {
  return surface_where(volume, [&](double value) { return value == label; });
}

Status read_start_mask(const std::string& path, const Volume& volume, TriangleMesh& first) {
  Volume mask;
  if (Status read = read_volume(path, {std::nullopt, true}, mask); !read) return read;
  first = surface_where(mask, [](double value) { return value != 0 && !std::isnan(value); });
  if (first.triangles.empty()) return failure(path, ": no voxel of the mask differs from 0");
  const bool both = volume.space != Space::unnamed && mask.space != Space::unnamed;
  if (both && volume.space != mask.space) move_by(turned_about_z(Affine()), first);
  return success();
}

Status read_start_mesh(const std::string& path, const Affine& to_world, TriangleMesh& first) {
  if (Status read = read_mesh(path, first); !read) return read;
  if (first.triangles.empty()) return failure(path, ": holds no triangle");
  for (const double x : first.positions)
    if (!std::isfinite(x)) return failure(path, ": holds a coordinate that is not finite");
  move_by(to_world, first);
  return success();
}

}  // namespace tool
