// SPDX-License-Identifier: MIT
#include "real_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "tool/scenes/elementary.h"

namespace bench {

namespace {

constexpr double pi = std::numbers::pi;

using Flat = std::array<double, 2>;
using Outline = std::vector<Flat>;   // counter-clockwise
using Ring = std::vector<uint32_t>;  // vertices of a closed polygon

uint32_t AddPoint(Mesh& m, const Flat& p, double z) {
  m.positions.insert(m.positions.end(), {p[0], p[1], z});
  return VertexCount(m) - 1;
}
Ring AddRing(Mesh& m, const Outline& outline, double z) {
  Ring ring;
  for (const Flat& p : outline) ring.push_back(AddPoint(m, p, z));
  return ring;
}
void AddFace(Mesh& m, uint32_t a, uint32_t b, uint32_t c) { m.triangles.insert(m.triangles.end(), {a, b, c}); }

// A band between two rings that start side by side. Seen from outside the body, `left` lies to the left of the
// triangles as they follow the rings.
void Join(Mesh& m, const Ring& right, const Ring& left) {
  size_t i = 0, k = 0;
  while (i < right.size() || k < left.size()) {
    const uint32_t a = right[i % right.size()], b = left[k % left.size()];
    if (k == left.size() || (i < right.size() && (2 * i + 1) * left.size() <= (2 * k + 1) * right.size()))
      AddFace(m, a, right[++i % right.size()], b);
    else
      AddFace(m, a, left[(k + 1) % left.size()], b), ++k;
  }
}
void JoinAll(Mesh& m, const std::vector<Ring>& rings) {
  for (size_t i = 0; i + 1 < rings.size(); ++i) Join(m, rings[i], rings[i + 1]);
}
// A cap of needles from the first corner.
void CloseFromCorner(Mesh& m, const Ring& ring, bool up) {
  for (size_t i = 1; i + 1 < ring.size(); ++i) AddFace(m, ring[0], ring[up ? i : i + 1], ring[up ? i + 1 : i]);
}

Flat OnCircle(double radius, double turn) {
  return {radius * tool::cosine(2 * pi * turn), radius * tool::sine(2 * pi * turn)};
}
Outline Circle(int sides, double radius) {
  Outline circle;
  for (int i = 0; i < sides; ++i) circle.push_back(OnCircle(radius, static_cast<double>(i) / sides));
  return circle;
}

Outline Scaled(Outline outline, double x, double y) {
  for (Flat& p : outline) p[0] *= x, p[1] *= y;
  return outline;
}

// A square of half the width `half`, rounded at its corners.
Outline RoundedSquare(int corners, double half, double radius) {
  Outline outline;
  const int quarter = corners / 4;
  for (int i = 0; i < 4 * quarter; ++i) {
    const double turn = static_cast<double>(i / quarter) / 4 + static_cast<double>(i % quarter) / (4 * (quarter - 1));
    const Flat centre = OnCircle((half - radius) * std::numbers::sqrt2, static_cast<double>(i / quarter) / 4 + 1.0 / 8);
    const Flat p = OnCircle(radius, turn);
    outline.push_back({centre[0] + p[0], centre[1] + p[1]});
  }
  return outline;
}

Outline Teeth(int teeth) {
  Outline outline;
  for (int i = 0; i < 20 * teeth; ++i) {
    // Up, along the tip, down, along the root.
    const int at = i % 20;
    const double up = at < 5 ? at / 5.0 : at < 10 ? 1 : at < 15 ? (15 - at) / 5.0 : 0;
    outline.push_back(OnCircle(1 + 0.08 * up, static_cast<double>(i) / (20 * teeth)));
  }
  return outline;
}

}  // namespace

Mesh PlateWithHoles(int cells, int sides) {
  Mesh m;
  const double heights[] = {-0.1, 0.1};
  const auto corner = [&](int x, int y, int side) {
    return static_cast<uint32_t>((side * (cells + 1) + y) * (cells + 1) + x);
  };
  for (const double z : heights)
    for (int y = 0; y <= cells; ++y)
      for (int x = 0; x <= cells; ++x) AddPoint(m, {static_cast<double>(x), static_cast<double>(y)}, z);
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) {
      // Holes start in the direction of the first corner of their square.
      Outline hole;
      for (int i = 0; i < sides; ++i) {
        const Flat p = OnCircle(0.3, static_cast<double>(i) / sides + 5.0 / 8);
        hole.push_back({x + 0.5 + p[0], y + 0.5 + p[1]});
      }
      const Ring low = AddRing(m, hole, heights[0]), high = AddRing(m, hole, heights[1]);
      const auto square = [&](int side) {
        return Ring{corner(x, y, side), corner(x + 1, y, side), corner(x + 1, y + 1, side), corner(x, y + 1, side)};
      };
      JoinAll(m, {square(1), high, low, square(0)});
    }
  const auto wall = [&](int x, int y, int to_x, int to_y) {
    const uint32_t a = corner(x, y, 0), b = corner(to_x, to_y, 0), c = corner(to_x, to_y, 1), d = corner(x, y, 1);
    AddFace(m, a, b, c), AddFace(m, a, c, d);
  };
  for (int i = 0; i < cells; ++i) {
    wall(i, 0, i + 1, 0), wall(cells, i, cells, i + 1);
    wall(i + 1, cells, i, cells), wall(0, i + 1, 0, i);
  }
  return m;
}

Mesh Gear(int teeth) {
  Mesh m;
  const Outline rim = Teeth(teeth), shaft = Circle(24, 0.2);
  const Ring low = AddRing(m, rim, -0.1), high = AddRing(m, rim, 0.1), inner_high = AddRing(m, shaft, 0.1),
             inner_low = AddRing(m, shaft, -0.1);
  JoinAll(m, {low, high, inner_high, inner_low, low});
  return m;
}

Mesh FilletedBox(int corners) {
  Mesh m;
  constexpr int steps = 6;
  constexpr double fillet = 0.02;
  std::vector<Ring> rings;
  for (const int side : {-1, 1})
    for (int i = 0; i <= steps; ++i) {
      const double turn = (side < 0 ? steps - i : i) / (4.0 * steps);
      const Flat p = OnCircle(fillet, turn);
      rings.push_back(AddRing(m, RoundedSquare(corners, 1 - fillet + p[0], 2 * fillet), side * (0.3 - fillet + p[1])));
    }
  JoinAll(m, rings);
  CloseFromCorner(m, rings.front(), false);
  CloseFromCorner(m, rings.back(), true);
  return m;
}

Mesh Washer() {
  Mesh m;
  const int sides[] = {1000, 600, 240, 90, 24};
  std::vector<Ring> rings;
  for (int i = 0; i < 5; ++i) rings.push_back(AddRing(m, Circle(sides[i], 1 - 0.15 * i), 0.05));
  for (int i = 4; i >= 0; --i) rings.push_back(AddRing(m, Circle(sides[i], 1 - 0.15 * i), -0.05));
  rings.push_back(rings.front());
  JoinAll(m, rings);
  return m;
}

Mesh TurnedPart(int around) {
  Mesh m;
  std::vector<Ring> rings;
  constexpr int steps = 8;
  constexpr double fillet = 0.03;
  const double radii[] = {0.3, 0.6, 0.9, 0.5, 0.25};
  for (int i = 0; i < 5; ++i)
    for (const int side : {-1, 1})
      for (int k = 0; k <= steps; ++k) {
        const Flat p = OnCircle(fillet, (side < 0 ? steps - k : k) / (4.0 * steps));
        const double middle = 1.0 * i, radius = radii[i] - fillet + p[0];
        rings.push_back(AddRing(m, Scaled(Circle(around, 1), radius, radius), middle + side * (0.49 - fillet + p[1])));
      }
  JoinAll(m, rings);
  CloseFromCorner(m, rings.front(), false);
  CloseFromCorner(m, rings.back(), true);
  return m;
}

Mesh Sculpt(int levels) {
  Mesh m = Icosphere(levels, 1, 0);
  for (size_t v = 0; v < m.positions.size(); v += 3) {
    double* p = m.positions.data() + v;
    const double x = p[0], y = p[1], z = p[2];
    // Creases in two directions, and a wave.
    const double height = 1 + 0.15 * std::abs(tool::sine(5 * x + 2 * y)) - 0.2 * std::abs(tool::sine(4 * z - x)) +
                          0.05 * tool::sine(9 * y + 3 * z);
    for (int k = 0; k < 3; ++k) p[k] *= height;
    // Pinches: planes that draw near vertices to a tenth of their distance.
    for (const double plane : {-0.5, 0.1, 0.6}) {
      const double away = p[0] - plane, reach = 0.12;
      if (std::abs(away) < reach) p[0] = plane + away * (0.1 + 0.9 * std::abs(away) / reach);
    }
  }
  return m;
}

Mesh Tilted(Mesh m) {
  // Turns by 1 about z, then by .7 about x.
  const double c = tool::cosine(1), s = tool::sine(1), d = tool::cosine(0.7), t = tool::sine(0.7);
  for (size_t v = 0; v < m.positions.size(); v += 3) {
    double* p = m.positions.data() + v;
    const double x = c * p[0] - s * p[1], y = s * p[0] + c * p[1], z = p[2];
    p[0] = x, p[1] = d * y - t * z, p[2] = t * y + d * z;
  }
  return m;
}

std::vector<NamedMesh> FilesIn(const std::string& shared) {
  std::vector<std::string> paths;
  for (const char* folder : {"meshes", "field"}) {
    std::error_code absent;
    for (const auto& entry : std::filesystem::directory_iterator(shared + "/data/" + folder, absent))
      paths.push_back(entry.path().string());
  }
  if (paths.empty()) std::fprintf(stderr, "no files in %s/data: real ones are left out\n", shared.c_str());
  std::sort(paths.begin(), paths.end());
  std::vector<NamedMesh> meshes;
  for (const std::string& path : paths) {
    NamedMesh named{std::filesystem::path(path).stem().string(), {}};
    if (tool::read_mesh(path, named.mesh) && TriangleCount(named.mesh) >= 1000) meshes.push_back(std::move(named));
  }
  return meshes;
}

std::vector<NamedMesh> RealMeshes(const std::string& only) {
  struct Maker {
    const char* name;
    Mesh (*make)();
  };
  constexpr Maker makers[] = {
      {"plate", [] { return PlateWithHoles(6, 64); }},
      {"plate-tilted", [] { return Tilted(PlateWithHoles(6, 64)); }},
      {"gear", [] { return Gear(50); }},
      {"gear-tilted", [] { return Tilted(Gear(50)); }},
      {"fillets", [] { return FilletedBox(1000); }},
      {"fillets-tilted", [] { return Tilted(FilletedBox(1000)); }},
      {"washer", [] { return Washer(); }},
      {"washer-tilted", [] { return Tilted(Washer()); }},
      {"turned", [] { return TurnedPart(128); }},
      {"sculpt-10k", [] { return Sculpt(5); }},
      {"sculpt-40k", [] { return Sculpt(6); }},
#ifdef BENCH_CGAL
      {"scan-sculpt", [] { return DecimatedWithCgal(Sculpt(7), 0.01); }},
      {"scan-knot", [] { return DecimatedWithCgal(Knot(5000, 32), 0.01); }},
      {"scan-torus", [] { return DecimatedWithCgal(Torus(1000, 160), 0.01); }},
      {"scan-noise", [] { return DecimatedWithCgal(Noisy(Sculpt(7), 0.3, 5), 0.05); }},
#endif
  };
  std::vector<NamedMesh> meshes;
  for (const Maker& maker : makers)
    if (std::string(maker.name).find(only) != std::string::npos) meshes.push_back({maker.name, maker.make()});
  return meshes;
}

}  // namespace bench
