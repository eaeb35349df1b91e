// SPDX-License-Identifier: MIT
// object: the voxels that a segmentation is to fill: those on the object's side of the threshold, connected with a seed
// across faces (6-connected).
#pragma once

#include <cstdint>
#include <vector>

#include "tool/io/volume.h"

namespace tool {

// What the values of a volume are.
enum class Values {
  grey,
  in_band,  // how far a grey value lies within a band
  in_label  // 1 where the label is, else 0
};

// Noise comes as near to a threshold as this many of its standard deviations.
inline constexpr double deviations_near = 2;

// Where the object lies among the values.
struct Threshold {
  double value = 127.5;
  bool bright = false;  // the object is brighter, not darker
  Values of = Values::grey;

  // How far a grey value lies on the object's side; negative on the other side.
  double depth(double grey) const { return bright ? grey - value : value - grey; }
};

struct Index {
  int i = 0, j = 0, k = 0;
};

struct Object {
  std::vector<uint8_t> mask;  // 1 for each voxel of the object, else 0
  uint64_t voxels = 0;
};

// Everything in voxels: calls visit(neighbour) for the neighbours across faces of a voxel.
template <class Visit>
void for_each_face_neighbour(const Volume& volume, const Index& v, Visit visit) {
  if (v.i > 0) visit(Index{v.i - 1, v.j, v.k});
  if (v.i + 1 < volume.nx) visit(Index{v.i + 1, v.j, v.k});
  if (v.j > 0) visit(Index{v.i, v.j - 1, v.k});
  if (v.j + 1 < volume.ny) visit(Index{v.i, v.j + 1, v.k});
  if (v.k > 0) visit(Index{v.i, v.j, v.k - 1});
  if (v.k + 1 < volume.nz) visit(Index{v.i, v.j, v.k + 1});
}

// Fails, naming the seed, where a seed lies outside the volume, or on the wrong side of the threshold. Seeds in
// millimetres. O(voxels).
Status find_object(const Volume& volume, const Threshold& threshold, const std::vector<Point>& seeds, Object& object);

// The same from all voxels of `start` (nonzero) on the object's side of the threshold. Fails where there are none.
Status find_object(const Volume& volume, const Threshold& threshold, const std::vector<uint8_t>& start, Object& object);

// Visits a connected set of voxels from `start`, which is in the set: take(voxel) says whether a voxel is in the set
// and not yet visited, and takes it out. Returns the number of voxels. Memory for the front alone.
template <class Take>
uint64_t flood(const Volume& volume, const Index& start, Take take) {
  std::vector<Index> front, next;
  if (take(start)) front.push_back(start);
  uint64_t count = 0;
  for (; !front.empty(); front.swap(next)) {
    count += front.size();
    next.clear();
    for (const Index& here : front)
      for_each_face_neighbour(volume, here, [&](const Index& v) {
        if (take(v)) next.push_back(v);
      });
  }
  return count;
}

}  // namespace tool
