// SPDX-License-Identifier: MIT
// Phantoms against their volumes, their noise, and distances by brute force.
#include "tool/segment/phantom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <random>

#include "support/point.h"

namespace tool {
namespace phantom_test {
namespace {

using support::pi;

Phantom phantom_named(const char* name, uint64_t seed) {
  Phantom phantom;
  const Status status = make_phantom(name, seed, phantom);
  EXPECT_TRUE(status.ok) << status.message;
  return phantom;
}

TEST(Phantoms, UnknownName) {
  Phantom phantom;
  EXPECT_EQ(make_phantom("cube", 1, phantom).message,
            "phantom \"cube\" is unknown (known: cube-cavity genus-3 torus-nested cyst)");
}

TEST(Phantoms, SameSeedSameBitsOtherSeedOthers) {
  const Phantom a = phantom_named("genus-3", 5), b = phantom_named("genus-3", 5), c = phantom_named("genus-3", 6);
  EXPECT_EQ(a.volume.values, b.volume.values);
  EXPECT_NE(a.volume.values, c.volume.values);
}

// Half of the voxels on the surface count.
double inside_voxels(const Phantom& phantom) {
  double count = 0;
  for (int z = 0; z < phantom.volume.nz; ++z) {
    for (int y = 0; y < phantom.volume.ny; ++y) {
      for (int x = 0; x < phantom.volume.nx; ++x) count += 0.5 * (1 - side_of_object(phantom.shape, x, y, z));
    }
  }
  return count;
}

// Monte Carlo, with the definition of the union written out, and a fixed seed; within about 0.2 %.
double volume_of_two_tori() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-41, 41);
  const int trials = 4000000;
  int hits = 0;
  for (int i = 0; i < trials; ++i) {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    hits += std::hypot(std::hypot(x, z) - 32, y) < 9 || std::hypot(std::hypot(y, z) - 32, x) < 9;
  }
  return std::pow(82, 3) * hits / trials;
}

// Voxels on planes of symmetry count a thin tube 1 % too small (the trapezoid rule's error at a round end).
TEST(Phantoms, VolumesAreThoseOfTheSolids) {
  const double cap = pi * 25 * (3 * 40 - 5) / 3;  // of the ball of radius 40, beyond a face at 35
  const double cube = std::pow(70, 3) - (4 * pi / 3 * std::pow(40, 3) - 6 * cap);
  EXPECT_NEAR(inside_voxels(phantom_named("cube-cavity", 1)) / cube, 1, 0.005);
  const double nested = 2 * pi * pi * 30 * 13 * 13 - 4 * (4 * pi / 3) * 6 * 6 * 6;
  EXPECT_NEAR(inside_voxels(phantom_named("torus-nested", 1)) / nested, 1, 0.02);
  const double rod = pi * 16 * 2 * 36;  // the ends are nearly flat
  EXPECT_NEAR(inside_voxels(phantom_named("cyst", 1)) / (4 * pi / 3 * 75 * 36 * 65 - rod), 1, 0.002);
  EXPECT_NEAR(inside_voxels(phantom_named("genus-3", 1)) / volume_of_two_tori(), 1, 0.02);
}

TEST(Phantoms, ValuesHaveTheStatedNoise) {
  for (const char* name : phantom_names) {
    const Phantom phantom = phantom_named(name, default_noise_seed);
    double sum[2] = {}, squares[2] = {}, count[2] = {};
    size_t i = 0;
    for (int z = 0; z < phantom.volume.nz; ++z) {
      for (int y = 0; y < phantom.volume.ny; ++y) {
        for (int x = 0; x < phantom.volume.nx; ++x, ++i) {
          const int side = side_of_object(phantom.shape, x, y, z);
          if (side == 0) continue;
          const double off = phantom.volume.values[i] - (side > 0 ? 255.0 : 0.0);
          sum[side > 0] += off;
          squares[side > 0] += off * off;
          count[side > 0] += 1;
        }
      }
    }
    const double bright_sigma = phantom.shape == PhantomShape::cyst ? std::hypot(20, 0.2 * 255) : 20;
    for (const int bright : {0, 1}) {
      EXPECT_NEAR(sum[bright] / count[bright], 0, 0.4) << name;
      EXPECT_NEAR(std::sqrt(squares[bright] / count[bright]), bright ? bright_sigma : 20, 0.3) << name;
    }
  }
}

TEST(Phantoms, SeedBallIsInside) {
  for (const char* name : phantom_names) {
    const Phantom phantom = phantom_named(name, 1);
    const double* s = phantom.seed;
    EXPECT_EQ(side_of_object(phantom.shape, s[0], s[1], s[2]), -1) << name;
    EXPECT_GT(distance_to_surface(phantom, s[0], s[1], s[2]), phantom.radius + 2) << name;
  }
}

// The phantoms again, as functions that vanish on the surface and change by no more than the way gone
// (Lipschitz 1).
double lipschitz_level(PhantomShape shape, double x, double y, double z) {
  const auto torus = [](double u, double v, double along, double ring, double tube) {
    return std::hypot(std::hypot(u, v) - ring, along) - tube;
  };
  switch (shape) {
    case PhantomShape::cube_cavity: {
      x -= 50, y -= 50, z -= 50;
      return std::max(std::max({std::fabs(x), std::fabs(y), std::fabs(z)}) - 35, 40 - std::hypot(x, y, z));
    }
    case PhantomShape::genus_3:
      x -= 50, y -= 50, z -= 50;
      return std::min(torus(x, z, y, 32, 9), torus(y, z, x, 32, 9));
    case PhantomShape::torus_nested: {
      x -= 50, y -= 50, z -= 50;
      double level = torus(x, y, z, 30, 13);
      for (const double a : {-30.0, 30.0}) {
        level = std::max({level, 6 - std::hypot(x - a, y, z), 6 - std::hypot(x, y - a, z)});
      }
      return level;
    }
    case PhantomShape::cyst:
      x -= 99, y -= 49, z -= 85;
      return std::max(36 * (std::hypot(x / 75, y / 36, z / 65) - 1), 4 - std::hypot(x, z));
  }
  return 0;
}

struct Cell {
  double bound, x, y, z, half;
  bool operator<(const Cell& other) const { return bound > other.bound; }
};

// Brute force: cubes are taken up in the order of their distance from the point and cut into eight while the
// surface may pass through them; the first to become small enough is where the surface is nearest.
double searched_distance(PhantomShape shape, double x, double y, double z) {
  std::priority_queue<Cell> cells;
  cells.push({0, 100, 100, 100, 256});
  while (!cells.empty()) {
    const Cell cell = cells.top();
    cells.pop();
    if (cell.half < 0.003) return std::hypot(cell.x - x, cell.y - y, cell.z - z);
    const double half = cell.half / 2;
    for (int part = 0; part < 8; ++part) {
      const double cx = cell.x + (part & 1 ? half : -half), cy = cell.y + (part & 2 ? half : -half);
      const double cz = cell.z + (part & 4 ? half : -half);
      if (std::fabs(lipschitz_level(shape, cx, cy, cz)) > 1.7320509 * half) continue;
      const double bound = std::hypot(std::max(std::fabs(cx - x) - half, 0.0), std::max(std::fabs(cy - y) - half, 0.0),
                                      std::max(std::fabs(cz - z) - half, 0.0));
      cells.push({bound, cx, cy, cz, half});
    }
  }
  return -1;
}

TEST(Phantoms, DistanceIsThatOfBruteForce) {
  for (const char* name : phantom_names) {
    const Phantom phantom = phantom_named(name, 1);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto check = [&](double x, double y, double z) {
      EXPECT_NEAR(distance_to_surface(phantom, x, y, z), searched_distance(phantom.shape, x, y, z), 0.02)
          << name << " at " << x << " " << y << " " << z;
    };
    for (int i = 0; i < 20; ++i) {
      check(phantom.volume.nx * unit(random), phantom.volume.ny * unit(random), phantom.volume.nz * unit(random));
    }
    // Near a seam: points within 2 of a common point of two primitives.
    for (int i = 0; i < 20; ++i) {
      const double a = 2 * pi * unit(random);
      double p[3] = {50 + 19.3649 * std::cos(a), 50 + 19.3649 * std::sin(a), 15};
      if (phantom.shape == PhantomShape::cyst) p[0] = 99 + 4 * std::cos(a), p[1] = 84.9, p[2] = 85 + 4 * std::sin(a);
      if (phantom.shape == PhantomShape::genus_3) {
        p[0] = p[1] = 9 * std::sin(a);
        p[2] = 50 + std::sqrt(std::pow(32 + 9 * std::cos(a), 2) - p[0] * p[0]);
        p[0] += 50, p[1] += 50;
      }
      check(p[0] + 4 * unit(random) - 2, p[1] + 4 * unit(random) - 2, p[2] + 4 * unit(random) - 2);
    }
  }
}

TEST(Phantoms, DistanceWhereNoNearestPointIsUnique) {
  const Phantom cube = phantom_named("cube-cavity", 1), tori = phantom_named("genus-3", 1);
  const Phantom nested = phantom_named("torus-nested", 1), cyst = phantom_named("cyst", 1);
  EXPECT_NEAR(distance_to_surface(cube, 50, 50, 50), 40, 0.001);
  EXPECT_NEAR(distance_to_surface(tori, 50, 50, 50), 32 - 9, 0.001);
  EXPECT_NEAR(distance_to_surface(tori, 50, 50, 82), 9, 0.001);
  EXPECT_NEAR(distance_to_surface(tori, 82, 50, 50), 9, 0.001);
  EXPECT_NEAR(distance_to_surface(tori, 50, 82, 50), 9, 0.001);
  EXPECT_NEAR(distance_to_surface(nested, 50, 50, 50), 30 - 13, 0.001);
  EXPECT_NEAR(distance_to_surface(nested, 80, 50, 50), 6, 0.001);
  EXPECT_NEAR(distance_to_surface(cyst, 99, 49, 85), 4, 0.001);
  EXPECT_NEAR(distance_to_surface(cyst, 99, 60, 85), 4, 0.001);
}

}  // namespace
}  // namespace phantom_test
}  // namespace tool
