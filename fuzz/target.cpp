// SPDX-License-Identifier: MIT
#include "target.h"

#include <cstdio>
#include <cstdlib>

namespace fuzz {

void Break(const std::string& promise) {
  std::fprintf(stderr, "\nbroken promise: %s\n", promise.c_str());
  std::abort();
}

bool IsCheap() {
  static const bool is_cheap = std::getenv("TOPOADAPT_FUZZ_CHEAP") != nullptr;
  return is_cheap;
}

bool IsJudged(uint64_t number, uint64_t input_size) {
  constexpr uint64_t calls_for_a_judge = 8;
  return !IsCheap() || number % calls_for_a_judge == input_size % calls_for_a_judge;
}

void Trace(const std::string& line) {
  static const bool is_wanted = std::getenv("TOPOADAPT_FUZZ_TRACE") != nullptr;
  if (is_wanted) std::fprintf(stderr, "%s\n", line.c_str());
}

}  // namespace fuzz
