// SPDX-License-Identifier: MIT
// Two balls, a hot and a cold one, move into each other and become one, in C++17. Heat is a density on the surface: new
// vertices get values between their parents', and each body keeps its sum.
#include <cmath>
#include <cstdio>
#include <topoadapt.hpp>

namespace {

using Point = std::array<double, 3>;
using Triangle = std::array<std::uint32_t, 3>;

// A ball of rings of vertices round the x axis, between two poles.
void add_ball(double x, std::vector<Point>& points, std::vector<Triangle>& triangles) {
  constexpr std::uint32_t rings = 12, sectors = 24;
  const double pi = std::acos(-1.0);
  const auto base = static_cast<std::uint32_t>(points.size()), left = base + rings * sectors, right = left + 1;
  for (std::uint32_t r = 0; r < rings; ++r)
    for (std::uint32_t s = 0; s < sectors; ++s) {
      const double polar = pi * (r + 1) / (rings + 1), around = 2 * pi * s / sectors;
      points.push_back({x - std::cos(polar), std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around)});
    }
  points.push_back({x - 1, 0, 0});
  points.push_back({x + 1, 0, 0});
  for (std::uint32_t s = 0; s < sectors; ++s) {
    const std::uint32_t t = (s + 1) % sectors, last = base + (rings - 1) * sectors;
    triangles.push_back({left, base + t, base + s});
    triangles.push_back({right, last + s, last + t});
    for (std::uint32_t lower = base; lower < last; lower += sectors) {
      triangles.push_back({lower + s, lower + t, lower + sectors + t});
      triangles.push_back({lower + s, lower + sectors + t, lower + sectors + s});
    }
  }
}

// A third of the area of a vertex's triangles.
std::vector<double> vertex_areas(const topoadapt::Mesh& mesh) {
  std::vector<double> areas(mesh.vertex_count(), 0);
  const auto at = mesh.positions();
  const auto triangles = mesh.triangles();
  for (std::size_t h = 0; h < triangles.size(); h += 3) {
    const double *a = &at[3 * triangles[h]], *b = &at[3 * triangles[h + 1]], *c = &at[3 * triangles[h + 2]];
    const Point u = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, w = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const double area = std::hypot(u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]) / 2;
    for (std::size_t i = 0; i < 3; ++i) areas[triangles[h + i]] += area / 3;
  }
  return areas;
}

// The heat of each body.
std::vector<double> measure(const topoadapt::Mesh& mesh, const std::vector<double>& density) {
  const topoadapt::Components bodies = mesh.components();
  const std::vector<double> areas = vertex_areas(mesh);
  std::vector<double> heat(bodies.size(), 0);
  for (std::size_t v = 0; v < density.size(); ++v) heat[bodies.labels[v]] += areas[v] * density[v];
  return heat;
}

// After each commit: densities follow the vertices, heat follows the bodies, and densities are set right by it.
void follow(const topoadapt::Mesh& mesh, topoadapt::Accounts<double>& heat, std::vector<double>& density) {
  mesh.carry(density);
  const std::vector<double> measured = measure(mesh, density);
  heat.follow(mesh, measured,
              [](double owned, double part, double whole) { return whole == 0 ? 0 : owned * part / whole; });
  for (std::size_t v = 0; v < density.size(); ++v) {
    const std::uint32_t body = heat.components().labels[v];
    if (measured[body] != 0) density[v] *= heat.amounts()[body] / measured[body];
  }
}

}  // namespace

int main() try {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  add_ball(-1.4, points, triangles);
  add_ball(1.4, points, triangles);
  topoadapt::Mesh mesh(points, triangles);
  std::vector<double> density(points.size(), 0);
  std::fill(density.begin(), density.begin() + static_cast<std::ptrdiff_t>(density.size() / 2), 1.0);
  topoadapt::Accounts<double> heat(mesh, measure(mesh, density));
  const double before = heat.total();
  std::uint32_t merges = 0;
  for (int step = 0; step < 6; ++step) {
    std::vector<double> targets(mesh.positions().begin(), mesh.positions().end());
    for (std::size_t i = 0; i < targets.size(); i += 3) targets[i] += targets[i] < 0 ? 0.1 : -0.1;
    mesh.move(targets);
    mesh.step();
    merges += mesh.count_events(TPA_EVENT_MERGE);
    follow(mesh, heat, density);
    mesh.remesh(0.2);
    follow(mesh, heat, density);
  }
  const std::vector<double> after = measure(mesh, density);
  std::printf("%u merge, %zu body of %u vertices, heat %.6f before and %.6f after\n", merges, after.size(),
              mesh.vertex_count(), before, after[0]);
  return merges == 1 && after.size() == 1 && std::fabs(after[0] / before - 1) < 1e-12 ? 0 : 1;
} catch (const topoadapt::Error& error) {
  return std::fprintf(stderr, "%s\n", error.what()), 1;
}
