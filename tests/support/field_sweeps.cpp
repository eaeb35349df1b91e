// SPDX-License-Identifier: MIT
// Field meshes swept along helices: springs, threads and wires with turns in each other.
#include "support/field_meshes.h"
#include "support/field_shapes.h"
#include "support/tangle_shapes.h"
#include "tool/scenes/elementary.h"

namespace support {

namespace {

Mesh TurnedOrNot(const Mesh& m, Random& random) { return Coin(random) ? m : RandomlyTurned(m, random); }

struct Helix {
  double radius, pitch, turns;
  Point At(double turn) const {
    const double a = 2 * pi * turn;
    return {radius * tool::cosine(a), radius * tool::sine(a), pitch * turn};
  }
};

std::vector<Point> PointsOf(const Helix& helix, int steps) {
  std::vector<Point> points;
  for (int i = 0; i <= steps; ++i) points.push_back(helix.At(helix.turns * i / steps));
  return points;
}

Mesh RoundTube(const std::vector<Point>& points, double radius, int sides) {
  return Tube(points, std::vector<double>(points.size(), radius), sides, {0, 0, 1});
}

// Turns closer than the tube is thick.
Mesh Spring(int sides, int steps_per_turn, Random& random) {
  const double tube = Uniform(random, 0.1, 0.35);
  const Helix helix{1, 2 * tube * Uniform(random, 0.3, 0.97), Uniform(random, 1.2, 4)};
  const int steps = static_cast<int>(helix.turns * steps_per_turn);
  return TurnedOrNot(RoundTube(PointsOf(helix, steps), tube, sides), random);
}

Mesh CoarseSpring(Random& random) {
  const int sides = WholeIn(random, 4, 10);
  return Spring(sides, WholeIn(random, 8, 24), random);
}
Mesh FineSpring(Random& random) {
  const int sides = WholeIn(random, 12, 20);
  return Spring(sides, WholeIn(random, 32, 80), random);
}

// A straight lead-in, then turns.
Mesh Wire(Random& random) {
  const double tube = Uniform(random, 0.1, 0.3);
  const Helix helix{1, 2 * tube * Uniform(random, 0.3, 0.95), Uniform(random, 1.5, 3)};
  const int per_turn = WholeIn(random, 10, 64), steps = static_cast<int>(helix.turns * per_turn);
  const double step = 2 * pi / per_turn;
  std::vector<Point> points;
  for (int i = WholeIn(random, 3, per_turn / 2); i > 0; --i) points.push_back({1, -step * i, 0});
  for (const Point& p : PointsOf(helix, steps)) points.push_back(p);
  return TurnedOrNot(RoundTube(points, tube, WholeIn(random, 5, 16)), random);
}

// A trapezoid or triangle in the half-plane of the axis, its base on the inner side and wider than the pitch.
Mesh Thread(int steps_per_turn, Random& random) {
  const double base = Uniform(random, 0.3, 1), tip = Coin(random) ? 0 : Uniform(random, 0.1, 0.8) * base;
  const double inner = Uniform(random, 0.5, 2), outer = inner + Uniform(random, 0.3, 1);
  const double pitch = base * Uniform(random, 0.5, 0.97), turns = Uniform(random, 1.3, 4);
  Outline profile = {{inner, -0.5 * base}, {outer, -0.5 * tip}, {inner, 0.5 * base}};
  if (tip > 0) profile.insert(profile.begin() + 2, {outer, 0.5 * tip});
  std::vector<std::vector<Point>> rings;
  const int steps = static_cast<int>(turns * steps_per_turn);
  for (int i = 0; i <= steps; ++i) {
    const double turn = turns * i / steps, a = 2 * pi * turn;
    std::vector<Point> ring;
    for (const Flat& p : profile) ring.push_back({p[0] * tool::cosine(a), p[0] * tool::sine(a), p[1] + pitch * turn});
    rings.push_back(ring);
  }
  return TurnedOrNot(Lofted(rings, false), random);
}

Mesh CoarseThread(Random& random) { return Thread(WholeIn(random, 6, 24), random); }
Mesh FineThread(Random& random) { return Subdivided(Thread(WholeIn(random, 20, 40), random)); }

}  // namespace

std::vector<FieldFamily> SweepFamilies() {
  return {
      {"spring-coarse", CoarseSpring, 400, 90},
      {"spring-fine", FineSpring, 100, 120},
      {"wire", Wire, 250, 90},
      {"thread-coarse", CoarseThread, 400, 90, true},
      {"thread-fine", FineThread, 100, 120, true},
  };
}

}  // namespace support
