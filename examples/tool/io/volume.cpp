// SPDX-License-Identifier: MIT
// volume: separable Gaussian smoothing.
#include "tool/io/volume.h"

#include <algorithm>
#include <cmath>

#include "tool/scenes/elementary.h"

namespace tool {

namespace {

// Weights of offsets 0..radius; the kernel is even.
std::vector<float> half_kernel(double sigma) {
  const int radius = static_cast<int>(std::ceil(4 * sigma));
  std::vector<double> weights;
  double sum = 0;
  for (int i = 0; i <= radius; ++i) {
    weights.push_back(exponential(-0.5 * (i / sigma) * (i / sigma)));
    sum += i == 0 ? weights.back() : 2 * weights.back();
  }
  std::vector<float> kernel;
  for (const double weight : weights) kernel.push_back(static_cast<float>(weight / sum));
  return kernel;
}

void smooth_row(const float* row, size_t length, const std::vector<float>& kernel, std::vector<float>& padded,
                float* out) {
  const size_t radius = kernel.size() - 1;
  padded.resize(length + 2 * radius);
  std::fill_n(padded.begin(), radius, row[0]);
  std::copy_n(row, length, padded.data() + radius);
  std::fill_n(padded.data() + radius + length, radius, row[length - 1]);
  for (size_t x = 0; x < length; ++x) out[x] = kernel[0] * padded[x + radius];
  for (size_t k = 1; k <= radius; ++k) {
    const float* left = padded.data() + radius - k;
    const float* right = padded.data() + radius + k;
    for (size_t x = 0; x < length; ++x) out[x] += kernel[k] * (left[x] + right[x]);
  }
}

// Along y or z whole rows are added up, so memory is walked in order. `count` rows follow each other in `from`; those
// of the result lie `stride` values apart.
void smooth_across_rows(const std::vector<float>& from, float* to, size_t length, int count, size_t stride,
                        const std::vector<float>& kernel) {
  const int radius = static_cast<int>(kernel.size()) - 1;
  const auto row_of = [&](int i) { return from.data() + static_cast<size_t>(std::clamp(i, 0, count - 1)) * length; };
  for (int i = 0; i < count; ++i) {
    const float* centre = row_of(i);
    float* out = to + static_cast<size_t>(i) * stride;
    for (size_t x = 0; x < length; ++x) out[x] = kernel[0] * centre[x];
    for (int k = 1; k <= radius; ++k) {
      const float weight = kernel[static_cast<size_t>(k)];
      const float* before = row_of(i - k);
      const float* after = row_of(i + k);
      for (size_t x = 0; x < length; ++x) out[x] += weight * (before[x] + after[x]);
    }
  }
}

// Along x and y, in place.
void smooth_slice(Volume& volume, int z, const std::vector<float>& along_x, const std::vector<float>& along_y) {
  const size_t length = static_cast<size_t>(volume.nx);
  float* slice = volume.values.data() + volume.index(0, 0, z);
  std::vector<float> padded, rows(length * static_cast<size_t>(volume.ny));
  for (size_t start = 0; start < rows.size(); start += length)
    smooth_row(slice + start, length, along_x, padded, rows.data() + start);
  smooth_across_rows(rows, slice, length, volume.ny, length, along_y);
}

// Along z, in place: the rows of all slices at y.
void smooth_upright(Volume& volume, int y, const std::vector<float>& along_z) {
  const size_t length = static_cast<size_t>(volume.nx), stride = length * static_cast<size_t>(volume.ny);
  std::vector<float> rows(length * static_cast<size_t>(volume.nz));
  float* first = volume.values.data() + volume.index(0, y, 0);
  for (size_t z = 0; z < static_cast<size_t>(volume.nz); ++z)
    std::copy_n(first + z * stride, length, rows.data() + z * length);
  smooth_across_rows(rows, first, length, volume.nz, stride, along_z);
}

// In voxels. Below, a neighbour's weight is zero as a float, and its logarithm may be beyond an int.
constexpr double least_sigma = 0.01;

}  // namespace

void turn_to_lps(Volume& volume) {
  if (volume.space != Space::ras) return;
  volume.to_world = turned_about_z(volume.to_world);
  volume.space = Space::lps;
  volume.is_turned = true;
}

double mean_side(const Volume& volume) { return std::cbrt(std::fabs(determinant(volume.to_world))); }

Status smooth_gaussian(Volume& volume, double sigma, const Workers& workers) {
  std::vector<float> kernels[3];
  for (size_t k = 0; k < 3; ++k) {
    const double in_voxels = sigma / volume.to_world.spacing(k);
    if (!(in_voxels >= 0 && in_voxels <= largest_sigma)) {
      return failure("sigma of ", sigma, " mm is ", in_voxels, " voxels along axis ", k + 1, ", not within 0 to ",
                     largest_sigma);
    }
    kernels[k] = in_voxels < least_sigma ? std::vector<float>{1} : half_kernel(in_voxels);
  }
  if (sigma == 0 || volume.values.empty()) return success();
  workers.for_each(static_cast<uint32_t>(volume.nz),
                   [&](uint32_t z) { smooth_slice(volume, static_cast<int>(z), kernels[0], kernels[1]); });
  workers.for_each(static_cast<uint32_t>(volume.ny),
                   [&](uint32_t y) { smooth_upright(volume, static_cast<int>(y), kernels[2]); });
  return success();
}

}  // namespace tool
