// SPDX-License-Identifier: MIT
#include "tool/view/slice.h"

#include <algorithm>
#include <cmath>

namespace tool {

namespace {

// For each axis of the volume, another axis of the world: the nearest pair first.
std::array<size_t, 3> nearest_world_axes(const Affine& map) {
  std::array<size_t, 3> world = {3, 3, 3};
  std::array<bool, 3> taken{};
  for (int round = 0; round < 3; ++round) {
    size_t best_axis = 0, best_world = 0;
    double best = -1;
    for (size_t i = 0; i < 3; ++i)
      for (size_t w = 0; w < 3; ++w) {
        const double share = std::fabs(map.axes[i][w]) / map.spacing(i);
        if (world[i] == 3 && !taken[w] && share > best) best = share, best_axis = i, best_world = w;
      }
    world[best_axis] = best_world;
    taken[best_world] = true;
  }
  return world;
}

// The letters at the low and the high end of the world's axes.
const char* letters_of(Space space, size_t world) {
  constexpr const char* ras[3] = {"LR", "PA", "IS"};
  constexpr const char* lps[3] = {"RL", "AP", "IS"};
  return space == Space::ras ? ras[world] : lps[world];
}

std::array<int, 3> sizes_of(const Volume& v) { return {v.nx, v.ny, v.nz}; }

void find_contour(const TriangleMesh& mesh, const Affine& to_index, Slice& s) {
  const SliceLayout& l = s.layout;
  std::vector<Point> index(mesh.positions.size() / 3);
  for (size_t v = 0; v < index.size(); ++v)
    index[v] = to_index({mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]});
  const auto place = [&](const Point& p) {
    return std::array<double, 2>{l.flip_right ? s.width - 1 - p[l.right] : p[l.right],
                                 l.flip_down ? s.height - 1 - p[l.down] : p[l.down]};
  };
  for (size_t f = 0; f < mesh.triangles.size(); f += 3) {
    std::array<double, 4> segment{};
    size_t ends = 0;
    for (size_t i = 0; i < 3; ++i) {
      const Point &p = index[mesh.triangles[f + i]], &q = index[mesh.triangles[f + (i + 1) % 3]];
      if ((p[l.axis] > s.at) == (q[l.axis] > s.at)) continue;
      const double t = (s.at - p[l.axis]) / (q[l.axis] - p[l.axis]);
      const std::array<double, 2> at = place(p + t * (q - p));
      segment[2 * ends] = at[0];
      segment[2 * ends + 1] = at[1];
      ++ends;
    }
    if (ends == 2) s.contour.push_back(segment);
  }
}

}  // namespace

std::array<SliceLayout, 3> slice_layouts(const Affine& map, Space space) {
  const std::array<size_t, 3> world = nearest_world_axes(map);
  // To the right and down, the world runs to the left of the patient, to the back, and to the feet.
  const auto flipped = [&](size_t i) {
    const bool wanted = world[i] < 2 && space != Space::ras;
    return (map.axes[i][world[i]] > 0) != wanted;
  };
  const auto set_letters = [&](size_t i, char(&ends)[2]) {
    if (space == Space::unnamed) return;
    const char* letters = letters_of(space, world[i]);
    const bool turned = (map.axes[i][world[i]] > 0) == flipped(i);
    ends[0] = letters[turned ? 1 : 0];
    ends[1] = letters[turned ? 0 : 1];
  };
  std::array<SliceLayout, 3> layouts;
  for (size_t axis = 0; axis < 3; ++axis) {
    SliceLayout& l = layouts[axis];
    const size_t p = axis == 0 ? 1 : 0, q = axis == 2 ? 1 : 2;
    l.axis = axis;
    l.world = world[axis];
    l.down = world[p] > world[q] ? p : q;
    l.right = l.down == p ? q : p;
    l.flip_right = flipped(l.right);
    l.flip_down = flipped(l.down);
    set_letters(l.right, l.sides);
    set_letters(l.down, l.poles);
  }
  return layouts;
}

Slice slice_of(const Volume& volume, const Affine& to_world, const SliceLayout& layout, int at,
               const TriangleMesh& mesh) {
  const std::array<int, 3> size = sizes_of(volume);
  Slice s;
  s.layout = layout;
  s.at = std::clamp(at, 0, size[layout.axis] - 1);
  s.width = size[layout.right];
  s.height = size[layout.down];
  s.step_right = to_world.spacing(layout.right);
  s.step_down = to_world.spacing(layout.down);
  std::array<int, 3> voxel{};
  voxel[layout.axis] = s.at;
  for (int y = 0; y < s.height; ++y)
    for (int x = 0; x < s.width; ++x) {
      voxel[layout.right] = layout.flip_right ? s.width - 1 - x : x;
      voxel[layout.down] = layout.flip_down ? s.height - 1 - y : y;
      s.grey.push_back(volume.at(voxel[0], voxel[1], voxel[2]));
    }
  find_contour(mesh, inverse(to_world), s);
  return s;
}

}  // namespace tool
