// SPDX-License-Identifier: MIT
// winding_grid: which space does a tangled mesh enclose? An oracle on a lattice of cubic cells, without code of the
// library. For each column of cells, the signed crossings of a vertical line with all triangles give the winding number
// at the middle of each cell. The cells of winding number >= 1 form a closed cubical complex. Its Betti numbers tell
// the number and genera of its boundary surfaces.
#pragma once

#include "support/support.h"

namespace support {

struct Lattice {
  Point low;    // corner of cell (0, 0, 0)
  double step;  // side of a cell
  std::array<int, 3> count;
  size_t Cells() const {
    return static_cast<size_t>(count[0]) * static_cast<size_t>(count[1]) * static_cast<size_t>(count[2]);
  }
  size_t At(int i, int j, int k) const {
    return (static_cast<size_t>(k) * static_cast<size_t>(count[1]) + static_cast<size_t>(j)) *
               static_cast<size_t>(count[0]) +
           static_cast<size_t>(i);
  }
  Point Middle(int i, int j, int k) const {
    return {low[0] + step * (i + 0.5), low[1] + step * (j + 0.5), low[2] + step * (k + 0.5)};
  }
};

// Round the mesh and `margin` about it, with two empty cells on each side; `cells` along the longest side of
// the mesh's box.
Lattice LatticeRound(const Mesh& m, int cells, double margin = 0);

// The winding number in the middle of each cell, at Lattice::At.
std::vector<int16_t> WindingNumbers(const Mesh& m, const Lattice& lattice);

// One byte for each cell.
using Cells = std::vector<uint8_t>;
Cells AtLeastOne(const std::vector<int16_t>& winding);
double VolumeOf(const Cells& cells, const Lattice& lattice);
double VolumeOfDifference(const Cells& a, const Cells& b, const Lattice& lattice);

// Adds the cells with middles closer than `distance` to one of the triangles.
void AddNear(const Mesh& m, const std::vector<uint32_t>& triangles, double distance, const Lattice& lattice,
             Cells& cells);
// Takes away marked cells no further than `distance` from the outside.
void Erode(double distance, const Cells& marked, const Lattice& lattice, Cells& cells);

// Fills voids and empties bodies of less than this volume.
void DropSpecks(double volume, const Lattice& lattice, Cells& cells);

// Of the closed cells as a subset of space. Their boundary has bodies + voids surfaces with `tunnels` as the sum of
// their genera (Alexander duality). The outermost cells must be empty.
struct Betti {
  int64_t bodies, tunnels, voids;
  bool operator==(const Betti&) const = default;
};
Betti BettiOf(const Cells& cells, const Lattice& lattice);
std::string Text(const Betti& betti);

}  // namespace support
