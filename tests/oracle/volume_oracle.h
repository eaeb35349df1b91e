// SPDX-License-Identifier: MIT
// volume_oracle: what faces enclose, in integers of any size.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>

#include "oracle/big_int.h"
#include "oracle/coordinates.h"

namespace volume_oracle {

inline big_int::BigVec Scaled(const support::Coordinates& p) {
  return {big_int::scaled(p.x), big_int::scaled(p.y), big_int::scaled(p.z)};
}

// 2^480 times six volumes over the faces for which counts(f), seen from the origin. The mesh has corners of faces,
// three for each, and positions of vertices.
template <class Mesh, class Counts>
big_int::BigInt SixVolumes(const Mesh& m, Counts counts) {
  big_int::BigInt sum;
  const auto at = [&](uint32_t corner) { return Scaled(m.position[m.corner[corner]]); };
  for (uint32_t f = 0; f < m.face_count; ++f)
    if (counts(f)) sum = sum + big_int::det3(at(3 * f), at(3 * f + 1), at(3 * f + 2));
  return sum;
}

// Is |sum - exact| <= doubt? `exact`: 2^480 times what it should be.
inline testing::AssertionResult IsWithinDoubt(double sum, double doubt, const big_int::BigInt& exact) {
  const big_int::BigInt unit = big_int::scaled(1);
  big_int::BigInt off = big_int::scaled(sum) * unit * unit - exact;
  off.negative = false;
  if ((big_int::scaled(doubt) * unit * unit - off).sign() >= 0) return testing::AssertionSuccess();
  return testing::AssertionFailure() << sum << " is off by more than " << doubt;
}

}  // namespace volume_oracle
