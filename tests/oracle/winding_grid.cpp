// SPDX-License-Identifier: MIT
#include "oracle/winding_grid.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "oracle/triangle_distance.h"

namespace support {

Lattice LatticeRound(const Mesh& m, int cells, double margin) {
  Point low = PositionOf(m, 0), high = low;
  for (size_t v = 0; v < VertexCount(m); ++v)
    for (size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], m.positions[3 * v + i]);
      high[i] = std::max(high[i], m.positions[3 * v + i]);
    }
  const double longest = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  Lattice lattice{low, longest / cells, {}};
  for (size_t i = 0; i < 3; ++i) {
    lattice.count[i] = static_cast<int>(std::ceil((high[i] - low[i] + 2 * margin) / lattice.step)) + 4;
    lattice.low[i] -= margin + 2 * lattice.step;
  }
  return lattice;
}

namespace {

struct PlanePoint {
  double x, y;
};

// Does the line from `at` towards growing x cross the segment a b, and which way? Both triangles of an edge
// get the same answer with opposite signs, rounding or not, so that the crossings of a closed mesh always add
// up to zero.
int CrossingOfRay(const PlanePoint& at, PlanePoint a, PlanePoint b) {
  int sign = 1;
  if (a.y > b.y || (a.y == b.y && a.x > b.x)) {
    std::swap(a, b);
    sign = -1;
  }
  if (!(a.y <= at.y && at.y < b.y)) return 0;
  return (b.x - a.x) * (at.y - a.y) - (at.x - a.x) * (b.y - a.y) > 0 ? sign : 0;
}

// How often the triangle, seen from above, goes round `at`: 1 counter-clockwise, 0 or -1.
int TurnsRound(const PlanePoint& at, const Point (&p)[3]) {
  int turns = 0;
  for (size_t i = 0; i < 3; ++i) {
    const Point &a = p[i], &b = p[(i + 1) % 3];
    turns += CrossingOfRay(at, {a[0], a[1]}, {b[0], b[1]});
  }
  return turns;
}

// The height of the triangle's plane above (x, y), within the triangle's range.
double HeightAt(const PlanePoint& at, const Point (&p)[3]) {
  const double ux = p[1][0] - p[0][0], uy = p[1][1] - p[0][1], vx = p[2][0] - p[0][0], vy = p[2][1] - p[0][1];
  const double wx = at.x - p[0][0], wy = at.y - p[0][1], area = ux * vy - uy * vx;
  const auto [low, high] = std::minmax({p[0][2], p[1][2], p[2][2]});
  if (area == 0) return low;
  const double s = (wx * vy - wy * vx) / area, t = (ux * wy - uy * wx) / area;
  return std::clamp(p[0][2] + s * (p[1][2] - p[0][2]) + t * (p[2][2] - p[0][2]), low, high);
}

// The cells first .. second - 1 along an axis with middles in [low, high], and one more on each side.
std::pair<int, int> RangeOf(const Lattice& lattice, size_t axis, double low, double high) {
  const double from = (low - lattice.low[axis]) / lattice.step - 1.5,
               to = (high - lattice.low[axis]) / lattice.step + 1.5;
  const int count = lattice.count[axis];
  return {std::clamp(static_cast<int>(std::floor(from)), 0, count),
          std::clamp(static_cast<int>(std::ceil(to)), 0, count)};
}

struct Extent {
  Point low, high;
};

Extent BoxOf(const Point (&p)[3]) {
  Extent box;
  for (size_t i = 0; i < 3; ++i) std::tie(box.low[i], box.high[i]) = std::minmax({p[0][i], p[1][i], p[2][i]});
  return box;
}

template <class Visit>
void ForEachTriangle(const Mesh& m, Visit visit) {
  for (size_t f = 0; f < TriangleCount(m); ++f) {
    const Point p[3] = {PositionOf(m, m.triangles[3 * f]), PositionOf(m, m.triangles[3 * f + 1]),
                        PositionOf(m, m.triangles[3 * f + 2])};
    visit(p);
  }
}

}  // namespace

std::vector<int16_t> WindingNumbers(const Mesh& m, const Lattice& lattice) {
  // First the crossings between the middles of cells k - 1 and k, noted at k - 1; then their sums from above.
  std::vector<int16_t> winding(lattice.Cells());
  ForEachTriangle(m, [&](const Point(&p)[3]) {
    const Extent box = BoxOf(p);
    const auto [i0, i1] = RangeOf(lattice, 0, box.low[0], box.high[0]);
    const auto [j0, j1] = RangeOf(lattice, 1, box.low[1], box.high[1]);
    for (int j = j0; j < j1; ++j)
      for (int i = i0; i < i1; ++i) {
        const Point middle = lattice.Middle(i, j, 0);
        const PlanePoint at{middle[0], middle[1]};
        const int turns = TurnsRound(at, p);
        if (turns == 0) continue;
        const int k = static_cast<int>(std::ceil((HeightAt(at, p) - lattice.low[2]) / lattice.step - 0.5));
        int16_t& cell = winding[lattice.At(i, j, std::clamp(k - 1, 0, lattice.count[2] - 1))];
        cell = static_cast<int16_t>(cell + turns);
      }
  });
  const size_t layer = lattice.At(0, 0, 1);
  for (size_t cell = lattice.Cells() - layer; cell-- > 0;)
    winding[cell] = static_cast<int16_t>(winding[cell] + winding[cell + layer]);
  return winding;
}

Cells AtLeastOne(const std::vector<int16_t>& winding) {
  Cells cells(winding.size());
  std::transform(winding.begin(), winding.end(), cells.begin(), [](int16_t w) { return static_cast<uint8_t>(w >= 1); });
  return cells;
}

double VolumeOf(const Cells& cells, const Lattice& lattice) {
  return static_cast<double>(std::count(cells.begin(), cells.end(), 1)) * std::pow(lattice.step, 3);
}

double VolumeOfDifference(const Cells& a, const Cells& b, const Lattice& lattice) {
  size_t different = 0;
  for (size_t i = 0; i < a.size(); ++i) different += a[i] != b[i] ? 1u : 0u;
  return static_cast<double>(different) * std::pow(lattice.step, 3);
}

// ---------------------------------------------------------------- distances

void AddNear(const Mesh& m, const std::vector<uint32_t>& triangles, double distance, const Lattice& lattice,
             Cells& cells) {
  for (uint32_t f : triangles) {
    const Point p[3] = {PositionOf(m, m.triangles[3 * f]), PositionOf(m, m.triangles[3 * f + 1]),
                        PositionOf(m, m.triangles[3 * f + 2])};
    const Extent box = BoxOf(p);
    std::pair<int, int> range[3];
    for (size_t i = 0; i < 3; ++i) range[i] = RangeOf(lattice, i, box.low[i] - distance, box.high[i] + distance);
    for (int k = range[2].first; k < range[2].second; ++k)
      for (int j = range[1].first; j < range[1].second; ++j)
        for (int i = range[0].first; i < range[0].second; ++i) {
          uint8_t& cell = cells[lattice.At(i, j, k)];
          if (cell == 0 && SquaredDistanceToTriangle(lattice.Middle(i, j, k), p) < distance * distance) cell = 1;
        }
  }
}

// The nearest cell outside has a cell of the region beside it.
void Erode(double distance, const Cells& marked, const Lattice& lattice, Cells& cells) {
  const Cells before = cells;
  const int reach = static_cast<int>(std::floor(distance / lattice.step));
  const double most = std::pow(distance / lattice.step, 2);
  const auto inside = [&](int i, int j, int k) {
    return i >= 0 && j >= 0 && k >= 0 && i < lattice.count[0] && j < lattice.count[1] && k < lattice.count[2] &&
           before[lattice.At(i, j, k)] != 0;
  };
  const auto clear_round = [&](int i, int j, int k) {
    for (int c = -reach; c <= reach; ++c)
      for (int b = -reach; b <= reach; ++b)
        for (int a = -reach; a <= reach; ++a) {
          if (a * a + b * b + c * c > most || !inside(i + a, j + b, k + c)) continue;
          const size_t at = lattice.At(i + a, j + b, k + c);
          if (marked[at] != 0) cells[at] = 0;
        }
  };
  for (int k = 0; k < lattice.count[2]; ++k)
    for (int j = 0; j < lattice.count[1]; ++j)
      for (int i = 0; i < lattice.count[0]; ++i)
        if (!inside(i, j, k) && (inside(i - 1, j, k) || inside(i + 1, j, k) || inside(i, j - 1, k) ||
                                 inside(i, j + 1, k) || inside(i, j, k - 1) || inside(i, j, k + 1)))
          clear_round(i, j, k);
}

// ---------------------------------------------------------------- topology

namespace {

// Cells first .. end - 1 of one row along x.
struct Run {
  int first, end;
  size_t row, parent;
  int64_t cells;  // at the root: of the whole piece
};

// The cells of one value as runs, grouped into pieces connected through faces, or through faces, edges and corners.
class Pieces {
 public:
  Pieces(const Cells& cells, const Lattice& lattice, uint8_t value, bool through_corners)
      : reach_(through_corners ? 1 : 0) {
    const int ny = lattice.count[1], nz = lattice.count[2];
    std::vector<size_t> row_start = {0};
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j) {
        AddRuns(cells, lattice, value, j, k);
        row_start.push_back(runs_.size());
        const size_t row = row_start.size() - 2;
        const auto touch = [&](int j2, int k2) {
          if (j2 < 0 || j2 >= ny || k2 < 0) return;
          const auto other = static_cast<size_t>(k2) * static_cast<size_t>(ny) + static_cast<size_t>(j2);
          JoinRows(row_start[row], row_start[row + 1], row_start[other], row_start[other + 1]);
        };
        touch(j - 1, k);
        touch(j, k - 1);
        if (through_corners) touch(j - 1, k - 1);
        if (through_corners) touch(j + 1, k - 1);
      }
  }

  int64_t Count() {
    int64_t count = 0;
    for (size_t i = 0; i < runs_.size(); ++i) count += Root(i) == i ? 1u : 0u;
    return count;
  }
  // Visits the runs of the pieces of fewer than `least` cells.
  template <class Visit>
  void ForEachSmall(double least, Visit visit) {
    for (size_t i = 0; i < runs_.size(); ++i)
      if (static_cast<double>(runs_[Root(i)].cells) < least) visit(runs_[i]);
  }

 private:
  void AddRuns(const Cells& cells, const Lattice& lattice, uint8_t value, int j, int k) {
    const size_t row = lattice.At(0, j, k);
    for (int i = 0; i < lattice.count[0]; ++i) {
      const int first = i;
      while (i < lattice.count[0] && cells[row + static_cast<size_t>(i)] == value) ++i;
      if (i > first) runs_.push_back({first, i, row, runs_.size(), i - first});
    }
  }
  void JoinRows(size_t a, size_t a_end, size_t b, size_t b_end) {
    while (a < a_end && b < b_end) {
      if (runs_[a].first < runs_[b].end + reach_ && runs_[b].first < runs_[a].end + reach_) Join(a, b);
      ++(runs_[a].end < runs_[b].end ? a : b);
    }
  }
  void Join(size_t a, size_t b) {
    a = Root(a);
    b = Root(b);
    if (a == b) return;
    runs_[std::max(a, b)].parent = std::min(a, b);
    runs_[std::min(a, b)].cells += runs_[std::max(a, b)].cells;
  }
  size_t Root(size_t i) {
    while (runs_[i].parent != i) i = runs_[i].parent = runs_[runs_[i].parent].parent;
    return i;
  }

  int reach_;
  std::vector<Run> runs_;
};

// Contribution of the eight cells round a corner (bit c of `full`: cell c is full) to corners - edges + squares -
// cubes, each counted at its corner of largest coordinates. Bit i of `span`: the point lies along axis i between cells
// on both sides.
constexpr int EulerAtCorner(unsigned full) {
  int euler = 0;
  for (unsigned span = 0; span < 8; ++span) {
    bool part = false;
    for (unsigned c = 0; c < 8; ++c) part = part || ((c & ~span) == 0 && (full >> c & 1) != 0);
    const bool even = span == 7 || span == 1 || span == 2 || span == 4;
    if (part) euler += even ? 1 : -1;
  }
  return euler;
}

int64_t EulerNumber(const Cells& cells, const Lattice& lattice) {
  int at_corner[256];
  for (unsigned full = 0; full < 256; ++full) at_corner[full] = EulerAtCorner(full);
  int64_t euler = 0;
  for (int k = 1; k < lattice.count[2]; ++k)
    for (int j = 1; j < lattice.count[1]; ++j)
      for (int i = 1; i < lattice.count[0]; ++i) {
        unsigned full = 0;
        for (unsigned c = 0; c < 8; ++c) {
          const int x = static_cast<int>(c & 1), y = static_cast<int>(c >> 1 & 1), z = static_cast<int>(c >> 2);
          full |= static_cast<unsigned>(cells[lattice.At(i - 1 + x, j - 1 + y, k - 1 + z)]) << c;
        }
        euler += at_corner[full];
      }
  return euler;
}

}  // namespace

void DropSpecks(double volume, const Lattice& lattice, Cells& cells) {
  for (const uint8_t value : {uint8_t{0}, uint8_t{1}})
    Pieces(cells, lattice, value, value == 1).ForEachSmall(volume / std::pow(lattice.step, 3), [&](const Run& run) {
      std::fill_n(cells.begin() + static_cast<std::ptrdiff_t>(run.row) + run.first, run.end - run.first,
                  static_cast<uint8_t>(1 - value));
    });
}

Betti BettiOf(const Cells& cells, const Lattice& lattice) {
  Betti betti{Pieces(cells, lattice, 1, true).Count(), 0, Pieces(cells, lattice, 0, false).Count() - 1};
  betti.tunnels = betti.bodies + betti.voids - EulerNumber(cells, lattice);
  return betti;
}

std::string Text(const Betti& betti) {
  return std::to_string(betti.bodies) + " bodies, " + std::to_string(betti.tunnels) + " tunnels, " +
         std::to_string(betti.voids) + " voids";
}

}  // namespace support
