// SPDX-License-Identifier: MIT
// Balls that grow until they overlap. The surface is the boundary of their union, of known topology.
#include <algorithm>

#include "tool/scenes/closing_voids.h"
#include "tool/scenes/elementary.h"
#include "tool/scenes/scene.h"
#include "tool/scenes/shapes.h"
#include "tool/scenes/sphere.h"

namespace tool {

namespace {

// Growth of the radius in one step, in edge lengths. Vertices off the spheres, such as new vertices in a crease,
// approach the spheres at most twice as fast.
constexpr double growth_per_step = 0.25;
// A tunnel or void is lost when about as narrow as an edge is long: at a radius of .75 edges its waist has 2 pi .75 =
// 4.7 edges.
constexpr double margin_in_edges = 0.75;

struct Balls {
  std::vector<Point> centers;
  double first_radius, last_radius, edge_length;
};

struct Growth {
  Point target;
  bool overdue = false;
};

// Along the normal of the sphere round the nearest centre, on to the given radius, by at most `most`. Points deeper in
// a ball, such as the walls of a channel, are overdue and go along their own normal.
Growth grown(const Point& from, const Point& normal, const std::vector<Point>& centers, double radius, double most) {
  const Point* nearest = nullptr;
  double least = 1e300;
  for (const Point& c : centers)
    if (const Point d = from - c; dot(d, d) < least) {
      least = dot(d, d);
      nearest = &c;
    }
  if (nearest == nullptr || least == 0) return {from};
  const double way = radius - std::sqrt(least);
  if (way > most) return {from + most * normal, true};
  return {from + std::max(way, -most) / std::sqrt(least) * (from - *nearest)};
}

// Centres in a lattice of cells, so that a search looks only at near centres.
class NearCenters {
 public:
  NearCenters(const std::vector<Point>& centers, double reach) : reach_(reach) {
    for (const Point& c : centers)
      for (size_t i = 0; i < 3; ++i) low_[i] = std::min(low_[i], c[i] - 2 * reach);
    for (const Point& c : centers)
      for (size_t i = 0; i < 3; ++i)
        size_[i] = std::max(size_[i], static_cast<size_t>((c[i] + 2 * reach - low_[i]) / reach) + 1);
    cells_.resize(size_[0] * size_[1] * size_[2]);
    for (const Point& c : centers) for_each_cell_round(c, [&](std::vector<Point>& cell) { cell.push_back(c); });
  }
  // All centres within reach of p, and some more.
  const std::vector<Point>& near(const Point& p) const { return cells_[index(cell_of(p), {0, 0, 0})]; }

 private:
  using Cell = std::array<size_t, 3>;
  Cell cell_of(const Point& p) const {
    Cell cell;
    for (size_t i = 0; i < 3; ++i) {
      const double at = std::clamp((p[i] - low_[i]) / reach_, 1.0, static_cast<double>(size_[i] - 2));
      cell[i] = static_cast<size_t>(at);
    }
    return cell;
  }
  size_t index(const Cell& cell, const std::array<int, 3>& step) const {
    size_t at[3];
    for (size_t i = 0; i < 3; ++i) at[i] = cell[i] + static_cast<size_t>(step[i] + 1) - 1;
    return (at[2] * size_[1] + at[1]) * size_[0] + at[0];
  }
  template <class Visit>
  void for_each_cell_round(const Point& c, const Visit& visit) {
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) visit(cells_[index(cell_of(c), {x, y, z})]);
  }

  double reach_;
  Point low_{1e300, 1e300, 1e300};
  size_t size_[3] = {1, 1, 1};
  std::vector<std::vector<Point>> cells_;
};

Scene scene_of(const Balls& balls) {
  Scene s;
  const double h = balls.edge_length;
  // Octahedral spheres have edges of pi / 2 r / parts.
  const int parts = std::max(2, static_cast<int>(std::lround(pi / 2 * balls.first_radius / h)));
  for (const Point& c : balls.centers) append(s.mesh, make_sphere({c[0], c[1], c[2]}, balls.first_radius, parts));
  s.edge_length = h;
  s.any_step = true;
  s.step = growth_per_step * h;
  s.duration = balls.last_radius - balls.first_radius;
  s.balls = BallUnion{balls.centers, balls.last_radius, margin_in_edges * h};
  s.motion = [balls, near = NearCenters(balls.centers, 1.5 * balls.last_radius)](const Moment& m,
                                                                                 std::vector<double>& targets) {
    const double radius = balls.first_radius + m.time + m.step;
    const double most = 2 * m.step;
    const std::vector<Point> normals =
        vertex_normals(m.positions.data(), m.vertices(), m.triangles.data(), m.triangles.size());
    std::vector<bool> overdue(m.vertices());
    for (size_t v = 0; v < m.vertices(); ++v) {
      const Growth growth = grown(m.position(v), normals[v], near.near(m.position(v)), radius, most);
      std::copy(growth.target.begin(), growth.target.end(), targets.begin() + static_cast<std::ptrdiff_t>(3 * v));
      overdue[v] = growth.overdue;
    }
    turn_closing_voids(m, overdue, targets);
  };
  return s;
}

// Solves g x = y for n unknowns by elimination; false if the system is singular.
bool solve(int n, double (&g)[3][3], double (&y)[3], double (&x)[3]) {
  for (int i = 0; i < n; ++i) {
    int pivot = i;
    for (int k = i + 1; k < n; ++k)
      if (std::fabs(g[k][i]) > std::fabs(g[pivot][i])) pivot = k;
    if (std::fabs(g[pivot][i]) < 1e-12) return false;
    std::swap(g[i], g[pivot]);
    std::swap(y[i], y[pivot]);
    for (int k = i + 1; k < n; ++k) {
      const double f = g[k][i] / g[i][i];
      for (int c = i; c < n; ++c) g[k][c] -= f * g[i][c];
      y[k] -= f * y[i];
    }
  }
  for (int i = n - 1; i >= 0; --i) {
    x[i] = y[i];
    for (int c = i + 1; c < n; ++c) x[i] -= g[i][c] * x[c];
    x[i] /= g[i][i];
  }
  return true;
}

// The radius at which the balls round 2 to 4 points first have a point in common, no other ball before: the radius of
// their smallest sphere, if its centre lies between the points and no other centre lies within. Else 0.
double critical_radius(const std::vector<Point>& corners, const std::vector<Point>& centers) {
  const int n = static_cast<int>(corners.size()) - 1;
  double gram[3][3] = {}, half[3] = {}, x[3] = {};
  const auto side = [&](int i) { return corners[static_cast<size_t>(i) + 1] - corners[0]; };
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) gram[i][k] = dot(side(i), side(k));
    half[i] = dot(side(i), side(i)) / 2;
  }
  if (!solve(n, gram, half, x)) return 0;
  Point middle = corners[0];
  double first = 1;
  for (int i = 0; i < n; ++i) {
    if (x[i] <= 0) return 0;
    first -= x[i];
    middle = middle + x[i] * side(i);
  }
  const double radius = length(corners[0] - middle);
  for (const Point& c : centers)
    if (length(c - middle) < radius * (1 - 1e-9)) return 0;
  return first > 0 ? radius : 0;
}

std::vector<double> critical_radii(const std::vector<Point>& centers) {
  std::vector<double> radii;
  for (uint32_t subset = 1; subset < 1u << centers.size(); ++subset) {
    std::vector<Point> corners;
    for (size_t i = 0; i < centers.size(); ++i)
      if ((subset >> i & 1) != 0) corners.push_back(centers[i]);
    if (corners.size() < 2 || corners.size() > 4) continue;
    if (const double r = critical_radius(corners, centers); r > 0) radii.push_back(r);
  }
  return radii;
}

double distance_to_nearest(const std::vector<double>& critical, double r) {
  double nearest = 1e300;
  for (const double c : critical) nearest = std::min(nearest, std::fabs(r - c));
  return nearest;
}

// The radius between `least` and `most` furthest from all critical radii.
double uncritical_radius(const std::vector<double>& critical, double least, double most) {
  constexpr int tries = 200;
  double best = least, furthest = -1;
  for (int i = 0; i <= tries; ++i) {
    const double r = least + (most - least) * i / tries, nearest = distance_to_nearest(critical, r);
    if (nearest > furthest) {
      furthest = nearest;
      best = r;
    }
  }
  return best;
}

// In a cube, .3 from each other.
std::vector<Point> scattered(uint64_t count, Dice& dice) {
  std::vector<Point> centers;
  const double half = 0.375 * cube_root(static_cast<double>(count));
  while (centers.size() < count) {
    const Point c = dice.in_cube(half);
    if (std::all_of(centers.begin(), centers.end(), [&](const Point& d) { return length(c - d) > 0.3; }))
      centers.push_back(c);
  }
  return centers;
}

// Up to eight balls at random, up to a radius at which most have met. New places are drawn while all such radii are
// near critical.
Scene few_balls(uint64_t count, uint64_t seed) {
  constexpr double edge = 0.06, spread = 0.1;
  Dice dice(seed * 16 + count);
  for (;;) {
    std::vector<Point> centers = scattered(count, dice);
    const std::vector<double> critical = critical_radii(centers);
    const double wanted = dice.uniform(0.4, 0.5);
    const double radius = uncritical_radius(critical, wanted - spread, wanted + spread);
    if (distance_to_nearest(critical, radius) > margin_in_edges * edge)
      return scene_of({std::move(centers), 0.12, radius, edge});
  }
}

// Many balls at random places have critical radii everywhere. So the balls stand near the points of a cubic lattice of
// spacing 1. Its critical radii lie near 1/2, sqrt(2)/2 (and sqrt(6)/3 where points are missing) and sqrt(3)/2.
std::vector<Point> grid_points(const int (&box)[3]) {
  std::vector<Point> points;
  for (int x = 0; x < box[0]; ++x)
    for (int y = 0; y < box[1]; ++y)
      for (int z = 0; z < box[2]; ++z) points.push_back({1.0 * x, 1.0 * y, 1.0 * z});
  return points;
}

std::vector<Point> jittered(std::vector<Point> points, double jitter, Dice& dice) {
  for (Point& p : points) p = p + dice.in_cube(jitter);
  return points;
}

// With a void in every cube of the box at the end.
Scene solid_balls(std::vector<Point> points, const int (&box)[3], Dice& dice) {
  Scene s = scene_of({jittered(std::move(points), 0.012, dice), 0.4, 0.79, 0.07});
  // The windows of the voids close over many steps; between them the motion has to see the walls as they become.
  s.any_step = false;
  const int voids = (box[0] - 1) * (box[1] - 1) * (box[2] - 1);
  s.end = SceneEnd{std::vector<long>(static_cast<size_t>(voids) + 1, 0)};
  return s;
}

// Seeds take turns: odd ones have `count` of the points of a cube about twice as large, and end at .6, as a sponge full
// of tunnels; even ones have all points of a box.
Scene many_balls(uint64_t count, const int (&box)[3], int cube, uint64_t seed) {
  Dice dice(seed * 16 + 9);
  const bool sponge = seed % 2 == 1;
  std::vector<Point> points = sponge ? grid_points({cube, cube, cube}) : grid_points(box);
  for (size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[dice.below(i)]);
  points.resize(count);
  if (!sponge) return solid_balls(std::move(points), box, dice);
  return scene_of({jittered(std::move(points), 0.02, dice), 0.4, 0.6, 0.1});
}

}  // namespace

Scene make_balls_2(uint64_t seed) { return few_balls(2, seed); }
Scene make_balls_3(uint64_t seed) { return few_balls(3, seed); }
Scene make_balls_4(uint64_t seed) { return few_balls(4, seed); }
Scene make_balls_5(uint64_t seed) { return few_balls(5, seed); }
Scene make_balls_6(uint64_t seed) { return few_balls(6, seed); }
Scene make_balls_7(uint64_t seed) { return few_balls(7, seed); }
Scene make_balls_8(uint64_t seed) { return few_balls(8, seed); }
Scene make_balls_cube(uint64_t seed) {
  constexpr int box[3] = {2, 2, 2};
  Dice dice(seed * 16 + 10);
  return solid_balls(grid_points(box), box, dice);
}
Scene make_balls_100(uint64_t seed) { return many_balls(100, {4, 5, 5}, 6, seed); }
Scene make_balls_1000(uint64_t seed) { return many_balls(1000, {10, 10, 10}, 12, seed); }

}  // namespace tool
