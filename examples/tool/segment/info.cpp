// SPDX-License-Identifier: MIT
#include "tool/segment/info.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "tool/segment/selection.h"
#include "tool/view/packing.h"

namespace tool {

namespace {

bool is_number(float grey) { return std::isfinite(grey); }

void measure_range(const Volume& volume, VolumeInfo& info) {
  double sum = 0;
  uint64_t count = 0;
  for (const float grey : volume.values) {
    if (!is_number(grey)) {
      ++info.nan;
      continue;
    }
    const auto value = static_cast<double>(grey);
    info.least = count == 0 ? value : std::min(info.least, value);
    info.most = count == 0 ? value : std::max(info.most, value);
    sum += value;
    ++count;
  }
  info.mean = count > 0 ? sum / static_cast<double>(count) : 0;
}

void fill_histogram(const Volume& volume, VolumeInfo& info) {
  std::tie(info.low, info.high) = grey_range(volume);
  info.histogram.assign(info_bins, 0);
  const double bins = info_bins, scale = bins / (info.high - info.low);
  for (const float grey : volume.values) {
    if (!is_number(grey)) continue;
    const double bin = (static_cast<double>(grey) - info.low) * scale;
    ++info.histogram[static_cast<size_t>(std::clamp(bin, 0.0, bins - 1))];
  }
}

// Faces of voxels from each voxel of the part to its border, layer by layer; `part` is 1 where it lies. The last voxel
// reached lies deepest.
void find_depth(const Volume& volume, std::vector<uint8_t>& part, SideInfo& side) {
  std::vector<Index> front, next;
  const auto at = [&](const Index& v) -> uint8_t& { return part[volume.index(v.i, v.j, v.k)]; };
  for (int k = 0; k < volume.nz; ++k)
    for (int j = 0; j < volume.ny; ++j)
      for (int i = 0; i < volume.nx; ++i) {
        const Index here = {i, j, k};
        if (at(here) != 1) continue;
        int inside = 0;
        for_each_face_neighbour(volume, here, [&](const Index& v) { inside += at(v) != 0 ? 1 : 0; });
        // Along an axis of one voxel, the volume's border is none.
        const int faces = 2 * ((volume.nx > 1 ? 1 : 0) + (volume.ny > 1 ? 1 : 0) + (volume.nz > 1 ? 1 : 0));
        if (inside < faces) front.push_back(here);
      }
  for (const Index& v : front) at(v) = 2;
  for (side.depth = 0; !front.empty(); front.swap(next)) {
    ++side.depth;
    side.seed = front[front.size() / 2];
    next.clear();
    for (const Index& here : front)
      for_each_face_neighbour(volume, here, [&](const Index& v) {
        if (at(v) != 1) return;
        at(v) = 2;
        next.push_back(v);
      });
  }
}

// Its parts, and the deepest voxel of the largest.
SideInfo look_at(const Volume& volume, const Threshold& threshold) {
  SideInfo side;
  side.threshold = threshold;
  std::vector<uint8_t> ahead(volume.voxels());
  for (size_t id = 0; id < ahead.size(); ++id) {
    ahead[id] = threshold.depth(static_cast<double>(volume.values[id])) > 0 ? 1 : 0;
    side.voxels += ahead[id];
  }
  Index in_largest;
  std::vector<uint8_t> part = ahead;
  for (int k = 0; k < volume.nz; ++k)
    for (int j = 0; j < volume.ny; ++j)
      for (int i = 0; i < volume.nx; ++i) {
        if (ahead[volume.index(i, j, k)] == 0) continue;
        ++side.parts;
        const uint64_t voxels = flood(volume, {i, j, k}, [&](const Index& v) {
          uint8_t& is_ahead = ahead[volume.index(v.i, v.j, v.k)];
          return is_ahead != 0 ? (is_ahead = 0, true) : false;
        });
        if (voxels <= side.largest) continue;
        side.largest = voxels;
        in_largest = {i, j, k};
      }
  if (side.largest == 0) return side;
  std::vector<uint8_t> largest(volume.voxels());
  flood(volume, in_largest, [&](const Index& v) {
    const size_t id = volume.index(v.i, v.j, v.k);
    if (part[id] == 0) return false;
    part[id] = 0;
    largest[id] = 1;
    return true;
  });
  find_depth(volume, largest, side);
  return side;
}

// Labels lie in patches: along x, most voxels but 0 have the value of the next one but 0. Whole numbers of a scan,
// noisy or with soft borders, do not.
bool lies_in_patches(const Volume& volume) {
  constexpr uint64_t most_changes = 3;  // one for so many pairs
  uint64_t pairs = 0, changes = 0;
  for (size_t id = 1; id < volume.voxels(); ++id) {
    const float here = volume.values[id], before = volume.values[id - 1];
    if (here == 0 || before == 0) continue;
    ++pairs;
    changes += here != before ? 1u : 0u;
  }
  return changes * most_changes <= pairs;
}

void count_labels(const Volume& volume, VolumeInfo& info) {
  std::vector<int32_t> labels;
  if (!lies_in_patches(volume) || !find_labels(volume, most_info_labels, labels)) return;
  for (const int32_t label : labels) info.labels.push_back({label, 0});
  for (const float value : volume.values) {
    const auto at = std::lower_bound(labels.begin(), labels.end(), static_cast<double>(value));
    if (at != labels.end() && static_cast<double>(*at) == static_cast<double>(value))
      ++info.labels[static_cast<size_t>(at - labels.begin())].voxels;
  }
}

}  // namespace

double otsu_threshold(const std::vector<uint64_t>& histogram, double low, double high) {
  const double width = (high - low) / static_cast<double>(histogram.size());
  double total = 0, sum = 0;
  for (size_t b = 0; b < histogram.size(); ++b) {
    total += static_cast<double>(histogram[b]);
    sum += static_cast<double>(histogram[b]) * static_cast<double>(b);
  }
  double below = 0, sum_below = 0, best = -1;
  size_t last = 0, first = histogram.size() - 1;
  for (size_t b = 0; b + 1 < histogram.size(); ++b) {
    below += static_cast<double>(histogram[b]);
    sum_below += static_cast<double>(histogram[b]) * static_cast<double>(b);
    if (histogram[b] == 0 || below == total) continue;
    const double apart = sum_below / below - (sum - sum_below) / (total - below);
    const double between = below * (total - below) * apart * apart;
    if (!(between > best)) continue;
    best = between;
    last = b;
    first = b + 1;
    while (first + 1 < histogram.size() && histogram[first] == 0) ++first;
  }
  return low + width * (static_cast<double>(last + first) + 1) / 2;
}

VolumeInfo info_of(const Volume& volume, const std::optional<double>& threshold) {
  VolumeInfo info;
  measure_range(volume, info);
  fill_histogram(volume, info);
  info.is_given = threshold.has_value();
  info.threshold = threshold.value_or(otsu_threshold(info.histogram, info.low, info.high));
  for (const bool bright : {false, true}) {
    const SideInfo side = look_at(volume, {info.threshold, bright});
    if (side.voxels > 0) info.sides.push_back(side);
  }
  count_labels(volume, info);
  return info;
}

}  // namespace tool
