// SPDX-License-Identifier: MIT
#include "shapes.h"

#include <algorithm>
#include <cmath>

namespace solver {

namespace {

const double pi = std::acos(-1.0);

}  // namespace

Shape revolve(const std::function<Eigen::Vector2d(double t)>& profile, int rings, int sectors) {
  const int left = rings * sectors, right = left + 1;
  Shape shape{Points(left + 2, 3), Triangles(2 * rings * sectors, 3)};
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < sectors; ++s) {
      const Eigen::Vector2d at = profile((r + 1.0) / (rings + 1));
      const double angle = 2 * pi * (s + 0.5 * r) / sectors;
      shape.points.row(r * sectors + s) << at[0], at[1] * std::cos(angle), at[1] * std::sin(angle);
    }
  shape.points.row(left) << profile(0)[0], 0, 0;
  shape.points.row(right) << profile(1)[0], 0, 0;
  int t = 0;
  const auto add = [&](int a, int b, int c) { shape.triangles.row(t++) << uint32_t(a), uint32_t(b), uint32_t(c); };
  for (int s = 0; s < sectors; ++s) {
    const int next = (s + 1) % sectors, last = (rings - 1) * sectors;
    add(left, next, s);
    add(right, last + s, last + next);
    for (int r = 0; r + 1 < rings; ++r) {
      const int a = r * sectors + s, b = r * sectors + next, c = a + sectors, d = b + sectors;
      add(a, b, c);
      add(b, d, c);
    }
  }
  return shape;
}

Shape ball(double x, double radius, double edge_length) {
  const int rings = std::max(6, static_cast<int>(pi * radius / edge_length));
  return revolve([=](double t) { return Eigen::Vector2d(x - radius * std::cos(pi * t), radius * std::sin(pi * t)); },
                 rings, 2 * rings);
}

Shape dumbbell(double edge_length) {
  const auto profile = [](double t) {
    const double x = -2.6 * std::cos(pi * t);
    const double from_ball = 1 - (std::fabs(x) - 1.6) * (std::fabs(x) - 1.6);
    const double neck = std::fabs(x) < 1.6 ? 0.3 : 0;
    return Eigen::Vector2d(x, std::max(std::sqrt(std::max(from_ball, 0.0)), neck));
  };
  return revolve(profile, static_cast<int>(7.5 / edge_length), 20);
}

Shape join(const Shape& a, const Shape& b) {
  Shape both{Points(a.points.rows() + b.points.rows(), 3), Triangles(a.triangles.rows() + b.triangles.rows(), 3)};
  both.points << a.points, b.points;
  both.triangles << a.triangles, (b.triangles.array() + static_cast<uint32_t>(a.points.rows())).matrix();
  return both;
}

}  // namespace solver
