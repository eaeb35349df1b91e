// SPDX-License-Identifier: MIT
// Several bodies that reach one point in the same step.
#include <algorithm>

#include "tool/scenes/elementary.h"
#include "tool/scenes/scene.h"
#include "tool/scenes/shapes.h"
#include "tool/scenes/sphere.h"

namespace tool {

namespace {

// Directions that spread: each is the best of several tries, the farthest from all earlier directions.
std::vector<Point> spread_directions(size_t count, Dice& dice) {
  constexpr int tries = 400;
  std::vector<Point> directions;
  while (directions.size() < count) {
    Point best{};
    double least = 2;
    for (int i = 0; i < tries; ++i) {
      const Point d = dice.direction();
      double nearest = -1;
      for (const Point& e : directions) nearest = std::max(nearest, dot(d, e));
      if (nearest < least) {
        least = nearest;
        best = d;
      }
    }
    directions.push_back(best);
  }
  return directions;
}

// Half of the smallest angle between two directions.
double half_angle(const std::vector<Point>& directions) {
  double nearest = -1;
  for (const Point& d : directions)
    for (const Point& e : directions)
      if (&d != &e) nearest = std::max(nearest, dot(d, e));
  return arc_cosine(nearest) / 2;
}

// Spheres drawn out to spindles with their tips at .1 from the origin. All tips pass the origin in the same step: the
// spindles become one body of genus 0.
Scene make_meeting(size_t count, uint64_t seed) {
  constexpr double half_length = 2, gap = 0.1, depth = 0.35;
  Dice dice(seed * 16 + count);
  const std::vector<Point> directions = spread_directions(count, dice);
  // Each spindle keeps to a cone of its own: in it an ellipsoid with centre at c and long half axis a may be tan(angle)
  // sqrt(c^2 - a^2) wide.
  const double room = tangent(std::min(half_angle(directions), pi / 3)) *
                      std::sqrt((half_length + gap) * (half_length + gap) - half_length * half_length);
  const double half_width = std::min(0.5, 0.9 * room);
  Scene s;
  s.carried_width = 3;
  for (const Point& d : directions) {
    TriangleMesh spindle = make_sphere({0, 0, 0}, half_width, 6);
    transform(spindle,
              [&](const Point& p) { return p + ((half_length / half_width - 1) * dot(p, d) + half_length + gap) * d; });
    append(s.mesh, spindle);
    for (size_t v = 0; v < vertex_count(spindle); ++v) {
      const Point way = -(gap + depth) * d;
      s.carried.insert(s.carried.end(), way.begin(), way.end());
    }
  }
  s.motion = [](const Moment& m, std::vector<double>& targets) {
    for (size_t i = 0; i < targets.size(); ++i) targets[i] = m.positions[i] + m.step * m.carried[i];
  };
  s.step = s.duration = 1;
  s.whole_steps = true;
  s.end = SceneEnd{{0}};
  return s;
}

}  // namespace

Scene make_meeting_3(uint64_t seed) { return make_meeting(3, seed); }
Scene make_meeting_4(uint64_t seed) { return make_meeting(4, seed); }
Scene make_meeting_5(uint64_t seed) { return make_meeting(5, seed); }
Scene make_meeting_8(uint64_t seed) { return make_meeting(8, seed); }

}  // namespace tool
