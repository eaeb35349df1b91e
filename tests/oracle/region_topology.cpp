// SPDX-License-Identifier: MIT
#include "oracle/region_topology.h"

#include <algorithm>
#include <cmath>

namespace support {

namespace {

// A share of a cell's side, so that middles of cells lie on no plane of a mesh drawn on a grid of its own.
constexpr double off_grid = 0.3713;

Lattice LatticeOf(const Mesh& m, int cells) {
  const double step = LatticeRound(m, cells).step;
  return LatticeRound(m, cells, off_grid * step);
}

// The region without its boundary: cells that share an edge or a corner alone are apart. The complement is closed, and
// has these numbers by Alexander duality.
Betti OpenBettiOf(Cells cells, const Lattice& lattice) {
  for (int k = 0; k < lattice.count[2]; ++k)
    for (int j = 0; j < lattice.count[1]; ++j)
      for (int i = 0; i < lattice.count[0]; ++i) {
        const bool outermost = i == 0 || j == 0 || k == 0 || i + 1 == lattice.count[0] || j + 1 == lattice.count[1] ||
                               k + 1 == lattice.count[2];
        uint8_t& cell = cells[lattice.At(i, j, k)];
        cell = outermost ? 0 : 1 - cell;
      }
  const Betti outside = BettiOf(cells, lattice);
  return {outside.voids, outside.tunnels, outside.bodies - 1};
}

struct Look {
  Betti closed, open;
};

Look LookAt(const Mesh& m, const Lattice& lattice) {
  const Cells cells = AtLeastOne(WindingNumbers(m, lattice));
  return {BettiOf(cells, lattice), OpenBettiOf(cells, lattice)};
}

// Without surfaces smaller than a cell.
Betti BettiOf(const Topology& t, double speck) {
  Betti betti{0, 0, 0};
  for (const Component& c : t.components) {
    if (std::fabs(c.volume) < speck) continue;
    ++(c.volume > 0 ? betti.bodies : betti.voids);
    betti.tunnels += c.genus;
  }
  return betti;
}

bool IsBetween(const Betti& b, const Look& look) {
  const auto between = [](int64_t x, int64_t a, int64_t c) { return std::min(a, c) <= x && x <= std::max(a, c); };
  return between(b.bodies, look.closed.bodies, look.open.bodies) &&
         between(b.voids, look.closed.voids, look.open.voids);
}

}  // namespace

TopologyVerdict JudgeTopology(const Mesh& given, const Mesh& result, const Topology& found, int cells) {
  const Lattice coarse = LatticeOf(given, cells), fine = LatticeOf(given, cells * 4 / 3);
  const Look truth = LookAt(given, fine);
  TopologyVerdict verdict;
  verdict.touches = !(truth.closed == truth.open);
  if (!(LookAt(given, coarse).closed == truth.closed)) return verdict;
  const Betti surfaces = BettiOf(found, std::pow(fine.step, 3));
  verdict.judged = true;
  if (verdict.touches) {
    verdict.right = IsBetween(surfaces, truth);
  } else {
    const Betti seen = LookAt(result, fine).closed;
    verdict.right = seen == truth.closed && surfaces == truth.closed;
    if (!verdict.right && seen == truth.closed) {
      // Things thinner than a cell? A grid twice as fine may see some.
      verdict.judged = LookAt(given, LatticeOf(given, 2 * cells * 4 / 3)).closed == truth.closed;
      verdict.right = !verdict.judged;
    }
    if (!(seen == truth.closed)) verdict.reason = "the grid sees " + Text(seen) + ", ";
  }
  if (!verdict.right) verdict.reason += Text(surfaces) + " instead of " + Text(truth.closed);
  return verdict;
}

}  // namespace support
