// SPDX-License-Identifier: MIT
#include "tool/segment/object.h"

#include <algorithm>
#include <cmath>

namespace tool {

namespace {

std::string text_of_point(const Point& p) { return text_of(p[0], ",", p[1], ",", p[2]); }

// The voxel of the object nearest to a point among the eight round it. The interpolant lies on the object's side at
// the point, so that at least one of them does.
Index nearest_voxel(const Volume& volume, const Threshold& threshold, const Point& p) {
  Index best;
  double least = 1e300;
  const AxisPosition on[3] = {position_on_axis(p[0], volume.nx), position_on_axis(p[1], volume.ny),
                              position_on_axis(p[2], volume.nz)};
  for (int corner = 0; corner < 8; ++corner) {
    const Index v{corner & 1 ? on[0].upper : on[0].lower, corner & 2 ? on[1].upper : on[1].lower,
                  corner & 4 ? on[2].upper : on[2].lower};
    if (!(threshold.depth(static_cast<double>(volume.at(v.i, v.j, v.k))) > 0)) continue;
    const double away = std::hypot(p[0] - v.i, p[1] - v.j, p[2] - v.k);
    if (away < least) {
      least = away;
      best = v;
    }
  }
  return best;
}

// What a voxel of the object does.
std::string object_of(const Threshold& threshold) {
  if (threshold.of == Values::in_label) return "has the label";
  if (threshold.of == Values::in_band) return "lies between --lower and --upper";
  return text_of("is ", threshold.bright ? "above" : "below", " the threshold");
}

// Why a place is not of the object. `value` as the volume has it there.
std::string reason_of(const Threshold& threshold, double value) {
  if (threshold.of == Values::in_label) return "the label is another there";
  if (threshold.of == Values::in_band)
    return text_of("the volume lies ", -threshold.depth(value), " outside of --lower to --upper there");
  return text_of("the volume is ", value, " there, not ", threshold.bright ? "above" : "below", " the threshold ",
                 threshold.value);
}

// The voxel of the object nearest to a place in millimetres, in words. O(voxels).
std::string nearest_of_object(const Volume& volume, const Threshold& threshold, const Point& seed) {
  Index best;
  double least = INFINITY;
  for (int k = 0; k < volume.nz; ++k)
    for (int j = 0; j < volume.ny; ++j)
      for (int i = 0; i < volume.nx; ++i) {
        if (!(threshold.depth(static_cast<double>(volume.at(i, j, k))) > 0)) continue;
        const double away = length(volume.to_world({double(i), double(j), double(k)}) - seed);
        if (away < least) least = away, best = {i, j, k};
      }
  if (least == INFINITY) return "; no voxel " + object_of(threshold);
  const Point voxel = {double(best.i), double(best.j), double(best.k)};
  return text_of("; the nearest voxel of the object is ", text_of_point(voxel), ", at ",
                 text_of_point(volume.in_file(volume.to_world(voxel))), " mm, ", least, " mm away");
}

Status check_seed(const Volume& volume, const Threshold& threshold, const Point& seed, const Point& at) {
  const int size[3] = {volume.nx, volume.ny, volume.nz};
  for (size_t k = 0; k < 3; ++k)
    if (!(at[k] >= -0.5 && at[k] <= size[k] - 0.5))
      return failure("seed ", text_of_point(at), " (voxels), ", text_of_point(volume.in_file(seed)),
                     " (mm) lies outside the volume of ", size[0], " x ", size[1], " x ", size[2], " voxels",
                     nearest_of_object(volume, threshold, seed));
  const double grey = volume.sample(at[0], at[1], at[2]);
  if (threshold.depth(grey) > 0) return success();
  return failure("seed ", text_of_point(at), " (voxels), ", text_of_point(volume.in_file(seed)),
                 " (mm) lies outside the object: ", reason_of(threshold, grey),
                 nearest_of_object(volume, threshold, seed));
}

// Adds what is connected with a voxel.
void add_object(const Volume& volume, const Threshold& threshold, const Index& start, Object& object) {
  object.voxels += flood(volume, start, [&](const Index& v) {
    const size_t id = volume.index(v.i, v.j, v.k);
    const bool taken = object.mask[id] == 0 && threshold.depth(static_cast<double>(volume.values[id])) > 0;
    if (taken) object.mask[id] = 1;
    return taken;
  });
}

}  // namespace

Status find_object(const Volume& volume, const Threshold& threshold, const std::vector<Point>& seeds, Object& object) {
  object.mask.assign(volume.voxels(), 0);
  object.voxels = 0;
  const Affine to_index = inverse(volume.to_world);
  for (const Point& seed : seeds) {
    const Point at = to_index(seed);
    if (Status s = check_seed(volume, threshold, seed, at); !s) return s;
    add_object(volume, threshold, nearest_voxel(volume, threshold, at), object);
  }
  return success();
}

Status find_object(const Volume& volume, const Threshold& threshold, const std::vector<uint8_t>& start,
                   Object& object) {
  object.mask.assign(volume.voxels(), 0);
  object.voxels = 0;
  for (int k = 0; k < volume.nz; ++k)
    for (int j = 0; j < volume.ny; ++j)
      for (int i = 0; i < volume.nx; ++i)
        if (start[volume.index(i, j, k)] != 0) add_object(volume, threshold, {i, j, k}, object);
  return object.voxels > 0 ? success() : failure("the first surface encloses no voxel of an object");
}

}  // namespace tool
