// SPDX-License-Identifier: MIT
#include "target.h"

#include <cstdio>
#include <cstdlib>

namespace fuzz {

void Break(const std::string& promise) {
  std::fprintf(stderr, "\nbroken promise: %s\n", promise.c_str());
  std::abort();
}

void Trace(const std::string& line) {
  static const bool is_wanted = std::getenv("TOPOADAPT_FUZZ_TRACE") != nullptr;
  if (is_wanted) std::fprintf(stderr, "%s\n", line.c_str());
}

}  // namespace fuzz
