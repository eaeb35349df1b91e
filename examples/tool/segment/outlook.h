// SPDX-License-Identifier: MIT
// outlook: how long the balloon may still take to fill the object, by its speed of late.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

namespace tool {

class Outlook {
 public:
  // The share of the object that is filled, so many seconds after the start. Times never fall.
  void note(double seconds, double share);

  // Until all is filled, at the speed of the second half of the time so far. None where the share does not grow.
  std::optional<double> seconds_left() const;

 private:
  struct Sample {
    double seconds, share;
  };
  std::deque<Sample> samples_;  // of the second half, the oldest first
};

// What the progress line says. `share`: filled; `resting`: the part of the vertices that do not move.
std::string text_of_progress(uint64_t iteration, uint32_t vertices, double share, double resting,
                             const std::optional<double>& seconds_left);

}  // namespace tool
