// SPDX-License-Identifier: MIT
#include "tool/segment/selection.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace tool {

namespace {

// The median grey value of the object's side. 0 where there is none.
double median_beyond(const Volume& volume, const Threshold& threshold) {
  std::vector<float> beyond;
  for (const float grey : volume.values)
    if (threshold.depth(static_cast<double>(grey)) > 0) beyond.push_back(grey);
  if (beyond.empty()) return threshold.value;
  const auto middle = beyond.begin() + static_cast<std::ptrdiff_t>(beyond.size() / 2);
  std::nth_element(beyond.begin(), middle, beyond.end());
  return static_cast<double>(*middle);
}

// The surface then lies halfway to the voxels that are NaN.
void fill_nan(const Threshold& threshold, Volume& volume) {
  if (std::none_of(volume.values.begin(), volume.values.end(), [](float grey) { return std::isnan(grey); })) return;
  const auto background = static_cast<float>(2 * threshold.value - median_beyond(volume, threshold));
  for (float& grey : volume.values)
    if (std::isnan(grey)) grey = background;
}

void take_label(double label, Volume& volume) {
  for (float& grey : volume.values) grey = static_cast<double>(grey) == label ? 1.0f : 0.0f;
}

void take_band(double lower, double upper, Volume& volume) {
  for (float& grey : volume.values)
    grey = static_cast<float>(std::min(static_cast<double>(grey) - lower, upper - static_cast<double>(grey)));
}

}  // namespace

Status select(const Selection& s, double sigma, Volume& volume, Threshold& threshold, const Workers& workers) {
  if (s.label) {
    take_label(*s.label, volume);
    threshold = {0.5, true, Values::in_label};
    return smooth_gaussian(volume, sigma, workers);
  }
  if (s.threshold) threshold = {*s.threshold, s.bright};
  if (s.lower || s.upper) threshold = {s.lower.value_or(s.upper.value_or(0)), s.lower.has_value()};
  fill_nan(threshold, volume);
  if (Status smoothed = smooth_gaussian(volume, sigma, workers); !smoothed) return smoothed;
  if (!s.lower || !s.upper) return success();
  take_band(*s.lower, *s.upper, volume);
  threshold = {0, true, Values::in_band};
  return success();
}

Status find_labels(const Volume& volume, size_t most, std::vector<int32_t>& labels) {
  std::set<float> values;
  float last = 0;
  for (const float value : volume.values) {
    if (value == last || std::isnan(value)) continue;
    last = value;
    if (value != std::floor(value) || std::fabs(value) > 0x1p24f)
      return failure("the volume is no label map: it holds the value ", value);
    values.insert(value);
    if (values.size() > most + 1) return failure("the volume holds more than ", most, " labels");
  }
  values.erase(0);
  for (const float value : values) labels.push_back(static_cast<int32_t>(value));
  return labels.empty() ? failure("the volume holds no label but 0") : success();
}

}  // namespace tool
