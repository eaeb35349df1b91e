// SPDX-License-Identifier: MIT
#include "tool/segment/border.h"

#include <algorithm>
#include <cmath>

namespace tool {

namespace {

// Part of a voxel, along the normal, from the border to where the force is full. A dim part of the object has full
// force, too, if its grey values lie beyond the threshold by more than that part of the contrast.
constexpr double part_of_voxel = 1.0 / 64;
// Part of the noise over which the force rises, so that single voxels do not stop a vertex.
constexpr double part_of_noise = 0.25;
// The noise may widen the force up to this part of a voxel.
constexpr double largest_part = 0.5;
// The force has a width even where all grey values are equal.
constexpr double least_width = 1e-6;
// The median of the magnitude of normally distributed numbers is this part of their standard deviation.
constexpr double median_of_normal = 0.6745;

double median_of(std::vector<float>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

// Areas of the faces between neighbours along i, j, k.
Point face_areas(const Affine& map) {
  return {length(cross(map.axes[1], map.axes[2])), length(cross(map.axes[2], map.axes[0])),
          length(cross(map.axes[0], map.axes[1]))};
}

}  // namespace

Border measure_border(const Volume& volume, const Object& object) {
  const Point areas = face_areas(volume.to_world);
  std::vector<float> steps, deviations;
  Border border;
  for (int k = 0; k < volume.nz; ++k)
    for (int j = 0; j < volume.ny; ++j)
      for (int i = 0; i < volume.nx; ++i) {
        const size_t id = volume.index(i, j, k);
        if (object.mask[id] == 0) continue;
        const float grey = volume.values[id];
        float sum = 0;
        int within = 0;
        for_each_face_neighbour(volume, {i, j, k}, [&](const Index& v) {
          const size_t other = volume.index(v.i, v.j, v.k);
          if (object.mask[other] != 0) {
            sum += volume.values[other];
            ++within;
            return;
          }
          steps.push_back(std::fabs(volume.values[other] - grey));
          border.area += areas[v.i != i ? 0 : v.j != j ? 1 : 2];
        });
        if (within == 6) deviations.push_back(std::fabs(grey - sum / 6));
      }
  border.faces = steps.size();
  border.contrast = median_of(steps);
  // The mean of six neighbours adds a sixth of the variance.
  border.noise = median_of(deviations) / median_of_normal / std::sqrt(7.0 / 6);
  return border;
}

double force_width(const Border& border) {
  const double by_contrast = part_of_voxel * border.contrast;
  return std::max(least_width, std::clamp(part_of_noise * border.noise, by_contrast, largest_part * border.contrast));
}

}  // namespace tool
