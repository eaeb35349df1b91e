// SPDX-License-Identifier: MIT
// bytes: numbers out of a fuzzer's bytes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fuzz {

// Runs dry to zeros, so that every input has a meaning.
struct Bytes {
  const uint8_t* data;
  size_t size;

  uint8_t Byte() {
    if (size == 0) return 0;
    --size;
    return *data++;
  }
  // 0 .. count-1, and 0 for count 0.
  uint32_t Below(uint32_t count) {
    uint32_t x = Byte();
    if (count > 256) x = x << 8 | Byte();
    if (count > 65536) x = x << 16 | static_cast<uint32_t>(Byte()) << 8 | Byte();
    return count == 0 ? 0 : x % count;
  }
  bool Once(uint32_t in) { return Below(in) == in - 1; }
  uint64_t Wide() {
    uint64_t x = 0;
    for (int i = 0; i < 8; ++i) x = x << 8 | Byte();
    return x;
  }
  // -reach .. reach in 256 parts, 0 for a byte of 128.
  double Around(double reach) { return reach * (static_cast<int>(Byte()) - 128) / 128.0; }
};

}  // namespace fuzz
