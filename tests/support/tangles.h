// SPDX-License-Identifier: MIT
// tangles: closed meshes that run into themselves, by family and seed, with the expected result if known beforehand.
#pragma once

#include <optional>
#include <ostream>

#include "support/support.h"

namespace support {

struct Tangle {
  Mesh mesh;
  // Genera of the surfaces of the result in ascending order, if they follow from the construction.
  std::optional<std::vector<int64_t>> genera;
};

struct Family {
  const char* name;
  Tangle (*make)(Random& random);
  int cells;  // of the winding grid along the longest side: enough to tell apart what the meshes keep apart
  // Tolerance of the volume, as a share of the exact volume: the joints cut corners as large as a few triangles.
  double volume_tolerance;
  uint32_t count;  // in the full run
  // Coarse: gaps between the surfaces are as small as their triangles, and cleanliness is all that is asked.
  bool coarse = false;
};

inline void PrintTo(const Family& family, std::ostream* out) { *out << family.name; }

const std::vector<Family>& TangleFamilies();
const Family& TangleFamily(const std::string& name);
Tangle MakeTangle(const Family& family, uint64_t seed);

}  // namespace support
