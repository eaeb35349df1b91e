// SPDX-License-Identifier: MIT
// target: the face of a fuzzing target, for libFuzzer and for replay.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "tool/result.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace fuzz {

// What all inputs so far have reached, in a line.
std::string Tally();
// Did so many pseudo-random inputs reach enough to say that promises were tested?
bool ReachedEnough(uint64_t inputs);

[[noreturn]] void Break(const std::string& promise);
// Prints the promise, of strings and numbers, and aborts unless it holds.
template <class... Parts>
void Demand(bool holds, const Parts&... promise) {
  if (!holds) Break(tool::text_of(promise...));
}
// The cheap mode, for volume, with TOPOADAPT_FUZZ_CHEAP in the environment: judges look at one call in eight, and no
// twin plays the others.
bool IsCheap();
// Is call number `number` of an input judged? The same for equal inputs.
bool IsJudged(uint64_t number, uint64_t input_size);
// Prints a line about a call if TOPOADAPT_FUZZ_TRACE is set in the environment.
void Trace(const std::string& line);

}  // namespace fuzz
