// SPDX-License-Identifier: MIT
// Bodies that come apart, open, close or vanish.
#include <algorithm>
#include <map>

#include "tool/scenes/closing_voids.h"
#include "tool/scenes/elementary.h"
#include "tool/scenes/scene.h"
#include "tool/scenes/shapes.h"
#include "tool/scenes/sphere.h"

namespace tool {

namespace {

void put(std::vector<double>& targets, size_t v, const Point& p) {
  std::copy(p.begin(), p.end(), targets.begin() + static_cast<std::ptrdiff_t>(3 * v));
}

std::vector<Point> normals_of(const Moment& m) {
  return vertex_normals(m.positions.data(), m.vertices(), m.triangles.data(), m.triangles.size());
}

// The mean curvature vectors, H n, by cotangents and a third of the areas round each vertex (Meyer et al. 2003);
// their divergence theorem holds for any triangles, thin ones included.
std::vector<Point> mean_curvatures(const Moment& m) {
  std::vector<Point> sum(m.vertices(), Point{});
  std::vector<double> area(m.vertices(), 0);
  for (size_t f = 0; f < m.triangles.size(); f += 3)
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = m.triangles[f + i], b = m.triangles[f + (i + 1) % 3], c = m.triangles[f + (i + 2) % 3];
      const Point u = m.position(a) - m.position(c), w = m.position(b) - m.position(c);
      const double twice = length(cross(u, w));
      area[c] += twice / 6;
      if (twice == 0) continue;
      const double cotangent = dot(u, w) / twice;
      const Point edge = m.position(b) - m.position(a);
      sum[a] = sum[a] + 0.5 * cotangent * edge;
      sum[b] = sum[b] - 0.5 * cotangent * edge;
    }
  for (size_t v = 0; v < sum.size(); ++v)
    if (area[v] > 0) sum[v] = 1 / area[v] * sum[v];
  return sum;
}

// A spindle with rounded ends: radius(x) on -half .. half, closed by caps of the radius there.
template <class Radius>
TriangleMesh spindle_of(double half, double edge, const Radius& radius) {
  std::vector<std::array<double, 2>> profile;
  const double end = radius(half);
  const int caps = std::max(2, static_cast<int>(std::lround(pi / 2 * end / edge)));
  const int rings = std::max(4, 2 * static_cast<int>(std::lround(half / edge)));
  for (int i = 1; i < caps; ++i)
    profile.push_back({-half - end * cosine(pi / 2 * i / caps), end * sine(pi / 2 * i / caps)});
  for (int i = 0; i <= rings; ++i) {
    const double x = -half + 2 * half * i / rings;
    profile.push_back({x, radius(x)});
  }
  for (int i = caps - 1; i > 0; --i)
    profile.push_back({half + end * cosine(pi / 2 * i / caps), end * sine(pi / 2 * i / caps)});
  TriangleMesh m = make_spindle(profile, std::max(6, static_cast<int>(std::lround(2 * pi * end / edge))));
  set_position(m, vertex_count(m) - 2, {-half - end, 0, 0});
  set_position(m, vertex_count(m) - 1, {half + end, 0, 0});
  return m;
}

// Breaks perfect symmetry.
void shake(TriangleMesh& m, Dice& dice, double most) {
  transform(m, [&](const Point& p) { return p + dice.in_cube(most); });
}

}  // namespace

// Two balls of radius 1 with a neck of radius .25 between them. Under mean curvature the neck's radius r follows r' =
// -1/r + the other curvature. The neck is gone by about t = r^2/2 = .03, when the balls have lost about 2 t / R^2 = 6
// %.
Scene make_dumbbell(uint64_t seed) {
  constexpr double edge = 0.1, ends = 1, neck = 0.25;
  Dice dice(seed);
  Scene s;
  s.mesh = spindle_of(1.6, edge, [&](double x) {
    const double t = std::min(1.0, std::fabs(x) / 1.6);
    return neck + (ends - neck) * t * t * (3 - 2 * t);
  });
  shake(s.mesh, dice, 0.02 * edge);
  s.edge_length = edge;
  s.step = 0.0005;
  s.duration = 0.08;
  s.motion = [](const Moment& m, std::vector<double>& targets) {
    const std::vector<Point> curvature = mean_curvatures(m);
    // An explicit step is stable for ways up to about a third of the edges round a vertex.
    const double most = 0.3 * edge;
    for (size_t v = 0; v < m.vertices(); ++v) {
      const Point way = m.step * curvature[v];
      put(targets, v, m.position(v) + std::min(1.0, most / std::max(most, length(way))) * way);
    }
  };
  s.end = SceneEnd{{0, 0}};
  return s;
}

// A tube of 4 to 40 radii. Its middle shrinks towards the axis until the tube necks off.
Scene make_tube(uint64_t seed) {
  constexpr double radius = 0.5, edge = 0.12;
  Dice dice(seed);
  const double half = dice.uniform(2, 20) * radius;
  Scene s;
  s.mesh = spindle_of(half, edge, [&](double) { return radius; });
  shake(s.mesh, dice, 0.02 * edge);
  s.edge_length = edge;
  s.step = 0.04;
  s.duration = 1.2;
  // The waist: 1 in the middle, next to nothing two radii away.
  s.motion = [](const Moment& m, std::vector<double>& targets) {
    const std::vector<Point> normals = normals_of(m);
    for (size_t v = 0; v < m.vertices(); ++v) {
      const Point p = m.position(v);
      put(targets, v, p - m.step * radius * exponential(-p[0] * p[0] / (radius * radius)) * normals[v]);
    }
  };
  s.end = SceneEnd{{0, 0}};
  return s;
}

// A bowl, half of a shell of radii 1 and .8, is pressed at its bottom from both sides until a hole opens.
Scene make_shell(uint64_t seed) {
  constexpr double edge = 0.09, outer = 1, inner = 0.8;
  Dice dice(seed);
  std::vector<std::array<double, 2>> profile;
  const int along = static_cast<int>(std::lround(pi / 2 * outer / edge)), rim = 2;
  for (int i = 1; i <= along; ++i)
    profile.push_back({-outer * cosine(pi / 2 * i / along), outer * sine(pi / 2 * i / along)});
  for (int i = 1; i < rim; ++i) profile.push_back({0, outer + (inner - outer) * i / rim});
  for (int i = along; i >= 1; --i)
    profile.push_back({-inner * cosine(pi / 2 * i / along), inner * sine(pi / 2 * i / along)});
  Scene s;
  s.mesh = make_spindle(profile, static_cast<int>(std::lround(2 * pi / edge)));
  set_position(s.mesh, vertex_count(s.mesh) - 2, {-outer, 0, 0});
  set_position(s.mesh, vertex_count(s.mesh) - 1, {-inner, 0, 0});
  shake(s.mesh, dice, 0.02 * edge);
  s.edge_length = edge;
  s.step = 0.02;
  s.duration = 1;
  const Point at{0, dice.uniform(-0.1, 0.1), dice.uniform(-0.1, 0.1)};
  s.motion = [at](const Moment& m, std::vector<double>& targets) {
    const std::vector<Point> normals = normals_of(m);
    for (size_t v = 0; v < m.vertices(); ++v) {
      const Point p = m.position(v), d{0, p[1] - at[1], p[2] - at[2]};
      const double reach = 0.25;
      put(targets, v, p - (p[0] > -0.5 ? 0 : 0.3 * m.step * exponential(-dot(d, d) / (reach * reach))) * normals[v]);
    }
  };
  s.end = SceneEnd{{1}};
  return s;
}

// A torus whose tube grows until the hole closes.
Scene make_ring(uint64_t seed) {
  constexpr double ring = 1, tube = 0.5, edge = 0.12;
  Dice dice(seed);
  Scene s;
  s.mesh = make_torus({0, 0, 0}, ring, tube, static_cast<int>(std::lround(2 * pi * ring / edge)),
                      static_cast<int>(std::lround(2 * pi * tube / edge)));
  shake(s.mesh, dice, 0.02 * edge);
  s.edge_length = edge;
  s.step = 0.02;
  s.duration = 0.8;
  s.any_step = true;
  // To the tube of the present radius, wherever a vertex is.
  s.motion = [](const Moment& m, std::vector<double>& targets) {
    const double wanted = tube + m.time + m.step;
    for (size_t v = 0; v < m.vertices(); ++v) {
      const Point p = m.position(v);
      const double r = std::sqrt(p[0] * p[0] + p[1] * p[1]);
      const Point axis = r == 0 ? Point{ring, 0, 0} : Point{ring * p[0] / r, ring * p[1] / r, 0};
      const Point d = p - axis;
      const double away = length(d), way = std::clamp(wanted - away, -2 * m.step, 2 * m.step);
      put(targets, v, away == 0 ? p : p + way / away * d);
    }
    turn_closing_voids(m, {}, targets);
  };
  s.end = SceneEnd{{0}};
  return s;
}

// Two balls; the second shrinks along its normals to nothing, and on.
Scene make_vanish(uint64_t seed) {
  constexpr double edge = 0.1;
  Dice dice(seed);
  Scene s;
  s.mesh = make_sphere({0, 0, 0}, 0.5, 8);
  append(s.mesh, make_sphere({1.2, 0.1, 0.05}, 0.35, 5));
  shake(s.mesh, dice, 0.02 * edge);
  s.edge_length = edge;
  s.step = 0.03;
  s.duration = 0.6;
  s.motion = [](const Moment& m, std::vector<double>& targets) {
    const std::vector<Point> normals = normals_of(m);
    for (size_t v = 0; v < m.vertices(); ++v)
      if (m.position(v)[0] > 0.6) put(targets, v, m.position(v) - m.step * normals[v]);
  };
  s.end = SceneEnd{{0}};
  return s;
}

}  // namespace tool
