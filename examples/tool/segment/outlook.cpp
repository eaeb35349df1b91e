// SPDX-License-Identifier: MIT
#include "tool/segment/outlook.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tool {

namespace {

// Triangles lie inside a round border, so that this share of the volume is all of it. The balloon settles then.
constexpr double all_filled = 0.97;

}  // namespace

void Outlook::note(double seconds, double share) {
  samples_.push_back({seconds, share});
  while (samples_.front().seconds < seconds / 2) samples_.pop_front();
}

std::optional<double> Outlook::seconds_left() const {
  if (samples_.empty()) return std::nullopt;
  const Sample &first = samples_.front(), &last = samples_.back();
  const double gained = last.share - first.share, rest = std::max(0.0, 1 - last.share);
  if (!(gained > 0)) return std::nullopt;
  return rest / gained * (last.seconds - first.seconds);
}

std::string text_of_progress(uint64_t iteration, uint32_t vertices, double share, double resting,
                             const std::optional<double>& seconds_left) {
  char line[160];
  const int length = std::snprintf(line, sizeof line, "iteration %llu, %u vertices, %.0f %% filled, %.0f %% at rest",
                                   static_cast<unsigned long long>(iteration), vertices,
                                   std::floor(100 * std::min(1.0, share)), 100 * resting);
  std::string text(line, static_cast<size_t>(length));
  if (share >= all_filled) return text + ", settling";
  if (!seconds_left) return text;
  std::snprintf(line, sizeof line, ", full in %.0f s at this speed", std::ceil(*seconds_left));
  return text + line;
}

}  // namespace tool
