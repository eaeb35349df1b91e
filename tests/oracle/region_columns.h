// SPDX-License-Identifier: MIT
// region_columns: how much of the region of winding number >= 1 of one mesh does another mesh lose or gain? An oracle
// on random columns, without code of the library. Along a column the lengths are exact but for rounding; both meshes
// share the columns, so that equal regions have no difference at all.
#pragma once

#include <array>
#include <vector>

#include "support/sample_meshes.h"

namespace support {

using TriangleCorners = std::array<Point, 3>;

struct RegionDifference {
  double truth = 0, result = 0;  // volumes of the regions; sampled, with errors of a few percent
  double lost = 0, gained = 0;   // of the truth, and beyond; sampled alike
  double error = 0;              // of lost + gained: at least one standard deviation of the sampling
  double cell = 0;               // the largest distance of two points in a cell of columns, across them
  double reach = 0;              // how far the farthest sampled point of both lies from the given triangles in contact
  bool is_plain = true;          // the result has winding numbers 0 and 1 only
  double Lost() const { return Share(lost); }
  double Gained() const { return Share(gained); }
  double VolumeError() const { return Share(result - truth); }

 private:
  // Of the true volume; all of it where there is none.
  double Share(double part) const { return truth > 0 ? part / truth : (part == 0 ? 0 : 1); }
};

// About so many columns along z, and as many in a random direction.
RegionDifference CompareRegions(const Mesh& given, const Mesh& result, int columns, uint64_t seed);
// The same over the triangles that only one of the meshes has, where alone regions can differ: far more precise for
// small changes. `truth` and `result` are volumes over these triangles, so their shares tell nothing.
// `reach` is 0 where nothing is in contact.
RegionDifference CompareChanges(const Mesh& given, const Mesh& result, int columns, uint64_t seed,
                                const std::vector<TriangleCorners>& contacts = {});

}  // namespace support
