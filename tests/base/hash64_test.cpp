// SPDX-License-Identifier: MIT
// The hash of words against XXH64 of their bytes, which is held against published values.
#include "base/hash64.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "oracle/xxh64.h"

namespace hash64_test {
namespace {

uint64_t OfText(const std::string& text) {
  return support::Xxh64(reinterpret_cast<const uint8_t*>(text.data()), text.size());
}

TEST(Hash64, TheOracleHasThePublishedValues) {
  EXPECT_EQ(OfText(""), 0xEF46DB3751D8E999u);
  EXPECT_EQ(OfText("a"), 0xD24EC4F1A98C6E5Bu);
  EXPECT_EQ(OfText("abc"), 0x44BC2CF5AD770999u);
  EXPECT_EQ(OfText("Nobody inspects the spammish repetition"), 0xFBCEA83C8A378BF1u);
}

TEST(Hash64, IsXxh64OfTheLittleEndianBytes) {
  std::mt19937 engine(1);
  std::vector<uint8_t> bytes;
  tpa::Hash64 hash;
  for (uint32_t words = 0; words <= 100; ++words) {
    EXPECT_EQ(hash.value(), support::Xxh64(bytes.data(), bytes.size())) << words << " words";
    const uint32_t word = static_cast<uint32_t>(engine());
    hash.add(word);
    for (uint32_t i = 0; i < 4; ++i) bytes.push_back(static_cast<uint8_t>(word >> 8 * i));
  }
}

}  // namespace
}  // namespace hash64_test
