// SPDX-License-Identifier: MIT
#include "oracle/region_columns.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "oracle/triangle_distance.h"

namespace support {

namespace {

constexpr int directions = 2;  // of columns, each with a full measure of the volume

using Corners = TriangleCorners;

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

struct Bounds {
  Point low, high;
};

void Add(const Mesh& m, Bounds& e) {
  for (size_t i = 0; i < m.positions.size(); ++i) {
    e.low[i % 3] = std::min(e.low[i % 3], m.positions[i]);
    e.high[i % 3] = std::max(e.high[i % 3], m.positions[i]);
  }
}

Columns ColumnsOver(const Bounds& e, int count, Random& random) {
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

double SquaredDistanceTo(const Corners& c, const Point& p) {
  const Point corners[3] = {c[0], c[1], c[2]};
  return SquaredDistanceToTriangle(p, corners);
}

// The greatest distance of sampled points to the nearest of some triangles.
class Reach {
 public:
  explicit Reach(const std::vector<Corners>& contacts) : contacts_(contacts) {}
  void Add(const Point& p) {
    if (contacts_.empty()) return;
    double nearest = HUGE_VAL;
    for (const Corners& c : contacts_) {
      nearest = std::min(nearest, SquaredDistanceTo(c, p));
      if (nearest <= squared_) return;
    }
    squared_ = nearest;
  }
  double Value() const { return std::sqrt(squared_); }

 private:
  const std::vector<Corners>& contacts_;
  double squared_ = 0;
};

constexpr int parts_of_stretch = 4;  // points that Reach sees

// Stretches below `speck`, left by rounding, do not count for winding numbers. Returns the sum of squares of the
// differing volumes of columns, which bounds the variance of their sum: the columns are independent.
double Measure(const std::vector<Crossing>& crossings, const Columns& columns, double speck, Reach& reach,
               RegionDifference& d) {
  const double area = columns.area / directions;
  int winding[2] = {0, 0};
  double squares = 0, differing = 0;
  for (size_t i = 0; i + 1 < crossings.size(); ++i) {
    winding[crossings[i].is_result ? 1 : 0] += crossings[i].step;
    if (crossings[i].column != crossings[i + 1].column) {
      squares += differing * differing;
      differing = 0;
      continue;
    }
    const double length = crossings[i + 1].z - crossings[i].z, volume = area * length;
    const bool in_truth = winding[0] >= 1, in_result = winding[1] >= 1;
    if (in_truth) d.truth += volume;
    if (in_result) d.result += volume;
    if (in_truth && !in_result) d.lost += volume;
    if (in_result && !in_truth) d.gained += volume;
    if (in_truth != in_result) differing += volume;
    const auto [x, y] = columns.place[crossings[i].column];
    for (int k = 0; in_truth != in_result && length > speck && k <= parts_of_stretch; ++k)
      reach.Add({x, y, crossings[i].z + length * k / parts_of_stretch});
    if (length > speck && (winding[1] < 0 || winding[1] > 1)) d.is_plain = false;
  }
  return squares + differing * differing;
}

// `over`: the meshes whose box the columns fill.
void Compare(const Mesh& given, const Mesh& result, const std::array<Mesh, 2>& over, int count, Random& random,
             const std::vector<Corners>& contacts, RegionDifference& d) {
  const Mesh& first = over[0].positions.empty() ? over[1] : over[0];
  if (first.positions.empty()) return;
  Bounds e{PositionOf(first, 0), PositionOf(first, 0)};
  Add(over[0], e);
  Add(over[1], e);
  const Columns columns = ColumnsOver(e, count, random);
  if (columns.place.empty()) return;
  std::vector<Crossing> crossings;
  Cut(given, columns, false, crossings);
  Cut(result, columns, true, crossings);
  std::sort(crossings.begin(), crossings.end());
  Reach reach(contacts);
  const double squares = Measure(crossings, columns, 1e-9 * Distance(e.low, e.high), reach, d);
  d.error = std::sqrt(d.error * d.error + squares);
  d.cell = std::max(d.cell, std::hypot(columns.side_x, columns.side_y));
  d.reach = std::max(d.reach, reach.Value());
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

Point Turned(const Point& p, const Turn& t) { return {Dot(t[0], p), Dot(t[1], p), Dot(t[2], p)}; }
Mesh Turned(const Mesh& m, const Turn& t) {
  return Mapped(m, [&](const Point& p) { return Turned(p, t); });
}
std::vector<Corners> Turned(std::vector<Corners> triangles, const Turn& t) {
  for (Corners& c : triangles)
    for (Point& p : c) p = Turned(p, t);
  return triangles;
}

// The corners of all triangles that the other mesh lacks, as a mesh without triangles.
Mesh Lacking(const Mesh& m, const Mesh& other) {
  const auto triangle = [](const Mesh& of, size_t f) {
    Corners c = {PositionOf(of, of.triangles[f]), PositionOf(of, of.triangles[f + 1]),
                 PositionOf(of, of.triangles[f + 2])};
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    return c;
  };
  std::vector<Corners> others;
  for (size_t f = 0; f < other.triangles.size(); f += 3) others.push_back(triangle(other, f));
  std::sort(others.begin(), others.end());
  Mesh out;
  for (size_t f = 0; f < m.triangles.size(); f += 3) {
    const Corners c = triangle(m, f);
    if (std::binary_search(others.begin(), others.end(), c)) continue;
    for (const Point& p : c) out.positions.insert(out.positions.end(), p.begin(), p.end());
  }
  return out;
}

RegionDifference Compare(const Mesh& given, const Mesh& result, const std::array<Mesh, 2>& over, int columns,
                         uint64_t seed, const std::vector<Corners>& contacts) {
  Random random(seed);
  RegionDifference d;
  Compare(given, result, over, columns, random, contacts, d);
  const Turn turn = RandomTurn(random);
  Compare(Turned(given, turn), Turned(result, turn), {Turned(over[0], turn), Turned(over[1], turn)}, columns, random,
          Turned(contacts, turn), d);
  return d;
}

}  // namespace

RegionDifference CompareRegions(const Mesh& given, const Mesh& result, int columns, uint64_t seed) {
  return Compare(given, result, {given, result}, columns, seed, {});
}

RegionDifference CompareChanges(const Mesh& given, const Mesh& result, int columns, uint64_t seed,
                                const std::vector<TriangleCorners>& contacts) {
  return Compare(given, result, {Lacking(given, result), Lacking(result, given)}, columns, seed, contacts);
}

}  // namespace support
