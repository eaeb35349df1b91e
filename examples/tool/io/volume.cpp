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

void smooth_rows(const Volume& from, const std::vector<float>& kernel, std::vector<float>& to) {
  const size_t length = static_cast<size_t>(from.nx), radius = kernel.size() - 1;
  std::vector<float> padded(length + 2 * radius);
  for (size_t start = 0; start < from.values.size(); start += length) {
    const float* row = from.values.data() + start;
    std::fill_n(padded.begin(), radius, row[0]);
    std::copy_n(row, length, padded.data() + radius);
    std::fill_n(padded.data() + radius + length, radius, row[length - 1]);
    float* out = to.data() + start;
    for (size_t x = 0; x < length; ++x) out[x] = kernel[0] * padded[x + radius];
    for (size_t k = 1; k <= radius; ++k) {
      const float* left = padded.data() + radius - k;
      const float* right = padded.data() + radius + k;
      for (size_t x = 0; x < length; ++x) out[x] += kernel[k] * (left[x] + right[x]);
    }
  }
}

// Along y or z whole rows are added up, so memory is walked in order. `count` rows lie `stride` values apart.
void smooth_across_rows(const float* from, float* to, size_t length, int count, size_t stride,
                        const std::vector<float>& kernel) {
  const int radius = static_cast<int>(kernel.size()) - 1;
  const auto row_of = [&](int i) { return from + static_cast<size_t>(std::clamp(i, 0, count - 1)) * stride; };
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

// In voxels. Below, a neighbour's weight is zero as a float, and its logarithm may be beyond an int.
constexpr double least_sigma = 0.01;

}  // namespace

double mean_side(const Volume& volume) { return std::cbrt(std::fabs(determinant(volume.to_world))); }

Status smooth_gaussian(Volume& volume, double sigma) {
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
  const size_t row = static_cast<size_t>(volume.nx), slice = row * static_cast<size_t>(volume.ny);
  std::vector<float> other(volume.values.size());
  smooth_rows(volume, kernels[0], other);
  for (size_t z = 0; z < static_cast<size_t>(volume.nz); ++z) {
    smooth_across_rows(other.data() + z * slice, volume.values.data() + z * slice, row, volume.ny, row, kernels[1]);
  }
  for (size_t y = 0; y < static_cast<size_t>(volume.ny); ++y) {
    smooth_across_rows(volume.values.data() + y * row, other.data() + y * row, row, volume.nz, slice, kernels[2]);
  }
  volume.values.swap(other);
  return success();
}

}  // namespace tool
