// SPDX-License-Identifier: MIT
#include "oracle/region_columns.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace support {

namespace {

constexpr int directions = 2;  // of columns, each with a full measure of the volume

using Corners = std::array<Point, 3>;

// One column in each cell of a grid in the xy plane, at a random place within, along z.
struct Columns {
  double low_x = 0, low_y = 0, side_x = 0, side_y = 0;
  int nx = 1, ny = 1;
  std::vector<std::array<double, 2>> place;
  double area = 0;  // of a cell
};

struct Crossing {
  uint32_t column;
  int32_t step;  // of the winding number, upwards
  bool is_result;
  double z;
  bool operator<(const Crossing& o) const {
    return std::tie(column, z, is_result, step) < std::tie(o.column, o.z, o.is_result, o.step);
  }
};

struct Extent {
  Point low, high;
};

void Add(const Mesh& m, Extent& e) {
  for (size_t i = 0; i < m.positions.size(); ++i) {
    e.low[i % 3] = std::min(e.low[i % 3], m.positions[i]);
    e.high[i % 3] = std::max(e.high[i % 3], m.positions[i]);
  }
}

Columns ColumnsOver(const Extent& e, int count, Random& random) {
  Columns c;
  const double x = e.high[0] - e.low[0], y = e.high[1] - e.low[1];
  if (!(x > 0) || !(y > 0)) return c;
  c.nx = std::clamp(static_cast<int>(std::lround(std::sqrt(count * x / y))), 1, count);
  c.ny = std::max(1, count / c.nx);
  c.low_x = e.low[0], c.low_y = e.low[1], c.side_x = x / c.nx, c.side_y = y / c.ny;
  c.area = c.side_x * c.side_y;
  for (int j = 0; j < c.ny; ++j)
    for (int i = 0; i < c.nx; ++i) {
      const double in_x = Uniform(random, 0, 1), in_y = Uniform(random, 0, 1);
      c.place.push_back({c.low_x + c.side_x * (i + in_x), c.low_y + c.side_y * (j + in_y)});
    }
  return c;
}

// Is (x, y) to the left of the way from a to b? Measured from the lesser end, so that both triangles of an edge agree.
bool IsLeft(const Point& a, const Point& b, double x, double y) {
  const bool turned = std::tie(b[0], b[1]) < std::tie(a[0], a[1]);
  const Point &p = turned ? b : a, &q = turned ? a : b;
  return ((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]) > 0) != turned;
}

double HeightAt(const Corners& t, double x, double y) {
  const double ux = t[1][0] - t[0][0], uy = t[1][1] - t[0][1], vx = t[2][0] - t[0][0], vy = t[2][1] - t[0][1];
  const double wx = x - t[0][0], wy = y - t[0][1], area = ux * vy - uy * vx;
  const auto [low, high] = std::minmax({t[0][2], t[1][2], t[2][2]});
  if (area == 0) return low;
  const double s = (wx * vy - wy * vx) / area, r = (ux * wy - uy * wx) / area;
  return std::clamp(t[0][2] + s * (t[1][2] - t[0][2]) + r * (t[2][2] - t[0][2]), low, high);
}

int CellOf(double x, double low, double side, int count) {
  return std::clamp(static_cast<int>(std::floor((x - low) / side)), 0, count - 1);
}

// Seen along z, by one formula for every triangle. A triangle without area has no sides.
bool HasArea(const Corners& t) {
  return (t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) != (t[1][1] - t[0][1]) * (t[2][0] - t[0][0]);
}

void CutTriangle(const Corners& t, const Columns& c, bool is_result, std::vector<Crossing>& crossings) {
  if (!HasArea(t)) return;
  const auto [x0, x1] = std::minmax({t[0][0], t[1][0], t[2][0]});
  const auto [y0, y1] = std::minmax({t[0][1], t[1][1], t[2][1]});
  const int i1 = CellOf(x1, c.low_x, c.side_x, c.nx), j1 = CellOf(y1, c.low_y, c.side_y, c.ny);
  for (int j = CellOf(y0, c.low_y, c.side_y, c.ny); j <= j1; ++j)
    for (int i = CellOf(x0, c.low_x, c.side_x, c.nx); i <= i1; ++i) {
      const auto column = static_cast<uint32_t>(j * c.nx + i);
      const auto [x, y] = c.place[column];
      const bool left = IsLeft(t[0], t[1], x, y);
      if (left != IsLeft(t[1], t[2], x, y) || left != IsLeft(t[2], t[0], x, y)) continue;
      crossings.push_back({column, left ? -1 : 1, is_result, HeightAt(t, x, y)});
    }
}

void Cut(const Mesh& m, const Columns& c, bool is_result, std::vector<Crossing>& crossings) {
  for (size_t f = 0; f < m.triangles.size(); f += 3)
    CutTriangle({PositionOf(m, m.triangles[f]), PositionOf(m, m.triangles[f + 1]), PositionOf(m, m.triangles[f + 2])},
                c, is_result, crossings);
}

// Stretches below `speck`, left by rounding, do not count for winding numbers.
void Measure(const std::vector<Crossing>& crossings, double area, double speck, RegionDifference& d) {
  int winding[2] = {0, 0};
  for (size_t i = 0; i + 1 < crossings.size(); ++i) {
    winding[crossings[i].is_result ? 1 : 0] += crossings[i].step;
    if (crossings[i].column != crossings[i + 1].column) continue;
    const double length = crossings[i + 1].z - crossings[i].z, volume = area * length;
    const bool in_truth = winding[0] >= 1, in_result = winding[1] >= 1;
    if (in_truth) d.truth += volume;
    if (in_result) d.result += volume;
    if (in_truth && !in_result) d.lost += volume;
    if (in_result && !in_truth) d.gained += volume;
    if (length > speck && (winding[1] < 0 || winding[1] > 1)) d.is_plain = false;
  }
}

void Compare(const Mesh& given, const Mesh& result, int count, Random& random, RegionDifference& d) {
  Extent e{PositionOf(given, 0), PositionOf(given, 0)};
  Add(given, e);
  Add(result, e);
  const Columns columns = ColumnsOver(e, count, random);
  if (columns.place.empty()) return;
  std::vector<Crossing> crossings;
  Cut(given, columns, false, crossings);
  Cut(result, columns, true, crossings);
  std::sort(crossings.begin(), crossings.end());
  Measure(crossings, columns.area / directions, 1e-9 * Distance(e.low, e.high), d);
}

using Turn = std::array<Point, 3>;

// Three random directions square to each other.
Turn RandomTurn(Random& random) {
  const auto direction = [&] {
    for (;;) {
      const Point p = RandomPoint(random, -1, 1);
      if (Length(p) > 0.1 && Length(p) < 1) return Unit(p);
    }
  };
  const Point x = direction(), z = Unit(Cross(x, direction()));
  return {x, Cross(z, x), z};
}

Mesh Turned(const Mesh& m, const Turn& t) {
  return Mapped(m, [&](const Point& p) { return Point{Dot(t[0], p), Dot(t[1], p), Dot(t[2], p)}; });
}

}  // namespace

RegionDifference CompareRegions(const Mesh& given, const Mesh& result, int columns, uint64_t seed) {
  Random random(seed);
  RegionDifference d;
  Compare(given, result, columns, random, d);
  const Turn turn = RandomTurn(random);
  Compare(Turned(given, turn), Turned(result, turn), columns, random, d);
  return d;
}

}  // namespace support
