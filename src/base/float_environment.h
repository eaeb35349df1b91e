// SPDX-License-Identifier: MIT
// float_environment: the floating-point environment that all bits rest on (P6): rounding to nearest, no trapped
// exceptions, subnormal numbers kept. A host may have set another one, on any of its threads.
#pragma once

#include "base/fp.h"

namespace tpa {

// Is arithmetic as needed? For processors whose environment has no instructions below. May raise exception flags.
inline bool rounds_as_needed() {
  volatile f64 one = 1, little = 0x1p-60, most_of_half = 0x1.8p-53, least = DBL_MIN;
  const f64 up = one + little, down = -one - little, nearest = one + most_of_half, subnormal = least * 0.5;
  return up == 1 && down == -1 && nearest > 1 && subnormal > 0;
}

// FloatState: the registers of the environment, control and exception flags. Assembler, since builtins are no barriers:
// arithmetic on memory must not move across.
#if defined(TPA_UNKNOWN_FLOAT_STATE)
#define TPA_NO_FLOAT_STATE
#elif defined(__SSE2__)
struct FloatState {
  u32 mxcsr;
#if defined(__i386__)
  // Conversions of 64-bit integers go through the x87 unit. As stored by fnstenv: control, status, five others.
  u32 x87[7];
#endif
};
inline FloatState float_state() {
  FloatState s;
  asm volatile("stmxcsr %0" : "=m"(s.mxcsr) : : "memory");
#if defined(__i386__)
  // fnstenv masks all exceptions as it goes.
  asm volatile("fnstenv %0\n\tfldenv %0" : "=m"(s.x87) : : "memory");
#endif
  return s;
}
inline void set_float_state(const FloatState& s) {
  asm volatile("ldmxcsr %0" : : "m"(s.mxcsr) : "memory");
#if defined(__i386__)
  // The top of the register stack stays as it is.
  constexpr u32 flags = 0x80FF;
  u32 now[7];
  asm volatile("fnstenv %0" : "=m"(now) : : "memory");
  now[0] = s.x87[0];
  now[1] = (now[1] & ~flags) | (s.x87[1] & flags);
  asm volatile("fldenv %0" : : "m"(now) : "memory");
#endif
}
inline FloatState needed_state(FloatState s) {
  s.mxcsr = 0x1F80;
#if defined(__i386__)
  s.x87[0] = (s.x87[0] & ~0xFFFFu) | 0x037F;
  s.x87[1] &= ~0xFFu;
#endif
  return s;
}
#elif defined(__aarch64__)
struct FloatState {
  u64 fpcr, fpsr;
};
inline FloatState float_state() {
  FloatState s;
  asm volatile("mrs %0, fpcr\n\tmrs %1, fpsr" : "=r"(s.fpcr), "=r"(s.fpsr) : : "memory");
  return s;
}
inline void set_float_state(const FloatState& s) {
  asm volatile("msr fpcr, %0\n\tmsr fpsr, %1" : : "r"(s.fpcr), "r"(s.fpsr) : "memory");
}
inline FloatState needed_state(FloatState) { return {0, 0}; }
#elif defined(__ARM_FP)
struct FloatState {
  u32 fpscr;
};
inline FloatState float_state() {
  FloatState s;
  asm volatile("vmrs %0, fpscr" : "=r"(s.fpscr) : : "memory");
  return s;
}
inline void set_float_state(const FloatState& s) {
#if defined(__clang__)
  asm volatile("vmsr fpscr, %0" : : "r"(s.fpscr) : "memory");
#else
  asm volatile("vmsr fpscr, %0" : : "r"(s.fpscr) : "memory", "vfpcc");
#endif
}
// Half precision, default NaN, flush to zero, rounding, traps and flags. Lengths of vectors stay.
inline FloatState needed_state(FloatState s) { return {s.fpscr & ~u32{0x0FC89F9F}}; }
#elif defined(__riscv_flen)
struct FloatState {
  size_t fcsr;
};
inline FloatState float_state() {
  FloatState s;
  asm volatile("frcsr %0" : "=r"(s.fcsr) : : "memory");
  return s;
}
inline void set_float_state(const FloatState& s) { asm volatile("fscsr %0" : : "r"(s.fcsr) : "memory"); }
inline FloatState needed_state(FloatState) { return {0}; }
#elif defined(__s390x__)
struct FloatState {
  u32 fpc;
};
inline FloatState float_state() {
  FloatState s;
  asm volatile("efpc %0" : "=d"(s.fpc) : : "memory");
  return s;
}
inline void set_float_state(const FloatState& s) { asm volatile("sfpc %0" : : "d"(s.fpc) : "memory"); }
inline FloatState needed_state(FloatState) { return {0}; }
#elif defined(__wasm__) || defined(__SOFTFP__) || defined(__riscv)
// A single environment, the needed one.
struct FloatState {};
inline FloatState float_state() { return {}; }
inline void set_float_state(const FloatState&) {}
inline FloatState needed_state(FloatState s) { return s; }
#else
#define TPA_NO_FLOAT_STATE
#endif

// Sets the needed environment for the length of a scope. At its end the caller's environment is back, flags included.
class FloatEnvironment {
 public:
#if defined(TPA_NO_FLOAT_STATE)
  bool as_needed() const { return as_needed_; }

 private:
  bool as_needed_ = rounds_as_needed();
#else
  FloatEnvironment() : caller_(float_state()) { set_float_state(needed_state(caller_)); }
  ~FloatEnvironment() { set_float_state(caller_); }
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;
  bool as_needed() const { return true; }

 private:
  FloatState caller_;
#endif
};
#undef TPA_NO_FLOAT_STATE

}  // namespace tpa
