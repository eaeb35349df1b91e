// SPDX-License-Identifier: MIT
// Field meshes upon copies of themselves, with noise, and with each vertex moved along its normal; and the files of
// meshes from the field.
#include <cmath>

#include "support/field_meshes.h"
#include "support/field_shapes.h"
#include "support/tangle_shapes.h"
#include "tool/scenes/elementary.h"

namespace support {

namespace {

Mesh Body(Random& random) {
  switch (WholeIn(random, 0, 4)) {
    case 0: return Sphere({}, 1, WholeIn(random, 3, 12));
    case 1: return Box({-0.7, -0.7, -0.7}, {0.7, 0.7, 0.7}, WholeIn(random, 1, 6));
    case 2: {
      const int around = WholeIn(random, 8, 36);
      return Torus({}, 0.8, 0.35, around, WholeIn(random, 6, 16));
    }
    case 3: return Bumpy(0.4, WholeIn(random, 4, 12), random);
    default: return Stick(0.4, 2, WholeIn(random, 6, 14));
  }
}

Mesh IdenticalCopies(Random& random) {
  const Mesh body = RandomlyTurned(Body(random), random);
  return Renumbered(Together(std::vector<Mesh>(static_cast<size_t>(WholeIn(random, 2, 4)), body)), random);
}

double SmallShare(Random& random) { return tool::exponential(Uniform(random, -9, -1)); }

// By less than a triangle, down to a thousandth of one.
Mesh ShiftedCopies(Random& random) {
  const Mesh body = Coin(random) ? RandomlyTurned(Body(random), random) : Body(random);
  const double far = MeanEdgeOf(body) * SmallShare(random);
  std::vector<Mesh> parts = {body};
  for (int n = WholeIn(random, 1, 2); n > 0; --n) {
    const Point by =
        Coin(random) ? QuarterTurned(Point{far, 0, 0}, WholeIn(random, 0, 23)) : Scaled(far, RandomDirection(random));
    parts.push_back(Translated(body, by));
  }
  return Renumbered(Together(parts), random);
}

Mesh TurnedCopies(Random& random) {
  const Mesh body = RandomlyTurned(Body(random), random);
  const double angle = 0.3 * SmallShare(random), c = tool::cosine(angle), s = tool::sine(angle);
  const Mesh turned = Mapped(body, [&](const Point& p) {
    return Point{p[0], c * p[1] - s * p[2], s * p[1] + c * p[2]};
  });
  return Renumbered(Together({body, turned}), random);
}

// ---------------------------------------------------------------- noise

// Each coordinate by up to a half, one or two mean edges.
Mesh WithNoise(Mesh m, Random& random) {
  static constexpr double shares[] = {0.5, 1, 2};
  const double far = shares[WholeIn(random, 0, 2)] * MeanEdgeOf(m);
  for (double& x : m.positions) x += Uniform(random, -far, far);
  return m;
}

Mesh NoiseSphere66(Random& random) { return WithNoise(Sphere({}, 1, 4), random); }
Mesh NoiseSphere258(Random& random) { return WithNoise(Sphere({}, 1, 8), random); }
Mesh NoiseSphere402(Random& random) { return WithNoise(Sphere({}, 1, 10), random); }
Mesh NoiseSphere1602(Random& random) { return WithNoise(Sphere({}, 1, 20), random); }
Mesh NoiseTorus(Random& random) {
  const int around = WholeIn(random, 12, 32);
  return WithNoise(Torus({}, 1, 0.4, around, around / 2), random);
}
Mesh NoiseSlab(Random& random) {
  const double edge = Uniform(random, 0.15, 0.4);
  return WithNoise(Slab(2, 2, Uniform(random, 0.2, 1), edge), random);
}

// ---------------------------------------------------------------- offsets

// Along the normals by -2 to 5 percent of the diagonal.
Mesh Offset(const Mesh& m, Random& random) {
  if (m.triangles.empty()) return m;
  const double far = DiagonalOf(m) * Uniform(random, -0.02, 0.05);
  const std::vector<Point> normals = VertexNormals(m);
  Mesh out = m;
  for (size_t i = 0; i < m.positions.size(); ++i) out.positions[i] += far * normals[i / 3][i % 3];
  return out;
}

// A sphere with dents and horns, narrow enough to close.
Mesh Knobbly(Random& random) {
  Point along[6];
  double height[6];
  for (int i = 0; i < 6; ++i) {
    along[i] = RandomDirection(random);
    height[i] = Uniform(random, -0.8, 1.2);
  }
  return Mapped(Sphere({}, 1, WholeIn(random, 8, 24)), [&](const Point& p) {
    double r = 1;
    for (int i = 0; i < 6; ++i) r += height[i] * tool::exponential(30 * (Dot(along[i], p) - 1));
    return Scaled(r, p);
  });
}

// A sphere with waves, the steepest as high as wide.
Mesh Wavy(Random& random) {
  Point wave[3];
  for (Point& w : wave) {
    const double length = Uniform(random, 4, 9);
    w = Scaled(length, RandomDirection(random));
  }
  const double height = Uniform(random, 0.2, 0.8);
  return Mapped(Sphere({}, 1, WholeIn(random, 8, 24)), [&](const Point& p) {
    double r = 1;
    for (const Point& w : wave) r += height / 3 * tool::sine(Dot(w, p));
    return Scaled(r, p);
  });
}

Mesh OffsetWavy(Random& random) { return Offset(Wavy(random), random); }
Mesh OffsetKnobbly(Random& random) { return Offset(Knobbly(random), random); }

Mesh OffsetReal(Random& random) {
  static constexpr const char* files[] = {"cow.off", "two_spheres.stl", "../field/knight_push003.off",
                                          "self_intersectA.obj"};
  return Offset(SharedMesh(files[WholeIn(random, 0, 3)]), random);
}

Mesh FieldFile(Random& random) {
  static constexpr const char* files[] = {"boxes3",      "boxes_cross",    "boxes_edge", "boxes_face", "cubestair",
                                          "frame",       "knight_push003", "overlap2",   "offset1",    "pentagram24",
                                          "shift2",      "spring8",        "spring12",   "spring20",   "swept8",
                                          "swept8_sub3", "thread32",       "wire12"};
  const std::string name = files[WholeIn(random, 0, 17)];
  return SharedMesh("../field/" + name + (name == "offset1" ? ".obj" : ".off"));
}

}  // namespace

std::vector<FieldFamily> CopyFamilies() {
  return {
      {"copies-identical", IdenticalCopies, 250, 60},
      {"copies-shifted", ShiftedCopies, 300, 72},
      {"copies-turned", TurnedCopies, 300, 72},
      {"noise-sphere-66", NoiseSphere66, 300, 72},
      {"noise-sphere-258", NoiseSphere258, 200, 72},
      {"noise-sphere-402", NoiseSphere402, 100, 72},
      {"noise-sphere-1602", NoiseSphere1602, 24, 72},
      {"noise-torus", NoiseTorus, 150, 72},
      {"noise-slab", NoiseSlab, 150, 72},
      {"offset-wavy", OffsetWavy, 300, 72},
      {"offset-knobbly", OffsetKnobbly, 300, 90},
      {"offset-real", OffsetReal, 60, 120},
      {"field-files", FieldFile, 40, 180, true},
  };
}

}  // namespace support
