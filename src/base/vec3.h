// SPDX-License-Identifier: MIT
// vec3: points and vectors. Every operation is a fixed sequence of IEEE operations (P6).
#pragma once

#include "base/fp.h"

namespace tpa {

struct Vec3 {
  f64 x = 0, y = 0, z = 0;
  constexpr f64& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  constexpr f64 operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  friend constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator*(f64 s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend constexpr bool operator==(const Vec3& a, const Vec3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
};

// Zeros of either sign differ, as for a copy of bytes.
constexpr bool have_same_bits(const Vec3& a, const Vec3& b) {
  const auto bits = [](f64 number) { return __builtin_bit_cast(u64, number); };
  return bits(a.x) == bits(b.x) && bits(a.y) == bits(b.y) && bits(a.z) == bits(b.z);
}

// Three points by reference.
struct Triangle {
  const Vec3* at[3];

  constexpr Triangle(const Vec3& a, const Vec3& b, const Vec3& c) : at{&a, &b, &c} {}
  constexpr Triangle(const Vec3 (&p)[3]) : Triangle(p[0], p[1], p[2]) {}
  constexpr const Vec3& operator[](u32 i) const { return *at[i]; }
};

// Uninitialised memory for n points.
template <u32 n>
struct Points {
  alignas(Vec3) u8 bytes[n * sizeof(Vec3)];
  Vec3* data() { return reinterpret_cast<Vec3*>(bytes); }
};

constexpr f64 dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr f64 squared_length(const Vec3& a) { return dot(a, a); }
// Above any sum of lengths, since load() admits coordinates up to 2^100 only. Sums of some hundred stay finite.
inline constexpr f64 no_way = 1e300;
inline f64 length(const Vec3& a) { return square_root(squared_length(a)); }
constexpr Vec3 midpoint(const Vec3& a, const Vec3& b) { return 0.5 * (a + b); }
// Twice the area times the unit normal of the triangle.
constexpr Vec3 area_normal(const Vec3& a, const Vec3& b, const Vec3& c) { return cross(b - a, c - a); }
constexpr Vec3 into_exact_range(const Vec3& a) {
  return {into_exact_range(a.x), into_exact_range(a.y), into_exact_range(a.z)};
}

}  // namespace tpa
