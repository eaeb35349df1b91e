// SPDX-License-Identifier: MIT
#include "support/uneven_bodies.h"

#include <algorithm>

#include "support/mesh_building.h"
#include "tool/scenes/elementary.h"

namespace support {

Mesh SphereOfRings(const std::vector<double>& angles, int meridians) {
  std::vector<Point> points;
  std::vector<double> radii;
  for (double a : angles) {
    points.push_back({0, 0, -tool::cosine(a)});
    radii.push_back(tool::sine(a));
  }
  Mesh m = Tube(points, radii, meridians, {1, 0, 0});
  const size_t poles = m.positions.size() - 6;
  m.positions[poles + 2] = -1;
  m.positions[poles + 5] = 1;
  return m;
}

Mesh Globe(int meridians, int bands) {
  std::vector<double> angles;
  for (int i = 1; i < bands; ++i) angles.push_back(pi * i / bands);
  return SphereOfRings(angles, meridians);
}

Mesh Slivers(int meridians, int bands) {
  std::vector<double> angles;
  for (int i = 1; i < bands; ++i)
    for (const double by : {0.0, 0.02}) angles.push_back(pi * (i + by) / bands);
  return SphereOfRings(angles, meridians);
}

namespace {

constexpr double narrow = 0.02;  // of a wide band

}  // namespace

Mesh Needles(int meridians, int bands) {
  std::vector<double> around;
  for (int i = 0; i < meridians; ++i)
    for (const double by : {0.0, narrow}) around.push_back(2 * pi * (i + by) / meridians);
  std::vector<std::vector<Point>> rings;
  for (int i = 1; i < bands; ++i) {
    const double a = pi * i / bands;
    rings.emplace_back();
    for (const double b : around)
      rings.back().push_back({tool::sine(a) * tool::cosine(b), tool::sine(a) * tool::sine(b), tool::cosine(a)});
  }
  Mesh m;
  for (const auto& ring : rings)
    for (const Point& p : ring) AddVertex(m, p);
  const size_t sides = around.size(), north = VertexCount(m), south = north + 1;
  AddVertex(m, {0, 0, 1});
  AddVertex(m, {0, 0, -1});
  for (size_t k = 0; k < sides; ++k) {
    const size_t next = (k + 1) % sides, last = (rings.size() - 1) * sides;
    AddTriangle(m, north, k, next);
    AddTriangle(m, south, last + next, last + k);
    for (size_t i = 0; i + 1 < rings.size(); ++i)
      AddQuad(m, i * sides + k, (i + 1) * sides + k, (i + 1) * sides + next, i * sides + next);
  }
  return m;
}

namespace {

bool TurnsOver(const Mesh& m, uint32_t v) {
  for (size_t f = 0; f < m.triangles.size(); f += 3) {
    if (m.triangles[f] != v && m.triangles[f + 1] != v && m.triangles[f + 2] != v) continue;
    const Point a = PositionOf(m, m.triangles[f]), b = PositionOf(m, m.triangles[f + 1]),
                c = PositionOf(m, m.triangles[f + 2]);
    if (Dot(a, Cross(b, c)) <= 0) return true;  // seen from the middle of the sphere
  }
  return false;
}

}  // namespace

Mesh Squeezed(int parts) {
  Mesh m = Sphere({}, 1, parts);
  for (size_t f = 0; f < m.triangles.size(); f += 3) {
    const uint32_t v = m.triangles[f], to = m.triangles[f + 1];
    if (v % 3 != 0 || to % 3 == 0) continue;
    const Mesh before = m;
    const Point p = Unit(Sum(Scaled(narrow, PositionOf(m, v)), Scaled(1 - narrow, PositionOf(m, to))));
    std::copy(p.begin(), p.end(), m.positions.begin() + 3 * static_cast<std::ptrdiff_t>(v));
    if (TurnsOver(m, v)) m = before;
  }
  return m;
}

Mesh GradedSphere(int meridians, double ratio) {
  const double growth = 1 + 2 * pi / meridians;
  std::vector<double> angles;
  for (double t = 0.5 / ratio; t < 3; t *= growth) angles.push_back(2 * tool::arc_tangent(t, 1));
  return SphereOfRings(angles, meridians);
}

}  // namespace support
