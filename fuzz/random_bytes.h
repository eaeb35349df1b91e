// SPDX-License-Identifier: MIT
// random_bytes: pseudo-random inputs of fuzzing targets.
#pragma once

#include <cstdint>
#include <vector>

namespace fuzz {

// SplitMix64 (Steele, Lea & Flood 2014).
inline uint64_t NextNumber(uint64_t& state) {
  uint64_t z = state += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

// At most 4095.
inline std::vector<uint8_t> RandomBytes(uint64_t seed) {
  std::vector<uint8_t> bytes(NextNumber(seed) % 4096);
  for (uint8_t& b : bytes) b = static_cast<uint8_t>(NextNumber(seed));
  return bytes;
}

}  // namespace fuzz
