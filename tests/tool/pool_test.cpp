// SPDX-License-Identifier: MIT
// The example's scheduler, held to the contract of tpa_exec.
#include "pool.h"

#include <atomic>
#include <memory>
#include <vector>

#include "gtest/gtest.h"

namespace pool_test {
namespace {

struct Calls {
  std::vector<std::atomic<uint32_t>> of;
  explicit Calls(uint32_t count) : of(count) {}
  static void Note(void* calls, uint32_t index) { ++static_cast<Calls*>(calls)->of.at(index); }
};

TEST(Pool, CallsEachIndexOnceAndReturnsWhenAllHave) {
  for (const int workers : {1, 2, 3, 5}) {
    const std::unique_ptr<Pool, void (*)(Pool*)> pool(pool_start(workers), pool_stop);
    ASSERT_NE(pool, nullptr);
    const tpa_exec exec = pool_exec(pool.get());
    for (int round = 0; round < 200; ++round)
      for (const uint32_t count : {0u, 1u, 2u, 3u, 7u, 64u, 1001u}) {
        Calls calls(count);
        exec.parallel_for(exec.user, count, Calls::Note, &calls);
        for (uint32_t i = 0; i < count; ++i) ASSERT_EQ(calls.of[i], 1u) << i << " of " << count << ", " << workers;
      }
  }
}

TEST(Pool, NeedsAWorker) { EXPECT_EQ(pool_start(0), nullptr); }

}  // namespace
}  // namespace pool_test
