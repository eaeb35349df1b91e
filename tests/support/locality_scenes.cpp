// SPDX-License-Identifier: MIT
// Scenes of the locality trial, and bodies beside them.
#include <algorithm>
#include <cmath>
#include <set>

#include "support/field_shapes.h"
#include "support/locality_trial.h"
#include "support/tangle_shapes.h"
#include "support/uneven_bodies.h"

namespace support {

namespace {

NearScene Moved(const Mesh& m, const std::function<Point(Point)>& map) { return {m, Mapped(m, map).positions}; }

double LogUniform(Random& random, double low, double high) {
  return low * std::exp(Uniform(random, 0, 1) * std::log(high / low));
}

// ---------------------------------------------------------------- scenes

// Two unit bodies that come to overlap by some depth.
NearScene Merging(const Mesh& first, const Mesh& second, Random& random) {
  const double slide = Coin(random) ? Uniform(random, 0, 0.7) : 0;
  const Mesh both = Together({Translated(first, {-1.05, 0, 0}), Translated(second, {1.05, slide, 0.03})});
  const double by = 0.05 + LogUniform(random, 0.01, 0.9) / 2;
  return Moved(both, [=](const Point& p) { return Point{p[0] < 0 ? p[0] + by : p[0] - by, p[1], p[2]}; });
}

NearScene EvenPair(Random& random) {
  const int parts = WholeIn(random, 2, 6);
  return Merging(Sphere({}, 1, parts), Sphere({}, 1, parts), random);
}

NearScene UnevenPair(Random& random) {
  const Mesh first = Coin(random) ? Sphere({}, 1, WholeIn(random, 1, 2)) : GradedSphere(8, 30);
  return Merging(RandomlyTurned(first, random), Sphere({}, 1, WholeIn(random, 6, 9)), random);
}

NearScene SliverPair(Random& random) {
  const auto body = [&] {
    return RandomlyTurned(Coin(random) ? Slivers(10, WholeIn(random, 6, 10)) : Globe(5, WholeIn(random, 16, 40)),
                          random);
  };
  const Mesh first = body();
  return Merging(first, body(), random);
}

NearScene ShakenBody(const Mesh& m, double edges, const std::function<bool(const Point&)>& takes, Random& random) {
  const double by = edges * MeanEdgeOf(m);
  return Moved(m, [&](const Point& p) { return takes(p) ? Sum(p, Scaled(by, RandomPoint(random, -1, 1))) : p; });
}

NearScene Crumple(Random& random) {
  return ShakenBody(
      Sphere({}, 1, WholeIn(random, 3, 7)), Uniform(random, 0.3, 1.3), [](const Point&) { return true; }, random);
}

NearScene CrumpledCap(Random& random) {
  const double above = Uniform(random, 0, 0.8);
  return ShakenBody(
      Sphere({}, 1, WholeIn(random, 4, 8)), Uniform(random, 0.4, 1.5), [=](const Point& p) { return p[2] > above; },
      random);
}

// A waist whose sides pass each other.
NearScene Pinch(Random& random) {
  std::vector<Point> points;
  std::vector<double> radii;
  const double thin = Uniform(random, 0.15, 0.4);
  for (int i = 0; i <= 20; ++i) {
    const double x = -2.5 + 0.25 * i;
    points.push_back({x, 0.01, 0.02});
    radii.push_back(thin + (1 - thin) * std::min(1.0, std::fabs(x) / 2));
  }
  const double far = Uniform(random, 0.3, 0.8), by = thin * Uniform(random, 1.05, 2);
  return Moved(Tube(points, radii, WholeIn(random, 5, 12), {0.1, 0.2, 1}), [=](const Point& p) {
    const double r = std::sqrt(p[1] * p[1] + p[2] * p[2]);
    return std::fabs(p[0]) >= far || r == 0 ? p : Point{p[0], p[1] * (1 - by / r), p[2] * (1 - by / r)};
  });
}

// A ball in the hollow of another one moves into the wall, or through it.
NearScene Nested(Random& random) {
  const Mesh hull = Together({Sphere({}, 1, WholeIn(random, 3, 6)), Reversed(Sphere({}, 0.6, WholeIn(random, 3, 5)))});
  const double radius = Uniform(random, 0.15, 0.3), by = Uniform(random, 0.62, 0.95) - radius;
  const Point d = RandomDirection(random);
  const uint32_t first = VertexCount(hull);
  NearScene s{Together({hull, Sphere({}, radius, WholeIn(random, 2, 4))}), {}};
  s.targets = s.mesh.positions;
  for (size_t i = 3 * size_t{first}; i < s.targets.size(); ++i) s.targets[i] += by * d[i % 3];
  return s;
}

// Boxes on a lattice: faces come to lie upon each other.
NearScene Boxes(Random& random) {
  const Point shift{1.25, 0.25 * WholeIn(random, -3, 3), 0.25 * WholeIn(random, -3, 3)};
  const Mesh m = Together({Box({0, 0, 0}, {1, 1, 1}, WholeIn(random, 1, 4)),
                           Translated(Box({0, 0, 0}, {1, 1, 1}, WholeIn(random, 1, 4)), shift)});
  const double by = 0.25 * WholeIn(random, 1, 4);
  return Moved(m, [=](const Point& p) { return Point{p[0] > 1.1 ? p[0] - by : p[0], p[1], p[2]}; });
}

NearScene OneVertex(Random& random) {
  const Mesh m =
      RandomlyTurned(Torus({}, 1, Uniform(random, 0.3, 0.5), WholeIn(random, 5, 12), WholeIn(random, 4, 8)), random);
  NearScene s{m, m.positions};
  const double way = Uniform(random, 0.4, 2) * MeanEdgeOf(m);
  const Point d = RandomDirection(random);
  const size_t v = random() % VertexCount(m);
  for (size_t i = 0; i < 3; ++i) s.targets[3 * v + i] += way * d[i];
  return s;
}

NearScene Tangled(const NearScene& s) { return {{s.targets, s.mesh.triangles}, s.targets, true}; }
NearScene TangledPair(Random& random) { return Tangled(Coin(random) ? EvenPair(random) : SliverPair(random)); }
NearScene TangledBall(Random& random) { return Tangled(Crumple(random)); }
NearScene TangledBoxes(Random& random) { return Tangled(Boxes(random)); }

// ---------------------------------------------------------------- bodies beside

const Point far{0, 0, 1000};

Beside Idle(const Mesh& m) { return {Translated(m, far), {}}; }

// Eighteen times the vertices of the scene.
Mesh FineBall(const NearScene& near, double radius) {
  const double parts = std::sqrt(18 * VertexCount(near.mesh) / 4.0);
  return Sphere({}, radius, static_cast<int>(std::ceil(parts)) + 1);
}

Beside Still(const NearScene&, Random&) {
  Beside b = Idle(Sphere({}, 1, 5));
  b.targets = b.mesh.positions;
  return b;
}

Beside Creeping(const NearScene&, Random& random) {
  Beside b = Idle(Sphere({}, 1, 5));
  b.targets = b.mesh.positions;
  for (double& x : b.targets) x += Uniform(random, -1e-9, 1e-9);
  return b;
}

// Beyond the box of the scene by half of its longest edge.
Beside CloseBy(const NearScene& near, Random& random) {
  Mesh moved{near.targets, near.mesh.triangles};
  double high = -1e300, longest = 0;
  for (const Mesh* m : {&near.mesh, static_cast<const Mesh*>(&moved)})
    for (size_t h = 0; h < m->triangles.size(); ++h) {
      const Point a = PositionOf(*m, m->triangles[h]), b = PositionOf(*m, m->triangles[h % 3 == 2 ? h - 2 : h + 1]);
      high = std::max(high, a[2]);
      longest = std::max(longest, Distance(a, b));
    }
  const double gap = longest / 2;
  return {Translated(Sphere({}, 0.5, WholeIn(random, 1, 4)), {0, 0, high + gap + 0.5}), {}, high + gap / 2};
}

Beside Active(const NearScene& near, const NearScene& other) {
  Beside b;
  b.is_active = true;
  b.mesh = Translated(near.adapts ? Mesh{other.targets, other.mesh.triangles} : other.mesh, far);
  if (!near.adapts) b.targets = Translated({other.targets, {}}, far).positions;
  return b;
}

}  // namespace

const std::vector<NearFamily>& NearFamilies() {
  static const std::vector<NearFamily> families = {{"even", EvenPair},          {"uneven", UnevenPair},
                                                   {"slivers", SliverPair},     {"crumple", Crumple},
                                                   {"cap", CrumpledCap},        {"pinch", Pinch},
                                                   {"nested", Nested},          {"boxes", Boxes},
                                                   {"one-vertex", OneVertex},   {"adapt-pair", TangledPair},
                                                   {"adapt-ball", TangledBall}, {"adapt-boxes", TangledBoxes}};
  return families;
}

const std::vector<BesideKind>& BesideKinds() {
  using N = const NearScene&;
  static const std::vector<BesideKind> kinds = {
      {"idle-tiny", [](N, Random&) { return Idle(Sphere({}, 1e-3, 2)); }},
      {"idle-huge", [](N, Random&) { return Idle(Sphere({}, 100, 4)); }},
      {"idle-fine", [](N near, Random&) { return Idle(FineBall(near, 0.1)); }},
      {"idle-coarse", [](N, Random&) { return Idle(Sphere({}, 3, 1)); }},
      {"idle-first",
       [](N near, Random&) {
         Beside b = Idle(FineBall(near, 1));
         b.comes_first = true;
         return b;
       }},
      {"close-by", CloseBy},
      {"still", Still},
      {"creeping", Creeping},
      {"own-places",
       [](N, Random&) {
         Beside b;
         b.all_targets = true;
         return b;
       }},
      {"crumples", [](N near, Random& random) { return Active(near, Crumple(random)); }},
      {"merges", [](N near, Random& random) { return Active(near, EvenPair(random)); }},
      {"slivers", [](N near, Random& random) { return Active(near, SliverPair(random)); }}};
  return kinds;
}

}  // namespace support
