// SPDX-License-Identifier: MIT
#include "geometry/dyadic.h"

#include <string.h>

namespace tpa::dyadic_detail {

namespace {

// Drops limbs of zero at both ends of limb[0 .. size - 1].
void trim(i32 sign, i32 low, u32 size, DyadicTarget out) {
  while (size > 0 && out.limb[size - 1] == 0) --size;
  u32 zeros = 0;
  while (zeros < size && out.limb[zeros] == 0) ++zeros;
  if (zeros > 0) memmove(out.limb, out.limb + zeros, (size - zeros) * sizeof(u32));
  out.sign = size == 0 ? 0 : sign;
  out.low = size == 0 ? 0 : low + static_cast<i32>(zeros);
  out.size = size - zeros;
}

// The limb of exponent `at`, beyond both ends zero.
u32 limb_at(const DyadicView& a, i32 at) {
  const i32 i = at - a.low;
  return i >= 0 && i < static_cast<i32>(a.size) ? a.limb[i] : 0;
}

i32 end_of(const DyadicView& a) { return a.low + static_cast<i32>(a.size); }

int compare_magnitudes(const DyadicView& a, const DyadicView& b) {
  const i32 low = min_of(a.low, b.low);
  for (i32 at = max_of(end_of(a), end_of(b)); at-- > low;) {
    const u32 x = limb_at(a, at), y = limb_at(b, at);
    if (x != y) return x > y ? 1 : -1;
  }
  return 0;
}

void add_magnitudes(const DyadicView& a, const DyadicView& b, i32 sign, DyadicTarget out) {
  const i32 low = min_of(a.low, b.low), end = max_of(end_of(a), end_of(b));
  u64 carry = 0;
  u32 size = 0;
  for (i32 at = low; at < end; ++at) {
    carry += u64{limb_at(a, at)} + limb_at(b, at);
    out.limb[size++] = static_cast<u32>(carry);
    carry >>= 32;
  }
  if (carry != 0) out.limb[size++] = static_cast<u32>(carry);
  trim(sign, low, size, out);
}

// Pre: |a| >= |b|.
void subtract_magnitudes(const DyadicView& a, const DyadicView& b, i32 sign, DyadicTarget out) {
  const i32 low = min_of(a.low, b.low), end = end_of(a);
  i64 borrow = 0;
  u32 size = 0;
  for (i32 at = low; at < end; ++at) {
    borrow += i64{limb_at(a, at)} - limb_at(b, at);
    out.limb[size++] = static_cast<u32>(borrow);
    borrow >>= 32;  // arithmetic: 0 or -1
  }
  trim(sign, low, size, out);
}

void copy(const DyadicView& a, i32 sign, DyadicTarget out) {
  memcpy(out.limb, a.limb, a.size * sizeof(u32));
  out.sign = sign;
  out.low = a.low;
  out.size = a.size;
}

u32 bits_of(u32 limb) { return 32 - static_cast<u32>(__builtin_clz(limb)); }

// The magnitude of a as an integer of `words` limbs whose highest bit is bit 32 * (words - 1) - 1: shifted up, exactly,
// as there is room for one limb more than the longer operand has.
void align_top(const DyadicView& a, u32* out, u32 words) {
  memset(out, 0, words * sizeof(u32));
  const u32 shift = 32 - bits_of(a.limb[a.size - 1]), first = words - 1 - a.size;
  for (u32 i = 0; i < a.size; ++i) {
    const u64 moved = u64{a.limb[i]} << shift;
    out[first + i] |= static_cast<u32>(moved);
    out[first + i + 1] |= static_cast<u32>(moved >> 32);
  }
}

bool at_least(const u32* a, const u32* b, u32 words) {
  for (u32 i = words; i-- > 0;)
    if (a[i] != b[i]) return a[i] > b[i];
  return true;
}
// a - times * b; below zero as a complement of two.
void take_away(u32* a, const u32* b, u32 times, u32 words) {
  u64 carry = 0;
  for (u32 i = 0; i < words; ++i) {
    carry += u64{times} * b[i];
    const u32 low = static_cast<u32>(carry);
    carry = (carry >> 32) + (a[i] < low ? 1 : 0);
    a[i] -= low;
  }
}
void put_back(u32* a, const u32* b, u32 words) {
  u64 carry = 0;
  for (u32 i = 0; i < words; ++i) {
    carry += u64{a[i]} + b[i];
    a[i] = static_cast<u32>(carry);
    carry >>= 32;
  }
}
void shift_up(u32* a, u32 bits, u32 words) {
  for (u32 i = words; i-- > 1;) a[i] = a[i] << bits | a[i - 1] >> (32 - bits);
  a[0] <<= bits;
}

// The next bits of a quotient, 1 .. 28 of them. The divisor's top bit is set, so a guess from the top limbs is too
// large by two at most (Knuth 1969, The Art of Computer Programming, 4.3.1). Pre: rest < divisor.
u32 next_bits(u32* rest, const u32* divisor, u32 bits, u32 words) {
  shift_up(rest, bits, words);
  const u64 top = u64{rest[words - 1]} << 32 | rest[words - 2];
  u32 guess = static_cast<u32>(top / divisor[words - 2]);
  take_away(rest, divisor, guess, words);
  for (; (rest[words - 1] >> 31) != 0; --guess) put_back(rest, divisor, words);
  return guess;
}
bool is_zero(const u32* a, u32 words) {
  for (u32 i = 0; i < words; ++i)
    if (a[i] != 0) return false;
  return true;
}

i32 top_bit(const DyadicView& a) { return 32 * (end_of(a) - 1) + static_cast<i32>(bits_of(a.limb[a.size - 1])); }

// Has the mantissa 53 significant bits at most?
bool is_double(u64 mantissa) { return (mantissa >> __builtin_ctzll(mantissa)) >> 53 == 0; }

// mantissa * 2^exponent, with the mantissa rounded to 53 bits, ties to even. Integer arithmetic, whatever the rounding
// mode of the processor.
f64 rounded(u64 mantissa, i32 exponent) {
  const u32 bits = 64 - static_cast<u32>(__builtin_clzll(mantissa));
  if (bits > 53) {
    const u32 drop = bits - 53;
    const u64 rest = mantissa & ((u64{1} << drop) - 1), half = u64{1} << (drop - 1);
    mantissa >>= drop;
    if (rest > half || (rest == half && (mantissa & 1) != 0)) ++mantissa;
    exponent += static_cast<i32>(drop);
  }
  // 2^exponent has an exponent field of its own; the product is exact.
  const u64 power = static_cast<u64>(exponent + 1023) << 52;
  f64 scale;
  memcpy(&scale, &power, sizeof scale);
  return static_cast<f64>(mantissa) * scale;
}

}  // namespace

void read(f64 value, DyadicTarget out) {
  u64 bits;
  memcpy(&bits, &value, sizeof bits);
  const u64 mantissa = (bits & ((u64{1} << 52) - 1)) | u64{1} << 52;
  const i32 exponent = static_cast<i32>(bits >> 52 & 0x7FF) - 1075;
  if (value == 0) {
    trim(0, 0, 0, out);
    return;
  }
  // Towards minus infinity: the shift that is left is 0 .. 31.
  const i32 low = exponent >= 0 ? exponent / 32 : -((31 - exponent) / 32);
  const u32 shift = static_cast<u32>(exponent - 32 * low);
  const u64 lower = mantissa << shift, upper = shift == 0 ? 0 : mantissa >> (64 - shift);
  out.limb[0] = static_cast<u32>(lower);
  out.limb[1] = static_cast<u32>(lower >> 32);
  out.limb[2] = static_cast<u32>(upper);
  trim(value < 0 ? -1 : 1, low, 3, out);
}

void multiply(const DyadicView& a, const DyadicView& b, DyadicTarget out) {
  if (a.sign == 0 || b.sign == 0) {
    trim(0, 0, 0, out);
    return;
  }
  memset(out.limb, 0, (a.size + b.size) * sizeof(u32));
  for (u32 i = 0; i < a.size; ++i) {
    u64 carry = 0;
    for (u32 k = 0; k < b.size; ++k) {
      carry += u64{a.limb[i]} * b.limb[k] + out.limb[i + k];
      out.limb[i + k] = static_cast<u32>(carry);
      carry >>= 32;
    }
    out.limb[i + b.size] = static_cast<u32>(carry);
  }
  trim(a.sign * b.sign, a.low + b.low, a.size + b.size, out);
}

void add(const DyadicView& a, const DyadicView& b, i32 sign, DyadicTarget out) {
  const i32 b_sign = sign * b.sign;
  if (b_sign == 0) return copy(a, a.sign, out);
  if (a.sign == 0) return copy(b, b_sign, out);
  if (a.sign == b_sign) return add_magnitudes(a, b, a.sign, out);
  const int order = compare_magnitudes(a, b);
  if (order == 0) return trim(0, 0, 0, out);
  if (order > 0) return subtract_magnitudes(a, b, a.sign, out);
  subtract_magnitudes(b, a, b_sign, out);
}

// Long division: 56 bits of quotient, of which the first may be zero, and a bit for a rest.
f64 quotient(const DyadicView& a, const DyadicView& b, u32* room, u32 words, bool& exact) {
  exact = a.sign == 0;
  if (exact) return 0;
  const i32 exponent = top_bit(a) - top_bit(b) - 55;
  if (exponent + 55 < -101) return 0;  // below 2^-100, whatever the bits
  words = min_of(words, max_of(a.size, b.size) + 2);
  u32 *rest = room, *divisor = room + words;
  align_top(a, rest, words);
  align_top(b, divisor, words);
  u64 bits = at_least(rest, divisor, words) ? 1 : 0;
  if (bits != 0) take_away(rest, divisor, 1, words);
  bits = bits << 27 | next_bits(rest, divisor, 27, words);
  bits = bits << 28 | next_bits(rest, divisor, 28, words);
  bits = bits << 1 | (is_zero(rest, words) ? 0 : 1);
  const f64 nearest = a.sign * b.sign * rounded(bits, exponent - 1), within = into_exact_range(nearest);
  exact = within == nearest && is_double(bits);
  return within;
}

}  // namespace tpa::dyadic_detail
