// SPDX-License-Identifier: MIT
#include "geometry/quantized_boxes.h"

namespace tpa {

namespace {

u8 nearest_step(f32 at) {
  return static_cast<u8>(static_cast<i32>(max_of(0.0f, min_of(at, static_cast<f32>(last_byte_step)))));
}

}  // namespace

QuantizedFrame frame_round(const Box& box) {
  // The steps of smaller frames might overflow.
  constexpr f32 least = 0x1p-100f;
  const f32 size = extent_of(box);
  QuantizedFrame f;
  for (u32 k = 0; k < 3; ++k) f.low[k] = box.low[k] - 0.5f * (size - (box.high[k] - box.low[k]));
  f.steps = static_cast<f32>(last_byte_step) / max_of(size, least);
  return f;
}

QuantizedBox byte_box(const QuantizedFrame& f, const Box& box) {
  QuantizedBox b;
#if defined(TPA_SSE2)
  static_assert(sizeof f == sizeof(F4) && sizeof b == 8);
  const F4 frame = load4(f.low), steps = all4(f.steps), last = all4(static_cast<f32>(last_byte_step));
  // Packing takes all negative numbers to zero, also those out of the range of integers.
  const auto whole = [&](const F4& x) {
    return _mm_cvttps_epi32(reinterpret_cast<__m128>(min4((x - frame) * steps, last)));
  };
  const __m128i words = _mm_packs_epi32(whole(load4(box.low)), whole(load4(box.high)));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(&b), _mm_packus_epi16(words, words));
#else
  for (u32 k = 0; k < 3; ++k) {
    b.low[k] = nearest_step((box.low[k] - f.low[k]) * f.steps);
    b.high[k] = nearest_step((box.high[k] - f.low[k]) * f.steps);
  }
#endif
  return b;
}

void set_bounds(const QuantizedFrame& f, u32 axis, Span<const F4> bounds, u8* to, u32 room) {
  // Rounding may exceed the last step by a fraction, which conversion to whole numbers drops.
  const F4 low = all4(f.low[axis]), steps = all4(f.steps);
  u32 at = 0;
#if defined(TPA_SSE2)
  const auto whole = [&](u32 i) { return _mm_cvttps_epi32(reinterpret_cast<__m128>((bounds[i] - low) * steps)); };
  for (; at < 4 * bounds.size && at + 16 <= room; at += 16) {
    const u32 i = at / 4;
    const __m128i first = _mm_packs_epi32(whole(i), whole(i + 1)), second = _mm_packs_epi32(whole(i + 2), whole(i + 3));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to + at), _mm_packus_epi16(first, second));
  }
#endif
  for (; at < 4 * bounds.size && at < room; ++at)
    to[at] = static_cast<u8>(static_cast<i32>((bounds[at / 4] - low)[at % 4] * steps[at % 4]));
}

void change_frame(const QuantizedLanes& boxes, u32 first, u32 last, const QuantizedFrame& from,
                  const QuantizedFrame& to) {
  const f32 scale = to.steps / from.steps;
  for (u32 k = 0; k < 3; ++k) {
    const f32 apart = (from.low[k] - to.low[k]) * to.steps;
    for (u32 i = first; i < last; ++i) {
      u8 &low = boxes.low[k][i], &high = boxes.high[k][i];
      if (low == no_byte_step) continue;
      // The first and the last step also stand for bounds beyond the frame.
      const bool in_low = low > 0, in_high = high < last_byte_step;
      low = in_low ? nearest_step(apart + static_cast<f32>(low) * scale - 1) : u8{0};
      high = in_high ? nearest_step(apart + static_cast<f32>(high + 1) * scale + 1) : u8{last_byte_step};
    }
  }
}

#if defined(TPA_VECTORS)
namespace {
using B16 = u8 __attribute__((vector_size(16)));

B16 load16(const u8* p) {
  B16 v;
  memcpy(&v, p, sizeof v);
  return v;
}
// The same box in all lanes.
struct BroadByteBox {
  B16 low[3], high[3];
};
#if defined(TPA_SSE2)
BroadByteBox broad(const QuantizedBox& q) {
  const __m128i eight = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(&q)), twice = _mm_unpacklo_epi8(eight, eight);
  const auto low = [](__m128i four) { return reinterpret_cast<B16>(_mm_shuffle_epi32(four, 0)); };
  const auto high = [](__m128i four) { return reinterpret_cast<B16>(_mm_shuffle_epi32(four, 0xFF)); };
  return {{low(_mm_shufflelo_epi16(twice, 0x00)), low(_mm_shufflelo_epi16(twice, 0x55)),
           low(_mm_shufflelo_epi16(twice, 0xAA))},
          {high(_mm_shufflehi_epi16(twice, 0x00)), high(_mm_shufflehi_epi16(twice, 0x55)),
           high(_mm_shufflehi_epi16(twice, 0xAA))}};
}
// Not zero where a > b.
B16 beyond(const B16& a, const B16& b) {
  return reinterpret_cast<B16>(_mm_subs_epu8(reinterpret_cast<__m128i>(a), reinterpret_cast<__m128i>(b)));
}
u32 bits_of_bytes(const B16& mask) { return static_cast<u32>(_mm_movemask_epi8(reinterpret_cast<__m128i>(mask))); }
#else
BroadByteBox broad(const QuantizedBox& q) {
  const auto all = [](u8 x) { return B16{x, x, x, x, x, x, x, x, x, x, x, x, x, x, x, x}; };
  return {{all(q.low[0]), all(q.low[1]), all(q.low[2])}, {all(q.high[0]), all(q.high[1]), all(q.high[2])}};
}
B16 beyond(const B16& a, const B16& b) { return reinterpret_cast<B16>(a > b); }
u32 bits_of_bytes(const B16& mask) {
  // One bit is left in each of eight bytes; the product gathers all eight in the highest byte.
  u64 half[2];
  memcpy(half, &mask, sizeof half);
  const auto gathered = [](u64 x) { return static_cast<u32>((x & 0x8040201008040201u) * 0x0101010101010101u >> 56); };
  return gathered(half[0]) | gathered(half[1]) << 8;
}
#endif
}  // namespace

u64 boxes_meeting(const QuantizedLanes& boxes, u32 first, u32 last, const QuantizedBox& q) {
  const BroadByteBox b = broad(q);
  const u32 n = min_of(last - first, 64u);
  u64 met = 0;
  for (u32 i = 0; i < n; i += bytes_in_lanes) {
    B16 apart{};
    for (u32 k = 0; k < 3; ++k)
      apart |=
          beyond(load16(boxes.low[k] + first + i), b.high[k]) | beyond(b.low[k], load16(boxes.high[k] + first + i));
    met |= u64{bits_of_bytes(reinterpret_cast<B16>(apart == B16{}))} << i;
  }
  return met & ~u64{0} >> (64 - n);
}
#else
u64 boxes_meeting(const QuantizedLanes& boxes, u32 first, u32 last, const QuantizedBox& q) {
  u64 met = 0;
  for (u32 i = first; i < min_of(last, first + 64); ++i) {
    u32 apart = 0;
    for (u32 k = 0; k < 3; ++k) apart |= u32{boxes.low[k][i] > q.high[k]} | u32{q.low[k] > boxes.high[k][i]};
    met |= u64{apart ^ 1} << (i - first);
  }
  return met;
}
#endif

}  // namespace tpa
