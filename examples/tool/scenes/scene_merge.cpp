// SPDX-License-Identifier: MIT
// Bodies that meet: pairs at random.
#include <algorithm>

#include "tool/scenes/elementary.h"
#include "tool/scenes/scene.h"
#include "tool/scenes/shapes.h"
#include "tool/scenes/sphere.h"

namespace tool {

namespace {

// Columns of a rotation: three unit vectors square to each other.
struct Frame {
  Point x, y, z;
  Point operator()(const Point& p) const { return p[0] * x + p[1] * y + p[2] * z; }
};

Frame random_frame(Dice& dice) {
  const Point x = dice.direction();
  Point helper;
  do helper = dice.direction();
  while (std::fabs(dot(helper, x)) > 0.9);
  const Point y = unit(cross(helper, x));
  return {x, y, cross(x, y)};
}

// 250 to 360 vertices: octahedral, or rings and sectors about as long as wide.
TriangleMesh unit_sphere(Dice& dice) {
  const uint64_t choice = dice.below(6);
  if (choice < 2) return make_sphere({0, 0, 0}, 1, 8 + static_cast<int>(choice));
  const int rings = 12 + static_cast<int>(dice.below(3));
  const int least = (248 + rings - 1) / rings, most = 358 / rings;
  return make_globe({0, 0, 0}, 1, rings, least + static_cast<int>(dice.below(static_cast<uint64_t>(most - least + 1))));
}

// An ellipsoid with a wave round it, flat enough for a convex body: a wave of amplitude a and wave number k on a unit
// sphere keeps it convex while a (k^2 + 1) < 1. Affine maps keep bodies convex.
struct Body {
  Frame pose, wave;
  double amplitude, phase, scale;
  Point axes;

  // From the centre to the surface, for a direction in the coordinates of the body, in which the body is nearly a unit
  // sphere.
  double radius(const Point& direction) const {
    return scale * (1 + amplitude * sine(3 * dot(wave.x, direction) + phase));
  }
  Point place(const Point& own) const { return pose({axes[0] * own[0], axes[1] * own[1], axes[2] * own[2]}); }
  // How far out a point lies: 1 on the surface. `outward` is set to the point of the surface before it.
  double depth(const Point& p, Point& outward) const {
    const Point own{dot(p, pose.x) / axes[0], dot(p, pose.y) / axes[1], dot(p, pose.z) / axes[2]};
    const double r = length(own);
    if (r == 0) return 0;
    const double wanted = radius(1 / r * own);
    outward = place(wanted / r * own);
    return r / wanted;
  }
};

Body random_body(Dice& dice, double scale) {
  const Frame pose = random_frame(dice), wave = random_frame(dice);
  const double amplitude = dice.uniform(0, 0.04), phase = dice.uniform(0, 2 * pi);
  const double a = dice.uniform(0.75, 1.3), b = dice.uniform(0.75, 1.3), c = dice.uniform(0.75, 1.3);
  return {pose, wave, amplitude, phase, scale, {a, b, c}};
}

TriangleMesh mesh_of(const Body& body, Dice& dice) {
  TriangleMesh m = unit_sphere(dice);
  transform(m, [&](const Point& p) { return body.place(body.radius(unit(p)) * unit(p)); });
  return m;
}

// How far the body extends beyond the plane square to `direction` through its centre.
double reach(const TriangleMesh& m, const Point& direction) {
  double most = 0;
  for (size_t v = 0; v < vertex_count(m); ++v) most = std::max(most, dot(position_of(m, v), direction));
  return most;
}

// From the centre to the surface, about: to the vertex nearest to the direction.
double radius_towards(const TriangleMesh& m, const Point& direction) {
  Point best = position_of(m, 0);
  for (size_t v = 1; v < vertex_count(m); ++v)
    if (const Point p = position_of(m, v); dot(unit(p), direction) > dot(unit(best), direction)) best = p;
  return length(best);
}

// Two bodies on their ways: meshes, centres and velocities.
struct Pair {
  Body body[2];
  TriangleMesh mesh[2];
  Point center[2], velocity[2];
};

// The bodies go on into each other. At time 1 they overlap, on the line of their centres, by 20 to 70 % of the shorter
// of the two radii along the line. Two convex bodies are one body of genus 0 from the first contact on.
Pair random_pair(uint64_t seed) {
  Dice dice(seed);
  Pair p{};
  for (int i = 0; i < 2; ++i) {
    p.body[i] = random_body(dice, i == 0 ? 1 : dice.uniform(0.6, 1));
    p.mesh[i] = mesh_of(p.body[i], dice);
  }
  const Point d = dice.direction(), back = -1 * d;
  const double apart = reach(p.mesh[0], d) + reach(p.mesh[1], back) + dice.uniform(0.02, 0.4);
  const Point across = unit(cross(d, random_frame(dice).x)), aside = dice.uniform(0, 0.6) * across;
  const double r = radius_towards(p.mesh[0], d), q = radius_towards(p.mesh[1], back);
  const Point closing = (apart - (r + q - dice.uniform(0.2, 0.7) * std::min(r, q))) * d + aside;
  const double share = dice.uniform(0, 1);
  const Point course = dice.direction(), drift = dice.uniform(0, 1) * course;
  p.velocity[0] = drift + share * closing;
  p.velocity[1] = drift - (1 - share) * closing;
  p.center[1] = apart * d + aside;
  transform(p.mesh[1], [&](const Point& x) { return x + p.center[1]; });
  return p;
}

Scene scene_of(const Pair& pair) {
  Scene s;
  for (int i = 0; i < 2; ++i) append(s.mesh, pair.mesh[i]);
  s.duration = 1;
  s.step = 1.0 / 20;
  return s;
}

}  // namespace

// Each vertex keeps the velocity of its body; new vertices have a velocity in between. A crease then stays behind the
// true crease, and the bodies may close over it, with voids left at the end.
Scene make_ramming_pair(uint64_t seed) {
  const Pair pair = random_pair(seed);
  Scene s = scene_of(pair);
  s.carried_width = 3;
  for (int i = 0; i < 2; ++i)
    for (size_t v = 0; v < vertex_count(pair.mesh[i]); ++v)
      s.carried.insert(s.carried.end(), pair.velocity[i].begin(), pair.velocity[i].end());
  s.motion = [](const Moment& m, std::vector<double>& targets) {
    for (size_t i = 0; i < targets.size(); ++i) targets[i] = m.positions[i] + m.step * m.carried[i];
  };
  return s;
}

// Volume of the union at the end, by counting the cells of a lattice with their middle within: about 10^5 of 64^3. The
// surface's share, some 10^4 cells, is counted to about .1 %.
double volume_at_end(const Pair& pair) {
  constexpr int cells = 64;
  Point low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (int i = 0; i < 2; ++i)
    for (size_t v = 0; v < vertex_count(pair.mesh[i]); ++v)
      for (size_t k = 0; k < 3; ++k) {
        const double x = position_of(pair.mesh[i], v)[k] + pair.velocity[i][k];
        low[k] = std::min(low[k], x - 0.1);
        high[k] = std::max(high[k], x + 0.1);
      }
  const Point cell = 1.0 / cells * (high - low);
  size_t within = 0;
  for (int x = 0; x < cells; ++x)
    for (int y = 0; y < cells; ++y)
      for (int z = 0; z < cells; ++z) {
        const Point p = low + Point{(x + 0.5) * cell[0], (y + 0.5) * cell[1], (z + 0.5) * cell[2]};
        Point unused;
        const auto inside = [&](int i) {
          return pair.body[i].depth(p - pair.center[i] - pair.velocity[i], unused) < 1;
        };
        within += inside(0) || inside(1) ? 1u : 0u;
      }
  return static_cast<double>(within) * cell[0] * cell[1] * cell[2];
}

// Each vertex goes with the body of the nearer surface: the crease stays in place.
Scene make_merging_pair(uint64_t seed) {
  const Pair pair = random_pair(seed);
  Scene s = scene_of(pair);
  s.motion = [pair](const Moment& m, std::vector<double>& targets) {
    for (size_t v = 0; v < m.vertices(); ++v) {
      Point surface[2];
      double depth[2];
      for (int i = 0; i < 2; ++i)
        depth[i] = pair.body[i].depth(m.position(v) - (pair.center[i] + m.time * pair.velocity[i]), surface[i]);
      const int nearer = depth[0] <= depth[1] ? 0 : 1;
      const Point p = pair.center[nearer] + (m.time + m.step) * pair.velocity[nearer] + surface[nearer];
      std::copy(p.begin(), p.end(), targets.begin() + static_cast<std::ptrdiff_t>(3 * v));
    }
  };
  s.any_step = true;
  s.end = SceneEnd{{0}};
  // Chords take some 2 % away, and a crease is blunt by an edge.
  s.volume = volume_at_end(pair);
  s.volume_tolerance = 0.04;
  return s;
}

}  // namespace tool
