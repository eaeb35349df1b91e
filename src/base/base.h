// SPDX-License-Identifier: MIT
// base: integers, spans, hashes of numbers and checked sizes, the ground of all of src/.
#pragma once

#include <stddef.h>
#include <stdint.h>

// 32-bit processors: no memory for code whose only gain is speed, and mostly no caches. Results and units of work are
// the same.
#define TPA_SMALL (UINTPTR_MAX <= UINT32_MAX)

namespace tpa {

using u8 = uint8_t;
using u16 = uint16_t;
using u32 = uint32_t;
using u64 = uint64_t;
using i8 = int8_t;
using i32 = int32_t;
using i64 = int64_t;
using f32 = float;
using f64 = double;

// "No such element", for every index of the library.
inline constexpr u32 none = 0xFFFFFFFFu;

// 2^64 / the golden ratio: products with this factor differ in their upper bits even for nearly equal numbers (Knuth
// 1973, The Art of Computer Programming, 6.4).
inline constexpr u64 scattering = 0x9e3779b97f4a7c15u;
// Hashes of a number, and of a pair. Pairs take two products: after a single product, pairs whose first numbers differ
// by a common stride would crowd.
constexpr u32 scattered(u32 a) { return static_cast<u32>(a * scattering >> 32); }
constexpr u32 scattered(u32 a, u32 b) {
  const u64 once = (u64{a} << 32 | b) * scattering;
  return static_cast<u32>((once ^ once >> 32) * scattering >> 32);
}

// Brings memory into the caches ahead of use. Inlined by force: GCC 12 removes calls of functions that only prefetch.
[[gnu::always_inline]] inline void fetch(const void* p) {
  if constexpr (!TPA_SMALL) __builtin_prefetch(p);
}

template <class T>
constexpr T min_of(T a, T b) {
  return b < a ? b : a;
}
template <class T>
constexpr T max_of(T a, T b) {
  return a < b ? b : a;
}
// Types that differ in name only: u32 is `unsigned long` on Cortex-M, where the literal 1u is `unsigned int`.
template <class A, class B>
concept SameIntegers = sizeof(A) == sizeof(B) && A(-1) == B(-1) && (A(-1) < 0) == (B(-1) < 0);
template <class A, class B>
requires SameIntegers<A, B>
constexpr A min_of(A a, B b) { return min_of<A>(a, static_cast<A>(b)); }
template <class A, class B>
requires SameIntegers<A, B>
constexpr A max_of(A a, B b) { return max_of<A>(a, static_cast<A>(b)); }
template <class T>
constexpr void swap_values(T& a, T& b) {
  T t = a;
  a = b;
  b = t;
}

// Three vertices of a face, counter-clockwise seen from outside; the face may not exist yet.
struct FaceCorners {
  u32 v[3];
};

// A borrowed array. The owner is the arena, and a span never outlives the call of its making.
template <class T>
struct Span {
  T* data = nullptr;
  u32 size = 0;
  constexpr T& operator[](u32 i) const { return data[i]; }
  constexpr T* begin() const { return data; }
  constexpr T* end() const { return data + size; }
  constexpr bool empty() const { return size == 0; }
  constexpr Span part(u32 first, u32 count) const { return {data + first, count}; }
  constexpr operator Span<const T>() const { return {data, size}; }
};

// An array with a limit. push() returns false for a full stack: running out is an answer, not an accident.
template <class T>
struct Stack {
  T* data = nullptr;
  u32 capacity = 0;
  u32 size = 0;
  constexpr bool push(const T& value) {
    if (size == capacity) return false;
    data[size++] = value;
    return true;
  }
  constexpr T pop() { return data[--size]; }
  constexpr T& operator[](u32 i) const { return data[i]; }
  constexpr T* begin() const { return data; }
  constexpr T* end() const { return data + size; }
  constexpr bool empty() const { return size == 0; }
  constexpr void clear() { size = 0; }
  constexpr Span<T> span() const { return {data, size}; }
};

// Sums and products of sizes. False if the true value does not fit; `out` then stays as it was.
[[nodiscard]] constexpr bool checked_add(u64 a, u64 b, u64& out) {
  if (b > UINT64_MAX - a) return false;
  out = a + b;
  return true;
}
[[nodiscard]] constexpr bool checked_mul(u64 a, u64 b, u64& out) {
  // By halves: compilers turn a division by a factor into a product of 128 bits, a library's function on some
  // platforms.
  const u64 large = a < b ? b : a, small = a < b ? a : b;
  if (small >> 32 != 0 || ((large >> 32) * small + ((large & UINT32_MAX) * small >> 32)) >> 32 != 0) return false;
  out = a * b;
  return true;
}

}  // namespace tpa
