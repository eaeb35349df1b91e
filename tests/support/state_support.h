// SPDX-License-Identifier: MIT
// state_support: the state of a context as bytes, for tests of saving, restoring and growing.
#pragma once

#include <cstdint>
#include <vector>

#include "oracle/xxh64.h"
#include "support/support.h"

namespace support {

using Bytes = std::vector<uint8_t>;

inline Bytes SavedFrom(const tpa_context* context) {
  size_t size = 0;
  EXPECT_EQ(tpa_save(context, nullptr, 0, &size, nullptr), TPA_OK);
  Bytes bytes(size);
  EXPECT_EQ(tpa_save(context, bytes.data(), size, &size, nullptr), TPA_OK);
  EXPECT_EQ(size, bytes.size());
  return bytes;
}

inline uint64_t DigestOf(const tpa_context* context) {
  uint64_t digest = 0;
  EXPECT_EQ(tpa_digest(context, &digest), TPA_OK);
  return digest;
}

inline uint64_t NumberAt(const Bytes& bytes, size_t offset, size_t size) {
  uint64_t x = 0;
  for (size_t i = size; i > 0; --i) x = x << 8 | bytes[offset + i - 1];
  return x;
}
inline void SetNumber(Bytes& bytes, size_t offset, size_t size, uint64_t x) {
  for (size_t i = 0; i < size; ++i) bytes[offset + i] = static_cast<uint8_t>(x >> 8 * i);
}
// Makes the hash right again.
inline void Seal(Bytes& bytes) {
  const size_t hashed = bytes.size() - 8;
  SetNumber(bytes, hashed, 8, Xxh64(bytes.data(), hashed));
}

struct Targets {
  std::vector<uint32_t> vertices;
  std::vector<double> positions;
  bool operator==(const Targets& other) const { return vertices == other.vertices && positions == other.positions; }
};

inline Targets TargetsOf(const tpa_context* context) {
  uint32_t count = 0;
  EXPECT_EQ(tpa_targets(context, nullptr, nullptr, 0, &count), TPA_OK);
  Targets out{std::vector<uint32_t>(count), std::vector<double>(3 * size_t{count})};
  EXPECT_EQ(tpa_targets(context, out.vertices.data(), out.positions.data(), count, &count), TPA_OK);
  return out;
}

}  // namespace support
