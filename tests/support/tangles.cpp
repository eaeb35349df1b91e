// SPDX-License-Identifier: MIT
#include "support/tangles.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "support/tangle_shapes.h"
#include "tool/scenes/elementary.h"

namespace support {

namespace {

using Genera = std::vector<int64_t>;

Mesh Moved(Mesh m, double far, Random& random) {
  return Translated(std::move(m), Scaled(far, RandomDirection(random)));
}
Mesh MovedAbout(Mesh m, double far, Random& random) {
  m = RandomlyTurned(std::move(m), random);
  return Moved(std::move(m), far, random);
}

Mesh TurnedAboutX(Mesh m, double angle) {
  const double c = tool::cosine(angle), s = tool::sine(angle);
  for (size_t v = 0; v < VertexCount(m); ++v) {
    const Point p = PositionOf(m, v);
    m.positions[3 * v + 1] = c * p[1] - s * p[2];
    m.positions[3 * v + 2] = s * p[1] + c * p[2];
  }
  return m;
}

// A closed mesh about the origin, about one in radius, and its genus.
struct Solid {
  Mesh mesh;
  int64_t genus;
};

Solid RandomSolid(Random& random) {
  switch (WholeIn(random, 0, 4)) {
    case 0: return {Sphere({}, 1, WholeIn(random, 6, 12)), 0};
    case 1: return {Torus({}, 0.8, 0.35, 36, 16), 1};
    case 2: return {Bumpy(0.4, WholeIn(random, 8, 12), random), 0};
    case 3: return {Box({-0.7, -0.7, -0.7}, {0.7, 0.7, 0.7}, WholeIn(random, 5, 9)), 0};
    default: return {Stick(0.4, 2, 12), 0};
  }
}

// ---------------------------------------------------------------- bodies in bodies

// Two balls, neither within the other, that reach into each other by a few triangles at least.
Tangle SpherePair(Random& random) {
  const double r = Uniform(random, 0.5, 1), reach = Uniform(random, 0.3, 1.2) * r;
  const Mesh a = RandomlyTurned(Sphere({}, 1, WholeIn(random, 6, 14)), random);
  const Mesh b = RandomlyTurned(Sphere({}, r, WholeIn(random, 6, 14)), random);
  return {Together({a, Moved(b, 1 + r - reach, random)}), Genera{0}};
}

Tangle SphereCluster(Random& random) {
  std::vector<Mesh> parts;
  for (int n = WholeIn(random, 3, 5); n > 0; --n) {
    const double far = Uniform(random, 0.6, 1.2);
    const int fineness = WholeIn(random, 14, 18);
    const double r = Uniform(random, 0.6, 1);
    parts.push_back(MovedAbout(Sphere({}, r, fineness), far, random));
  }
  return {Together(parts), {}};
}

// Balls round a common axis, like the segments of an orange: each meets each, and all their rings meet at two
// poles.
Tangle BallRing(Random& random) {
  const int n = WholeIn(random, 3, 5), fineness = WholeIn(random, 5, 20);
  std::vector<Mesh> parts;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * pi * i / n;
    parts.push_back(
        Translated(RandomlyTurned(Sphere({}, 1, fineness), random), {0.75 * tool::cosine(a), 0.75 * tool::sine(a), 0}));
  }
  return {Together(parts), Genera{0}};
}

Tangle CoarseSphereCluster(Random& random) {
  std::vector<Mesh> parts;
  for (int n = WholeIn(random, 4, 12); n > 0; --n) {
    const double far = Uniform(random, 0, 1.8);
    const int fineness = WholeIn(random, 5, 10);
    const double r = Uniform(random, 0.5, 1);
    parts.push_back(MovedAbout(Sphere({}, r, fineness), far, random));
  }
  return {Together(parts), {}};
}

Tangle TorusPair(Random& random) {
  std::vector<Mesh> parts;
  for (int i = 0; i < 2; ++i) {
    const double far = Uniform(random, 0.2, 1), r = Uniform(random, 0.2, 0.35);
    parts.push_back(MovedAbout(Torus({}, 1, r, 80, 24), far, random));
  }
  return {Together(parts), {}};
}

Tangle CoarseTorusCluster(Random& random) {
  std::vector<Mesh> parts;
  for (int n = WholeIn(random, 2, 5); n > 0; --n) {
    const double far = Uniform(random, 0, 1), r = Uniform(random, 0.25, 0.4);
    parts.push_back(MovedAbout(Torus({}, 1, r, 40, 14), far, random));
  }
  return {Together(parts), {}};
}

Tangle FiveCopies(Random& random) {
  const Solid body = RandomSolid(random);
  std::vector<Mesh> parts;
  for (int i = 0; i < 5; ++i) parts.push_back(RandomlyTurned(body.mesh, random));
  return {Together(parts), {}};
}

Tangle FiveCows(Random& random) {
  const Mesh cow = SharedMesh("cow.off");
  std::vector<Mesh> parts;
  for (int i = 0; i < 5 && !cow.triangles.empty(); ++i) parts.push_back(RandomlyTurned(cow, random));
  return {Together(parts), {}};
}

Tangle CowPair(Random& random) {
  const Mesh cow = SharedMesh("cow.off");
  if (cow.triangles.empty()) return {};
  return {Together({cow, MovedAbout(cow, Uniform(random, 0, 0.5), random)}), {}};
}

Tangle IdenticalCopies(Random& random) {
  const Solid body = RandomSolid(random);
  const Mesh mesh = RandomlyTurned(body.mesh, random);
  return {Renumbered(Together(std::vector<Mesh>(static_cast<size_t>(WholeIn(random, 2, 3)), mesh)), random),
          Genera{body.genus}};
}

// The same surface, cut into other triangles: in contact everywhere, but not copies.
Tangle NearCopies(Random& random) {
  const int parts = WholeIn(random, 7, 12);
  const Mesh mesh = Sphere({}, 1, parts);
  return {Together({RandomlyTurned(mesh, random), RandomlyTurned(mesh, random)}), Genera{0}};
}

// Balls in each other without contact; `w` is the winding number within. Surfaces between winding number 0 and 1,
// either way round, stay.
Tangle Nested(Random& random) {
  std::vector<Mesh> parts = {RandomlyTurned(Sphere({}, 1, 12), random)};
  Genera genera{0};
  int w = 1;
  double r = 1;
  for (int n = WholeIn(random, 1, 3); n > 0; --n) {
    r *= 0.6;
    const bool reversed = Coin(random);
    const Mesh ball = MovedAbout(Sphere({}, r, 9), 0.2 * r, random);
    parts.push_back(reversed ? Reversed(ball) : ball);
    const int inner = w + (reversed ? -1 : 1);
    if ((w >= 1) != (inner >= 1)) genera.push_back(0);
    w = inner;
  }
  return {Together(parts), genera};
}

// Two overlapping balls; the second contains a ball of either orientation.
Tangle NestedInPair(Random& random) {
  const Mesh a = RandomlyTurned(Sphere({}, 1, 12), random), b = Moved(Sphere({}, 0.8, 10), 1.2, random);
  const Mesh ball = MovedAbout(Sphere({}, 0.25, 6), 0.05, random);
  const bool reversed = Coin(random);
  return {Together({a, b, reversed ? Reversed(ball) : ball}), reversed ? Genera{0, 0} : Genera{0}};
}

// Two blocks on one lattice with a face, a part of a face, an edge or a corner in common.
Tangle Touching(Random& random) {
  const int n = WholeIn(random, 4, 7), kind = WholeIn(random, 0, 3);
  const double half = 0.5 * WholeIn(random, 0, 1);  // vertices meet vertices, or the middles of edges
  const Mesh a = Block({0, 0, 0}, {1.0 * n, 1.0 * n, 1.0 * n}, {n, n, n});
  Point by{1.0 * n, 0, 0};
  if (kind == 1) by = {1.0 * n, std::floor(n / 2.0) + half, half};
  if (kind == 2) by = {1.0 * n, 1.0 * n, half};
  if (kind == 3) by = {1.0 * n, 1.0 * n, 1.0 * n};
  const int rotation = WholeIn(random, 0, 23);
  const Mesh m = Renumbered(QuarterTurned(Together({a, Translated(a, by)}), rotation), random);
  // Blocks with an edge or a corner in common may end joined or just apart.
  return {m, kind < 2 ? std::optional(Genera{0}) : std::nullopt};
}

// ---------------------------------------------------------------- thin parts

Tangle TubeThroughTube(Random& random) {
  const double r = Uniform(random, 0.25, 0.4);
  const int sides = WholeIn(random, 10, 16);
  const Mesh a = Stick(0.4, 4, 14), b = Stick(r, 4, sides);
  const Mesh turned = TurnedAboutX(b, Uniform(random, 0.7, pi - 0.7));
  // Not so far to the side that the bodies only touch.
  const Point by{Uniform(random, -0.3, 0.3), Uniform(random, -0.2, 0.2), Uniform(random, -1, 1)};
  return {RandomlyTurned(Together({a, Translated(turned, by)}), random), Genera{0}};
}

Tangle TubesThroughTubes(Random& random) {
  std::vector<Mesh> parts;
  for (int n = 3; n > 0; --n) {
    const double far = Uniform(random, 0, 0.8), length = Uniform(random, 3, 4), r = Uniform(random, 0.25, 0.35);
    parts.push_back(MovedAbout(Stick(r, length, 24), far, random));
  }
  return {Together(parts), {}};
}

Tangle CoarseTubes(Random& random) {
  std::vector<Mesh> parts;
  for (int n = WholeIn(random, 3, 8); n > 0; --n) {
    const double far = Uniform(random, 0, 0.8), length = Uniform(random, 3, 4), r = Uniform(random, 0.2, 0.35);
    parts.push_back(MovedAbout(Stick(r, length, 12), far, random));
  }
  return {Together(parts), {}};
}

// Bars along x laid through bars along y: as many holes as the lattice has meshes.
Tangle Grille(Random& random) {
  const int m = WholeIn(random, 2, 3), n = WholeIn(random, 2, 3);
  std::vector<Mesh> parts;
  const auto bar = [&](int rotation, const Point& by) {
    parts.push_back(Translated(QuarterTurned(Stick(0.3, 2.2 * 3, 12), rotation), by));
  };
  int along_x = 0, along_y = 0;
  for (int r = 0; r < 24; ++r) {
    const Point p = QuarterTurned(Point{0, 0, 1}, r);
    if (p[0] == 1) along_x = r;
    if (p[1] == 1) along_y = r;
  }
  const auto a_bit = [&] { return Uniform(random, -0.1, 0.1); };
  for (int i = 0; i < m; ++i) bar(along_x, {a_bit(), 2 * (i - 0.5 * (m - 1)), a_bit()});
  for (int i = 0; i < n; ++i) bar(along_y, {2 * (i - 0.5 * (n - 1)), a_bit(), a_bit()});
  return {RandomlyTurned(Together(parts), random), Genera{(m - 1) * (n - 1)}};
}

// Thinner than the edges of its triangles.
Mesh ThinSlab(Random& random) { return Slab(4, 4, Uniform(random, 0.08, 0.3), 0.35); }

Tangle TubeThroughSlab(Random& random) {
  const Point by = RandomPoint(random, -0.5, 0.5);
  const Mesh tube = Translated(Stick(Uniform(random, 0.35, 0.7), 2.5, 14), by);
  const double angle = Uniform(random, -0.7, 0.7);
  const Mesh slab = TurnedAboutX(ThinSlab(random), angle);
  return {RandomlyTurned(Together({slab, tube}), random), Genera{0}};
}

// Two convex bodies with a convex overlap: no holes. Not nearly parallel, so that their surfaces meet along a line.
Tangle SlabThroughSlab(Random& random) {
  const Mesh a = Slab(4, 4, Uniform(random, 0.1, 0.3), 0.22), b = Slab(4, 4, Uniform(random, 0.1, 0.3), 0.22);
  const double angle = Uniform(random, 0.6, pi - 0.6);
  const Point by{Uniform(random, -1.5, 1.5), Uniform(random, -1, 1), 0};
  const Mesh across = TurnedAboutX(Translated(b, by), angle);
  return {RandomlyTurned(Together({a, across}), random), Genera{0}};
}

// Two slabs side by side, slid into each other.
Tangle SlabIntoSlab(Random& random) {
  const double thick = Uniform(random, 0.2, 0.4);
  const Mesh a = Slab(4, 3, thick, 0.3), b = Slab(4, 3.3, thick, 0.31);
  const Point by{Uniform(random, 2.5, 3.2), Uniform(random, -0.5, 0.5), Uniform(random, -0.4, 0.4) * thick};
  return {RandomlyTurned(Together({a, Translated(b, by)}), random), Genera{0}};
}

// A hollow ball, and a tube through both of its walls.
Tangle ShellAndTube(Random& random) {
  const double r = Uniform(random, 0.6, 0.9);
  const Mesh shell =
      Together({RandomlyTurned(Sphere({}, 1, 14), random), Reversed(RandomlyTurned(Sphere({}, r, 12), random))});
  return {Together({shell, MovedAbout(Stick(0.25, 2.6, 12), 0.1, random)}), Genera{0, 1}};
}

// ---------------------------------------------------------------- bodies through themselves

Tangle Knot(Random& random) {
  const int sides = WholeIn(random, 10, 14), around = WholeIn(random, 110, 150);
  const double radius = Uniform(random, 0.3, 0.38), height = Uniform(random, 0.15, 0.3);
  return {RandomlyTurned(Trefoil(height, radius, around, sides), random), Genera{4}};
}

Tangle NoisySphere(double share, Random& random) {
  return {RandomlyTurned(Noisy(Sphere({}, 1, WholeIn(random, 8, 14)), share, random), random), {}};
}
Tangle NoisySphere1(Random& random) { return NoisySphere(0.01, random); }
Tangle NoisySphere10(Random& random) { return NoisySphere(0.1, random); }

// A shaft is pushed into a ball and out of the other side.
Tangle DentThrough(Random& random) {
  const int parts = WholeIn(random, 14, 18);
  const double depth = Uniform(random, 2.3, 2.6), angle = Uniform(random, 0.5, 0.7);
  return {RandomlyTurned(Dented(angle, depth, parts), random), Genera{1}};
}

Tangle InvertedWaists(Random& random) {
  const int waists = WholeIn(random, 1, 3);
  const int sides = WholeIn(random, 16, 24);
  const Mesh pinched = Pinched(Uniform(random, 0.2, 0.6), waists, sides);
  return {RandomlyTurned(pinched, random), Genera(static_cast<size_t>(waists) + 1, 0)};
}

// ---------------------------------------------------------------- others

// Edges from 1 to 1000. Two horns tip by tip, in contact along their length; or the first tip in the wide end of the
// second; or crossed.
Tangle Graded(Random& random) {
  const Mesh a = Horn(0.4, 1000, WholeIn(random, 16, 22)), b = Horn(0.4, 1000, WholeIn(random, 16, 22));
  const double turn = Uniform(random, 0, 2 * pi);
  switch (WholeIn(random, 0, 2)) {
    case 0: return {Together({a, TurnedAboutX(b, Uniform(random, 0.35, 0.6))}), Genera{0}};
    case 1: return {Together({a, Translated(TurnedAboutX(b, turn), {0, 0, Uniform(random, 0.6, 0.9)})}), Genera{0}};
    default: {
      const Mesh crossed = Translated(TurnedAboutX(b, 0.5 * pi), {Uniform(random, -0.05, 0.05), 0.5, 0.6});
      return {Together({a, crossed}), Genera{0}};
    }
  }
}

Tangle Real(const char* file) { return {SharedMesh(file), {}}; }
Tangle Cow(Random&) { return Real("cow.off"); }
Tangle SelfIntersect(Random&) { return Real("self_intersectA.obj"); }
Tangle TwoSpheres(Random&) { return {SharedMesh("two_spheres.stl"), Genera{0}}; }

}  // namespace

const std::vector<Family>& TangleFamilies() {
  static const std::vector<Family> families = {
      {"sphere-pair", SpherePair, 72, 0.05, 100},
      {"sphere-cluster", SphereCluster, 180, 0.05, 80},
      {"ball-ring", BallRing, 72, 0.05, 60},
      {"coarse-spheres", CoarseSphereCluster, 72, 0.3, 60, true},
      {"torus-pair", TorusPair, 120, 0.05, 60},
      {"coarse-tori", CoarseTorusCluster, 72, 0.3, 60, true},
      {"five-copies", FiveCopies, 96, 0.05, 60},
      {"five-cows", FiveCows, 160, 0.3, 10, true},
      {"cow-pair", CowPair, 160, 0.1, 20, true},
      {"identical-copies", IdenticalCopies, 72, 0.05, 50},
      {"near-copies", NearCopies, 72, 0.1, 50},
      {"nested", Nested, 72, 0.05, 50},
      {"nested-in-pair", NestedInPair, 72, 0.05, 50},
      {"touching", Touching, 72, 0.2, 60},
      {"tube-through-tube", TubeThroughTube, 120, 0.05, 60},
      {"tubes-through-tubes", TubesThroughTubes, 144, 0.05, 60},
      {"coarse-tubes", CoarseTubes, 72, 0.3, 60, true},
      {"grille", Grille, 120, 0.05, 30},
      {"tube-through-slab", TubeThroughSlab, 144, 0.15, 60},
      {"slab-through-slab", SlabThroughSlab, 144, 0.2, 60},
      {"slab-into-slab", SlabIntoSlab, 144, 0.1, 60},
      {"shell-and-tube", ShellAndTube, 108, 0.1, 60},
      {"knot", Knot, 144, 0.05, 40},
      {"noisy-sphere-1", NoisySphere1, 96, 0.05, 60, true},
      {"noisy-sphere-10", NoisySphere10, 96, 0.1, 60, true},
      {"dent-through", DentThrough, 108, 0.1, 40},
      {"inverted-waists", InvertedWaists, 108, 0.2, 40},
      {"graded", Graded, 120, 0.1, 40},
      {"cow", Cow, 240, 0.01, 1},
      {"self-intersect", SelfIntersect, 240, 0.01, 1},
      {"two-spheres", TwoSpheres, 120, 0.01, 1},
  };
  return families;
}

const Family& TangleFamily(const std::string& name) {
  for (const Family& f : TangleFamilies())
    if (f.name == name) return f;
  throw std::invalid_argument("no family of tangles is called " + name);
}

Tangle MakeTangle(const Family& family, uint64_t seed) {
  Random random(seed);
  return family.make(random);
}

}  // namespace support
