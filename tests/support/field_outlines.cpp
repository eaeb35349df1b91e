// SPDX-License-Identifier: MIT
// Field meshes extruded from outlines that cross themselves, and profiles swept along polygons that they fold over at.
#include <algorithm>
#include <cmath>

#include "support/field_meshes.h"
#include "support/field_shapes.h"
#include "support/tangle_shapes.h"
#include "tool/scenes/elementary.h"

namespace support {

namespace {

// A fan about a corner of many points on lines would have flat triangles.
Mesh RandomlyExtruded(const Outline& outline, int most_layers, Random& random) {
  const double height = Uniform(random, 0.2, 1);
  const int layers = WholeIn(random, 1, most_layers);
  return Extruded(outline, height, layers, outline.size() > 11 || Coin(random) ? Cap::middle : Cap::corner);
}

Mesh Placed(const Mesh& m, Random& random) {
  switch (WholeIn(random, 0, 2)) {
    case 0: return m;
    case 1: return QuarterTurned(m, WholeIn(random, 0, 23));
    default: return RandomlyTurned(m, random);
  }
}

// A star drawn in one line, each point joined to the `step`th next.
Outline Star(Random& random) {
  static constexpr int kinds[][2] = {{5, 2}, {7, 2}, {7, 3}, {8, 3}, {9, 2}, {9, 4}, {11, 3}};
  const auto& [points, step] = kinds[WholeIn(random, 0, 6)];
  const double turn = Coin(random) ? 0 : Uniform(random, 0, 2 * pi);
  Outline p;
  for (int i = 0; i < points; ++i) {
    const double a = 2 * pi * ((i * step) % points) / points + turn;
    p.push_back({tool::cosine(a), tool::sine(a)});
  }
  return p;
}

Mesh CoarseStar(Random& random) {
  const Outline star = Star(random);
  return Placed(RandomlyExtruded(star, 2, random), random);
}

Mesh FineStar(Random& random) {
  const Outline star = Refined(Star(random), WholeIn(random, 3, 24));
  return Placed(RandomlyExtruded(star, 6, random), random);
}

double Area(const Outline& p) {
  double sum = 0;
  for (size_t i = 0; i < p.size(); ++i)
    sum += 0.5 * (p[i][0] * p[(i + 1) % p.size()][1] - p[i][1] * p[(i + 1) % p.size()][0]);
  return sum;
}

Outline CounterClockwise(Outline p) {
  if (Area(p) < 0) std::reverse(p.begin(), p.end());
  return p;
}

Outline RandomOutline(Random& random) {
  for (;;) {
    Outline p;
    for (int n = WholeIn(random, 4, 9); n > 0; --n) p.push_back({Uniform(random, 0, 1), Uniform(random, 0, 1)});
    if (std::fabs(Area(p)) > 0.05) return CounterClockwise(p);
  }
}

Mesh CoarseOutline(Random& random) {
  const Outline p = RandomOutline(random);
  return Placed(RandomlyExtruded(p, 2, random), random);
}

Mesh FineOutline(Random& random) {
  const Outline p = Refined(RandomOutline(random), WholeIn(random, 3, 16));
  return Placed(RandomlyExtruded(p, 5, random), random);
}

// A smooth closed curve with loops: a circle on a circle.
Mesh CurvedOutline(Random& random) {
  const int waves = WholeIn(random, 2, 6), points = WholeIn(random, 16, 120);
  const double height = Uniform(random, 0.3, 1.2), phase = Uniform(random, 0, 2 * pi);
  Outline p;
  for (int i = 0; i < points; ++i) {
    const double a = 2 * pi * i / points, b = waves * a + phase;
    p.push_back({tool::cosine(a) + height * tool::cosine(b), tool::sine(a) + height * tool::sine(b)});
  }
  return Placed(RandomlyExtruded(CounterClockwise(p), 4, random), random);
}

// ---------------------------------------------------------------- mitred frames

// The corners of a closed way: a rectangle, or a convex polygon.
Outline Way(Random& random) {
  const double long_side = Uniform(random, 1, 4), short_side = Uniform(random, 0.5, 2);
  if (Coin(random)) return {{0, 0}, {long_side, 0}, {long_side, short_side}, {0, short_side}};
  Outline p;
  const int corners = WholeIn(random, 3, 7);
  for (int i = 0; i < corners; ++i) {
    const double a = 2 * pi * (i + Uniform(random, -0.25, 0.25)) / corners;
    p.push_back({long_side * tool::cosine(a), (0.5 * long_side + 0.5 * short_side) * tool::sine(a)});
  }
  return p;
}

// Points (outwards, upwards) round the way, mostly on its inner side, so that they pass each other at short sides.
Outline Profile(Random& random) {
  Outline p;
  const int corners = WholeIn(random, 4, 9);
  const double inwards = Uniform(random, 0.2, 1.2), upwards = Uniform(random, 0.2, 0.6);
  for (int i = 0; i < corners; ++i) {
    const double a = 2 * pi * i / corners, r = Coin(random) ? 1 : Uniform(random, 0.5, 1);
    p.push_back({inwards * (r * tool::cosine(a) - 0.6), upwards * r * tool::sine(a)});
  }
  return p;
}

// `outwards` along the bisector of the corner of both edges.
Point Mitre(const Outline& way, size_t corner, double outwards, double upwards) {
  const size_t n = way.size();
  const Flat &a = way[(corner + n - 1) % n], &b = way[corner], &c = way[(corner + 1) % n];
  const Point u = Unit({b[1] - a[1], a[0] - b[0], 0}), v = Unit({c[1] - b[1], b[0] - c[0], 0});
  const Point by = Scaled(outwards / (1 + Dot(u, v)), Sum(u, v));
  return {b[0] + by[0], b[1] + by[1], upwards};
}

Mesh Frame(int parts, int profile_parts, Random& random) {
  const Outline way = Way(random), profile = Refined(Profile(random), profile_parts);
  std::vector<std::vector<Point>> rings;
  for (size_t i = 0; i < way.size(); ++i)
    for (int k = 0; k < parts; ++k) {
      std::vector<Point> ring;
      const double t = static_cast<double>(k) / parts;
      for (const Flat& p : profile) {
        const Point a = Mitre(way, i, p[0], p[1]), b = Mitre(way, (i + 1) % way.size(), p[0], p[1]);
        ring.push_back(Sum(Scaled(1 - t, a), Scaled(t, b)));
      }
      rings.push_back(ring);
    }
  return Placed(Lofted(rings, true), random);
}

Mesh CoarseFrame(Random& random) { return Frame(1, 1, random); }
Mesh FineFrame(Random& random) {
  const int parts = WholeIn(random, 2, 10);
  return Frame(parts, WholeIn(random, 1, 3), random);
}

}  // namespace

std::vector<FieldFamily> OutlineFamilies() {
  return {
      {"star-coarse", CoarseStar, 200, 72, true},       {"star-fine", FineStar, 200, 72, true},
      {"outline-coarse", CoarseOutline, 500, 90, true}, {"outline-fine", FineOutline, 300, 90, true},
      {"outline-curved", CurvedOutline, 300, 90, true}, {"frame-coarse", CoarseFrame, 400, 72, true},
      {"frame-fine", FineFrame, 300, 72, true},
  };
}

}  // namespace support
