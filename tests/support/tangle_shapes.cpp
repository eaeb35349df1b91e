// SPDX-License-Identifier: MIT
#include "support/tangle_shapes.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "support/mesh_building.h"
#include "tool/scenes/elementary.h"

namespace support {

int WholeIn(Random& random, int low, int high) { return static_cast<int>(std::floor(Uniform(random, low, high + 1))); }

bool Coin(Random& random) { return random() >> 63 != 0; }

Point RandomDirection(Random& random) {
  const double z = Uniform(random, -1, 1), a = Uniform(random, 0, 2 * pi), r = std::sqrt(1 - z * z);
  return {r * tool::cosine(a), r * tool::sine(a), z};
}

Mesh RandomlyTurned(Mesh m, Random& random) {
  // Shoemake 1992: a unit quaternion.
  const double u = Uniform(random, 0, 1), a = Uniform(random, 0, 2 * pi), b = Uniform(random, 0, 2 * pi);
  const double x = std::sqrt(1 - u) * tool::sine(a), y = std::sqrt(1 - u) * tool::cosine(a),
               z = std::sqrt(u) * tool::sine(b), w = std::sqrt(u) * tool::cosine(b);
  const Point rows[3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                         {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                         {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
  return Mapped(std::move(m), [&](const Point& p) { return Point{Dot(rows[0], p), Dot(rows[1], p), Dot(rows[2], p)}; });
}

Mesh Reversed(Mesh m) {
  for (size_t f = 0; f < m.triangles.size(); f += 3) std::swap(m.triangles[f], m.triangles[f + 1]);
  return m;
}

Mesh Resized(Mesh m, double factor) {
  for (double& x : m.positions) x *= factor;
  return m;
}

Mesh Block(Point low, Point high, std::array<int, 3> counts) {
  Mesh m;
  std::map<std::array<int, 3>, size_t> number;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [place, added] = number.emplace(at, number.size());
    for (size_t i = 0; added && i < 3; ++i) m.positions.push_back(low[i] + (high[i] - low[i]) * at[i] / counts[i]);
    return place->second;
  };
  for (size_t axis = 0; axis < 3; ++axis)
    for (int side : {0, counts[axis]})
      for (int i = 0; i < counts[(axis + 1) % 3]; ++i)
        for (int k = 0; k < counts[(axis + 2) % 3]; ++k) {
          const auto corner = [&](int u, int v) {
            std::array<int, 3> at{};
            at[axis] = side;
            at[(axis + 1) % 3] = i + u;
            at[(axis + 2) % 3] = k + v;
            return vertex(at);
          };
          const size_t c[4] = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          if (side == 0)
            AddQuad(m, c[0], c[3], c[2], c[1]);
          else
            AddQuad(m, c[0], c[1], c[2], c[3]);
        }
  return m;
}

Mesh Slab(double x, double y, double z, double edge) {
  const auto cells = [&](double side) { return std::max(1, static_cast<int>(std::lround(side / edge))); };
  return Block({-x / 2, -y / 2, -z / 2}, {x / 2, y / 2, z / 2}, {cells(x), cells(y), cells(z)});
}

Mesh Stick(double radius, double length, int sides) {
  const double edge = 2 * pi * radius / sides;
  // The ends are rounded off in rings, so that all triangles there have about the size of an edge.
  const int rings = std::max(1, static_cast<int>(std::lround(radius / edge)));
  const int steps = std::max(1, static_cast<int>(std::lround(length / edge)));
  std::vector<Point> points;
  std::vector<double> radii;
  const auto add = [&](double z, double r) {
    points.push_back({0, 0, z});
    radii.push_back(r);
  };
  for (int i = 1; i < rings; ++i) add(-length / 2 - 0.2 * radius * (rings - i) / rings, radius * i / rings);
  for (int i = 0; i <= steps; ++i) add(-length / 2 + length * i / steps, radius);
  for (int i = rings - 1; i > 0; --i) add(length / 2 + 0.2 * radius * (rings - i) / rings, radius * i / rings);
  return Tube(points, radii, sides, {1, 0, 0});
}

Mesh Ring(const std::vector<Point>& curve, double radius, int sides) {
  const size_t n = curve.size(), count = static_cast<size_t>(sides);
  const auto along = [&](size_t i) { return Unit(Difference(curve[(i + 1) % n], curve[(i + n - 1) % n])); };
  const auto square = [](const Point& u, const Point& t) { return Unit(Difference(u, Scaled(Dot(u, t), t))); };
  std::vector<Point> across = {square({0.3, 0.5, 0.8}, along(0))};
  for (size_t i = 1; i <= n; ++i) across.push_back(square(across[i - 1], along(i % n)));
  // The turn of the frame on its way round is taken back evenly.
  const Point& u = across[0];
  const double twist = tool::arc_tangent(Dot(across[n], Cross(along(0), u)), Dot(across[n], u));
  Mesh m;
  for (size_t i = 0; i < n; ++i) {
    const Point v = Cross(along(i), across[i]);
    for (size_t k = 0; k < count; ++k) {
      const double a =
          2 * pi * static_cast<double>(k) / sides - twist * static_cast<double>(i) / static_cast<double>(n);
      const Point p =
          Sum(curve[i], Sum(Scaled(radius * tool::cosine(a), across[i]), Scaled(radius * tool::sine(a), v)));
      m.positions.insert(m.positions.end(), p.begin(), p.end());
    }
  }
  for (size_t i = 0; i < n; ++i)
    for (size_t k = 0; k < count; ++k) {
      const size_t j = (i + 1) % n, l = (k + 1) % count;
      AddQuad(m, i * count + k, i * count + l, j * count + l, j * count + k);
    }
  return m;
}

Mesh Trefoil(double height, double radius, int around, int sides) {
  std::vector<Point> curve;
  for (int i = 0; i < around; ++i) {
    const double t = 2 * pi * i / around, r = 2 + tool::cosine(3 * t);
    curve.push_back({r * tool::cosine(2 * t), r * tool::sine(2 * t), height * tool::sine(3 * t)});
  }
  return Ring(curve, radius, sides);
}

Mesh Bumpy(double height, int parts, Random& random) {
  Point wave[3];
  double phase[3];
  for (int i = 0; i < 3; ++i) {
    const Point along = RandomDirection(random);
    wave[i] = Scaled(Uniform(random, 1.5, 3), along);
    phase[i] = Uniform(random, 0, 2 * pi);
  }
  return Mapped(Sphere({}, 1, parts), [&](const Point& p) {
    double r = 1;
    for (int i = 0; i < 3; ++i) r += height / 3 * tool::sine(Dot(wave[i], p) + phase[i]);
    return Scaled(r, p);
  });
}

Mesh Horn(double radius, double ratio, int sides) {
  // From ring to ring as far as from vertex to vertex.
  const double growth = 1 + 2 * pi * radius / sides;
  const int steps = static_cast<int>(std::ceil(tool::logarithm(ratio) / tool::logarithm(growth)));
  std::vector<Point> points;
  std::vector<double> radii;
  const auto add = [&](double z, double r) {
    points.push_back({0, 0, z});
    radii.push_back(r);
  };
  add(0.9 / ratio, 0.6 * radius / ratio);
  for (int i = 0; i <= steps; ++i) {
    const double z = tool::exponential(tool::logarithm(ratio) * (static_cast<double>(i) / steps - 1));
    add(z, radius * z);
  }
  const int rings = sides / 6;
  for (int i = rings - 1; i > 0; --i) add(1 + 0.2 * radius * (rings - i) / rings, radius * i / rings);
  return Tube(points, radii, sides, {1, 0, 0});
}

Mesh Noisy(const Mesh& m, double share, Random& random) {
  std::vector<Point> by(VertexCount(m));
  for (Point& p : by) p = RandomPoint(random, -1, 1);
  const auto moved = [&](double far) {
    Mesh out = m;
    for (size_t i = 0; i < m.positions.size(); ++i) out.positions[i] += far * by[i / 3][i % 3];
    return out;
  };
  const double wanted = share * TriangleCount(m);
  double low = 0, high = std::sqrt(Dot(PositionOf(m, 0), PositionOf(m, 0)));
  for (int step = 0; step < 12; ++step) {
    const double middle = 0.5 * (low + high);
    std::vector<bool> meets(TriangleCount(m));
    for (const auto& [a, b] : AllMeetingPairs(moved(middle))) meets[a] = meets[b] = true;
    (static_cast<double>(std::count(meets.begin(), meets.end(), true)) < wanted ? low : high) = middle;
  }
  return moved(high);
}

Mesh Dented(double angle, double depth, int parts) {
  return Mapped(Sphere({}, 1, parts), [&](const Point& p) {
    const double a = tool::arc_cosine(std::clamp(p[2], -1.0, 1.0)) / angle;
    // Steep, so that the shaft has about the same width everywhere, a little less towards its end.
    const double down = a < 1 ? depth * (1 - a * a * a * a) : 0;
    return Point{p[0], p[1], p[2] - down};
  });
}

Mesh Pinched(double depth, int waists, int sides) {
  const double pitch = 2.5, length = pitch * (waists + 1);
  return Mapped(Stick(1, length, sides), [&](const Point& p) {
    const double along = std::clamp((p[2] + length / 2) / pitch - 0.5, 0.0, 1.0 * waists);
    return Point{p[0] * (1 - (1 + depth) * (0.5 - 0.5 * tool::cosine(2 * pi * along))), p[1], p[2]};
  });
}

Mesh SharedMesh(const std::string& file) {
  Mesh m;
  const tool::Status read = tool::read_mesh(std::string(TOPOADAPT_SHARED_DATA) + "/meshes/" + file, m);
  return read ? m : Mesh{};
}

}  // namespace support
