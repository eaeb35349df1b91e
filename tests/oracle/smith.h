// SPDX-License-Identifier: MIT
// smith: the Smith normal form of sparse integer matrices, and with it the homology of a triangulated
// surface.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace smith {

struct Entry {
  int column;
  int64_t value;
};
// Lines of entries, sorted by column, no zeros.
using Matrix = std::vector<std::vector<Entry>>;

// The nonzero elementary divisors, each dividing the next: their number is the rank. Exact: throws std::overflow_error
// when 64 bits overflow.
std::vector<int64_t> ElementaryDivisors(Matrix m, int columns);

// Homology of a complex of triangles: ranks of H0, H1, H2, and the torsion of H0 and H1 (divisors above 1).
struct Homology {
  std::array<int, 3> rank;
  std::array<std::vector<int64_t>, 2> torsion;
  bool operator==(const Homology&) const = default;
};
Homology HomologyOf(const std::vector<std::array<int, 3>>& faces, int vertices);

inline const Homology sphere{{1, 0, 1}, {}};

}  // namespace smith
