// SPDX-License-Identifier: MIT
#include "tool/scenes/shapes.h"

#include "tool/scenes/elementary.h"

namespace tool {

namespace {

void add_vertex(TriangleMesh& m, const Point& p) { m.positions.insert(m.positions.end(), p.begin(), p.end()); }

void add_triangle(TriangleMesh& m, size_t a, size_t b, size_t c) {
  for (const size_t v : {a, b, c}) m.triangles.push_back(static_cast<uint32_t>(v));
}

void add_quad(TriangleMesh& m, size_t a, size_t b, size_t c, size_t d) {
  add_triangle(m, a, b, c);
  add_triangle(m, a, c, d);
}

}  // namespace

void append(TriangleMesh& mesh, const TriangleMesh& part) {
  const auto offset = static_cast<uint32_t>(vertex_count(mesh));
  mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
  for (const uint32_t v : part.triangles) mesh.triangles.push_back(v + offset);
}

TriangleMesh make_spindle(const std::vector<std::array<double, 2>>& profile, int sides) {
  TriangleMesh m;
  const size_t rings = profile.size(), count = static_cast<size_t>(sides);
  for (size_t i = 0; i < rings; ++i)
    for (size_t k = 0; k < count; ++k) {
      // Every other ring is turned by half a side, so that the triangles are even.
      const double a = 2 * pi * (static_cast<double>(k) + (i % 2 == 0 ? 0 : 0.5)) / sides;
      add_vertex(m, {profile[i][0], profile[i][1] * cosine(a), profile[i][1] * sine(a)});
    }
  add_vertex(m, {profile.front()[0], 0, 0});
  add_vertex(m, {profile.back()[0], 0, 0});
  const size_t first = rings * count, last = first + 1;
  for (size_t k = 0; k < count; ++k) {
    const size_t next = (k + 1) % count;
    for (size_t i = 0; i + 1 < rings; ++i) {
      const size_t a = i * count + k, b = i * count + next, c = (i + 1) * count + k, d = (i + 1) * count + next;
      if (i % 2 == 0) {
        add_triangle(m, a, b, c);
        add_triangle(m, b, d, c);
      } else {
        add_triangle(m, a, d, c);
        add_triangle(m, a, b, d);
      }
    }
    add_triangle(m, first, next, k);
    add_triangle(m, last, (rings - 1) * count + k, (rings - 1) * count + next);
  }
  return m;
}

TriangleMesh make_globe(const Point& center, double radius, int rings, int sectors) {
  std::vector<std::array<double, 2>> profile;
  for (int i = 1; i <= rings; ++i) {
    const double a = pi * i / (rings + 1);
    profile.push_back({-radius * cosine(a), radius * sine(a)});
  }
  TriangleMesh m = make_spindle(profile, sectors);
  set_position(m, vertex_count(m) - 2, {-radius, 0, 0});
  set_position(m, vertex_count(m) - 1, {radius, 0, 0});
  transform(m, [&](const Point& p) { return center + p; });
  return m;
}

TriangleMesh make_torus(const Point& center, double ring, double tube, int around, int across) {
  TriangleMesh m;
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < across; ++k) {
      const double a = 2 * pi * i / around, b = 2 * pi * k / across, r = ring + tube * cosine(b);
      add_vertex(m, center + Point{r * cosine(a), r * sine(a), tube * sine(b)});
    }
  const auto at = [&](int i, int k) { return static_cast<size_t>((i % around) * across + k % across); };
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < across; ++k) add_quad(m, at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
  return m;
}

std::vector<Point> vertex_normals(const double* positions, size_t vertices, const uint32_t* triangles, size_t corners) {
  std::vector<Point> normals(vertices, Point{});
  const auto at = [&](uint32_t v) { return Point{positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]}; };
  for (size_t f = 0; f + 2 < corners; f += 3) {
    const Point a = at(triangles[f]);
    const Point n = cross(at(triangles[f + 1]) - a, at(triangles[f + 2]) - a);
    for (size_t i = 0; i < 3; ++i) normals[triangles[f + i]] = normals[triangles[f + i]] + n;
  }
  for (Point& n : normals)
    if (dot(n, n) > 0) n = unit(n);
  return normals;
}

}  // namespace tool
