// SPDX-License-Identifier: MIT
// ball_union: the topology of a union of balls, from the alpha complex of their centres (Edelsbrunner 1995: the two
// have the same homotopy type), which CGAL computes exactly.
#pragma once

#include <optional>
#include <vector>

#include "tool/scenes/points.h"

namespace support {

struct Betti {
  long components, tunnels, voids;
  bool operator==(const Betti&) const = default;
};

// Was CGAL found when the tests were built? Without CGAL no topology is known.
bool KnowsUnions();

// Empty if the topology differs for some radius within `margin` of the given radius.
std::optional<Betti> BettiOfUnion(const std::vector<tool::Point>& centers, double radius, double margin);

}  // namespace support
