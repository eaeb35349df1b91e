// SPDX-License-Identifier: MIT
// phantom: the voxels of the synthetic volumes, their noise, and known facts about them. The distance to their surfaces
// is in phantom_distance.cpp.
#include "tool/segment/phantom.h"

#include <cmath>
#include <iterator>

#include "tool/segment/phantom_shapes.h"

namespace tool {

namespace {

// SplitMix64 (Steele, Lea, Flood 2014).
struct Random {
  uint64_t state;

  uint64_t bits() {
    state += 0x9E3779B97F4A7C15u;
    uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }

  // Uniform in [-1, 1), on a grid of 2^-52.
  double symmetric() { return static_cast<double>(bits() >> 11) * 0x1p-52 - 1; }
};

// Natural logarithm of a positive number, from the series of 2 artanh((m - 1) / (m + 1)) with m near 1. The C
// library's would differ in the last bit from machine to machine.
double logarithm(double x) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0.70710678118654752) {
    m *= 2;
    --exponent;
  }
  const double z = (m - 1) / (m + 1), squared = z * z;
  double series = 0;
  for (int k = 19; k >= 1; k -= 2) series = series * squared + 1.0 / k;
  return 2 * z * series + exponent * 0.69314718055994531;
}

// Standard normal numbers in pairs: Box and Muller's transform in Marsaglia's polar form, which needs no
// sine.
struct Normal {
  Random random;
  double spare = 0;
  bool has_spare = false;

  double next() {
    if (has_spare) {
      has_spare = false;
      return spare;
    }
    double u, v, s;
    do {
      u = random.symmetric();
      v = random.symmetric();
      s = u * u + v * v;
    } while (s >= 1 || s == 0);
    const double scale = std::sqrt(-2 * logarithm(s) / s);
    spare = v * scale;
    has_spare = true;
    return u * scale;
  }
};

constexpr double bright = 255, noise_sigma = 20, speckle_sigma = 0.2;

void fill(PhantomShape shape, uint64_t noise_seed, Volume& volume) {
  Normal normal{Random{noise_seed}};
  volume.values.resize(static_cast<size_t>(volume.nx) * static_cast<size_t>(volume.ny) *
                       static_cast<size_t>(volume.nz));
  float* value = volume.values.data();
  for (int z = 0; z < volume.nz; ++z) {
    for (int y = 0; y < volume.ny; ++y) {
      for (int x = 0; x < volume.nx; ++x) {
        const int side = side_of_object(shape, x, y, z);
        double level = 0.5 * bright * (side + 1);
        if (shape == PhantomShape::cyst && side > 0) level *= 1 + speckle_sigma * normal.next();
        *value++ = static_cast<float>(level + noise_sigma * normal.next());
      }
    }
  }
}

void set_ball(Phantom& phantom, double x, double y, double z, double radius) {
  phantom.seed[0] = x;
  phantom.seed[1] = y;
  phantom.seed[2] = z;
  phantom.radius = radius;
}

// Sizes, a ball well inside (its clearance is the distance of its centre to the surface), and the topology.
void describe(Phantom& phantom) {
  Volume& volume = phantom.volume;
  volume.nx = volume.ny = volume.nz = 100;
  switch (phantom.shape) {
    case PhantomShape::cube_cavity: {
      // On the diagonal, as far from three faces as from the ball: half - s = sqrt(3) s - cavity.
      // Clearance 7.5.
      const double s = (cube_half + cavity_radius) / (1 + std::sqrt(3.0));
      set_ball(phantom, cube_centre + s, cube_centre + s, cube_centre + s, 5);
      phantom.genera = {5};
      return;
    }
    case PhantomShape::genus_3:
      set_ball(phantom, tori_centre, tori_centre, tori_centre + tori_ring, 6);  // clearance 9
      phantom.genera = {3};
      return;
    case PhantomShape::torus_nested: {
      const double along = nested_ring * std::sqrt(0.5);
      set_ball(phantom, nested_centre + along, nested_centre + along, nested_centre, 8);  // clearance 13
      phantom.genera = {1, 0, 0, 0, 0};
      return;
    }
    case PhantomShape::cyst:
      volume.nx = 199;
      volume.ny = 99;
      volume.nz = 171;
      set_ball(phantom, cyst_centre[0] + 35, cyst_centre[1], cyst_centre[2], 12);  // clearance 30
      phantom.genera = {1};
      return;
  }
}

}  // namespace

int side_of_object(PhantomShape shape, double x, double y, double z) {
  const double level = level_of(shape, x, y, z);
  return level < 0 ? -1 : level > 0 ? 1 : 0;
}

Status make_phantom(std::string_view name, uint64_t noise_seed, Phantom& phantom) {
  for (size_t i = 0; i < std::size(phantom_names); ++i) {
    if (name != phantom_names[i]) continue;
    phantom = Phantom();
    phantom.shape = static_cast<PhantomShape>(i);
    describe(phantom);
    trace_seam(phantom);
    fill(phantom.shape, noise_seed, phantom.volume);
    return success();
  }
  return failure("phantom \"", name, "\" is unknown (known: cube-cavity genus-3 torus-nested cyst)");
}

}  // namespace tool
