// SPDX-License-Identifier: MIT
// mixed_seed: seeds of independent random rows. The finaliser of MurmurHash3 (Appleby 2011) parts neighbouring numbers,
// whose rows would otherwise be shifted copies in some generators.
#pragma once

#include <cstdint>
#include <string>

namespace support {

inline uint64_t Finalised(uint64_t x) {
  x = (x ^ (x >> 33)) * 0xFF51AFD7ED558CCDu;
  x = (x ^ (x >> 33)) * 0xC4CEB9FE1A85EC53u;
  return x ^ (x >> 33);
}

// Of a seed within a family: FNV-1a of the name keeps families apart.
inline uint64_t MixedSeed(const std::string& family, uint64_t seed) {
  uint64_t name = 0xCBF29CE484222325u;
  for (const char c : family) name = (name ^ static_cast<unsigned char>(c)) * 0x100000001B3u;
  return Finalised(Finalised(seed + 0x9E3779B97F4A7C15u) ^ name);
}

}  // namespace support
