// SPDX-License-Identifier: MIT
#include "tool/segment/thickness.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tool {

namespace {

// A grid of squared distances along one axis: `count` numbers, `stride` apart.
struct Line {
  float* first;
  size_t count, stride;
  float step;    // mm from one to the next
  bool bounded;  // beyond the ends lies what distances count from
};

constexpr float far = 1e12f;

// Each number becomes the least of number + squared distance over the line, as far as `reach` mm.
void spread(const Line& line, float reach, std::vector<float>& copy) {
  copy.resize(line.count);
  bool any_near = line.bounded;
  for (size_t i = 0; i < line.count; ++i) {
    copy[i] = line.first[i * line.stride];
    any_near = any_near || copy[i] < far;
  }
  if (!any_near) return;
  const size_t window = std::min(line.count, static_cast<size_t>(std::min(reach / line.step, 1e9f)) + 1);
  for (size_t i = 0; i < line.count; ++i) {
    if (copy[i] == 0) continue;
    float least = copy[i];
    for (size_t away = 1; away <= window; ++away) {
      const float mm = static_cast<float>(away) * line.step, square = mm * mm;
      if (square >= least) break;
      const auto take = [&](float number) { least = std::min(least, number + square); };
      if (away <= i)
        take(copy[i - away]);
      else if (line.bounded)
        take(0);
      if (i + away < line.count)
        take(copy[i + away]);
      else if (line.bounded)
        take(0);
    }
    line.first[i * line.stride] = least;
  }
}

// Distances in mm from the zeros of `squares`, right up to `reach`; greater ones may be too great.
void measure_distances(const Volume& volume, float reach, bool bounded, std::vector<float>& squares) {
  const size_t nx = static_cast<size_t>(volume.nx), ny = static_cast<size_t>(volume.ny),
               nz = static_cast<size_t>(volume.nz);
  const float steps[3] = {static_cast<float>(volume.to_world.spacing(0)),
                          static_cast<float>(volume.to_world.spacing(1)),
                          static_cast<float>(volume.to_world.spacing(2))};
  std::vector<float> copy;
  for (size_t row = 0; row < ny * nz; ++row) spread({&squares[row * nx], nx, 1, steps[0], bounded}, reach, copy);
  for (size_t k = 0; k < nz; ++k)
    for (size_t i = 0; i < nx; ++i) spread({&squares[k * ny * nx + i], ny, nx, steps[1], bounded}, reach, copy);
  for (size_t i = 0; i < nx * ny; ++i) spread({&squares[i], nz, nx * ny, steps[2], bounded}, reach, copy);
  for (float& square : squares) square = std::sqrt(square);
}

// How far a ball stands for the object round it: corners of a block stick out of its balls by half their radius, and
// voxels of a round border by up to a voxel.
float cover_of(float radius, float half) { return 1.5f * radius + 2 * half; }

// Distances of the object's voxels from the others, less the half voxel by which the border lies nearer.
std::vector<float> depths_of(const Volume& volume, const Object& object, float reach, float half) {
  std::vector<float> depths(volume.voxels());
  for (size_t id = 0; id < depths.size(); ++id) depths[id] = object.mask[id] != 0 ? far : 0;
  measure_distances(volume, reach + half, true, depths);
  for (float& depth : depths) depth = depth > 0 ? std::max(half, depth - half) : 0;
  return depths;
}

bool is_middle(const Volume& volume, const std::vector<float>& depths, const Index& v) {
  const float depth = depths[volume.index(v.i, v.j, v.k)];
  bool middle = true;
  for_each_face_neighbour(volume, v,
                          [&](const Index& u) { middle = middle && depths[volume.index(u.i, u.j, u.k)] <= depth; });
  return middle;
}

// Raises the parts of the voxels within `depth` of a middle.
void paint_ball(const Volume& volume, const Index& v, float depth, uint8_t part, std::vector<uint8_t>& parts) {
  const int size[3] = {volume.nx, volume.ny, volume.nz}, at[3] = {v.i, v.j, v.k};
  int low[3], high[3];
  float step[3];
  for (size_t k = 0; k < 3; ++k) {
    step[k] = static_cast<float>(volume.to_world.spacing(k));
    const int reach = static_cast<int>(depth / step[k]) + 1;
    low[k] = std::max(0, at[k] - reach);
    high[k] = std::min(size[k] - 1, at[k] + reach);
  }
  const auto square = [&](int a, int b, size_t k) { return float(a - b) * step[k] * float(a - b) * step[k]; };
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j) {
      const float rest = depth * depth - square(k, at[2], 2) - square(j, at[1], 1);
      for (int i = low[0]; i <= high[0]; ++i)
        if (square(i, at[0], 0) <= rest) {
          uint8_t& there = parts[volume.index(i, j, k)];
          there = std::max(there, part);
        }
    }
}

}  // namespace

namespace {

// The numbers of the eight voxels round a place.
std::array<size_t, 8> voxels_round(const EdgeField& field, const Point& place) {
  const Point p = field.to_index(place);
  const AxisPosition on[3] = {position_on_axis(p[0], field.nx), position_on_axis(p[1], field.ny),
                              position_on_axis(p[2], field.nz)};
  std::array<size_t, 8> round{};
  for (size_t corner = 0; corner < 8; ++corner) {
    const size_t i = static_cast<size_t>(corner & 1 ? on[0].upper : on[0].lower);
    const size_t j = static_cast<size_t>(corner & 2 ? on[1].upper : on[1].lower);
    const size_t k = static_cast<size_t>(corner & 4 ? on[2].upper : on[2].lower);
    round[corner] = (k * static_cast<size_t>(field.ny) + j) * static_cast<size_t>(field.nx) + i;
  }
  return round;
}

}  // namespace

double EdgeField::part_at(const Point& place) const {
  if (parts.empty()) return 1;
  uint8_t lowest = 255;
  for (const size_t id : voxels_round(*this, place))
    if (parts[id] > 0) lowest = std::min(lowest, parts[id]);
  return lowest / 255.0;
}

bool EdgeField::is_shortened_at(const Point& place) const {
  if (shortened.empty()) return false;
  const std::array<size_t, 8> round = voxels_round(*this, place);
  return std::any_of(round.begin(), round.end(), [&](size_t id) { return shortened[id] != 0; });
}

EdgeField measure_edges(const Volume& volume, const Object& object, double shortest, double longest) {
  EdgeField field{inverse(volume.to_world), volume.nx, volume.ny, volume.nz, 1, {}, {}};
  if (shortest >= longest) return field;
  const float thick = static_cast<float>(longest / edge_of_radius);
  const float half = 0.5f * static_cast<float>(mean_side(volume));
  const std::vector<float> depths = depths_of(volume, object, thick, half);
  std::vector<float> from_thick(depths.size());
  for (size_t id = 0; id < depths.size(); ++id) from_thick[id] = depths[id] >= thick ? 0 : far;
  const float cover = cover_of(thick, half);
  measure_distances(volume, cover, false, from_thick);
  std::vector<uint8_t> radii(depths.size(), 0);  // of 255 for `thick`
  for (size_t id = 0; id < depths.size(); ++id) radii[id] = from_thick[id] <= cover ? 255 : 0;
  for (int k = 0; k < volume.nz; ++k)
    for (int j = 0; j < volume.ny; ++j)
      for (int i = 0; i < volume.nx; ++i) {
        const size_t id = volume.index(i, j, k);
        if (depths[id] > 0 && radii[id] < 255 && is_middle(volume, depths, {i, j, k}))
          paint_ball(volume, {i, j, k}, cover_of(depths[id], half), static_cast<uint8_t>(255 * depths[id] / thick),
                     radii);
      }
  const uint8_t least = static_cast<uint8_t>(std::max(1.0, std::ceil(255 * shortest / longest)));
  uint8_t finest = 255;
  for (size_t id = 0; id < radii.size(); ++id) {
    radii[id] = object.mask[id] != 0 ? std::max(radii[id], least) : uint8_t{0};
    if (radii[id] != 0) finest = std::min(finest, radii[id]);
  }
  if (finest == 255) return field;
  field.least = finest / 255.0;
  field.parts = std::move(radii);
  return field;
}

namespace {

// Halves the parts of the voxels chosen and their neighbours.
void halve_parts(const Volume& volume, const std::vector<uint8_t>& chosen, uint8_t least,
                 const std::vector<uint8_t>& before, std::vector<uint8_t>& parts) {
  const auto halve = [&](const Index& v) {
    const size_t id = volume.index(v.i, v.j, v.k);
    if (before[id] > least) parts[id] = std::max(least, static_cast<uint8_t>(before[id] / 2));
  };
  for (int k = 0; k < volume.nz; ++k)
    for (int j = 0; j < volume.ny; ++j)
      for (int i = 0; i < volume.nx; ++i) {
        if (chosen[volume.index(i, j, k)] == 0) continue;
        halve({i, j, k});
        for_each_face_neighbour(volume, {i, j, k}, halve);
      }
}

// No part is greater than a neighbour's by more than `rise` along each axis; 0 asks for nothing. One sweep in each
// direction spreads a part along any way of steps that are all up or all down, the second pair along the others.
void grade_parts(const Volume& volume, const uint8_t (&rise)[3], std::vector<uint8_t>& parts) {
  const size_t strides[3] = {1, volume.index(0, 1, 0), volume.index(0, 0, 1)};
  const auto take = [&](size_t id, size_t neighbour, size_t axis) {
    if (parts[id] != 0 && parts[neighbour] != 0)
      parts[id] = static_cast<uint8_t>(std::min<int>(parts[id], parts[neighbour] + rise[axis]));
  };
  const int size[3] = {volume.nx, volume.ny, volume.nz};
  for (int sweep = 0; sweep < 4; ++sweep) {
    const bool up = sweep % 2 == 0;
    for (size_t n = 0; n < parts.size(); ++n) {
      const size_t id = up ? n : parts.size() - 1 - n;
      for (size_t axis = 0; axis < 3; ++axis) {
        const int at = static_cast<int>(id / strides[axis] % static_cast<size_t>(size[axis]));
        if (up && at > 0) take(id, id - strides[axis], axis);
        if (!up && at + 1 < size[axis]) take(id, id + strides[axis], axis);
      }
    }
  }
}

}  // namespace

uint64_t shorten_edges(const Volume& volume, const Object& object, const std::vector<uint8_t>& chosen, double least,
                       double longest, EdgeField& field) {
  std::vector<uint8_t> before = field.parts;
  if (before.empty())
    for (const uint8_t inside : object.mask) before.push_back(inside != 0 ? 255 : 0);
  field.parts = before;
  halve_parts(volume, chosen, static_cast<uint8_t>(std::max(1.0, std::ceil(255 * least))), before, field.parts);
  uint8_t rise[3];
  for (size_t k = 0; k < 3; ++k)
    rise[k] = static_cast<uint8_t>(std::clamp(255 * edge_gradation * volume.to_world.spacing(k) / longest, 1.0, 255.0));
  grade_parts(volume, rise, field.parts);
  field.shortened.resize(before.size());
  uint64_t count = 0;
  uint8_t finest = 255;
  for (size_t id = 0; id < before.size(); ++id) {
    field.shortened[id] = field.parts[id] < before[id] ? 1 : 0;
    count += field.shortened[id];
    if (field.parts[id] != 0) finest = std::min(finest, field.parts[id]);
  }
  field.least = finest / 255.0;
  return count;
}

}  // namespace tool
