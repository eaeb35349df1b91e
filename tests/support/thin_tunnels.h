// SPDX-License-Identifier: MIT
// thin_tunnels: bodies with a true tunnel, or a true handle, far thinner than their edges, there before the step. A
// ball moves into such a body near it, over its mouth or far from it, or two balls meet apart. A step may close only
// what it made.
#pragma once

#include <string>
#include <vector>

#include "support/step_noise.h"

namespace support {

struct TunnelFamily {
  std::string name;
  int shape, contact;  // of the lists in thin_tunnels.cpp
};
inline void PrintTo(const TunnelFamily& family, std::ostream* out) { *out << family.name; }
const std::vector<TunnelFamily>& TunnelFamilies();

struct TunnelTrial {
  StepTrial trial;       // wrong or refused: a step failed, or left no sound mesh
  double thickness = 0;  // of the tunnel or handle, in mean edges
  bool met = false;
  bool is_closed = false;  // the true tunnel or handle is gone
  std::string reason;
};

TunnelTrial PlayTunnel(const TunnelFamily& family, uint64_t seed);

}  // namespace support
