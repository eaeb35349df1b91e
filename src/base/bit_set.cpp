// SPDX-License-Identifier: MIT
#include "base/bit_set.h"

namespace tpa {

namespace {

u32 bit_of(u32 id) { return 1u << id % BitSet::bits; }
u32 lowest(u32 word) { return static_cast<u32>(__builtin_ctz(word)); }
u32 from(u32 bit) { return ~0u << bit % BitSet::bits; }

}  // namespace

void BitSet::note_word(u32 word) {
  level[1][word / bits] |= bit_of(word);
  level[2][word / (bits * bits)] |= bit_of(word / bits);
}

void BitSet::forget_word(u32 word) {
  if ((level[1][word / bits] &= ~bit_of(word)) == 0) level[2][word / (bits * bits)] &= ~bit_of(word / bits);
}

void BitSet::cut_off(u32 n) {
  const u32 first = n / bits;
  for (u32 word = next_word(first); level[0][word] != 0; word = next_word(word + 1)) {
    level[0][word] &= word == first ? ~from(n) : 0;
    if (level[0][word] == 0) forget_word(word);
  }
}

u32 BitSet::next_word(u32 word) const {
  const u32 place = word / bits, behind = place + 1;
  if (const u32 beside = level[1][place] & from(word); beside != 0) return bits * place + lowest(beside);
  u32 wanted = from(behind);
  for (u32 top = behind / bits; top < top_words; ++top, wanted = ~0u)
    if (const u32 rest = level[2][top] & wanted; rest != 0) {
      const u32 next = bits * top + lowest(rest);
      return bits * next + lowest(level[1][next]);
    }
  return static_cast<u32>(level[1] - level[0]) - 1;
}

}  // namespace tpa
