// SPDX-License-Identifier: MIT
// hash64: XXH64 with seed 0 (Collet 2012), the hash of saved states. The input comes in words of 32 bits, and counts as
// the little-endian bytes of these words, on every processor.
#pragma once

#include "base/base.h"

namespace tpa {

struct Hash64 {
  static constexpr u32 stripe = 8;  // words
  static constexpr u64 prime[5] = {0x9E3779B185EBCA87u, 0xC2B2AE3D27D4EB4Fu, 0x165667B19E3779F9u, 0x85EBCA77C2B2AE63u,
                                   0x27D4EB2F165667C5u};
  u64 lane[4] = {prime[0] + prime[1], prime[1], 0, 0 - prime[0]};
  u32 pending[stripe] = {};
  u64 words = 0;

  void add(u32 word) {
    pending[words++ % stripe] = word;
    if (words % stripe == 0)
      for (u32 i = 0; i < 4; ++i) lane[i] = round(lane[i], pair(i));
  }
  u64 value() const {
    u64 h = words >= stripe ? joined() : prime[4];
    h += 4 * words;
    const u32 rest = static_cast<u32>(words % stripe);
    for (u32 i = 0; i < rest / 2; ++i) h = rotated(h ^ round(0, pair(i)), 27) * prime[0] + prime[3];
    if (rest % 2 == 1) h = rotated(h ^ pending[rest - 1] * prime[0], 23) * prime[1] + prime[2];
    h = (h ^ h >> 33) * prime[1];
    h = (h ^ h >> 29) * prime[2];
    return h ^ h >> 32;
  }

 private:
  static constexpr u64 rotated(u64 x, u32 by) { return x << by | x >> (64 - by); }
  static constexpr u64 round(u64 sum, u64 input) { return rotated(sum + input * prime[1], 31) * prime[0]; }
  u64 pair(u32 i) const { return u64{pending[2 * i + 1]} << 32 | pending[2 * i]; }
  u64 joined() const {
    u64 h = rotated(lane[0], 1) + rotated(lane[1], 7) + rotated(lane[2], 12) + rotated(lane[3], 18);
    for (u64 l : lane) h = (h ^ round(0, l)) * prime[0] + prime[3];
    return h;
  }
};

}  // namespace tpa
