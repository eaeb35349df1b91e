// SPDX-License-Identifier: MIT
// phantom: synthetic volumes with a known surface and topology, for the balloon. The object is dark.
// Voxels strictly inside it are 0, strictly outside 255; a voxel centre exactly on the surface is 127.5, so
// that the isosurface at the threshold runs through it. Gaussian noise of sigma 20 is added everywhere; the
// bright part of `cyst` is first multiplied by 1 + 0.2 g, g normal (speckle). The same noise seed gives the
// same bits everywhere: the generator uses IEEE additions, multiplications, divisions and square roots only.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "tool/io/volume.h"
#include "tool/result.h"

namespace tool {

enum class PhantomShape {
  cube_cavity,   // the cube [15, 85]^3 minus the ball of radius 40 about its centre
  genus_3,       // two tori (ring 32, tube 9) about (50, 50, 50), in the xz and the yz plane
  torus_nested,  // a torus (ring 30, tube 13) in the xy plane minus four balls of radius 6 on its ring
  cyst           // an ellipsoid (75, 36, 65) minus a rod of radius 4 along y through its centre
};

struct Phantom {
  PhantomShape shape = PhantomShape::cube_cavity;
  Volume volume;
  double seed[3] = {0, 0, 0};  // centre and radius of a ball well inside the object
  double radius = 0;
  double threshold = 127.5;
  std::vector<int> genera;          // of each component of the surface, largest component first
  std::vector<double> seam;         // closed polylines (x, y, z): seams of two primitives without a formula
  std::vector<size_t> seam_starts;  // first point of each polyline, and the end
};

inline constexpr const char* phantom_names[] = {"cube-cavity", "genus-3", "torus-nested", "cyst"};
inline constexpr uint64_t default_noise_seed = 1;

// Fails for an unknown name; the message lists all phantoms.
Status make_phantom(std::string_view name, uint64_t noise_seed, Phantom& phantom);

// -1 inside the object, 0 exactly on its surface, 1 outside. Voxel coordinates.
int side_of_object(PhantomShape shape, double x, double y, double z);

// Distance from a point to the exact surface of the object (never negative), within 0.001 voxels. O(seam
// points).
double distance_to_surface(const Phantom& phantom, double x, double y, double z);

}  // namespace tool
