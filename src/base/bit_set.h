// SPDX-License-Identifier: MIT
// bit_set: a set of the numbers 0 .. n - 1, with a bit for each number, and two levels of summary, with a bit for each
// word below that is not 0. Iteration ascends, in O(members + n / 32768).
#pragma once

#include <string.h>

#include "base/base.h"

namespace tpa {

struct BitSet {
  static constexpr u32 levels = 3, bits = 32;  // bits of a word
  u32* level[levels] = {};
  u32 words = 0, top_words = 0;  // of all levels together, and of the last level

  bool contains(u32 id) const { return (level[0][id / bits] >> id % bits & 1) != 0; }
  // False for a number that was a member before.
  bool add(u32 id) {
    u32& word = level[0][id / bits];
    const u32 bit = 1u << id % bits;
    if ((word & bit) != 0) return false;
    if (word == 0) note_word(id / bits);
    word |= bit;
    return true;
  }
  void remove(u32 id) {
    u32& word = level[0][id / bits];
    word &= ~(1u << id % bits);
    if (word == 0) forget_word(id / bits);
  }
  // The first member from `id` on, or none; members added meanwhile count. Expected O(1), as for iteration.
  u32 next(u32 id) const {
    u32 word = id / bits, rest = level[0][word] & ~0u << id % bits;
    if (rest == 0) word = next_word(word + 1), rest = level[0][word];
    return rest == 0 ? none : bits * word + static_cast<u32>(__builtin_ctz(rest));
  }
  void clear() { memset(level[0], 0, words * sizeof(u32)); }

  // Iteration. The loop may remove the number in hand; numbers added meanwhile may be left out.
  struct End {};
  struct Iterator {
    const BitSet& set;
    u32 word, rest;
    u32 operator*() const { return bits * word + static_cast<u32>(__builtin_ctz(rest)); }
    bool operator!=(End) const { return rest != 0; }
    void operator++() {
      rest &= rest - 1;
      if (rest == 0) word = set.next_word(word + 1), rest = set.level[0][word];
    }
  };
  Iterator begin() const {
    const u32 first = next_word(0);
    return {*this, first, level[0][first]};
  }
  End end() const { return {}; }
  // Removes the members from n on. O(removed members); clear() is O(n).
  void cut_off(u32 n);

 private:
  // The first word from `word` on that is not 0, or the zero word behind all.
  u32 next_word(u32 word) const;
  void note_word(u32 word);
  void forget_word(u32 word);
};

// Words of memory for a set of the numbers 0 .. n - 1, all 0 in the empty set. The last word of each level stays 0.
constexpr u64 words_on_level(u64 n, u32 level) { return (n >> 5 * (level + 1)) + 2; }
constexpr u64 bit_set_words(u64 n) {
  u64 words = 0;
  for (u32 l = 0; l < BitSet::levels; ++l) words += words_on_level(n, l);
  return words;
}
inline BitSet open_bit_set(u32* words, u32 n) {
  BitSet set;
  for (u32 l = 0; l < BitSet::levels; ++l) {
    set.level[l] = words;
    words += words_on_level(n, l);
  }
  set.words = static_cast<u32>(bit_set_words(n));
  set.top_words = static_cast<u32>(words_on_level(n, BitSet::levels - 1));
  return set;
}

}  // namespace tpa
