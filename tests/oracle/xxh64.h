// SPDX-License-Identifier: MIT
// xxh64: XXH64 with seed 0 (Collet 2012) over bytes, straight from its description.
#pragma once

#include <cstddef>
#include <cstdint>

namespace support {

inline uint64_t Xxh64(const uint8_t* data, size_t size) {
  constexpr uint64_t p1 = 11400714785074694791u, p2 = 14029467366897019727u, p3 = 1609587929392839161u,
                     p4 = 9650029242287828579u, p5 = 2870177450012600261u;
  const auto number = [](const uint8_t* p, size_t bytes) {
    uint64_t x = 0;
    for (size_t i = bytes; i > 0; --i) x = 256 * x + p[i - 1];
    return x;
  };
  const auto turn = [](uint64_t x, int by) { return (x << by) | (x >> (64 - by)); };
  const auto round = [&](uint64_t sum, uint64_t x) { return turn(sum + x * p2, 31) * p1; };
  const uint8_t* const end = data + size;
  uint64_t h = p5;
  if (size >= 32) {
    uint64_t v1 = p1 + p2, v2 = p2, v3 = 0, v4 = -p1;
    for (; end - data >= 32; data += 32) {
      v1 = round(v1, number(data, 8));
      v2 = round(v2, number(data + 8, 8));
      v3 = round(v3, number(data + 16, 8));
      v4 = round(v4, number(data + 24, 8));
    }
    h = turn(v1, 1) + turn(v2, 7) + turn(v3, 12) + turn(v4, 18);
    for (uint64_t v : {v1, v2, v3, v4}) h = (h ^ round(0, v)) * p1 + p4;
  }
  h += size;
  for (; end - data >= 8; data += 8) h = turn(h ^ round(0, number(data, 8)), 27) * p1 + p4;
  for (; end - data >= 4; data += 4) h = turn(h ^ number(data, 4) * p1, 23) * p2 + p3;
  for (; data < end; ++data) h = turn(h ^ *data * p5, 11) * p1;
  h = (h ^ (h >> 33)) * p2;
  h = (h ^ (h >> 29)) * p3;
  return h ^ (h >> 32);
}

}  // namespace support
