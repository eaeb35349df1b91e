// SPDX-License-Identifier: MIT
// morton: places along a space-filling curve (Morton 1966): neighbours in the order are near in space.
#pragma once

#include "base/base.h"

namespace tpa {

inline constexpr u32 curve_bits = 11;  // along each axis

// Bit i of x goes to bit 3 i. Pre: x < 2^21.
constexpr u64 spread_bits(u64 x) {
  x = (x | x << 32) & 0x1F00000000FFFFu;
  x = (x | x << 16) & 0x1F0000FF0000FFu;
  x = (x | x << 8) & 0x100F00F00F00F00Fu;
  x = (x | x << 4) & 0x10C30C30C30C30C3u;
  return (x | x << 2) & 0x1249249249249249u;
}

// The place of a point within -1 .. 1 along each axis: less than 2^33.
inline u64 place_on_curve(const f32* point) {
  constexpr f32 cells = static_cast<f32>(1u << (curve_bits - 1)) * (1 - 0x1p-20f);
  const auto cell = [&](f32 x) { return spread_bits(static_cast<u64>(static_cast<i64>((x + 1) * cells))); };
  return cell(point[0]) | cell(point[1]) << 1 | cell(point[2]) << 2;
}

}  // namespace tpa
