// SPDX-License-Identifier: MIT
// Sums of chunks: the same bits for every schedule, and those of a plain loop where one chunk takes all.
#include "base/parallel.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "support/schedules.h"

namespace parallel_test {
namespace {

double SumOf(const std::vector<double>& terms, const tpa::Exec& exec) {
  return tpa::sum_of_chunks(exec, static_cast<uint32_t>(terms.size()), [&](uint32_t first, uint32_t last) {
    double sum = 0;
    for (uint32_t i = first; i < last; ++i) sum += terms[i];
    return sum;
  });
}

TEST(Parallel, SumsHaveTheSameBitsForAllSchedules) {
  std::mt19937 random(1);
  for (const size_t count : {0u, 1u, 4095u, 4096u, 4097u, 100000u, 131071u, 131072u, 131073u, 500000u}) {
    std::vector<double> terms(count);
    double plain = 0;
    for (double& x : terms) x = std::uniform_real_distribution<>(-1, 1)(random);
    for (const double x : terms) plain += x;
    const double serial = SumOf(terms, {});
    EXPECT_EQ(SumOf(terms, {nullptr, support::Backwards, nullptr}), serial) << count;
    EXPECT_EQ(SumOf(terms, {nullptr, support::OnTwoThreads, nullptr}), serial) << count;
    EXPECT_NEAR(serial, plain, 1e-9) << count;
    if (count <= 4096) {
      EXPECT_EQ(serial, plain) << count;
    }
  }
}

}  // namespace
}  // namespace parallel_test
