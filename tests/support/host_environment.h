// SPDX-License-Identifier: MIT
// Floating-point environments as hosts set them, and the registers that hold them, read without code of the library.
#pragma once

#include <cfenv>
#include <cstdint>
#include <string>
#include <vector>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace support {

struct HostEnvironment {
  std::string name;
  int rounding = FE_TONEAREST;
  int traps = 0;       // of feenableexcept()
  bool flush = false;  // subnormal numbers to zero, as operands and as results
  int flags = 0;       // raised before
};

// Can this processor flush subnormal numbers?
inline bool HasFlush() {
#if defined(__SSE2__) || defined(__aarch64__)
  return true;
#else
  return false;
#endif
}

inline void SetFlush() {
#if defined(__SSE2__)
  _mm_setcsr(_mm_getcsr() | 0x8040);
#elif defined(__aarch64__)
  uint64_t fpcr;
  asm volatile("mrs %0, fpcr" : "=r"(fpcr));
  asm volatile("msr fpcr, %0" : : "r"(fpcr | 1u << 24) : "memory");
#endif
}

// All of the control and status bits, where they can be read.
struct FloatRegisters {
  int rounding, traps, flags;
  uint64_t control;
  bool operator==(const FloatRegisters&) const = default;
};
inline FloatRegisters ReadFloatRegisters() {
  FloatRegisters r{std::fegetround(), 0, std::fetestexcept(FE_ALL_EXCEPT), 0};
#if defined(__GLIBC__)
  r.traps = fegetexcept();
#endif
#if defined(__SSE2__)
  r.control = _mm_getcsr();
#elif defined(__aarch64__)
  asm volatile("mrs %0, fpcr" : "=r"(r.control));
#endif
#if defined(__i386__)
  uint32_t x87[7];
  asm volatile("fnstenv %0\n\tfldenv %0" : "=m"(x87) : : "memory");
  r.control |= static_cast<uint64_t>(x87[0] & 0xFFFF) << 32 | static_cast<uint64_t>(x87[1] & 0xFF) << 48;
#endif
  return r;
}

// The environment for the length of a scope.
class Hosted {
 public:
  explicit Hosted(const HostEnvironment& e) {
    std::feholdexcept(&before_);
    std::feraiseexcept(e.flags);
    std::fesetround(e.rounding);
    if (e.flush) SetFlush();
#if defined(__GLIBC__)
    if (e.traps != 0) feenableexcept(e.traps);
#endif
    at_start_ = ReadFloatRegisters();
  }
  ~Hosted() { std::fesetenv(&before_); }
  Hosted(const Hosted&) = delete;
  Hosted& operator=(const Hosted&) = delete;
  bool Unchanged() const { return ReadFloatRegisters() == at_start_; }

 private:
  std::fenv_t before_;
  FloatRegisters at_start_;
};

// All rounding modes, with and without flush to zero, with no, each and all exceptions trapped. Flags are raised only
// where the exceptions are not trapped.
inline std::vector<HostEnvironment> HostEnvironments() {
  std::vector<HostEnvironment> all;
  const struct {
    const char* name;
    int mode;
  } roundings[] = {{"nearest", FE_TONEAREST}, {"up", FE_UPWARD}, {"down", FE_DOWNWARD}, {"to zero", FE_TOWARDZERO}};
  std::vector<int> traps{0};
#if defined(__GLIBC__)
  std::fenv_t before;
  std::feholdexcept(&before);
  // Some processors have no traps.
  if (feenableexcept(FE_ALL_EXCEPT) != -1 && fegetexcept() == FE_ALL_EXCEPT)
    traps = {0, FE_INVALID, FE_DIVBYZERO, FE_OVERFLOW, FE_UNDERFLOW, FE_INEXACT, FE_ALL_EXCEPT};
  std::fesetenv(&before);
#endif
  for (const auto& r : roundings)
    for (bool flush : {false, true})
      for (int trap : traps) {
        if (flush && !HasFlush()) continue;
        const int flags = (FE_DIVBYZERO | FE_UNDERFLOW) & ~trap;
        all.push_back({std::string(r.name) + (flush ? ", flush" : "") + ", traps " + std::to_string(trap), r.mode, trap,
                       flush, flags});
        if (flags != 0) all.push_back({all.back().name + ", no flags", r.mode, trap, flush, 0});
      }
  return all;
}

}  // namespace support
