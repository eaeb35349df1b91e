// SPDX-License-Identifier: MIT
#include "geometry/star.h"

#include "base/simd.h"

namespace tpa {

namespace {

// The triangles of a star are taken two at a time in vector registers, and usual_star at least: most stars have no
// more, and their loops a fixed length. Sums round differently in lanes, so other stars may stay unproven; an unproven
// star is tested pair by pair, with the same answer.
#if defined(TPA_VECTORS)
using Some = D2;
constexpr u32 usual_star = 8;
u32 bits_of_some(const I2& mask) { return bits_of_two(mask); }
f64 total(const D2& x) { return x[0] + x[1]; }
f64 largest(const D2& x) { return max_of(x[0], x[1]); }
D2 larger(const D2& a, const D2& b) { return max2(a, b); }
static_assert(sizeof(Vec3) == 3 * sizeof(f64));
Some coordinates(const f64* at) { return Some{at[0], at[3]}; }
#else
using Some = f64;
constexpr u32 usual_star = 0;
u32 bits_of_some(bool one) { return one; }
f64 total(f64 x) { return x; }
f64 largest(f64 x) { return x; }
f64 larger(f64 a, f64 b) { return max_of(a, b); }
Some coordinates(const f64* at) { return *at; }
#endif
constexpr u32 at_once = sizeof(Some) / sizeof(f64);
u32 rounded_up(u32 n) { return max_of(usual_star, n + n % at_once); }

// Rounded edges of the fan: from p to at[0], and to at[1] in the second lane.
struct Spokes {
  Some x, y, z;
};
Spokes spokes_to(const Vec3* at, const Vec3& p) {
  return {coordinates(&at->x) - p.x, coordinates(&at->y) - p.y, coordinates(&at->z) - p.z};
}

}  // namespace

// Soundness. Let u be half an ulp of 1, N the computed sum of normals, taken as an exact vector, r the largest
// coordinate difference of the star, and look along N. A triangle (p, a, b) turns by an angle between 0 and pi if
// N . (a x b) > 0. The computed value has six terms of seven roundings each (two differences, a product, a subtraction,
// a product with N, two additions), so its error is below 7.01 u times sum |N_x| (|a_y b_z| + |a_z b_y|), which is at
// most 2 |N|_1 r^2.
//
// The number of rounds k follows from a count: how often does the link change between the half planes m . a >= 0 and
// m . a < 0, for m = axis x N? If all triangles turn between 0 and pi, none can jump over either half plane, so k
// rounds change 2 k times. The axis is the one that N leans to least, so |m|^2 >= 2/3 |N|^2. m . a has two terms of two
// roundings each, so the computed value is off by less than 2.01 u r |N|_1, as if a were displaced along m by as much
// over |m|. Let all spokes move at once to their displaced places. On the way N . (a x b) changes by less than the
// displacement times (|a| + |b|) |N|, less than 9 u |N|_1 r^2, so N . (a x b) stays positive, and k stays the same.
//
// One bound of 24 u |N|_1 r^2, which covers its own roundings, serves all triangles. Coordinates are multiples of
// 2^-152, so products are multiples of 2^-304, and their rounded sums are zero or above 2^-305: nothing underflows. If
// all triangles turn by more than the bound and the link goes round once, the triangles are seen as sectors of disjoint
// interiors about p. Any two share p or their common edge, and a further common point in space would show.
bool star_is_unfolded(const Vec3& p, Vec3* link, u32 n) {
  if (n < 3 || n > star_is_unfolded_limit) return false;
  const u32 end = rounded_up(n);
  for (u32 i = n; i <= end; ++i) link[i] = link[0];
  Some nx[star_is_unfolded_limit / at_once], ny[star_is_unfolded_limit / at_once], nz[star_is_unfolded_limit / at_once];
  Some x{}, y{}, z{}, reach{};
  for (u32 i = 0, k = 0; i < end; i += at_once, ++k) {
    const Spokes a = spokes_to(link + i, p), b = spokes_to(link + i + 1, p);
    x = x + (nx[k] = a.y * b.z - a.z * b.y);
    y = y + (ny[k] = a.z * b.x - a.x * b.z);
    z = z + (nz[k] = a.x * b.y - a.y * b.x);
    reach = larger(larger(reach, abs_of(a.x)), larger(abs_of(a.y), abs_of(a.z)));
  }
  const Vec3 sum = {total(x), total(y), total(z)}, size = {abs_of(sum.x), abs_of(sum.y), abs_of(sum.z)};
  const f64 r = largest(reach), bound = 24 * 0x1p-53 * (size.x + size.y + size.z) * (r * r);
  // The two axes after the axis of the least component, without a branch: the axis is as good as random.
  static constexpr u8 first_after[8] = {0, 0, 0, 1, 2, 2, 2, 1}, second_after[8] = {1, 1, 1, 2, 0, 0, 0, 2};
  const u32 order = u32{size.x <= size.y} | u32{size.x <= size.z} << 1 | u32{size.y <= size.z} << 2;
  const u32 from = first_after[order], to = second_after[order];
  const f64 of_sum[] = {sum.x, sum.y, sum.z}, of_p[] = {p.x, p.y, p.z}, *const at = &link->x;
  const f64 sum_from = of_sum[from], sum_to = of_sum[to], p_from = of_p[from], p_to = of_p[to];
  u32 up = 0, down = 0;
  for (u32 i = 0, k = 0; i < end; i += at_once, ++k) {
    up |= bits_of_some(sum.x * nx[k] + sum.y * ny[k] + sum.z * nz[k] > Some{} + bound) << i;
    down |= bits_of_some((coordinates(at + 3 * i + from) - p_from) * sum_to <
                         (coordinates(at + 3 * i + to) - p_to) * sum_from)
            << i;
  }
  const u32 all = none >> (star_is_unfolded_limit - n);
  u32 changes = (down ^ (down >> 1 | down << (n - 1))) & all;
  changes &= changes - 1;
  return (up & all) == all && changes != 0 && (changes & (changes - 1)) == 0;
}

void FanNormal::add(const Vec3& spoke, const Vec3& next) {
  sum = sum + cross(spoke, next);
  reach = max_of(reach, max_of(abs_of(spoke.x), max_of(abs_of(spoke.y), abs_of(spoke.z))));
}

FanTurns::FanTurns(const FanNormal& normal) : sum_(normal.sum) {
  const f64 size[] = {abs_of(sum_.x), abs_of(sum_.y), abs_of(sum_.z)};
  bound_ = 24 * 0x1p-53 * (size[0] + size[1] + size[2]) * (normal.reach * normal.reach);
  const int least = size[0] <= size[1] ? (size[0] <= size[2] ? 0 : 2) : (size[1] <= size[2] ? 1 : 2);
  from_ = least == 2 ? 0 : least + 1;
  to_ = from_ == 2 ? 0 : from_ + 1;
}

void FanTurns::add(const Vec3& spoke, const Vec3& next) {
  all_up_ = all_up_ && turns_up(spoke, next);
  changes_ += is_behind(spoke) != is_behind(next) ? 1u : 0u;
}

}  // namespace tpa
