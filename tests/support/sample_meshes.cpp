// SPDX-License-Identifier: MIT
#include "support/sample_meshes.h"

#include <map>
#include <numeric>

#include "support/mesh_building.h"
#include "tool/scenes/elementary.h"

namespace support {

Mesh Sphere(Point center, double radius, int parts) {
  return tool::make_sphere({center[0], center[1], center[2]}, radius, parts);
}

namespace {}  // namespace

Mesh Torus(Point center, double ring, double tube, int around, int across) {
  Mesh m;
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < across; ++k) {
      const double a = 2 * pi * i / around, b = 2 * pi * k / across, r = ring + tube * tool::cosine(b);
      AddVertex(m, {center[0] + r * tool::cosine(a), center[1] + r * tool::sine(a), center[2] + tube * tool::sine(b)});
    }
  const auto at = [&](int i, int k) { return static_cast<size_t>((i % around) * across + k % across); };
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < across; ++k) AddQuad(m, at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
  return m;
}

Mesh Box(Point low, Point high, int n) {
  Mesh m;
  std::map<std::array<int, 3>, size_t> number;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [place, added] = number.emplace(at, number.size());
    if (added) {
      Point p;
      for (size_t i = 0; i < 3; ++i) p[i] = low[i] + (high[i] - low[i]) * at[i] / n;
      AddVertex(m, p);
    }
    return place->second;
  };
  for (size_t axis = 0; axis < 3; ++axis)
    for (int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
          size_t corner[4];
          constexpr int step[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
          for (size_t c = 0; c < 4; ++c) {
            std::array<int, 3> at{};
            at[axis] = side;
            at[(axis + 1) % 3] = i + step[c][0];
            at[(axis + 2) % 3] = k + step[c][1];
            corner[c] = vertex(at);
          }
          if (side == 0)
            AddQuad(m, corner[0], corner[3], corner[2], corner[1]);
          else
            AddQuad(m, corner[0], corner[1], corner[2], corner[3]);
        }
  return m;
}

Mesh Tube(const std::vector<Point>& points, const std::vector<double>& radii, int sides, Point up) {
  Mesh m;
  const size_t n = points.size(), count = static_cast<size_t>(sides);
  for (size_t i = 0; i < n; ++i) {
    const Point along = Unit(Difference(points[std::min(i + 1, n - 1)], points[i == 0 ? 0 : i - 1]));
    const Point u = Unit(Cross(up, along)), v = Cross(along, u);
    for (int k = 0; k < sides; ++k) {
      const double a = 2 * pi * k / sides;
      Point p = points[i];
      for (size_t c = 0; c < 3; ++c) p[c] += radii[i] * (tool::cosine(a) * u[c] + tool::sine(a) * v[c]);
      AddVertex(m, p);
    }
  }
  const size_t first = n * count, last = first + 1;
  AddVertex(m, points.front());
  AddVertex(m, points.back());
  for (size_t k = 0; k < count; ++k) {
    const size_t next = (k + 1) % count;
    for (size_t i = 0; i + 1 < n; ++i)
      AddQuad(m, i * count + k, i * count + next, (i + 1) * count + next, (i + 1) * count + k);
    AddTriangle(m, first, next, k);
    AddTriangle(m, last, (n - 1) * count + k, (n - 1) * count + next);
  }
  return m;
}

Mesh Together(const std::vector<Mesh>& parts) {
  Mesh all;
  for (const Mesh& m : parts) {
    const uint32_t base = VertexCount(all);
    all.positions.insert(all.positions.end(), m.positions.begin(), m.positions.end());
    for (uint32_t v : m.triangles) all.triangles.push_back(base + v);
  }
  return all;
}

Mesh Translated(Mesh m, Point by) {
  for (size_t i = 0; i < m.positions.size(); ++i) m.positions[i] += by[i % 3];
  return m;
}

// From the generator's bits, so that every standard library draws the same.
double Uniform(Random& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

Point RandomPoint(Random& random, double low, double high) {
  Point p;
  for (double& x : p) x = Uniform(random, low, high);
  return p;
}

namespace {

std::vector<uint32_t> RandomPermutation(uint32_t n, Random& random) {
  std::vector<uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  for (uint32_t i = n; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

}  // namespace

Mesh ThinBody(Random& random) {
  Mesh m;
  const auto n = static_cast<uint32_t>(3 + random() % 8);
  const double thickness = std::pow(10, Uniform(random, -3, -0.5));
  for (uint32_t v = 0; v < n; ++v) {
    const double turn = 2 * pi * (v + Uniform(random, -0.4, 0.4)) / n, r = Uniform(random, 0.3, 1);
    m.positions.insert(m.positions.end(), {r * std::cos(turn), r * std::sin(turn), thickness * Uniform(random, -1, 1)});
  }
  for (int tip = 0; tip < 2; ++tip)
    m.positions.insert(m.positions.end(),
                       {Uniform(random, -0.5, 0.5), Uniform(random, -0.5, 0.5), thickness * Uniform(random, -1, 1)});
  for (uint32_t v = 0; v < n; ++v) {
    const uint32_t next = (v + 1) % n;
    m.triangles.insert(m.triangles.end(), {v, next, n, next, v, n + 1});
  }
  return m;
}

Mesh Renumbered(const Mesh& m, Random& random) {
  const std::vector<uint32_t> vertex = RandomPermutation(VertexCount(m), random);
  const std::vector<uint32_t> triangle = RandomPermutation(TriangleCount(m), random);
  Mesh out = m;
  for (size_t v = 0; v < vertex.size(); ++v)
    for (size_t i = 0; i < 3; ++i) out.positions[3 * size_t{vertex[v]} + i] = m.positions[3 * v + i];
  for (size_t f = 0; f < triangle.size(); ++f) {
    const size_t turn = random() % 3;
    for (size_t i = 0; i < 3; ++i)
      out.triangles[3 * size_t{triangle[f]} + (i + turn) % 3] = vertex[m.triangles[3 * f + i]];
  }
  return out;
}

Point QuarterTurned(Point p, int rotation) {
  // Six places for the x axis, four turns about it.
  for (int i = 0; i < rotation % 4; ++i) p = {p[0], -p[2], p[1]};
  const int place = rotation / 4 % 6;
  for (int i = 0; place < 4 && i < place; ++i) p = {-p[1], p[0], p[2]};
  if (place == 4) p = {p[2], p[1], -p[0]};
  if (place == 5) p = {-p[2], p[1], p[0]};
  return p;
}

Mesh QuarterTurned(Mesh m, int rotation) {
  for (size_t v = 0; v < VertexCount(m); ++v) {
    const Point p = QuarterTurned(PositionOf(m, v), rotation);
    std::copy(p.begin(), p.end(), m.positions.begin() + static_cast<std::ptrdiff_t>(3 * v));
  }
  return m;
}

}  // namespace support
