// SPDX-License-Identifier: MIT
#include "tool/view/packing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace tool {

namespace {

using Steps = std::array<uint16_t, 3>;

uint64_t morton_of(const Steps& p) {
  uint64_t code = 0;
  for (int bit = 15; bit >= 0; --bit)
    for (const uint16_t step : p) code = code << 1 | (static_cast<uint64_t>(step) >> bit & 1);
  return code;
}

std::vector<Steps> quantized(const TriangleMesh& mesh, PackedMesh& packed) {
  std::vector<Steps> steps(packed.vertices);
  for (size_t axis = 0; axis < 3; ++axis) {
    double low = INFINITY, high = -INFINITY;
    for (size_t i = axis; i < mesh.positions.size(); i += 3) {
      low = std::min(low, mesh.positions[i]);
      high = std::max(high, mesh.positions[i]);
    }
    packed.box[axis] = low;
    packed.box[axis + 3] = high;
    const double scale = high > low ? 65535 / (high - low) : 0;
    for (size_t v = 0; v < steps.size(); ++v)
      steps[v][axis] = static_cast<uint16_t>(std::lround((mesh.positions[3 * v + axis] - low) * scale));
  }
  return steps;
}

// Vertices in Morton order, so that neighbours have near numbers.
std::vector<uint32_t> ordered(const std::vector<Steps>& steps) {
  std::vector<std::pair<uint64_t, uint32_t>> keys(steps.size());
  for (uint32_t v = 0; v < keys.size(); ++v) keys[v] = {morton_of(steps[v]), v};
  std::sort(keys.begin(), keys.end());
  std::vector<uint32_t> order(steps.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = keys[i].second;
  return order;
}

void append_varint(std::string& bytes, uint32_t value) {
  for (; value >= 128; value >>= 7) bytes += static_cast<char>((value & 127) | 128);
  bytes += static_cast<char>(value);
}

void append_positions(std::string& bytes, const std::vector<Steps>& steps, const std::vector<uint32_t>& order) {
  for (size_t axis = 0; axis < 3; ++axis) {
    std::string low, high;
    uint16_t last = 0;
    for (const uint32_t v : order) {
      const auto difference = static_cast<uint16_t>(steps[v][axis] - last);
      const auto zigzag = static_cast<uint16_t>(difference << 1 ^ (difference >> 15 ? 0xffff : 0));
      low += static_cast<char>(zigzag & 255);
      high += static_cast<char>(zigzag >> 8);
      last = steps[v][axis];
    }
    bytes += low + high;
  }
}

struct Corners {
  std::array<uint32_t, 3> v;  // the least first
  uint8_t mark;
};

std::vector<Corners> sorted_triangles(const TriangleMesh& mesh, const std::vector<uint32_t>& order,
                                      const std::vector<uint8_t>& marks) {
  std::vector<uint32_t> place(order.size());
  for (uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  std::vector<Corners> triangles(mesh.triangles.size() / 3);
  for (size_t f = 0; f < triangles.size(); ++f) {
    auto& v = triangles[f].v;
    for (size_t i = 0; i < 3; ++i) v[i] = place[mesh.triangles[3 * f + i]];
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    triangles[f].mark = marks.empty() ? uint8_t{0} : marks[f];
  }
  std::sort(triangles.begin(), triangles.end(), [](const Corners& a, const Corners& b) { return a.v < b.v; });
  return triangles;
}

// The part of all values, a thousandth here, taken for outliers at each end.
constexpr size_t outliers = 1000, most_sampled = 1000003;

// Doubles the steps along the finest axis until few enough voxels are left.
void choose_steps(const Volume& volume, PackedVolume& packed) {
  const int size[3] = {volume.nx, volume.ny, volume.nz};
  for (;;) {
    size_t voxels = 1, finest = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      packed.size[axis] = (size[axis] - 1) / packed.steps[axis] + 1;
      voxels *= static_cast<size_t>(packed.size[axis]);
      if (packed.steps[axis] * volume.to_world.spacing(axis) < packed.steps[finest] * volume.to_world.spacing(finest))
        finest = axis;
    }
    if (voxels <= most_page_voxels) break;
    packed.steps[finest] *= 2;
  }
  packed.to_world = volume.to_world;
  for (size_t axis = 0; axis < 3; ++axis) {
    packed.to_world.origin = packed.to_world.origin + 0.5 * (packed.steps[axis] - 1) * volume.to_world.axes[axis];
    packed.to_world.axes[axis] = packed.steps[axis] * volume.to_world.axes[axis];
  }
}

double mean_of_block(const Volume& volume, const PackedVolume& packed, int x, int y, int z) {
  const auto [sx, sy, sz] = packed.steps;
  double sum = 0;
  int count = 0;
  for (int k = z * sz; k < std::min(volume.nz, (z + 1) * sz); ++k)
    for (int j = y * sy; j < std::min(volume.ny, (y + 1) * sy); ++j)
      for (int i = x * sx; i < std::min(volume.nx, (x + 1) * sx); ++i) {
        const double grey = static_cast<double>(volume.at(i, j, k));
        sum += std::isfinite(grey) ? grey : packed.low;
        ++count;
      }
  return sum / count;
}

}  // namespace

PackedMesh pack_mesh(const TriangleMesh& mesh, const std::vector<uint8_t>& marks) {
  PackedMesh packed;
  packed.vertices = mesh.positions.size() / 3;
  packed.triangles = mesh.triangles.size() / 3;
  if (packed.vertices == 0) return packed;
  const std::vector<Steps> steps = quantized(mesh, packed);
  const std::vector<uint32_t> order = ordered(steps);
  append_positions(packed.bytes, steps, order);
  uint32_t last = 0;
  const std::vector<Corners> triangles = sorted_triangles(mesh, order, marks);
  for (const Corners& t : triangles) {
    append_varint(packed.bytes, t.v[0] - last);
    append_varint(packed.bytes, t.v[1] - t.v[0]);
    append_varint(packed.bytes, t.v[2] - t.v[0]);
    last = t.v[0];
  }
  if (!marks.empty())
    for (const Corners& t : triangles) packed.bytes += static_cast<char>(t.mark);
  return packed;
}

std::pair<double, double> grey_range(const Volume& volume) {
  std::vector<double> sample;
  const size_t stride = std::max<size_t>(1, volume.values.size() / most_sampled);
  for (size_t i = 0; i < volume.values.size(); i += stride)
    if (std::isfinite(volume.values[i])) sample.push_back(static_cast<double>(volume.values[i]));
  if (sample.empty()) return {0, 1};
  std::sort(sample.begin(), sample.end());
  const size_t cut = sample.size() / outliers;
  double low = sample[cut], high = sample[sample.size() - 1 - cut];
  if (low == high) low = sample.front(), high = sample.back();
  return {low, low == high ? low + 1 : high};
}

PackedVolume pack_volume(const Volume& volume) {
  PackedVolume packed;
  std::tie(packed.low, packed.high) = grey_range(volume);
  choose_steps(volume, packed);
  const double scale = 255 / (packed.high - packed.low);
  for (int z = 0; z < packed.size[2]; ++z)
    for (int y = 0; y < packed.size[1]; ++y) {
      int last = 0;
      for (int x = 0; x < packed.size[0]; ++x) {
        const double grey = (mean_of_block(volume, packed, x, y, z) - packed.low) * scale;
        const int byte = static_cast<int>(std::lround(std::clamp(grey, 0.0, 255.0)));
        packed.bytes += static_cast<char>((byte - last) & 255);
        last = byte;
      }
    }
  return packed;
}

}  // namespace tool
