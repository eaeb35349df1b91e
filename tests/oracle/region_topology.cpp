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

// Without the outermost layer of cells, and without crumbs of it. Along a slanted edge in which two parts touch, cells
// of both may share faces, and lie in that layer.
Betti PeeledBettiOf(const Mesh& m, const Lattice& lattice) {
  const Cells cells = AtLeastOne(WindingNumbers(m, lattice));
  Cells peeled = cells;
  Erode(1.01 * lattice.step, cells, lattice, peeled);
  DropSpecks(8 * std::pow(lattice.step, 3), lattice, peeled);
  return BettiOf(peeled, lattice);
}

Betti ClosedBettiOf(const Mesh& m, const Lattice& lattice) {
  return BettiOf(AtLeastOne(WindingNumbers(m, lattice)), lattice);
}

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
  const Mesh both = Together({given, result});
  const Lattice coarse = LatticeOf(both, cells), fine = LatticeOf(both, cells * 4 / 3);
  const Look truth = LookAt(given, fine);
  TopologyVerdict verdict;
  verdict.touches = !(truth.closed == truth.open);
  if (!(ClosedBettiOf(given, coarse) == truth.closed)) return verdict;
  const Betti surfaces = BettiOf(found, std::pow(fine.step, 3));
  verdict.judged = true;
  const Betti seen = ClosedBettiOf(result, fine);
  const bool fits = verdict.touches ? IsBetween(surfaces, truth) : surfaces == truth.closed && seen == truth.closed;
  if (fits) return verdict;
  if (surfaces.tunnels == truth.closed.tunnels && IsBetween(surfaces, {truth.closed, PeeledBettiOf(given, fine)})) {
    verdict.touches = true;
    return verdict;
  }
  // Things thinner than a cell? A grid twice as fine may see some. What no grid sees in either mesh, but the surfaces
  // of the result count, is thinner than its cells too.
  const Lattice finer = LatticeOf(both, 2 * cells * 4 / 3);
  const Betti still = ClosedBettiOf(given, finer);
  const bool is_alike = seen == truth.closed && ClosedBettiOf(result, finer) == still;
  verdict.judged = still == truth.closed && !is_alike;
  verdict.right = !verdict.judged;
  if (verdict.judged)
    verdict.reason = Text(surfaces) + " instead of " + Text(truth.closed) + ", by the grid " + Text(seen);
  return verdict;
}

}  // namespace support
